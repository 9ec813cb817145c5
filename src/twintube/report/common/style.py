"""Style of the pictures: colours, panels, notes under a plot."""

import textwrap
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from io import BytesIO
from typing import Any, TypeVar

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

INK, GREY, FAINT = "#1b1b1b", "#8a949b", "#c3cbd0"
BLUE, ORANGE, RED, GREEN, VIOLET = "#2a7f9e", "#d98c21", "#b3282d", "#3f8f4f", "#6d4c94"
DARK = {  # the same on a dark page
    INK: "#e6ebee", GREY: "#98a4ab", BLUE: "#5ab0d0", ORANGE: "#e5a84f", RED: "#ef7b76", GREEN: "#6fc27f", VIOLET: "#b79ad6",
}  # fmt: skip
LEVELS = (INK, ORANGE, RED)  # the intact state, the paper's 60 % and 40 %
PHASES = {"oil": "#c98b1f", "foam": "#f0d9a8", "gas": "#cfe0ee"}
STAND_IN = "stand-in: virtual rig, not the paper's measurement"
T = TypeVar("T")
DPI = 130
NOTE_SIZE = 7.5  # points
RC: Any = {  # matplotlib has a type of its own for the keys
    "axes.grid": True,
    "grid.alpha": 0.3,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.labelsize": 9.5,
    "xtick.labelsize": 9,
    "ytick.labelsize": 9,
    "font.size": 10,
    "legend.frameon": False,
    "legend.fontsize": 9,
}


MAKE: ContextVar[Callable[..., Figure]] = ContextVar("make", default=Figure)


@contextmanager
def of_pyplot() -> Iterator[None]:
    """Figures that are made within belong to pyplot, which shows them in notebooks and keeps them until they are closed."""
    from matplotlib import pyplot

    token = MAKE.set(pyplot.figure)
    try:
        yield
    finally:
        MAKE.reset(token)


def canvas(rows: int = 1, columns: int = 1, size: tuple[float, float] = (10.0, 4.4), **options: Any) -> tuple[Figure, Any]:
    """A figure with `rows` x `columns` axes (always an array of them) of the given size [inch]."""
    with matplotlib.rc_context(RC):
        figure = MAKE.get()(figsize=size, dpi=DPI, layout="constrained")
        axes = figure.subplots(rows, columns, squeeze=False, **options)
    return figure, axes


def panels(names: Iterable[str], x: str, y: str) -> tuple[Figure, dict[str, Axes]]:
    """Panels (a) to (h), one per damper, as in the paper."""
    listed = list(names)
    figure, axes = canvas(2, (len(listed) + 1) // 2, (11.0, 6.2), sharex=True)
    table = dict(zip(listed, axes.flat, strict=False))
    for letter, (name, ax) in zip("abcdefgh", table.items(), strict=False):
        title(ax, f"({letter}) {name}")
    label(axes, x, y)
    return figure, table


def pairs(size: tuple[float, float], *rows: str, **options: Any) -> tuple[Figure, Any]:
    """Panels (a) first and (b) 19th oscillation for the work over the velocity, in `rows` of these names."""
    figure, axes = canvas(len(rows), 2, size, **options)
    for row, name in zip(axes, rows, strict=True):
        for ax, text in zip(row, ("(a) 1st oscillation", "(b) 19th oscillation"), strict=True):
            title(ax, f"{text}, {name}" if name else text)
    label(axes, "maximum velocity [m/s]", "work of one oscillation [J]")
    return figure, axes


def from_zero(axes: Any) -> None:
    """Axes that are drawn begin at 0."""
    for ax in axes.flat:
        ax.set_xlim(left=0)
        ax.set_ylim(bottom=0)


def loop(ax: Axes, run: Any, span: slice, unit: float = 1.0, **options: Any) -> None:
    """Force over stroke [mm] of a part of a record or a simulation, the force [N] times `unit`."""
    ax.plot(run.stroke[span] * 1e3, run.force[span] * unit, **options)


NARROW = 4.3  # [inch] width of a picture for a screen of 400 pixels: its type stays legible
BESIDE = 20  # letters of the entries of its key that still fit beside each other


def grid(
    count: int, panel: tuple[float, float], narrow: bool = False, most: int = 3, least: float = 0.0, **options: Any
) -> tuple[Figure, Any]:
    """A figure of `count` panels of a size [inch], `most` in a row, or one where narrow; axes (rows, columns).

    `least` is the width [inch] that a legend needs. Panels that are left over are hidden.
    """
    columns = 1 if narrow else min(most, count)
    rows = -(-count // columns)
    width, legend = (NARROW, 0.9) if narrow else (max(panel[0] * columns, least), 0.5)
    figure, axes = canvas(rows, columns, (width, panel[1] * rows + legend), **options)
    for ax in axes.flat[count:]:
        ax.set_visible(False)
    return figure, axes


def spread(several: Sequence[T], most: int) -> list[T]:
    """At most so many, evenly picked, first and last among them."""
    return [several[i] for i in sorted({round(x) for x in np.linspace(0, len(several) - 1, min(most, len(several)))})]


def bars(ax: Axes, rows: Sequence[tuple[str, float, str]], letters: int) -> None:
    """A bar for each name, size and colour, the first at the top; the names in lines of so many letters."""
    names, sizes, colours = zip(*rows[::-1], strict=True)
    ax.barh(["\n".join(textwrap.wrap(name, letters)) for name in names], sizes, color=colours)


def title(ax: Axes, text: str, size: float = 10.5) -> None:
    """A panel's title, in smaller type where there are many."""
    ax.set_title(text, loc="left", fontsize=size)


def plain(text: str) -> str:
    """A user's text, in which `$` does not begin a formula; for every name that a picture shows."""
    return text.replace("$", r"\$")


def label(axes: Any, x: str, y: str) -> None:
    """Labels at the outer axes only."""
    for row in axes:
        row[0].set_ylabel(y)
    for ax in axes[-1]:
        ax.set_xlabel(x)


def legend_above(figure: Figure, *axes: Axes, columns: int = 6) -> None:
    """One legend for the whole figure, above the axes."""
    unique: dict[str, Any] = {}
    for ax in axes:
        handles, labels = ax.get_legend_handles_labels()
        unique |= {text: handle for text, handle in zip(labels, handles, strict=True) if text not in unique}
    if figure.get_figwidth() <= NARROW:
        columns = 1 if max(map(len, unique), default=0) > BESIDE else 2
    figure.legend(list(unique.values()), list(unique), loc="outside upper left", ncols=min(columns, len(unique)), fontsize=9,
                  frameon=False)  # fmt: skip


def notes(figure: Figure, lines: Iterable[str]) -> None:
    """Notes under the plot: stand-ins and assumed values."""
    width, height = figure.get_size_inches()
    wrapped = [text for line in lines for text in textwrap.wrap(line, int(width * 17))]
    if not wrapped:
        return
    inch = NOTE_SIZE / 72 * 1.35
    figure.set_size_inches(width, height + inch * len(wrapped))
    height += inch * len(wrapped)
    share = (inch * len(wrapped) + 0.06) / height
    engine = figure.get_layout_engine()
    assert isinstance(engine, ConstrainedLayoutEngine)
    engine.set(rect=(0, share, 1, 1 - share))
    figure.text(0.008, 0.04 / height, "\n".join(wrapped), fontsize=NOTE_SIZE, color="#555", va="bottom", linespacing=1.2)


def png(figure: Figure) -> bytes:
    """The picture as PNG; equal figures give equal bytes."""
    with BytesIO() as buffer, matplotlib.rc_context(RC):
        figure.savefig(buffer, format="png", dpi=DPI, metadata={"Software": None})
        return buffer.getvalue()
