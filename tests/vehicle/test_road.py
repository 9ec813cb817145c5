"""The road has the spectrum of its class and does not repeat."""

import numpy as np
import pytest

from twintube.vehicle import road
from twintube.vehicle.ride import track


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("road_class", ["C", "D"])
def test_measured_density_stays_within_the_limits_of_the_class(seed: int, road_class: str) -> None:
    profile = road.generate(5000, road_class=road_class, seed=seed)
    centres, density = road.measured_density(profile.height)
    mean = road.GD_N0[road_class] * (centres / road.N_0) ** -2
    assert centres[0] < 0.03
    assert centres[-1] > 1.5
    assert np.all(density > mean / 2)
    assert np.all(density < mean * 2)
    assert road.measured_gd_n0(profile.height) == pytest.approx(road.GD_N0[road_class], rel=0.15)


def test_class_d_is_1024e_6() -> None:
    assert road.GD_N0["D"] == 1024e-6


def test_seeds_reproduce_and_differ() -> None:
    a, b, c = (road.generate(500, seed=s).height for s in (1, 1, 2))
    assert np.array_equal(a, b)
    assert not np.array_equal(a, c)


def test_a_longer_road_continues_a_shorter_one() -> None:
    short, long = road.generate(200, seed=3), road.generate(5000, seed=3)
    assert np.array_equal(short.height, long.height[: len(short.height)])
    assert np.array_equal(short.enveloped, long.enveloped[: len(short.enveloped)])


def test_the_profile_does_not_depend_on_the_speed() -> None:
    slow, fast = track(18.0, 100.0, seed=2), track(36.0, 50.0, seed=2)  # 5 and 10 m/s
    assert np.allclose(slow.heights[20000::2], fast.heights[10000:], rtol=0, atol=1e-12)


def test_nothing_repeats() -> None:
    height = road.generate(4000, seed=1).height
    height = height - height.mean()
    count = len(height)
    correlation = np.correlate(height[::10], height[::10], "full")[count // 10 :] / np.sum(height[::10] ** 2)
    assert np.abs(correlation[round(100 / road.SPACING / 10) :]).max() < 0.6


def test_positions_outside_the_road_are_refused() -> None:
    with pytest.raises(ValueError, match=r"position 0 to 11 m: must be from 0 to 10 m"):
        road.generate(10.0).at(np.array([0.0, 11.0]))


def test_envelope_is_the_mean_over_the_contact_length() -> None:
    profile = road.generate(200, seed=4)
    half = round(road.CONTACT_LENGTH / road.SPACING) // 2
    fine = np.arange(0.0, road.CONTACT_LENGTH, 1e-4) - road.CONTACT_LENGTH / 2
    for centre in (3.0, 50.02, 120.5):
        position = centre + fine
        mean = np.interp(position, np.arange(len(profile.height)) * road.SPACING, profile.height).mean()
        assert profile.at(np.array([centre]))[0] == pytest.approx(mean, abs=0.02 * profile.height.std())
    assert half == 3
