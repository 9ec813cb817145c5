"""Gas spring and stops: forces of the stroke that do no work, and the hysteresis of rubber, which does."""

import numpy as np
import pytest

from twintube.dampers import Damper
from twintube.engine.simulate import simulate
from twintube.rig.signals import AMPLITUDE, harmonic_block


def test_a_residual_spring_does_no_work_and_is_no_other_force(sa8: Damper) -> None:
    block = harmonic_block(1.048)
    springy = sa8.with_(c_residual=-500.0, F_residual=150.0)
    plain, extended = (simulate(x, block.stroke, block.velocity) for x in (sa8, springy))
    np.testing.assert_allclose(extended.work, plain.work, rtol=0, atol=1e-9)
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


@pytest.mark.parametrize(("power", "loss"), [(1.5, 0.15), (1.0, 0.0), (2.0, 0.3)])
def test_rubber_loses_a_share_of_what_it_takes(sa8: Damper, power: float, loss: float) -> None:
    """Over one press and release: twice that share of the work stored, the integral of F_stop x^power."""
    block = harmonic_block(0.131, start="rebound")
    F_stop, onset = 800.0, 0.03
    stop = {"F_stop_re": F_stop, "onset_re": onset, "power_stop": power, "loss_stop": loss}
    plain, stopped = (simulate(x, block.stroke, block.velocity) for x in (sa8, sa8.with_(**stop)))
    stored = F_stop * 0.01 * ((AMPLITUDE - onset) / 0.01) ** (power + 1) / (power + 1)
    presses = int(np.sum(np.diff((block.stroke > onset).astype(int)) == 1))
    assert stopped.work[-1] - plain.work[-1] == pytest.approx(2 * loss * presses * stored, rel=0.05, abs=1e-3)
    assert np.array_equal(stopped.F_fluid, plain.F_fluid)
    outside = block.stroke < onset
    assert np.array_equal(stopped.F_friction[outside], plain.F_friction[outside])


def test_a_wrong_preload_shows_on_the_intact_damper(sa8: Damper) -> None:
    """Gas at another pressure: the rod's cross-section times the difference, and the stiffness of enclosed gas with it."""
    intact = sa8.with_(oil_level=1.0, gas_preload=1)
    p = intact.parameters
    rod = np.pi / 4 * p.D_PR**2
    extra = 2e5 * rod
    z = np.linspace(-0.04, 0.04, 9)
    plain, pressed = (simulate(x, z, 0 * z) for x in (intact, intact.with_(F_surplus=extra)))
    stiffness = p.c_gas * 2e5 / (p.F_0 / rod + 1e5)  # goes with the absolute pressure
    np.testing.assert_allclose(pressed.F_gas - plain.F_gas, stiffness * z - extra, rtol=1e-6)
    assert np.array_equal(pressed.F_fluid, plain.F_fluid)


def test_each_state_has_its_own_wrong_pressure(sa8: Damper) -> None:
    """F_surplus is of the charge, c_residual and F_residual of what a lost charge has left."""
    z = np.linspace(-0.04, 0.04, 9)
    lost, charged = sa8, sa8.with_(oil_level=1.0, gas_preload=1)
    for damper, foreign in ((lost, {"F_surplus": 80.0}), (charged, {"c_residual": 3000.0, "F_residual": 80.0})):
        plain, other = (simulate(x, z, 0 * z).F_gas for x in (damper, damper.with_(**foreign)))
        assert np.array_equal(plain, other)
