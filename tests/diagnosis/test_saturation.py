"""A limit of the force channel under noise is seen against the model; a valve that opens at high forces is none."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import uniform_filter1d

from tests.diagnosis import small
from twintube.dampers import load
from twintube.data import Record
from twintube.diagnosis.measurement.edges import with_edges, with_noise
from twintube.diagnosis.measurement.saturation import saturated
from twintube.diagnosis.problem import Problem
from twintube.engine.simulate import simulate
from twintube.rig.signals import AMPLITUDE

LIMIT = 0.6  # of the largest force


def problem(formula: small.Formula | None) -> Problem:
    return with_edges(with_noise(small.problem(small.records(formula, speeds=(0.3, 0.6, 1.0, 1.3)))))


@pytest.fixture(scope="module")
def largest() -> float:
    return max(float(r.force.max()) for r in small.records(speeds=(1.3,)))


def test_a_limit_is_named_with_its_records_and_what_is_beyond_is_left_out(largest: float) -> None:
    seen, rest = saturated(problem(lambda r: np.minimum(r.force, LIMIT * largest)))
    assert seen is not None and seen.name == "saturation" and np.isinf(seen.size)
    named = float(seen.text.split(" at about ")[1].split(" N")[0])
    assert named == pytest.approx(LIMIT * largest, rel=0.02)
    assert "v1300" in seen.text and "v300" not in seen.text
    assert float(np.mean(rest.misfits(rest.residual({})))) < 2.0


def test_a_good_damper_and_a_valve_that_opens_are_no_limit(largest: float) -> None:
    assert saturated(problem(None))[0] is None
    knee = LIMIT * largest
    assert saturated(problem(lambda r: np.minimum(r.force, knee + 0.3 * (r.force - knee))))[0] is None
    assert saturated(problem(lambda r: 0.8 * r.force))[0] is None


def triangle(level: float, *, factor: float = 1.0) -> Record:
    """Strokes of constant velocity with turns of finite acceleration, forces times a factor and cut at a level [N]."""
    strokes = np.linspace(-AMPLITUDE, AMPLITUDE, 161)
    z = uniform_filter1d(np.concatenate([strokes[:-1], strokes[::-1][:-1]] * 4), 12, mode="nearest")
    t = np.arange(len(z)) * (strokes[1] - strokes[0]) / 1.3
    v = np.gradient(z, t)
    force = factor * simulate(load("SA8", as_published=True), z, v, t).force
    noise = 3.0 * np.random.default_rng(3).standard_normal(len(z))
    like = small.record(small.run(1.3))
    seen = np.clip(force, -level, level) + noise
    return replace(like, name="triangle", time=t, stroke=z, velocity=v, force=seen, usable=np.ones(len(z), dtype=bool))


def test_a_limit_is_told_from_another_setting_at_constant_velocity(largest: float) -> None:
    slower = small.records(speeds=(0.1, 0.3, 0.6))
    cut = with_edges(with_noise(small.problem([*slower, triangle(0.8 * largest)])))
    seen, rest = saturated(cut)
    assert seen is not None and "triangle" in seen.text
    assert float(rest.misfits(rest.residual({}))[-1]) < 2.0
    # Another setting changes the other direction, too.
    assert saturated(with_edges(with_noise(small.problem([*slower, triangle(np.inf, factor=0.8)]))))[0] is None


def test_a_limit_that_some_records_show_holds_for_those_whose_strokes_are_beyond_it_all_along(largest: float) -> None:
    """At constant velocity the model does not rise on beyond the limit, so that this record alone would not show it."""
    level = LIMIT * largest
    sines = small.records(lambda r: np.clip(r.force, -level, level), speeds=(0.3, 0.6, 1.0))
    seen, rest = saturated(with_edges(with_noise(small.problem([*sines, triangle(level)]))))
    assert seen is not None and "triangle" in seen.text
    assert float(rest.misfits(rest.residual({}))[-1]) < 2.0
    # Where a force passes the limit of others, it is not that of the channel.
    whole = saturated(with_edges(with_noise(small.problem([*sines, triangle(np.inf)]))))[0]
    assert whole is None or "triangle" not in whole.text


def test_a_filter_that_overshoots_where_the_model_is_uncertain_does_not_hide_a_limit(largest: float) -> None:
    cut = with_edges(with_noise(small.problem([*small.records(speeds=(0.1, 0.3, 0.6)), triangle(0.8 * largest)])))
    *others, last = cut.records
    place = int(np.argmax(np.where(last.judged, last.force, 0.0)))
    over = last.force.copy()
    over[place] += 0.1 * largest
    for edges, sure in ((0.1 * largest, True), (0.0, False)):
        wide = last.edges.copy()
        wide[place] += edges
        seen = saturated(cut.with_records([*others, replace(last, force=over, edges=wide)]))[0]
        assert (seen is not None and "triangle" in seen.text) == sure
