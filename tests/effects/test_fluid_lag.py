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
