"""Shares, bands and curves of the detection, on figures that are known and on the benches."""

from dataclasses import replace

import numpy as np
import pytest

from twintube.dampers import load
from twintube.dampers.freed_gas import VARIED
from twintube.engine.simulate import InputError, simulate
from twintube.inspection import METHODS, Condition, Detection, conditions, first_seen, study
from twintube.inspection.scatter import RANGES, samples
from twintube.rig.signals import harmonic_block
from twintube.vehicle.cars import load_car


def detection(figures, intact, method="eusama", level=0.5) -> Detection:
    return Detection("SA8", METHODS[method], Condition(level, 0), np.asarray(figures, float), np.asarray(intact, float))


@pytest.mark.parametrize("method", ["eusama", "bump"])
def test_at_most_5_percent_of_the_intact_dampers_are_alarmed(method):
    figures = np.random.default_rng(1).normal(50, 5, 1000)
    same = detection(figures, figures, method)
    assert 0.045 <= same.share <= 0.05
    assert same.area == pytest.approx(0.5, abs=1e-9)


def test_dampers_that_are_all_worse_are_all_detected():
    for method, worse in (("eusama", -100.0), ("bump", 100.0)):
        figures = np.random.default_rng(1).normal(50, 5, 100)
        apart = detection(figures + worse, figures, method)
        assert apart.share == 1.0
        assert apart.area == 1.0
        assert apart.band[0] == pytest.approx(0.025 ** (1 / 100)), "Clopper and Pearson, all of 100"
        assert apart.band[1] == 1.0


def test_the_area_is_the_share_of_pairs_in_order():
    random = np.random.default_rng(2)
    worn, intact = random.normal(0, 1, 60), random.normal(1, 1, 60)
    assert detection(worn, intact).area == pytest.approx(np.mean(worn[:, None] < intact[None, :]))
    false_alarms, found = detection(worn, intact).roc
    assert (false_alarms[0], found[0], false_alarms[-1], found[-1]) == (0.0, 0.0, 1.0, 1.0)
    assert (np.diff(found) >= 0).all() and (np.diff(false_alarms) >= 0).all()


def test_a_loss_is_seen_from_the_level_below_which_no_level_is_missed():
    intact = np.arange(100.0)
    low, same = intact - 1000.0, intact
    found = [detection(figures, intact, level=level) for level, figures in ((0.8, low), (0.7, same), (0.6, low), (0.5, low))]
    assert first_seen(found, "SA8", "eusama") == 0.6
    assert first_seen([detection(same, intact)], "SA8", "eusama") is None


def test_draws_are_within_their_ranges_and_a_longer_list_begins_with_a_shorter_one():
    drawn = samples(200, seed=3)
    for item in RANGES:
        values = [sample.values[item.name] for sample in drawn]
        assert item.low <= min(values) < max(values) <= item.high
        assert item.basis and item.reason
    assert samples(5, seed=3) == drawn[:5]
    assert samples(5, seed=4) != drawn[:5]


def test_cars_of_the_scatter_are_as_warm_as_the_law_of_their_damper_says() -> None:
    """A sample at 40 degC is the damper of its own tolerance that `simulate` has at 40 degC."""
    damper, block = load("SA8"), harmonic_block(0.524)
    (sample,) = samples(1, seed=3)
    share = sample.values["force"]
    p = damper.parameters
    made = damper.with_(F_re=[share * F for F in p.F_re], F_co=[share * F for F in p.F_co])
    warm = replace(sample, values={**sample.values, "temperature_degC": 40.0}).made(damper)
    assert simulate(warm, block).force == pytest.approx(simulate(made, block, temperature=313.15).force, abs=1e-6)


def test_the_study_sees_30_percent_oil_and_not_90():
    damper = load("SA8")
    states = conditions((0.9, 0.3), gas_preload=0.0)
    found = study([damper], load_car(), states, ("eusama", "push_down"), count=20, processes=1)
    assert len(found) == 2 * 2 * 2, "methods, levels, model and factor"
    shares = {(d.method.name, d.condition): d.share for d in found}
    for name in ("eusama", "push_down"):
        assert shares[name, states[1]] == 1.0
        assert shares[name, states[0]] <= 0.2
    again = study([damper], load_car(), states, ("push_down",), count=20, processes=2)
    alone = [d.as_json for d in found if d.method.name == "push_down"]
    assert [d.as_json for d in again] == alone, "the number of processes is without effect"


def test_every_way_is_studied_and_the_scalar_factor_once():
    found = study(
        [load("SA8")], load_car(), conditions((0.4,), gas_preload=0.0), ("push_down",), count=20, ways=VARIED, processes=1
    )
    assert [d.condition.freed_gas for d in found if not d.condition.scalar] == list(VARIED)
    assert sum(d.condition.scalar for d in found) == 1
    assert {first_seen(found, "SA8", "push_down", name) for name in VARIED} == {0.4}
    assert first_seen(found, "SA8", "push_down", "return_fast") is None, "was not studied"


@pytest.mark.parametrize("count", [1, 19, 10_001])
def test_a_number_of_samples_without_5_percent_is_refused(count):
    with pytest.raises(InputError, match=rf"^samples = {count}: must be from 20 to 10000$"):
        study([load("SA8")], load_car(), conditions((0.5,), gas_preload=0.0), count=count)
