"""What may be the cause: the effects, found in their folder, and the faults of the measurement."""

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields

import numpy as np

from twintube.core import effects
from twintube.diagnosis.fit import Free, Problem
from twintube.identification.objective import FASTER, TABLE_6, TABLES_7_8

BASE = (*TABLE_6, *TABLES_7_8)  # the parameters that a bad calibration is sought in
OFFSET = 0.005  # of the largest force: zero of a good load cell
DELAY = 3e-4  # [s] what sampling leaves open
SHAPES = 2  # lengths, times and powers of a cause that are sought, the first in its file; the fit finds the others
SHARES = (0.003, 0.01, 0.03, 0.1, 0.3)  # of a strength's range, at which a search begins


@dataclass(frozen=True)
class Candidate:
    """One possible cause: its parameters, and those of them that are neutral while it is absent."""

    name: str
    title: str
    cause: str
    free: tuple[Free, ...]
    strength: tuple[str, ...]
    units: Mapping[str, str]
    fault: bool
    decides: str  # the measurement that tells it from its look-alikes


def nuisances(problem: Problem) -> tuple[Free, ...]:
    """What every measurement has: a small zero of the load cell and less than a sample of delay."""
    peak = max(case.peak for case in problem.cases)
    return (
        Free("force_offset", 0.0, -OFFSET * peak, OFFSET * peak),
        Free("channel_delay", 0.0, -DELAY, DELAY),
    )


def base(problem: Problem) -> tuple[Free, ...]:
    """The degradation parameters, from the given values."""
    table = {item.name: item.metadata for item in fields(effects.Parameters)}
    fastest = max(case.top_speed for case in problem.cases)
    found = []
    for name in BASE:
        low, high = table[name]["lower"], table[name]["upper"]
        if name == "v_cav":
            high = min(high, FASTER * fastest)
        start = min(max(getattr(problem.damper.parameters, name), low), high)
        found.append(Free(name, start, low, high))
    return tuple(found)


def candidates(problem: Problem) -> list[Candidate]:
    """All effects that do not act already, and the faults."""
    peak = max(case.peak for case in problem.cases)
    reach = max(float(np.abs(case.stroke).max()) for case in problem.cases)
    found = []
    for effect in effects.EFFECTS.values():
        if effect.acts(problem.damper.parameters):
            continue
        free = []
        for item in effect.parameters:
            meta = item.metadata
            low, high, start = meta["lower"], meta["upper"], meta["default"]
            if meta["unit"] == "m" and high > reach > low and item.name not in effect.strength:
                high, start = reach, 0.9 * reach  # a place within the stroke
            free.append(Free(item.name, start, low, high))
        units = {item.name: item.metadata["unit"] for item in effect.parameters}
        found.append(
            Candidate(effect.name, effect.title, effect.cause, tuple(free), effect.strength, units, False, effect.decides)
        )
    found.append(Candidate(
        "force_offset", "Zero of the load cell", "The force channel reads a constant beside the force.",
        (Free("force_offset", 0.0, -0.5 * peak, 0.5 * peak),), ("force_offset",), {"force_offset": "N"}, True,
        "the load cell read with the damper taken out",
    ))  # fmt: skip
    found.append(Candidate(
        "force_gain", "Calibration of the force channel", "The force channel reads all forces too large or too small.",
        (Free("force_gain", 1.0, 0.5, 2.0),), ("force_gain",), {"force_gain": "1"}, True,
        "the load cell checked with a known weight",
    ))  # fmt: skip
    found.append(Candidate(
        "channel_delay", "Delay between the channels", "Force and stroke are not recorded at the same time.",
        (Free("channel_delay", 0.0, -0.03, 0.03),), ("channel_delay",), {"channel_delay": "s"}, True,
        "a record of the friction alone at high frequency: only a delay shifts it",
    ))  # fmt: skip
    return found


def grid(candidate: Candidate, f: Free) -> list[float]:
    """Values from which to begin: a strength over its range with both signs, a length or time about its usual value.

    A power or a share begins at its low end too, which is a law of its own.
    """
    if f.name not in candidate.strength:
        near = [f.start, (f.low + f.start) / 2, (f.high * f.start) ** 0.5 if f.start > 0 else f.high / 2]
        near += [f.low] if candidate.units[f.name] == "1" else []
        return sorted({min(max(x, f.low), f.high) for x in near})
    sides = [(sign, side) for sign, side in ((1.0, f.high - f.start), (-1.0, f.start - f.low)) if side > 0]
    return [f.start + sign * share * side for share in SHARES for sign, side in sides]


def best_start(
    problems: Sequence[Problem], candidate: Candidate, fixed: Sequence[Mapping[str, float]]
) -> tuple[float, dict[str, float]]:
    """The point that explains the cases best, and their sum of squares there; one strength after another joins.

    `fixed` holds the other values in each of the problems.

    The zero of the load cell goes along: at the one of the model without the cause a residual spring would start as a loss.
    """
    zeros = [nuisances(problem)[0] for problem in problems]
    grids = {f.name: grid(candidate, f) for f in candidate.free}
    shapes = [f.name for f in candidate.free if f.name not in candidate.strength][:SHAPES]
    best, low = {f.name: f.start for f in candidate.free}, np.inf
    left = list(candidate.strength)
    while left:
        # Lengths and times are sought with the first strength only.
        others = itertools.product(*(grids[name] for name in shapes)) if len(left) == len(candidate.strength) else [()]
        some = [dict(zip(shapes, other, strict=False)) for other in others]
        points = [best | {name: x} | shape for name in left for x in grids[name] for shape in some]
        costs = [
            problem.costs([{**values, **point} for point in points], zero)
            for problem, values, zero in zip(problems, fixed, zeros, strict=True)
        ]
        scores = [sum(some) for some in zip(*costs, strict=True)]
        if min(scores) >= low:
            break
        point, low = points[int(np.argmin(scores))], min(scores)
        left = [name for name in left if point[name] == best[name]]
        best = point
    return float(low), best
