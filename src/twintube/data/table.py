"""From the columns of a file to quantities in SI units."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pint
from numpy.typing import NDArray

from twintube.arrays import Array
from twintube.dampers.damper import suggestion
from twintube.dampers.quantity import parsed, quantity, registry
from twintube.data.findings import Notes, more
from twintube.data.formats import Format, Raw
from twintube.words import listed, printable, shown

UNITS = {"time": "s", "stroke": "m", "force": "N", "velocity": "m/s", "temperature": "degC"}
EXAMPLES = {"time": "time [s]", "stroke": "stroke [mm]", "force": "force [N]"}


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
            return np.asarray(registry().Quantity(values, parsed(unit)).to("degC").magnitude, dtype=float)
        return values * quantity(f"1 {unit}", UNITS[name])
    except (ValueError, pint.PintError) as error:
        raise ValueError(f"unit {shown(unit)} is not a unit of {name}, must be one like {UNITS[name]}") from error


def convert(raw: Raw, form: Format, notes: Notes, needed: Sequence[str] = tuple(EXAMPLES)) -> Table | None:
    """The quantities of a record, with findings on columns, units and cells; None if a needed column is missing."""
    notes.counted = raw.counted
    before = len(notes.findings)
    sources = chosen(raw, form, notes)
    columns: dict[str, Array] = {}
    headers: dict[str, str] = {}
    rows = np.asarray(raw.rows, dtype=np.int64)
    for name, (header, source) in sources.items():
        try:
            numbers = cells(raw.columns[source], header, rows, form.decimal, notes)
            if len(numbers) != len(rows):
                notes.error(f"{len(numbers)} samples where another column of the file has {len(rows)}", header)
                continue
            columns[name] = in_si(numbers, name, split_header(header)[1])
            headers[name] = header
            carried, stated = raw.units.get(source), split_header(header)[1]
            if carried and not equal_units(name, carried, stated):
                notes.error(f"the file gives {shown(source)} in {printable(carried)}, not in {stated}", header)
        except ValueError as error:
            notes.error(str(error), header)
    for name in needed:
        if name not in columns and not (name in sources and len(notes.findings) > before):
            refused = next((header for header in raw.refused if split_header(header)[0] == name), None)
            if refused is not None:
                notes.error(f"holds {raw.refused[refused]}, must hold numbers", refused)
                continue
            there = listed(map(printable, raw.columns)) or "nothing"
            hint = suggestion(name, [split_header(text)[0] for text in raw.columns])
            notes.error(f"no column {EXAMPLES[name]!r} among {there}{hint}", name)
    if len(rows) < 2:
        notes.error(f"{len(rows)} samples, at least 2 are needed")
        return None
    return Table(columns, headers, rows) if set(needed) <= set(columns) else None


def chosen(raw: Raw, form: Format, notes: Notes) -> dict[str, tuple[str, str]]:
    """By quantity: the header with its unit, and the name in the file."""
    if isinstance(form.columns, dict):
        pairs = list(form.columns.items())
    else:
        carried = {name: f"{name} [{unit}]" for name, unit in raw.units.items() if "[" not in name}
        pairs = [(carried.get(name, name), name) for name in raw.columns]
    sources: dict[str, tuple[str, str]] = {}
    unused = []
    for header, source in pairs:
        name = split_header(header)[0]
        if source in raw.refused:
            notes.error(f"{shown(source)} holds {raw.refused[source]}, must hold numbers", header)
        elif source not in raw.columns:
            there = listed(map(printable, raw.columns))
            notes.error(f"the file has no {shown(source)} but {there}{suggestion(source, raw.columns)}", header)
        elif name not in UNITS:
            unused.append(shown(header))
        elif name in sources:
            notes.error(f"{name} is there already as {shown(sources[name][0])}", header)
        else:
            sources[name] = header, source
    if unused and sources and notes.counted == "row":
        notes.warning(f"not used: {listed(unused)}; used are {', '.join(UNITS)}")
    return sources


def equal_units(name: str, unit: str, other: str) -> bool:
    """Whether two units of a quantity are equal."""
    probe = np.array([1.0, 2.0])
    try:
        return bool(np.allclose(in_si(probe, name, unit), in_si(probe, name, other), rtol=1e-9, atol=0.0))
    except ValueError:
        return False


def cells(values: Any, header: str, rows: NDArray[np.int64], decimal: str, notes: Notes) -> Array:
    """Floats of a column; a finding on the cells that are not numbers."""
    try:
        if notes.counted == "row":
            text = "".join(values)
            if "_" in text or (decimal == "," and "." in text):
                raise ValueError  # numpy takes 1_000 for a number, and the point would be a thousands separator
            values_read = [cell.replace(",", ".") for cell in values] if decimal == "," else values
        else:
            values_read = values
        numbers: Array = np.asarray(values_read, dtype=float)
    except (ValueError, TypeError, OverflowError):
        numbers = np.array([number(cell, decimal) for cell in values], dtype=float)
    bad = np.flatnonzero(~np.isfinite(numbers))
    if len(bad):
        row = int(rows[min(bad[0], len(rows) - 1)])
        cell = numbers[bad[0]] if isinstance(values, np.ndarray) else values[bad[0]]
        notes.error(
            wrong_cell(cell, decimal) + more(len(bad), int(rows[min(bad[-1], len(rows) - 1)]), notes.counted), header, row
        )
    return numbers


def wrong_cell(cell: Any, decimal: str) -> str:
    """What is wrong with a cell that is not a number."""
    if cell is None or (isinstance(cell, str) and not cell.strip()):
        return "the cell is empty"
    text = shown(cell) if isinstance(cell, str) else f"{cell}"
    if isinstance(cell, str) and decimal == "," and math.isfinite(number(cell.replace(",", ""), ".")):
        return f"{text} holds a point where decimal is ',': numbers must have no thousands separator and one decimal sign"
    if isinstance(cell, str) and decimal == "." and math.isfinite(number(cell, ",")):
        return f"{text} is not a finite number: set decimal = ','?"
    return f"{text} is not a finite number"


def number(cell: Any, decimal: str) -> float:
    """A cell as float, NaN if it is not a number."""
    if isinstance(cell, str):
        if "_" in cell or (decimal == "," and "." in cell):
            return math.nan
        cell = cell.replace(",", ".") if decimal == "," else cell
    try:
        return float(cell)
    except (ValueError, TypeError, OverflowError):
        return math.nan
