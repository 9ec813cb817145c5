"""Fade by retained heat, recovery at rest."""

import math

import numpy as np
import pytest

from twintube.dampers import load
from twintube.engine.simulate import simulate
from twintube.rig.signals import harmonic_block


def test_fluid_force_fades_with_the_work_while_nothing_cools() -> None:
    block = harmonic_block(1.048)
    base = load("SA8")
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
    base = load("SA8")
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
    base = load("SA8")
    plain = simulate(base, block.stroke, block.velocity)
    warm = simulate(base.with_(fade_heat=1e-4, H_start=500.0, cooling_time=5.0), block.stroke, block.velocity, block.time)
    assert warm.F_fluid[0] == pytest.approx(plain.F_fluid[0] * math.exp(-0.05))
