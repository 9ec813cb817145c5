"""From the fine steps to the samples of a file: mean, filter, clock, noise, zero, converter."""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import cumulative_trapezoid
from scipy.signal import butter, lfilter

from twintube.arrays import Array
from twintube.lab.challenge.plan import Bench, Sampling
from twintube.lab.challenge.run import Run

CUTOFF, ORDER = 0.4, 2  # anti-alias filter: of the sampling rate, Butterworth
FINER = 16  # steps of the filter in a sample
RANGE = 1.6  # of the converter over the largest value


@dataclass(frozen=True)
class Samples:
    """A record as the logger sees it, still without noise; (n,) each."""

    time: Array  # [s] from the start of the file
    stroke: Array
    force: Array
    velocity: Array
    temperature: Array | None


def taken(time: Array, values: Array, at: Array, fs: float, kind: str, late: bool) -> Array:
    """Values at the times `at` [s]: points, means over a sample interval, or behind the anti-alias filter."""
    if kind == "mean":
        total = cumulative_trapezoid(values, time, initial=0.0)
        ends = at if late else at + 0.5 / fs
        begins = np.maximum(ends - 1.0 / fs, time[0])
        ends = np.clip(ends, time[0] + 1e-9, time[-1])
        begins = np.minimum(begins, ends - 1e-9)
        return np.asarray((integral(ends, time, total, values) - integral(begins, time, total, values)) / (ends - begins))
    if kind == "filtered":
        grid = np.arange(time[0], time[-1] + 1.0 / fs, 1.0 / (FINER * fs))
        b, a = butter(ORDER, CUTOFF * 2.0 / FINER)
        first = values[0]
        filtered: Array = lfilter(b, a, np.interp(grid, time, values) - first) + first
        return np.interp(at, grid, filtered)
    return np.interp(at, time, values)


def integral(at: Array, time: Array, total: Array, values: Array) -> Array:
    """Integral of a piecewise straight signal up to the times `at`."""
    i = np.clip(np.searchsorted(time, at, side="right") - 1, 0, len(time) - 2)
    h = at - time[i]
    width = np.maximum(time[i + 1] - time[i], 1e-12)
    return np.asarray(total[i] + h * values[i] + 0.5 * h**2 * (values[i + 1] - values[i]) / width)


def sampled(run: Run, fs: float, sampling: Sampling, rng: np.random.Generator | None) -> Samples:
    """The samples of a finished run; without `rng` no jitter."""
    start, end = run.start, float(run.time[-1])
    nominal = np.arange(0.0, end - start - 0.5 / fs, 1.0 / fs)
    jitter = sampling.jitter / fs * rng.standard_normal(len(nominal)) if rng is not None else 0.0
    actual = nominal + jitter

    def channel(values: Array, clock: object, kind: str) -> Array:
        at = clock(actual) if callable(clock) else actual
        return taken(run.time, values, start + at, fs, kind, sampling.late)

    stroke = channel(run.stroke, run.stroke_time, sampling.kind if sampling.both else "point")
    force = channel(run.force, run.force_time, sampling.kind)
    velocity = channel(run.motion.velocity, run.stroke_time, "point")
    temperature = None if run.temperature is None else channel(run.temperature, None, "point")
    return Samples(nominal, stroke, force, velocity, temperature)


def coloured(rng: np.random.Generator, n: int, colour: float) -> Array:
    """Noise of variance 1, white or of first order."""
    white = rng.standard_normal(n)
    if colour == 0.0:
        return white
    return np.asarray(lfilter([np.sqrt(1.0 - colour**2)], [1.0, -colour], white))


def converted(values: Array, largest: float, bits: int) -> Array:
    """Values in the steps of a converter."""
    step = 2.0 * RANGE * largest / 2**bits
    return np.asarray(step * np.round(values / step))


def logged(samples: Samples, bench: Bench, sigma: float, largest: float, reach: float, rng: np.random.Generator) -> Samples:
    """The samples with noise of `sigma` [N], zero scatter and steps of the converter."""
    s = bench.sampling
    n = len(samples.time)
    peak = float(np.abs(samples.force).max())
    force = samples.force + sigma * coloured(rng, n, s.colour) + s.zero * peak * rng.uniform(-1, 1)
    stroke = samples.stroke + s.stroke_noise * rng.standard_normal(n)
    top = float(np.abs(samples.velocity).max())
    velocity = samples.velocity + 0.002 * top * rng.standard_normal(n)
    warm = samples.temperature
    if warm is not None:
        warm = np.round(warm + 0.1 * rng.standard_normal(n), 1)
    return Samples(
        samples.time, converted(stroke, reach, s.bits), converted(force, largest, s.bits), np.round(velocity, 5), warm
    )
