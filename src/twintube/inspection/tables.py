"""The methods and the ranges of the scatter as rows of text, for the documentation and the page."""

from collections.abc import Iterable, Sequence

from twintube.common.readable import unit_of
from twintube.inspection.methods import METHODS
from twintube.inspection.scatter import RANGES, Range

METHOD_HEAD = ("method", "figure", "limit", "source", "how sure")
RANGE_HEAD = ("what scatters", "range", "basis and reason")


def method_rows() -> list[list[str]]:
    """One row per method."""
    return [[f"{m.title} ({m.name})", m.figure, m.rule, m.source, m.certainty] for m in METHODS.values()]


def span(item: Range) -> str:
    """Both ends of a range in engineering units."""
    unit, factor = unit_of(item.unit, item.high)
    return f"{item.low * factor:g} to {item.high * factor:g} {unit}".rstrip()


def range_rows() -> list[list[str]]:
    """One row per range of the scatter."""
    return [[item.title, span(item), f"{item.basis}: {item.reason}"] for item in RANGES]


def markdown(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table in Markdown."""
    first, *rest = ("| " + " | ".join(cells) + " |\n" for cells in (head, *rows))
    return "".join((first, "|" + "---|" * len(head) + "\n", *rest))
