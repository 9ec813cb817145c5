"""Two curves beside each other as SVG: small, and without the second that a library of pictures takes to start."""

import math
from collections.abc import Iterable, Sequence
from html import escape

SIZE, GAP, MARGIN = (380, 270), 30, (60, 10, 45)  # [px] of a panel, between panels; left, top, bottom
STYLE = (
    '<style>path{fill:none;stroke:#204a87;stroke-width:1.3}line{stroke:#ddd}'
    'text{font:12px sans-serif;fill:#222;text-anchor:middle}.left{text-anchor:end}</style>'
)  # fmt: skip
MOST = 7  # ticks of an axis


def ticks(low: float, high: float) -> list[float]:
    """Round numbers between two limits, at most MOST."""
    span = max(high - low, 1e-12)
    ten = 10.0 ** math.floor(math.log10(span / MOST))
    step = next(m * ten for m in (1, 2, 5, 10, 20) if span / (m * ten) <= MOST - 1)
    return [i * step for i in range(math.ceil(low / step), math.floor(high / step) + 1)]


def scale(values: Iterable[float], start: float, end: float) -> tuple[float, float, float, float]:
    """The limits of an axis, and origin and factor of its coordinates."""
    low, high = min(values), max(values)
    room = 0.04 * (high - low) or 1.0
    factor = (end - start) / (high - low + 2 * room)
    return low - room, high + room, start - (low - room) * factor, factor


def panel(left: float, x: Sequence[float], y: Sequence[float], label: str, side: str) -> list[str]:
    """A curve with its grid and the names of its axes; the numbers of the vertical axis only where it has a name."""
    (width, height), top = SIZE, MARGIN[1]
    x_low, x_high, x_zero, x_factor = scale(x, left, left + width)
    y_low, y_high, y_zero, y_factor = scale(y, top + height, top)
    parts = []
    for value in ticks(x_low, x_high):
        at = x_zero + value * x_factor
        parts.append(f'<line x1="{at:.1f}" x2="{at:.1f}" y1="{top}" y2="{top + height}"/>')
        parts.append(f'<text x="{at:.1f}" y="{top + height + 16}">{value:.6g}</text>')
    for value in ticks(y_low, y_high):
        at = y_zero + value * y_factor
        parts.append(f'<line x1="{left}" x2="{left + width}" y1="{at:.1f}" y2="{at:.1f}"/>')
        if side:
            parts.append(f'<text class="left" x="{left - 6}" y="{at + 4:.1f}">{value:.6g}</text>')
    points = " ".join(f"{x_zero + a * x_factor:.1f},{y_zero + b * y_factor:.1f}" for a, b in zip(x, y, strict=True))
    parts.append(f'<text x="{left + width / 2}" y="{top + height + 36}">{escape(label)}</text>')
    if side:
        parts.append(f'<text transform="translate(14,{top + height / 2}) rotate(-90)">{escape(side)}</text>')
    return [*parts, f'<path d="M{points}"/>']


def svg(curves: Sequence[tuple[str, Sequence[float]]], side: str, y: Sequence[float], says: str) -> str:
    """The curves of `y`, which is called `side`, over each (name, values); `says` is for screen readers."""
    (width, height), (left, top, bottom) = SIZE, MARGIN
    whole = left + len(curves) * (width + GAP), top + height + bottom
    parts = [
        part
        for i, (label, x) in enumerate(curves)
        for part in panel(left + i * (width + GAP), x, y, label, "" if i else side)
    ]
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {whole[0]} {whole[1]}" role="img" '
        f'aria-label="{escape(says)}">{STYLE}{"".join(parts)}</svg>'
    )
