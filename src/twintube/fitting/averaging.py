"""A force channel that was smoothed after the measurement by a moving mean over a fixed share of every oscillation.

Such a mean takes out every harmonic k by |sinc(k share)|: the mean oscillation has zeros at equal numbers of harmonics at
every velocity, amplitude and frequency. No physics does that: what depends on stroke, velocity or time moves with them. A
model is then compared through such a mean.
"""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.fft import rfft
from scipy.integrate import cumulative_trapezoid
from scipy.optimize import nnls

from twintube.common.arrays import Array
from twintube.fitting.harmonic import Harmonic
from twintube.fitting.rule import JUDGEMENT, METHOD, NUMERICS, Section

smoothed = Section("Fault: smoothed force (also used by identification)")
KNOWN = "false alarms in blind_trials, knowing mr_maurel"


@dataclass(frozen=True)
class Rules:
    """The thresholds; read `RULES`."""

    loop: int = smoothed(1024, "", "phases of the mean oscillation", NUMERICS)
    nyquist: float = smoothed(0.48, "1", "of the sampling rate, up to which a harmonic counts", JUDGEMENT)
    turns: int = smoothed(3, "", "oscillations that a record needs", JUDGEMENT)
    averaged_shares: tuple[float, float, int] = smoothed(
        (0.03, 0.3, 80), "1", "shares of an oscillation tried: from, to, number", KNOWN
    )
    most_harmonics: int = smoothed(40, "", "odd harmonics of a record that are looked at", KNOWN)
    least_harmonics: int = smoothed(10, "", "odd harmonics that tell a zero from chance", KNOWN)
    zeros_inside: float = smoothed(2.2, "1", "zeros that must lie within them: many loops have a single zero", KNOWN)
    above_noise: float = smoothed(6.0, "1", "amplitude relative to noise at which the harmonics of a record end", KNOWN)
    behind: int = smoothed(4, "", "neighbouring odd harmonics that must all be below it", KNOWN)
    depth: float = smoothed(0.03, "1", "depth of a zero, as a share is never a whole number of samples", KNOWN)
    jump_slope: float = smoothed(-1.0, "1", "power of the harmonic with which the spectrum of a jump falls", METHOD)
    better: float = smoothed(0.5, "1", "log ratio of variances by which zeros must beat a smooth fall", KNOWN)
    agree: int = smoothed(3, "", "records that must ask for equal shares", KNOWN)
    agree_share: float = smoothed(0.5, "1", "of the records that can show it, that must agree", KNOWN)
    alike: float = smoothed(0.05, "1", "log ratio up to which shares are equal", KNOWN)
    apart: float = smoothed(
        1.2, "1", "factor between velocities and between amplitudes: else a stop or a knee does it", KNOWN
    )


RULES = Rules()
SHARES = np.geomspace(*RULES.averaged_shares)
SHARES.flags.writeable = False


@dataclass(frozen=True)
class Averaging:
    """A moving mean: its share of an oscillation [1], the records that show it, and those that could."""

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
    """Frequencies [Hz], amplitudes and their noise [N] of the harmonics (n,) of the mean oscillation.

    The first and the last oscillation are left out where two others remain: they may hold the start and the stop of the
    machine, which of them and how much depends on the sign of the stroke.
    """
    t, marks = block.time, block.marks[1:-1] if len(block.marks) > RULES.turns + 1 else block.marks
    phase = np.arange(RULES.loop) / RULES.loop
    loops = [np.interp(t[a] + phase * (t[b] - t[a]), t, block.force) for a, b in itertools.pairwise(marks)]
    harmonics = rfft(np.array(loops), axis=1) * 2 / RULES.loop
    number = np.arange(1, int(min(RULES.loop, float(np.median(np.diff(marks)))) * RULES.nyquist))
    noise = np.sqrt(harmonics.var(axis=0) / (len(loops) - 1))
    return number / float(np.median(np.diff(t[marks]))), np.abs(harmonics.mean(axis=0))[number], noise[number]


def averaging(blocks: Sequence[Harmonic]) -> Averaging | None:
    """The share that several records of different velocities and amplitudes each ask for; None where they do not."""
    answers = [
        (answer, block) for block in blocks if len(block.marks) > RULES.turns and (answer := asked(block)) is not None
    ]
    clear = [(share, block) for (share, better), block in answers if better > RULES.better]
    groups = [[(s, block) for s, block in clear if abs(np.log(s / share)) < RULES.alike] for share, _ in clear]
    alike = max(groups, key=len, default=[])
    if len(alike) < max(RULES.agree, RULES.agree_share * len(answers)):
        return None
    for size in ([block.top_speed for _, block in alike], [float(np.ptp(block.stroke)) for _, block in alike]):
        if max(size) < RULES.apart * min(size):
            return None
    return Averaging(float(np.median([s for s, _ in alike])), len(alike), len(answers))


def asked(block: Harmonic) -> tuple[float, float] | None:
    """The share that explains a record's odd harmonics best, and by how much; None where there are too few harmonics."""
    _, amplitude, noise = spectrum(block)
    number = np.arange(1, len(amplitude) + 1)
    odd = (number % 2 == 1) & (number >= 3)
    number, amplitude, noise = (x[odd][: RULES.most_harmonics] for x in (number, amplitude, np.maximum(noise, 1e-12)))
    drowned = [bool(amplitude[i : i + RULES.behind].max() < RULES.above_noise * noise[i]) for i in range(len(number))]
    end = drowned.index(True) if True in drowned else len(number)
    if end < RULES.least_harmonics:
        return None
    number, logs = number[:end], np.log(np.maximum(amplitude, 2 * noise))[:end]
    shares = SHARES[SHARES * number[-1] > RULES.zeros_inside]
    if not len(shares):
        return None
    left = [unexplained(number, logs - np.log(np.maximum(np.abs(np.sinc(number * x)), RULES.depth))) for x in shares]
    return float(shares[int(np.argmin(left))]), float(np.log(unexplained(number, logs) / min(left)))


def unexplained(number: NDArray[np.int64], logs: Array) -> float:
    """Squared distance of log amplitudes (n,) from a smooth fall."""
    # About its mean, so that no constant is left; steeper than a jump's slope and than none by what is not negative.
    slopes = np.column_stack([np.log(number), number])
    slopes -= slopes.mean(axis=0)
    _, left = nnls(-slopes, logs - logs.mean() - RULES.jump_slope * slopes[:, 0])
    return float(left**2) + 1e-12


def through(blocks: Sequence[Harmonic], seen: Averaging) -> list[Harmonic]:
    """The records with the length [s] of their moving mean."""
    return [replace(block, averaged=seen.share * period(block)) for block in blocks]


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
    """The moving mean for mean forces (n,) of the intervals that end at `time` (n,), as means of these intervals."""
    if window <= 0.0:
        return means
    step = np.maximum(np.diff(time), 1e-12)
    once = np.concatenate([[0.0], np.cumsum(means[1:] * step)])
    twice = np.concatenate([[0.0], np.cumsum((once[:-1] + once[1:]) / 2 * step)])

    def integral(t: Array) -> Array:
        i = np.clip(np.searchsorted(time, t, side="right") - 1, 0, len(time) - 2)
        x = t - time[i]
        return np.asarray(twice[i] + x * (once[i] + x * means[i + 1] / 2))

    smooth = np.diff(integral(time + window / 2) - integral(time - window / 2)) / window / step
    return np.concatenate([smooth[:1], smooth])
