"""From a dataset folder to an identified parameter set with its origin and its validation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from twintube.common.arrays import Array
from twintube.common.showing import data_frame, picture
from twintube.common.words import listed
from twintube.dampers import Damper
from twintube.data import LoadedDataset, Record, load_dataset, require_fills
from twintube.data.findings import unconfirmed
from twintube.engine.simulate import InputError
from twintube.fitting.averaging import averaging, through
from twintube.fitting.harmonic import Harmonic
from twintube.fitting.oscillations import harmonic
from twintube.fitting.splits import distinct
from twintube.fitting.strokes import quiet
from twintube.identification.optimise import DEFAULT
from twintube.identification.pressure import at_one_pressure
from twintube.identification.remarks import EQUAL_SPEEDS, SINGLE, continuation, noisy, reach, signs
from twintube.identification.temperature import at_their_temperature
from twintube.identification.validation import Validated, intact, validate_drives, validate_harmonic
from twintube.identification.workflow import PAPER, Budget, Identification, identify_damper

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

ENOUGH = 5  # distinct velocities from which on some are held out, where dataset.toml splits nothing
HELD_OUT = (3, 1)  # every third velocity from the second on; not the two highest, between which cavitation begins


@dataclass(frozen=True, repr=False)
class Result:
    """What `twintube identify` reports: `identification.damper` is the identified damper.

    `to_dataframe()` and `plot()` show how it does on the records, `identification.to_dataframe()` the parameters.
    """

    dataset: LoadedDataset
    harmonics: list[tuple[Harmonic, str]]  # with their split, in the order of the dataset
    identification: Identification
    validation: list[Validated]
    remarks: list[str]

    def to_dataframe(self) -> pd.DataFrame:
        """A row for each record: its state, whether it was fitted, and how far the identified damper is off in it.

        Works are of the first and the last oscillation, of drives the total. Units stand in `.attrs["units"]`. Raises
        UserError where pandas is not installed.
        """
        rows = [
            {
                "record": v.name, "split": v.split, "oil_level": v.oil_level, "gas_preload": v.gas_preload,
                "top_speed": v.top_speed, "force_rmse": v.force_rmse, "force_peak": v.force_peak,
                "work_first": v.work_measured[0], "work_first_simulated": v.work_simulated[0],
                "work_last": v.work_measured[-1], "work_last_simulated": v.work_simulated[-1],
            }
            for v in self.validation
        ]  # fmt: skip
        forces, works = ("force_rmse", "force_peak"), ("first", "first_simulated", "last", "last_simulated")
        units = {"top_speed": "m/s"} | dict.fromkeys(forces, "N") | {f"work_{which}": "J" for which in works}
        return data_frame(rows, units, index="record")

    def plot(self) -> Figure:
        """Draw the work of each oscillation, measured and simulated, as a figure of pyplot."""
        return picture(self)

    def __repr__(self) -> str:
        fitted = sum(row.split == "fit" for row in self.validation)
        return f"<Result: {self.identification.damper.name} from {fitted} of {len(self.validation)} records>"


def identify(
    path: str | Path,
    *,
    method: str = DEFAULT,
    budget: Budget = PAPER,
    seed: int = 1,
    journal: Path | None = None,
    progress: Callable[[str, float], None] | None = None,
) -> Result:
    """Identify the damper of a dataset folder and validate it on all records.

    Args:
        path: a folder with dataset.toml and its records, or that file.
        method: de searches all parameters together; pso (the paper's) first takes the paper's steps.
        budget: PAPER, QUICK or a Budget: how long to search.
        seed: of all random numbers.
        journal: a folder that makes a killed run resumable.
        progress: called with the step's title and its error after each generation.

    Raises DataError with all defects of the records, and InputError where they do not suffice.

    """
    dataset = load_dataset(path)
    return identify_dataset(dataset, method=method, budget=budget, seed=seed, journal=journal, progress=progress)


def identify_dataset(
    dataset: LoadedDataset,
    *,
    method: str = DEFAULT,
    budget: Budget = PAPER,
    seed: int = 1,
    journal: Path | None = None,
    progress: Callable[[str, float], None] | None = None,
) -> Result:
    """Identify the dataset's damper from its records for fitting and validate it on all; raises InputError.

    Freed gas does what it does in the given damper.
    """
    require_known(dataset)
    slow = [r for r in dataset.records if r.measurement == "quasi-static"]
    drives = [r for r in dataset.records if r.measurement == "stochastic"]
    sines = [harmonic(r) for r in dataset.records if r.measurement == "harmonic"]
    if not sines:
        kinds = listed(sorted({r.measurement for r in dataset.records}))
        raise InputError(f"{dataset.title}: no harmonic record to identify from, only {kinds}")
    stated = {r.name: r.split for r in dataset.records}
    split, remarks = splits(sines, stated)
    remarks = unconfirmed(dataset.findings) + signs(dataset, sines) + remarks
    smoothed = averaging(sines)
    if smoothed is not None:
        sines = through(sines, smoothed)
        remarks.append(f"{smoothed.text}; the model is passed through an equal mean where sines are fitted and validated")
    fitted = [h for h, kind in zip(sines, split, strict=True) if kind == "fit"]
    if not fitted:
        raise InputError(f"{dataset.title}: all harmonic records are held out, none is left to identify from")
    pressure, whole, still, told = at_one_pressure(
        [h for h in fitted if h.intact], [r for r in slow if intact(r) and r.split != "heldout"]
    )
    remarks += told
    if whole:
        fitted_names = {h.name for h in whole} | {r.name for r in still}
        base, said = at_their_temperature(dataset.damper, (r for r in dataset.records if r.name in fitted_names))
        dataset, remarks = replace(dataset, damper=replace(base, gas_pressure=pressure)), remarks + said
    result = identify_damper(
        dataset.damper,
        next(map(loop, still), None),
        whole,
        [h for h in fitted if not h.intact],
        slow_lost=[(r.fill[0], loop(r)) for r in slow if not r.gas_preload and r.split != "heldout"],
        method=method, budget=budget, seed=seed, journal=journal, progress=progress,
    )  # fmt: skip
    measured = whole
    levels = sorted({h.oil_level for h in sines if not h.intact}, reverse=True)
    damper = replace(result.damper, measured_levels=tuple(levels))
    damper = with_origin(damper, dataset, result, method=method, seed=seed, fitted=len(fitted), top=reach(measured))
    result = replace(result, damper=damper)
    rows = [validate_harmonic(damper, h, kind, result.offset) for h, kind in zip(sines, split, strict=True)]
    result = replace(result, damper=damper)
    return Result(
        dataset, list(zip(sines, split, strict=True)), result, rows + validate_drives(damper, drives, result.offset),
        remarks + result.remarks + continuation(damper, measured) + noisy(damper, sines),
    )  # fmt: skip


def require_known(dataset: LoadedDataset) -> None:
    """Raise InputError where a record's fill is unknown: all of them are fitted or validated, in their state."""
    require_fills(
        dataset.records, "identify needs a stated fill: state it in dataset.toml, or let twintube diagnose find it"
    )


def loop(record: Record) -> tuple[Array, Array]:
    """Stroke [m] without its noise and force [N] of a quasi-static record."""
    return quiet(record.time, record.stroke), record.force


def splits(records: Sequence[Harmonic], stated: dict[str, str | None]) -> tuple[list[str], list[str]]:
    """`fit` or `heldout` for every record, and remarks on the choice."""
    if any(stated[r.name] for r in records):
        return [stated[r.name] or "fit" for r in records], []
    judged = [not r.intact for r in records]
    judged = judged if any(judged) else [True] * len(records)
    speeds = distinct((r.top_speed for r, counts in zip(records, judged, strict=True) if counts), EQUAL_SPEEDS)
    every, first = HELD_OUT
    held = [v for i, v in enumerate(speeds[:-2]) if len(speeds) >= ENOUGH and i % every == first]
    kinds = [
        "heldout" if counts and any(v <= r.top_speed <= EQUAL_SPEEDS * v for v in held) else "fit"
        for r, counts in zip(records, judged, strict=True)
    ]
    if len(records) == 1:
        return kinds, [SINGLE]
    if not held:
        count = "1 velocity" if len(speeds) == 1 else f"{len(speeds)} velocities"
        return kinds, [f"{count}, fewer than {ENOUGH}: no record is held out, the validation is of the fit"]
    velocities = ", ".join(f"{v:.3g}" for v in held)
    return kinds, [f"dataset.toml splits nothing: the records at {velocities} m/s are held out"]


def with_origin(
    damper: Damper, dataset: LoadedDataset, result: Identification, *, method: str, seed: int, fitted: int, top: float
) -> Damper:
    """The damper with where its values come from; its F-v curve was measured up to `top` [m/s]."""
    origin = f"identified from '{dataset.title}': {fitted} harmonic records"
    sources, assumed = dict(damper.sources), dict(damper.assumed)
    changed = [
        name
        for name in ("fv", "friction", "gas_spring")
        if parameters_of(damper, name) != parameters_of(dataset.damper, name)
    ]
    if result.steps:
        changed += ["degradation", "foam", "cavitation"]
    for group in changed:
        sources[group] = f"{origin}, {method}, seed {seed}" if group not in ("fv", "friction", "gas_spring") else origin
        if group == "fv":
            sources[group] += f"; measured up to {top:.3g} m/s, beyond by the last slope"
        known = parameters_of(dataset.damper, group)
        for key in [key for key in assumed if key.split(".")[0] == group]:
            name = key.partition(".")[2]
            if not name or parameters_of(damper, group).get(name) != known.get(name):
                del assumed[key]
    groups = {item.name: item.metadata["group"] for item in fields(type(damper.parameters))}
    for estimate in result.estimates:
        if not estimate.determined:
            group = groups[estimate.name]
            assumed[f"{group}.{estimate.name}"] = "not determined by the records it was identified from"
    return replace(damper, name=f"{damper.name}-identified", title=dataset.title, sources=sources, assumed=assumed)


def parameters_of(damper: Damper, group: str) -> dict[str, Any]:
    """The parameters of a group by name."""
    table = damper.parameters
    return {n: getattr(table, n) for n, f in type(table).__dataclass_fields__.items() if f.metadata["group"] == group}
