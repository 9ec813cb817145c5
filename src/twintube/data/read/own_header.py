"""The file's own header where dataset.toml names the columns in its place: it may say other units."""

import csv
import io
import re
from collections.abc import Sequence
from itertools import islice

from twintube.data.convert.units import NUMBER, units_row

NEAREST = 3  # rows over the numbers: names, units and a blank one


def texts_over(text: str, delimiter: str, skipped: int, headers: Sequence[str]) -> dict[str, list[str]]:
    """By header of `columns`: what the last rows that are skipped hold over that column, units in square brackets."""
    over: dict[str, list[str]] = {}
    width = len(headers)
    for line in list(islice(io.StringIO(text), skipped))[-NEAREST:]:
        cells = cells_of(line.rstrip("\r\n"), delimiter, width)
        if len(cells) != width or all(NUMBER.fullmatch(cell) for cell in cells):
            continue
        units = units_row(cells)
        for header, cell, unit in zip(headers, cells, units or cells, strict=True):
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
