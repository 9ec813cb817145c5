"""The motion between the samples of the stroke, which no record holds: a cubic spline, unless another explains the force."""

from dataclasses import replace

import numpy as np
from scipy.interpolate import Akima1DInterpolator, CubicSpline, PPoly, make_interp_spline

from twintube.diagnosis.fit import Problem
from twintube.diagnosis.record import PreparedRecord
from twintube.fitting.strokes import quiet


def straight_sided(path: PPoly) -> PPoly:
    """The path through the same samples with the slopes of Akima (1970): those of the straight side at a sharp turn."""
    spline = Akima1DInterpolator(path.x, path(path.x))
    return PPoly(spline.c, spline.x)


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
