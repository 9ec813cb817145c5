"""How the force was sampled is known before anything is judged: delay, zero, means and a filter near the sampling rate."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import butter, lfilter

from tests.diagnosis import small
from twintube.common.arrays import Array
from twintube.core import effects
from twintube.dampers import load
from twintube.data import Record
from twintube.diagnosis.channels import period, unfiltered, usual_delay
from twintube.diagnosis.measurement.edges import barely_cavitating, with_edges, with_noise
from twintube.diagnosis.measurement.sampling import with_sampling
from twintube.diagnosis.problem import Problem
from twintube.diagnosis.records.seen import SAMPLING
from twintube.diagnosis.rules import RULES

SPEEDS = (0.3, 0.6, 1.0)
COARSE = 40  # samples per oscillation


@pytest.fixture(scope="module")
def runs() -> list[small.Run]:
    return [small.run(v, level, turns=20, samples=COARSE, slow=0 if level == small.INTACT else 2)
            for level in (small.INTACT, small.DEGRADED) for v in SPEEDS]  # fmt: skip


def sampled(runs: list[small.Run], force: list[Array]) -> list[Record]:
    """Records of the runs with forces as the channel gave them."""
    return [small.record(r, f, seed=i, noise=0.002) for i, (r, f) in enumerate(zip(runs, force, strict=True))]


def late(r: small.Run, delay: float) -> Array:
    """The force later by a `delay` [s]."""
    return r.at(r.force, r.time - delay)


def filtered(r: small.Run) -> Array:
    """The force through a fourth-order filter at 0.4 of the sampling rate, without its mean delay."""
    b, a = butter(4, 0.8 / small.FINE)
    w = np.arange(1e-4, 2e-4, 1e-5)
    z = np.exp(-1j * w)
    phase = np.unwrap(np.angle(np.polyval(b[::-1], z) / np.polyval(a[::-1], z)))
    delay = -float(np.polyfit(w, phase, 1)[0])
    even = np.arange(len(r.force), dtype=float)
    return np.interp(even + delay, even, lfilter(b, a, r.force - r.force[0]) + r.force[0])


def test_points_are_known_as_points(runs: list[small.Run]) -> None:
    problem = with_sampling(small.problem(sampled(runs, [r.force for r in runs])))
    assert problem.usual["sample_mean"] < 0.1
    assert abs(problem.usual["channel_delay"]) < 0.02 * period(problem)
    assert all(abs(problem.usual[name]) < 0.05 for name in SAMPLING[1:])


@pytest.mark.parametrize("delay", [-3e-3, 1e-3, 4e-3])  # [s], the shortest period is 7 ms
def test_a_delay_of_a_part_of_a_sample_is_known(runs: list[small.Run], delay: float) -> None:
    problem = with_sampling(small.problem(sampled(runs, [late(r, delay) for r in runs])))
    assert problem.usual["channel_delay"] == pytest.approx(delay, abs=4e-4)


def test_a_filter_near_the_sampling_rate_is_no_misfit(runs: list[small.Run]) -> None:
    records = sampled(runs, [filtered(r) for r in runs])
    bare = with_edges(with_noise(small.problem(records)))
    known = with_edges(with_noise(with_sampling(small.problem(records))))
    misfits = [p.misfits(p.residual({})) for p in (bare, known)]
    assert misfits[0].mean() > 3.0 * misfits[1].mean()
    assert misfits[1].mean() < 1.5


def test_the_delay_of_a_filter_is_that_of_sampling_and_a_sharp_one_is_not(runs: list[small.Run]) -> None:
    """A filter of the fourth order at 0.4 of the rate is late by 1.04 samples."""

    def behind(r: small.Run) -> float:
        return 1.04 * small.FINE * float(r.time[1] - r.time[0])

    usual = [with_sampling(small.problem(sampled(runs, [late(replace(r, force=force(r)), behind(r)) for r in runs])))
             for force in (filtered, lambda r: r.force)]  # fmt: skip
    assert not unfiltered(usual[0]) and usual[0].usual["bend_about"] < -RULES.bent
    assert usual_delay(usual[0]) > RULES.open_samples * period(usual[0])
    assert unfiltered(usual[1]) and usual[1].usual["channel_delay"] <= RULES.open_samples * period(usual[1])


def test_a_record_of_another_damper_does_not_decide(runs: list[small.Run]) -> None:
    records = sampled(runs, [late(r, 2e-3) for r in runs])
    strange = [replace(records[0], force=1.5 * records[0].force + 30.0), *records[1:]]
    values = [with_sampling(small.problem(some)).usual for some in (records, strange)]
    assert values[1]["channel_delay"] == pytest.approx(values[0]["channel_delay"], abs=0.03 * 1e-2)


def neutral_forces(problem: Problem, name: str, share: float) -> Array:
    """The forces of the samples with the strengths of an effect at a share of their range."""
    several = [item for item in effects.EFFECTS[name].parameters if item.metadata["role"] == "strength"]
    return problem.forces({several[0].name: share * float(several[0].metadata["upper"])})


# A lag sees the mean of a step in which the gas runs out, not its end: up to 0.6 ms.
@pytest.mark.parametrize("name", sorted(set(effects.EFFECTS) - {"fluid_lag"}))
def test_an_effect_of_next_to_no_strength_leaves_every_sample_as_it_was(runs: list[small.Run], name: str) -> None:
    problem = small.problem(sampled(runs, [r.force for r in runs]))
    change = np.abs(neutral_forces(problem, name, 1e-9) - problem.forces({}))
    assert change.max() < 0.02 * np.abs(problem.measured).max()
    assert np.sqrt(np.mean(change**2)) < 1e-3 * np.abs(problem.measured).max()


@pytest.mark.parametrize("build_up", [1e-9, 3e-4])
def test_what_is_left_of_the_past_stays_below_the_intact_force(runs: list[small.Run], build_up: float) -> None:
    problem = small.problem(sampled(runs, [r.force for r in runs]))
    force = problem.forces({"build_up": build_up, "carry_over": 1.0})
    assert np.abs(force).max() < 1.5 * np.abs(problem.measured).max()


def test_a_speed_just_beyond_the_threshold_of_cavitation_may_be_noise() -> None:
    """A record that passes it by 1 % knows nothing of cavitation, one that passes it by 20 % does."""
    for factor, open_to_doubt in ((1.01, True), (1.2, False), (0.9, False)):
        problem = small.problem(
            small.records(lambda r: r.force, (factor * load("SA8", as_published=True).parameters.v_cav,), (small.DEGRADED,))
        )
        doubt = barely_cavitating(problem, problem.simulated(problem.damping({}))[1])
        assert (doubt.max() > 0.05 * problem.records[0].peak) == open_to_doubt
