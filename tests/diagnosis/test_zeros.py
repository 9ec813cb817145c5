"""Zeros of the load cell that differ from record to record, and what passes for them."""

from dataclasses import replace

import numpy as np
import pytest

from tests.diagnosis import small
from twintube.dampers import load
from twintube.diagnosis.fit import Problem
from twintube.diagnosis.prepare import PreparedRecord
from twintube.diagnosis.zeros import differ, step, zero_drift

SPEEDS = (0.131, 0.262, 0.524, 0.786, 1.048)  # [m/s]
COUNT = 300  # draws of a rate of alarms


@pytest.fixture(scope="module")
def records() -> list[PreparedRecord]:
    """Of a damper with worn valves, in three states of filling."""
    worn = small.records(lambda r: r.force - 0.1 * r.fluid, SPEEDS, (small.INTACT, small.DEGRADED, 0.304))
    return small.problem(worn).records


def test_the_scatter_of_the_records_zeros_is_not_that_of_a_wrong_model(records: list[PreparedRecord]) -> None:
    worn, _ = zero_drift(Problem(load("SA8"), records))
    rng, peak = np.random.default_rng(1), max(record.peak for record in records)
    zeros = 0.02 * peak * rng.standard_normal(len(records))
    pairs = zip(records, zeros, strict=True)
    moved = [replace(r, force=r.force + z) for r, z in pairs]
    drifting, remarks = zero_drift(Problem(load("SA8"), moved))
    assert worn.drift < 0.01 * peak
    assert 0.01 * peak < drifting.drift < 0.04 * peak
    assert "differs from record to record" in remarks[0]


def test_errors_are_whitened_by_the_covariance_of_a_zero_of_every_record(records: list[PreparedRecord]) -> None:
    problem = Problem(load("SA8"), records[:3], drift=7.0)
    a, b = problem.starts[1:3]
    weight = problem.weight[a:b]
    covariance = np.eye(b - a) + 7.0**2 * np.outer(weight, weight)
    weighted = (problem.forces({}) - problem.measured)[a:b] * weight
    expected = weighted @ np.linalg.solve(covariance, weighted)
    assert np.sum(problem.residual({})[a:b] ** 2) == pytest.approx(expected, rel=1e-9)


def test_a_constant_force_of_a_state_differs_from_zeros_that_scatter(records: list[PreparedRecord]) -> None:
    rng, drift = np.random.default_rng(4), 0.005 * max(record.peak for record in records)
    scattered = [drift * rng.standard_normal(len(records)) for _ in range(COUNT)]
    assert np.mean([differ(records, zeros, 0.05) for zeros in scattered]) < 0.05 + 3 * np.sqrt(0.05 * 0.95 / COUNT)
    degraded = np.array([not record.gas_preload for record in records])
    assert np.mean([differ(records, zeros + 3 * drift * degraded, 0.05) for zeros in scattered]) > 0.95
    one_wrong = scattered[0] + np.where(np.arange(len(records)) == 3, 100 * drift, 0.0)
    assert not differ(records, one_wrong, 0.05)
    assert not differ(records, 1e-3 * (scattered[0] + 3 * drift * degraded), 0.05)  # numerics
    assert step(records, drift * degraded) == drift
