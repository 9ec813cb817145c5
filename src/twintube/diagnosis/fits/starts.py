"""Where the fit of a candidate begins: the best of many starts, seen in some of the records."""

import itertools
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.polynomial import Polynomial

from twintube.diagnosis.fits.candidates import DELAYED, MOVING, RECALIBRATE, Candidate, linear, nuisances
from twintube.diagnosis.fits.fit import Free, Problem
from twintube.diagnosis.records.seen import CARRIED, CLOCK, DELAY
from twintube.diagnosis.rules import RULES


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


def measured(name: str, whole: Problem) -> tuple[Free, ...]:
    """What of the measurement is free where a candidate begins."""
    return (nuisances if name in DELAYED else linear)(whole)


def start_cost(
    problems: Sequence[Problem], point: Mapping[str, float], fixed: Sequence[Mapping[str, float]], free: Sequence[Free]
) -> float:
    """The sum of squares of a point in all problems, `free` of the measurement; `fixed` are the other values in each."""
    pairs = zip(problems, fixed, strict=True)
    return sum(problem.costs([{**values, **point}], values, free)[0] for problem, values in pairs)


def best_start(
    problems: Sequence[Problem],
    candidate: Candidate,
    fixed: Sequence[Mapping[str, float]],
    whole: Problem | None = None,
) -> tuple[float, dict[str, float]]:
    """The point that explains the records best, and their sum of squares there; arguments as of `starts`."""
    low, points = starts(problems, candidate, fixed, whole)
    return low, points[-1]


def starts(
    problems: Sequence[Problem],
    candidate: Candidate,
    fixed: Sequence[Mapping[str, float]],
    whole: Problem | None = None,
) -> tuple[float, list[dict[str, float]]]:
    """A simple point and the one that explains the records best, with the sum of squares there.

    In the latter strength after strength joins if it helps. One that does not is not in it: it stays neutral, as free it
    would follow the noise. The simple point has the first alone, or those of rebound and compression alike.

    `fixed` holds the other values in each of the problems. The measurement is free: at the zero of the model without the
    cause a residual spring would start as a loss, and behind the delay that stands in for a late effect it would not show.
    So that is sought without a delay, too: as far off as that its slope does not hold. `whole` has all records, of which the
    problems may have a part only.
    """
    free = measured(candidate.name, whole or problems[0])
    stands_in = candidate.name in DELAYED and any(abs(problem.usual.get(DELAY, 0.0)) > 0.0 for problem in problems)
    grids = {f.name: grid(candidate, f) for f in candidate.free}
    if candidate.single:  # a step of the force comes or goes with some thousandths of the oil
        grids |= {f.name: [x for size in fills(f.high) for x in (size, -size)] for f in candidate.free}
    if CLOCK in grids:
        grids[CLOCK] = clock_starts(problems, fixed)
    shapes = [f.name for f in candidate.free if f.name not in candidate.strength][: RULES.shapes]
    best, low = {f.name: f.start for f in candidate.free}, np.inf
    points: list[dict[str, float]] = []

    def costs(points: Sequence[Mapping[str, float]]) -> list[float]:
        some = [
            problem.costs([{**values, **point} for point in points], values, free)
            for problem, values in zip(problems, fixed, strict=True)
        ]
        return [sum(cost) for cost in zip(*some, strict=True)]

    by_name = {f.name: f for f in candidate.free}
    neutral = costs([best])[0]
    left = list(candidate.strength)
    while left:
        # Lengths and times are sought together with the first strength, then each by itself: a stop has an onset of its own.
        every = itertools.product(*(grids[name] for name in shapes))
        some = [dict(zip(shapes, other, strict=True)) for other in every] + [{DELAY: 0.0}] * stands_in
        if len(left) < len(candidate.strength):
            some = [{}, *({name: x} for name in shapes for x in grids[name])]
        # A length or a power that belongs to another strength changes nothing: it need not be tried with this one.
        rows = [(name, grids[name][len(grids[name]) // 2], shape) for name in left for shape in some]
        scores = costs([best | {name: x} | shape for name, x, shape in rows])
        seen = {(name, score): shape for (name, _, shape), score in zip(reversed(rows), reversed(scores), strict=True)}
        fewer = {name: [shape for key, shape in seen.items() if key[0] == name] for name in left}
        fewer = {name: best_shapes(best, name, grids[name], several, costs) for name, several in fewer.items()}
        rows = [(name, x, shape) for name in left for x in grids[name] for shape in fewer[name]]
        tried = [best | {name: x} | shape for name, x, shape in rows]
        scores = costs(tried)
        # Else a strength between two values of its grid, or beyond, loses against a value of another's.
        for name in left:
            own = [i for i, row in enumerate(rows) if row[0] == name]
            for shape in fewer[name]:
                line = {best[name]: neutral} | {rows[i][1]: scores[i] for i in own if rows[i][2] == shape}
                tried += [best | shape | {name: x}] if (x := lowest(line)) not in line else []
            top = tried[min(own, key=lambda i: scores[i])]
            tried += [top | {name: moved(by_name[name], top[name], by)} for by in RULES.factors_tried]
        scores += costs(tried[len(rows) :])
        if min(scores) >= (1.0 - RULES.joins) * low:
            break
        if not points:
            points += alike(candidate, best, some, grids, costs, min(scores))
        point, low = tried[int(np.argmin(scores))], min(scores)
        left = [name for name in left if point[name] == best[name]]
        # At a wrong size of the first strength another than the true one joins it.
        for _ in range(RULES.moves):
            joined = [name for name in candidate.strength if name not in left]
            nearer = [point | {n: moved(by_name[n], point[n], by)} for n in joined for by in RULES.factors_tried]
            scores = costs(nearer)
            if min(scores, default=np.inf) >= (1.0 - RULES.joins) * low:
                break
            point, low = nearer[int(np.argmin(scores))], min(scores)
        best, neutral = point, low
        points.append({name: x for name, x in best.items() if name not in left})
        if candidate.single:
            break
    last: dict[str, float] = {name: x for name, x in best.items() if name not in left}
    return float(low), [points[0], points[-1]] if len(points) > 1 else [last]


def best_shapes(
    best: Mapping[str, float],
    name: str,
    grid: Sequence[float],
    shapes: list[dict[str, float]],
    costs: Callable[[Sequence[Mapping[str, float]]], list[float]],
) -> list[dict[str, float]]:
    """Those of many `shapes` that explain most at a few values of a strength's `grid`, in their order."""
    if len(shapes) <= RULES.shapes_kept:
        return shapes
    few = grid[RULES.shapes_coarse // 2 :: RULES.shapes_coarse] or grid
    scores = np.reshape(costs([{**best, name: x, **shape} for shape in shapes for x in few]), (len(shapes), len(few)))
    kept = np.argsort(scores.min(axis=1), kind="stable")[: RULES.shapes_kept]
    return [shapes[i] for i in sorted(kept.tolist())]


def alike(
    candidate: Candidate,
    best: Mapping[str, float],
    shapes: Sequence[Mapping[str, float]],
    grids: Mapping[str, Sequence[float]],
    costs: Callable[[Sequence[Mapping[str, float]]], list[float]],
    singly: float,
) -> list[dict[str, float]]:
    """The best point in which strengths of rebound and compression are alike; none where one `singly` costs less."""
    sides: dict[str, list[Free]] = {}
    for f in candidate.free:
        if f.name in candidate.strength:
            sides.setdefault(f.name.removesuffix("_co").removesuffix("_re"), []).append(f)
    tried = [
        {f.name: min(max(x, f.low), f.high) for f in both} | dict(shape)
        for both in sides.values()
        if len(both) > 1
        for x in grids[both[0].name]
        for shape in shapes
    ]
    scores = costs([{**best, **point} for point in tried]) if tried else []
    if tried:  # a single strength is no better for being between the values of its grid
        top = tried[int(np.argmin(scores))]
        by_name = {f.name: f for f in candidate.free if f.name in candidate.strength}
        nearer = [{n: moved(by_name[n], x, by) if n in by_name else x for n, x in top.items()} for by in RULES.factors_tried]
        tried += nearer
        scores += costs([{**best, **point} for point in nearer])
    if not tried or min(scores) >= singly:
        return []
    least = tried[int(np.argmin(scores))]
    return [{name: x for name, x in {**best, **least}.items() if name in least or name not in candidate.strength}]


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
