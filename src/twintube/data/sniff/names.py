"""The names and units over the body of a table: of all readings of the rows over it the one that explains most columns."""

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

from twintube.data.convert.column_names import likeness
from twintube.data.convert.units import name_and_unit, units_row
from twintube.data.sniff.body import Body, is_number

HEAD = 8  # rows over the body in which its names must be
DEEPEST = 3  # rows that names may take, where cells are merged


@dataclass(frozen=True)
class Names:
    """A reading of the rows over a body."""

    texts: list[str]  # by column, empty where it has none
    units: list[str] | None  # by column, where they have a row of their own
    rows: list[int]  # that hold the names

    def pair(self, i: int) -> tuple[str, str]:
        """Name and unit of a column."""
        name, unit = name_and_unit(self.texts[i]) if i < len(self.texts) else ("", "")
        if self.units is not None and i < len(self.units) and self.units[i]:
            unit = name_and_unit(f"x [{self.units[i]}]")[1]
        return name, unit


def names_over(body: Body, numbers: Collection[int]) -> Names | None:
    """The names of the columns `numbers` of a body; None where it has none.

    A reading that tells fewer than two quantities must name all of these columns. Of two that explain as much the one that
    takes fewer rows counts, then the nearer one.
    """
    found = []
    for names in readings(body, max(numbers, default=0) + 1):
        named = sum(1 for i in numbers if i < len(names.texts) and names.texts[i])
        told: dict[str, float] = {}
        for i in numbers:
            quantity, score = likeness(*names.pair(i))
            told[quantity] = max(score, told.get(quantity, 0.0))
        if named >= max(2, len(numbers)) or sum(1 for score in told.values() if score) >= 2:
            units = sum(1 for i in numbers if names.pair(i)[1])
            found.append(((sum(told.values()), named + units, -len(names.rows), names.rows[-1]), names))
    return max(found, key=lambda item: item[0])[1] if found else None


def readings(body: Body, width: int) -> Iterator[Names]:
    """All readings of the rows over a body: which hold names, several where cells are merged, and which one units."""
    over = [i for i in range(body.first) if body.rows[i]][-HEAD:]
    cells = [single_names(body.rows[i], width) if body.delimiter == "whitespace" else body.rows[i] for i in over]
    units = [units_row(row) for row in cells]
    named = [not any(is_number(cell, body.decimal) for cell in row) for row in cells]
    for last in range(len(over)):
        for first in range(last, max(-1, last - DEEPEST), -1):
            if not named[first]:
                break
            texts, rows = merged(cells[first : last + 1]), over[first : last + 1]
            yield Names(texts, units[last + 1] if last + 1 < len(over) else None, rows)


def merged(rows: Sequence[Sequence[str]]) -> list[str]:
    """Each column's lowest text."""
    width = max(map(len, rows))
    return [next((row[i] for row in reversed(rows) if i < len(row) and row[i]), "") for i in range(width)]


def single_names(cells: list[str], width: int) -> list[str]:
    """The names of a row that is parted by spaces: `Time [s]` is a single one."""
    return cells if len(cells) <= width else re.split(r"\s+(?![\[(])", " ".join(cells))
