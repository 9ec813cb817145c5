"""Balancing the records is explicit: problems do not change, and a selector has its start from the beginning."""

import numpy as np
import pytest

from twintube.diagnosis.candidates import candidates
from twintube.diagnosis.fit import Problem
from twintube.diagnosis.gains import bootstrap, removed, worst
from twintube.diagnosis.prepare import prepare
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.select import Fold, Selector
from twintube.lab.blind_trials.trials import dataset, trial


@pytest.fixture(scope="module")
def problem() -> Problem:
    data = dataset(trial("valve_wear", 2001, blocks=(0.262, 0.524)))
    return Problem(data.damper, prepare(data))


def test_a_balanced_problem_is_another_problem(problem: Problem) -> None:
    before = problem.shared({}).copy()
    misfit = problem.misfits(problem.residual({}))
    balanced = problem.balanced(misfit)
    assert np.array_equal(problem.shared({}), before)
    assert np.array_equal(balanced.residual({}), problem.residual({}))
    sums = np.add.reduceat(balanced.shared({}) ** 2, problem.starts[:-1]) / problem.counts
    assert sums == pytest.approx(np.minimum(misfit, 1.0))


def test_a_selector_balances_its_records_and_leaves_the_given_ones(problem: Problem) -> None:
    half = len(problem.records) // 2
    fitted, held = problem.with_records(problem.records[:half]), problem.with_records(problem.records[half:])
    selector = Selector(fitted, candidates(problem), [Fold(fitted, held)])
    assert np.all(fitted.share == 1.0)
    assert selector.start.names == ()
    misfit = selector.start.fits[0].misfit
    expected = np.repeat(1 / np.sqrt(np.maximum(1.0, misfit)), np.diff(fitted.starts))
    assert selector.whole.share == pytest.approx(expected)
    assert selector.folds[0].fitted.share == pytest.approx(expected)
    assert selector.count == held.counts.sum()


def test_gains_over_records() -> None:
    rows = np.array([[9.0, 10.0], [4.0, 10.0], [-5.0, 0.01]])
    assert worst(rows) == pytest.approx(0.4)  # a record of next to no explainable error does not count
    low, high = bootstrap(rows[:2])
    assert (low, high) == (pytest.approx(0.4), pytest.approx(0.9))
    assert removed(0.0, -1.0, 10) == 0.0
    assert removed(RULES.right, 0.0, 10) == pytest.approx(1.0)
