"""A limit of the force channel under noise is seen against the model; a valve that opens at high forces is none."""

import numpy as np
import pytest

from tests.diagnosis import small
from twintube.diagnosis.edges import with_edges, with_noise
from twintube.diagnosis.fit import Problem
from twintube.diagnosis.saturation import saturated

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
