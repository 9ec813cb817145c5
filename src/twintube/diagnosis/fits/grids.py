"""The values from which the search for a start of a candidate begins, and those between them."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.polynomial import Polynomial

from twintube.diagnosis.fits.candidates import MOVING, RECALIBRATE, Candidate
from twintube.diagnosis.fits.fit import Free, Problem
from twintube.diagnosis.records.seen import CARRIED, CLOCK
from twintube.diagnosis.rules import RULES


def grids(problems: Sequence[Problem], candidate: Candidate, fixed: Sequence[Mapping[str, float]]) -> dict[str, list[float]]:
    """The values of each free parameter of a candidate; arguments as of `starts`."""
    several = {f.name: grid(candidate, f) for f in candidate.free}
    if candidate.single:  # a step of the force comes or goes with some thousandths of the oil
        several |= {f.name: [x for size in fills(f.high) for x in (size, -size)] for f in candidate.free}
    if CLOCK in several:
        several[CLOCK] = clock_starts(problems, fixed)
    return several


def grid(candidate: Candidate, f: Free) -> list[float]:
    """Values from which to begin: a strength over its range with both signs, a length or time near its usual value.

    A power or a share begins at its low end too, which is a law of its own; a share at the other end as well. Half a share
    is tried of the first law only.
    """
    if f.name not in candidate.strength:
        if f.low < 0.0 < f.high:  # a place on either side
            return [float(x) for x in np.linspace(f.low, f.high, RULES.places + 2)[1:-1]]
        if f.name in candidate.laws[1:] and f.high == 1.0:
            return [f.low, f.high]
        near = [f.start, (f.low + f.start) / 2, (f.high * f.start) ** 0.5 if f.start > 0 else f.high / 2]
        near += ([f.low, f.high] if f.high == 1.0 or f.name == CARRIED else [f.low]) if f.name in candidate.laws else []
        return sorted({min(max(x, f.low), f.high) for x in near})
    sides = [(sign, side) for sign, side in ((1.0, f.high - f.start), (-1.0, f.start - f.low)) if side > 0]
    shares = np.geomspace(*RULES.shares_moving).tolist() if candidate.name in MOVING else RULES.shares
    shares = RULES.shares_calibration if candidate.name == RECALIBRATE else shares
    return [f.start + sign * share * side for share in shares for sign, side in sides]


def fills(most: float) -> list[float]:
    """Errors of a fill [1] up to `most`, to either side, from which a search begins."""
    fine, coarse, end = RULES.fills_tried
    near, far = np.arange(fine, end, fine), np.arange(end, most, coarse)
    return [*RULES.shares[:2], *near.tolist(), *far.tolist()]


def clock_starts(problems: Sequence[Problem], fixed: Sequence[Mapping[str, float]]) -> list[float]:
    """Errors of the clock that explain the records best, seen by moving the forces of the model without one.

    Over a long record a clock drifts by whole oscillations, so that there are many local optima.
    """
    clocks = np.linspace(-RULES.clock_range, RULES.clock_range, RULES.clocks)
    costs = np.zeros(len(clocks))
    for problem, values in zip(problems, fixed, strict=True):
        forces = problem.forces(values)
        for record, a, b in zip(problem.records, problem.starts[:-1], problem.starts[1:], strict=True):
            elapsed = np.maximum(record.time - record.begin, 0.0)
            weight, measured = (problem.weight * problem.share)[a:b], problem.measured[a:b]
            for i, clock in enumerate(clocks):
                moved = np.interp(record.time - clock * elapsed, record.time, forces[a:b])
                costs[i] += float(np.sum((weight * (moved - measured)) ** 2))
    inner = costs[1:-1]
    lowest = 1 + np.flatnonzero((inner <= costs[:-2]) & (inner <= costs[2:]))
    return [float(clocks[i]) for i in lowest[np.argsort(costs[lowest])][: RULES.clock_starts]] or [0.0]


def moved(f: Free, x: float, by: float) -> float:
    """A strength `by` times as far from doing nothing, within its range."""
    return min(max(f.start + by * (x - f.start), f.low), f.high)


def lowest(costs: Mapping[float, float]) -> float:
    """Where a parabola through the lowest of some costs and its two neighbours is lowest; the lowest at an end of them."""
    x = np.array(sorted(costs))
    y = np.array([costs[value] for value in x.tolist()])
    i = int(np.argmin(y))
    if not 0 < i < len(x) - 1:
        return float(x[i])
    slope = Polynomial.fit(x[i - 1 : i + 2], y[i - 1 : i + 2], 2).deriv()
    return float(slope.roots()[0]) if slope.degree() == 1 and slope.coef[1] > 0.0 else float(x[i])
