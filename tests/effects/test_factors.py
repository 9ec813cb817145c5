"""Side load, place-dependent friction, valve wear and a wrong fill: the paper's model with another number."""

import numpy as np
import pytest

from twintube.dampers import Damper, load
from twintube.engine.simulate import simulate, work_between
from twintube.rig.signals import AMPLITUDE, harmonic_block


def test_side_load_multiplies_the_friction_and_its_work(sa8: Damper) -> None:
    block = harmonic_block(0.524)
    plain, loaded = (simulate(x, block.stroke, block.velocity) for x in (sa8, sa8.with_(side_load=2.0)))
    fluid = simulate(sa8.with_(F_FrS=0.0), block.stroke, block.velocity)
    fast = np.abs(block.velocity) > 0.06
    p = sa8.parameters
    factor = 1.0 + 2.0 / (1.0 + p.oil_loss_gain * (1.0 - p.oil_level))
    np.testing.assert_allclose(loaded.F_friction[fast], factor * plain.F_friction[fast], rtol=1e-3)
    assert np.array_equal(loaded.F_fluid, plain.F_fluid)
    assert loaded.work[-1] - fluid.work[-1] == pytest.approx(factor * (plain.work[-1] - fluid.work[-1]), rel=0.02)


def test_slow_ramps_show_no_side_load(sa8: Damper) -> None:
    z = np.linspace(-0.01, 0.01, 2001)
    v = np.full(len(z), 1e-5)
    plain, loaded = (simulate(x, z, v).F_friction for x in (sa8, sa8.with_(side_load=5.0)))
    assert loaded == pytest.approx(plain, rel=0.02, abs=1e-3)


def test_friction_follows_the_position_and_never_pushes(sa8: Damper) -> None:
    block = harmonic_block(0.262)
    slope, bow = 30.0, 500.0
    plain, leaning = (
        simulate(x, block.stroke, block.velocity) for x in (sa8, sa8.with_(friction_slope=slope, friction_bow=bow))
    )
    factor = np.maximum(0.0, 1.0 + slope * block.stroke + bow * block.stroke**2)
    np.testing.assert_allclose(leaning.F_friction, factor * plain.F_friction, rtol=0, atol=1e-9)
    assert np.array_equal(leaning.F_fluid, plain.F_fluid)
    # Over a whole oscillation the slope does no net work, the bow adds that of the mean square stroke along the way.
    sloped, bowed = (
        work_between(sa8.with_(**x), block.stroke, block.velocity, block.marks)
        for x in ({"friction_slope": 10.0}, {"friction_bow": 500.0})
    )
    rest = work_between(sa8.with_(F_FrS=0.0), block.stroke, block.velocity, block.marks)
    rubbed = work_between(sa8, block.stroke, block.velocity, block.marks) - rest
    assert sloped - rest == pytest.approx(rubbed, rel=0.02)
    assert (bowed - rest)[-1] / rubbed[-1] == pytest.approx(1.0 + 500.0 * AMPLITUDE**2 / 3.0, rel=0.03)


def test_a_spot_rubs_where_it_is_and_nowhere_else(sa8: Damper) -> None:
    block = harmonic_block(0.262)
    spot = {"friction_spot": 4.0, "spot_at": 0.01, "spot_width": 0.005}
    plain, dented = (simulate(x, block.stroke, block.velocity) for x in (sa8, sa8.with_(**spot)))
    factor = 1.0 + 4.0 * np.exp(-(((block.stroke - 0.01) / 0.005) ** 2))
    np.testing.assert_allclose(dented.F_friction, factor * plain.F_friction, rtol=0, atol=1e-9)
    far = np.abs(block.stroke - 0.01) > 0.03
    assert far.any()
    np.testing.assert_allclose(dented.force[far], plain.force[far], rtol=0, atol=1e-6)


def test_wear_scales_each_branch_and_its_work() -> None:
    block = harmonic_block(1.048)
    base = load("SA8", as_published=True).with_(F_FrS=0.0)
    p = base.parameters
    worn = simulate(base.with_(wear_re=-0.3, wear_co=0.2), block.stroke, block.velocity)
    scaled = base.with_(F_re=[0.7 * F for F in p.F_re], F_co=[1.2 * F for F in p.F_co])
    same = simulate(scaled, block.stroke, block.velocity)
    np.testing.assert_allclose(worn.force, same.force, rtol=1e-6)
    # A step that holds a reversal counts with the direction of its stroke.
    assert worn.work[-1] == pytest.approx(same.work[-1], rel=1e-4)
    assert worn.k_degr.max() == pytest.approx(1.2)


def test_a_weak_blow_off_takes_a_constant_force_where_it_is_open() -> None:
    block, sa8 = harmonic_block(1.048), load("SA8", as_published=True)
    v = block.velocity
    for speed in (0.2, 1.0):
        weak = sa8.with_(opening_re=60.0, opening_co=25.0, opening_speed=speed)
        plain, worn = (simulate(x, block.stroke, v).F_fluid for x in (sa8, weak))
        opened = np.clip(np.abs(v) / speed - 0.5, 0.0, 1.0)
        assert plain - worn == pytest.approx(opened * np.where(v >= 0.0, 60.0, -25.0), abs=1e-6)
    # No spring pulls: at most all of the force is lost.
    none = simulate(sa8.with_(opening_re=1000.0, opening_speed=0.02), block.stroke, v).F_fluid[v > 0.0]
    assert none.min() == 0.0


@pytest.mark.parametrize(
    ("recorded", "error", "true"), [(0.6, -0.1, 0.5), (1.0, -0.1, 0.9), (0.9, 0.3, 1.0), (0.2, -0.3, 0.0)]
)
def test_a_wrong_fill_is_another_fill(recorded: float, error: float, true: float) -> None:
    block = harmonic_block(1.572)
    base = load("SA8", as_published=True).with_(gas_preload=0)
    wrong = simulate(base.with_(oil_level=recorded, level_error=error), block.stroke, block.velocity)
    right = simulate(base.with_(oil_level=true), block.stroke, block.velocity)
    np.testing.assert_allclose(wrong.force, right.force, rtol=0, atol=1e-6)
    np.testing.assert_allclose(wrong.F_friction, right.F_friction, rtol=0, atol=1e-9)
    assert wrong.V_cav == pytest.approx(right.V_cav, abs=1e-15)


def test_the_intact_state_keeps_the_recorded_level() -> None:
    block = harmonic_block(1.048)
    intact = load("SA8", as_published=True)
    a, b = (simulate(x, block.stroke, block.velocity) for x in (intact, intact.with_(level_error=-0.2)))
    assert np.array_equal(a.force, b.force)
