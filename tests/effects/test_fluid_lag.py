"""The force in a compressible oil column."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from twintube.core import model
from twintube.core.effects import State
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import Damper
from twintube.engine.simulate import simulate
from twintube.rig.signals import oscillations


def test_force_builds_up_and_decays_exponentially(dashpot: Damper) -> None:
    p, d, s, f = dashpot.with_(C_fluid=1e-5).parameters, blank(Derived), blank(State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    tau = 1e-5 * 2000.0
    for i in range(1, 21):
        model.advance(p, d, s, f, 3e-4 * i, 0.3, 0.3, 1e-3)
        assert s.F_fluid == pytest.approx(600.0 * (1 - math.exp(-i * 1e-3 / tau)), rel=0.01)
    top = s.F_fluid
    for i in range(1, 21):
        model.advance(p, d, s, f, 6e-3, 0.0, 0.0, 1e-3)
        assert s.F_fluid == pytest.approx(top * math.exp(-i * 1e-3 / tau), rel=0.01)
    assert s.z == 6e-3


def test_a_step_without_time_changes_nothing(dashpot: Damper) -> None:
    p, d, s, f = dashpot.with_(C_fluid=1e-5).parameters, blank(Derived), blank(State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    model.advance(p, d, s, f, 0.0, 0.5, 0.5, 0.0)
    assert s.F_fluid == pytest.approx(1000.0)  # a record may start in motion
    model.advance(p, d, s, f, 0.003, 0.3, 0.3, 0.01)
    before = (s.F_fluid, s.work)
    model.advance(p, d, s, f, 0.003, 0.1, 0.1, 0.0)
    assert (s.F_fluid, s.work) == before


def test_trapped_air_is_a_dead_stroke_that_pressure_closes(dashpot: Damper) -> None:
    """An isothermal gas of V_air at ambient pressure, on the annulus: the stroke given is V_air/A (1 - p_atm/p)."""
    damper = dashpot.with_(V_air=1e-6, gas_preload=0, oil_level=1.0)
    p, d, s, f = damper.parameters, blank(Derived), blank(State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    z = given = 0.0
    for _ in range(400):
        z += 0.1 * 1e-4
        model.advance(p, d, s, f, z, 0.1, 0.1, 1e-4)
        # What the valves pass is the force over the dashpot's constant.
        given += (0.1 - s.F_fluid / 2000.0) * 1e-4
    assert s.F_fluid == pytest.approx(200.0, rel=0.01)
    pressure = 1e5 + s.F_fluid / d.A_1
    assert given == pytest.approx(1e-6 / d.A_1 * (1 - 1e5 / pressure), rel=0.01)


@pytest.mark.parametrize("omega", [5.0, 20.0, 60.0])
def test_the_columns_of_both_directions_obey_their_differential_equation(dashpot: Damper, omega: float) -> None:
    """Two one-sided Maxwell elements, integrated by another scheme: one is still being relieved while the other builds up."""
    C_re, C_co, D = 2e-6, 1e-5, 2000.0
    t, z, v = oscillations(0.02 * omega, 0.02, 4, 5e-4)

    def rate(time: float, F: np.ndarray) -> list[float]:
        speed = float(np.interp(time, t, v))
        rates = [(speed - F[0] / D) / C_re, (-speed - F[1] / D) / C_co]
        return [x if x > 0.0 or held > 0.0 else 0.0 for x, held in zip(rates, F, strict=True)]

    exact = solve_ivp(rate, (0.0, t[-1]), [0.0, 0.0], t_eval=t, max_step=1e-3, rtol=1e-6, atol=1e-3).y
    force = simulate(dashpot.with_(C_fluid=C_re, C_fluid_co=C_co), z, v, t).force
    error = force - (np.maximum(exact[0], 0.0) - np.maximum(exact[1], 0.0))
    assert np.sqrt(np.mean(error[20:] ** 2)) < 0.02 * np.sqrt(np.mean(force**2))


@pytest.mark.parametrize("element", [{}, {"C_fluid": 2e-6, "C_fluid_co": 2e-6}, {"C_mount": 2e-6, "tau_mount": 0.0}])
@pytest.mark.parametrize("omega", [5.0, 60.0])
def test_late_valves_are_a_first_order_lag(dashpot: Damper, element: dict[str, float], omega: float) -> None:
    """Alone the dashpot's force behind the lag; with a spring in series their complex impedance, but for the columns' two sides."""
    tau = 0.003
    t, z, v = oscillations(0.02 * omega, 0.02, 6, 2e-4)
    force = simulate(dashpot.with_(tau_fluid=tau, **element), z, v, t).force
    last = t > t[-1] * 4 / 6
    found = 2 * np.mean(force[last] * np.exp(-1j * omega * t[last]))
    late = 2000.0 / (1 + 1j * omega * tau)
    if "C_mount" in element:
        late = 1 / (1 / late + 1j * omega * element["C_mount"])
    elif element:
        late = 1 / (1 / 2000.0 + 1j * omega * element["C_fluid"]) / (1 + 1j * omega * tau)
    assert abs(found / (0.02 * omega * late) - 1) < (0.05 if "C_fluid" in element else 0.01)


def test_late_valves_do_not_show_in_the_steady_force(dashpot: Damper) -> None:
    p, d, s, f = dashpot.with_(tau_fluid=0.002).parameters, blank(Derived), blank(State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    for i in range(1, 31):
        model.advance(p, d, s, f, 3e-4 * i, 0.3, 0.3, 1e-3)
        if i < 4:
            assert s.F_fluid == pytest.approx(600.0 * (1 - math.exp(-i * 1e-3 / 0.002)), rel=0.01)
    assert s.F_fluid == pytest.approx(600.0, rel=1e-5)
