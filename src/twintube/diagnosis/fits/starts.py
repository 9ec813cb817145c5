"""Where the fit of a candidate begins: the best of many starts, seen in some of the records."""

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from twintube.diagnosis.fits.candidates import DELAYED, Candidate, linear, nuisances
from twintube.diagnosis.fits.fit import Free, Problem
from twintube.diagnosis.fits.grids import grids, lowest, moved
from twintube.diagnosis.records.seen import DELAY
from twintube.diagnosis.rules import RULES

Point = dict[str, float]  # values by name


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
) -> tuple[float, list[Point]]:
    """A simple point and the one that explains the records best, with the sum of squares there.

    In the latter strength after strength joins if it helps. One that does not is not in it: it stays neutral, as free it
    would follow the noise. The simple point has the first alone, or those of rebound and compression alike.

    `fixed` holds the other values in each of the problems. The measurement is free: at the zero of the model without the
    cause a residual spring would start as a loss, and behind the delay that stands in for a late effect it would not show.
    So that is sought without a delay, too: as far off as that its slope does not hold. `whole` has all records, of which the
    problems may have a part only.
    """
    search = Search(
        problems, candidate, fixed, measured(candidate.name, whole or problems[0]), grids(problems, candidate, fixed)
    )
    best, low = {f.name: f.start for f in candidate.free}, np.inf
    neutral = search.costs([best])[0]
    left = list(candidate.strength)
    points: list[Point] = []
    while left:
        shapes = search.shapes(first=len(left) == len(candidate.strength))
        tried, scores = search.strengths(best, neutral, left, shapes)
        if min(scores) >= (1.0 - RULES.joins) * low:
            break
        if not points:
            points += search.alike(best, shapes, min(scores))
        point = tried[int(np.argmin(scores))]
        left = [name for name in left if point[name] == best[name]]
        best, low = search.nearer(point, min(scores), [name for name in candidate.strength if name not in left])
        neutral = low
        points.append({name: x for name, x in best.items() if name not in left})
        if candidate.single:
            break
    last = {name: x for name, x in best.items() if name not in left}
    return float(low), [points[0], points[-1]] if len(points) > 1 else [last]


@dataclass(frozen=True)
class Search:
    """What a search for a start tries of a candidate, and what it costs; attributes as the arguments of `starts`."""

    problems: Sequence[Problem]
    candidate: Candidate
    fixed: Sequence[Mapping[str, float]]
    measurement: Sequence[Free]  # what of the measurement is free
    grids: Mapping[str, Sequence[float]]

    def costs(self, points: Sequence[Mapping[str, float]]) -> list[float]:
        """The sums of squares of points in all problems."""
        some = [
            problem.costs([{**values, **point} for point in points], values, self.measurement)
            for problem, values in zip(self.problems, self.fixed, strict=True)
        ]
        return [sum(cost) for cost in zip(*some, strict=True)]

    def shapes(self, *, first: bool) -> list[Point]:
        """Lengths and times: together with the first strength, then each by itself, as a stop has an onset of its own."""
        names = [f.name for f in self.candidate.free if f.name not in self.candidate.strength][: RULES.shapes]
        if not first:
            return [{}, *({name: x} for name in names for x in self.grids[name])]
        late = any(abs(problem.usual.get(DELAY, 0.0)) > 0.0 for problem in self.problems)
        together = itertools.product(*(self.grids[name] for name in names))
        several = [dict(zip(names, values, strict=True)) for values in together]
        return several + [{DELAY: 0.0}] * (late and self.candidate.name in DELAYED)

    def strengths(
        self, best: Point, neutral: float, left: Sequence[str], shapes: Sequence[Point]
    ) -> tuple[list[Point], list[float]]:
        """The points with one more strength of those `left`, and their costs; `best` so far costs `neutral`."""
        fewer = self.fewer_shapes(best, left, shapes)
        rows = [(name, x, shape) for name in left for x in self.grids[name] for shape in fewer[name]]
        tried = [best | {name: x} | shape for name, x, shape in rows]
        scores = self.costs(tried)
        # Else a strength between two values of its grid, or beyond, loses against a value of another's.
        for name in left:
            own = [i for i, row in enumerate(rows) if row[0] == name]
            for shape in fewer[name]:
                line = {best[name]: neutral} | {rows[i][1]: scores[i] for i in own if rows[i][2] == shape}
                tried += [best | shape | {name: x}] if (x := lowest(line)) not in line else []
            tried += self.factors(tried[min(own, key=lambda i: scores[i])], [name])
        return tried, scores + self.costs(tried[len(rows) :])

    def fewer_shapes(self, best: Point, left: Sequence[str], shapes: Sequence[Point]) -> dict[str, list[Point]]:
        """The shapes that are tried with each strength.

        A length or a power that belongs to another strength changes nothing: it need not be tried with this one.
        """
        rows = [(name, self.grids[name][len(self.grids[name]) // 2], shape) for name in left for shape in shapes]
        scores = self.costs([best | {name: x} | shape for name, x, shape in rows])
        seen = {(name, score): shape for (name, _, shape), score in zip(reversed(rows), reversed(scores), strict=True)}
        return {
            name: self.best_shapes(best, name, [shape for key, shape in seen.items() if key[0] == name]) for name in left
        }

    def best_shapes(self, best: Point, name: str, shapes: list[Point]) -> list[Point]:
        """Those of many `shapes` that explain most at a few values of a strength, in their order."""
        if len(shapes) <= RULES.shapes_kept:
            return shapes
        grid = self.grids[name]
        few = grid[RULES.shapes_coarse // 2 :: RULES.shapes_coarse] or grid
        costs = self.costs([{**best, name: x, **shape} for shape in shapes for x in few])
        scores = np.reshape(costs, (len(shapes), len(few)))
        kept = np.argsort(scores.min(axis=1), kind="stable")[: RULES.shapes_kept]
        return [shapes[i] for i in sorted(kept.tolist())]

    def nearer(self, point: Point, low: float, joined: Sequence[str]) -> tuple[Point, float]:
        """A point and its cost with the strengths that `joined` moved: at a wrong size others than the true one join it."""
        for _ in range(RULES.moves):
            tried = [near for name in joined for near in self.factors(point, [name])]
            scores = self.costs(tried)
            if min(scores, default=np.inf) >= (1.0 - RULES.joins) * low:
                break
            point, low = tried[int(np.argmin(scores))], min(scores)
        return point, low

    def alike(self, best: Point, shapes: Sequence[Point], singly: float) -> list[Point]:
        """The best point in which strengths of rebound and compression are alike; none where one `singly` costs less."""
        candidate = self.candidate
        sides: dict[str, list[Free]] = {}
        for f in candidate.free:
            if f.name in candidate.strength:
                sides.setdefault(f.name.removesuffix("_co").removesuffix("_re"), []).append(f)
        tried = [
            {f.name: min(max(x, f.low), f.high) for f in both} | shape
            for both in sides.values()
            if len(both) > 1
            for x in self.grids[both[0].name]
            for shape in shapes
        ]
        scores = self.costs([best | point for point in tried]) if tried else []
        if tried:  # a single strength is no better for being between the values of its grid
            nearer = self.factors(tried[int(np.argmin(scores))], candidate.strength)
            tried += nearer
            scores += self.costs([best | point for point in nearer])
        if not tried or min(scores) >= singly:
            return []
        least = tried[int(np.argmin(scores))]
        return [{name: x for name, x in {**best, **least}.items() if name in least or name not in candidate.strength}]

    def factors(self, point: Point, names: Sequence[str]) -> list[Point]:
        """The point with those of the `names` that it has smaller and larger by some factors."""
        free = [f for f in self.candidate.free if f.name in names and f.name in point]
        return [point | {f.name: moved(f, point[f.name], by) for f in free} for by in RULES.factors_tried]
