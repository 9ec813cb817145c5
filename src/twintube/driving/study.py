"""The study of drives: random cars drive with good and with worn dampers; a Parquet file of features, a row for each minute.

What is computed stands at once in a journal beside the file, with which an interrupted study goes on.
"""

import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Final

from twintube.common.bars import Bar
from twintube.common.files import replacing
from twintube.common.words import counted
from twintube.dampers.freed_gas import DEFAULT, SCALAR, VARIED
from twintube.driving.channels import PLACES
from twintube.driving.draws import GROUPS, PER_CAR, REFERENCES, Drawn, draw
from twintube.driving.drives import driven
from twintube.driving.features import table
from twintube.driving.scenes import scene
from twintube.driving.writing import write
from twintube.errors import InputError
from twintube.provenance import fingerprint
from twintube.studies.definition import StudyError
from twintube.studies.execute import Work, column, locally, on_cluster
from twintube.version import __version__

DRIVES: Final = (1, 100_000)
MINUTES: Final = (1.0, 60.0)
NAME: Final = "driving"
FIXED: Final = {
    "drive": "1", "group": "", "car": "1", "reference": "bool", "model": "", "failed": "", "minute": "1",
    "road_class": "", "road_seed": "1", "road_scale": "1", "speed_kmh": "km/h", "persons": "1", "luggage_kg": "kg",
    "temperature_degC": "degC", "ambient_degC": "degC", "hills": "1", "apart": "1",
    **{f"{name}_{place}": unit for name, unit in (("oil_level", "1"), ("gas_preload", "1"), ("tyre_pressure", "Pa"))
       for place in PLACES},
}  # fmt: skip


@dataclass(frozen=True)
class Plan:
    """What is driven: drives of some minutes from a seed.

    Worn dampers drive again on the same roads with the other ways of the freed gas (`freed_gas`), and as scalar factors
    (`scalar`). Raises StudyError.
    """

    drives: int
    minutes: float
    seed: int = 1
    scalar: bool = False
    freed_gas: bool = False
    group: str | None = None  # the cars of one group of `draws` alone
    per_car: int = PER_CAR  # drives of each car, of which the first are its references
    signals: str | None = None  # folder that receives the signals of every drive

    def __post_init__(self) -> None:
        """Check the bounds."""
        for name, value, (low, high) in (("drives", self.drives, DRIVES), ("minutes", self.minutes, MINUTES)):
            if not low <= value <= high:
                raise StudyError(f"{name} = {value:g}: must be from {low:g} to {high:g}")
        if self.seed < 0:
            raise StudyError(f"seed = {self.seed}: must not be below 0")
        if not REFERENCES < self.per_car <= PER_CAR:
            raise StudyError(f"per_car = {self.per_car}: must be from {REFERENCES + 1} to {PER_CAR}")
        if self.group is not None and self.group not in GROUPS:
            raise StudyError(f"group {self.group}: must be one of {', '.join(GROUPS)}")

    def __len__(self) -> int:
        return self.drives * len(self.models)

    def number(self, i: int) -> int:
        """The number of the drive that is the `i`-th of this study."""
        car, place = divmod(i, self.per_car)
        if self.group is not None:
            car = car * len(GROUPS) + GROUPS.index(self.group)
        return car * PER_CAR + place

    @property
    def models(self) -> tuple[str, ...]:
        """What the worn dampers of a drive are, one after the other; DEFAULT first."""
        others = tuple(way for way in VARIED if way != DEFAULT)
        return (DEFAULT, *(others if self.freed_gas else ()), *((SCALAR,) if self.scalar else ()))

    @property
    def text(self) -> str:
        """What the result depends on, but for the version."""
        known = asdict(self)
        del known["signals"]
        return json.dumps({"study": NAME, **known})


def version_mark() -> str:
    """Version and fingerprint of the sources."""
    return f"{__version__} {fingerprint(__name__)}"


def work(plan: Plan, start: int, stop: int, expected: str) -> list[list[dict[str, Any]]]:
    """The rows of each case from `start` to before `stop`; raises StudyError where this process has another version."""
    if version_mark() != expected:
        raise StudyError(f"a worker has twintube {version_mark()}, not {expected}: install the same version on both")
    return [rows(plan, number) for number in range(start, stop)]


def rows(plan: Plan, number: int) -> list[dict[str, Any]]:
    """A row for each minute of a case; one that says why where it could not be driven, none for a twin without wear."""
    i, which = divmod(number, len(plan.models))
    number, model = plan.number(i), plan.models[which]
    drawn = draw(number, 60.0 * plan.minutes, plan.seed, model)
    if model != DEFAULT and min(drawn.wear.oil_level) == 1.0 and min(drawn.wear.gas_preload) == 1:
        return []
    name = f"drive_{number:06d}{'' if model == DEFAULT else '_' + model.split()[0]}.parquet"
    return minutes_of(drawn, None if plan.signals is None else Path(plan.signals) / name)


def minutes_of(drawn: Drawn, file: Path | None = None) -> list[dict[str, Any]]:
    """A row for each minute of a drive, or one that says why there is none; its signals are written to `file`."""
    about = described(drawn)
    try:
        signals = driven(scene(drawn.vehicle, drawn.conditions, drawn.wear, {"drive": drawn.number, "group": drawn.group}))
        if file is not None:
            write(signals, file)
        minutes = table(signals)
    except InputError as error:
        return [about | {"failed": str(error), "minute": 0}]
    if not minutes:
        return [about | {"failed": "no minute is usable", "minute": 0}]
    return [about | {"minute": i + 1} | minute for i, minute in enumerate(minutes)]


def described(drawn: Drawn) -> dict[str, Any]:
    """What is said of a drive in each of its rows."""
    where, wear = drawn.conditions, drawn.wear
    return {
        "drive": drawn.number, "group": drawn.group, "car": drawn.car, "reference": drawn.reference, "model": wear.model,
        "road_class": where.road_class, "road_seed": where.road_seed, "road_scale": where.scale,
        "speed_kmh": where.speed_kmh, "persons": where.persons, "luggage_kg": where.luggage,
        "temperature_degC": where.temperature, "ambient_degC": where.ambient, "hills": where.hills, "apart": where.apart,
        **{f"oil_level_{place}": float(level) for place, level in zip(PLACES, wear.oil_level, strict=True)},
        **{f"gas_preload_{place}": int(gas) for place, gas in zip(PLACES, wear.gas_preload, strict=True)},
        **{f"tyre_pressure_{place}": value for place, value in zip(PLACES, where.pressures, strict=True)},
    }  # fmt: skip


def journal_of(output: Path) -> Path:
    """Where a study keeps what it has computed until all is."""
    return output.with_name(f"{output.name}.journal")


def begun(journal: Path, head: str) -> list[list[dict[str, Any]]]:
    """The cases that a journal holds; a line that was cut short is left out. Raises StudyError for another study's."""
    if not journal.exists():
        return []
    lines = journal.read_text(encoding="utf-8").split("\n")
    if lines[0] != head:
        raise StudyError(f"{journal} is of another study or version: remove it, or name another --output")
    return [json.loads(line) for line in lines[1:-1]]


def computed(
    plan: Plan, done: int, processes: int, cluster: str | None
) -> Iterator[list[list[dict[str, Any]]]]:  # fmt: skip
    """The rows of the cases from `done` on, a case at a time."""
    spans = [(i, i + 1) for i in range(done, len(plan))]
    task: Work = work
    if not spans:
        return
    parts = (
        on_cluster(task, plan, version_mark(), spans, cluster)
        if cluster is not None
        else locally(task, plan, version_mark(), spans, processes)
    )
    with closing(parts):
        yield from parts


def run(
    plan: Plan, output: Path, *, processes: int, cluster: str | None = None, progress: bool = True
) -> tuple[int, int]:  # fmt: skip
    """Drive a study into the Parquet file `output`; returns the numbers of rows and of drives that failed.

    Computed by `processes` of this machine, or by the workers of the Dask scheduler at the address `cluster`. A study
    that was interrupted goes on by its journal. Raises StudyError.
    """
    if processes < 1:
        raise StudyError(f"processes = {processes}: must be at least 1")
    if output.is_dir():
        raise StudyError(f"{output} is a folder, not a file")
    if plan.signals is not None:
        Path(plan.signals).mkdir(parents=True, exist_ok=True)
    journal, head = journal_of(output), json.dumps({"plan": plan.text, "version": version_mark()})
    cases = begun(journal, head)
    bar = Bar(total=len(plan), initial=len(cases), unit="drive", leave=False, disable=None if progress else True)
    # Written anew, without a line that was cut short.
    with journal.open("w", encoding="utf-8") as file, bar:
        for text in (head, *map(json.dumps, cases)):
            file.write(text + "\n")
        for part in computed(plan, len(cases), processes, cluster):
            for case in part:
                file.write(json.dumps(case) + "\n")
                cases.append(case)
            file.flush()
            bar.update(len(part))
    found = [row for case in cases for row in case]
    write_table(plan, found, output)
    journal.unlink()
    return len(found), sum("failed" in row for row in found)


def write_table(plan: Plan, found: Sequence[Mapping[str, Any]], output: Path) -> None:
    """All rows as Parquet; no date, so that equal studies give equal files."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    whole = {"drive", "car", "minute", "road_seed", "persons", *(name for name in FIXED if name.startswith("gas_preload"))}
    kinds = {"": pa.string(), "bool": pa.bool_()}
    fields = [
        column(name, pa.int64() if name in whole else kinds.get(unit, pa.float64()), unit if unit not in kinds else "1")
        for name, unit in FIXED.items()
    ]
    names = dict.fromkeys(name for row in found for name in row if name not in FIXED)
    fields += [column(name, pa.float64(), "1") for name in names]
    about = {"twintube.version": __version__, "twintube.fingerprint": version_mark(), "twintube.study": plan.text}
    columns = [pa.array([row.get(field.name) for row in found], field.type) for field in fields]
    with replacing(output) as part:
        pq.write_table(pa.table(columns, schema=pa.schema(fields, metadata=about)), part, compression="zstd")


def summary(plan: Plan, output: Path, counts: tuple[int, int]) -> str:
    """What a study says at its end."""
    failed = f", {counted(counts[1], 'drive')} could not be driven" if counts[1] else ""
    return f"{output}: {counted(counts[0], 'row')} of {counted(plan.drives, 'drive')} of {plan.minutes:g} min{failed}"
