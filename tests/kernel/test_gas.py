"""The gas spring: the published line, and the polytropic gas that compresses by p V^n."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest
from scipy.optimize import brentq

from twintube.core.checks import problems
from twintube.core.kernel import prepare
from twintube.core.kernel.forces import P_AMBIENT, gas_rise
from twintube.core.variables import Derived, blank
from twintube.dampers import Damper, load, names
from twintube.dampers.dead_length import HIGHEST, prepared, pressure, reserve_gas
from twintube.engine.simulate import simulate
from twintube.fitting.simulation import SimulatedRecords
from twintube.rig.signals import harmonic_block


class Driven(NamedTuple):
    """A record that drives the model."""

    oil_level: float
    gas_preload: int
    time: np.ndarray
    stroke: np.ndarray
    velocity: np.ndarray


def gas_force(damper: Damper, z: np.ndarray) -> np.ndarray:
    return simulate(damper, z, np.full(len(z), 0.01)).F_gas


@pytest.mark.parametrize("name", names())
def test_linear_by_default(name: str) -> None:
    p = load(name).parameters
    z = np.linspace(-p.stroke_max, p.stroke_max, 21)
    assert p.polytropic == 0
    assert np.array_equal(gas_force(load(name, as_published=True), z), p.c_gas * z - p.F_0)
    assert np.array_equal(gas_force(load(name, as_published=True).with_(gas_preload=0), z), p.c_gas_lost * z)


@pytest.mark.parametrize("share", [0.1, 0.4, 0.99])
def test_a_share_of_the_preload_is_that_share_of_its_pressure(share: float) -> None:
    """The force at stroke 0 goes with the pressure above ambient, the stiffness with the absolute one."""
    kept, low, lost = (load("SA8", as_published=True).with_(gas_preload=g) for g in (1, share, 0))
    z = np.linspace(-0.04, 0.04, 9)
    ends = share * gas_force(kept, z) + (1.0 - share) * gas_force(lost, z)
    assert gas_force(low, z) == pytest.approx(ends, rel=1e-12, abs=1e-12)
    d = blank(Derived)
    prepare(low.parameters, d)
    assert pytest.approx(d.F_0) == share * kept.parameters.F_0


def test_what_is_missing_of_the_preload_lets_the_oil_cavitate() -> None:
    """The freed gas goes with the missing pressure: with half of it half as much in the first strokes."""
    block = harmonic_block(1.572)
    freed = {}
    for share in (0.0, 0.25, 0.5, 0.75, 1.0):
        damper = load("SA8", as_published=True).with_(oil_level=0.9, gas_preload=share)
        d = blank(Derived)
        prepare(damper.parameters, d)
        assert d.cavitation == pytest.approx((1.0 - share) * 0.5)
        freed[share] = simulate(damper, block.stroke, block.velocity).V_cav[block.marks[1]]
    assert freed[1.0] == 0.0
    assert list(freed.values()) == sorted(freed.values(), reverse=True)
    assert freed[0.75] / freed[0.0] == pytest.approx(0.25, rel=0.1)


@pytest.mark.parametrize("given", [1, True, "100 %", 1.0])
def test_whole_numbers_and_booleans_are_shares(given: object) -> None:
    assert load("SA8").with_(gas_preload=given).parameters == load("SA8").parameters


@pytest.mark.parametrize("n", [1.0, 1.2, 1.35, 1.4])
@pytest.mark.parametrize("name", ["SA1", "SA5", "SA8"])
def test_polytropic_gas_is_that_of_the_reserve(name: str, n: float) -> None:
    """p V^n of the gas above the oil, whose volume follows from the dimensions, on the rod's cross-section."""
    damper = load(name, as_published=True).with_(polytropic=1, n_gas=n)
    p, d = damper.parameters, prepared(damper.parameters)
    z = np.linspace(-p.stroke_max, p.stroke_max, 15)
    V = reserve_gas(p, d)
    absolute = (P_AMBIENT + p.F_0 / d.A_rod) * (V / (V + d.A_rod * z)) ** n
    # The stiffness in the parameter set is rounded to 10 N/m.
    assert gas_force(damper, z) == pytest.approx(-(absolute - P_AMBIENT) * d.A_rod, rel=0.02)


@pytest.mark.parametrize(("preload", "stiffness"), [(1, "c_gas"), (0, "c_gas_lost")])
def test_about_the_middle_it_is_the_line_times_the_exponent(preload: int, stiffness: str) -> None:
    damper = load("SA7", as_published=True).with_(polytropic=1, n_gas=1.3, gas_preload=preload)
    z = np.array([-1e-6, 0.0, 1e-6])
    force = gas_force(damper, z)
    assert force[1] == -preload * damper.parameters.F_0
    assert (force[2] - force[0]) / 2e-6 == pytest.approx(1.3 * getattr(damper.parameters, stiffness), rel=1e-4)


def test_beyond_the_maximum_stroke_it_goes_on_along_its_tangent() -> None:
    """The tube is longer than the gas lasts; no number is infinite there."""
    p = load("SA5", as_published=True).with_(polytropic=1).parameters
    d = prepared(p)
    end = -p.stroke_max
    assert d.half_length > reserve_gas(p, d) / d.A_rod
    slope = (gas_rise(p, p.F_0, p.c_gas, end + 1e-7) - gas_rise(p, p.F_0, p.c_gas, end)) / 1e-7
    for beyond in (0.01, d.half_length + end):
        rise = gas_rise(p, p.F_0, p.c_gas, end - beyond) - gas_rise(p, p.F_0, p.c_gas, end)
        assert rise == pytest.approx(-slope * beyond, rel=1e-4)


def test_it_is_elastic_and_changes_no_other_force() -> None:
    block = harmonic_block(1.048)
    damper = load("SA5", as_published=True).with_(oil_level=0.8, gas_preload=0)
    line, gas = (simulate(x, block.stroke, block.velocity) for x in (damper, damper.with_(polytropic=1)))
    assert np.array_equal(line.work, gas.work)
    assert np.array_equal(line.F_fluid, gas.F_fluid)
    assert np.array_equal(line.F_friction, gas.F_friction)
    assert not np.array_equal(line.F_gas, gas.F_gas)


@pytest.mark.parametrize("as_published", [True, False])
def test_mean_forces_see_the_same_gas(as_published: bool) -> None:
    """What fits see is the mean force over an interval, with effects beyond the paper and without."""
    damper = load("SA5", as_published=as_published).with_(polytropic=1)
    t = np.linspace(0.0, 1.0, 201)
    z, v = 0.045 * np.sin(2 * np.pi * t), 0.09 * np.pi * np.cos(2 * np.pi * t)
    without = damper.with_(F_0=0.0, c_gas=0.0)
    record = Driven(1.0, 1, t, z, v)
    mean, bare = (
        run.run(run.rows(), ())[0] for run in (SimulatedRecords(x, [record], parts=1, failed=0.0) for x in (damper, without))
    )
    p = damper.parameters
    exact = np.array([gas_rise(p, p.F_0, p.c_gas, x) - p.F_0 for x in z])
    assert mean[1:] - bare[1:] == pytest.approx(0.5 * (exact[1:] + exact[:-1]), abs=0.5)


@pytest.mark.parametrize("polytropic", [0, 1])
def test_a_mount_holds_the_gas_at_rest(polytropic: int) -> None:
    """Rubber and gas balance each other: x / C_mount is the rise of the gas force at the piston, which is at z - x."""
    damper = load("SA5").with_(polytropic=polytropic, C_mount=2e-5, F_FrS=0.0)
    p = damper.parameters
    t = np.linspace(0.0, 3.0, 601)
    z = np.maximum(-0.02 * t, -0.045)
    held = simulate(damper, z, np.where(z > -0.045, -0.02, 0.0), t)
    x = brentq(lambda x: x / p.C_mount - gas_rise(p, p.F_0, p.c_gas, -0.045 - x), -0.02, 0.0)
    assert held.F_gas[-1] == pytest.approx(gas_rise(p, p.F_0, p.c_gas, -0.045 - x) - p.F_0, abs=0.01)


@pytest.mark.parametrize("surplus", [-60.0, 120.0])
def test_another_charge_is_another_pressure_in_the_same_volume(surplus: float) -> None:
    damper = load("SA7", as_published=True).with_(polytropic=1)
    p, d = damper.parameters, blank(Derived)
    prepare(p, d)
    z = np.linspace(-0.07, 0.07, 8)
    whole = p.F_0 + P_AMBIENT * d.A_rod
    shape = (1.0 + p.c_gas * z / whole) ** -p.n_gas
    assert gas_force(damper.with_(F_surplus=surplus), z) - gas_force(damper, z) == pytest.approx(-surplus * shape)


@pytest.mark.parametrize("wrong", [{"c_gas": 2e4}, {"c_gas_lost": 900.0}, {"c_gas": 9000.0, "stroke_max": 0.09}])
def test_gas_without_room_is_refused(wrong: dict[str, float]) -> None:
    p = load("SA8").parameters
    assert not problems(replace(p, **wrong))
    (said,) = problems(replace(p, polytropic=1, **wrong))
    name = next(iter(wrong))
    assert said.startswith(f"gas_spring.{name} = {wrong[name]:g} N/m: must be below")


@pytest.mark.parametrize("name", names())
def test_no_shipped_damper_passes_20_bar_as_driven(name: str) -> None:
    """The bound of the dead lengths is isothermal; a stroke leaves the gas little time to cool."""
    damper = load(name, as_published=True)
    p, d = damper.parameters, prepared(damper.parameters)
    driven = pressure(damper, p.n_gas)
    assert pressure(damper) < driven < HIGHEST
    force = gas_force(damper.with_(polytropic=1), np.array([-p.stroke_max]))[0]
    assert 1.0 - force / d.A_rod / 1e5 == pytest.approx(driven, rel=0.01)
