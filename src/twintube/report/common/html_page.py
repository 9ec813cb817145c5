"""A self-contained HTML page of sections with pictures, verdicts and tables, independent of the content.

A page that answers a question has a headline: answer, next step and picture are seen at once, the sections fold. A page
without one is a collection: its sections are open, and contents lead to them.
"""

import base64
import json
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Any

import jinja2
from matplotlib.figure import Figure

from twintube.common.files import write_bytes, write_text
from twintube.report.common import style
from twintube.version import __version__

BRIEF = 420  # characters: longer listings of numbers are folded
MARKS = {"holds": "yes", "does not hold": "no", "not checkable": "open"}  # verdict -> class of the style sheet


@dataclass(frozen=True)
class Picture:
    """A PNG with its alternative text and caption."""

    png: bytes
    alt: str
    caption: str = ""
    narrow: bytes = b""  # the PNG for small screens, if there is one
    name: str = ""  # of the file that stands beside the page, if one does

    @classmethod
    def drawn(cls, draw: Callable[[bool], Figure], caption: str, name: str = "") -> "Picture":
        """A picture in two shapes, for wide and, where `draw` is told so, for narrow screens."""
        return cls(style.png(draw(False)), caption, caption, style.png(draw(True)), name)


@dataclass(frozen=True)
class Table:
    """A table; cells are text."""

    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    caption: str = ""
    numeric: Sequence[int] = ()  # right-aligned columns


@dataclass(frozen=True)
class Finding:
    """A statement with its verdict, a key of `MARKS` or empty."""

    text: str
    verdict: str = ""
    facts: Sequence[tuple[str, str]] = ()  # name and text, short
    numbers: Mapping[str, Any] = field(default_factory=dict)  # long listings are folded, and not printed

    @property
    def listing(self) -> list[tuple[str, str]]:
        """The numbers as pairs of name and text."""
        return [(name.replace("_", " "), readable(value)) for name, value in self.numbers.items()]

    @property
    def brief(self) -> bool:
        """Whether the listing is short enough to be shown unfolded."""
        return sum(len(name) + len(text) for name, text in self.listing) <= BRIEF


@dataclass(frozen=True)
class Headline:
    """The answer in one sentence, in large type, with what the first screen holds besides."""

    text: str
    verdict: str = ""
    mark: str = "open"  # class of the style sheet: yes, no, open, warn or found
    remark: str = ""  # below the sentence
    next: str = ""  # the next step
    picture: Picture | None = None


@dataclass(frozen=True)
class Section:
    """A section of the page."""

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
    live: str = ""  # HTML of `report.live`
    open: bool = False  # not folded, below a headline


def mark(verdict: str) -> str:
    """The class of a verdict in the style sheet."""
    return MARKS.get(verdict, "open")


def data_uri(png: bytes) -> str:
    """A PNG as data URI, so that the page needs no other file."""
    return "data:image/png;base64," + base64.b64encode(png).decode("ascii")


def upper(text: str) -> str:
    """A text as a sentence begins."""
    return text[0].upper() + text[1:]


def coded(text: str) -> str:
    """A text as HTML, in which what stands between backticks is code."""
    return re.sub("`([^`]+)`", r"<code>\1</code>", escape(text))


def readable(value: Any) -> str:
    """Numbers as text that wraps: `name: value` pairs, nested ones in brackets."""
    if isinstance(value, Mapping):
        names = [str(key).replace("_", " ") for key in value]
        return "; ".join(f"{n} ({readable(v)})" if isinstance(v, Mapping) else f"{n}: {readable(v)}"
                         for n, v in zip(names, value.values(), strict=True)) or "none"  # fmt: skip
    if isinstance(value, (list, tuple)):
        if any(isinstance(v, (list, tuple, Mapping)) for v in value):
            return "; ".join(readable(v) for v in value)
        return ", ".join(readable(v) for v in value) or "none"
    return value if isinstance(value, str) else json.dumps(value)


def rendered(module: str, name: str, **values: Any) -> str:
    """A template beside a module, with these values."""
    environment = jinja2.Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.filters.update({"coded": coded, "mark": mark, "uri": data_uri, "sentence": upper})
    return environment.from_string(beside(module, name)).render(**values)


def beside(module: str, name: str) -> str:
    """The text of a file in the folder of a module."""
    return files(module.rpartition(".")[0]).joinpath(name).read_text(encoding="utf-8")


@dataclass(frozen=True)
class Page:
    """The page of a result."""

    title: str
    sections: Sequence[Section]
    lead: Sequence[str] = ()
    summary: Sequence[Table] = ()
    headline: Headline | None = None
    foot: str = ""

    @property
    def html(self) -> str:
        """The whole page."""
        foot = ". ".join(text for text in (self.foot.rstrip("."), f"twintube {__version__}") if text)
        named = {name: getattr(self, name) for name in ("title", "lead", "sections", "summary", "headline")}
        return rendered(__name__, "page.html", **named, foot=foot)

    def write(self, folder: Path, name: str = "report.html") -> list[Path]:
        """Write the page and those of its pictures that have a name; returns the files."""
        first = [self.headline.picture] if self.headline and self.headline.picture else []
        shown = [*first, *(picture for section in self.sections for picture in section.pictures)]
        files = {folder / f"{picture.name}.png": picture.png for picture in shown if picture.name}
        for file, png in files.items():
            write_bytes(file, png)
        write_text(folder / name, self.html)
        return [*files, folder / name]
