"""The columns that a reader gives, within bounds."""

from typing import Any

import numpy as np

MOST_VALUES = 64_000_000  # numbers in all columns of a file
MOST_COLUMNS = 1000
MOST_WIDE = 64  # columns of a matrix; a wider one is not a recording of channels
LONGEST_NAME = 500
LONGEST_CELL = 100  # characters of a text in a column
Request = dict[str, Any]  # wanted: names in the file, or None; sheet, group: a name or None; first_rows: of all sheets


class UnreadableError(ValueError):
    """A file that cannot be read, with the whole message."""


class Columns:
    """The columns of a file, within bounds on their number and size."""

    def __init__(self) -> None:
        self.values: dict[str, np.ndarray[Any, Any]] = {}
        self.empty: dict[str, np.ndarray[Any, Any]] = {}  # where a cell holds nothing
        self.units: dict[str, str] = {}
        self.refused: dict[str, str] = {}  # columns that hold no numbers, and what they hold
        self.nothing = ""  # what a cell without a value means, where it is not just empty
        self.count = 0

    def expect(self, name: str, count: int) -> None:
        """Raise UnreadableError if a column of `count` values is too many; called before it is read."""
        if len(name) > LONGEST_NAME:
            raise UnreadableError(f"a column's name has {len(name)} characters, at most {LONGEST_NAME} are read")
        if len(self.values) + len(self.refused) >= MOST_COLUMNS:
            raise UnreadableError(f"more than {MOST_COLUMNS} columns")
        self.count += count
        if self.count > MOST_VALUES:
            raise UnreadableError(f"more than {MOST_VALUES} values up to column {name!r}")

    def refuse(self, name: str, what: str) -> None:
        """Note what a variable is that is no column of numbers."""
        self.expect(name, 0)
        self.refused[name] = what

    def put(self, name: str, cells: list[Any]) -> None:
        """Add a column of numbers, of texts (times, numbers with a comma), or of both; None is an empty cell."""
        self.expect(name, len(cells))
        kinds = {type(cell) for cell in cells} - {type(None)}
        if kinds <= {int, float}:
            self.values[name] = np.array([np.nan if cell is None else cell for cell in cells], dtype=float)
            self.empty[name] = np.array([cell is None for cell in cells])
        elif kinds <= {int, float, str} and max(len(cell) for cell in cells if isinstance(cell, str)) <= LONGEST_CELL:
            self.values[name] = np.array(["" if cell is None else str(cell) for cell in cells])
        else:
            self.refused[name] = ", ".join(sorted(kind.__name__ for kind in kinds))
