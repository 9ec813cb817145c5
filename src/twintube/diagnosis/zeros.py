"""The zero of the load cell, which differs from record to record: how much, and whether a cause hides in the zeros.

A model that is wrong errs by means that change smoothly with the velocity, or that differ between the states of filling as
those of a preload do; zeros do neither.
"""

from collections.abc import Sequence

import numpy as np
from scipy.stats import kruskal

from twintube.arrays import Array
from twintube.diagnosis.candidates import OFFSET
from twintube.diagnosis.fit import NUMERICS, Problem
from twintube.diagnosis.prepare import Case

LEAST_BENDS = 3  # three records of neighbouring velocities each, from which the scatter of zeros is told


def zero_drift(problem: Problem) -> tuple[Problem, list[str]]:
    """The problem with the scatter of the records' zeros in it, and a remark where a good load cell has less."""
    drift = scatter(problem.cases, problem.means(problem.errors({}) * problem.weight))
    share = drift / max(case.peak for case in problem.cases)
    size = f"about {drift:.2g} N, {100 * share:.2g} % of the largest force"
    text = f"the zero of the force channel differs from record to record by {size}: put aside in every comparison"
    return problem.with_drift(drift), [text] if share > OFFSET else []


def states(cases: Sequence[Case]) -> list[list[int]]:
    """The numbers of the records of each state of filling, by velocity."""
    found: dict[tuple[float, int], list[int]] = {}
    for i in sorted(range(len(cases)), key=lambda i: cases[i].top_speed):
        found.setdefault((cases[i].oil_level, cases[i].preload), []).append(i)
    return list(found.values())


def scatter(cases: Sequence[Case], means: Array) -> float:
    """Standard deviation [N] of the zeros from the mean errors (r,) [N] of the records; 0 where there are too few."""
    bent = np.concatenate([np.diff(means[some], 2) for some in states(cases)])
    return 1.4826 * float(np.median(np.abs(bent))) / np.sqrt(6.0) if len(bent) >= LEAST_BENDS else 0.0


def step(cases: Sequence[Case], means: Array) -> float:
    """Largest difference [N] between two states of filling in the median of their records' mean errors (r,) [N]."""
    return float(np.ptp([np.median(means[some]) for some in states(cases)]))


def differ(cases: Sequence[Case], means: Array, alarm: float) -> bool:
    """Whether the mean errors (r,) [N] differ between the states more than zeros do, at a rate of `alarm` (Kruskal-Wallis).

    Zeros that scatter know nothing of the filling. A difference that the model's numerics may make does not count.
    """
    if step(cases, means) <= NUMERICS * max(case.peak for case in cases):
        return False
    return bool(kruskal(*(means[some] for some in states(cases))).pvalue < alarm)
