"""Mount and oil columns, in series with the valves: the mount against the complex impedance of a linear one."""

import math
from typing import Any

import numpy as np
import pytest

from twintube.core import model
from twintube.core.effects import State
from twintube.core.frame import end_weight
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import Damper
from twintube.engine.simulate import simulate
from twintube.rig.signals import harmonic_block, oscillations

D = 2000.0  # [N s/m] of the dashpot
ELEMENTS = [
    ({"C_mount": 5e-6, "tau_mount": 0.0}, 0.0),
    ({"C_mount": 5e-6, "tau_mount": 0.004}, 0.004),
]
MASS = 3.0  # [kg]


@pytest.mark.parametrize(("element", "tau"), ELEMENTS)
@pytest.mark.parametrize("omega", [5.0, 20.0, 60.0])
def test_harmonic_force_has_the_amplitude_and_phase_of_the_impedance(
    dashpot: Damper, element: dict[str, float], tau: float, omega: float
) -> None:
    t, z, v = oscillations(0.02 * omega, 0.02, 6, 1e-3)
    force = simulate(dashpot.with_(**element), z, v, t).force
    last = t > t[-1] * 4 / 6
    found = 2 * np.mean(force[last] * np.exp(-1j * omega * t[last]))
    exact = 0.02 * omega / (1 / D + 1j * omega * 5e-6 / (1 + 1j * omega * tau))
    assert abs(found / exact - 1) < 0.01


@pytest.mark.parametrize("element", [{"C_mount": 1e-12}, {"C_fluid": 1e-12, "C_fluid_co": 1e-12}])
def test_a_stiff_element_changes_nothing(sa8: Damper, element: dict[str, Any]) -> None:
    block = harmonic_block(0.524, dt=2e-4, rest=5.0)
    sa8 = sa8.with_(dead_length=0.11)  # full chambers: where a phase runs out, the force jumps a part of a step later
    plain = simulate(sa8, block.stroke, block.velocity).force
    stiff = simulate(sa8.with_(**element), block.stroke, block.velocity, block.time).force
    assert np.sqrt(np.mean((stiff - plain) ** 2)) < 0.005 * np.sqrt(np.mean(plain**2))


@pytest.mark.parametrize("element", [{"C_mount": 1e-5}, {"C_fluid": 1e-5, "C_fluid_co": 1e-5}])
def test_slow_motion_does_not_show_it(dashpot: Damper, element: dict[str, Any]) -> None:
    t, z, v = oscillations(0.005, 0.02, 2, 0.05)
    force = simulate(dashpot.with_(**element), z, v, t).force
    assert np.abs(force - D * v)[20:].max() < 0.01 * D * 0.005


@pytest.mark.parametrize(
    "element", [{"C_mount": 1e-6}, {"C_mount": 1e-5}, {"C_fluid": 1e-5, "C_fluid_co": 1e-5, "V_air": 1e-6}]
)
def test_the_loop_is_the_dissipated_work(sa8: Damper, element: dict[str, Any]) -> None:
    block = harmonic_block(0.524, dt=5e-4, rest=5.0)
    result = simulate(sa8.with_(**element), block.stroke, block.velocity, block.time)
    for i in (3, 18):
        a, b = block.marks[i], block.marks[i + 1]
        loop = np.trapezoid(result.force[a : b + 1], block.stroke[a : b + 1])
        assert result.work[b] - result.work[a] == pytest.approx(loop, rel=0.01)


@pytest.mark.parametrize(
    "element", [{"C_mount": 1e-6}, {"C_mount": 2e-5}, {"C_fluid": 2e-5, "C_fluid_co": 2e-5, "V_air": 1e-6}]
)
def test_stable_in_steps_of_1_ms_and_in_64_samples(sa8: Damper, element: dict[str, Any]) -> None:
    damper = sa8.with_(**element)
    for velocity in (0.05, 0.524, 1.572):
        t, z, v = oscillations(velocity, 0.045, 2, 1e-4)
        fine = simulate(damper, z, v, t).force
        for dt in (1e-3, t[-1] / 128):
            times, z, v = oscillations(velocity, 0.045, 2, dt)
            error = simulate(damper, z, v, times).force - np.interp(times, t, fine)
            assert np.sqrt(np.mean(error**2)) < 0.1 * np.sqrt(np.mean(fine**2)), (velocity, dt)


@pytest.mark.parametrize("omega", [5.0, 60.0])
def test_the_rod_s_mass_lies_between_rubber_and_valves(dashpot: Damper, omega: float) -> None:
    t, z, v = oscillations(0.02 * omega, 0.02, 6, 5e-4)
    force = simulate(dashpot.with_(C_mount=5e-6, tau_mount=0.002, m_rod=MASS), z, v, t).force
    last = t > t[-1] * 4 / 6
    found = 2 * np.mean(force[last] * np.exp(-1j * omega * t[last]))
    rubber = 1j * omega * 5e-6 / (1 + 1j * omega * 0.002)
    exact = 0.02 * omega / (1 / (D + 1j * omega * MASS) + rubber)
    assert abs(found / exact - 1) < 0.01


def test_the_weight_of_the_end_meets_the_exponential_decay() -> None:
    """y1 = y0 - q ((1 - w) y0 + w y1) has to be y0 exp(-q), whatever the step of q time constants."""
    for q in (1e-9, 1e-4, 0.9e-3, 1.1e-3, 0.1, 1.0, 10.0, 400.0):
        w = end_weight(q)
        assert (1.0 - (1.0 - w) * q) / (1.0 + w * q) == pytest.approx(math.exp(-q), rel=1e-9, abs=1e-12)
    assert end_weight(1e9) == 1.0


@pytest.mark.parametrize("tau", [0.0, 0.001])
def test_halved_parts_have_a_quarter_of_the_error(dashpot: Damper, tau: float) -> None:
    """The mount is met to second order: in parts of 48 and 96 to an oscillation, its impedance to 0.2 and 0.05 %."""
    omega, amplitude, C = 20.0, 0.03, 5e-6
    p = dashpot.with_(C_mount=C, tau_mount=tau).parameters
    errors = []
    for n in (48, 96):
        t, z, v = oscillations(omega * amplitude, amplitude, 6, 2 * np.pi / omega / n)
        d, s, f = blank(Derived), blank(State), blank(Flow)
        model.set_up(p, d)
        model.start(p, d, s, 0.0)
        force = []
        for i in range(len(t)):
            before = max(0, i - 1)
            model.advance_whole(p, d, s, f, float(z[i]), float(v[before]), float(v[i]), float(t[i] - t[before]))
            force.append(s.F_fluid)
        last = t > t[-1] * 4 / 6
        found = 2 * np.mean(np.array(force)[last] * np.exp(-1j * omega * t[last]))
        exact = omega * amplitude / (1 / D + 1j * omega * C / (1 + 1j * omega * tau))
        errors.append(abs(found / exact - 1))
    assert errors[0] < 0.002
    assert errors[1] < 0.3 * errors[0]


@pytest.mark.parametrize("element", [{"C_mount": 1e-6}, {"C_fluid": 1e-6, "C_fluid_co": 2e-6, "V_air": 5e-7}])
def test_a_step_of_k_degr_within_an_interval_is_met(sa8: Damper, element: dict[str, Any]) -> None:
    """48 intervals to a fast cavitating oscillation, whose phases run out somewhere in between."""
    damper = sa8.with_(**element)
    t, z, v = oscillations(1.572, 0.045, 4, 5e-5)
    fine = simulate(damper, z, v, t).force
    times, z, v = oscillations(1.572, 0.045, 4, t[-1] / 192)
    error = simulate(damper, z, v, times).force - np.interp(times, t, fine)
    assert np.sqrt(np.mean(error**2)) < 0.03 * np.sqrt(np.mean(fine**2))
