"""Zeros of the load cell that differ from record to record, and what passes for them."""

import itertools
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from tests.diagnosis import small
from twintube.dampers import load
from twintube.diagnosis.measurement.zeros import scatter, zero_change, zero_drift
from twintube.diagnosis.problem import Problem
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.rules import RULES

SPEEDS = (0.131, 0.262, 0.524, 0.786, 1.048)  # [m/s]
COUNT = 300  # draws of a rate of alarms


@pytest.fixture(scope="module")
def records() -> list[PreparedRecord]:
    """Of a damper with worn valves, in three states of filling."""
    worn = small.records(lambda r: r.force - 0.1 * r.fluid, SPEEDS, (small.INTACT, small.DEGRADED, 0.304))
    return small.problem(worn).records


def test_the_scatter_of_the_records_zeros_is_not_that_of_a_wrong_model(records: list[PreparedRecord]) -> None:
    worn, _ = zero_drift(Problem(load("SA8", as_published=True), records))
    rng, peak = np.random.default_rng(1), max(record.peak for record in records)
    zeros = 0.02 * peak * rng.standard_normal(len(records))
    pairs = zip(records, zeros, strict=True)
    moved = [replace(r, force=r.force + z) for r, z in pairs]
    drifting, remarks = zero_drift(Problem(load("SA8", as_published=True), moved))
    assert worn.drift < 0.01 * peak
    assert 0.01 * peak < drifting.drift < 0.04 * peak
    assert "differs from record to record" in remarks[0]


def test_a_single_record_of_another_zero_does_not_make_all_zeros_scatter(records: list[PreparedRecord]) -> None:
    several = [replace(records[0], top_speed=0.1 * (i + 1)) for i in range(8)]
    zeros = np.random.default_rng(2).standard_normal((COUNT, 8))
    usual = [scatter(several, row) for row in zeros]
    assert np.median(usual) == pytest.approx(1.0, rel=0.3)
    assert np.median([scatter(several, row + 60.0 * np.eye(8)[5]) for row in zeros]) < 1.5


def test_errors_are_whitened_by_the_covariance_of_a_zero_of_every_record(records: list[PreparedRecord]) -> None:
    problem = Problem(load("SA8", as_published=True), records[:3], drift=7.0)
    a, b = problem.starts[1:3]
    weight = problem.weight[a:b]
    covariance = np.eye(b - a) + 7.0**2 * np.outer(weight, weight)
    weighted = (problem.forces({}) - problem.measured)[a:b] * weight
    expected = weighted @ np.linalg.solve(covariance, weighted)
    assert np.sum(problem.residual({})[a:b] ** 2) == pytest.approx(expected, rel=1e-9)


def zeroed(records: list[PreparedRecord], zeros: Sequence[float]) -> Problem:
    """Records of a right model whose forces read constants beside the force."""
    right = Problem(load("SA8", as_published=True), records)
    forces = [right.forces({})[a:b] for a, b in itertools.pairwise(right.starts)]
    moved = [replace(r, force=f + z, noise=np.full(len(f), 1.0)) for r, f, z in zip(records, forces, zeros, strict=True)]
    return Problem(load("SA8", as_published=True), moved)


def test_a_zero_that_moves_in_the_order_of_the_records_is_a_fault_and_is_put_right(records: list[PreparedRecord]) -> None:
    count = len(records)
    rng = np.random.default_rng(3)
    evenly, at_once = np.linspace(0.0, 30.0, count), np.where(np.arange(count) >= count // 2, 20.0, 0.0)
    for zeros, effect, size in ((evenly, "zero_drift", 30.0), (at_once, "force_offset", 20.0)):
        fault, still = zero_change(zeroed(records, zeros + rng.standard_normal(count)))
        assert fault is not None
        assert (fault.effect, fault.factor) == (effect, pytest.approx(size, rel=0.15))
        assert np.std(still.means(still.errors({}) * still.weight)) < 2.5
    assert fault.records == tuple(record.name for record in records[count // 2 :])


def test_the_interval_of_a_zero_that_moves_holds_as_often_as_it_says(records: list[PreparedRecord]) -> None:
    rng = np.random.default_rng(4)
    step_of = np.where(np.arange(len(records)) >= len(records) // 2, 40.0, 0.0)
    faults = [zero_change(zeroed(records, step_of + 5.0 * rng.standard_normal(len(records))))[0] for _ in range(60)]
    holds = [abs(fault.factor - 40.0) <= fault.spread for fault in faults if fault is not None]
    assert len(holds) > 50
    assert 0.78 <= np.mean(holds) <= 0.98


def test_a_zero_that_drifts_on_from_record_to_record_is_a_rate(records: list[PreparedRecord]) -> None:
    begun = np.concatenate([[0.0], np.cumsum([np.ptp(r.time) for r in records])[:-1]])
    later = [replace(r, before=float(x)) for r, x in zip(records, begun, strict=True)]
    right = zeroed(later, np.zeros(len(records)))
    rate = 30.0 / begun[-1]
    drifts = [r.force + rate * (x + r.time - r.time[0]) for r, x in zip(right.records, begun, strict=True)]
    pairs = zip(right.records, drifts, strict=True)
    fault, still = zero_change(right.with_records([replace(r, force=f) for r, f in pairs]))
    assert fault is not None
    assert (fault.effect, fault.unit, fault.factor) == ("zero_drift", "N/s", pytest.approx(rate, rel=0.05))
    assert np.ptp(still.means(still.errors({}) * still.weight)) < 1.0


def test_a_drift_takes_its_constant_with_it(records: list[PreparedRecord]) -> None:
    """Which record has the zero of the load cell nobody knows: it need not be the first one."""
    count = len(records)
    fault, still = zero_change(zeroed(records, np.linspace(-15.0, 30.0, count)))
    assert fault is not None and fault.effect == "zero_drift"
    assert np.abs(still.means(still.errors({}) * still.weight)).max() < 2.5


def test_an_even_drift_shows_in_five_records_and_a_step_does_not(records: list[PreparedRecord]) -> None:
    evenly = np.linspace(0.0, 30.0, 5)
    fault, _ = zero_change(zeroed(records[:5], evenly))
    assert fault is not None and fault.effect == "zero_drift"
    uneven = evenly + np.array([5.0, -5.0, 0.0, -5.0, 5.0])
    assert zero_change(zeroed(records[:5], uneven))[0] is None
    assert zero_change(zeroed(records[:5], np.array([0.0, 0.0, 0.0, 30.0, 30.0])))[0] is None


def test_zeros_that_scatter_and_a_force_that_comes_with_the_loss_of_oil_do_not_move(records: list[PreparedRecord]) -> None:
    rng = np.random.default_rng(5)
    pushed_out = np.array([-20.0 * (not record.intact) for record in records])
    for zeros in (10.0 * rng.standard_normal(len(records)), pushed_out + rng.standard_normal(len(records))):
        problem = zeroed(records, zeros)
        assert zero_change(problem) == (None, problem)


def test_a_constant_that_pulls_the_rod_in_is_no_gas_that_is_left(records: list[PreparedRecord]) -> None:
    """No residual pressure does that; more gas in the intact damper looks alike, but then the intact records are wrong."""
    degraded = np.array([not record.intact for record in records])
    rng = np.random.default_rng(6)
    fault, _ = zero_change(zeroed(records, 20.0 * degraded + rng.standard_normal(len(records))))
    assert fault is not None and fault.effect == "force_offset"
    assert fault.records == tuple(record.name for record in records if not record.intact)
    assert zero_change(zeroed(records, -20.0 * ~degraded + rng.standard_normal(len(records))))[0] is None


def test_a_constant_that_comes_with_another_filling_and_more_than_it_is_no_zero(records: list[PreparedRecord]) -> None:
    """As where foam decays in the emptier state: a mean, and an error that is larger than noise."""
    right = zeroed(records, np.zeros(len(records)))
    last = np.array([record.oil_level == records[-1].oil_level for record in records])
    assert 0 < last.sum() < len(last) and not records[int(np.argmax(last)) - 1].intact
    rng = np.random.default_rng(8)
    zeros = right.spread(np.where(last, 20.0, rng.standard_normal(len(records))))
    ripple = right.spread(np.where(last, 1.0, 0.0)) * np.resize([1.0, -1.0], len(zeros))
    for size, moved in ((0.0, True), (60.0, False)):
        pairs = zip(right.records, itertools.pairwise(right.starts), strict=True)
        change = zeros + size * ripple
        problem = right.with_records([replace(r, force=r.force + change[a:b]) for r, (a, b) in pairs])
        assert (zero_change(problem)[0] is not None) == moved


def test_a_force_that_falls_in_one_direction_alone_is_no_zero(records: list[PreparedRecord]) -> None:
    right = zeroed(records, np.zeros(len(records)))
    later = right.spread(np.where(np.arange(len(records)) >= len(records) // 2, 20.0, 0.0))
    rising = np.concatenate([record.velocity > 0.0 for record in records])
    for change, moved in ((later, True), (np.where(rising, 2.0 * later, 0.0), False)):
        pairs = zip(right.records, itertools.pairwise(right.starts), strict=True)
        problem = right.with_records([replace(r, force=r.force + change[a:b]) for r, (a, b) in pairs])
        assert (zero_change(problem)[0] is not None) == moved


def test_few_records_give_a_scatter_of_zeros_that_a_good_load_cell_has(records: list[PreparedRecord]) -> None:
    some = records[:2] + records[5:7]
    drift = [zero_drift(zeroed(some, size * np.array([1.0, -1.0, -1.0, 1.0])))[0].drift for size in (1.0, 300.0)]
    assert drift[0] == pytest.approx(np.sqrt(2.0), rel=0.01)
    assert drift[1] == pytest.approx(RULES.small_zero * max(record.peak for record in some), rel=0.01)


def test_a_zero_of_its_own_that_a_good_load_cell_may_have_is_none_of_the_damper(records: list[PreparedRecord]) -> None:
    peak = max(record.peak for record in records)
    own = np.where(np.arange(len(records)) == 2, 1.0, 0.0)
    zeros = 0.3 * np.random.default_rng(7).standard_normal(len(records))
    small, large = (zeroed(records, size * peak * own + zeros) for size in (0.003, 0.02))
    assert np.all(zero_drift(small)[0].misfits(zero_drift(small)[0].residual({})) < 2.0)
    assert zero_drift(large)[0].drift < 1.0


def test_zeros_whose_bends_are_small_by_chance_without_some_record_scatter_as_all_do(records: list[PreparedRecord]) -> None:
    several = [replace(records[0], top_speed=0.1 * (i + 1)) for i in range(8)]
    zeros = np.random.default_rng(5).standard_normal((COUNT, 8))
    assert np.mean([scatter(several, row) < 0.25 for row in zeros]) < 0.02


def test_zeros_are_not_known_to_less_than_a_load_cell_has(records: list[PreparedRecord]) -> None:
    drifting, remarks = zero_drift(zeroed(records, np.zeros(len(records)).tolist()))
    assert drifting.drift == RULES.least_zero * max(record.peak for record in drifting.records)
    assert not remarks


def test_a_mean_error_that_a_good_load_cell_may_have_is_a_zero_and_a_larger_one_the_models(
    records: list[PreparedRecord],
) -> None:
    """However little the zeros of the others scatter."""
    problem = zeroed(records, np.zeros(len(records)).tolist()).with_drift(1.0)
    good = RULES.small_zero * max(record.peak for record in records)
    for mean, most in ((0.8 * good, good), (4.0 * good, good)):
        zeros = problem.zeros(np.full(len(problem.measured), mean))
        assert zeros == pytest.approx(min(mean, most), rel=0.1)
