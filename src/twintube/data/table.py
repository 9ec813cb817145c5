"""From the columns of a file to quantities in SI units."""

import math
from dataclasses import dataclass
from tokenize import TokenError
from typing import Any

import numpy as np
from numpy.typing import NDArray

from twintube.arrays import Array
from twintube.dampers.damper import suggestion
from twintube.dampers.quantity import quantity, registry
from twintube.data.findings import Notes, more
from twintube.data.formats import Format, Raw

UNITS = {"time": "s", "stroke": "m", "force": "N", "velocity": "m/s", "temperature": "degC"}
EXAMPLES = {"time": "time [s]", "stroke": "stroke [mm]", "force": "force [N]"}  # these must be there


@dataclass(frozen=True)
class Table:
    """A record as read: NaN where a cell was no number."""

    columns: dict[str, Array]  # by quantity, (n,), SI units, temperature in degC
    headers: dict[str, str]  # by quantity
    rows: NDArray[np.int64]  # number in the file, (n,)


def split_header(header: str) -> tuple[str, str]:
    """Name and unit of `name [unit]`."""
    name, _, unit = header.strip().removesuffix("]").partition("[")
    return name.strip(), unit.strip()


def in_si(values: Array, name: str, unit: str) -> Array:
    """The values of a quantity in its unit of UNITS; raises ValueError."""
    if not unit:
        raise ValueError(f"no unit, must be like '{name} [{UNITS[name]}]'")
    try:
        if name == "temperature":
            return np.asarray(registry().Quantity(values, unit).to("degC").magnitude, dtype=float)
        return values * quantity(f"1 {unit}", UNITS[name])
    except Exception as error:  # pint raises many kinds on a text that is no unit
        if not isinstance(error, (ValueError, TokenError, AttributeError, TypeError, SyntaxError)):
            raise
        raise ValueError(f"unit {unit!r} is no unit of {name}, must be one like {UNITS[name]}") from error


def convert(raw: Raw, form: Format, notes: Notes) -> Table | None:
    """The quantities of a record, with findings on columns, units and cells; None if a needed column is missing."""
    notes.counted = raw.counted
    before = len(notes.findings)
    sources = chosen(raw, form, notes)
    columns: dict[str, Array] = {}
    headers: dict[str, str] = {}
    rows = np.asarray(raw.rows, dtype=np.int64)
    for name, (header, source) in sources.items():
        try:
            numbers = cells(raw.columns[source], header, rows, notes)
            if len(numbers) != len(rows):
                notes.error(f"{len(numbers)} samples where another column of the file has {len(rows)}", header)
                continue
            columns[name] = in_si(numbers, name, split_header(header)[1])
            headers[name] = header
            carried = raw.units.get(source)
            if carried and not same_unit(name, carried, split_header(header)[1]):
                notes.error(f"the file gives {source!r} in {carried}, not in {split_header(header)[1]}", header)
        except ValueError as error:
            notes.error(str(error), header)
    for name, example in EXAMPLES.items():
        if name not in columns and not (name in sources and len(notes.findings) > before):
            there = ", ".join(list(raw.columns)[:20]) or "nothing"
            hint = suggestion(name, [split_header(text)[0] for text in raw.columns])
            notes.error(f"no column {example!r} among {there}{hint}", name)
    if len(rows) < 2:
        notes.error(f"{len(rows)} samples, at least 2 are needed")
        return None
    return Table(columns, headers, rows) if set(EXAMPLES) <= set(columns) else None


def chosen(raw: Raw, form: Format, notes: Notes) -> dict[str, tuple[str, str]]:
    """By quantity: the header with its unit, and the name in the file."""
    if isinstance(form.columns, dict):
        pairs = list(form.columns.items())
    else:
        carried = {name: f"{name} [{unit}]" for name, unit in raw.units.items() if "[" not in name}
        pairs = [(carried.get(name, name), name) for name in raw.columns]
    found: dict[str, tuple[str, str]] = {}
    unused = []
    for header, source in pairs:
        name = split_header(header)[0]
        if source not in raw.columns:
            there = ", ".join(list(raw.columns)[:20])
            notes.error(f"the file has no {source!r} but {there}{suggestion(source, raw.columns)}", header)
        elif name not in UNITS:
            unused.append(header)
        elif name in found:
            notes.error(f"{name} is there already as {found[name][0]!r}", header)
        else:
            found[name] = header, source
    if unused and found and notes.counted == "row":
        notes.warning(f"not used: {', '.join(map(repr, unused))}; used are {', '.join(UNITS)}")
    return found


def same_unit(name: str, one: str, other: str) -> bool:
    """Whether two units of a quantity are the same."""
    probe = np.array([1.0, 2.0])
    try:
        return bool(np.allclose(in_si(probe, name, one), in_si(probe, name, other), rtol=1e-9, atol=0.0))
    except ValueError:
        return False


def cells(values: Any, header: str, rows: NDArray[np.int64], notes: Notes) -> Array:
    """Floats of a column; a finding on the cells that are none."""
    try:
        if notes.counted == "row" and "_" in "".join(values):
            raise ValueError  # numpy takes 1_000 for a number
        numbers: Array = np.asarray(values, dtype=float)
    except (ValueError, TypeError):
        numbers = np.array([number(cell) for cell in values], dtype=float)
    bad = np.flatnonzero(~np.isfinite(numbers))
    if len(bad):
        row = int(rows[bad[0]])
        text = f"{numbers[bad[0]]}" if isinstance(values, np.ndarray) else repr(values[bad[0]])
        what = "the cell is empty" if not text.strip("' ") or text == "None" else f"{text} is no finite number"
        notes.error(what + more(len(bad), int(rows[bad[-1]]), notes.counted), header, row)
    return numbers


def number(cell: Any) -> float:
    """A cell as float, NaN if it is none."""
    try:
        return math.nan if "_" in str(cell) else float(cell)
    except (ValueError, TypeError):
        return math.nan
