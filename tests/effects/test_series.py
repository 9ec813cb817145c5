"""Mount and oil columns, in series with the valves: the mount against the complex impedance of a linear one."""

from typing import Any

import numpy as np
import pytest

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
