"""Causes that look alike, and two at once, are told apart."""

from pathlib import Path

import pytest

from tests.diagnosis.test_diagnose import answered
from twintube.core import effects
from twintube.diagnosis import diagnose
from twintube.lab.blind_trials.trials import trial, write


@pytest.mark.parametrize(
    ("kind", "named"),
    [
        pytest.param("mount_compliance", {"mount_compliance"}, marks=pytest.mark.slow),
        pytest.param("fluid_lag", {"fluid_lag"}, marks=pytest.mark.slow),
        pytest.param("oil_level_error+valve_wear", {"oil_level_error", "valve_wear"}, marks=pytest.mark.slow),
        pytest.param(
            "valve_wear+gas_spring",
            {"valve_wear", "gas_spring"},
            marks=[
                pytest.mark.slow,
                pytest.mark.xfail(reason="wear with an opening of its own leaves no more than noise of so small a preload"),
            ],
        ),
    ],
)
def test_look_alikes_and_pairs_are_distinguished(kind: str, named: set[str], tmp_path: Path) -> None:
    answer = answered(kind, tmp_path)
    assert answer.verdict == "cause"
    assert {cause.effect for cause in answer.causes} == named
    assert answer.errors["heldout"]["extended"].force_rmse_N < answer.errors["heldout"]["base"].force_rmse_N
    assert set(effects.active(answer.extended.parameters)) == named


@pytest.mark.slow
def test_a_leak_is_not_taken_for_a_calibration_where_half_of_the_records_fit_another_power(tmp_path: Path) -> None:
    """A leak that does not depend on the speed fits one half better than the true one and fails on the other."""
    answer = diagnose(write(trial("seal_leak", 104), tmp_path))
    assert (answer.verdict, [cause.effect for cause in answer.causes]) == ("cause", ["seal_leak"])
    assert answer.causes[0].gain.heldout > 0.9
    power = answer.extended.parameters.leak_power  # type: ignore[attr-defined]
    if abs(power - 0.5) > 0.1:
        pytest.xfail(f"the leak is named, its law is not: a power of {power:.2f} and leakage beyond the reserve for 0.5")
