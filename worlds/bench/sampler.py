"""From the fine steps to the samples of a file: mean, filter, clock, noise, converter."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import cumulative_trapezoid
from scipy.signal import butter, lfilter

from twintube.common.arrays import Array
from worlds.bench.plan import RNG

FINER = 16  # steps of the filter in a sample
RANGE = 1.6  # of the converter over the largest value


@dataclass(frozen=True)
class Recorder:
    """How channels become samples."""

    fs: float  # [Hz]
    kind: str  # point, mean, or filtered: Butterworth of second order against aliases
    corner: float = 0.4  # of the filter, of the rate
    both: bool = True  # the stroke as well; else it is read at points
    late: bool = False  # a mean is stamped at its end, not in its middle
    jitter: float = 0.0  # of the step, standard deviation


def taken(time: Array, values: Array, at: Array, recorder: Recorder, kind: str = "") -> Array:
    """Values (m,) at the times `at` [s] from fine steps (n,), as the recorder does, or as another `kind`."""
    kind, fs = kind or recorder.kind, recorder.fs
    if kind == "mean":
        total = cumulative_trapezoid(values, time, initial=0.0)
        ends = at if recorder.late else at + 0.5 / fs
        begins = np.maximum(ends - 1.0 / fs, time[0])
        ends = np.clip(ends, time[0] + 1e-9, time[-1])
        begins = np.minimum(begins, ends - 1e-9)
        return np.asarray((integral(ends, time, total, values) - integral(begins, time, total, values)) / (ends - begins))
    if kind == "filtered":
        grid = np.arange(time[0], time[-1] + 1.0 / fs, 1.0 / (FINER * fs))
        b, a = butter(2, recorder.corner * 2.0 / FINER)
        filtered: Array = lfilter(b, a, np.interp(grid, time, values) - values[0]) + values[0]
        return np.interp(at, grid, filtered)
    return np.interp(at, time, values)


def integral(at: Array, time: Array, total: Array, values: Array) -> Array:
    """Integral of a piecewise straight signal up to the times `at`."""
    i = np.clip(np.searchsorted(time, at, side="right") - 1, 0, len(time) - 2)
    h = at - time[i]
    width = np.maximum(time[i + 1] - time[i], 1e-12)
    return np.asarray(total[i] + h * values[i] + 0.5 * h**2 * (values[i + 1] - values[i]) / width)


def channels(
    time: Array, start: float, signals: list[tuple[Array, str, Callable[[Array], Array] | None]], recorder: Recorder,
    rng: RNG | None = None,
) -> list[Array]:  # fmt: skip
    """Nominal times (m,) from 0 and the samples (m,) of each signal: values, kind of sampling and clock, None is a true one.

    Without `rng` there is no jitter.
    """
    nominal = np.arange(0.0, time[-1] - start - 0.5 / recorder.fs, 1.0 / recorder.fs)
    actual = nominal + (recorder.jitter / recorder.fs * rng.standard_normal(len(nominal)) if rng is not None else 0.0)
    return [nominal, *(taken(time, values, start + (clock(actual) if clock else actual), recorder, kind)
                       for values, kind, clock in signals)]  # fmt: skip


def coloured(rng: RNG, n: int, memory: float) -> Array:
    """Noise (n,) of variance 1, white or of first order with `memory` from sample to sample."""
    white = rng.standard_normal(n)
    return white if memory == 0.0 else np.asarray(lfilter([np.sqrt(1.0 - memory**2)], [1.0, -memory], white))


def converted(values: Array, step: float) -> Array:
    """Values in the steps of a converter."""
    return np.asarray(step * np.round(values / step))


def step_of(largest: float, bits: int) -> float:
    """Step of a converter whose range holds the largest value well."""
    return float(2.0 * RANGE * largest / 2**bits)
