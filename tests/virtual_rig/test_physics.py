import ast
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import virtual_rig
from virtual_rig import run, virtual_damper

DAMPER = virtual_damper("SA8")


def sine(velocity, count=3, amplitude=0.045, samples=600):
    phase = np.linspace(0, 2 * np.pi * count, count * samples + 1)
    return phase * amplitude / velocity, amplitude * np.sin(phase)


@cache
def record(velocity, oil_level=1.0, gas_preload=True, count=3):
    return run(DAMPER, *sine(velocity, count), oil_level, gas_preload)


def works(r, samples=600):
    edges = range(0, len(r.time), samples)
    return np.array([np.trapezoid(r.force[a : a + samples + 1], r.stroke[a : a + samples + 1]) for a in edges[:-1]])


@pytest.mark.parametrize("velocity", [0.05, 1.572])
@pytest.mark.parametrize(("oil_level", "gas_preload"), [(1.0, True), (0.56, False), (0.3, False)])
def test_oil_and_gas_are_conserved(velocity, oil_level, gas_preload):
    r = record(velocity, oil_level, gas_preload, 8)
    assert np.allclose(r.oil.sum(0), oil_level * DAMPER.V_oil, rtol=1e-9)
    gas = (r.free_gas + r.dissolved_gas).sum(0)
    assert np.allclose(gas, gas[0], rtol=1e-9)
    assert (r.pressure > 0).all()
    for volume in (r.oil, r.free_gas, r.bubbles, r.dissolved_gas):
        assert volume.min() > -1e-9


def test_intact_curve_rises_and_has_the_size_of_a_car_damper():
    rebound, compression = [], []
    for velocity in (0.05, 0.131, 0.262, 0.524, 1.048, 1.572):
        r = record(velocity)
        rebound.append(r.force[1200])
        compression.append(r.force[1500])
    assert (np.diff(rebound) > 0).all() and (np.diff(compression) < 0).all()
    assert 600 < rebound[2] < 800 and 1400 < rebound[4] < 2050
    assert (np.negative(compression[1:]) < rebound[1:]).all()


def test_preload_makes_a_gas_spring():
    def slope(gas_preload):
        r = run(DAMPER, *sine(0.001, 2), 1.0, gas_preload)
        up, down = r.force[550:651], r.force[850:951][::-1]  # the same strokes in both directions
        return np.polyfit(r.stroke[550:651], (up + down) / 2, 1)[0]

    assert slope(True) > 1.5 * slope(False)


@pytest.mark.parametrize(("oil_level", "gas_preload"), [(1.0, True), (0.4, False)])
def test_every_oscillation_dissipates(oil_level, gas_preload):
    r = record(1.048, oil_level, gas_preload)
    assert (works(r) > 0).all()
    assert (np.diff(r.dissipated) >= -1e-6).all()
    assert r.temperature[-1] > r.temperature[0]


@pytest.mark.parametrize(("oil_level", "gas_preload"), [(1.0, True), (0.4, False)])
def test_force_does_not_depend_on_the_tolerance(oil_level, gas_preload):
    base = record(1.048, oil_level, gas_preload)
    tight = run(DAMPER, *sine(1.048), oil_level, gas_preload, rtol=1e-9)
    assert np.abs(base.force - tight.force).max() < 0.01 * np.abs(tight.force).max()


@pytest.mark.parametrize("velocity", [0.05, 0.524, 1.572])
def test_less_oil_less_work(velocity):
    full, half, little = (works(record(velocity, x, x == 1, 8))[-1] for x in (1.0, 0.5, 0.3))
    assert little < half < full


def test_intact_stays_the_same_and_degraded_fades():
    intact, degraded = works(record(1.572, 1.0, True, 19)), works(record(1.572, 0.5, False, 19))
    assert intact[1:] == pytest.approx(intact[1], rel=0.02)
    assert degraded[-1] < 0.97 * degraded[1]


def test_force_comes_late_in_the_stroke_when_oil_is_lost():
    r = record(0.05, 0.4, False)
    up = r.force[600 + 450 : 600 + 750]  # from the lowest to the highest stroke
    assert up[:60].max() < 0.6 * up.max()


def test_bad_input_is_refused():
    t, z = sine(0.5)
    for time, stroke, oil in ((t, z * 10, 1.0), (t[::-1], z, 1.0), (t, z, 0.0), (t, z, 1.5), (t, z[:-1], 1.0)):
        with pytest.raises(ValueError):
            run(DAMPER, time, stroke, oil)


def test_nothing_but_dimensions_comes_from_twintube():
    for path in Path(virtual_rig.__file__).parent.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("twintube"):
                assert node.module == "twintube.parameters"
            if isinstance(node, ast.Import):
                assert not any(name.name.startswith("twintube") for name in node.names)
