"""Pictures that say one thing: a sentence above, its conditions under it, what is assumed at the bottom, names at lines.

Made for pages that show a picture of WIDTH at about 100 pixels per inch: smaller letters than these are not legible.
"""

import math
import re
import textwrap
from collections.abc import Iterable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, to_hex
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from scipy.optimize import isotonic_regression

from twintube.report.common.style import BLUE, GREY, INK, NARROW

WIDTH = 8.3  # [inch]
SENTENCE, WORDS, SMALL = 11.5, 9.0, 8.0  # sizes of letters [points]
LINE = 1.35  # height of a line over the size of its letters
WIDE = {SENTENCE: 0.60, WORDS: 0.53, SMALL: 0.53}  # width of a letter over its size: the sentence is bold
INTACT, SCALAR, OTHER = INK, BLUE, GREY  # the damper as new; oil level as a factor of its force; beside the matter
# Oil levels by lightness, which every eye tells apart, from full without preload to a third.
OIL = LinearSegmentedColormap.from_list("oil", ["#f7c948", "#e07b2c", "#b8412b", "#5e0b30"])
LEAST = 0.3  # oil level at the dark end


def worn(oil_level: float) -> str:
    """The colour of a damper with lost preload at an oil level [1]."""
    return to_hex(OIL(min(1.0, (1.0 - oil_level) / (1.0 - LEAST))))


def colour_of(gas_preload: float, oil_level: float) -> str:
    """The colour of a state."""
    return INTACT if gas_preload >= 1.0 and oil_level >= 1.0 else worn(oil_level)


def oil(level: float) -> str:
    """`80 % oil`."""
    return f"{100 * level:.0f} % oil"


def framed(figure: Figure, sentence: str, conditions: str, note: str, key: Axes | None = None) -> None:
    """Add the sentence, the conditions and the key of an axes above the panels and the note below; the figure grows."""
    width, height = figure.get_size_inches()
    head = [(line, SENTENCE, "bold", INK) for line in wrapped(sentence, SENTENCE, width)]
    head += [(line, WORDS, "normal", "#555") for line in wrapped(conditions, WORDS, width)]
    foot = wrapped(note, SMALL, width)
    gap = 0.08  # [inch]
    unique = dict(zip(*reversed(key.get_legend_handles_labels()), strict=True)) if key is not None else {}
    columns = len(unique) if width > NARROW else min(2, len(unique))
    row = (1 + math.ceil(len(unique) / columns)) * inches(WORDS) if unique else 0.0
    above, below = sum(inches(size) for _, size, _, _ in head) + 2 * gap + row, inches(SMALL) * len(foot) + gap
    full = height + above + below
    figure.set_size_inches(width, full)
    engine = figure.get_layout_engine()
    assert isinstance(engine, ConstrainedLayoutEngine)
    engine.set(rect=(0.0, below / full, 1.0, height / full))
    top = full - gap
    for text, size, weight, colour in head:  # names may hold "$"
        figure.text(gap / width, top / full, text, size=size, weight=weight, color=colour, va="top", parse_math=False)
        top -= inches(size)
    if unique:
        place = (gap / width, (top - 0.5 * gap) / full)
        figure.legend(list(unique.values()), list(unique), loc="upper left", bbox_to_anchor=place, ncols=columns,
                      fontsize=WORDS, frameon=False, columnspacing=1.4, borderaxespad=0.0)  # fmt: skip
    figure.text(gap / width, 0.5 * gap / full, "\n".join(foot), size=SMALL, color="#555", va="bottom", parse_math=False)


def inches(size: float) -> float:
    """Height of a line of letters of a size [points]."""
    return LINE * size / 72


def wrapped(text: str, size: float, width: float) -> list[str]:
    """Lines of a text that fit into a width [inch]; a number stays with its unit."""
    return textwrap.wrap(
        re.sub(r"(?<=\d) (?=\S)", "\N{NO-BREAK SPACE}", text), int((width - 0.2) * 72 / (size * WIDE[size]))
    )


def name_lines(ax: Axes, names: Iterable[tuple[float, str, str]]) -> None:
    """Write (height in data, text, colour) at the right of the axes, moved apart where they would overlap.

    For axes whose limits are final.
    """
    ordered = sorted(names, key=lambda item: item[0])
    if not ordered:
        return
    heights = ax.transAxes.inverted().transform(ax.transData.transform([(0.0, y) for y, _, _ in ordered]))[:, 1]
    figure = ax.get_figure(root=True)
    assert figure is not None
    gap = inches(WORDS) / (ax.get_position().height * figure.get_size_inches()[1])
    steps = gap * np.arange(len(ordered))
    apart = isotonic_regression(heights - steps).x + steps
    for y, (_, text, colour) in zip(apart.tolist(), ordered, strict=True):
        ax.text(1.015, y, text, transform=ax.transAxes, color=colour, size=WORDS, va="center", parse_math=False)
