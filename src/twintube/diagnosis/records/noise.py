"""Noise of mean forces: what does not repeat from oscillation to oscillation, else what intervals do not share."""

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.rules import RULES

SCATTER = 1.4826  # standard deviation of normal errors over their median absolute value
TINY = np.finfo(float).tiny
BEND = math.sqrt(6.0)  # standard deviation of a second difference over that of its values


def repeat_noise(force: Array, cycle: NDArray[np.int64], calm: NDArray[np.bool_]) -> float:
    """Standard deviation [N] of what does not repeat from oscillation to oscillation, slow trends apart.

    It is read where the force is `calm` (n,), with no step of the model's own.
    """
    numbers, counts = np.unique(cycle[cycle >= 0], return_counts=True)
    usual = int(np.median(counts)) if len(counts) else 0
    same = [cycle == i for i, n in zip(numbers, counts, strict=True) if n == usual]
    if len(same) < RULES.repeats:
        return 0.0
    apart = np.diff(np.array([force[own] for own in same]), 2, axis=0) / BEND
    return SCATTER * float(np.median(np.abs(apart[all_of_three(np.array([calm[own] for own in same]))])))


def all_of_three(calm: NDArray[np.bool_], apart: int = 1) -> NDArray[np.bool_]:
    """Whether all values (n, ...) of a second difference (n - 2 apart, ...) are calm; of all of them, where few are."""
    three = calm[2 * apart :] & calm[apart:-apart] & calm[: -2 * apart]
    return three if three.sum() >= RULES.calm_share * three.size else np.ones_like(three)


def averaging_noise(held: NDArray[np.int64], alike: float = 0.0) -> Array:
    """Noise of the mean force over intervals of `held` samples (n,), in units of that of a sample: the trapezoidal rule.

    `alike` is the correlation of neighbouring samples.
    """
    counts, of = np.unique(held, return_inverse=True)
    return np.sqrt([covariance(int(n), 0, alike) for n in counts])[of]


@lru_cache(8192)
def covariance(held: int, apart: int, alike: float) -> float:
    """Covariance of the means over two intervals of `held` samples, so many intervals apart: neighbours share a sample.

    In units of the variance of a sample; `alike` is the correlation of neighbouring samples.
    """
    if held > RULES.few_samples:
        summed = held - 0.5 if alike == 0.0 else held * (1.0 + alike) / (1.0 - alike)
        return alike ** (held * apart) * min(summed / held**2, 1.0)
    weight = np.full(held + 1, 1.0 / held)
    weight[[0, -1]] /= 2.0
    at = np.arange(held + 1)
    return float(weight @ alike ** np.abs(apart * held + at[:, None] - at) @ weight)


def bend_variance(held: int, apart: int, alike: float) -> float:
    """Variance of second differences of such means, so many intervals apart."""
    return 6.0 * covariance(held, 0, alike) - 8.0 * covariance(held, apart, alike) + 2.0 * covariance(held, 2 * apart, alike)


def neighbour_noise(force: Array, held: NDArray[np.int64], calm: NDArray[np.bool_], alike: float) -> float:
    """Standard deviation [N] of a sample from neighbouring intervals, for records without enough oscillations.

    It is read where the force is `calm` (n,); `alike` is the correlation of neighbouring samples.
    """
    if len(force) <= 2:
        return 0.0
    white = force / averaging_noise(held, alike)
    most = float(np.median(np.abs(white - np.median(white))))  # a model's errors are no smaller than their noise
    return SCATTER * min(bent(force, held, calm, 1, alike), most)


def bent(force: Array, held: NDArray[np.int64], calm: NDArray[np.bool_], apart: int, alike: float) -> float:
    """Median second difference [N] of means (n,) so many intervals apart, in units of what a sample's noise makes it."""
    counts, of = np.unique(held[apart:-apart], return_inverse=True)
    expected = np.sqrt([bend_variance(int(n), apart, alike) for n in counts])[of]
    bends = np.abs(force[2 * apart :] - 2.0 * force[apart:-apart] + force[: -2 * apart]) / expected
    return float(np.median(bends[all_of_three(calm, apart)]))


def correlation(force: Array, held: NDArray[np.int64], calm: NDArray[np.bool_], apart: tuple[int, int]) -> float:
    """Correlation of neighbouring samples of noise, seen in mean forces (n,) [N]; 0 where it is none.

    Second differences of neighbours and of intervals a number `apart` ask for the same noise with it, those further apart
    say whether it is noise: a model's error is smooth, and gains more.
    """
    if len(force) < RULES.coloured_least:
        return 0.0
    near, far = apart
    several = np.linspace(0.0, RULES.most_alike, 50) ** (1.0 / float(np.median(held)))
    gains = [bent(force, held, calm, near, c) / max(bent(force, held, calm, 1, c), TINY) for c in several.tolist()]
    best = int(np.argmin(np.abs(np.log(np.maximum(gains, TINY)))))
    alike = float(several[best])
    further = bent(force, held, calm, far, alike) / max(bent(force, held, calm, 1, alike), TINY)
    return 0.0 if max(gains[best], further) > RULES.smooth else alike


def colour(records: Sequence[PreparedRecord], forces: Sequence[Array]) -> float:
    """Correlation of neighbouring samples of noise, in forces (n,) [N] of each record: the channel has the same in all.

    Where oscillations repeat it only says what noise other intervals have. Where none does all noise is read with it, and
    next to what is left of the stroke's noise, which is white, it shows in intervals further apart.
    """
    own, counts = [], []
    for record, force in zip(records, forces, strict=True):
        whole = record.samples > 0
        if whole.sum() >= RULES.coloured_least:
            apart = RULES.coloured_repeated if repeating(record) else RULES.coloured_alone
            own.append(correlation(force[whole], record.samples[whole], calm(record)[whole], apart))
            counts.append(int(whole.sum()))
    return float(np.median(np.repeat(own, counts))) if own else 0.0  # the longer a record, the better it tells


def repeating(record: PreparedRecord) -> bool:
    """Whether a record has oscillations enough that are alike."""
    return any(len(alike) >= RULES.repeats for alike in likes(record))


def likes(record: PreparedRecord) -> list[NDArray[np.int64]]:
    """Numbers of oscillations that are alike in their samples and ranges, and so share noise."""
    held = np.maximum(record.samples, 1)
    left = np.unique(record.cycle[record.cycle >= 0])
    shape = {i: np.array([held[record.cycle == i].sum(), np.ptp(record.stroke[record.cycle == i])]) for i in left}
    groups = []
    while len(left):
        alike = np.array([bool(np.all(np.abs(np.log(shape[i] / shape[left[0]])) < np.log(RULES.alike_turns))) for i in left])
        groups.append(left[alike])
        alike[0] = True
        left = left[~alike]
    return groups


def calm(record: PreparedRecord) -> NDArray[np.bool_]:
    """The intervals (n,) in which the model's own steps leave less open than noise does."""
    return np.asarray(record.edges <= RULES.calm_edges * record.noise)


def noise(record: PreparedRecord, force: Array) -> Array:
    """Standard deviation [N] of the mean forces (n,) of a record's intervals, from what in a `force` (n,) does not repeat.

    Of a model's errors that is noise alone; a force itself is sampled at other phases in every oscillation. Oscillations of
    like duration and range share it; what belongs to none has that of the most common, by its number of samples.
    """
    cycle, held, quiet = record.cycle, np.maximum(record.samples, 1), calm(record)
    each = np.full(len(force), np.nan)
    most, common = 0, 0.0
    for alike in likes(record):
        inside = np.isin(cycle, alike)
        size = repeat_noise(force[inside], cycle[inside], quiet[inside])
        if size > 0.0:
            usual = round(float(np.median(held[inside])))
            sample = size / np.sqrt(covariance(usual, 0, record.colour))
            each[inside] = sample * averaging_noise(held[inside], record.colour)
            if len(alike) > most:
                most, common = len(alike), float(sample)
    if common == 0.0:
        whole = record.samples > 0
        common = neighbour_noise(force[whole], held[whole], quiet[whole], record.colour)
    # Errors of rounding are like in neighbouring samples where no noise is larger than the step. A model's hold them, too.
    rounding = record.resolution / np.sqrt(12.0) if common < record.resolution else 0.0
    rounding = min(rounding, SCATTER * float(np.median(np.abs(force - np.median(force)))))
    every = np.where(np.isnan(each), common * averaging_noise(held, record.colour), each)
    return np.hypot(every, max(rounding, RULES.least_noise * record.peak))
