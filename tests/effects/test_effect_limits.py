"""Effects at the ends of their ranges: k_degr keeps its declared bound, and a step too short to be one does no harm."""

import math
from dataclasses import fields
from typing import Any

import numpy as np
import pytest

from twintube.core import model
from twintube.core.effects import EFFECTS, State, oil_temperature
from twintube.core.outputs import total_force
from twintube.core.variables import Derived, Flow, Outputs, Parameters, blank
from twintube.dampers import Damper

BOUND = {item.name: item.metadata for item in fields(Outputs)}["k_degr"]["upper"]


def started(damper: Damper) -> tuple[Any, Derived, State, Flow]:
    p, d, s, f = damper.parameters, blank(Derived), blank(State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    model.advance(p, d, s, f, 0.0, 0.0, 0.0, 0.0)
    return p, d, s, f


def wandering(seed: int, steps: int) -> list[tuple[float, float, float]]:
    """Velocities [m/s], strokes at the end [m] and lengths [s] of random steps, some of them rounding of others."""
    rng = np.random.default_rng(seed)
    z, v, motion = 0.0, 0.0, []
    for h in rng.choice([1e-4, 1e-3, 1e-3, 5e-3, 1e-9, 1e-16, 0.0, 2e-2], steps).tolist():
        v = 0.95 * v + rng.uniform(-0.2, 0.2)
        v = math.copysign(v, -z) if abs(z + v * h) > 0.08 else v
        z += v * h
        motion.append((v, z, h))
    return motion


def test_the_bound_of_k_degr_is_that_of_its_factors() -> None:
    """The phases give at most the intact damper's force, which a stiffer valve and cold oil raise, by the law and beyond."""
    ranges = {item.name: item.metadata for effect in EFFECTS.values() for item in effect.parameters}
    stiff = 1.0 + max(ranges["wear_re"]["upper"], ranges["wear_co"]["upper"])
    (law,) = (item.metadata["upper"] for item in fields(Parameters) if item.name == "k_cold")
    cold = law * math.exp(oil_temperature.THICKEST)
    assert 0.95 * BOUND < stiff * cold < BOUND


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("early", [0.0, 0.6, 1.0])
def test_a_gradual_build_up_never_exceeds_the_intact_damper(sa8: Damper, seed: int, early: float) -> None:
    """Each time the gas comes back, the past must not add another step of the force."""
    level = (0.3, 0.5, 0.7, 0.9)[seed]
    damper = sa8.with_(oil_level=level, gas_preload=0, build_up=0.03, early_share=early, carry_over=1.0, tau_build=0.02)
    p, d, s, f = started(damper)
    for v, z, h in wandering(seed, 1500):
        model.advance(p, d, s, f, z, v, v, h)
        assert 0.0 <= s.k_degr <= 1.0 + 1e-12


def test_the_largest_k_degr_is_reached(sa8: Damper) -> None:
    damper = sa8.with_(wear_re=1.0, fade_heat=1e-3, H_start=-2e4, k_cold=10.0)
    p, d, s, f = started(damper)
    s.temperature = damper.parameters.T_cold
    model.advance(p, d, s, f, 1e-6, 0.1, 0.1, 1e-5)
    assert s.k_degr == pytest.approx(20.0 * math.exp(2.0), rel=1e-3)
    assert s.k_degr < BOUND


ELEMENTS: dict[str, dict[str, float]] = {
    "undamped mount": {"C_mount": 2e-5, "tau_mount": 0.0},
    "undamped mount on late valves": {"C_mount": 2e-5, "tau_mount": 0.0, "tau_fluid": 0.02, "C_fluid": 8e-6},
    "mount with a rod": {"C_mount": 2e-5, "m_rod": 2.0, "V_air": 5e-6},
    "oil column": {"C_fluid": 1e-10, "C_fluid_co": 5e-5, "V_air": 1e-10, "tau_fluid": 1e-4},
    "leak": {"leak_film": 1e-5, "leak_power": 2.0},
    "leak under pressure": {"leak_film": 1e-5, "leak_power": 0.0},
}


@pytest.mark.parametrize("element", ELEMENTS.values(), ids=ELEMENTS)
@pytest.mark.parametrize("h", [5e-324, 1e-300, 1e-16, 1e-9])
def test_a_step_that_is_rounding_keeps_the_force(sa8: Damper, element: dict[str, float], h: float) -> None:
    p, d, s, f = started(sa8.with_(oil_level=0.56, gas_preload=0, **element))
    for i in range(100):
        model.advance(p, d, s, f, 3e-4 * (i + 1), 0.3, 0.3, 1e-3)
    before, at = total_force(s), s.z_rod
    for _ in range(20):
        assert model.advance(p, d, s, f, at, 0.3, 0.3, h)
    assert total_force(s) == pytest.approx(before, rel=1e-6)


@pytest.mark.parametrize("friction", [5e-324, 1e-300, 1e-9, 0.0])
def test_friction_that_goes_away_between_steps_leaves_none(sa8: Damper, friction: float) -> None:
    """Tunable: the Dahl force of before is many times the new saturated one."""
    _, d, s, f = started(sa8)
    p = sa8.with_(F_FrS=friction).parameters
    for i in range(20):
        model.advance(sa8.parameters, d, s, f, 3e-4 * (i + 1), 0.3, 0.3, 1e-3)
    assert s.F_friction > 1.0
    model.set_up(p, d)
    assert model.advance(p, d, s, f, 7e-3, 0.3, 0.3, 1e-3)
    assert abs(s.F_friction) <= 2.0 * friction


@pytest.mark.parametrize("element", ELEMENTS.values(), ids=ELEMENTS)
def test_random_steps_give_forces_of_a_damper(sa8: Damper, element: dict[str, float]) -> None:
    p, d, s, f = started(sa8.with_(oil_level=0.8, gas_preload=1, **element))
    for v, z, h in wandering(7, 1200):
        assert model.advance(p, d, s, f, z, v, v, h)
        assert all(math.isfinite(getattr(s, item.name)) for item in fields(State))
        assert abs(total_force(s)) < 1e6
