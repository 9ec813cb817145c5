"""What the values of a text file's columns tell: which is the velocity, their units, sampling, kind of the measurement."""

import re
from collections import Counter
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from twintube.common.arrays import Array
from twintube.data.convert.cells import SPACES
from twintube.data.convert.quantities import UNITS, in_si
from twintube.data.convert.stamps import is_stamp, seconds
from twintube.data.convert.units import WEIGHTS

ALIKE = 0.15  # spread of the turning points of a harmonic record over their mean
FEWEST = 16  # samples of which a kind is told
SLOW = 5e-3  # [m/s] up to which a record is quasi-static; the paper's ramps have 1 mm/s
USUAL_STEP = 6e-3  # [s] in the middle of the steps of rigs, 0.2 ms to 0.2 s: the nearest unit is taken
TIMES = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "day": 86400.0}  # [s]; Excel counts days
COLDEST = 200.0  # [K] of a damper: what is above is no degC
PART = rf"(?<=\d)[ '’{SPACES}](?=\d{{3}}(?!\d))"  # between thousands
GROUPED = re.compile(PART, re.ASCII)
DIGITS = rf"(\d+|[1-9]\d{{0,2}}({PART}\d{{3}})+"
EXPONENT = r"([eE][+-]?\d+)?$"
NUMBER = {
    # 1,234 may be a decimal number, 1,234.5 and 1,234,567 not; with the other decimal sign 2.189 is a thousand.
    ".": re.compile(
        rf"[+-]?({DIGITS})(\.\d*)?|\.\d+|[1-9]\d{{0,2}}((,\d{{3}})+\.\d*|(,\d{{3}}){{2,}})){EXPONENT}", re.ASCII
    ),
    ",": re.compile(rf"[+-]?({DIGITS}|[1-9]\d{{0,2}}(\.\d{{3}})+)(,\d*)?|,\d+){EXPONENT}", re.ASCII),
}


@dataclass
class Sniffed:
    """What dataset.toml should say about a text file."""

    reading: dict[str, Any]  # keys of dataset.toml: columns, delimiter, decimal, encoding, skip_rows
    measurement: str = ""  # quasi-static, harmonic, stochastic or not known
    facts: list[str] = field(default_factory=list)  # what was seen
    doubts: list[str] = field(default_factory=list)  # what was guessed
    missing: list[str] = field(default_factory=list)  # what must be filled in


def judge(columns: dict[str, tuple[int, str]], body: list[list[str]], decimal: str, result: Sniffed) -> None:
    """Complete the units from the sizes of the values, and say sampling and kind of the measurement."""
    values = {name: column(body, i, decimal) for name, (i, _) in columns.items()}
    stamped = "time" in columns and np.isfinite(stamps := times(body, columns["time"][0])).any()
    known: dict[str, Array] = {}
    headers: dict[str, str] = {}
    for name, (_, stated) in columns.items():
        if name == "time" and stamped:
            known[name], headers[name] = stamps, "time"
            continue
        unit = stated or guessed(name, values[name])
        if not stated:
            result.doubts.append(f"{name}: the file gives no unit, {unit} is guessed from the size of the values")
        try:
            known[name] = in_si(values[name], name, unit)
        except ValueError:
            wrong, unit = unit, WEIGHTS.get(unit, "") if name == "force" else ""
            how = f"is a mass, {unit} is assumed"
            if not unit:
                unit = guessed(name, values[name])
                how = f"is not known here, {unit} is guessed from the size of the values"
            result.doubts.append(f"{name}: the unit {wrong!r} {how}")
            known[name] = in_si(values[name], name, unit)
        headers[name] = f"{name} [{unit}]"
    for name, or_else in (("time", "set `sample_rate_Hz`"), ("stroke", "`channels`"), ("force", "`channels`")):
        if name not in known:
            result.missing.append(f"{name}: no column looks like it; complete `columns`, or {or_else}")
    write_columns(columns, headers, result)
    if "time" in known:
        say_motion(known["time"], known.get("stroke"), result)


def say_motion(time: Array, stroke: Array | None, result: Sniffed) -> None:
    """Sampling and kind of the measurement."""
    steps = np.diff(time)
    steps = steps[np.isfinite(steps) & (steps > 0)]
    if len(steps):
        step = float(np.median(steps))
        result.facts.append(f"{len(time)} rows looked at, {1 / step:.4g} Hz, {len(time) * step:.4g} s")
    if stroke is not None:
        result.measurement = kind_of(time, stroke)


def write_columns(columns: dict[str, tuple[int, str]], headers: dict[str, str], result: Sniffed) -> None:
    """`columns` as dataset.toml wants it: left out, header = name in the file, or a list by position."""
    stated, by_place = result.reading["columns"], {i: headers[name] for name, (i, _) in columns.items()}
    if not isinstance(stated, dict):
        result.reading["columns"] = [by_place.get(i, "") for i in range(len(stated))]
        return
    result.reading["columns"] = {header: stated[i] for i, header in by_place.items()}
    if all(header == stated[i] for i, header in by_place.items()):
        del result.reading["columns"]


def cells_of(body: list[list[str]], i: int) -> list[str]:
    """The cells of a column."""
    return [row[i] if i < len(row) else "" for row in body]


def column(body: list[list[str]], i: int, decimal: str) -> Array:
    """The numbers of a column, NaN where a cell is not one."""
    parts = str.maketrans(dict.fromkeys([" ", "'", "’", *SPACES, "." if decimal == "," else ","], None))
    numbers = [
        cell.translate(parts).replace(",", ".") if NUMBER[decimal].match(cell) else "nan" for cell in cells_of(body, i)
    ]
    return np.array(numbers, dtype=float)


def times(body: list[list[str]], i: int) -> Array:
    """Seconds since the first stamp in a column, NaN where it holds none."""
    cells = cells_of(body, i)
    with suppress(ValueError):
        if any(map(is_stamp, cells[:1])):
            return seconds(cells)
    return np.full(len(cells), np.nan)


def guessed(name: str, values: Array) -> str:
    """The unit that makes the size of the values that of a damper on a bench."""
    finite = values[np.isfinite(values)]
    if len(finite) < 2:
        return EXPECTED_UNIT[name]
    span = float(np.ptp(finite))
    if name == "time":
        step = float(np.median(np.abs(np.diff(finite)))) or USUAL_STEP
        return min(TIMES, key=lambda unit: abs(np.log(step * TIMES[unit] / USUAL_STEP)))
    if name == "temperature":
        return "K" if float(np.median(finite)) > COLDEST else "degC"
    limit, small, large = {"stroke": (1.0, "m", "mm"), "force": (60.0, "kN", "N"), "velocity": (10.0, "m/s", "mm/s")}[name]
    return small if span < limit else large


def velocity_apart(columns: dict[str, tuple[int, str]], body: list[list[str]], decimal: str) -> dict[str, tuple[int, str]]:
    """The columns with force and velocity exchanged where the supposed force is more like the derivative of the stroke."""
    time, stroke, force, velocity = (
        column(body, columns[name][0], decimal) for name in ("time", "stroke", "force", "velocity")
    )
    sound = np.isfinite(time) & np.isfinite(stroke) & np.isfinite(force) & np.isfinite(velocity)
    if np.count_nonzero(sound) < 3 or (np.diff(time[sound]) <= 0).any():
        return columns
    derivative = np.gradient(stroke[sound], time[sound])
    like = [abs(correlation(derivative, values[sound])) for values in (force, velocity)]
    if like[0] <= like[1]:
        return columns
    (at, unit), (other, other_unit) = columns["force"], columns["velocity"]
    return columns | {"force": (other, unit), "velocity": (at, other_unit)}


def correlation(a: Array, b: Array) -> float:
    """Pearson's correlation coefficient, 0 where one of the rows does not change."""
    return float(np.corrcoef(a, b)[0, 1]) if np.ptp(a) > 0.0 and np.ptp(b) > 0.0 else 0.0


EXPECTED_UNIT = UNITS | {"stroke": "mm", "velocity": "mm/s"}


def kind_of(time: Array, stroke: Array) -> str:
    """The kind of a measurement by its speed and its turning points; "" where nothing moves."""
    sound = np.isfinite(time) & np.isfinite(stroke)
    time, stroke = time[sound], stroke[sound]
    rising = np.concatenate([[True], np.diff(np.maximum.accumulate(time)) > 0]) if len(time) else sound[:0]
    time, stroke = time[rising], stroke[rising]
    if len(time) < FEWEST or float(np.ptp(stroke)) == 0.0:
        return ""
    middle, half = (stroke.max() + stroke.min()) / 2, float(np.ptp(stroke)) / 2
    # Turning points between crossings of the middle, each by more than a tenth of the stroke.
    side = np.where(stroke > middle + 0.1 * half, 1, np.where(stroke < middle - 0.1 * half, -1, 0))
    moved = np.flatnonzero(side)
    parts = np.split(moved, np.flatnonzero(np.diff(side[moved])) + 1)
    turns = np.array([float(np.abs(stroke[part] - middle).max()) for part in parts])
    coarse = max(1, len(time) // 20000)
    speed = np.abs(np.gradient(stroke[::coarse], time[::coarse]))
    if float(np.quantile(speed, 0.9)) < SLOW:
        return "quasi-static"
    inner = turns[1:-1]
    common = Counter(np.round(inner / half / ALIKE).astype(int).tolist()).most_common(1)
    return "harmonic" if len(inner) >= 3 and common[0][1] >= 0.8 * len(inner) else "stochastic"
