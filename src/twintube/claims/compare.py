"""Effect of every open choice, for which the paper gives no value, on every claim."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields, replace

from twintube.claims import evaluate
from twintube.claims.claim import BENCH, Bench, Claim
from twintube.core.variables import Parameters
from twintube.dampers.freed_gas import WAYS
from twintube.rig.signals import STARTS

POSITIONS = (-0.015, 0.015)  # [m]
AMPLITUDES = (0.040,)  # [m] instead of 45 mm; 50 mm would be the whole assumed stroke
VALUES = {  # of readings that are no switch
    "cavitation_loss": (0.0, 0.05, 0.1, 0.28, 0.4),  # 0.28: the highest state to which Y was fitted
    "foot_valve": (0.0, 0.1),  # from the rod's share of the piston's area on, 0.19 at the rear, V1 is always filled
}
SHOWN = 0.005  # relative change [1] of a number that is shown


@dataclass(frozen=True)
class Alternative:
    """One alternative choice: a value of a reading, a bench setting, or the rear curve."""

    name: str
    value: str
    readings: dict[str, float]
    bench: Bench
    rear: bool = False  # rear dampers with the rear curve


@dataclass(frozen=True)
class Change:
    """Change of one claim: the new verdict, whether it differs, and the figure that changes most."""

    id: str
    holds: bool
    flips: bool
    moves: str


def alternatives(bench: Bench = BENCH) -> list[Alternative]:
    """All alternative values of the open choices, one at a time."""
    choices = []
    for item in fields(Parameters):
        if item.metadata["group"] == "reading":
            default = item.metadata["default"]
            values = VALUES.get(item.name, range(int(item.metadata["upper"]) + 1))
            choices += [Alternative(item.name, f"{v:g}", {item.name: v}, bench) for v in values if v != default]
    choices += [Alternative("start", v, {}, replace(bench, start=v)) for v in STARTS if v != bench.start]
    choices += [Alternative("position", f"{v * 1e3:+g} mm", {}, replace(bench, position=v)) for v in POSITIONS]
    choices += [Alternative("amplitude", f"{v * 1e3:g} mm", {}, replace(bench, reach=v)) for v in AMPLITUDES]
    choices += [Alternative("freed_gas", v, {}, replace(bench, freed_gas=v)) for v in WAYS]
    choices.append(Alternative("F-v curve", "rear dampers with the rear one of its source", {}, bench, rear=True))
    return choices


def compare(bench: Bench = BENCH) -> Iterator[tuple[Alternative, list[Change]]]:
    """Every alternative with the changes of all claims; two are computed at a time."""
    base = list(evaluate(bench=bench))
    with ThreadPoolExecutor(2) as pool:
        choices = alternatives(bench)
        yield from zip(choices, pool.map(lambda choice: effects(base, choice), choices), strict=True)


def effects(base: list[Claim], choice: Alternative) -> list[Change]:
    """The change of every claim with one alternative."""
    changes = []
    for claim, varied in zip(base, evaluate(choice.readings, choice.bench, rear=choice.rear), strict=True):
        a, b = (dict(numbers(c.figures, "")) for c in (claim, varied))
        moves = [(abs(a[k] - b[k]) / max(abs(a[k]), abs(b[k]), 1.0), k) for k in a if k in b]
        size, key = max(moves, default=(0.0, ""))
        text = f"{key.strip('.')} {a[key]:g} -> {b[key]:g}" if size > SHOWN else ""
        changes.append(Change(claim.id, varied.holds, varied.holds != claim.holds, text))
    return changes


def numbers(figures: object, path: str) -> Iterator[tuple[str, float]]:
    """All numbers in nested figures with their path."""
    if isinstance(figures, dict):
        for key, value in figures.items():
            yield from numbers(value, f"{path}.{key}")
    elif isinstance(figures, (list, tuple)):
        for i, value in enumerate(figures):
            yield from numbers(value, f"{path}[{i}]")
    elif isinstance(figures, float):
        yield path, figures
