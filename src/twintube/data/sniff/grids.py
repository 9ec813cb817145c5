"""Where rows of cells come from: the lines of a text, which are cut by a delimiter, or a sheet of a workbook."""

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass

from twintube.data.read.sheets import Cells, texts
from twintube.data.read.text import split_white

DELIMITERS = (";", "\t", ",", "|", "whitespace")  # in this order where two serve alike
BLANK = re.compile(r"[\s,;|]*")
MOST_QUOTED = 400  # lines in which quotes are looked for
LONGEST = 20_000  # characters of a row


@dataclass(frozen=True)
class Lines:
    """The lines of a text."""

    lines: Sequence[str]
    usual: str  # the delimiter where dataset.toml names none
    delimiters: Sequence[str] = DELIMITERS

    def __len__(self) -> int:
        return len(self.lines)

    @property
    def quoted(self) -> bool:
        """Whether quotes may keep a delimiter within a cell."""
        return any('"' in line for line in self.lines[:MOST_QUOTED])

    def blank(self, i: int) -> bool:
        """Whether a line holds nothing."""
        return BLANK.fullmatch(self.lines[i]) is not None

    def too_long(self, i: int) -> bool:
        """Whether a line is none of a table of channels."""
        return len(self.lines[i]) > LONGEST

    def cells(self, numbers: Sequence[int], delimiter: str, _: str) -> list[list[str]]:
        """The cells of some lines, without empty ones at their end."""
        return cut([self.lines[i] for i in numbers], delimiter)


@dataclass(frozen=True)
class Sheet:
    """The rows of a sheet."""

    rows: Sequence[Cells]
    usual: str = ""
    delimiters: Sequence[str] = ("",)
    quoted: bool = False

    def __len__(self) -> int:
        return len(self.rows)

    def blank(self, i: int) -> bool:
        """Whether a row holds nothing."""
        return all(cell is None for cell in self.rows[i])

    def too_long(self, _: int) -> bool:
        """Cells are bounded by the workbook."""
        return False

    def cells(self, numbers: Sequence[int], _: str, decimal: str) -> list[list[str]]:
        """The cells of some rows as text."""
        return [trimmed(texts(self.rows[i], decimal)) for i in numbers]


Grid = Lines | Sheet


def trimmed(row: list[str]) -> list[str]:
    """The cells without blanks around them, and without empty ones at the end."""
    cells = [cell.strip() for cell in row]
    while cells and not cells[-1]:
        cells.pop()
    return cells


def cut(lines: Sequence[str], delimiter: str) -> list[list[str]]:
    """The cells of each line, without empty ones at its end."""
    if delimiter == "whitespace":
        return [trimmed(split_white(line)) for line in lines]
    try:
        return [trimmed(next(csv.reader([line], delimiter=delimiter, skipinitialspace=True), [])) for line in lines]
    except csv.Error:
        return [[] for _ in lines]
