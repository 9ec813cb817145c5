"""The zero of the load cell, which differs from record to record: how much, and whether a cause hides in the zeros.

A model that is wrong errs by means that change smoothly with the velocity, or that differ between the states of filling as
those of a preload do; zeros do neither.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.stats import kruskal

from twintube.arrays import Array
from twintube.diagnosis.faults import Fault
from twintube.diagnosis.fit import Problem
from twintube.diagnosis.gains import bootstrap
from twintube.diagnosis.prepare import BEND, SCATTER, PreparedRecord
from twintube.diagnosis.rules import RULES


def zero_drift(problem: Problem) -> tuple[Problem, list[str]]:
    """The problem with the scatter of the records' zeros in it, and a remark where a good load cell has less."""
    means = problem.means(problem.errors({}) * problem.weight)
    drift = scatter(problem.records, means)
    drift = max(drift, own_zero(problem, means, RULES.usual_zeros * drift) / RULES.usual_zeros)
    share = drift / largest(problem.records)
    size = f"about {drift:.2g} N, {100 * share:.2g} % of the largest force"
    text = f"the zero of the force channel differs from record to record by {size}; every comparison allows for it"
    return problem.with_drift(drift), [text] if share > RULES.small_zero else []


def zero_change(problem: Problem) -> tuple[Fault | None, Problem]:
    """A zero that moves from record to record in the order of the dataset, at once or evenly, and the problem without it.

    What begins with the loss of oil is no zero, but maybe the force of gas, unless it pulls the rod in.
    """
    means = problem.means(problem.errors({}) * problem.weight)
    count = len(means)
    if count < RULES.order_least:
        return None, problem
    rest = float(np.sum((means - means.mean()) ** 2))
    order = np.arange(count) - (count - 1) / 2
    fits = {0: order * float(order @ means) / float(order @ order)}
    keys = [(record.oil_level, record.gas_preload) for record in problem.records]
    for cut in range(RULES.order_side, count - RULES.order_side + 1):
        same = keys[cut] == keys[cut - 1]
        if same or not (problem.records[cut].intact or problem.records[cut - 1].intact) or pulled_in(problem, means):
            side = np.arange(count) >= cut
            fits[cut] = np.where(side, means[side].mean(), means[~side].mean()) - means.mean()
    left = {cut: float(np.sum((means - means.mean() - fit) ** 2)) for cut, fit in fits.items()}
    cut = min(left, key=lambda cut: left[cut])
    size = float(fits[cut][0] - fits[cut][-1])  # errors are simulated less measured forces
    if left[cut] > RULES.order_left * rest or abs(size) < RULES.small_force * largest(problem.records):
        return None, problem
    # In each state of several records the zero must move as in all.
    for some in states(problem.records):
        fit, own = (x[some] - x[some].mean() for x in (fits[cut], means))
        if np.ptp(fits[cut][some]) > 0.0 and np.sum((own - fit) ** 2) > RULES.order_state * np.sum(own**2):
            return None, problem
    # A zero is the same in rebound and compression; a damper that is weaker in one more than in the other has a mean, too.
    both = by_direction(problem)
    apart = both - both.mean(axis=0)
    if np.sum((apart - fits[cut][:, None]) ** 2) > RULES.order_state * np.sum(apart**2):
        return None, problem
    shift = fits[cut] - fits[cut][0]
    still = problem.with_records(
        [replace(r, force=r.force + x) for r, x in zip(problem.records, shift.tolist(), strict=True)]
    )
    before, after = (np.add.reduceat(some.residual({}) ** 2, some.starts[:-1]) for some in (problem, still))
    if bootstrap(np.column_stack([before - after, before]))[0] <= 0.0:
        return None, problem  # the means of a damper that is weaker, or of records that hardly count
    if cut == 0:
        text = "The zero of the force channel moves evenly from the first record to the last."
        return Fault("zero_drift", "Drifting zero of the load cell", text, size, "zero_moved", "N"), still
    names = tuple(record.name for record in problem.records[cut:])
    text = f"From {names[0]} on the force channel reads a constant that the records before do not have."
    return Fault("force_offset", "Zero of the load cell", text, size, "force_offset", "N", names), still


def pulled_in(problem: Problem, means: Array) -> bool:
    """Whether the model is right while intact, and a constant pulls the rod in without preload: no gas does that."""
    intact = np.array([record.intact for record in problem.records])
    if not 0 < intact.sum() < len(intact):
        return False
    right = float(means[intact].mean())
    return abs(right) < RULES.order_intact * (right - float(means[~intact].mean()))


def by_direction(problem: Problem) -> Array:
    """Mean errors (r, 2) [N] of the model as given in rebound and compression."""
    errors, columns = problem.errors({}), []
    rising = np.concatenate([record.velocity > 0.0 for record in problem.records])
    for some in (rising, ~rising):
        power = np.where(some, problem.weight**2, 0.0)
        pulled, sums = (np.add.reduceat(x, problem.starts[:-1]) for x in (power * errors, power))
        columns.append(pulled / np.maximum(sums, np.finfo(float).tiny))
    return np.column_stack(columns)


def largest(records: Sequence[PreparedRecord]) -> float:
    """Largest force [N] of all records."""
    return max(record.peak for record in records)


def states(records: Sequence[PreparedRecord]) -> list[list[int]]:
    """The numbers of the records of each state of filling, by velocity."""
    numbers: dict[tuple[float, int], list[int]] = {}
    for i in sorted(range(len(records)), key=lambda i: records[i].top_speed):
        numbers.setdefault((records[i].oil_level, records[i].gas_preload), []).append(i)
    return list(numbers.values())


def own_zero(problem: Problem, means: Array, usual: float) -> float:
    """Size [N] of a zero beyond the `usual` that a single record of its state has; 0 where there is none.

    A good load cell may have it, and apart from it the record is explained.
    """
    squares = (problem.errors({}) - problem.spread(means)) ** 2 * problem.weight**2
    left = np.add.reduceat(squares, problem.starts[:-1]) / np.maximum(problem.counts, 1)
    far = np.flatnonzero(np.abs(means) > usual)
    if len(far) != 1 or abs(means[far[0]]) > RULES.small_zero * largest(problem.records) or left[far[0]] > RULES.odd_right:
        return 0.0
    like = next(some for some in states(problem.records) if far[0] in some)
    return float(abs(means[far[0]])) if len(like) >= RULES.repeats else 0.0


def scatter(records: Sequence[PreparedRecord], means: Array) -> float:
    """Standard deviation [N] of the zeros from the mean errors (r,) [N] of the records; 0 where there are too few.

    A single record far from all others, say of another damper, does not make their zeros scatter.
    """
    every, at = scatter_of(records, means), range(len(means))
    others = [scatter_of([r for k, r in enumerate(records) if k != i], np.delete(means, i)) for i in at if len(at) > 2]
    least = min(others, default=every)
    return least if least < RULES.odd_zero * every else every


def scatter_of(records: Sequence[PreparedRecord], means: Array) -> float:
    """The like, whichever records there are."""
    several = states(records)
    bent = np.concatenate([np.diff(means[some], 2) for some in several])
    if len(bent) >= RULES.least_bends:
        return SCATTER * float(np.median(np.abs(bent))) / BEND
    # Few records tell zeros from a smooth error no better than by their scatter, of which a good load cell has little.
    apart = np.concatenate([means[some] - means[some].mean() for some in several])
    free = max(1, len(means) - len(several))
    most = RULES.small_zero * largest(records)
    return min(most, float(np.sqrt(np.sum(apart**2) / free)))


def step(records: Sequence[PreparedRecord], means: Array) -> float:
    """Largest difference [N] between two states of filling in the median of their records' mean errors (r,) [N]."""
    return float(np.ptp([np.median(means[some]) for some in states(records)]))


def differ(records: Sequence[PreparedRecord], means: Array, alarm: float) -> bool:
    """Whether the mean errors (r,) [N] differ between the states more than zeros do, at a rate of `alarm` (Kruskal-Wallis).

    Zeros that scatter do not depend on the filling. A difference that the model's numerics may make does not count.
    """
    if step(records, means) <= RULES.model_error * largest(records):
        return False
    return bool(kruskal(*(means[some] for some in states(records))).pvalue < alarm)
