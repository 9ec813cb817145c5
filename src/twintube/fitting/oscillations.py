"""The oscillations of a measured harmonic record: where they begin and end, without preconditioning and rests."""

import itertools
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from twintube.common.arrays import Array
from twintube.data import MEASURED, Record
from twintube.engine.simulate import InputError
from twintube.fitting.harmonic import Harmonic
from twintube.fitting.strokes import quiet

REST = 1.0  # a rest lasts at least so long [s] ...
STILL = 0.004  # ... with the stroke within this share of its range, less than a ramp of 1 mm/s goes
FAST_SHARE = 0.8  # oscillations of the measured block reach this share of the record's largest stroke per time
SMOOTHING = 100  # parts of an oscillation over which a velocity computed from the stroke is smoothed
HALF_WAY = 0.1  # share of the half range that the stroke must go below the middle between two beginnings


def segments(time: Array, stroke: Array) -> list[NDArray[np.int64]]:
    """The samples of each stretch between rests; a rest's first and last sample belong to its neighbours."""
    every = np.arange(len(time))
    window = int(REST / max(float(np.median(np.diff(time))), 1e-9)) // 2 * 2 + 1
    if window < 3 or window >= len(time):
        return [every]
    # Still is every sample of a window in which nothing moves, not only its middle.
    calm = maximum_filter1d(stroke, window) - minimum_filter1d(stroke, window) < STILL * np.ptp(stroke)
    inside = minimum_filter1d(maximum_filter1d(calm.astype(np.int8), window), 3).astype(bool)
    inside[[0, -1]] = False
    breaks = np.flatnonzero(np.diff(inside.astype(np.int8)))
    parts = np.split(every, breaks + 1)
    return [part for part in parts if not inside[part[0]] and len(part) > 2]


def beginnings(stroke: Array) -> NDArray[np.int64]:
    """The samples at which oscillations begin, rising through the middle of the range, and the last end."""
    middle, half = (stroke.max() + stroke.min()) / 2, float(np.ptp(stroke)) / 2
    if half == 0.0:
        return np.array([], dtype=np.int64)
    near = HALF_WAY * half
    side = np.where(stroke > middle + near, 1, np.where(stroke < middle - near, -1, 0))
    known = np.flatnonzero(side)
    rises: list[int] = []
    for low, high in itertools.pairwise(known.tolist()):
        if side[low] < 0 < side[high]:
            above = low + int(np.argmax(stroke[low : high + 1] > middle))
            # The nearer of the two samples around the crossing
            rises.append(above - 1 if abs(stroke[above - 1] - middle) < abs(stroke[above] - middle) else above)
    if abs(stroke[0] - middle) < near and side[known[0]] > 0:
        rises.insert(0, 0)
    if abs(stroke[-1] - middle) < near and side[known[-1]] < 0:
        rises.append(len(stroke) - 1)
    return np.array(rises, dtype=np.int64)


def slopes(time: Array, stroke: Array, at: NDArray[np.int64], reach: NDArray[np.int64]) -> Array:
    """Velocity (n,) [m/s] at the samples `at`: between the mean strokes of the `reach` samples before and after.

    A difference of neighbouring samples would turn micrometres of noise into velocities beyond the thresholds of foam.
    """
    last = len(time) - 1
    reach = np.maximum(1, np.minimum(reach, np.minimum(at, last - at)))
    low, high = np.maximum(at - reach, 0), np.minimum(at + reach, last)

    def mean(sums: Array, a: NDArray[np.int64], b: NDArray[np.int64]) -> Array:
        return np.asarray((sums[b + 1] - sums[a]) / (b + 1 - a), dtype=float)

    # Sums of long records lose the digits that a short window needs, unless they are of extended precision.
    totals = [np.concatenate([[0.0], np.cumsum(x.astype(np.longdouble))]) for x in (time - time[0], stroke)]
    ways = [mean(total, at, high) - mean(total, low, at) for total in totals]
    velocity: Array = ways[1] / np.maximum(ways[0], 1e-12)
    return velocity


def smooth_velocity(record: Record) -> Array:
    """The measured velocity, or else that of the stroke, smoothed over a hundredth of each oscillation."""
    if record.velocity_source == MEASURED:
        return record.velocity
    reach = np.ones(len(record.time), dtype=np.int64)
    for part in segments(record.time, record.stroke):
        for a, b in itertools.pairwise(beginnings(record.stroke[part]).tolist()):
            reach[part[a] : part[b] + 1] = max(1, (b - a) // (2 * SMOOTHING))
    return slopes(record.time, record.stroke, np.arange(len(reach)), reach)


def harmonic(record: Record) -> Harmonic:
    """The longest run of oscillations at the record's highest speed, with what was before it as a lead.

    Its stroke is without noise (strokes.py), and so is a velocity that comes from the stroke. Rests keep only their ends;
    what comes after the run is left out. Raises InputError where there is no full oscillation or the fill is unknown.
    """
    oil_level, gas_preload = record.fill
    recorded = record.stroke
    record = replace(record, stroke=quiet(record.time, recorded))
    parts = segments(record.time, record.stroke)
    kept = np.concatenate(parts)
    time, stroke, velocity, force = (x[kept] for x in (record.time, record.stroke, smooth_velocity(record), record.force))
    way = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(stroke)))])
    starts = np.cumsum([0, *(len(part) for part in parts)])
    marked = [beginnings(stroke[a:b]) + a for a, b in itertools.pairwise(starts)]
    speeds = [np.diff(way[marks]) / np.diff(time[marks]) for marks in marked]
    if not any(len(some) for some in speeds):
        raise InputError(f"{record.file}: no full oscillation, the stroke goes from {stroke.min():g} to {stroke.max():g} m")
    every = np.concatenate(speeds)
    # The median of the fast oscillations, as a single cycle may hold a gap or an outlier.
    usual = FAST_SHARE * np.median(every[every >= FAST_SHARE * every.max()])
    runs = []
    for marks, some in zip(marked, speeds, strict=True):
        for fast, group in itertools.groupby(range(len(some)), key=lambda i: bool(some[i] >= usual)):
            run = list(group)
            if fast:
                runs.append(marks[run[0] : run[-1] + 2])
    block = max(runs, key=len)
    end = int(block[-1]) + 1
    return Harmonic(
        oil_level=oil_level,
        gas_preload=float(gas_preload),
        time=time[:end],
        stroke=stroke[:end],
        velocity=velocity[:end],
        force=force[:end],
        marks=block,
        name=record.name,
        recorded=recorded[kept][:end],
        usable=record.usable[kept][:end],
        gas_pressure=record.gas_pressure if gas_preload else None,
    )
