"""Gas spring and stops: forces of the stroke that do no work."""

from typing import Any

import numpy as np
import pytest

from twintube.parameters import Damper
from twintube.rig import harmonic_block
from twintube.simulate import simulate


@pytest.mark.parametrize("added", [{"c_residual": -500.0, "F_residual": 150.0}, {"F_stop_re": 900.0, "F_stop_co": 500.0}])
def test_no_work_and_no_other_force(sa8: Damper, added: dict[str, Any]) -> None:
    block = harmonic_block(1.048)
    plain, extended = (simulate(x, block.stroke, block.velocity) for x in (sa8, sa8.with_(**added)))
    assert extended.work == pytest.approx(plain.work, abs=1e-9)
    assert np.array_equal(extended.F_fluid, plain.F_fluid)
    assert np.array_equal(extended.F_friction, plain.F_friction)
    assert not np.array_equal(extended.F_gas, plain.F_gas)


def test_gas_spring_is_a_line(sa8: Damper) -> None:
    z = np.linspace(-0.04, 0.04, 9)
    plain, extended = (simulate(x, z, 0 * z).F_gas for x in (sa8, sa8.with_(c_residual=3000.0, F_residual=80.0)))
    assert extended - plain == pytest.approx(3000.0 * z - 80.0)


def test_stops_push_back_beyond_their_onset_only(sa8: Damper) -> None:
    z = np.array([-0.05, -0.045, -0.04, 0.0, 0.03, 0.04])
    stops = {"F_stop_re": 1000.0, "onset_re": 0.03, "F_stop_co": 600.0, "onset_co": 0.04}
    plain, extended = (simulate(x, z, 0 * z).F_gas for x in (sa8, sa8.with_(**stops)))
    expected = [-600.0, -600.0 * 0.5**1.5, 0.0, 0.0, 0.0, 1000.0]
    assert extended - plain == pytest.approx(expected, abs=1e-9)
