"""Cells as numbers. Thousands separators are read where the cells of a column leave no doubt, and refused elsewhere."""

import math
import re
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array
from twintube.common.words import shown
from twintube.data.findings import Notes
from twintube.data.formats import EMPTY

SPACES = "\N{NO-BREAK SPACE}\N{FIGURE SPACE}\N{THIN SPACE}\N{NARROW NO-BREAK SPACE}"
SAME = str.maketrans(dict.fromkeys(SPACES, " ") | {"\N{RIGHT SINGLE QUOTATION MARK}": "'"})


def cells(values: Any, header: str, rows: NDArray[np.int64], decimal: str, notes: Notes, *, empty: str = EMPTY) -> Array:
    """Floats (n,) of a column; a finding on the cells that are not numbers."""
    written = any(isinstance(cell, str) for cell in values[:1])
    try:
        numbers = np.asarray(plain(values, header, rows, decimal, notes) if written else values, dtype=float)
    except (ValueError, TypeError, OverflowError):
        numbers = floats(values, decimal)
    bad = ~np.isfinite(numbers)
    if where := notes.places(bad, rows):
        cell = numbers[bad][0] if isinstance(values, np.ndarray) else values[int(np.argmax(bad))]
        notes.error(wrong_cell(cell, decimal, empty) + where.tail, header, where.first)
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


def floats(values: Iterable[Any], decimal: str) -> Array:
    """The cells (n,) as numbers, NaN where one is none."""
    return np.array([number(cell, decimal) for cell in values], dtype=float)


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


def one_space(cell: str) -> str:
    """The cell with one kind of space and of apostrophe, none at its ends."""
    return cell.translate(SAME).strip()


def parted(text: str, decimal: str) -> list[str]:
    """The signs in the cells that may part thousands."""
    return [sign for sign in (" ", "'", "," if decimal == "." else ".") if sign in text]


def ungrouped(cells: Sequence[str], separator: str, decimal: str) -> tuple[list[str], int] | None:
    """The cells without their thousands separators, and the number of the first that had one; None where in doubt.

    Every separator must part groups of three digits after a first one that does not begin with 0. A space or an apostrophe
    is no decimal sign. That a point or a comma is none is clear where no longer number is without and a cell holds both
    signs or several separators, or where the column has no decimal sign but whole numbers below 1000: `2.189` among
    `870` and `-45`, with decimal = ',' in dataset.toml.
    """
    groups = re.compile(
        rf"\s*[+-]?[1-9]\d{{0,2}}(?:{re.escape(separator)}\d{{3}})+(?:{re.escape(decimal)}\d*)?\s*", re.ASCII
    )
    grouped = [cell for cell in cells if separator in cell]
    if not grouped or not all(groups.fullmatch(cell) for cell in grouped):
        return None
    if separator in ",." and not thousands(cells, grouped, separator, decimal):
        return None
    first = next(i for i, cell in enumerate(cells) if separator in cell)
    return [cell.replace(separator, "") for cell in cells], first


def thousands(cells: Sequence[str], grouped: Sequence[str], separator: str, decimal: str) -> bool:
    """Whether a point or a comma in `grouped`, some of the cells, can only part thousands."""
    others = [cell for cell in cells if separator not in cell]
    if any(re.match(r"\s*[+-]?\d{4}", cell) for cell in others):
        return False
    both_signs = any(decimal in cell or cell.count(separator) > 1 for cell in grouped)
    whole = decimal == "," and not any(decimal in cell for cell in cells) and any(cell.strip() for cell in others)
    return both_signs or whole
