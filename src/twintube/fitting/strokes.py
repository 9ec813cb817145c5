"""The stroke of a record without its noise, for a friction that counts every reversal.

A Dahl element takes each sample of noise for a reversal, and 0.02 mm of it, of a usual transducer, rival the length over
which friction builds up. Each sample becomes the value of a local cubic over the widest window that differs from
narrower ones by no more than noise (the method of Lepski: Goldenshluger and Nemirovski, On spatially adaptive estimation of
nonparametric regression, 1997), so that a sharp reversal keeps its place. A vibration that goes on is kept by its
spectrum, where it is more than the error of a coarse channel. Between reversals beyond the noise the stroke goes one way.
"""

import itertools
import math
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.fft import irfft, rfft
from scipy.ndimage import uniform_filter1d
from scipy.optimize import isotonic_regression
from scipy.signal import oaconvolve, savgol_coeffs, savgol_filter

from twintube.common.arrays import Array
from twintube.data.check.defects import resolution

ORDER = 6  # of the differences that show noise: those of a sine with 50 samples per oscillation are below 1e-7 of it
LAGS = (1, 2, 4, 8, 16)  # samples between the values of a difference: filtered noise shows at some distance only
LEVEL_OFF = 1.6  # growth from lag to lag below which a difference is noise: motion grows by 2^6, white noise not at all
OVERTAKEN = 4.0  # the like from neighbours to the next, where growth from there on is ...
FASTER = 1.5  # ... so many times that: of motion alone it is the less the further apart, white noise hides motion near by
SMOOTHEST = 10.0  # times the difference of neighbours, to which that of noise grows: what grows more is a smooth motion
LEAST = 1e-7  # [m], or [s] of the times: noise below which nothing counts it
MOST = 0.01  # of the range: more is motion that is sampled too coarsely
SCATTER = 1.4826  # standard deviation of normal errors over their median absolute value
NARROWEST, WIDEST, GROWTH = 2, 4000, math.sqrt(2)  # half widths of the windows [samples]
BACK = 2  # windows of half the width are compared
DOUBT = 3.0  # squared difference of two windows that is more than noise, relative to that of noise
SURE = 1.0  # minus logarithm of the chance that noise alone has any frequency that is kept
NEIGHBOURS, FEWEST = 8, 64  # half widths over which it is averaged, and the least number of samples
REVERSAL = 3.0  # standard deviations of the noise that a reversal exceeds
AROUND = 9  # samples over which a velocity is computed
SHORTEST = 1e-9  # [s] sample period


def noise(stroke: Array) -> tuple[float, int]:
    """Standard deviation [m] of the noise of an evenly sampled stroke (n,) and the samples over which it is correlated.

    Zero where differences grow with the distance of the samples, as those of motion do. Rests at a single level of the
    channel hide the noise.
    """
    sizes = []
    changes = np.concatenate([[0], np.cumsum(np.diff(stroke) != 0.0)])
    for lag in LAGS:
        differences = stroke
        for _ in range(ORDER):
            differences = differences[lag:] - differences[:-lag]
        differences = differences[changes[ORDER * lag :] > changes[: -ORDER * lag]]
        if len(differences) < 2 * ORDER:
            break
        sizes.append(SCATTER * float(np.median(np.abs(differences))) / math.sqrt(math.comb(2 * ORDER, ORDER)))
    for lag, (near, far) in zip(LAGS, itertools.pairwise(sizes), strict=False):
        if near > SMOOTHEST * sizes[0]:
            break
        hidden = lag == LAGS[0] and far <= OVERTAKEN * near and FASTER * far * far < near * max(sizes[2:3], default=0.0)
        if hidden or far <= LEVEL_OFF * near:
            return (near, lag) if LEAST <= near <= MOST * float(np.ptp(stroke)) else (0.0, 1)
    return 0.0, 1


def quiet(time: Array, stroke: Array) -> Array:
    """The stroke (n,) [m] at its times (n,) [s] without noise; as it was where it has none."""
    if len(stroke) <= AROUND:
        return stroke
    # A sample that is late lies further along the stroke, which is no noise.
    late = time - smoothed(time, *noise(time))
    rates = [savgol_filter(x, AROUND, 2, deriv=1) for x in (stroke, time)]
    moved = np.asarray(late * rates[0] / np.maximum(rates[1], SHORTEST))
    size, lag = noise(stroke - moved)
    if size == 0.0:
        return stroke
    levels = resolution(stroke)
    rounding = levels[0] / math.sqrt(12.0) if levels else 0.0
    return one_way(smoothed(stroke - moved, size, lag, rounding) + moved, size)


@cache
def window(half: int) -> tuple[Array, float]:
    """Weights (2 half + 1,) of the value in the middle of a local cubic, and the noise that they leave [1]."""
    weights = np.asarray(savgol_coeffs(2 * half + 1, 3))
    return weights, float(np.sqrt(weights @ weights))


def half_widths(samples: int, lag: int) -> list[int]:
    """Half widths of the windows for a record of so many samples with noise correlated over `lag`, in rising order."""
    count = 1 + int(math.log(WIDEST / NARROWEST) / math.log(GROWTH))
    widths = {round(NARROWEST * lag * GROWTH**i) for i in range(count)}
    return sorted(half for half in widths if 4 * half < samples)


def smoothed(stroke: Array, size: float, lag: int, rounding: float = 0.0) -> Array:
    """The evenly sampled stroke (n,) [m] with noise of `size` [m], correlated over `lag` samples, taken out.

    `rounding` is the standard deviation [m] of the error of its levels, which a steady motion repeats.
    """
    if size == 0.0:
        return stroke
    middle = float(np.mean(stroke))  # taken off, as a convolution by blocks rounds relative to the largest value
    values, left = [stroke - middle], [1.0]
    chosen = np.zeros(len(stroke), dtype=np.int64)
    agree = np.ones(len(stroke), dtype=bool)
    for number, half in enumerate(half_widths(len(stroke), lag), start=1):
        weights, remains = window(half)
        inside = slice(half, len(stroke) - half)
        value = values[0].copy()
        value[inside] = oaconvolve(values[0], weights, mode="valid")
        values.append(value)
        left.append(min(1.0, remains * math.sqrt(lag)))
        narrow = max(0, number - BACK)
        apart = uniform_filter1d((value - values[narrow]) ** 2, max(FEWEST, NEIGHBOURS * half) + 1)
        agree[: inside.start] = agree[inside.stop :] = False
        agree &= apart <= DOUBT * size**2 * (left[narrow] ** 2 - left[number] ** 2)
        if not agree.any():
            break
        chosen[agree] = number
    smooth = np.take_along_axis(np.array(values), chosen[None], axis=0)[0]
    kept = repeated(values[0] - smooth, size, lag)
    return np.asarray(smooth + middle + (kept if np.std(kept) > rounding else 0.0))


def repeated(rest: Array, size: float, lag: int) -> Array:
    """What noise of `size` [m] does not explain in the rest (n,) of a stroke: a vibration of the rig goes on for long."""
    spectrum = rfft(rest)
    highest = np.log(len(spectrum)) + SURE  # relative to the mean power of noise, of so many frequencies
    spectrum[np.abs(spectrum) ** 2 <= highest * lag * size**2 * len(rest)] = 0.0
    return np.asarray(irfft(spectrum, len(rest)))


def turns(stroke: Array, least: float) -> list[int]:
    """The samples of all reversals by more than `least` [m], the first and the last sample included."""
    reversals, extreme, rising = [0], 0, 0
    for i, z in enumerate(stroke.tolist()):
        if (rising >= 0 and z > stroke[extreme]) or (rising <= 0 and z < stroke[extreme]):
            if rising == 0 and abs(z - stroke[0]) > least:
                rising = 1 if z > stroke[0] else -1
            if rising != 0:
                extreme = i
        elif rising != 0 and abs(z - stroke[extreme]) > least:
            reversals.append(extreme)
            extreme, rising = i, -rising
    return [*reversals, len(stroke) - 1]


def one_way(stroke: Array, size: float) -> Array:
    """The stroke (n,) [m] that goes one way between reversals beyond noise of `size` [m]: nearest in least squares."""
    straight = stroke.copy()
    for a, b in itertools.pairwise(turns(stroke, REVERSAL * size)):
        straight[a : b + 1] = isotonic_regression(stroke[a : b + 1], increasing=bool(stroke[b] >= stroke[a])).x
    return straight


def direction(stroke: Array, least: float) -> NDArray[np.bool_]:
    """Whether the stroke rises (n,), reversals by less than `least` [m] apart."""
    rising = np.zeros(len(stroke), dtype=bool)
    for a, b in itertools.pairwise(turns(stroke, least)):
        rising[a : b + 1] = stroke[b] > stroke[a]
    return rising
