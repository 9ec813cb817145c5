"""What the model's own steps leave open covers what a good damper's records are off by."""

from dataclasses import replace

import numpy as np
from scipy.ndimage import uniform_filter1d
from scipy.signal import sawtooth

from tests.diagnosis import small
from twintube.dampers import load
from twintube.diagnosis.measurement.edges import between_readings, with_edges, with_motion, with_noise
from twintube.diagnosis.measurement.faults import scaled
from twintube.diagnosis.records.thinning import thin
from twintube.engine.simulate import simulate

LEVEL = 4e-5  # [m] of a coarse stroke channel


def test_noise_of_the_stroke_is_part_of_the_errors() -> None:
    """Few samples per stroke of a coarse channel: where friction turns, the model is off by more than the force's noise."""
    rough = [
        replace(r, stroke=np.round(r.stroke / LEVEL) * LEVEL)
        for r in (small.record(small.run(v, samples=80), noise=0.0005) for v in (0.1, 0.3))
    ]
    problem = with_noise(small.problem(rough))
    assert scaled(problem.records[0], 1.0, -1e3).stroke_noise == 1e3 * problem.records[0].stroke_noise > 0.0
    noise_alone = float(np.mean(problem.misfits(problem.residual({}))))
    whole = with_edges(problem)
    assert noise_alone > 2.0
    assert float(np.mean(whole.misfits(whole.residual({})))) < 1.5


def test_readings_between_points_and_means_leave_a_step_open() -> None:
    problem = small.problem(small.records(speeds=(0.3,)))
    usual = {"sample_mean": 0.0, "bend_ahead": 0.0, "bend_about": 0.0, "bend_before": 0.0}
    assert between_readings(problem.with_usual(usual)) == 0.0
    assert between_readings(problem.with_usual({**usual, "sample_mean": 1.0})) == 0.0
    assert between_readings(problem.with_usual({**usual, "sample_mean": 0.4})) == 0.2
    late = {**usual, "bend_ahead": -0.3, "bend_before": 0.3}
    assert between_readings(problem.with_usual(late)) == 0.0, "a third difference is late, not wider"


def test_the_step_across_a_rest_has_no_speed_in_it() -> None:
    """A model that takes the speed of a sample that moves again for that of the rest foams in it."""
    fast = small.record(small.run(1.0))
    slow = small.record(small.run(0.05, turns=3))
    rest = np.arange(1, 2001) * 5e-3
    time = np.concatenate([slow.time, slow.time[-1] + rest, slow.time[-1] + rest[-1] + 1e-3 + fast.time])
    stroke = np.concatenate([slow.stroke, np.full(len(rest), slow.stroke[-1]), fast.stroke])
    whole = replace(
        fast, time=time, stroke=stroke, force=np.zeros(len(time)), velocity=np.zeros(len(time)),
        usable=np.ones(len(time), dtype=bool),
    )  # fmt: skip
    at, _, stretch = thin(whole)
    across = int(np.argmax(np.diff(time[at])))
    assert time[at][across + 1] - time[at][across] > 5.0
    assert abs(stroke[at[across + 1]] - slow.stroke[-1]) < 1e-6
    assert stretch[across + 1] == stretch[across] + 1


def test_a_rig_that_turns_within_a_sample_goes_straight_between_turns() -> None:
    """A cubic spline through seven samples per stroke swings on behind each turn; the slopes of Akima do not."""
    fine, every, speed = 1e-4, 90, 1.3
    time = np.arange(0.0, 3.0, fine)
    stroke = uniform_filter1d(0.04 * sawtooth(2 * np.pi * speed / 0.16 * time + 0.3, 0.5), 31)
    force = simulate(load("SA8", as_published=True), stroke, np.gradient(stroke, time), time).force
    few = slice(None, None, every)
    noisy = force[few] + 2.0 * np.random.default_rng(5).standard_normal(len(time[few]))
    turning = replace(
        small.record(small.run(speed)), name="triangle", time=time[few], stroke=stroke[few], force=noisy,
        velocity=np.gradient(stroke, time)[few], usable=np.ones(len(time[few]), dtype=bool),
    )  # fmt: skip
    smooth = small.record(small.run(0.6))
    problem = with_noise(small.problem([smooth, turning]).with_usual({"sample_mean": 0.0}))
    other = with_motion(problem)
    assert other.records[0].path is problem.records[0].path
    before, after = (p.misfits(p.residual({}))[1] for p in (problem, other))
    assert after < 0.5 * before
