"""The zero of the load cell, which differs from record to record: how much, and whether a cause hides in the zeros.

A model that is wrong errs by means that change smoothly with the velocity, or that differ between the states of filling as
those of a preload do; zeros do neither.
"""

from collections.abc import Sequence

import numpy as np
from scipy.stats import kruskal

from twintube.arrays import Array
from twintube.diagnosis.fit import Problem
from twintube.diagnosis.prepare import BEND, SCATTER, PreparedRecord
from twintube.diagnosis.rules import RULES


def zero_drift(problem: Problem) -> tuple[Problem, list[str]]:
    """The problem with the scatter of the records' zeros in it, and a remark where a good load cell has less."""
    drift = scatter(problem.records, problem.means(problem.errors({}) * problem.weight))
    share = drift / max(record.peak for record in problem.records)
    size = f"about {drift:.2g} N, {100 * share:.2g} % of the largest force"
    text = f"the zero of the force channel differs from record to record by {size}; every comparison allows for it"
    return problem.with_drift(drift), [text] if share > RULES.small_zero else []


def states(records: Sequence[PreparedRecord]) -> list[list[int]]:
    """The numbers of the records of each state of filling, by velocity."""
    numbers: dict[tuple[float, int], list[int]] = {}
    for i in sorted(range(len(records)), key=lambda i: records[i].top_speed):
        numbers.setdefault((records[i].oil_level, records[i].gas_preload), []).append(i)
    return list(numbers.values())


def scatter(records: Sequence[PreparedRecord], means: Array) -> float:
    """Standard deviation [N] of the zeros from the mean errors (r,) [N] of the records; 0 where there are too few."""
    bent = np.concatenate([np.diff(means[some], 2) for some in states(records)])
    return SCATTER * float(np.median(np.abs(bent))) / BEND if len(bent) >= RULES.least_bends else 0.0


def step(records: Sequence[PreparedRecord], means: Array) -> float:
    """Largest difference [N] between two states of filling in the median of their records' mean errors (r,) [N]."""
    return float(np.ptp([np.median(means[some]) for some in states(records)]))


def differ(records: Sequence[PreparedRecord], means: Array, alarm: float) -> bool:
    """Whether the mean errors (r,) [N] differ between the states more than zeros do, at a rate of `alarm` (Kruskal-Wallis).

    Zeros that scatter do not depend on the filling. A difference that the model's numerics may make does not count.
    """
    if step(records, means) <= RULES.model_error * max(record.peak for record in records):
        return False
    return bool(kruskal(*(means[some] for some in states(records))).pvalue < alarm)
