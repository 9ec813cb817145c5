"""A record that lacks the slow strokes before it is noticed, and a damper that had none is believed."""

import numpy as np
import pytest

from tests.diagnosis import small
from twintube.data import Record
from twintube.diagnosis.edges import with_edges, with_noise
from twintube.diagnosis.fit import Problem
from twintube.diagnosis.history import bare_of_strokes, settled, with_history

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
    assert not any(bare_of_strokes(record) for record in whole.records)
    assert with_history(whole) == (whole, [])
