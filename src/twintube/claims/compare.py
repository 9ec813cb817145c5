"""What every other choice that the text leaves open does to every claim."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields, replace

from twintube.claims import evaluate
from twintube.claims.claim import BENCH, Bench, Claim
from twintube.core.variables import Parameters
from twintube.dampers.closures import CLOSURES
from twintube.rig.signals import STARTS

POSITIONS = (-0.015, 0.015)  # [m]
AMPLITUDES = (0.040,)  # [m] beside 45 mm; 50 mm would be the whole assumed stroke
LOSSES = (0.0, 0.05, 0.1, 0.28, 0.4)  # of cavitation_loss; 0.28: the highest state to which Y was fitted


@dataclass(frozen=True)
class Alternative:
    """One other choice: a value of a reading, or another bench."""

    name: str
    value: str
    readings: dict[str, float]
    bench: Bench


@dataclass(frozen=True)
class Effect:
    """What it does to one claim: the verdict, whether that is another one, and the figure that moves most."""

    id: str
    holds: bool
    flips: bool
    moves: str


def alternatives(bench: Bench = BENCH) -> list[Alternative]:
    """Every other value of every open choice, one at a time."""
    found = []
    for item in fields(Parameters):
        if item.metadata["group"] == "reading":
            default = item.metadata["default"]
            values = LOSSES if item.name == "cavitation_loss" else range(int(item.metadata["upper"]) + 1)
            found += [Alternative(item.name, f"{v:g}", {item.name: v}, bench) for v in values if v != default]
    found += [Alternative("start", v, {}, replace(bench, start=v)) for v in STARTS if v != bench.start]
    found += [Alternative("position", f"{v * 1e3:+g} mm", {}, replace(bench, position=v)) for v in POSITIONS]
    found += [Alternative("amplitude", f"{v * 1e3:g} mm", {}, replace(bench, reach=v)) for v in AMPLITUDES]
    found += [Alternative("closure", v, {}, replace(bench, closure=v)) for v in CLOSURES]
    return found


def compare(bench: Bench = BENCH) -> Iterator[tuple[Alternative, list[Effect]]]:
    """Every alternative with its effect on every claim, two at a time."""
    base = list(evaluate(bench=bench))
    with ThreadPoolExecutor(2) as pool:
        found = alternatives(bench)
        yield from zip(found, pool.map(lambda other: effects(base, other), found), strict=True)


def effects(base: list[Claim], other: Alternative) -> list[Effect]:
    """The effect of one alternative on every claim."""
    found = []
    for claim, changed in zip(base, evaluate(other.readings, other.bench), strict=True):
        a, b = (dict(numbers(c.figures, "")) for c in (claim, changed))
        moves = [(abs(a[k] - b[k]) / max(abs(a[k]), abs(b[k]), 1.0), k) for k in a if k in b]
        size, key = max(moves, default=(0.0, ""))
        text = f"{key.strip('.')} {a[key]:g} -> {b[key]:g}" if size > 0.005 else ""
        found.append(Effect(claim.id, changed.holds, changed.holds != claim.holds, text))
    return found


def numbers(figures: object, path: str) -> Iterator[tuple[str, float]]:
    """All numbers in nested figures with their place."""
    if isinstance(figures, dict):
        for key, value in figures.items():
            yield from numbers(value, f"{path}.{key}")
    elif isinstance(figures, (list, tuple)):
        for i, value in enumerate(figures):
            yield from numbers(value, f"{path}[{i}]")
    elif isinstance(figures, float):
        yield path, figures
