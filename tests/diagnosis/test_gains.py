"""Errors and gains: the noise floor is below every model, and what is left out counts nowhere."""

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from twintube.arrays import Array
from twintube.diagnosis.fits.gains import bootstrap, errors, floor, gains, removed, whole, worst
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.result import RecordResult
from twintube.diagnosis.rules import RULES


def result(measured: Array, models: tuple[Array, Array, Array], weight: Array) -> RecordResult:
    n = len(measured)
    record = SimpleNamespace(stroke=0.045 * np.sin(np.linspace(0.0, 20.0, n)), cycle=np.repeat(np.arange(n // 10), 10)[:n])
    return RecordResult(cast(PreparedRecord, record), "heldout", measured, *models, weight)


def some(rng: np.random.Generator, scales: tuple[float, float, float]) -> list[RecordResult]:
    """Three records whose noise and weights differ, and the errors of the models in units of the noise."""
    several = []
    for n, sigma in ((200, 1.0), (300, 30.0), (100, 5.0)):
        measured = sigma * rng.standard_normal(n)
        weight = np.where(rng.random(n) < 0.1, 0.0, 1.0 / sigma)
        models = [measured + scale * sigma * rng.standard_normal(n) for scale in scales]
        several.append(result(measured, (models[0], models[1], models[2]), weight))
    return several


@pytest.mark.parametrize("scales", [(5.0, 4.0, 1.0), (1.0, 1.0, 1.0), (0.5, 0.6, 0.4), (3.0, 0.2, 1.0), (1.0, 9.0, 9.0)])
def test_no_model_is_below_the_noise_floor(scales: tuple[float, float, float]) -> None:
    for seed in range(20):
        records = some(np.random.default_rng(seed), scales)
        force = {name: e.force_rmse_N for name, e in errors(records).items()}
        least = min(force[name] for name in ("base", "recalibrated", "extended"))
        assert force["noise_floor"] <= least * (1 + 1e-12)
        assert 0.0 < floor(records) <= 1.0
        assert np.all(gains(records)[:, 1].sum() >= -1e-9)


def test_the_gain_is_that_of_the_errors_that_are_shown() -> None:
    records = some(np.random.default_rng(1), (5.0, 4.0, 1.5))
    base, extended, noise = (errors(records)[name].force_rmse_N ** 2 for name in ("base", "extended", "noise_floor"))
    assert whole(gains(records)) == pytest.approx((base - extended) / (base - noise), rel=1e-9)
    worse = some(np.random.default_rng(1), (1.5, 4.0, 5.0))
    assert whole(gains(worse)) < 0.0


def test_intervals_without_weight_count_nowhere() -> None:
    records = some(np.random.default_rng(2), (5.0, 4.0, 1.5))
    before = {name: e.force_rmse_N for name, e in errors(records).items()}
    work = errors(records)["base"].work_rmse_J
    for r in records:
        r.base[r.weight == 0.0] += 1e6
    assert {name: e.force_rmse_N for name, e in errors(records).items()} == pytest.approx(before)
    assert errors(records)["base"].work_rmse_J == pytest.approx(work)


def test_gains_over_records() -> None:
    rows = np.array([[9.0, 10.0], [4.0, 10.0], [-5.0, 0.01]])
    assert worst(rows) == pytest.approx(0.4)  # a record of next to no explainable error does not count
    low, high = bootstrap(rows[:2])
    assert (low, high) == (pytest.approx(0.4), pytest.approx(0.9))
    assert removed(0.0, -1.0, 10) == 0.0
    assert removed(RULES.right, 0.0, 10) == pytest.approx(1.0)


def test_a_cause_in_two_of_many_records_is_in_every_resample() -> None:
    quiet = np.column_stack([np.linspace(-1.0, 1.0, 20), np.full(20, 1.0)])
    loud = np.array([[900.0, 1000.0], [800.0, 1000.0]])
    low, high = bootstrap(np.concatenate([quiet, loud]))
    assert (low, high) == (pytest.approx(0.79, abs=0.03), pytest.approx(0.89, abs=0.03))
    low, _ = bootstrap(np.concatenate([quiet, loud[:1]]))
    assert low < 0.1, "where a single record holds all of it, another sample of records may lack it"
