"""Rows that are looked at, the lines of a text or those of a sheet, and which of them are the body of a table.

The body is the run of rows that a way to cut them turns into most numbers. A row counts by the share of its written cells
that are numbers or times, and against the run where it holds too few or has a text in a column of numbers. Empty cells
count for nothing, wherever they are. A row of names over numbers begins anew.
"""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from twintube.data.convert.stamps import is_stamp
from twintube.data.convert.units import units_row
from twintube.data.read.blocks import are_names
from twintube.data.read.sheets import Cells, texts
from twintube.data.read.tables import split
from twintube.data.sniff.values import GROUPED, NUMBER

DELIMITERS = (";", "\t", ",", "|", "whitespace")  # in this order where two serve alike
BLANK = re.compile(r"[\s,;|]*")
MOST_QUOTED = 400  # lines in which quotes are looked for
LONGEST = 20_000  # characters of a row
PLAIN_FIRST = 0.999  # of a score: of two ways that serve alike the one without thousands separators
LEAST = 2  # numbers in a row of a table


@dataclass(frozen=True)
class Grid:
    """Lines of a text, or rows of a sheet, which has no delimiter."""

    rows: Sequence[str | Cells]
    usual: str = ""  # the delimiter where dataset.toml names none
    delimiters: Sequence[str] = ("",)

    @property
    def quoted(self) -> bool:
        """Whether quotes may keep a delimiter within a cell."""
        return any('"' in row for row in self.rows[:MOST_QUOTED] if isinstance(row, str))

    def blank(self, i: int) -> bool:
        """Whether a row holds nothing."""
        row = self.rows[i]
        return BLANK.fullmatch(row) is not None if isinstance(row, str) else all(cell is None for cell in row)

    def too_long(self, i: int) -> bool:
        """Whether a line is none of a table of channels; cells are bounded by the workbook."""
        row = self.rows[i]
        return isinstance(row, str) and len(row) > LONGEST

    def cells(self, numbers: Sequence[int], delimiter: str, decimal: str) -> list[list[str]]:
        """The cells of some rows as text, without empty ones at their end."""
        some = (self.rows[i] for i in numbers)
        return [trimmed(split(row, delimiter) if isinstance(row, str) else texts(row, decimal)) for row in some]


def trimmed(row: list[str]) -> list[str]:
    """The cells without blanks around them, and without empty ones at the end."""
    cells = [cell.strip() for cell in row]
    while cells and not cells[-1]:
        cells.pop()
    return cells


def cut(lines: Sequence[str], delimiter: str) -> list[list[str]]:
    """The cells of each line, without empty ones at its end."""
    return [trimmed(split(line, delimiter)) for line in lines]


@dataclass(frozen=True)
class Body:
    """Rows cut in one way, and where the numbers begin in them."""

    delimiter: str
    decimal: str
    rows: list[list[str]]
    first: int  # of the body
    usual: frozenset[int]  # columns that hold numbers in most rows
    score: float  # 0 where there is no table

    def takes(self, row: Sequence[str]) -> bool:
        """Whether a row has no text where the others have numbers."""
        return bool(row) and all(is_number(row[j], self.decimal) for j in self.usual if j < len(row) and row[j])

    @property
    def over(self) -> list[str]:
        """The row over the body."""
        return self.rows[self.first - 1] if self.first else []


def is_number(cell: str, decimal: str) -> bool:
    """Whether a cell holds a number or a time."""
    return NUMBER[decimal].match(cell) is not None or is_stamp(cell)


def body(rows: list[list[str]], delimiter: str, decimal: str) -> Body:
    """The body of rows that were cut in this way."""
    places = [[j for j, cell in enumerate(row) if cell and is_number(cell, decimal)] for row in rows]
    numeric = [at for at in places if len(at) >= LEAST]
    usual = {j for j, count in Counter(j for at in numeric for j in at).items() if 2 * count > len(numeric)}
    worth = [worth_of(row, at, usual) for row, at in zip(rows, places, strict=True)]
    if delimiter == "whitespace" and numeric:  # no cell is empty there: another number of them comes from another delimiter
        ((most, _),) = Counter(map(len, numeric)).most_common(1)
        worth = [value if len(at) == most else -1.0 for value, at in zip(worth, places, strict=True)]
    begin, run, first, score = 0, 0.0, 0, 0.0
    for i, value in enumerate(worth):
        if run <= 0.0 or (not places[i] and names_begin(rows, places, worth, i)):
            begin, run = i, 0.0
        run += value
        if run > score:
            first, score = begin, run
    while first > 0 and damaged(rows[first - 1], places[first - 1], usual):
        first -= 1
    if any(GROUPED.search(cell) for row in rows[first:] for cell in row):
        score *= PLAIN_FIRST
    return Body(delimiter, decimal, rows, first, frozenset(usual), score)


def worth_of(row: Sequence[str], numbers: Sequence[int], usual: set[int]) -> float:
    """What a row counts for in a body whose columns in `usual` hold numbers."""
    written = {j for j, cell in enumerate(row) if cell}
    if len(numbers) < LEAST or usual & (written - set(numbers)):
        return -1.0
    return len(numbers) / len(written)


def damaged(row: Sequence[str], numbers: Sequence[int], usual: set[int]) -> bool:
    """Whether a row over the body is one of it, for the checks to refuse: more numbers than texts in its columns."""
    written = {j for j in usual if j < len(row) and row[j]}
    return len(usual & set(numbers)) > len(written) / 2


def names_begin(rows: Sequence[list[str]], places: Sequence[Sequence[int]], worth: Sequence[float], i: int) -> bool:
    """Whether row `i`, which holds no number, is one of as many names as numbers below, a row of units between or not."""
    below = i + 1
    if below + 1 < len(rows) and units_row(rows[below]) is not None:
        below += 1
    names = [cell for cell in rows[i] if cell]
    return below < len(rows) and worth[below] > 0.0 and len(names) >= len(places[below]) and are_names(names)
