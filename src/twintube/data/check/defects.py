"""What a recorder or its load cell does to a force: arrays (n,) in, samples or figures out; nothing is changed.

    clipped      the force is cut at a limit
    dropped      single samples, or runs of an equal value, jump away and come back
    frozen       the force stands still while the stroke moves, and then jumps
    resolution   step and number of the levels that a channel takes
    unprepared   a harmonic record begins at the speed of its block

None of them needs a model of the damper.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array

Mask = NDArray[np.bool_]

# Clipping. A sine that is quantised has 2.4 times as many samples at its highest value as at the next.
AT_LIMIT = 1e-6  # of the limit: forces within it are equal; single precision keeps 6e-8
FEWEST_AT_LIMIT, LONGEST_AT_LIMIT = 8, 4  # samples at the limit in all, and in a row
ROUND_TOP = 100.0  # times AT_LIMIT: below a limit is nothing so near, below a round top nine times as much as in it
PILE = 5.0  # times the samples at any of the values next below
NEXT_BELOW = 10  # values
SLOW = 0.02  # of the largest speed: a force that is constant from there on is friction
SLOW_SHARE = 0.05  # of the samples at the limit that may be slower
# Dropouts
JUMP = 0.1  # of the force's spread
USUAL = 8.0  # times the change that nine of ten samples do not reach
LEVELS = 3.0  # steps of a coarse force that a jump must exceed
PER_CYCLE = 30  # samples: with fewer a single one may be the top of a narrow peak, and only zeros are told from it
NEARBY = 0.1  # of the stroke's range
SHORT = 5  # samples after which the force must be back where it was
FEW = 3  # of a kind in a record; more than that, and one in two cycles, are a property of the damper
# Frozen force
LEAST_FROZEN = 5  # samples
FROZEN = 5.0  # times the length that 99 of 100 runs of equal values do not exceed
MOVED = 0.01  # of the stroke's range
MISSED = 0.01  # of the force's spread: the jump at the end
# Levels
FEWEST_SAMPLES = 100
REPEATED = 0.5  # distinct values per sample: more are no levels
ROUNDING = 1e-6  # of the range: steps below it come from the unit's conversion
# Preconditioning
PREPARED = 0.8  # of the block's speed: a first cycle that is slower prepares for it


@dataclass(frozen=True)
class Clipped:
    """Limits of the force [N], None where it has none on that side, and the samples (n,) at them."""

    low: float | None
    high: float | None
    samples: Mask


def spread(values: Array) -> float:
    """The range without a hundredth at each end, which outliers cannot widen."""
    low, high = np.quantile(values, [0.01, 0.99])
    return float(high - low)


def runs(values: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """First and last sample of each run of equal values."""
    change = np.flatnonzero(np.diff(values) != 0)
    return np.append(0, change + 1), np.append(change, len(values) - 1)


def filled(begin: NDArray[np.int64], end: NDArray[np.int64], count: int) -> Mask:
    """The samples (count,) from each `begin` to its `end`."""
    edges = np.zeros(count + 1, dtype=np.int64)
    np.add.at(edges, begin, 1)
    np.add.at(edges, end + 1, -1)
    return np.cumsum(edges[:-1]) > 0


def cycle_starts(stroke: Array) -> NDArray[np.int64]:
    """Samples at which the stroke rises through the middle of its range, each after a way down below a tenth of it."""
    middle, half = (stroke.max() + stroke.min()) / 2, float(np.ptp(stroke)) / 2
    side = np.where(stroke > middle, 1, np.where(stroke < middle - 0.1 * half, -1, 0))
    known = np.flatnonzero(side)
    up = (side[known][1:] > 0) & (side[known][:-1] < 0)
    return known[1:][up]


def clipped(force: Array, speed: Array) -> Clipped:
    """Where the force piles up at its largest or smallest value, at `speed` (n,) [m/s] of the stroke, without sign."""
    limits: dict[int, float | None] = {1: None, -1: None}
    samples = np.zeros(len(force), dtype=bool)
    for sign in limits:
        values = sign * force
        limit = float(values.max())
        at = values >= limit - AT_LIMIT * abs(limit)
        if at.sum() < FEWEST_AT_LIMIT or at.all():
            continue
        begin, end = runs(at.astype(float))
        longest = int(np.max((end - begin + 1)[at[begin]]))
        _, counts = np.unique(values[~at], return_counts=True)
        rounded = values[~at] >= limit - ROUND_TOP * AT_LIMIT * abs(limit)
        piled = at.sum() >= PILE * counts[-NEXT_BELOW:].max() and at.sum() >= rounded.sum()
        if longest >= LONGEST_AT_LIMIT and piled and np.quantile(speed[at], SLOW_SHARE) > SLOW * speed.max():
            limits[sign] = sign * limit
            samples |= at
    return Clipped(limits[-1], limits[1], samples)


def dropped(force: Array, stroke: Array) -> Mask:
    """Samples at which the force jumps away and comes back at once, and runs at exactly 0 between two jumps."""
    begin, end = runs(force)
    inner = (begin > 0) & (end < len(force) - 1)
    begin, end = begin[inner], end[inner]
    size = spread(force)
    if not len(begin) or size == 0.0:
        return np.zeros(len(force), dtype=bool)
    steps = np.abs(np.diff(force))
    level = float(steps[steps > ROUNDING * size].min(initial=size))
    least = max(JUMP * size, USUAL * float(np.quantile(np.abs(np.diff(force, 2)), 0.9)) / 2, LEVELS * level)
    away, back = force[begin] - force[begin - 1], force[end + 1] - force[end]
    jumps = np.minimum(np.abs(away), np.abs(back))
    returned = (away * back < 0) & (np.abs(force[end + 1] - force[begin - 1]) < 0.5 * jumps) & (end - begin < SHORT)
    zero = (force[begin] == 0.0) & (end > begin)
    stays = (jumps > least) & zero
    alone = np.flatnonzero((jumps > least) & returned & ~zero)
    starts = cycle_starts(stroke)
    if len(starts) > 1 and np.median(np.diff(starts)) < PER_CYCLE:
        alone = alone[force[begin[alone]] == 0.0]
    if len(alone) > max(FEW, len(starts) / 2):
        alone = alone[:0]
    hit = np.append(np.flatnonzero(stays), [i for i in alone if unlike_others(force, stroke, int(begin[i]), jumps[i] / 2)])
    hit = hit.astype(np.int64)
    return filled(begin[hit], end[hit], len(force))


def unlike_others(force: Array, stroke: Array, at: int, far: float) -> bool:
    """Whether no sample of about this stroke and its direction comes within `far` [N] of the force at sample `at`.

    The narrow peaks of a damper that fills and empties come back in other cycles, if not at the very sample. A value that
    recurs exactly is that of a recorder.
    """
    rising = np.diff(stroke, append=stroke[-1]) > 0
    near = (np.abs(stroke - stroke[at]) < NEARBY * np.ptp(stroke)) & (rising == rising[at]) & (force != force[at])
    near[max(0, at - SHORT) : at + SHORT + 1] = False
    return not bool(np.any(np.abs(force[near] - force[at]) < far))


def frozen(force: Array, stroke: Array) -> Mask:
    """Runs of an equal force over which the stroke moves, and after which the force jumps."""
    begin, end = runs(force)
    lengths = end - begin + 1
    steps = np.abs(np.diff(force))
    if not steps.any():
        return np.zeros(len(force), dtype=bool)
    least = max(LEAST_FROZEN, FROZEN * float(np.quantile(lengths, 0.99)))
    after = np.minimum(end + 1, len(force) - 1)
    jump = max(MISSED * spread(force), FROZEN * float(np.median(steps[steps > 0])))
    hit = (lengths >= least) & (np.abs(stroke[end] - stroke[begin]) > MOVED * np.ptp(stroke))
    hit &= np.abs(force[after] - force[end]) > jump
    at = np.flatnonzero(hit)
    if len(at) > max(FEW, len(cycle_starts(stroke)) / 2):
        return np.zeros(len(force), dtype=bool)
    jumps = np.abs(force[after] - force[end])
    at = np.array([i for i in at if unlike_others(force, stroke, int(end[i]), jumps[i] / 2)], dtype=np.int64)
    return filled(begin[at] + 1, end[at], len(force))  # the first sample is a good one


def resolution(values: Array) -> tuple[float, int, float] | None:
    """Step between the levels that a channel takes, their number in its range, and its noise.

    None where it takes no levels. The noise holds that of the levels themselves, 0.29 steps.
    """
    levels = np.unique(values)
    if len(values) < FEWEST_SAMPLES or len(levels) < 2 or len(levels) > REPEATED * len(values):
        return None
    steps = np.diff(levels)
    span = float(levels[-1] - levels[0])
    step = float(steps[steps > ROUNDING * span].min(initial=span))
    noise = 1.4826 * float(np.median(np.abs(np.diff(values, 3)))) / np.sqrt(20.0)  # of white noise
    return step, round(span / step) + 1, noise


def unprepared(time: Array, stroke: Array) -> bool:
    """Whether the first cycle of an oscillation is as fast as the others: its record holds no slow ones before the block."""
    starts = cycle_starts(stroke)
    if len(starts) < 3:
        return False
    way = np.append(0.0, np.cumsum(np.abs(np.diff(stroke))))
    speeds = np.diff(way[starts]) / np.diff(time[starts])
    return bool(speeds[0] >= PREPARED * np.median(speeds[speeds >= PREPARED * speeds.max()]))
