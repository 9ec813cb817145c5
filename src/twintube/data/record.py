"""Records as CSV files with headers `name [unit]`: `time [s]`, `stroke [mm]`, optional `velocity [mm/s]`."""

import csv
import math
from pathlib import Path

import numpy as np

from twintube.arrays import Array
from twintube.dampers.quantity import quantity
from twintube.engine.simulate import InputError

UNITS = {"time": "s", "stroke": "m", "velocity": "m/s"}


def read_csv(path: Path) -> tuple[Array, Array, Array]:
    """Time [s], stroke [m] and velocity [m/s] of a record; a missing velocity is the central difference of the stroke.

    Raises InputError with file, row and column, and OSError.
    """
    with path.open(newline="", encoding="utf-8-sig") as file:
        rows = list(csv.reader(file))
    if not rows:
        raise InputError(f"{path.name}: the file is empty")
    columns: dict[str, tuple[int, float]] = {}
    for i, header in enumerate(rows[0]):
        name, _, unit = header.strip().rstrip("]").partition(" [")
        if name in UNITS:
            try:
                columns[name] = (i, quantity(f"1 {unit}", UNITS[name]))
            except ValueError as error:
                raise InputError(f"{path.name}: row 1, column {header!r}: {error}") from error
    for name in ("time", "stroke"):
        if name not in columns:
            raise InputError(f"{path.name}: row 1: no column '{name} [{UNITS[name]}]' among {', '.join(rows[0])}")
    values: dict[str, list[float]] = {name: [] for name in columns}
    for number, row in enumerate(rows[1:], start=2):
        for name, (i, scale) in columns.items():
            try:
                value = float(row[i]) * scale
            except (ValueError, IndexError):
                value = math.nan
            if not math.isfinite(value):
                cell = row[i] if i < len(row) else "nothing"
                raise InputError(f"{path.name}: row {number}, column {name}: {cell!r} is no finite number")
            values[name].append(value)
    time, stroke = np.array(values["time"]), np.array(values["stroke"])
    if len(time) < 2:
        raise InputError(f"{path.name}: {len(time)} samples, at least 2 are needed")
    late = np.flatnonzero(np.diff(time) <= 0)
    if len(late):
        raise InputError(f"{path.name}: row {late[0] + 3}, column time: {time[late[0] + 1]:g} s is not after the row before")
    velocity = np.array(values["velocity"]) if "velocity" in values else np.gradient(stroke, time)
    return time, stroke, velocity
