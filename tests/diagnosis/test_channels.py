"""Faults of a measuring channel are recovered with their size from forces that the simulation made."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from tests.diagnosis import small
from twintube.data import Record
from twintube.diagnosis.channels import SOUGHT, faults, period, usual_delay
from twintube.diagnosis.measurement.odd import own_fault
from twintube.diagnosis.measurement.sampling import with_sampling
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


def test_every_fault_of_a_channel_is_tested_here(runs: list[small.Run]) -> None:
    # A cell set to zero with the damper in it is told with the state of the gas: tests/diagnosis/test_tared.py.
    assert [c.name for c in faults(small.problem([small.record(runs[0])]))] == list(SOUGHT)
    assert set(FAULTS) == set(SOUGHT)


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_recovered(name: str, runs: list[small.Run]) -> None:
    value, measured = FAULTS[name]
    problem = small.problem([measured(r) for r in runs]).with_usual(SHARP)
    sought = next(f for f in faults(problem) if f.name == name)
    found = own_fault(problem, ("all",), [sought])
    assert found is not None and found.effect == name
    assert found.factor == pytest.approx(value, abs=max(0.02 * abs(value - sought.neutral), 0.1 * sought.usual))


def test_strokes_and_velocities_are_those_of_the_moment_of_the_force(runs: list[small.Run]) -> None:
    """Before and after the record the damper stands still."""
    (record,) = small.problem([small.record(runs[2])]).records
    stroke, velocity = record.moved(0.004, 0.0)
    np.testing.assert_allclose(stroke, runs[2].at(runs[2].stroke, record.time - 0.004), rtol=0, atol=2e-6)
    assert np.all(velocity[record.time < 0.004] == 0.0)
    late = record.moved(0.0, 0.01)[0]
    np.testing.assert_allclose(late, runs[2].at(runs[2].stroke, 0.99 * record.time), rtol=0, atol=2e-6)


def test_what_sampling_leaves_open_is_no_fault(runs: list[small.Run]) -> None:
    """Points at a coarse rate: neither a mean over the interval nor a delay is found, and the delay left open is a sample's."""
    problem = small.problem(
        [small.record(small.run(v, turns=20, samples=29), seed=i, noise=0.002) for i, v in enumerate(SPEEDS)]
    )
    assert usual_delay(problem) == pytest.approx(RULES.open_filtered * period(problem))
    assert usual_delay(problem.with_usual(SHARP)) == pytest.approx(RULES.open_samples * period(problem))
    assert usual_delay(small.problem([small.record(runs[2])])) >= RULES.small_delay
    usual = with_sampling(problem).usual
    assert usual["sample_mean"] < 0.1
    assert abs(usual["channel_delay"]) < 0.02 * period(problem)


def test_averaged_and_point_samples_differ_most_at_jumps(runs: list[small.Run]) -> None:
    problem = small.problem([small.record(small.run(0.3, turns=4, samples=29))])
    mean, point = problem.simulated(())
    (record,) = problem.records
    apart = np.abs(mean - point)
    turned = np.abs(np.diff(np.sign(record.velocity), prepend=0)) > 0
    near = turned | np.roll(turned, 1) | np.roll(turned, -1)
    assert apart[near].max() > 2 * np.median(apart[~near])
    np.testing.assert_allclose(problem.forces({"sample_mean": 1.0}), mean, rtol=1e-6)
    np.testing.assert_allclose(problem.forces({}), point, rtol=1e-6)


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
