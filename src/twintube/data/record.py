"""A record of a dataset: what was measured, and how a file becomes one."""

from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from twintube.arrays import Array, freeze_arrays
from twintube.core.checks import tube_limit
from twintube.dampers import Damper
from twintube.data.checks import check, computed
from twintube.data.column_claims import check_names
from twintube.data.findings import Finding, Notes, UnreadableError
from twintube.data.hints import suggest_columns
from twintube.data.manifest import Entry
from twintube.data.quality import check_quality, within
from twintube.data.raw import Outcome
from twintube.data.table import Table, convert

MEASURED = "measured"
GIVEN = "given, but recomputable from the stroke"
GRADIENT = "central difference of the stroke over its actual times (numpy.gradient)"
ALL: NDArray[np.bool_] = np.ones(0, dtype=bool)  # every sample of a record is usable
ALL.flags.writeable = False


@dataclass(frozen=True)
class Record:
    """One measurement; all arrays (n,), SI units but temperatures in degC; stroke and force positive in rebound."""

    name: str  # the file without its ending and, where it holds several records, what of it this one is
    file: str  # as dataset.toml names it, with the same addition
    measurement: str  # quasi-static, harmonic or stochastic
    oil_level: float  # share of the intact oil volume
    gas_preload: bool
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

    def __post_init__(self) -> None:
        """Shared by all who read it."""
        if self.usable is ALL:
            object.__setattr__(self, "usable", np.ones(len(self.time), dtype=bool))
        freeze_arrays(self)


def read_record(entry: Entry, outcome: Outcome | None, damper: Damper | None, notes: Notes, own: Notes) -> Record | None:
    """Check a record that was read; None if it has an error. `notes` takes findings on dataset.toml, `own` on the file."""
    limit, level = None, entry.oil_level
    if damper is not None:
        if level is None and entry.oil_volume is not None:
            level = entry.oil_volume / damper.parameters.V_oil
            if level > 1.0:
                most = damper.parameters.V_oil * 1e6
                message = f"{entry.where}oil_volume_mL = {entry.oil_volume * 1e6:g}: must be from 0 to {most:g} mL"
                notes.error(message + f", the intact volume of {damper.name}", "oil_volume_mL", entry.line)
                entry = replace(entry, complete=False)
        limit = tube_limit(damper.parameters)
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
        if any(finding.message.startswith(("no column", "no unit")) for finding in own.findings):
            suggest_columns(outcome, entry.form, own)
        return None
    check_names(outcome, entry.form, table.headers, own)
    table = turned(table, entry)
    check(table, limit, own)
    excluded = within(table.columns["time"], entry.excluded)
    usable = check_quality(table, excluded, own)
    if own.failed or not entry.complete or level is None:
        return None
    c = table.columns
    velocity, source = c.get("velocity"), MEASURED
    if velocity is None:
        velocity, source = np.gradient(c["stroke"], c["time"]), GRADIENT
    elif computed(c["time"], c["stroke"], velocity):
        source = GIVEN
    return Record(
        name=Path(entry.file).stem + entry.label.removeprefix(entry.file),
        file=entry.label,
        measurement=entry.measurement,
        oil_level=level,
        gas_preload=entry.gas_preload,
        start_temperature=entry.start_temperature,
        split=entry.split,
        time=c["time"],
        stroke=c["stroke"],
        force=c["force"],
        velocity=velocity,
        velocity_source=source,
        temperature=temperature(table, entry, own),
        findings=tuple(own.findings),
        setting=entry.setting,
        gas_pressure=entry.gas_pressure,
        usable=usable,
    )


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
