"""A record that lacks the slow strokes before it is noticed, and a damper that had none is believed."""

from dataclasses import replace

import numpy as np
import pytest

from tests.diagnosis import small
from twintube.dampers import load
from twintube.data import Record
from twintube.diagnosis.measurement.edges import with_edges, with_noise
from twintube.diagnosis.measurement.history import bare_of_strokes, settled, sudden, with_history
from twintube.diagnosis.problem import Problem
from twintube.engine.simulate import simulate

SPEEDS, STROKES = (0.3, 1.0), 6


@pytest.fixture(scope="module")
def intact() -> list[Record]:
    return [small.record(small.run(speed), seed=i) for i, speed in enumerate(SPEEDS)]


def ready(records: list[Record]) -> Problem:
    return with_edges(with_noise(small.problem(records)))


def test_slow_strokes_that_are_not_in_the_file_are_noticed(intact: list[Record]) -> None:
    begin = STROKES * 2 * np.pi * small.AMPLITUDE / small.SLOW
    cut = [small.record(small.run(v, small.DEGRADED, slow=STROKES), seed=i, begin=begin) for i, v in enumerate(SPEEDS)]
    before = ready([*intact, *cut])
    after, names = with_history(settled(before))
    assert names == [record.name for record in cut]
    misfits = [p.misfits(p.residual({})) for p in (before, after)]
    assert np.all(misfits[1][2:] < misfits[0][2:] / 3)
    assert misfits[1][:2] == pytest.approx(misfits[0][:2], rel=0.3)
    # What was simulated before a record is not compared, nor its first oscillation.
    assert np.all(after.counts < before.counts)
    assert np.all(after.counts > 0.5 * before.counts)


def test_a_damper_that_rested_before_and_a_file_with_slow_strokes_are_left_as_they_are(intact: list[Record]) -> None:
    rested = [small.record(small.run(v, small.DEGRADED), seed=i) for i, v in enumerate(SPEEDS)]
    problem = ready([*intact, *rested])
    after, names = with_history(settled(problem))
    assert names == []
    assert [len(r.time) for r in after.records] == [len(r.time) for r in problem.records]
    whole = ready([small.record(small.run(v, small.DEGRADED, slow=3), seed=i) for i, v in enumerate(SPEEDS)])
    assert bare_of_strokes(whole) == []
    assert with_history(whole) == (whole, [])


def test_a_slow_random_motion_holds_no_slow_strokes_of_its_own() -> None:
    """Its velocity stays below that of the strokes for a while by chance, over parts of its range."""
    t = np.arange(3000) * 5e-3
    parts = [(0.5, 0.9), (0.83, 2.1), (1.31, 4.0), (2.03, 0.3)]  # Hz, phase: no motion that repeats within the record
    z = sum(np.sin(2 * np.pi * f * t + phase) / f for f, phase in parts)
    z *= 0.08 / np.abs(np.gradient(z, t)).max()
    v = np.gradient(z, t)
    force = simulate(load("SA8", as_published=True).with_(oil_level=small.DEGRADED, gas_preload=0), z, v, t).force
    like = small.record(small.run(0.3, small.DEGRADED))
    usable = np.ones(len(t), dtype=bool)
    random = replace(like, measurement="stochastic", time=t, stroke=z, velocity=v, force=force, usable=usable)
    problem = small.problem([random])
    (record,) = problem.records
    assert not (record.cycle >= 0).any()
    assert sudden(record) and bare_of_strokes(problem) == [record.name]
