"""A force channel that was smoothed after the measurement by a moving mean over the same share of every oscillation.

Such a mean takes out every harmonic k by |sinc(k share)|: the mean oscillation has zeros at the same numbers of harmonics at
every velocity, amplitude and frequency. No physics does that: what depends on stroke, velocity or time moves with them. A
model is then compared through the same mean.
"""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.fft import rfft
from scipy.integrate import cumulative_trapezoid
from scipy.optimize import lsq_linear

from twintube.arrays import Array
from twintube.identification.objective import Harmonic

LOOP = 1024  # phases of the mean oscillation
NYQUIST = 0.48  # of the sampling rate, up to which a harmonic counts
SHARES = np.geomspace(0.03, 0.3, 80)
MOST, LEAST = 40, 10  # odd harmonics of a record that are looked at, and that tell a zero from a chance
ZEROS = 2.2  # of the mean that must lie within them: one zero alone is made by many loops
ABOVE = 6.0  # amplitude relative to noise at which the harmonics of a record end, over four of them
BEHIND = 4
DEPTH = 0.03  # of a zero, as a share is never a whole number of samples
JUMP = -1.0  # no force falls more slowly with the harmonic than one that jumps
BETTER = 0.5  # log of the ratio of variances by which zeros must explain a record better than a smooth fall
AGREE, SAME = 3, 0.05  # records that must ask for one share, and how far apart theirs may be
APART = 1.2  # their velocities and their amplitudes: a knee of the F-v curve or a stop would be at one phase in all of them


@dataclass(frozen=True)
class Averaging:
    """What was seen: the share of an oscillation [1], and in how many of the records that could show it."""

    share: float
    seen: int
    of: int

    @property
    def text(self) -> str:
        """One sentence, without its full stop."""
        return (
            f"the force channel is a moving mean over {self.share:.3f} of each oscillation in {self.seen} of the {self.of} "
            "records with enough harmonics to show it: it was smoothed after the measurement"
        )


def spectrum(block: Harmonic) -> tuple[Array, Array, Array]:
    """Frequencies [Hz], amplitudes and their noise [N] of the harmonics (n,) of the mean oscillation."""
    t, marks = block.time, block.marks
    phase = np.arange(LOOP) / LOOP
    loops = [np.interp(t[a] + phase * (t[b] - t[a]), t, block.force) for a, b in itertools.pairwise(marks)]
    harmonics = rfft(np.array(loops), axis=1) * 2 / LOOP
    number = np.arange(1, int(min(LOOP, float(np.median(np.diff(marks)))) * NYQUIST))
    noise = np.sqrt(harmonics.var(axis=0) / (len(loops) - 1))
    return number / float(np.median(np.diff(t[marks]))), np.abs(harmonics.mean(axis=0))[number], noise[number]


def averaging(blocks: Sequence[Harmonic]) -> Averaging | None:
    """The share that AGREE records of different velocities and amplitudes each ask for; None where they do not."""
    found = [(one, block) for block in blocks if len(block.marks) > 3 and (one := asked(block)) is not None]
    clear = [(share, block) for (share, better), block in found if better > BETTER]
    groups = [[(s, block) for s, block in clear if abs(np.log(s / share)) < SAME] for share, _ in clear]
    alike = max(groups, key=len, default=[])
    if len(alike) < max(AGREE, len(found) / 2):
        return None
    for size in ([block.top_speed for _, block in alike], [float(np.ptp(block.stroke)) for _, block in alike]):
        if max(size) < APART * min(size):
            return None
    return Averaging(float(np.median([s for s, _ in alike])), len(alike), len(found))


def asked(block: Harmonic) -> tuple[float, float] | None:
    """The share that explains a record's odd harmonics best, and how much better than none; None where it has too few."""
    _, amplitude, noise = spectrum(block)
    number = np.arange(1, len(amplitude) + 1)
    odd = (number % 2 == 1) & (number >= 3)
    number, amplitude, noise = number[odd][:MOST], amplitude[odd][:MOST], np.maximum(noise[odd][:MOST], 1e-12)
    drowned = [bool(amplitude[i : i + BEHIND].max() < ABOVE * noise[i]) for i in range(len(number))]
    end = drowned.index(True) if True in drowned else len(number)
    if end < LEAST:
        return None
    number, logs = number[:end], np.log(np.maximum(amplitude, 2 * noise))[:end]
    shares = SHARES[SHARES * number[-1] > ZEROS]
    if not len(shares):
        return None
    left = [unexplained(number, logs - np.log(np.maximum(np.abs(np.sinc(number * x)), DEPTH))) for x in shares]
    return float(shares[int(np.argmin(left))]), float(np.log(unexplained(number, logs) / min(left)))


def unexplained(number: NDArray[np.int64], logs: Array) -> float:
    """Squared distance of log amplitudes (n,) from a smooth fall."""
    shape = np.column_stack([np.ones(len(number)), np.log(number), number])
    fit = lsq_linear(shape, logs, bounds=([-np.inf] * 3, [np.inf, JUMP, 0.0]))
    return float(2 * fit.cost) + 1e-12


def through(blocks: Sequence[Harmonic], found: Averaging) -> list[Harmonic]:
    """The records with the length [s] of their moving mean."""
    return [replace(block, averaged=found.share * period(block)) for block in blocks]


def period(block: Harmonic) -> float:
    """Duration [s] of an oscillation of the block."""
    return float(np.median(np.diff(block.time[block.marks])))


def averaged(time: Array, force: Array, window: float) -> Array:
    """Moving mean (n,) or (n, k) of what is sampled much more densely than the `window` [s]; shorter at both ends."""
    if window <= 0.0:
        return force
    if force.ndim > 1:
        return np.column_stack([averaged(time, column, window) for column in force.T])
    total = cumulative_trapezoid(force, time, initial=0.0)
    begin, end = (np.clip(time + side * window / 2, time[0], time[-1]) for side in (-1, 1))
    return np.asarray((np.interp(end, time, total) - np.interp(begin, time, total)) / (end - begin))


def averaged_means(time: Array, means: Array, window: float) -> Array:
    """The same for mean forces (n,) of the intervals that end at `time` (n,), as means of these intervals."""
    if window <= 0.0:
        return means
    step = np.maximum(np.diff(time), 1e-12)
    once = np.concatenate([[0.0], np.cumsum(means[1:] * step)])
    twice = np.concatenate([[0.0], np.cumsum((once[:-1] + once[1:]) / 2 * step)])

    def integral(t: Array) -> Array:
        i = np.clip(np.searchsorted(time, t, side="right") - 1, 0, len(time) - 2)
        x = t - time[i]
        return np.asarray(twice[i] + x * (once[i] + x * means[i + 1] / 2))

    found = np.diff(integral(time + window / 2) - integral(time - window / 2)) / window / step
    return np.concatenate([found[:1], found])
