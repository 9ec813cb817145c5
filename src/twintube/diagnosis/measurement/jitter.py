"""Jitter of the sampling: samples that were not taken at the times that the file states.

A stroke that moves on meanwhile is off by its speed times that, so that the forces show it at speed, as noise that is white
from sample to sample. The file does not hold it, and a slow part of the record does not show it.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.interpolate import CubicSpline

from twintube.common.arrays import Array
from twintube.diagnosis.measurement.edges import with_edges, with_noise
from twintube.diagnosis.measurement.motion import along
from twintube.diagnosis.problem import Problem
from twintube.diagnosis.rules import RULES
from twintube.fitting.strokes import quiet

MEDIAN = 0.455  # of the square of a normal error, whose variance is 1


def with_uncertainty(problem: Problem) -> Problem:
    """The problem with all that its forces are open by: noise, the model's own steps, jitter of the samples."""
    return with_jitter(with_edges(with_noise(problem)))


def with_jitter(problem: Problem) -> Problem:
    """The problem with what the jitter of its samples leaves open in the forces, as further `edges` of its records."""
    base = problem.simulated(problem.damping({}))[1]
    again = [jittered(problem, seed).simulate(problem.damping({}))[1] - base for seed in range(RULES.jitter_draws)]
    size = jitter(problem, again) / RULES.jitter_tried
    if size == 0.0:
        return problem
    change = size * np.sqrt(np.mean(np.square(again), axis=0))
    pairs = zip(problem.records, problem.starts[:-1], problem.starts[1:], strict=True)
    return problem.with_records([replace(r, edges=np.hypot(r.edges, change[a:b])) for r, a, b in pairs])


def jittered(problem: Problem, seed: int) -> Problem:
    """The problem with strokes whose samples are off by jitter of the size that is tried."""
    rng = np.random.default_rng(seed)
    records = []
    for record in problem.records:
        time = record.path.x
        late = RULES.jitter_tried * record.period * rng.standard_normal(len(time))
        records.append(along(record, CubicSpline(time, quiet(time, record.path(time) + late * record.path(time, 1)))))
    return problem.with_records(records)


def jitter(problem: Problem, again: Sequence[Array]) -> float:
    """Jitter [1, of a sample period] that the errors ask for, from what it changes in the forces in several draws (n,) [N].

    Second differences of neighbouring errors hold what is white. It is seen where it would be more than all other noise.
    What asks for more than `most_jitter` is something else, say a wrong clock: 0.
    """
    variance = np.where(problem.used, problem.sigma, np.inf) ** 2
    known = variance[:-2] + 4.0 * variance[1:-1] + variance[2:]
    asked = np.mean([np.diff(change, 2) ** 2 for change in again], axis=0) / RULES.jitter_tried**2
    errors = np.diff(problem.errors({}), 2) ** 2
    shown = np.isfinite(known) & (asked * RULES.jitter_tried**2 > known)
    if shown.sum() < RULES.jitter_least:
        return 0.0
    sizes = np.linspace(0.0, 2.0 * RULES.most_jitter, RULES.jitters)
    middle = [float(np.median(errors[shown] / (known[shown] + size**2 * asked[shown]))) for size in sizes]
    size = float(sizes[int(np.argmin(np.abs(np.subtract(middle, MEDIAN))))])
    return size if size <= RULES.most_jitter else 0.0
