"""Temperature: a law through two points of a bench, what it does to oil, friction and gas, and the heat that is made."""

import math
import warnings
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.eight import EIGHT
from twintube.core.kernel.forces import P_AMBIENT
from twintube.core.kernel.temperature import thickness
from twintube.dampers import Damper, load
from twintube.dampers.damper import ParameterError
from twintube.dampers.temperature import at_temperature
from twintube.engine.simulate import InputError, simulate
from twintube.engine.simulation import Simulation
from twintube.errors import InputWarning
from twintube.rig.signals import Signal, harmonic_block

SA8 = load("SA8")
P = SA8.parameters
BLOCK = harmonic_block(1.048, dt=2e-3)
CELSIUS = 273.15


def factor(damper: Damper, degC: float) -> float:
    """Fluid force over that at the temperature of the F-v curve."""
    return math.exp(thickness(damper.parameters, degC + CELSIUS))


def run(damper: Damper, temperature: Any = None, block: Signal = BLOCK) -> Simulation:
    return simulate(damper, block.stroke, block.velocity, block.time, temperature=temperature)


# The law


@pytest.mark.parametrize("name", EIGHT)
def test_the_law_goes_through_its_three_points(name: str) -> None:
    p = load(name).parameters
    assert thickness(p, p.T_curve) == 0.0
    assert thickness(p, p.T_cold) == pytest.approx(math.log(p.k_cold))
    assert thickness(p, p.T_hot) == pytest.approx(math.log(p.k_hot))


def test_the_defaults_are_within_what_is_published() -> None:
    """2.5-fold from 20 to -30 degC, 2 % for 5 K about there (Hryciow 2022); 0.2 to 0.3 %/K from 28 to 80 degC (a bench)."""
    assert factor(SA8, -30.0) / factor(SA8, 20.0) == pytest.approx(2.5, rel=0.02)
    assert 1.0 - factor(SA8, 25.0) / factor(SA8, 20.0) == pytest.approx(0.02, abs=0.006)
    assert -math.log(factor(SA8, 80.0) / factor(SA8, 28.0)) / 52.0 == pytest.approx(0.0025, abs=0.0005)


@settings(deadline=None)
@given(k_cold=st.floats(1.0, 10.0), k_hot=st.floats(0.1, 1.0), T=st.floats(150.0, 500.0))
def test_a_warmer_oil_is_never_stiffer(k_cold: float, k_hot: float, T: float) -> None:
    p = SA8.with_(k_cold=k_cold, k_hot=k_hot).parameters
    assert thickness(p, T + 1.0) <= thickness(p, T) + 1e-12
    assert math.log(k_hot) - 1e-9 <= thickness(p, T) <= math.log(k_cold) + 1e-9


def test_two_points_of_viscosities_by_vogel_give_all_of_them() -> None:
    """The law is Vogel's: any oil of his is met over the whole range by two of its points."""

    def vogel(T: float) -> float:
        return math.exp(200.0 / (T - 170.0))

    T = P.T_curve
    ratios = {point: vogel(point) / vogel(T) for point in (P.T_cold, P.T_hot)}
    p = SA8.with_(k_cold=ratios[P.T_cold], k_hot=ratios[P.T_hot]).parameters
    for other in np.linspace(P.T_cold, P.T_hot, 23):
        assert math.exp(thickness(p, other)) == pytest.approx(vogel(other) / vogel(T), rel=1e-12)


@pytest.mark.parametrize("point", [{"k_cold": 1.0}, {"k_hot": 1.0}, {"k_cold": 1.0, "k_hot": 1.0}])
def test_a_point_with_the_factor_one_is_no_law(point: dict[str, float]) -> None:
    p = SA8.with_(**point).parameters
    assert all(thickness(p, T) == 0.0 for T in np.linspace(P.T_cold + 0.1, P.T_hot - 0.1, 7))


def test_points_on_the_wrong_side_are_refused() -> None:
    with pytest.raises(ParameterError, match=r"temperature\.T_cold = 300 K: must be below temperature\.T_curve = 296\.15 K"):
        SA8.with_(T_cold=300.0)
    with pytest.raises(ParameterError, match=r"temperature\.T_hot = 290 K: must be above temperature\.T_curve = 296\.15 K"):
        SA8.with_(T_hot="290 K")
    with pytest.raises(ParameterError, match=r"temperature\.k_hot = 1\.2: must be a number from 0\.1 to 1"):
        SA8.with_(k_hot=1.2)


# What it does


@pytest.mark.parametrize("changes", [{}, {"C_mount": 1e-6, "C_fluid": 2e-6}, {"fade_heat": 1e-5}])
@pytest.mark.parametrize("published", [True, False])
def test_the_temperature_of_the_parameters_changes_no_bit(published: bool, changes: dict[str, float]) -> None:
    damper = load("SA8", as_published=published).with_(oil_level=0.6, gas_preload=0, **changes)
    plain, given = run(damper), run(damper, P.T_curve)
    assert all(np.array_equal(values, given.columns[name]) for name, values in plain.columns.items())


@pytest.mark.parametrize("published", [True, False])
@pytest.mark.parametrize("degC", [-30.0, -10.0, 0.0, 40.0, 80.0])
def test_each_force_goes_with_its_own_law(degC: float, published: bool) -> None:
    damper = load("SA8", as_published=published).with_(oil_level=0.6)
    T = degC + CELSIUS
    plain, tempered = run(damper), run(damper, T)
    k = factor(damper, degC)
    np.testing.assert_allclose(tempered.F_fluid, k * plain.F_fluid, rtol=1e-9)
    np.testing.assert_allclose(tempered.k_degr, k * plain.k_degr, rtol=1e-9)
    np.testing.assert_allclose(tempered.F_friction, k**0.5 * plain.F_friction, rtol=1e-9)
    # p V = n R T of the enclosed gas: its absolute pressure on the rod goes with T.
    ambient = P_AMBIENT * math.pi / 4 * P.D_PR**2
    np.testing.assert_allclose(ambient - tempered.F_gas, T / P.T_curve * (ambient - plain.F_gas), rtol=1e-9)
    assert np.array_equal(tempered.V1_oil, plain.V1_oil)
    assert np.all(tempered.T_oil == T)


@pytest.mark.parametrize(("power", "share"), [(0.0, 0.0), (1.0, 1.0)])
def test_friction_is_dry_or_viscous_or_between(power: float, share: float) -> None:
    damper = SA8.with_(friction_power=power)
    ratio = run(damper, 263.15).F_friction[50] / run(damper).F_friction[50]
    assert ratio == pytest.approx(factor(damper, -10.0) ** share)


def test_a_temperature_holds_until_the_next_sample_and_is_forgotten_when_it_is_gone() -> None:
    T = np.full(len(BLOCK.time), P.T_curve)
    T[1000:1500] = 263.15
    plain, changed = run(SA8), run(SA8, T)
    cold = changed.T_oil != P.T_curve
    assert np.flatnonzero(cold).tolist() == list(range(1001, 1501))
    np.testing.assert_allclose(changed.F_fluid[cold], factor(SA8, -10.0) * plain.F_fluid[cold], rtol=1e-6)
    assert np.array_equal(changed.force[~cold], plain.force[~cold])


@pytest.mark.parametrize("published", [True, False])
def test_interpreter_and_c_agree_to_the_bit(published: bool) -> None:
    damper = load("SA8", as_published=published).with_(oil_level=0.6, gas_preload=0.3)
    T = np.linspace(240.0, 360.0, len(BLOCK.time))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", InputWarning)
        fast, slow = (
            simulate(damper, BLOCK.stroke, BLOCK.velocity, BLOCK.time, temperature=T, interpreted=way)
            for way in (False, True)
        )
    assert all(np.array_equal(values, slow.columns[name]) for name, values in fast.columns.items())


@pytest.mark.parametrize("share", [1.0, 0.4])
@pytest.mark.parametrize("kelvins", [250.0, 340.0])
def test_parameters_at_a_temperature_are_the_damper_at_it(kelvins: float, share: float) -> None:
    """But for the ambient pressure on the rod where the preload is lost."""
    damper = SA8.with_(oil_level=0.6, gas_preload=share)
    made, given = run(at_temperature(damper, kelvins)), run(damper, kelvins)
    np.testing.assert_allclose(made.F_fluid, given.F_fluid, rtol=1e-9)
    np.testing.assert_allclose(made.F_friction, given.F_friction, rtol=1e-9, atol=1e-9)
    ambient = P_AMBIENT * math.pi / 4 * P.D_PR**2
    lost = (1.0 - share) * (kelvins / P.T_curve - 1.0) * ambient
    np.testing.assert_allclose(made.F_gas - lost, given.F_gas, rtol=1e-9)


def test_parameters_at_no_temperature_are_refused_and_beyond_the_law_warned_of() -> None:
    with pytest.raises(ParameterError, match="SA8: temperature = 0 K: must be a number from 150 to 500 K"):
        at_temperature(SA8, 0.0)
    with pytest.warns(InputWarning, match="SA8: temperature = 230 K: the law of this damper holds from 243.15 to 353.15 K"):
        at_temperature(SA8, 230.0)


# Heat


@pytest.mark.parametrize("changes", [{}, {"warm_heat": 1 / 700.0}, {"C_mount": 1e-6, "tau_fluid": 1e-3}, {"side_load": 2.0}])
@pytest.mark.parametrize("temperature", [None, 250.0])
def test_the_heat_flow_is_the_work_and_the_work_what_the_force_did(
    changes: dict[str, float], temperature: float | None
) -> None:
    """Over whole oscillations no energy is stored in gas or friction: all that the rod put in has become heat."""
    block = harmonic_block(1.048, dt=2.5e-4)
    damper = SA8.with_(oil_level=0.7, **changes)
    result = run(damper, temperature, block)
    heat = np.concatenate([[0.0], np.cumsum(result.heat_flow[1:] * np.diff(block.time))])
    np.testing.assert_allclose(heat, result.work, rtol=1e-9, atol=1e-9)
    first, last = int(block.marks[4]), int(block.marks[14])
    span = slice(first, last + 1)
    rod = np.trapezoid(result.force[span], block.stroke[span])
    assert heat[last] - heat[first] == pytest.approx(rod, rel=1e-3)


def test_a_step_without_time_has_no_heat_flow() -> None:
    assert np.all(np.isnan(simulate(load("SA8", as_published=True), [0.0, 0.01], [0.1, 0.1]).heat_flow))
    still = simulate(SA8, [0.0, 0.0], [0.0, 0.0], [0.0, 1.0])
    assert still.heat_flow.tolist() == [0.0, 0.0]


def test_a_damper_of_its_own_heat_reaches_the_temperature_of_its_power() -> None:
    """Where power and cooling balance the oil is P R above the surroundings, R being cooling_time over the capacity."""
    capacity, cooling = 700.0, 20.0
    period = harmonic_block(0.524, dt=2e-3)
    first, last = int(period.marks[5]), int(period.marks[6])
    stroke, velocity = (np.tile(values[first:last], 300) for values in (period.stroke, period.velocity))
    time = np.arange(len(stroke)) * 2e-3
    damper = SA8.with_(warm_heat=1.0 / capacity, cooling_time=cooling)
    result = simulate(damper, stroke, velocity, time, temperature=273.15)
    late = slice(len(time) // 2, None)
    power = float(np.mean(result.heat_flow[late]))
    assert float(np.mean(result.T_oil[late])) - 273.15 == pytest.approx(power * cooling / capacity, rel=0.01)
    # It began as cold as around it, and thick oil makes more heat.
    assert result.T_oil[0] == 273.15
    cycle = last - first
    assert np.mean(result.heat_flow[:cycle]) > np.mean(result.heat_flow[-cycle:])


def test_heat_and_what_is_around_add_up() -> None:
    damper = SA8.with_(warm_heat=1.0 / 700.0, cooling_time=2000.0)
    cold, warm = (run(damper, T).T_oil - T for T in (263.15, 313.15))
    assert cold[-1] > warm[-1] > 0.5  # 40 s against 2000 s: nearly all of the work is still there
    assert warm[-1] == pytest.approx(run(damper, 313.15).work[-2] / 700.0, rel=0.03)


# What is refused and warned of


@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf, 25.0])
def test_what_is_no_temperature_is_refused(value: float) -> None:
    T = np.full(len(BLOCK.time), 290.0)
    T[7] = value
    with pytest.raises(InputError, match=r"sample 7: temperature = .* K: must be a number from 150 to 500 K"):
        run(SA8, T)
    with pytest.raises(InputError, match=r"sample 0: temperature = .* K"):
        run(SA8, value)
    with pytest.raises(InputError, match=r"temperature \(3,\) must be one number or an array of the length"):
        run(SA8, [290.0, 291.0, 292.0])


@pytest.mark.parametrize(("degC", "end"), [(-40.0, "T_cold"), (95.0, "T_hot")])
def test_beyond_the_law_is_a_warning_with_its_range_and_the_factor_of_its_end(degC: float, end: str) -> None:
    said = rf"sample 0: temperature = {degC + CELSIUS:g} K: the law of this damper holds from 243\.15 to 353\.15 K"
    with pytest.warns(InputWarning, match=said):
        beyond = run(SA8, degC + CELSIUS)
    assert np.array_equal(beyond.F_fluid, run(SA8, getattr(P, end)).F_fluid)


def test_the_ends_of_the_law_belong_to_it() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        run(SA8, -30.0 + CELSIUS)
        run(SA8, 80.0 + CELSIUS)
