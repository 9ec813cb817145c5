"""Faults of a measuring channel are recovered with their size from forces that the simulation made."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from tests.diagnosis import small
from twintube.data import Record
from twintube.diagnosis.fits.candidates import FAULT_TITLES, Candidate, faults, nuisances, period, usual_delay
from twintube.diagnosis.fits.fit import Problem
from twintube.diagnosis.fits.starts import best_start
from twintube.diagnosis.rules import RULES

SPEEDS = (0.1, 0.3, 1.0)


@pytest.fixture(scope="module")
def runs() -> list[small.Run]:
    return [small.run(speed) for speed in SPEEDS]


def stretched(r: small.Run) -> Record:
    record = small.record(r)
    return replace(record, stroke=1.03 * record.stroke, velocity=1.03 * record.velocity)


def slow(r: small.Run) -> Record:
    record = small.record(r)
    return replace(record, time=1.03 * record.time, velocity=record.velocity / 1.03)


SHARP = {"bend_about": 0.0}  # no filter
FAULTS: dict[str, tuple[float, Callable[[small.Run], Record]]] = {
    "force_offset": (40.0, lambda r: small.record(r, r.force + 40.0)),
    "force_gain": (0.95, lambda r: small.record(r, 0.95 * r.force)),
    "stroke_gain": (1.03, stretched),
    "time_base": (1.03, slow),
    "clamp_inertia": (4.0, lambda r: small.record(r, r.force + 4.0 * np.gradient(r.velocity, r.time))),
    "zero_drift": (1.5, lambda r: small.record(r, r.force + 1.5 * r.time)),
    "clock_error": (0.002, lambda r: small.record(r, r.at(r.force, r.time * (1 - 0.002)))),
    "channel_delay": (0.004, lambda r: small.record(r, r.at(r.force, r.time - 0.004))),
}


def fault(problem: Problem, name: str) -> Candidate:
    return next(c for c in faults(problem) if c.name == name)


def test_every_fault_of_a_channel_is_tested_here(runs: list[small.Run]) -> None:
    assert [c.name for c in faults(small.problem([small.record(runs[0])]))] == list(FAULT_TITLES)
    assert set(FAULTS) == set(FAULT_TITLES)


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_recovered_from_its_own_start(name: str, runs: list[small.Run]) -> None:
    value, measured = FAULTS[name]
    problem = small.problem([measured(r) for r in runs]).with_usual(SHARP)
    candidate = fault(problem, name)
    cost, start = best_start([problem], candidate, [{}])
    f, *laws = candidate.free
    fit = problem.fit([*(g for g in nuisances(problem) if g.name != name), replace(f, start=start[name]), *laws])
    assert cost < float(np.sum(problem.residual({}) ** 2))
    assert fit.values[name] == pytest.approx(value, abs=max(0.02 * abs(value - f.start), candidate.least[name] * 0.1))
    assert abs(value - f.start) > candidate.least[name]
    assert fit.misfit.max() < 1.2


def test_a_zero_that_settles_is_recovered_with_its_rate(runs: list[small.Run]) -> None:
    """As of a load cell that warms up at the beginning of each record."""
    problem = small.problem([small.record(r, r.force + 8.0 * (1.0 - np.exp(-0.2 * r.time))) for r in runs])
    candidate = fault(problem, "zero_drift")
    _, start = best_start([problem], candidate, [{}])
    fit = problem.fit([*nuisances(problem), *(replace(f, start=start[f.name]) for f in candidate.free)])
    assert fit.values["zero_drift"] == pytest.approx(1.6, rel=0.1)
    assert fit.values["zero_settling"] == pytest.approx(0.2, rel=0.2)
    assert fit.misfit.max() < 1.2


def test_the_interval_of_a_single_record_is_not_narrower_than_its_noise_allows(runs: list[small.Run]) -> None:
    problem = small.problem([small.record(runs[1], 0.95 * runs[1].force)])
    (gain,) = fault(problem, "force_gain").free
    fit = problem.fit([*nuisances(problem), gain])
    at = [g.name for g in fit.free].index(gain.name)
    slope = problem.forces({"force_gain": 1.0}) * problem.weight
    assert np.sqrt(fit.covariance[at, at]) > 0.3 / np.linalg.norm(slope)


def test_strokes_and_velocities_are_those_of_the_moment_of_the_force(runs: list[small.Run]) -> None:
    """Before and after the record the damper stands still."""
    (record,) = small.problem([small.record(runs[2])]).records
    stroke, velocity = record.moved(0.004, 0.0)
    assert stroke == pytest.approx(runs[2].at(runs[2].stroke, record.time - 0.004), abs=2e-6)
    assert np.all(velocity[record.time < 0.004] == 0.0)
    late = record.moved(0.0, 0.01)[0]
    assert late == pytest.approx(runs[2].at(runs[2].stroke, 0.99 * record.time), abs=2e-6)


def test_what_sampling_leaves_open_is_no_fault(runs: list[small.Run]) -> None:
    """Points at a coarse rate: neither a mean over the interval nor a delay is fitted, and the delay left open is a sample's."""
    problem = small.problem(
        [small.record(small.run(v, turns=20, samples=29), seed=i, noise=0.002) for i, v in enumerate(SPEEDS)]
    )
    assert usual_delay(problem) == pytest.approx(RULES.open_filtered * period(problem))
    assert usual_delay(problem.with_usual(SHARP)) == pytest.approx(RULES.open_samples * period(problem))
    assert usual_delay(small.problem([small.record(runs[2])])) >= RULES.small_delay
    fit = problem.fit(nuisances(problem))
    assert fit.values["sample_mean"] < 0.1
    assert abs(fit.values["channel_delay"]) < 0.02 * period(problem)
    assert fit.misfit.max() < 1.2


def test_averaged_and_point_samples_differ_most_at_jumps(runs: list[small.Run]) -> None:
    problem = small.problem([small.record(small.run(0.3, turns=4, samples=29))])
    mean, point = problem.simulated(())
    (record,) = problem.records
    apart = np.abs(mean - point)
    turned = np.abs(np.diff(np.sign(record.velocity), prepend=0)) > 0
    near = turned | np.roll(turned, 1) | np.roll(turned, -1)
    assert apart[near].max() > 2 * np.median(apart[~near])
    assert problem.forces({"sample_mean": 1.0}) == pytest.approx(mean)
    assert problem.forces({}) == pytest.approx(point)


@pytest.mark.parametrize(
    "changes", [{"wear_re": -0.1, "wear_co": -0.1}, {"fade_heat": 1e-4}], ids=lambda changes: next(iter(changes))
)
def test_an_effect_on_the_fluid_acts_on_samples_as_on_means(runs: list[small.Run], changes: dict[str, float]) -> None:
    problem = small.problem([small.record(runs[1])])
    (record,) = problem.records
    assert (record.samples < RULES.steps_per_interval).any()
    steady = (np.abs(record.velocity) > 0.5 * record.top_speed) & record.judged
    mean, point = problem.simulated(problem.damping(changes))
    assert point[steady] == pytest.approx(mean[steady], rel=0.01)
