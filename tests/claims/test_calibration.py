"""The dead lengths in the files are those of the calibration, and physically possible."""

import pytest

from twintube.claims.calibrate import FLAT, calibrate, deviations
from twintube.claims.lengths import STEP, candidates
from twintube.dampers import load, names
from twintube.dampers.dead_length import HIGHEST, LONGEST, SHORTEST, bounds, pressure


@pytest.mark.parametrize("name", ["SA5"])
def test_dead_length_in_the_file_is_the_calibrated_one(name: str) -> None:
    assert calibrate(load(name)).chosen.dead_length == pytest.approx(load(name).parameters.dead_length)


@pytest.mark.slow
@pytest.mark.parametrize("name", names())
def test_every_dead_length_is_the_calibrated_one(name: str) -> None:
    calibration = calibrate(load(name))
    assert calibration.chosen.dead_length == pytest.approx(load(name).parameters.dead_length)
    smallest = min(fit.misfit for fit in calibration.fits)
    assert calibration.chosen.misfit <= smallest + FLAT
    assert calibration.range[0] <= calibration.chosen.dead_length <= calibration.range[1]


@pytest.mark.parametrize("name", names())
def test_dead_lengths_are_possible(name: str) -> None:
    damper = load(name)
    assert SHORTEST <= damper.parameters.dead_length <= LONGEST
    assert damper.parameters.dead_length / STEP == pytest.approx(round(damper.parameters.dead_length / STEP))
    assert 6.0 < pressure(damper) <= HIGHEST
    assert all(pressure(candidate) <= HIGHEST for candidate in candidates(damper))
    assert "twintube paper calibrate" in damper.assumed["geometry.dead_length"]


def test_gas_of_a_long_dead_length_is_refused() -> None:
    """SA5 at 90 mm would be squeezed to 57 bar."""
    assert pressure(load("SA5").with_(dead_length=0.09)) == pytest.approx(57, abs=1)
    assert max(candidate.parameters.dead_length for candidate in candidates(load("SA5"))) < 0.09


def test_deviations_name_the_claims_of_the_damper() -> None:
    assert set(deviations(load("SA2"))) == {"C1", "C2", "C3", "C16"}
    assert set(deviations(load("SA7"))) == {"C1", "C2", "C3", "C4", "C15", "C16"}
    assert {"C5 largest", "C7 first", "C9 40%"} <= set(deviations(load("SA8")))


@pytest.mark.parametrize("name", names())
def test_bounds_are_those_of_the_candidates(name: str) -> None:
    """The grid of the calibration ends where the bounds do."""
    low, high = bounds(load(name))
    lengths = [candidate.parameters.dead_length for candidate in candidates(load(name))]
    assert lengths[0] == pytest.approx(low) and 0.0 <= high - lengths[-1] < STEP
    assert pressure(load(name).with_(dead_length=high)) <= HIGHEST
    if high < LONGEST:
        assert pressure(load(name).with_(dead_length=high + 2e-3)) > HIGHEST


def test_the_own_dead_length_is_within_the_bounds() -> None:
    assert bounds(load("SA3").with_(dead_length=0.03))[0] == 0.03
    assert bounds(load("SA3").with_(dead_length=0.13))[1] == 0.13
