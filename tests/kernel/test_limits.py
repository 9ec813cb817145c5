"""Limits in which the answer is known without the kernel."""

import numpy as np
import pytest

from twintube.core.kernel import fill, prepare, step
from twintube.core.variables import Derived, Flow, State, blank
from twintube.dampers import load, names
from twintube.engine.simulate import simulate
from twintube.rig.signals import harmonic_block


@pytest.mark.parametrize("name", names())
@pytest.mark.parametrize("velocity", [0.05, 0.524, 2.0])
def test_full_damper_with_preload_is_the_intact_one(name: str, velocity: float) -> None:
    block = harmonic_block(velocity)
    result = simulate(load(name, as_published=True), block.stroke, block.velocity)
    assert np.all(result.k_degr == 1.0)
    assert np.all(result.V1_gas == 0.0)
    assert np.all(result.V2_gas == 0.0)


@pytest.mark.parametrize("name", names())
def test_empty_damper_has_no_fluid_force(name: str) -> None:
    block = harmonic_block(1.048)
    result = simulate(load(name, as_published=True).with_(oil_level=0.0, gas_preload=0), block.stroke, block.velocity)
    assert np.all(result.k_degr == 0.0)
    assert np.all(result.F_fluid == 0.0)


@pytest.mark.parametrize("name", names())
def test_neutral_foam_and_cavitation_are_variant_2(name: str) -> None:
    damper = load(name, as_published=True)
    block = harmonic_block(1.572)
    base = damper.with_(oil_level=damper.measured_levels[-1], gas_preload=0, S_BV=0.0, S_PV=0.0, Y_Co_cav=0.0, Y_Re_cav=0.0)
    result = simulate(base, block.stroke, block.velocity)
    p = damper.parameters
    assert np.all(result.V1_foam + result.V2_foam + result.V3_foam == 0.0)
    # Between the splits only the coefficients of equations 23 to 29 occur.
    steady = np.diff(result.k_degr, prepend=np.nan) == 0.0
    allowed = [0.0, 1.0, p.X_Re, p.X_Co1, p.X_Co2 + p.G_PV * (1 - p.X_Co2)]
    distance = np.abs(result.k_degr[steady][:, None] - np.array(allowed)).min(axis=1)
    assert steady.mean() > 0.7
    assert distance.max() < 1e-9
    # Parameters of foam and cavitation do nothing then.
    other = base.with_(S_BVoil=0.9, S_PVoil=0.9, B=0.1, E=3.0, v_cav=0.1, v_foam=0.01)
    assert np.array_equal(simulate(other, block.stroke, block.velocity).force, result.force)


def test_slow_motion_neither_foams_nor_cavitates() -> None:
    damper = load("SA8", as_published=True).with_(oil_level=0.5, gas_preload=0, v_cav=0.9)
    block = harmonic_block(0.05)
    result = simulate(damper, block.stroke, block.velocity)
    assert np.all(result.V1_foam + result.V2_foam + result.V3_foam == 0.0)
    assert np.all(result.V_cav == 0.0)


def test_fv_curve_alone() -> None:
    damper = load("SA1", as_published=True).with_(F_FrS=0.0, F_0=0.0, c_gas=0.0)
    p = damper.parameters
    velocity = np.linspace(-2.0, 2.0, 401)
    stroke = np.cumsum(velocity) * 1e-4
    result = simulate(damper, stroke - stroke.mean(), velocity)
    rebound = np.interp(velocity, [0.0, *p.v_re], [0.0, *p.F_re])
    compression = -np.interp(-velocity, [0.0, *p.v_co], [0.0, *p.F_co])
    np.testing.assert_allclose(result.force, np.where(velocity > 0, rebound, compression), rtol=0, atol=1e-9)


def test_fv_curve_goes_on_along_its_last_segment() -> None:
    damper = load("SA1", as_published=True).with_(F_FrS=0.0, F_0=0.0, c_gas=0.0)
    result = simulate(damper, [0.0, 0.001], [15.0, 15.0])
    v, F = damper.parameters.v_re[3:5], damper.parameters.F_re[3:5]
    slope = (F[1] - F[0]) / (v[1] - v[0])
    assert result.force[1] == pytest.approx(F[1] + slope * (15.0 - v[1]), rel=1e-12)


def test_gas_in_v1_delays_the_rebound_force_by_its_volume() -> None:
    """X_Re = 0: gas g in V1 takes the stroke g / A_1, then oil comes at once (equations 16, 23, 24)."""
    damper = load("SA7", as_published=True).with_(oil_level=0.35, gas_preload=0)
    assert damper.parameters.X_Re == 0.0
    d, s, f = blank(Derived), blank(State), blank(Flow)
    p = damper.parameters
    prepare(p, d)
    fill(p, d, s, 0.0)
    gas = s.V1_gas
    assert gas > 0
    step(p, d, s, f, gas / d.A_1 - 1e-6, 0.04, 0.04)
    assert s.k_degr == 0.0
    step(p, d, s, f, gas / d.A_1 + 1e-6, 0.04, 0.04)
    assert s.k_degr == pytest.approx(0.5, abs=1e-6)
    step(p, d, s, f, gas / d.A_1 + 2e-6, 0.04, 0.04)
    assert s.k_degr == 1.0


def test_foam_of_a_known_recipe() -> None:
    """Rebound with an empty reserve: the bottom valve's gas makes foam of S (1 + S_oil) times its volume (31, 34)."""
    damper = load("SA8", as_published=True).with_(
        oil_level=0.3, gas_preload=0, S_BV=0.5, S_BVoil=0.4, Y_Co_cav=0.0, Y_Re_cav=0.0
    )
    d, s, f = blank(Derived), blank(State), blank(Flow)
    p = damper.parameters
    prepare(p, d)
    fill(p, d, s, -0.02)
    assert s.V3_oil == 0.0
    step(p, d, s, f, -0.01, 0.5, 0.5)
    gas = d.A_rod * 0.01
    assert s.V2_foam == pytest.approx(0.5 * gas * 1.4, rel=1e-12)
    assert s.V2_foam_oil / s.V2_foam == pytest.approx(0.4 / 1.4, rel=1e-12)
