"""The road is what it says: class D, and never the same twice."""

import numpy as np
import pytest

from twintube import road


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("road_class", ["C", "D"])
def test_measured_density_stays_within_the_limits_of_the_class(seed: int, road_class: str) -> None:
    profile = road.generate(1000, road_class=road_class, seed=seed)
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


def test_nothing_repeats_within_the_run() -> None:
    profile = road.generate(834, seed=1)
    assert profile.length >= 834
    height = profile.height - profile.height.mean()
    spectrum = np.abs(np.fft.rfft(height)) ** 2
    correlation = np.fft.irfft(spectrum) / np.sum(height**2)
    middle = slice(round(60 / road.SPACING), round((profile.length - 60) / road.SPACING))
    assert np.abs(correlation[middle]).max() < 0.9


def test_envelope_is_the_mean_over_the_contact_length() -> None:
    profile = road.generate(200, seed=4)
    count = round(road.CONTACT_LENGTH / road.SPACING)
    # Mean over 6 spacings: trapezoids between 7 samples, cyclic as the profile is.
    weights = np.r_[0.5, np.ones(count - 1), 0.5] / count
    mean = np.zeros_like(profile.height)
    for offset, weight in zip(range(-count // 2, count // 2 + 1), weights, strict=True):
        mean += weight * np.roll(profile.height, offset)
    assert np.abs(profile.enveloped - mean).max() < 0.02 * profile.height.std()
