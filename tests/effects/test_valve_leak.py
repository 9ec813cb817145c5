"""A leak past the valves: an orifice parallel to the F-v curve, alone and with compressible oil or a rubber mount."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from twintube.core import model
from twintube.core.effects import State, effects_bypass, effects_scale_valve
from twintube.core.kernel import fluid_force
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import Damper, load, names
from twintube.engine.simulate import simulate
from twintube.rig.signals import harmonic_block, oscillations

D = 2000.0  # [N s/m] of the dashpot


@pytest.mark.parametrize("name", names())
@pytest.mark.parametrize(("bleed_re", "bleed_co", "laminar"), [(0.05, 0.02, 0.0), (0.5, 0.5, 1.0), (1e-4, 0.3, 0.4)])
def test_valves_and_leak_pass_what_the_piston_displaces(name: str, bleed_re: float, bleed_co: float, laminar: float) -> None:
    p = load(name, as_published=True).with_(bleed_re=bleed_re, bleed_co=bleed_co, bleed_laminar=laminar).parameters
    for u in (1e-9, 1e-3, 0.02, 0.1, 0.26, 1.0, 5.0, -1e-9, -0.005, -0.1, -0.5, -3.0):
        F = fluid_force(p, u) * effects_scale_valve(p, u)
        assert 0.0 < F / fluid_force(p, u) <= 1.0
        valves = brentq(lambda x, F=F: fluid_force(p, x) - F, min(0.0, u), max(0.0, u), xtol=1e-16)
        assert valves + effects_bypass(p, F) == pytest.approx(u, rel=1e-9, abs=1e-15)


def test_a_leak_takes_most_of_the_slow_force_and_little_of_the_fast_one() -> None:
    base = load("SA8", as_published=True).with_(F_FrS=0.0, F_0=0.0, c_gas=0.0)
    shares = []
    for velocity in (0.05, 0.262, 1.572):
        block = harmonic_block(velocity)
        plain, leaking = (simulate(x, block.stroke, block.velocity) for x in (base, base.with_(bleed_re=0.05)))
        shares.append(leaking.force.max() / plain.force.max())
        # The other direction has valves of its own.
        assert leaking.force.min() == pytest.approx(plain.force.min())
    assert shares[0] < 0.75 < shares[1] < 0.9 < shares[2] < 1.0


def test_a_scale_acts_on_what_the_leak_has_left() -> None:
    block = harmonic_block(0.524)
    base = load("SA8", as_published=True).with_(F_FrS=0.0, bleed_re=0.05, bleed_co=0.1)
    leaking, both = (simulate(x, block.stroke, block.velocity) for x in (base, base.with_(wear_re=-0.2, wear_co=0.1)))
    scale = np.where(block.velocity >= 0.0, 0.8, 1.1)
    np.testing.assert_allclose(both.F_fluid, scale * leaking.F_fluid, rtol=0, atol=1e-6)


def test_the_work_is_the_area_of_the_loop(sa8: Damper) -> None:
    block = harmonic_block(0.524, dt=5e-4, rest=5.0)
    result = simulate(sa8.with_(bleed_re=0.1, bleed_co=0.1), block.stroke, block.velocity)
    a, b = block.marks[3], block.marks[4]
    loop = np.trapezoid(result.force[a : b + 1], block.stroke[a : b + 1])
    assert result.work[b] - result.work[a] == pytest.approx(loop, rel=0.01)


def test_a_loaded_oil_column_is_relieved_through_valves_and_leak(dashpot: Damper) -> None:
    """At rest C dF/dt = -(F/D + bleed sqrt(F / 1000 N)): the speed of the piston says nothing about the valves."""
    C, bleed = 1e-5, 0.1
    p, d, s, f = (
        dashpot.with_(C_fluid=C, column_share=0.0, bleed_re=bleed).parameters,
        blank(Derived),
        blank(State),
        blank(Flow),
    )
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    for i in range(1, 201):
        model.advance(p, d, s, f, 3e-4 * i, 0.3, 0.3, 1e-3)
    # Steady: what the piston displaces passes both.
    root = math.sqrt(s.F_fluid)
    assert s.F_fluid / D + bleed * root / math.sqrt(1000.0) == pytest.approx(0.3, rel=1e-4)
    exact = solve_ivp(
        lambda t, F: -(F / D + bleed * np.sqrt(np.maximum(F, 0.0) / 1000.0)) / C, (0.0, 0.02), [s.F_fluid],
        t_eval=np.linspace(0.0, 0.02, 21), rtol=1e-8,
    ).y[0]  # fmt: skip
    for F in exact[1:15]:
        model.advance(p, d, s, f, 0.06, 0.0, 0.0, 1e-3)
        assert s.F_fluid == pytest.approx(F, rel=0.03, abs=0.005 * exact[0])


@pytest.mark.parametrize("element", [{"C_mount": 1e-10, "tau_mount": 0.0}, {"C_fluid": 1e-10, "C_fluid_co": 1e-10}])
def test_a_stiff_element_in_series_changes_nothing(dashpot: Damper, element: dict[str, float]) -> None:
    leaking = dashpot.with_(bleed_re=0.1, bleed_co=0.2)
    t, z, v = oscillations(0.3, 0.03, 2, 1e-3)
    plain = simulate(leaking, z, v, t).force
    stiff = simulate(leaking.with_(**element), z, v, t).force
    assert np.abs(stiff - plain)[5:].max() < 0.01 * np.abs(plain).max()
