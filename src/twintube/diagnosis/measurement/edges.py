"""What the model's own steps leave open: where a force steps, and at the edge between two states of filling.

A step of the force falls anywhere between two samples. And where the gas just reaches the valve, a fill or a velocity that
is off by a thousandth makes another oscillation of it. Neither tells anything about a cause.
"""

from copy import copy
from dataclasses import replace

import numpy as np

from twintube.common.arrays import Array
from twintube.diagnosis.channels import period
from twintube.diagnosis.measurement.history import logs
from twintube.diagnosis.measurement.motion import along, between_samples, measured_again, straight_sided
from twintube.diagnosis.problem import Problem
from twintube.diagnosis.records.noise import colour, noise
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.records.seen import BENDS, DELAY, SAMPLING, STROKE_GAIN
from twintube.diagnosis.rules import RULES
from twintube.fitting.simulation import MARGIN


def with_motion(problem: Problem) -> Problem:
    """The problem with another motion between the samples of those records that it explains far better.

    Where a rig turns within a sample, a cubic spline swings on: its speed is wrong in the samples around.
    """
    weighted = with_edges(with_noise(problem))
    other = weighted.with_records([along(r, straight_sided(r.path)) for r in weighted.records])
    gained = np.subtract(logs(weighted), logs(other)) > RULES.motion_gain * problem.counts
    pairs = zip(problem.records, other.records, gained, strict=True)
    return problem.with_records([along(r, better.path) if taken else r for r, better, taken in pairs])


def with_edges(problem: Problem) -> Problem:
    """The problem with the error that its steps leave open, `edges` of its records."""
    # Point samples: whether a step falls before or after a sample matters most.
    means, base = problem.simulated(problem.damping({}))
    others = [refilled(problem, s * RULES.open_level).simulate(problem.damping({}))[1] for s in (-1, 1)]
    changes = [{STROKE_GAIN: 1.0 + s * RULES.open_stroke} for s in (-1, 1)]
    # Fits take the threshold of foam a bit above the given value, see fitting/simulation.py.
    changes += [{"v_foam": s * problem.given.parameters.v_foam} for s in (1.0, 2 * MARGIN - 1)]
    others += [problem.simulated(problem.damping(change))[1] for change in changes]
    several = np.sqrt(sum(((other - base) ** 2 for other in others), np.zeros(len(base))) / 2)
    several = np.hypot(several, barely_cavitating(problem, base))
    again = [measured_again(problem, seed).simulate(problem.damping({}))[1] - base for seed in range(RULES.stroke_draws)]
    several = np.hypot(several, np.sqrt(np.mean(np.square(again), axis=0)))
    late = moved_in_time(problem, RULES.open_step * period(problem))
    motion = RULES.open_motion * np.abs(between_samples(problem).simulate(problem.damping({}))[1] - base)
    filtered = min(1.0, sum(abs(problem.usual.get(name, 0.0)) for name in SAMPLING))
    several = np.hypot(several, between_readings(problem) * np.abs(means - base))
    records = []
    for record, a, b in zip(problem.records, problem.starts[:-1], problem.starts[1:], strict=True):
        sharp = np.hypot(alone(late[a:b]), motion[a:b])
        edges = np.sqrt(record.edges**2 + several[a:b] ** 2 + passed_on(record, base[a:b], sharp, filtered) ** 2)
        records.append(replace(record, edges=edges))
    return with_noise(problem.with_records(records))


def between_readings(problem: Problem) -> float:
    """How far the samples are from points and from means [1], 0 to 0.5: how a filter reads a sharp step is not known."""
    mean = problem.usual.get("sample_mean", 0.0)
    wider = abs(sum(problem.usual.get(name, 0.0) for name in BENDS))  # what cancels is late or early, and known
    return 0.5 * min(1.0, min(mean, 1.0 - mean) + wider)


def barely_cavitating(problem: Problem, base: Array) -> Array:
    """What the force (n,) [N] of records whose speed just passes the threshold of cavitation would be off if it did not.

    The noise of a stroke is seen in its slope, so that such a speed may be an overshoot.
    """
    least = problem.given.parameters.v_cav
    most = (1.0 + RULES.open_speed) * least
    barely = [bool(least < np.abs(record.velocity).max() <= most) for record in problem.records]
    if not any(barely):
        return np.zeros(len(base))
    other = problem.simulated(problem.damping({"v_cav": most}))[1]
    return np.where(problem.spread(np.array(barely)), np.abs(other - base), 0.0)


def refilled(problem: Problem, more: float) -> Problem:
    """The problem with `more` oil [1] in its degraded states."""
    other = copy(problem)
    degraded = problem.states[:, 1] == 0
    other.states = problem.states.copy()
    other.states[degraded, 0] = np.clip(other.states[degraded, 0] + more, 0.0, 1.0)
    return other


def with_noise(problem: Problem) -> Problem:
    """The problem with the noise of its records from what does not repeat in the errors of the model as given."""
    errors = np.split(problem.errors({}), problem.starts[1:-1])
    alike = colour(problem.records, errors)
    records = [replace(record, colour=alike) for record in problem.records]
    return problem.with_records([replace(r, noise=noise(r, error)) for r, error in zip(records, errors, strict=True)])


def passed_on(record: PreparedRecord, force: Array, edges: Array, filtered: float) -> Array:
    """Errors (n,) [N] at the steps of a force (n,) [N] with what a filter passes on; `filtered` is 0 for samples of points.

    What is known of the filter is open by a part of each bend of the force, in the samples around, too.
    """
    bend = np.abs(np.diff(force, 2, prepend=force[0], append=force[-1])) / np.maximum(record.samples, 1)
    reach = range(-2, 4)
    bends = np.maximum.reduce([np.roll(bend, by) for by in reach])
    around = np.maximum.reduce([np.roll(edges, by) for by in (-1, 1, 2)])
    return np.asarray(np.maximum(edges, filtered * np.hypot(0.5 * around, RULES.open_filter * bends)))


def moved_in_time(problem: Problem, time: float) -> Array:
    """What the simulated force (n,) [N] changes by where it is seen so much [s] earlier or later."""
    usual = problem.usual.get(DELAY, 0.0)
    early, late = (problem.simulated(problem.damping({DELAY: usual + s * time}))[1] for s in (-1, 1))
    return np.asarray(np.abs(late - early) / 2.0)


def alone(change: Array) -> Array:
    """The part of changes (n,) that the intervals around do not have: a step lies in two intervals at most."""
    return np.asarray(np.maximum(change - np.maximum(np.roll(change, 2), np.roll(change, -2)), 0.0))
