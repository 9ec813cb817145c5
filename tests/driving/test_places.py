"""Exchanged channels are found by what the wheels share, and unrelated signals are not taken for exchanged ones."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from rolling import rolling

from twintube import load
from twintube.driving.channels import NAMES, PLACES, channel_name
from twintube.driving.drives import driven
from twintube.driving.monitor import watch
from twintube.driving.places import EDGES, likelier, limit, linked, links
from twintube.driving.scenes import Conditions, Vehicle, Wear, scene
from twintube.driving.signals import Signals
from twintube.driving.spectra import spectra
from twintube.errors import InputError
from twintube.vehicle.cars import load_car

VEHICLE = Vehicle(load_car(), load("SA7"), load("SA8"))
BOTH = ("speed", "accel")


def exchanged(signals: Signals, one: str, other: str, sensors: tuple[str, ...]) -> Signals:
    names = {channel_name(sensor, one): channel_name(sensor, other) for sensor in sensors}
    names |= {other: one for one, other in names.items()}
    return replace(signals, values={name: signals.values[names.get(name, name)] for name in signals.values})


def with_speeds_alone(signals: Signals) -> Signals:
    return replace(signals, values={name: x for name, x in signals.values.items() if "wheel_accel" not in name})


@pytest.fixture(scope="module")
def worn() -> Signals:
    """A fast drive on a smooth road with a worn damper: the rear wheels come 0.1 s after the front ones."""
    wear = Wear((1.0, 1.0, 0.4, 1.0), (1, 1, 0, 1))
    return driven(scene(VEHICLE, Conditions("B", 100.0, 40.0), wear))


@pytest.mark.parametrize("sensors", [("speed",), ("accel",), BOTH])
@pytest.mark.parametrize(("one", "other"), list(combinations(PLACES, 2)))
def test_two_exchanged_wheels_are_named(worn: Signals, one: str, other: str, sensors: tuple[str, ...]) -> None:
    with pytest.raises(InputError, match="exchanged wheels") as error:
        watch(exchanged(worn, one, other, sensors))
    for sensor in sensors:
        assert f"{channel_name(sensor, one)} shows the {NAMES[other]}" in str(error.value)
        assert f"{channel_name(sensor, other)} shows the {NAMES[one]}" in str(error.value)
    assert str(error.value).count(" shows ") == 2 * len(sensors)


@pytest.mark.parametrize(("one", "other"), list(combinations(PLACES, 2)))
def test_exchanged_wheel_speeds_are_found_without_accelerations(worn: Signals, one: str, other: str) -> None:
    with pytest.raises(InputError, match=f"{channel_name('speed', one)} shows the {NAMES[other]}"):
        watch(with_speeds_alone(exchanged(worn, one, other, ("speed",))))


def test_the_sides_of_the_whole_car_are_told_by_its_yaw(worn: Signals) -> None:
    mirrored = exchanged(exchanged(worn, "fl", "fr", BOTH), "rl", "rr", BOTH)
    assert likelier(links(spectra(mirrored))) == []
    with pytest.raises(InputError, match="in a left turn the right wheels must turn faster"):
        watch(mirrored)


def test_a_drive_with_its_own_names_is_judged(worn: Signals) -> None:
    for drive in (worn, with_speeds_alone(worn)):
        assert likelier(links(spectra(drive))) == []
        watch(drive)


def test_likelihood_of_unrelated_signals_is_exponential() -> None:
    """Mean 1, and a share of exp(-3) above 3: each within four standard errors of the count."""
    random, found = np.random.default_rng(1), []
    for _ in range(70):
        first, second = (random.standard_normal((2, 4, 10, 8)) for _ in range(2))
        found += list(linked(first[0] + 1j * first[1], second[0] + 1j * second[1], 80.0).ravel())
    count, share = len(found), np.exp(-3.0)
    assert np.mean(found) == pytest.approx(1.0, abs=4.0 / np.sqrt(count))
    assert np.mean(np.array(found) > 3.0) == pytest.approx(share, abs=4.0 * np.sqrt(share / count))


def test_wheels_without_a_road_have_no_order() -> None:
    """Independent values are counted right: windows of noise that lie half over one another pass no limit."""
    sums = []
    for seed in range(20):
        found = links(spectra(rolling(rough=0.0, seconds=60.0, seed=seed)))
        assert likelier(found) == []
        sums += [found.followed[0][i, k] for i in range(4) for k in range(4) if i != k]
    assert np.mean(sums) == pytest.approx(len(EDGES) - 1, rel=0.1)


def test_the_limit_is_passed_by_chance_as_often_as_said() -> None:
    """A link is a sum of exponential variables, one a band; of so many trials 20 pass a chance of a hundredth."""
    trials = np.random.default_rng(2).exponential(size=(2000, 8, len(EDGES) - 1)).sum(axis=(1, 2))
    level = limit(8, 1, chance=0.01)
    assert np.count_nonzero(trials > level) == pytest.approx(20, abs=4.0 * np.sqrt(20))
    assert limit(8, 1) < limit(8, 574)
