"""Records that begin at temperatures of their own, which no file tells."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid

from tests.diagnosis import small
from twintube.arrays import Array
from twintube.data import Record
from twintube.diagnosis import diagnose
from twintube.diagnosis.fits.fit import Problem
from twintube.diagnosis.verdict.answer import BEGUN

APART = (-1.2, 0.7, 2.0, -0.4)  # [K] from one record to another
FADE = 0.02  # [1/K] of the viscosity
CAPACITY = 500.0  # [J/K]
HEAT = {"fade_heat": FADE / CAPACITY, "cooling_time": 2000.0, "H_start": 0.0}


@pytest.fixture(scope="module")
def records() -> list[Record]:
    """Of a damper that warms up from another temperature in each record, by its work, and loses no heat."""

    def force(r: small.Run, begin: float) -> Array:
        warmer = begin + cumulative_trapezoid(np.abs(r.force * r.velocity), r.time, initial=0.0) / CAPACITY
        return r.force - r.fluid * FADE * warmer / (1.0 + FADE * warmer)

    runs = [small.run(speed) for speed in small.SPEEDS]
    pairs = enumerate(zip(runs, APART, strict=True))
    return [small.record(r, force(r, begin), seed=i) for i, (r, begin) in pairs]


@pytest.fixture(scope="module")
def problem(records: list[Record]) -> Problem:
    return small.problem(records)


def test_records_of_unknown_temperatures_are_heat(records: list[Record], tmp_path: Path) -> None:
    answer = diagnose(small.write(records, tmp_path))
    assert (answer.verdict, [cause.effect for cause in answer.causes]) == ("cause", ["oil_temperature"])
    errors = answer.errors["heldout"]
    assert errors["extended"].force_rmse_N < 1.2 * errors["noise_floor"].force_rmse_N < 0.5 * errors["base"].force_rmse_N
    assert BEGUN in answer.remarks


def misfit(problem: Problem, values: Mapping[str, float]) -> float:
    return float(np.mean(problem.residual(values)[problem.used] ** 2))


def test_errors_are_whitened_by_the_covariance_of_a_beginning_of_every_record(problem: Problem) -> None:
    drifting = problem.with_drift(7.0)
    change = drifting.beginnings(HEAT)
    assert change is not None
    for a, b in zip(drifting.starts[:-1], drifting.starts[1:], strict=True):
        weight = drifting.weight[a:b]
        covariance = np.eye(b - a) + 7.0**2 * np.outer(weight, weight) + np.outer(weight * change[a:b], weight * change[a:b])
        weighted = drifting.errors(HEAT)[a:b] * weight
        expected = weighted @ np.linalg.solve(covariance, weighted)
        assert np.sum(drifting.residual(HEAT)[a:b] ** 2) == pytest.approx(expected, rel=1e-9)


def test_each_record_has_its_own_beginning_at_a_price(problem: Problem) -> None:
    known = problem.with_records([replace(r, warmth_known=True) for r in problem.records])
    assert known.beginnings(HEAT) is None
    assert misfit(problem, HEAT) < 0.3 * misfit(known, HEAT)
    left = problem.begun_forces(HEAT) - problem.measured
    assert np.std(left[problem.used]) < 0.3 * np.std(problem.errors(HEAT)[problem.used])
    # Where all records begin alike, the freedom costs more than noise gives.
    alike = small.problem([small.record(small.run(speed), seed=i) for i, speed in enumerate(small.SPEEDS)])
    bare = alike.with_records([replace(r, warmth_known=True) for r in alike.records])
    slow = {**HEAT, "cooling_time": 5.0, "fade_heat": 1e-6}
    open_, closed = (float(np.sum(p.unit_misfits(slow) * p.unit_counts)) for p in (alike, bare))
    assert open_ > closed - len(small.SPEEDS)


def test_without_heat_there_is_no_beginning(problem: Problem) -> None:
    assert problem.beginnings({}) is None
    assert problem.beginnings({**HEAT, "fade_heat": 0.0}) is None
    assert np.array_equal(problem.begun_forces({}), problem.forces({}))
