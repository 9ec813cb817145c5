"""The motion of a damper from a single file: what a simulation needs. Columns, units and formats are those of datasets."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from twintube.common.arrays import Array
from twintube.data.convert.quantities import convert
from twintube.data.findings import Finding, Notes, UnreadableError
from twintube.data.formats import Format
from twintube.data.read.columns import read_raw
from twintube.engine.simulate import InputError

NEEDED = ("time", "stroke")
MOST_MESSAGES = 5


@dataclass(frozen=True)
class Motion:
    """Arrays (n,), SI units; a missing velocity is the central difference of the stroke."""

    time: Array
    stroke: Array
    velocity: Array
    force: Array | None  # as in the file, whose sign nobody stated
    findings: tuple[Finding, ...] = ()  # warnings and remarks on how the file was read


def read_motion(path: Path) -> tuple[Array, Array, Array]:
    """Time [s], stroke [m] and velocity [m/s] of a file. Raises InputError with file, row and column, and OSError."""
    motion = read_moved(path)
    return motion.time, motion.stroke, motion.velocity


def read_moved(path: Path, block: int | None = None) -> Motion:
    """The motion in a file, or in a block of it, and its force where there is one.

    Raises InputError with file, row and column, and OSError.
    """
    notes = Notes(path.name)
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
    time, stroke = table.columns["time"], table.columns["stroke"]
    velocity = table.columns.get("velocity")
    velocity = np.gradient(stroke, time) if velocity is None else velocity
    return Motion(time, stroke, velocity, table.columns.get("force"), tuple(notes.findings))
