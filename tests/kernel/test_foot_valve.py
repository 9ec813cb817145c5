"""Compression faster than oil follows into V1: the reading `foot_valve`."""

import numpy as np
import pytest

from twintube.core.kernel.forces import P_AMBIENT, UNREACHED
from twintube.dampers import Damper, load, names
from twintube.engine.simulate import at_rest, simulate
from twintube.rig.signals import Signal, harmonic_block


def free(name: str = "SA8", share: float = 0.0, **changes: float) -> Damper:
    """An intact damper whose foot valve makes a share of the compression force."""
    return load(name).with_(foot_valve=share, **changes)


def fills_up_to(damper: Damper) -> float:
    return float(at_rest(damper, 0.0)[1].v_fill)


def last(block: Signal, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Values of the last rebound and of the compression after it."""
    begin, end = block.marks[-2:]
    moving = block.velocity[begin:end]
    return values[begin:end][moving > 0.0], values[begin:end][moving < 0.0]


@pytest.mark.parametrize("name", names())
@pytest.mark.parametrize("share", [0.0, 0.05, 0.1])
@pytest.mark.parametrize("gas", [0, 1])
def test_v1_has_no_pressure_left_at_the_speed_up_to_which_it_fills(name: str, share: float, gas: int) -> None:
    """Reserve, and foot valve over the rod, less piston valve over its ring."""
    damper = free(name, share, gas_preload=gas)
    p, d = damper.parameters, at_rest(damper, 0.0)[1]
    force = float(np.interp(d.v_fill, [0.0, *p.v_co], [0.0, *p.F_co]))
    if d.v_fill <= p.v_co[-1]:
        reserve = P_AMBIENT + d.F_0 / d.A_rod
        assert reserve + share * force / d.A_rod == pytest.approx((1.0 - share) * force / d.A_1, rel=1e-9)


@pytest.mark.parametrize("name", names())
def test_a_foot_valve_with_the_rods_share_fills_v1_at_any_speed(name: str) -> None:
    d = at_rest(load(name), 0.0)[1]
    rod = d.A_rod / d.A_2
    assert fills_up_to(load(name)) == fills_up_to(free(name, 1.001 * rod)) == UNREACHED
    assert fills_up_to(free(name, 0.999 * rod)) > fills_up_to(free(name)) > fills_up_to(free(name, gas_preload=0))


def test_below_that_speed_nothing_changes() -> None:
    block = harmonic_block(0.9 * fills_up_to(free()))
    assert np.array_equal(simulate(free(), block).force, simulate(load("SA8"), block).force)


def test_above_it_force_is_lost_in_compression_and_at_the_begin_of_rebound() -> None:
    """At most the force of that speed is left. What has not followed is a void, which closes without force."""
    damper, block = free(), harmonic_block(0.786)
    run, intact, most = simulate(damper, block), simulate(load("SA8"), block), fills_up_to(damper)
    p = damper.parameters
    fast = run.velocity < -1.05 * most  # not the step across it
    np.testing.assert_allclose(-run.F_fluid[fast], np.interp(most, [0.0, *p.v_co], [0.0, *p.F_co]), rtol=0.01)
    assert np.abs(intact.F_fluid[fast]).min() > np.abs(run.F_fluid[fast]).max()
    k, void = (last(block, values)[0] for values in (run.k_degr, run.V1_gas))
    assert void[0] > 0.0 and void[-1] == 0.0
    assert k[1] == 0.0 and k[-1] == 1.0
    assert np.all(np.diff(k[1:]) >= 0.0), "once closed it stays closed"
    assert run.V2_gas.max() == 0.0, "a void does not pass the piston valve"


def test_the_void_is_what_the_piston_takes_and_does_not_get() -> None:
    """Of a sine V sin(a), v_fill follows, but never more than V2 gives."""
    damper, block = free(), harmonic_block(0.786)
    d = at_rest(damper, 0.0)[1]
    angle = np.linspace(np.arcsin(d.v_fill / 0.786), np.pi, 10_000)
    takes = np.sin(angle)
    missing = takes - np.minimum(d.v_fill / 0.786, d.A_2 / d.A_1 * takes)
    expected = d.A_1 * float(np.abs(block.stroke).max()) * np.cumsum(missing) * (angle[1] - angle[0])
    void = last(block, simulate(damper, block).V1_gas)[1]
    assert (void.max(), void[-1]) == pytest.approx((expected.max(), expected[-1]), rel=0.01)


@pytest.mark.parametrize("share", [-0.1, 1.1])
def test_a_share_is_from_0_to_1(share: float) -> None:
    with pytest.raises(ValueError, match=rf"foot_valve = {share}: must be a number from 0 to 1"):
        free(share=share)
