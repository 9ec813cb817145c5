"""The names and units over the body of a table: of all readings of the rows over it the one that explains most columns.

Runs of a test may stand side by side in a table, each with columns of its own.
"""

import re
from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

from twintube.data.convert.column_names import NAMED, likeness
from twintube.data.convert.units import name_and_unit, units_row
from twintube.data.read.tables import single_names
from twintube.data.sniff.grids import Body, is_number

HEAD = 8  # rows over the body in which its names must be
COUNTED = re.compile(r"[\s_#.-]*(\d+|\b[A-Z])$")  # how `Stroke 1` and `Stroke B` end
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


def side_by_side(names: Names, held: Sequence[int]) -> list[list[int]]:
    """The columns of each run; all columns where there is one run.

    There are several where stroke and force come as often, one after the other, under names that only a number or a letter
    tells apart. The time is theirs or, where it comes once, that of all.
    """
    told = {i: quantity for i in held for quantity, score in [likeness(*names.pair(i))] if score >= NAMED}
    counts = Counter(told.values())
    runs = counts["stroke"]
    own = [quantity for quantity in ("time", "stroke", "force") if counts[quantity] == runs]
    if runs < 2 or "force" not in own or (counts["time"] != 1 and "time" not in own):
        return [list(held)]
    first = next(quantity for quantity in told.values() if quantity in own)
    starts = [i for i, quantity in told.items() if quantity == first]
    common = [i for i in held if i < starts[0]]
    parts = [[i for i in held if start <= i < end] for start, end in zip(starts, [*starts[1:], max(held) + 1], strict=True)]
    alike = {frozenset((told[i], COUNTED.sub("", names.pair(i)[0])) for i in part if told.get(i) in own) for part in parts}
    several = len(alike) == 1 and {quantity for quantity, _ in next(iter(alike))} == set(own)
    return [common + part for part in parts] if several else [list(held)]
