"""The dead lengths in the files are those of the calibration, and physically possible."""

import pytest

from twintube.claims.calibrate import FLAT, calibrate, deviations
from twintube.claims.lengths import HIGHEST, LONGEST, SHORTEST, STEP, candidates, pressure
from twintube.dampers import load, names


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
    assert "twintube calibrate" in damper.assumed["geometry.dead_length"]


def test_gas_of_a_long_dead_length_is_refused() -> None:
    """SA5 at 90 mm would be squeezed to 57 bar."""
    assert pressure(load("SA5").with_(dead_length=0.09)) == pytest.approx(57, abs=1)
    assert max(candidate.parameters.dead_length for candidate in candidates(load("SA5"))) < 0.09


def test_deviations_name_the_claims_of_the_damper() -> None:
    assert set(deviations(load("SA2"))) == {"C1", "C2", "C3", "C16"}
    assert set(deviations(load("SA7"))) == {"C1", "C2", "C3", "C4", "C15", "C16"}
    assert {"C5 largest", "C7 first", "C9 40%"} <= set(deviations(load("SA8")))
