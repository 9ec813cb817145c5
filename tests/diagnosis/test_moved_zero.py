"""A constant of all records without gas may be what is left of the gas, or a zero that moved when oil was drained."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from tests.diagnosis import small
from twintube.arrays import Array
from twintube.diagnosis.measurement.edges import with_noise
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.result import RecordResult
from twintube.diagnosis.verdict.moved_zero import moved_zero

LIMIT = 10.0
CONSTANT, STIFFNESS = 40.0, 2000.0  # [N], [N/m]


@pytest.fixture(scope="module")
def records() -> list[PreparedRecord]:
    """Three speeds with gas and three without."""
    return list(
        with_noise(small.problem(small.records(speeds=(0.3, 0.6, 1.0), levels=(small.INTACT, small.DEGRADED)))).records
    )


def held(records: list[PreparedRecord], hidden: Callable[[PreparedRecord], Array], seed: int = 3) -> list[RecordResult]:
    """Records of a right model, of which the base model lacks what is `hidden` where there is no gas."""
    rng, results = np.random.default_rng(seed), []
    for r in records:
        missing = hidden(r) if not r.intact else np.zeros(len(r.time))
        measured = r.force + missing + r.noise * rng.standard_normal(len(r.time))
        base, extended = r.force, r.force + missing
        results.append(RecordResult(r, "heldout", measured, base, base, extended, r.judged / r.noise))
    return results


def test_a_constant_without_gas_is_a_zero_as_well(records: list[PreparedRecord]) -> None:
    assert {r.intact for r in records} == {True, False}
    share = moved_zero(held(records, lambda r: np.full(len(r.time), CONSTANT)), LIMIT)
    assert share is not None and share == pytest.approx(1.0, abs=0.01)


def test_the_stiffness_of_a_gas_is_no_zero(records: list[PreparedRecord]) -> None:
    assert moved_zero(held(records, lambda r: CONSTANT - STIFFNESS * r.stroke), LIMIT) is None


def test_where_all_records_are_alike_no_zero_moved_with_the_filling(records: list[PreparedRecord]) -> None:
    degraded = [replace(r, oil_level=small.DEGRADED, gas_preload=0) for r in records]
    assert moved_zero(held(degraded, lambda r: np.full(len(r.time), CONSTANT)), LIMIT) is None
