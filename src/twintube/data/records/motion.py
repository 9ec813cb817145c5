"""A single file that no dataset.toml names, read as those of datasets: a motion to simulate, or a record to compare with."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from twintube.common.arrays import Array
from twintube.data.check.quality import check_quality
from twintube.data.convert.quantities import Table, convert
from twintube.data.findings import Finding, Notes, UnreadableError
from twintube.data.formats import Format
from twintube.data.read.columns import read_raw
from twintube.data.records.record import Record, samples, velocity_of
from twintube.data.sniff.values import kind_of
from twintube.engine.simulate import InputError

NEEDED = ("time", "stroke")
MOST_MESSAGES = 5


@dataclass(frozen=True)
class Motion:
    """Arrays (n,), SI units but temperatures in degC; a missing velocity is the central difference of the stroke."""

    time: Array
    stroke: Array
    velocity: Array
    temperature: Array | None = None


def read_motion(path: Path) -> tuple[Array, Array, Array]:
    """Time [s], stroke [m] and velocity [m/s] of a file. Raises InputError with file, row and column, and OSError."""
    columns = read_table(path, Notes(path.name)).columns
    return columns["time"], columns["stroke"], velocity_of(columns)[0]


def read_moved(path: Path, fill: tuple[float, float], block: int | None = None) -> tuple[Motion | Record, list[Finding]]:
    """What is in a file, or in a block of it, and findings on how it was read: a record where it holds a force.

    The record is of a damper with the `fill`, oil level [1] and preload; its kind is judged by its motion. The signs are as
    in the file. Raises InputError with file, row and column, and OSError.
    """
    notes = Notes(path.name)
    table = read_table(path, notes, block)
    time, stroke, temperature = table.columns["time"], table.columns["stroke"], table.columns.get("temperature")
    if "force" not in table.columns:
        return Motion(time, stroke, velocity_of(table.columns)[0], temperature), notes.findings
    kind = kind_of(time, stroke) or "stochastic"
    notes.remark(f"taken as {kind}, judged by the speed and the turning points of the stroke")
    usable = check_quality(table, np.zeros(len(time), dtype=bool), notes)
    record = Record(
        name=path.stem,
        file=path.name,
        measurement=kind,
        oil_level=fill[0],
        gas_preload=fill[1],
        start_temperature=None,
        split=None,
        **samples(table),
        temperature=temperature,
        findings=(),
        usable=usable,
    )
    return record, notes.findings


def read_table(path: Path, notes: Notes, block: int | None = None) -> Table:
    """The quantities in a file; raises InputError with file, row and column, and OSError."""
    form = Format(block=block)
    try:
        table = convert(read_raw(path, form), form, notes, NEEDED)
    except UnreadableError as error:
        notes.error(str(error), row=error.row)
        table = None
    if table is not None:
        late = np.flatnonzero(np.diff(table.columns["time"]) <= 0)
        for i in late[:1]:
            time = table.columns["time"][i + 1]
            notes.error(f"{time:g} s is not after the row before", table.headers["time"], int(table.rows[i + 1]))
    errors = [finding for finding in notes.findings if finding.severity == "error"]
    if errors or table is None:
        rest = len(errors) - MOST_MESSAGES
        text = "; ".join(finding.text for finding in errors[:MOST_MESSAGES])
        raise InputError(f"{path.name}: {text}" + (f"; and {rest} more" if rest > 0 else ""))
    return table
