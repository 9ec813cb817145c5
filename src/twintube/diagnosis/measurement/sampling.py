"""How the force was sampled: the delay, the zero and the filter that every measurement has, before anything else is judged.

A sample of the force may be a point, a mean over its interval or what a filter makes of it, and late by a part of it. Until
this is known a fast step of the force looks like noise, like a record that is odd, or like a cause.
"""

from collections.abc import Sequence

import numpy as np

from twintube.diagnosis.channels import nuisances, unfiltered, usual_delay
from twintube.diagnosis.problem import Free, Problem
from twintube.diagnosis.records.seen import DELAY
from twintube.diagnosis.rules import RULES


def with_sampling(problem: Problem) -> Problem:
    """The problem with delay, zero and samples of its force channel as most of its records have them, `usual`.

    A delay that only a filter would have is a cause where the force was not filtered.
    """
    known = problem.with_usual(sampling(problem))
    if unfiltered(known) and abs(known.usual[DELAY]) > usual_delay(known):
        return known.with_usual(sampling(known))
    return known


def sampling(problem: Problem) -> dict[str, float]:
    """Delay, zero and samples of the force channel as most records have them."""
    free = nuisances(problem)
    late = next(f for f in free if f.name == DELAY)
    linear = [f for f in free if f is not late]
    delays, step = np.linspace(late.low, late.high, RULES.delays_tried), (late.high - late.low) / RULES.delays_tried
    best: dict[str, float] = {}
    low = np.inf
    while step > RULES.sampling_known * late.high:
        points = [{DELAY: float(delay)} for delay in delays]
        list(problem.threads.map(problem.simulated, {problem.damping(point) for point in points}))
        for point in points:
            cost, values = filtered(problem, point, linear)
            if cost < low:
                low, best = cost, values
        delays = np.clip(best[DELAY] + step * np.array([-0.5, 0.5]), late.low, late.high)
        step /= 2.0
    return best


def filtered(problem: Problem, point: dict[str, float], free: Sequence[Free]) -> tuple[float, dict[str, float]]:
    """The values of `free`, linear in the force, that suit most records at the delay of `point`, and their cost.

    Misfits count by their logarithms, so that records of which the model knows nothing do not decide.
    """
    values = point
    for _ in range(RULES.sampling_rounds):
        values = problem.adjusted(values, free)
    misfit = problem.misfits(problem.residual(values))
    return float(np.average(np.log(RULES.least_misfit + misfit), weights=problem.counts)), values
