"""Causes that look alike, and two at once, are told apart."""

from pathlib import Path

import pytest

from tests.diagnose.test_diagnose import answered
from twintube import effects


@pytest.mark.parametrize(
    ("kind", "named"),
    [
        ("mount_compliance", {"mount_compliance"}),
        pytest.param("fluid_lag", {"fluid_lag"}, marks=pytest.mark.slow),
        pytest.param("oil_level_error+valve_wear", {"oil_level_error", "valve_wear"}, marks=pytest.mark.slow),
        ("valve_wear+gas_spring", {"valve_wear", "gas_spring"}),
    ],
)
def test_look_alikes_and_pairs_are_told_apart(kind: str, named: set[str], tmp_path: Path) -> None:
    found = answered(kind, tmp_path)
    assert found.verdict == "cause"
    assert {cause.effect for cause in found.causes} == named
    assert found.errors["heldout"]["extended"].force_rmse_N < found.errors["heldout"]["base"].force_rmse_N
    assert set(effects.active(found.extended.parameters)) == named
