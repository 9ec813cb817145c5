"""The force in a compressible oil column."""

import math

import pytest

from twintube import model
from twintube.effects import State
from twintube.parameters import Damper
from twintube.variables import Derived, Flow, blank


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
