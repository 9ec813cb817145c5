"""What is wrong with measured data: findings, collected over all records before anything is refused."""

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from twintube.common.grouping import grouped
from twintube.common.words import counted, listed, printable, shown
from twintube.engine.simulate import InputError

# A number of a message, but none in a name; a quoted name, which stays; the count of further places.
NUMBER = re.compile(r"'[^']*'|\"[^\"]*\"|(?<![\w.])[+-]?\d[\d.]*(?:e[+-]?\d+)?|\([^()]* such [^()]*\)")
Counted = Literal["row", "sample", "line"]
UNCONFIRMED = "not confirmed: "  # how the warning about a guess of a new dataset begins
MOST_NAMED = 3  # further files of a kind of finding


@dataclass(frozen=True)
class Finding:
    """One defect: where it is, and a message that names the quantity, its value and the limit."""

    severity: Literal["error", "warning", "remark"]
    file: str  # as written in dataset.toml, or "dataset.toml" itself
    column: str  # header as in the file or in `columns`; a key in dataset.toml; "" if it is about the whole file
    row: int | None  # of a text or a line of dataset.toml from 1, else the sample from 0; None: all of the column
    message: str
    counted: Counted = "row"

    @property
    def place(self) -> str:
        """Row and column, or the line of dataset.toml and its key."""
        place = [] if self.row is None else [f"{self.counted} {self.row}"]
        return ", ".join(
            place + ([self.column if self.counted == "line" else f"column {shown(self.column)}"] if self.column else [])
        )

    @property
    def text(self) -> str:
        """Row, column and message, in one line."""
        return " ".join(printable(": ".join([*([self.place] if self.place else []), self.message])).split("\n"))

    @property
    def kind(self) -> tuple[str, str, str]:
        """What it shares with findings that differ in their numbers alone."""
        return self.severity, self.column, NUMBER.sub(lambda m: m[0] if m[0][0] in "'\"" else "", self.message)

    def __str__(self) -> str:
        joint = ", " if self.counted == "line" and self.place else ": "
        return f"{self.severity}: {printable(self.file)}{joint}{self.text}"


class DataError(InputError):
    """A dataset that cannot be used; `findings` are all errors and warnings of all its records."""

    def __init__(self, title: str, findings: Iterable[Finding]) -> None:
        self.findings = list(findings)
        errors = [finding for finding in self.findings if finding.severity == "error"]
        count = "1 error" if len(errors) == 1 else f"{len(errors)} errors"
        super().__init__(f"{title}: {count}\n" + report(self.findings))


def report(findings: Iterable[Finding]) -> str:
    """One line per kind of finding, errors first, remarks last: the first in full, and where else there are such."""
    order = ("error", "warning", "remark")
    kinds = grouped((each.kind, each) for each in sorted(findings, key=lambda each: order.index(each.severity)))
    return "\n".join(f"{first}{elsewhere(first, others)}" for first, *others in kinds.values())


def unconfirmed(findings: Iterable[Finding]) -> list[str]:
    """What dataset.toml still calls a guess, each once."""
    return list(dict.fromkeys(finding.message for finding in findings if finding.message.startswith(UNCONFIRMED)))


def elsewhere(first: Finding, others: list[Finding]) -> str:
    """The tail of the line of a first finding: other files, or other places in its own, with findings of its kind."""
    files = list(dict.fromkeys(printable(other.file) for other in others if other.file != first.file))
    places = [f"{other.counted} {other.row}" for other in others if other.file == first.file]
    return "".join(
        f" (the like {joint} {counted(len(some), f'more {what}')}: {listed(some, MOST_NAMED)})"
        for joint, what, some in (("in", "file", files), ("at", "place", places))
        if some
    )


class UnreadableError(ValueError):
    """A file that gives no table at all; the message becomes a finding."""

    def __init__(self, message: str, row: int | None = None) -> None:
        super().__init__(message)
        self.row = row


@dataclass(frozen=True)
class Places:
    """Samples at which something is wrong."""

    first: int  # row in the file
    tail: str  # of a message, how many there are


@dataclass
class Notes:
    """Collects the findings of one file."""

    file: str
    counted: Counted = "row"
    findings: list[Finding] = field(default_factory=list)

    def error(self, message: str, column: str = "", row: int | None = None) -> None:
        """Add a finding that refuses the dataset."""
        self.findings.append(Finding("error", self.file, column, row, message, self.counted))

    def warning(self, message: str, column: str = "", row: int | None = None) -> None:
        """Add a finding that the dataset can be used with."""
        self.findings.append(Finding("warning", self.file, column, row, message, self.counted))

    def remark(self, message: str, column: str = "", row: int | None = None) -> None:
        """Add a finding about the test rather than its data."""
        self.findings.append(Finding("remark", self.file, column, row, message, self.counted))

    def places(self, wrong: NDArray[np.bool_], rows: NDArray[np.int64]) -> Places | None:
        """The samples (n,), of these rows, where something is `wrong`; None where nothing is."""
        at = rows[np.flatnonzero(wrong)]
        if not len(at):
            return None
        tail = f" ({len(at)} such {self.counted}s, the last is {self.counted} {at[-1]})" if len(at) > 1 else ""
        return Places(int(at[0]), tail)

    @property
    def failed(self) -> bool:
        """Whether there is an error."""
        return any(finding.severity == "error" for finding in self.findings)
