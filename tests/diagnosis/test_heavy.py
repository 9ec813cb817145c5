"""Noise with heavy tails: few samples decide nothing; and the budget of the error, whose first line is what is hidden."""

import re

import numpy as np
import pytest
from scipy.stats import t as student

from tests.diagnosis import small
from twintube.common.arrays import Array
from twintube.dampers import load
from twintube.data import LoadedDataset
from twintube.diagnosis import Answer, answer
from twintube.diagnosis.contract import as_json
from twintube.diagnosis.heavy import tails, weights_of
from twintube.diagnosis.memory import lasting
from twintube.diagnosis.numbers import numbers
from twintube.report.diagnosis.page import lines

SPEEDS = (0.3, 0.6, 1.0)  # [m/s]
CATALOGUE = ["force_offset", "force_gain", "gas_spring", "valve_wear"]


def test_a_weighted_gaussian_with_its_tails_is_students_distribution() -> None:
    r = np.linspace(-40.0, 40.0, 81)
    w = weights_of(r)
    several = [-0.5 * weight * x**2 + 0.5 * np.log(weight) for x, weight in zip(r, w, strict=True)]
    found = [one + tails(r[[i]], w[[i]]) for i, one in enumerate(several)]
    law = student(numbers().freedom).logpdf
    assert found == pytest.approx(law(r) - law(0.0), abs=1e-12)


def test_what_lasts_is_expected_as_a_dense_gaussian_has_it() -> None:
    rng, n = np.random.default_rng(1), 40
    sigma, size = rng.uniform(0.5, 2.0, n), rng.uniform(1.0, 3.0, n)
    kept = np.concatenate([[0.0], rng.uniform(0.5, 0.95, n - 1)])
    values = rng.normal(0.0, 3.0, n)
    chain = [[np.prod(kept[min(i, j) + 1 : max(i, j) + 1]) for j in range(n)] for i in range(n)]
    covariance = np.array(chain) * size[:, None] * size
    expected = covariance @ np.linalg.solve(covariance + np.diag(sigma**2), values)
    assert lasting(values, sigma, size, kept) == pytest.approx(expected, abs=1e-9)


def spiked(r: small.Run) -> Array:
    """A zero that is wrong, and a few samples that are wrong by far more."""
    force = r.force - 80.0
    force[len(force) // 3 :: len(force) // 4] += 900.0
    return np.asarray(force)


@pytest.fixture(scope="module")
def zero() -> Answer:
    records = small.records(lambda r: r.force - 80.0, SPEEDS)
    return answer(LoadedDataset("Small", load("SA8", as_published=True), records, []), catalogue=CATALOGUE)


def test_few_samples_decide_nothing(zero: Answer) -> None:
    records = small.records(spiked, SPEEDS)
    found = answer(LoadedDataset("Small", load("SA8", as_published=True), records, []), catalogue=CATALOGUE)
    assert found.cause is not None and zero.cause is not None
    assert found.cause.values["force_offset"] == pytest.approx(zero.cause.values["force_offset"], abs=5.0)


def test_the_answer_tells_the_fault_that_is_hidden(zero: Answer) -> None:
    assert zero.to_dataframe()["probability"].idxmax() == "force_offset"
    assert re.fullmatch(r"<Answer about SA8 from 3 records: measurement_fault: force_offset \(.*%\)>", repr(zero))


def test_the_first_line_of_the_budget_is_what_is_hidden(zero: Answer) -> None:
    budget = zero.budget()
    assert budget is not None
    assert budget.largest.name == "force_offset"
    assert budget.largest.force == pytest.approx(80.0, abs=10.0)
    assert budget.error > budget.largest.force - budget.noise
    assert as_json(zero)["budget"]["contributions"][0]["name"] == "force_offset"
    said = lines(zero)
    assert any(line.startswith("The simulation is") for line in said)
    assert any("Zero of the load cell" in line and "the cause that is named" in line for line in said)
