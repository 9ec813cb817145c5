"""Several tables in one text or sheet: where each begins, and how one is chosen.

A machine that goes on in the same file writes the names again, or only begins its time again. A block begins with a row of
names over rows of numbers, and what stands before the names belongs to it, too; or where the time is back at its first.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from twintube.data.convert.cells import floats
from twintube.data.convert.quantities import quantity_of
from twintube.data.convert.stamps import is_stamp
from twintube.data.convert.units import units_row
from twintube.data.findings import UnreadableError
from twintube.data.formats import Format

Row = tuple[int, list[str]]  # its number in the file, and its cells
FEWEST_ROWS = 3  # of numbers: what a record needs; a smaller table in a head is none
DIGITS = frozenset("0123456789")
FIRST = DIGITS | frozenset("+-.")  # how nearly all rows of numbers begin
NUMERIC = re.compile(r"\s*[+-]?[.,]?[0-9]|\s*[+-]?(nan|inf)", re.IGNORECASE)
NAMED = 8  # blocks whose rows a message names


def odd_rows(rows: Sequence[Row]) -> list[int]:
    """The places of the rows that do not begin like a number: the few that may be names, or blank."""
    return [i for i, (_, cells) in enumerate(rows) if not cells or cells[0][:1] not in FIRST]


@dataclass(frozen=True)
class Rows:
    """The rows of a table that hold something, and the others."""

    table: list[Row]
    blank: list[Row]
    starts: list[int]  # places in the table where blocks begin
    heads: list[int]  # by block: where its names are, which it may share with the block before


def ruled(rows: list[Row], form: Format) -> Rows:
    """Blank rows and blocks told apart."""
    odd = odd_rows(rows)
    blank = {i for i in odd if not filled(rows[i][1])}
    table = [row for i, row in enumerate(rows) if i not in blank] if blank else rows
    named = starts_of(table, odd_rows(table) if blank else odd)
    ends = [*named[1:], len(table)] if named else []
    starts = [(place, head) for head, end in zip(named, ends, strict=True) for place in restarts(table, head, end, form)]
    return Rows(table, [rows[i] for i in sorted(blank)], [place for place, _ in starts], [head for _, head in starts])


def starts_of(table: Sequence[Row], odd: Sequence[int]) -> list[int]:
    """The places in the table where blocks begin: rows of names, or the first row where it holds numbers already."""
    texts = (i for i in odd if not any(cell[:1] in DIGITS for cell in table[i][1]))
    starts = [i for i in texts if is_header(table, i)]
    if (not starts or starts[0] > 0) and are_numbers(table[:FEWEST_ROWS]):
        starts.insert(0, 0)
    return starts


def restarts(table: Sequence[Row], head: int, end: int, form: Format) -> list[int]:
    """The head of a block and the places where its time begins again, if that is so wherever it goes back."""
    names = table[head][1]
    at = None if form.sample_rate is not None else time_place(names, form)
    if at is None:
        return [head]
    first = head + head_rows(table, head)
    cells = [row[at] if at < len(row) else "" for _, row in table[first:end]]
    if any(map(is_stamp, cells[:1])):
        return [head]
    try:
        times = np.array([cell.replace(",", ".") for cell in cells] if form.decimal == "," else cells, dtype=float)
    except ValueError:
        times = floats(cells, form.decimal)
    steps = np.diff(times)
    if not (steps < 0).any() or not (steps > 0).any():
        return [head]
    back = np.flatnonzero(steps < 0) + 1
    last = np.minimum(back + FEWEST_ROWS - 1, len(times) - 1)
    goes_on = (last - back == FEWEST_ROWS - 1) & (times[last] < times[back - 1])  # a single wrong time begins nothing
    begins = goes_on & (times[back] <= times[0] + np.median(steps[steps > 0]) / 2)
    return [head, *(first + back).tolist()] if begins.all() else [head]


def time_place(names: Sequence[str], form: Format) -> int | None:
    """The place of the time in a row, as far as dataset.toml or the names tell."""
    if isinstance(form.columns, dict):
        wanted = next((column for header, column in form.columns.items() if quantity_of(header) == "time"), None)
        return next((i for i, name in enumerate(names) if name.strip() == wanted), None)
    return next((i for i, name in enumerate(form.columns or names) if quantity_of(name) == "time"), None)


def head_rows(table: Sequence[Row], head: int) -> int:
    """The number of rows of names and units where a block begins."""
    if is_numbers(table[head][1]):
        return 0
    return 2 if head + 1 < len(table) and units_row(table[head + 1][1]) is not None else 1


def is_header(table: Sequence[Row], i: int) -> bool:
    """Whether row `i` holds names, a row of units under them or not, and no more numbers than names under each other."""
    first = next((k for k in (i + 1, i + 2) if k < len(table) and is_numbers(table[k][1])), 0)
    if not first or (first == i + 2 and units_row(table[i + 1][1]) is None):
        return False
    names, body = filled(table[i][1]), table[first : first + FEWEST_ROWS]
    if not are_names(names) or not are_numbers(body):
        return False
    if any(len(filled(cells)) > len(names) for _, cells in body):
        return False
    return not (i > 0 and units_row(names) is not None and are_names(filled(table[i - 1][1])))  # the units of the row above


def are_numbers(rows: Sequence[Row]) -> bool:
    """Whether these are rows of numbers, and enough for a record."""
    return len(rows) == FEWEST_ROWS and all(is_numbers(cells) for _, cells in rows)


def are_names(texts: Sequence[str]) -> bool:
    """Whether the texts of a row differ and none begins like a number."""
    return len(set(texts)) >= 2 and not any(NUMERIC.match(text) for text in texts)


def is_numbers(cells: Sequence[str]) -> bool:
    """Whether a row holds more numbers or stamps than anything else, and at least two of them."""
    written = filled(cells)
    numbers = sum(NUMERIC.match(cell) is not None for cell in written)
    return numbers >= 2 and 2 * numbers > len(written)


def filled(cells: Sequence[str]) -> list[str]:
    """The cells that are not empty."""
    return [text for cell in cells if (text := cell.strip())]


def chosen(rows: Rows, block: int | None) -> list[Row]:
    """The rows of the block, counted from 1, from its names on; all rows where there is one. Raises UnreadableError."""
    table, starts = rows.table, rows.starts
    if block is None and len(starts) < 2:
        if starts and starts[0] > 0 and len(filled(table[0][1])) < len(filled(table[starts[0] + 1][1])):
            head, names = table[0][0], table[starts[0]][0]
            raise UnreadableError(f"row {head} is not that of the names, which is row {names}: set block = 1")
        return table
    if block is None or block > len(starts):
        raise UnreadableError(which([table[i][0] for i in starts], block))
    first, head = starts[block - 1], rows.heads[block - 1]
    over = table[head : head + head_rows(table, head)] if head < first else []
    if block == len(starts):
        return over + table[first:]
    last = starts[block]
    if rows.heads[block] == last:
        while last > first + 1 and foreign(table[last - 1][1], len(filled(table[first][1]))):
            last -= 1
    return over + table[first:last]


def foreign(cells: Sequence[str], width: int) -> bool:
    """Whether a row before the names of the next block is its head, and not the last of this block's rows."""
    written = filled(cells)
    return not NUMERIC.match(written[0]) and (len(written) != width or not is_numbers(cells))


def which(rows: Sequence[int], block: int | None) -> str:
    """The message that a block must be chosen, or that there is no such block; `rows` are those where the blocks begin."""
    if len(rows) < 2:
        return f"block = {block}: the file has {'one block' if rows else 'no table of numbers under names'}"
    named = ", ".join(map(str, rows[:NAMED])) + (", ..." if len(rows) > NAMED else "")
    given = "" if block is None else f"block = {block}: "
    return (
        f"{given}the file has {len(rows)} blocks, which begin in rows {named}: "
        f"set block, from 1 to {len(rows)}, in a [[record]] for each that is wanted"
    )
