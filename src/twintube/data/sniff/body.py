"""Which of the first rows are the body of a table: the run of rows that a way to cut them turns into most numbers.

A row counts by the share of its written cells that are numbers or times, and against the run where it holds too few or has
a text in a column of numbers. Empty cells count for nothing, wherever they are. A row of names over numbers begins anew.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from twintube.data.convert.stamps import is_stamp
from twintube.data.convert.units import units_row
from twintube.data.read.blocks import are_names
from twintube.data.sniff.values import GROUPED, NUMBER

PLAIN_FIRST = 0.999  # of a score: of two ways that serve alike the one without thousands separators
LEAST = 2  # numbers in a row of a table


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
