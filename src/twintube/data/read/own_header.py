"""The file's own header where dataset.toml names the columns in its place: it may say other units."""

import csv
import re
from collections.abc import Sequence

from twintube.data.convert.units import units_row
from twintube.data.read.blocks import is_numbers

NEAREST = 3  # rows over the numbers: names, units and a blank one


def texts_over(rows: Sequence[Sequence[str]], headers: Sequence[str]) -> dict[str, list[str]]:
    """By header of `columns`: what the last rows that are skipped hold over that column, units in square brackets.

    A row with fewer cells than columns is none of names; one with more has names without cells.
    """
    over: dict[str, list[str]] = {}
    for cells in rows[-NEAREST:]:
        if len(cells) < len(headers) or is_numbers(cells):
            continue
        units = units_row(cells)
        for header, cell, unit in zip(headers, cells, units or cells, strict=False):
            if header and cell.strip():
                over.setdefault(header, []).append(f"[{unit}]" if units else cell.strip())
    return over


def cells_of(line: str, delimiter: str, width: int) -> list[str]:
    """The cells of a row of names or units, without empty ones beyond the columns."""
    if delimiter == "whitespace":
        cells = line.split()
        return cells if len(cells) <= width else re.split(r"\s+(?![\[(])", " ".join(cells))  # `Time [s]` is a single name
    try:
        cells = next(csv.reader([line], delimiter=delimiter, skipinitialspace=True), [])
    except csv.Error:
        return []
    while len(cells) > width and not cells[-1].strip():
        cells.pop()
    return cells
