"""The methods and the ranges of the scatter as rows of text, for the documentation and the page."""

from collections.abc import Iterable, Sequence

from twintube.common.readable import unit_of
from twintube.inspection.methods import METHODS
from twintube.inspection.scatter import RANGES, Range

METHOD_HEAD = ("method", "figure", "limit", "source", "how sure")
RANGE_HEAD = ("what scatters", "from", "to", "basis", "reason")


def method_rows() -> list[list[str]]:
    """One row per method."""
    return [[f"{m.title} ({m.name})", m.figure, m.rule, m.source, m.certainty] for m in METHODS.values()]


def ends(item: Range) -> tuple[str, str]:
    """Both ends of a range in engineering units."""
    unit, factor = unit_of(item.unit, item.high)
    low, high = (f"{end * factor:g}{' ' + unit if unit else ''}" for end in (item.low, item.high))
    return low, high


def range_rows() -> list[list[str]]:
    """One row per range of the scatter."""
    return [[item.title, *ends(item), item.basis, item.reason] for item in RANGES]


def markdown(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table in Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)
