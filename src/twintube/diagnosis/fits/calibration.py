"""Other values of the degradation parameters, which interact: no search from a single parameter to the next gets there."""

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.optimize import differential_evolution

from twintube.arrays import Array
from twintube.diagnosis.fits.candidates import RECALIBRATE, Candidate, linear
from twintube.diagnosis.fits.fit import Free, Problem
from twintube.diagnosis.fits.starts import best_start
from twintube.diagnosis.rules import RULES
from twintube.fitting.parameters import DEGRADATION, ranges


def calibration(problem: Problem) -> Candidate:
    """Other values of the degradation parameters; those that do not help keep the given ones."""
    limits = ranges(DEGRADATION, max(record.top_speed for record in problem.records)).tolist()
    free = []
    for name, (low, high) in zip(DEGRADATION, limits, strict=True):
        given = min(max(getattr(problem.damper.parameters, name), low), high)
        free.append(Free(name, given, low, high, given))
    least = {f.name: RULES.acts * f.width for f in free}
    text = "Other values of the degradation parameters explain the records."
    return Candidate(RECALIBRATE, "Degradation parameters", text, tuple(free), DEGRADATION, {}, False, "", least)


def best_calibration(
    problems: Sequence[Problem], candidate: Candidate, fixed: Sequence[Mapping[str, float]]
) -> dict[str, float]:
    """The values that explain the records of all problems best, without those that hardly help.

    By differential evolution around where a search of parameter after parameter ends. `fixed` holds the other values in each
    of the problems; what of the measurement forces are linear in is free.
    """
    free = candidate.free
    given = {f.name: f.start for f in free}
    begin = given | best_start(problems, candidate, fixed)[1]
    measured = [linear(problem) for problem in problems]

    def costs(points: Sequence[Mapping[str, float]]) -> Array:
        some = [
            problem.costs([{**values, **point} for point in points], values, own)
            for problem, values, own in zip(problems, fixed, measured, strict=True)
        ]
        return np.sum(some, axis=0)  # type: ignore[no-any-return]

    rng = np.random.default_rng(1)
    result = differential_evolution(
        lambda x: costs([dict(zip(given, row, strict=True)) for row in x.T]),
        [(f.low, f.high) for f in free],
        strategy="currenttobest1bin",
        maxiter=RULES.generations,
        init=few_changed(rng, free, list(begin.values())),
        rng=rng,
        polish=False,
        tol=0.0,
        updating="deferred",
        vectorized=True,
    )
    best, low = dict(zip(given, result.x.tolist(), strict=True)), float(result.fun)
    # Free parameters that do not help follow the noise.
    while best:
        fewer = [{name: x for name, x in best.items() if name != left} for left in best]
        cost = costs([{**given, **point} for point in fewer])
        least = int(np.argmin(cost))
        if cost[least] > (1.0 + RULES.joins) * low:
            break
        best, low = fewer[least], min(low, float(cost[least]))
    return best


def few_changed(rng: np.random.Generator, free: Sequence[Free], begin: Sequence[float]) -> Array:
    """Points (n, k) with up to `most_changed` values drawn, the others in turn as given and as in `begin`, the first.

    Where all are drawn at once hardly any point explains more than the given values.
    """
    given, low, high = (np.array([getattr(f, name) for f in free]) for name in ("start", "low", "high"))
    points = np.array([begin, given] * (RULES.population * len(free) // 2))
    for point in points[1:]:
        drawn = rng.choice(len(free), int(rng.integers(1, RULES.most_changed + 1)), replace=False)
        point[drawn] = rng.uniform(low[drawn], high[drawn])
    return points
