"""The motion between the samples of the stroke, which no record holds: a cubic spline, unless another explains the force."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import Akima1DInterpolator, CubicHermiteSpline, CubicSpline, PPoly, make_interp_spline
from scipy.ndimage import maximum_filter1d

from twintube.common.arrays import Array
from twintube.diagnosis.problem import Problem
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.rules import RULES
from twintube.fitting.strokes import quiet


def straight_sided(path: PPoly) -> PPoly:
    """The path through the same samples, about sharp turns with the slopes of Akima (1970): those of the straight side."""
    t, x = path.x, path(path.x)
    slopes = np.where(about_sharp_turns(t, x), Akima1DInterpolator(t, x)(t, 1), path(t, 1))
    return CubicHermiteSpline(t, x, slopes)


def about_sharp_turns(t: Array, x: Array) -> NDArray[np.bool_]:
    """Whether samples (n,) of a motion x(t) are near to where it turns from side to side within one or two of them."""
    side = np.diff(x) / np.diff(t)
    speed = np.abs(side)
    around = maximum_filter1d(speed, 2 * RULES.turn_reach + 1)
    fast = speed > RULES.sharp * np.maximum(around, RULES.sharp * speed.max())
    turns = np.zeros(len(x), dtype=bool)
    turns[1:-2] = (side[:-2] * side[2:] < 0.0) & fast[:-2] & fast[2:]
    return np.asarray(maximum_filter1d(turns, 2 * RULES.turn_reach + 1))


def between_samples(problem: Problem) -> Problem:
    """The problem with another smooth motion through the same samples of the stroke; at a sharp turn it differs."""
    return problem.with_records(
        [along(r, PPoly.from_spline(make_interp_spline(r.path.x, r.path(r.path.x), k=5))) for r in problem.records]
    )


def measured_again(problem: Problem, seed: int) -> Problem:
    """The problem with strokes as if measured once more, with noise of their size, of which smoothing leaves a part."""
    rng = np.random.default_rng(seed)
    records = []
    for record in problem.records:
        time = record.path.x
        noisy = record.path(time) + record.stroke_noise * rng.standard_normal(len(time))
        records.append(along(record, CubicSpline(time, quiet(time, noisy))) if record.stroke_noise > 0.0 else record)
    return problem.with_records(records)


def along(record: PreparedRecord, path: PPoly) -> PreparedRecord:
    """The record on another path of its stroke [m] over time [s]."""
    at, recorded = np.clip(record.time, path.x[0], path.x[-1]), record.time >= record.begin
    stroke, velocity = np.where(recorded, path(at), record.stroke), np.where(recorded, path(at, 1), record.velocity)
    return replace(record, path=path, stroke=stroke, velocity=velocity)
