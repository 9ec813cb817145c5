"""A self-contained HTML page of sections with pictures, verdicts and tables; it knows nothing of what it reports."""

import base64
import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib.resources import files
from typing import Any

import jinja2

BRIEF = 420  # characters of numbers that are shown unfolded
MARKS = {"holds": "yes", "does not hold": "no", "not checkable": "open"}  # verdict -> class of the style sheet


@dataclass(frozen=True)
class Picture:
    """A PNG and what a reader who cannot see it is told."""

    png: bytes
    alt: str
    caption: str = ""

    @property
    def uri(self) -> str:
        """The picture itself as address, so that the page needs no other file."""
        return "data:image/png;base64," + base64.b64encode(self.png).decode("ascii")


@dataclass(frozen=True)
class Table:
    """A table; cells are text."""

    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    caption: str = ""
    numeric: Sequence[int] = ()  # columns that are set flush right


@dataclass(frozen=True)
class Finding:
    """A statement with its verdict, one of `MARKS` or nothing."""

    text: str
    verdict: str = ""
    facts: Sequence[tuple[str, str]] = ()  # name and text, short
    numbers: Mapping[str, Any] = field(default_factory=dict)  # many are unfolded on demand, and left out in print

    @property
    def mark(self) -> str:
        """Class in the style sheet."""
        return MARKS.get(self.verdict, "open")

    @property
    def listing(self) -> list[tuple[str, str]]:
        """The numbers as name and text."""
        return [(name.replace("_", " "), readable(value)) for name, value in self.numbers.items()]

    @property
    def brief(self) -> bool:
        """Whether the numbers are few enough to be shown at once."""
        return sum(len(name) + len(text) for name, text in self.listing) <= BRIEF


@dataclass(frozen=True)
class Headline:
    """The answer in one sentence, large and above everything else."""

    text: str
    verdict: str = ""
    mark: str = "open"  # class of the style sheet: yes, no, open, warn or found
    tiles: Sequence[tuple[str, str]] = ()  # a figure and what it is


@dataclass(frozen=True)
class Section:
    """One entry of the table of contents."""

    anchor: str
    title: str
    verdict: str = ""
    tally: str = ""
    text: Sequence[str] = ()
    pictures: Sequence[Picture] = ()
    findings: Sequence[Finding] = ()
    tables: Sequence[Table] = ()
    notes: Sequence[tuple[str, str]] = ()  # name and text, below the findings
    items: Sequence[str] = ()  # a list below the text

    @property
    def mark(self) -> str:
        """Class in the style sheet."""
        return MARKS.get(self.verdict, "open")


def readable(value: Any) -> str:
    """Numbers as text that wraps: `name: value` pairs, inner ones in brackets."""
    if isinstance(value, Mapping):
        names = [str(key).replace("_", " ") for key in value]
        return "; ".join(f"{n} ({readable(v)})" if isinstance(v, Mapping) else f"{n}: {readable(v)}"
                         for n, v in zip(names, value.values(), strict=True)) or "none"  # fmt: skip
    if isinstance(value, (list, tuple)):
        if any(isinstance(v, (list, tuple, Mapping)) for v in value):
            return "; ".join(readable(v) for v in value)
        return ", ".join(readable(v) for v in value) or "none"
    return value if isinstance(value, str) else json.dumps(value)


def html(
    title: str, lead: Iterable[str], sections: Iterable[Section], summary: Iterable[Table] = (), foot: str = "",
    headline: Headline | None = None,
) -> str:  # fmt: skip
    """The whole page."""
    environment = jinja2.Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    source = files("twintube.report").joinpath("page.html").read_text(encoding="utf-8")
    return environment.from_string(source).render(
        title=title, lead=list(lead), sections=list(sections), summary=list(summary), foot=foot, headline=headline
    )
