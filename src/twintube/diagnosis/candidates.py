"""What may be the cause: the effects of the catalogue and the faults of the measurement."""

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from twintube.core import effects
from twintube.diagnosis.fit import Free, Problem
from twintube.diagnosis.rules import RULES
from twintube.fitting.parameters import DEGRADATION, ranges

FAULT_TITLES = {
    "force_offset": "Zero of the load cell",
    "force_gain": "Calibration of the force channel",
    "channel_delay": "Delay between the channels",
}


@dataclass(frozen=True)
class Candidate:
    """A possible cause: its parameters, and those of them that are neutral while it is absent."""

    name: str
    title: str
    cause: str
    free: tuple[Free, ...]
    strength: tuple[str, ...]
    units: Mapping[str, str]
    fault: bool
    decides: str  # the measurement that tells it from its look-alikes
    laws: tuple[str, ...] = ()  # parameters whose lowest value is a law of its own


def nuisances(problem: Problem) -> tuple[Free, ...]:
    """What every measurement has: a small zero of the load cell and less than a sample of delay."""
    zero = RULES.small_zero * max(record.peak for record in problem.records)
    return (
        Free("force_offset", 0.0, -zero, zero),
        Free("channel_delay", 0.0, -RULES.small_delay, RULES.small_delay),
    )


def base(problem: Problem) -> tuple[Free, ...]:
    """The degradation parameters, in which a bad calibration is sought, from the given values."""
    limits = ranges(DEGRADATION, max(record.top_speed for record in problem.records)).tolist()
    free = []
    for name, (low, high) in zip(DEGRADATION, limits, strict=True):
        free.append(Free(name, min(max(getattr(problem.damper.parameters, name), low), high), low, high))
    return tuple(free)


def candidates(problem: Problem) -> list[Candidate]:
    """All effects that do not act already, and the faults."""
    peak = max(record.peak for record in problem.records)
    reach = max(float(np.abs(record.stroke).max()) for record in problem.records)
    several = []
    for effect in effects.EFFECTS.values():
        if effect.acts(problem.damper.parameters):
            continue
        free = []
        for item in effect.parameters:
            meta = item.metadata
            low, high, start = meta["lower"], meta["upper"], meta["default"]
            if meta["role"] == "place" and high > reach > low:
                high, start = reach, RULES.place * reach
            free.append(Free(item.name, start, low, high))
        units = {item.name: item.metadata["unit"] for item in effect.parameters}
        laws = tuple(item.name for item in effect.parameters if item.metadata["role"] == "law")
        several.append(
            Candidate(
                effect.name, effect.title, effect.cause, tuple(free), effect.strength, units, False, effect.decides, laws
            )
        )
    zero, late = RULES.zero_range * peak, RULES.delay_range
    several.append(Candidate(
        "force_offset", FAULT_TITLES["force_offset"], "The force channel reads a constant in addition to the force.",
        (Free("force_offset", 0.0, -zero, zero),), ("force_offset",), {"force_offset": "N"}, True,
        "the load cell read with the damper taken out",
    ))  # fmt: skip
    several.append(Candidate(
        "force_gain", FAULT_TITLES["force_gain"], "The force channel reads all forces too large or too small.",
        (Free("force_gain", 1.0, *RULES.gain_range),), ("force_gain",), {"force_gain": "1"}, True,
        "the load cell checked with a known weight",
    ))  # fmt: skip
    several.append(Candidate(
        "channel_delay", FAULT_TITLES["channel_delay"], "Force and stroke are not recorded simultaneously.",
        (Free("channel_delay", 0.0, -late, late),), ("channel_delay",), {"channel_delay": "s"}, True,
        "a record of the friction alone at high frequency: only a delay shifts it",
    ))  # fmt: skip
    return several


def grid(candidate: Candidate, f: Free) -> list[float]:
    """Values from which to begin: a strength over its range with both signs, a length or time near its usual value.

    A power or a share begins at its low end too, which is a law of its own.
    """
    if f.name not in candidate.strength:
        near = [f.start, (f.low + f.start) / 2, (f.high * f.start) ** 0.5 if f.start > 0 else f.high / 2]
        near += [f.low] if f.name in candidate.laws else []
        return sorted({min(max(x, f.low), f.high) for x in near})
    sides = [(sign, side) for sign, side in ((1.0, f.high - f.start), (-1.0, f.start - f.low)) if side > 0]
    return [f.start + sign * share * side for share in RULES.shares for sign, side in sides]


def best_start(
    problems: Sequence[Problem], candidate: Candidate, fixed: Sequence[Mapping[str, float]]
) -> tuple[float, dict[str, float]]:
    """The point that explains the records best, and their sum of squares there; strength after strength joins.

    `fixed` holds the other values in each of the problems. The zero of the load cell is free: at that of the model without
    the cause a residual spring would start as a loss.
    """
    zeros = [nuisances(problem)[0] for problem in problems]
    grids = {f.name: grid(candidate, f) for f in candidate.free}
    shapes = [f.name for f in candidate.free if f.name not in candidate.strength][: RULES.shapes]
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
