"""A record of a dataset: what was measured, and how a file becomes one."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array, freeze_arrays
from twintube.common.words import listed
from twintube.core.checks import tube_limit
from twintube.dampers import Damper
from twintube.data.check.column_claims import check_names
from twintube.data.check.quality import check_quality, within
from twintube.data.check.reference import check_part
from twintube.data.check.values import check, computed
from twintube.data.convert.quantities import Table, convert
from twintube.data.dataset_toml.manifest import Entry
from twintube.data.findings import Finding, Notes, UnreadableError
from twintube.data.read.columns import Outcome
from twintube.data.sniff.hints import LACKS, suggest_columns
from twintube.engine.simulate import InputError

MEASURED = "measured"
GIVEN = "given, but recomputable from the stroke"
GRADIENT = "central difference of the stroke over its actual times (numpy.gradient)"
FILL = ("oil_level", "gas_preload")
# What dataset.toml says of a record in the same words
STATED = (*FILL, "measurement", "start_temperature", "split", "setting", "gas_pressure", "reference", "reference_window")
ALL: NDArray[np.bool_] = np.ones(0, dtype=bool)  # every sample of a record is usable
ALL.flags.writeable = False


@dataclass(frozen=True)
class Record:
    """One measurement; all arrays (n,), SI units but temperatures in degC; stroke and force positive in rebound."""

    name: str  # the file without its ending and, where it holds several records, what of it this one is
    file: str  # as dataset.toml names it, with the same addition
    measurement: str  # quasi-static, harmonic or stochastic
    oil_level: float | None  # share of the intact oil volume; None: unknown
    gas_preload: float | None  # share [1], true and false where it is there or lost; None: unknown
    start_temperature: float | None  # [degC]
    split: str | None  # fit, heldout or not said
    time: Array
    stroke: Array
    force: Array
    velocity: Array
    velocity_source: str  # MEASURED, GIVEN or GRADIENT
    temperature: Array | None  # [degC], measured along the record, or its `temperature_degC` at each sample
    findings: tuple[Finding, ...]
    setting: str | None = None  # of an adjustable valve, in the words of dataset.toml
    gas_pressure: float | None = None  # gauge, cold [Pa]
    usable: NDArray[np.bool_] = field(default_factory=lambda: ALL)  # False: excluded, dropped out, frozen or clipped
    state: str = ""  # records of one filling share it: the label in dataset.toml, or one made for them
    reference: bool = False  # the damper as it was on this bench
    reference_window: tuple[float, float] | None = None  # [s] of `time`: the part that is a reference, the rest is not

    def __post_init__(self) -> None:
        """Shared by all who read it."""
        if self.usable is ALL:
            object.__setattr__(self, "usable", np.ones(len(self.time), dtype=bool))
        freeze_arrays(self)

    @property
    def unknown(self) -> list[str]:
        """The keys of its fill that nobody knows."""
        return [key for key in FILL if getattr(self, key) is None]

    @property
    def fill(self) -> tuple[float, float]:
        """Its oil level [1] and share of the gas preload [1]; raises InputError where one is unknown."""
        if self.oil_level is None or self.gas_preload is None:
            raise InputError(not_stated([self], "state the fill in dataset.toml"))
        return self.oil_level, self.gas_preload

    @property
    def in_reference(self) -> NDArray[np.bool_]:
        """The samples (n,) that show the damper as it was."""
        if self.reference_window is not None:
            return within(self.time, [self.reference_window])
        return np.full(len(self.time), self.reference)


class UnknownFillError(InputError):
    """A fill that nobody knows stands where a known one is needed."""


def has_reference(records: Iterable[Record]) -> bool:
    """Whether some records, or parts of them, show the damper as it was, and others do not."""
    some = list(records)
    return any(r.reference or r.reference_window for r in some) and not all(r.reference for r in some)


def require_fills(records: Iterable[Record], remedy: str) -> None:
    """Raise UnknownFillError, which names the records whose fill is unknown and the remedy, where there are such."""
    unknown = [record for record in records if record.unknown]
    if unknown:
        raise UnknownFillError(not_stated(unknown, remedy))


def not_stated(unknown: Sequence[Record], remedy: str) -> str:
    """A message about records of an unknown fill."""
    keys = [key for key in FILL if any(key in record.unknown for record in unknown)]
    files = listed((record.file for record in unknown), 5)
    what = f"{' and '.join(keys)} {'is' if len(keys) == 1 else 'are'} unknown"
    return f"record{'s' * (len(unknown) > 1)} {files}: {what}; {remedy}"


def read_record(entry: Entry, outcome: Outcome | None, damper: Damper | None, notes: Notes, own: Notes) -> Record | None:
    """Check a record that was read; None if it has an error. `notes` takes findings on dataset.toml, `own` on the file."""
    limit = None if damper is None else tube_limit(damper.parameters)
    if outcome is None:
        return None
    if isinstance(outcome, UnreadableError):
        own.counted = "row"
        own.error(str(outcome), row=outcome.row)
        return None
    if isinstance(outcome, OSError):
        own.error(f"cannot be read: {outcome.strerror or outcome}")
        return None
    table = convert(outcome, entry.form, own, window=entry.window)
    if table is None:
        if any(finding.message.startswith(LACKS) for finding in own.findings):
            suggest_columns(outcome, entry.form, own)
        return None
    check_names(outcome, entry.form, table.headers, own)
    table = turned(table, entry)
    check(table, limit, own)
    excluded = within(table.columns["time"], entry.excluded)
    usable = check_quality(table, excluded, own)
    if own.failed or not entry.complete or not check_part(entry, table.columns["time"], usable, notes):
        return None
    return Record(
        name=Path(entry.file).stem + entry.label.removeprefix(entry.file),
        file=entry.label,
        **{key: getattr(entry, key) for key in STATED},
        **samples(table),
        temperature=temperature(table, entry, own),
        findings=tuple(own.findings),
        usable=usable,
        state=entry.state or "",
    )


def samples(table: Table) -> dict[str, Any]:
    """The arrays of a record, by its fields."""
    velocity, source = velocity_of(table.columns)
    given = {name: table.columns[name] for name in ("time", "stroke", "force")}
    return given | {"velocity": velocity, "velocity_source": source}


def velocity_of(columns: Mapping[str, Array]) -> tuple[Array, str]:
    """The velocity (n,) [m/s] of columns by name, from the stroke where there is none, and its source."""
    time, stroke, velocity = columns["time"], columns["stroke"], columns.get("velocity")
    if velocity is None:
        return np.gradient(stroke, time), GRADIENT
    return velocity, GIVEN if computed(time, stroke, velocity) else MEASURED


def turned(table: Table, entry: Entry) -> Table:
    """The signs and the zero that dataset.toml states; nothing else is ever changed."""
    columns = dict(table.columns)
    columns["force"] = columns["force"] * entry.force_sign
    columns["stroke"] = columns["stroke"] * entry.stroke_sign + entry.stroke_offset
    if "velocity" in columns:
        columns["velocity"] = columns["velocity"] * entry.stroke_sign
    return replace(table, columns=columns)


def temperature(table: Table, entry: Entry, notes: Notes) -> Array | None:
    """Along the record (n,) [degC]: as measured, else the one that dataset.toml gives."""
    measured = table.columns.get("temperature")
    if entry.temperature is None:
        return measured
    if measured is not None:
        message = f"temperature_degC = {entry.temperature:g} of dataset.toml is not used: the file has its temperatures"
        notes.warning(message, table.headers["temperature"])
        return measured
    return np.full(len(table.rows), float(entry.temperature))
