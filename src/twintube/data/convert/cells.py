"""Cells as numbers."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array
from twintube.common.words import shown
from twintube.data.convert.grouping import one_space, parted, ungrouped
from twintube.data.findings import Notes, more
from twintube.data.formats import EMPTY


def cells(values: Any, header: str, rows: NDArray[np.int64], decimal: str, notes: Notes, *, empty: str = EMPTY) -> Array:
    """Floats (n,) of a column; a finding on the cells that are not numbers."""
    written = any(isinstance(cell, str) for cell in values[:1])
    try:
        numbers = np.asarray(plain(values, header, rows, decimal, notes) if written else values, dtype=float)
    except (ValueError, TypeError, OverflowError):
        numbers = np.array([number(cell, decimal) for cell in values], dtype=float)
    bad = np.flatnonzero(~np.isfinite(numbers))
    if len(bad):
        row = int(rows[min(bad[0], len(rows) - 1)])
        cell = numbers[bad[0]] if isinstance(values, np.ndarray) else values[bad[0]]
        tail = more(len(bad), int(rows[min(bad[-1], len(rows) - 1)]), notes.counted)
        notes.error(wrong_cell(cell, decimal, empty) + tail, header, row)
    return numbers


def slow_cells(values: Any, header: str, rows: NDArray[np.int64], decimal: str, notes: Notes) -> Array:
    """Floats (n,) of a channel that some loggers write in few rows: between its cells it is a straight line."""
    written = np.array([cell is not None and not (isinstance(cell, str) and not cell.strip()) for cell in values])
    at = np.flatnonzero(written)
    if len(at) in (0, len(values)):
        return cells(values, header, rows, decimal, notes)
    notes.remark(f"a value in {len(at)} of {len(values)} {notes.counted}s; between them it is interpolated", header)
    return np.interp(np.arange(len(values)), at, cells([values[i] for i in at], header, rows[at], decimal, notes))


def plain(values: Sequence[str], header: str, rows: NDArray[np.int64], decimal: str, notes: Notes) -> Sequence[str]:
    """The cells with a point as decimal sign and no thousands separators; raises ValueError where they may be either."""
    text = "\n".join(values)
    if "_" in text:
        raise ValueError("numpy takes 1_000 for a number")
    if not text.isascii() or " " in text:
        values = [one_space(cell) for cell in values]
        text = "\n".join(values)
    if not text.isascii():
        raise ValueError("numpy takes full-width digits for numbers")
    for separator in parted(text, decimal):
        without = ungrouped(values, separator, decimal)
        if without is None:
            raise ValueError("a second kind of sign")
        first = without[1]
        read = without[0][first].replace(",", ".").strip()
        message = f"{shown(separator)} is read as a thousands separator: {shown(values[first].strip())} as {read}"
        notes.warning(message, header, int(rows[first]))
        values = without[0]
    return [cell.replace(",", ".") for cell in values] if decimal == "," else values


def wrong_cell(cell: Any, decimal: str, empty: str) -> str:
    """What is wrong with a cell that is not a number."""
    if cell is None or (isinstance(cell, str) and not cell.strip()):
        return empty
    text = shown(cell) if isinstance(cell, str) else f"{cell}"
    if isinstance(cell, str) and decimal == "," and math.isfinite(number(cell.replace(",", ""), ".")):
        return f"{text} holds a point where decimal is ',': numbers must have no thousands separator and one decimal sign"
    if isinstance(cell, str) and decimal == "." and math.isfinite(number(cell, ",")):
        return f"{text} is not a finite number: set decimal = ','?"
    return f"{text} is not a finite number"


def number(cell: Any, decimal: str) -> float:
    """A cell as float, NaN if it is not a number."""
    if isinstance(cell, str):
        if "_" in cell or (decimal == "," and "." in cell) or not cell.strip().isascii():
            return math.nan
        cell = cell.replace(",", ".") if decimal == "," else cell
    try:
        return float(cell)
    except (ValueError, TypeError, OverflowError):
        return math.nan
