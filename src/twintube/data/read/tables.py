"""Rows of cells, of a text or of a sheet, as columns by name: unconverted and unjudged.

Where dataset.toml names the columns in place of the file's own header, that is looked at, too: it may say other units.
"""

import csv
import re
from bisect import bisect_left
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from operator import itemgetter
from typing import Any

import numpy as np

from twintube.common.words import listed, shown
from twintube.data.convert.units import NUMBER, units_row
from twintube.data.findings import UnreadableError
from twintube.data.formats import MOST_COLUMNS, Format, Raw
from twintube.data.read.blocks import Row, Rows, chosen, is_numbers

DELIMITERS = {";": "';'", "\t": "'\\t'", ",": "','"}
NEAREST = 3  # rows over the numbers: names, units and a blank one
BLANKS = re.compile(r"[ \t\r\n\f\v]+")


def table_of(rows: Rows, form: Format, delimiter: str) -> Raw:
    """The columns of the block that `form` asks for; raises UnreadableError."""
    return with_blank(columns_of(chosen(rows, form.block), form, delimiter), rows)


def with_blank(raw: Raw, rows: Rows) -> Raw:
    """With the blank rows between the samples."""
    blank = rows.blank
    if not blank or not len(raw.rows):
        return raw
    first, last = (bisect_left(blank, raw.rows[i], key=itemgetter(0)) for i in (0, -1))
    between = blank[first:last]
    return replace(raw, blank=[number for number, _ in between], spaced=any(len(cells) > 1 for _, cells in between))


def columns_of(table: Sequence[Row], form: Format, delimiter: str) -> Raw:
    """The columns of one table; raises UnreadableError."""
    first, names = table[0]
    if isinstance(form.columns, list):
        headers = form.columns
        named = form.block is not None and not is_numbers(names)
    else:
        headers, named = [cell.strip() for cell in names], True
        check_header(table[0], delimiter, form.decimal)
    body = table[1:] if named else table
    if len(headers) > MOST_COLUMNS:
        raise UnreadableError(f"{len(headers)} columns, at most {MOST_COLUMNS} are read", first)
    for header, count in Counter(headers).items():
        if header and count > 1:
            hint = "" if headers is form.columns else ": set `columns`, the headers as a list, and skip_rows"
            raise UnreadableError(f"two columns are named {shown(header)}{hint}", first)
    units = units_row(body[0][1]) if body and named else None
    if units is not None:
        body = body[1:]
    width = len(headers)
    if headers is form.columns:
        own = [i for i, header in enumerate(headers) if header]
        last = (k for k in range(len(body), 0, -1) if any(cell.strip() for i in own for cell in body[k - 1][1][i : i + 1]))
        body = body[: next(last, 0)]  # the others are of a longer run beside this one
    rows = [cells for _, cells in body]
    widths = set(map(len, rows)) or {width}
    if widths != {width}:
        for number, cells in body:
            if len(cells) > width and any(cell.strip() for cell in cells[width:]):
                raise UnreadableError(wrong_width(cells, width, names, delimiter, form.decimal), number)
        # Missing cells are reported as empty ones.
        rows = [cells if len(cells) == width else (cells + [""] * width)[:width] for cells in rows]
    columns: dict[str, Any] = {header: [cells[i] for cells in rows] for i, header in enumerate(headers) if header}
    without = [header for header in headers[max(widths) :] if header]
    empty = [name for name, cells in columns.items() if name not in without and not any(map(str.strip, cells))]
    numbers = np.array([number for number, _ in body], dtype=np.int64)
    if headers is form.columns:
        # The block's own names and units, which the list replaces.
        over = texts_over([row + [""] * width for row in (names, units or []) if named], headers)
        return Raw(columns, numbers, "row", over=over, without=without, empty=empty)
    carried = {header: unit for header, unit in zip(headers, units or [], strict=False) if header and unit}
    return Raw(columns, numbers, "row", carried, without=without, empty=empty)


def check_header(row: tuple[int, list[str]], delimiter: str, decimal: str) -> None:
    """Raise UnreadableError where the header holds numbers, or all names in a single cell."""
    number, cells = row
    if all(NUMBER.fullmatch(cell) for cell in cells):
        text = listed(cells, 4)
        raise UnreadableError(f"numbers ({text}) where the header must be: set `columns`, the headers as a list", number)
    if len(cells) == 1 and (other := other_delimiter(cells[0], delimiter, decimal)):
        raise UnreadableError(f"a header of one column {shown(cells[0])}: {other}", number)


def wrong_width(cells: list[str], width: int, header: list[str], delimiter: str, decimal: str) -> str:
    """The message about a row with more cells than there are columns."""
    named = "1 column is" if width == 1 else f"{width} columns are"
    both = delimiter == "," and not any("." in cell for cell in cells)
    hint = other_delimiter(delimiter.join(header), delimiter, decimal) or (
        "is ',' both the delimiter and the decimal sign?"
        if both
        else "are the names in another row? set skip_rows, or `columns`, the headers as a list"
    )
    return f"{len(cells)} cells where {named} named; {hint}"


def other_delimiter(line: str, delimiter: str, decimal: str) -> str:
    """What to set where the line is rather split by another delimiter; empty where nothing says so."""
    counts = {sign: line.count(sign) for sign in DELIMITERS if sign not in (delimiter, decimal)}
    sign = max(counts, key=lambda sign: counts[sign])
    if not counts[sign]:
        return ""
    comma = " and, where numbers are written 1,5, decimal = ','" if sign != "," else ""
    return f"set delimiter = {DELIMITERS[sign]}{comma}"


def split(line: str, delimiter: str) -> list[str]:
    """The cells of a line; no-break and thin spaces part thousands, and no cells."""
    if delimiter == "whitespace":
        return line.split() if line.isascii() else [cell for cell in BLANKS.split(line) if cell]
    try:
        return next(csv.reader([line], delimiter=delimiter, skipinitialspace=True), [])
    except csv.Error:
        return []


def single_names(cells: list[str], width: int) -> list[str]:
    """The names of a row that is parted by spaces: `Time [s]` is a single one."""
    return cells if len(cells) <= width else re.split(r"\s+(?![\[(])", " ".join(cells))


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
