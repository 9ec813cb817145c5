"""What is wrong with measured data: findings, collected over all records before anything is refused."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Literal

from twintube.engine.simulate import InputError
from twintube.words import printable, shown


@dataclass(frozen=True)
class Finding:
    """One defect: where it is, and a message that names the quantity, its value and the limit."""

    severity: Literal["error", "warning", "remark"]
    file: str  # as written in dataset.toml, or "dataset.toml" itself
    column: str  # header as in the file or in `columns`; a key in dataset.toml; "" if it is about the whole file
    row: int | None  # row of a text file counted from 1, else number of the sample counted from 0; None: the whole column
    message: str
    counted: Literal["row", "sample"] = "row"

    @property
    def text(self) -> str:
        """Row, column and message, in one line."""
        place = [] if self.row is None else [f"{self.counted} {self.row}"]
        place += [f"column {shown(self.column)}"] if self.column else []
        return " ".join(printable(": ".join([*([", ".join(place)] if place else []), self.message])).split("\n"))

    def __str__(self) -> str:
        return f"{self.severity}: {printable(self.file)}: {self.text}"


class DataError(InputError):
    """A dataset that cannot be used; `findings` are all errors and warnings of all its records."""

    def __init__(self, title: str, findings: Iterable[Finding]) -> None:
        self.findings = list(findings)
        errors = [finding for finding in self.findings if finding.severity == "error"]
        count = "1 error" if len(errors) == 1 else f"{len(errors)} errors"
        super().__init__(f"{title}: {count}\n" + report(self.findings))


def report(findings: Iterable[Finding]) -> str:
    """One line per finding, errors first, remarks last."""
    order = ("error", "warning", "remark")
    return "\n".join(str(finding) for finding in sorted(findings, key=lambda finding: order.index(finding.severity)))


class UnreadableError(ValueError):
    """A file that gives no table at all; the message becomes a finding."""

    def __init__(self, message: str, row: int | None = None) -> None:
        super().__init__(message)
        self.row = row


@dataclass
class Notes:
    """Collects the findings of one file."""

    file: str
    counted: Literal["row", "sample"] = "row"
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

    @property
    def failed(self) -> bool:
        """Whether there is an error."""
        return any(finding.severity == "error" for finding in self.findings)


def more(count: int, last: int, counted: str) -> str:
    """The tail of a message about the first of `count` places."""
    return f" ({count} such {counted}s, the last is {counted} {last})" if count > 1 else ""
