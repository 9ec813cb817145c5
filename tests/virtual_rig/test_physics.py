from functools import cache

import numpy as np
import pytest

from tests.eight import EIGHT
from twintube.lab.virtual_rig import run, virtual_damper

DAMPER = virtual_damper("SA8")


def sine(velocity, count=3, amplitude=0.045, samples=600):
    phase = np.linspace(0, 2 * np.pi * count, count * samples + 1)
    return phase * amplitude / velocity, amplitude * np.sin(phase)


@cache
def record(velocity, oil_level=1.0, gas_preload=True, count=3, name="SA8"):
    return run(virtual_damper(name), *sine(velocity, count), oil_level, gas_preload=gas_preload)


@cache
def relative(velocity, oil_level, name="SA8", count=19):
    """Work of every oscillation relative to intact."""
    return works(record(velocity, oil_level, False, count, name)) / works(record(velocity, 1.0, True, count, name))


def assert_conserves(r):
    assert np.allclose(r.oil.sum(0), r.oil_level * r.damper.V_oil, rtol=1e-9)
    gas = (r.free_gas + r.dissolved_gas).sum(0)
    assert np.allclose(gas, gas[0], rtol=1e-9)
    assert (r.pressure > 0).all()
    for volume in (r.oil, r.oil[2] - r.film, r.film, r.free_gas, r.bubbles, r.free_gas - r.bubbles, r.dissolved_gas):
        assert volume.min() > -1e-8


def works(r, samples=600):
    edges = range(0, len(r.time), samples)
    return np.array([np.trapezoid(r.force[a : a + samples + 1], r.stroke[a : a + samples + 1]) for a in edges[:-1]])


@pytest.mark.parametrize("velocity", [0.05, 1.572])
@pytest.mark.parametrize(("oil_level", "gas_preload"), [(1.0, True), (0.56, False), (0.3, False)])
def test_oil_and_gas_are_conserved(velocity, oil_level, gas_preload):
    assert_conserves(record(velocity, oil_level, gas_preload, 8))


@pytest.mark.parametrize("name", EIGHT)
def test_every_damper_runs_with_little_oil(name):
    for oil_level in (0.6, 0.35):
        r = record(1.048, oil_level, False, 3, name)
        assert_conserves(r)
        assert (works(r) > 0).all()


@pytest.mark.parametrize("name", EIGHT)
def test_intact_damper_reaches_the_forces_it_is_sized_for(name):
    damper = virtual_damper(name)
    gas = damper.preload * damper.A_rod  # pushes the rod out
    rebound, compression = [], []
    for velocity in (damper.forces.slow[0], 0.52, damper.forces.fast[0]):
        r = record(velocity, name=name)
        rebound.append(r.force[1200] + gas)
        compression.append(-r.force[1500] - gas)
    for i, point in ((0, damper.forces.slow), (2, damper.forces.fast)):
        assert rebound[i] == pytest.approx(point[1], rel=0.15)
        assert compression[i] == pytest.approx(point[2], rel=0.2)  # the weakest check valve's spring
    assert (np.diff(rebound) > 0).all() and (np.diff(compression) > 0).all()


def test_preload_makes_a_gas_spring():
    def slope(gas_preload):
        r = run(DAMPER, *sine(0.001, 2), 1.0, gas_preload=gas_preload)
        up, down = r.force[550:651], r.force[850:951][::-1]  # the same strokes in both directions
        return np.polyfit(r.stroke[550:651], (up + down) / 2, 1)[0]

    assert slope(True) > 1.5 * slope(False)


def test_a_share_of_the_preload_is_a_share_of_its_force():
    """At rest in the middle the gas pushes the rod out by its pressure above ambient on the rod's cross-section."""
    whole = DAMPER.preload * DAMPER.A_rod
    for share in (0.0, 0.4, 1.0):
        force = run(DAMPER, np.linspace(0.0, 0.1, 11), np.zeros(11), 1.0, gas_preload=share).force
        assert -force[0] == pytest.approx(share * whole, abs=0.01 * whole)


@pytest.mark.parametrize(("oil_level", "gas_preload"), [(1.0, True), (0.4, False)])
def test_every_oscillation_dissipates(oil_level, gas_preload):
    r = record(1.048, oil_level, gas_preload)
    assert (works(r) > 0).all()
    assert (np.diff(r.dissipated) >= -1e-6).all()
    assert r.temperature[-1] > r.temperature[0]


@pytest.mark.parametrize(
    ("velocity", "oil_level", "gas_preload"), [(0.05, 0.5, False), (1.048, 1.0, True), (1.048, 0.4, False)]
)
def test_work_becomes_heat(velocity, oil_level, gas_preload):
    r = record(velocity, oil_level, gas_preload, 8)
    work, heat = works(r)[2:].sum(), r.dissipated[-1] - r.dissipated[1200]
    assert heat == pytest.approx(work, rel=0.01)
    cooled = r.damper.cooling * np.trapezoid(r.temperature - 25, r.time)
    assert r.damper.heat_capacity * (r.temperature[-1] - 25) == pytest.approx(r.dissipated[-1] - cooled, rel=1e-3)


def test_hot_oil_damps_less():
    cold, hot = (works(run(DAMPER, *sine(1.048), temperature_degC=T))[1] for T in (25.0, 100.0))
    assert 0.7 < hot / cold < 0.97


@pytest.mark.parametrize(("oil_level", "gas_preload"), [(1.0, True), (0.4, False)])
def test_force_does_not_depend_on_the_tolerance(oil_level, gas_preload):
    base = record(1.048, oil_level, gas_preload)
    tight = run(DAMPER, *sine(1.048), oil_level, gas_preload=gas_preload, rtol=1e-9)
    assert np.abs(base.force - tight.force).max() < 0.01 * np.abs(tight.force).max()


@pytest.mark.parametrize("velocity", [0.05, 0.524, 1.572])
def test_less_oil_less_work(velocity):
    full, half, little = (works(record(velocity, x, x == 1, 8))[-1] for x in (1.0, 0.5, 0.3))
    assert little < half < full


@pytest.mark.parametrize("name", ["SA1", "SA8"])
def test_intact_stays_the_same(name):
    intact = works(record(1.572, 1.0, True, 19, name))
    assert intact[1:] == pytest.approx(intact[1], rel=0.03)  # warmer oil


@pytest.mark.parametrize("oil_level", [0.9, 0.56, 0.4])
def test_no_fade_when_slow(oil_level):
    share = relative(0.05, oil_level)
    assert share[2:] == pytest.approx(share[2], abs=0.02)


@pytest.mark.parametrize("name", ["SA1", "SA8"])
def test_degraded_fades_when_fast(name):
    share = relative(1.572, 0.6, name)
    assert (np.diff(share) < 0.01).all()
    assert share[0] < 0.97 and share[-1] < 0.5 * share[0]


def test_gas_loss_alone_costs_little():
    assert relative(1.572, 1.0)[-1] > 0.9


def test_without_oil_thrown_onto_the_walls_there_is_less_fade():
    calm = run(virtual_damper(jet_width=1e-6), *sine(1.572, 19), 0.5, gas_preload=False)
    assert calm.film.max() < 1e-8
    assert works(calm)[-1] > 1.5 * works(record(1.572, 0.5, False, 19))[-1]


def test_oil_on_the_walls_runs_down():
    t, z = sine(1.572, 8)
    at_rest = np.arange(t[-1] + 0.01, t[-1] + 30, 0.01)
    r = run(DAMPER, np.concatenate([t, at_rest]), np.concatenate([z, np.zeros(len(at_rest))]), 0.6, gas_preload=False)
    assert r.film[len(t)] > 1e-5 and r.film[-1] < 0.5 * r.film[len(t)]


def test_force_comes_late_in_the_stroke_when_oil_is_lost():
    r = record(0.05, 0.4, False)
    fluid = DAMPER.A_1 * r.pressure[0] - DAMPER.A_2 * r.pressure[1] + DAMPER.A_rod * 1e5
    for up in (fluid[1050:1350], -fluid[750:1050]):  # from the lowest to the highest stroke, and back
        assert up.max() > 10.0 and up[:60].max() < 0.3 * up.max()


def test_bad_input_is_refused():
    t, z = sine(0.5)
    for time, stroke, oil in ((t, z * 10, 1.0), (t[::-1], z, 1.0), (t, z, 0.0), (t, z, 1.5), (t, z[:-1], 1.0)):
        with pytest.raises(ValueError):
            run(DAMPER, time, stroke, oil)


def test_a_leak_takes_what_the_rod_carries_out():
    damper = virtual_damper("SA8", leak=2e-5)
    r = run(damper, *sine(0.524))
    out = np.maximum(np.diff(r.stroke), 0.0).sum()
    assert damper.V_oil - r.oil[:, -1].sum() == pytest.approx(2e-5 * out, rel=1e-3)
    assert (r.dissolved_gas.sum(0)[-1] + r.free_gas.sum(0)[-1]) < (r.dissolved_gas + r.free_gas).sum(0)[0]


def test_foam_of_a_run_before_makes_the_force_soft_until_it_has_risen():
    foamy = run(virtual_damper("SA8", foam=0.05), *sine(0.524, 8))
    assert_conserves(foamy)
    missing = 1.0 - works(foamy) / works(record(0.524, count=8))
    assert missing[0] > 0.02
    assert missing[-1] < 0.7 * missing[0]
    assert foamy.bubbles[:2, 0].sum() > 0.0
