"""The paper's statements about results, C1 to C14, evaluated with its published parameters.

`evaluate` returns one `Claim` per statement. A claim that took part in the calibration of the dead lengths is marked
`calibrated`, one that follows from an assumed value alone `assumed`; only the others are evidence.
"""

from collections.abc import Callable, Iterator
from dataclasses import fields

from twintube.claims import drives, harmonic, intact
from twintube.claims.claim import Claim
from twintube.parameters import load, names
from twintube.variables import Parameters

EVALUATORS: tuple[Callable[..., Claim], ...] = (
    harmonic.c1,
    harmonic.c2,
    harmonic.c3,
    harmonic.c4,
    harmonic.c5,
    harmonic.c6,
    harmonic.c7,
    harmonic.c8,
    harmonic.c9,
    harmonic.c10,
    intact.c11,
    intact.c12,
    drives.c13,
    harmonic.c14,
)


def evaluate(readings: dict[str, int] | None = None) -> Iterator[Claim]:
    """All claims in order; `readings` sets parameters of the group `reading` for every damper."""
    dampers = {name: load(name).with_(**(readings or {})) for name in names()}
    for evaluator in EVALUATORS:
        yield evaluator(dampers)


def compare_readings() -> Iterator[tuple[str, int, list[str], list[str]]]:
    """Every other value of every reading: name, value, claims that flip, and the figures that move most."""
    base = {c.id: c for c in evaluate()}
    for item in fields(Parameters):
        if item.metadata["group"] != "reading":
            continue
        for value in range(item.metadata["upper"] + 1):
            if value == item.metadata["default"]:
                continue
            other = {c.id: c for c in evaluate({item.name: value})}
            flips = [f"{i} {'holds' if other[i].holds else 'fails'}" for i in base if other[i].holds != base[i].holds]
            moves = []
            for i, claim in base.items():
                a, b = (dict(numbers(c.figures, i)) for c in (claim, other[i]))
                moves += [(abs(a[k] - b[k]), f"{k} {a[k]:g} -> {b[k]:g}") for k in a if k in b and abs(a[k]) <= 10]
            moves.sort(reverse=True)
            yield item.name, value, flips, [text for size, text in moves[:3] if size > 0.005]


def numbers(figures: object, path: str) -> Iterator[tuple[str, float]]:
    """All numbers in nested figures with their place."""
    if isinstance(figures, dict):
        for key, value in figures.items():
            yield from numbers(value, f"{path}.{key}")
    elif isinstance(figures, list):
        for i, value in enumerate(figures):
            yield from numbers(value, f"{path}[{i}]")
    elif isinstance(figures, float):
        yield path, figures


__all__ = ["EVALUATORS", "Claim", "compare_readings", "evaluate"]
