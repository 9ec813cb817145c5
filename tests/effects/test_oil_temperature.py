"""Fade by retained heat, recovery at rest; what a measured temperature does to oil, friction and gas."""

import math
from dataclasses import dataclass

import numpy as np
import pytest

from twintube.common.arrays import Array
from twintube.dampers import load
from twintube.dampers.temperature import at_temperature
from twintube.engine.simulate import simulate
from twintube.fitting.simulation import SimulatedRecords
from twintube.rig.signals import harmonic_block


def test_fluid_force_fades_with_the_work_while_nothing_cools() -> None:
    block = harmonic_block(1.048)
    base = load("SA8", as_published=True)
    plain = simulate(base, block.stroke, block.velocity)
    faded = simulate(base.with_(fade_heat=1e-4, cooling_time=2000.0), block.stroke, block.velocity, block.time)
    end = len(block.time) - 1
    # 40 s against 2000 s: almost all of the work is still there.
    assert faded.F_fluid[end] / plain.F_fluid[end] == pytest.approx(math.exp(-1e-4 * faded.work[end]), rel=0.01)
    assert faded.k_degr[end] == pytest.approx(faded.F_fluid[end] / plain.F_fluid[end])
    assert np.array_equal(faded.F_friction, plain.F_friction)


def test_rest_recovers() -> None:
    z = np.array([0.0, *np.linspace(0, 0.04, 100), 0.04, 0.04, *np.linspace(0.04, 0.0, 100)])
    v = np.array([0.0, *np.full(100, 0.4), 0.0, 0.0, *np.full(100, -0.4)])
    base = load("SA8", as_published=True)
    forces = []
    for rest in (0.1, 60.0, 1e4):
        t = np.cumsum([0.0, *np.full(101, 1e-3), rest, *np.full(100, 1e-3)])
        forces.append(simulate(base.with_(fade_heat=1e-3, cooling_time=60.0), z, v, t).F_fluid[103])
    neutral = simulate(base, z, v).F_fluid[103]
    assert abs(forces[0]) < abs(forces[1]) < abs(forces[2])
    assert forces[2] == pytest.approx(neutral, rel=1e-9)
    # What is gone after one time constant of the cooling is 1 - 1/e of the heat.
    assert math.log(forces[1] / neutral) / math.log(forces[0] / neutral) == pytest.approx(math.exp(-59.9 / 60), rel=0.01)


def test_a_warm_start_thins_the_oil_from_the_beginning() -> None:
    block = harmonic_block(0.262)
    base = load("SA8", as_published=True)
    plain = simulate(base, block.stroke, block.velocity)
    warm = simulate(base.with_(fade_heat=1e-4, H_start=500.0, cooling_time=5.0), block.stroke, block.velocity, block.time)
    assert warm.F_fluid[0] == pytest.approx(plain.F_fluid[0] * math.exp(-0.05))


def test_only_the_laminar_part_of_the_force_knows_the_viscosity() -> None:
    base = load("SA8", as_published=True).with_(fade_heat=1e-4, H_start=1000.0, cooling_time=5.0)
    left = {}
    for speed in (0.1, 1.0):
        z, v = np.linspace(-0.03, 0.03, 61), np.full(61, speed)
        t = np.arange(61) * 1e-3 / speed
        plain, mixed = (
            simulate(damper, z, v, t).F_fluid[1] for damper in (load("SA8", as_published=True), base.with_(turbulence=2.0))
        )
        left[speed] = mixed / plain
    thin = math.exp(-0.1)  # hardly any work has been done after the first millimetre
    assert left == pytest.approx({x: (thin + 2.0 * x) / (1.0 + 2.0 * x) for x in left}, rel=2e-3)


@dataclass
class Warmed:
    """A record of the intact damper at measured temperatures `kelvins` [K]."""

    time: Array
    stroke: Array
    velocity: Array
    kelvins: Array
    oil_level: float = 1.0
    gas_preload: int = 1


def means(warm: float, **changes: float) -> Array:
    """Mean forces [N] of a slow triangle, `warm` [K] beyond the temperature of the F-v curve."""
    z = np.concatenate([np.linspace(-0.03, 0.03, 61), np.linspace(0.03, -0.03, 61)[1:]])
    v = np.where(np.arange(121) < 60, 0.2, -0.2)
    damper = load("SA8", as_published=True)
    record = Warmed(np.arange(121) * 5e-3, z, v, np.full(121, damper.parameters.T_curve + warm))
    problem = SimulatedRecords(damper, [record], parts=4, failed=np.inf)
    return problem.run(problem.rows(), changes.items())[0][5:55]


def test_records_and_simulate_take_the_same_temperature() -> None:
    """What diagnosis compares at a measured temperature is the damper that `at_temperature` makes of it."""
    warm = 20.0
    damper = load("SA8", as_published=True)
    hot = at_temperature(damper, damper.parameters.T_curve + warm).parameters
    changed = {name: getattr(hot, name) for name in ("F_re", "F_co", "F_FrS", "sigma_0", "F_0", "c_gas", "c_gas_lost")}
    assert means(warm) == pytest.approx(means(0.0, **changed), rel=1e-9)
    assert np.max(np.abs(means(warm) - means(0.0))) > 5.0


def test_a_damper_may_fade_and_ease_beyond_the_law() -> None:
    gas = means(20.0, F_FrS=0.0, k_cold=1.0, k_hot=1.0) - means(0.0, F_FrS=0.0)
    lawless = {"F_FrS": 0.0, "k_cold": 1.0, "k_hot": 1.0}
    p = load("SA8", as_published=True).parameters
    spring = p.c_gas * (np.linspace(-0.03, 0.03, 61)[5:55] - 0.0005) - p.F_0 + gas
    plain = means(20.0, **lawless) - spring
    for fade in (0.01, -0.01):
        assert means(20.0, **lawless, fade_kelvin=fade) - spring == pytest.approx(math.exp(-20.0 * fade) * plain, rel=2e-3)
    rubbing = means(20.0) - means(20.0, F_FrS=0.0)
    eased = means(20.0, friction_kelvin=0.01) - means(20.0)
    assert eased == pytest.approx((math.exp(-0.2) - 1.0) * rubbing, rel=1e-6)


def test_a_law_of_its_own_is_nothing_at_the_temperature_of_the_curve() -> None:
    assert np.array_equal(means(0.0, fade_kelvin=0.02, friction_kelvin=0.02)[5:], means(0.0, fade_kelvin=1e-12)[5:])


def test_gas_follows_the_retained_heat_where_nothing_is_measured() -> None:
    block = harmonic_block(1.048)
    base = load("SA8", as_published=True).with_(fade_heat=1e-9, cooling_time=2000.0)
    cold, warm = (simulate(x, block.stroke, block.velocity, block.time) for x in (base, base.with_(gas_heat=1e-5)))
    heat = cold.work  # 40 s against 2000 s
    assert warm.F_gas[-1] / cold.F_gas[-1] == pytest.approx(1.0 + 1e-5 * heat[-1], rel=0.02)
    assert np.array_equal(warm.F_fluid, cold.F_fluid)
