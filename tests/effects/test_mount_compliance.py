"""The piston's stroke behind a rubber mount."""

import numpy as np
import pytest

from twintube.core import model
from twintube.core.effects import State
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import Damper
from twintube.rig.signals import oscillations


def test_the_piston_lacks_the_deflection(dashpot: Damper) -> None:
    p, d, s, f = dashpot.with_(C_mount=1e-5, tau_mount=0.0).parameters, blank(Derived), blank(State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    # 0.3 m/s for much longer than C d = 20 ms, in steps of 10 ms from rest.
    for i in range(1, 16):
        model.advance(p, d, s, f, 0.003 * i, 0.3, 0.3, 0.01)
    assert s.F_fluid == pytest.approx(600.0, rel=1e-3)
    assert s.x_mount == pytest.approx(600.0 * 1e-5, rel=1e-3)
    assert s.z == pytest.approx(0.045 - s.x_mount, abs=1e-12)
    # At rest the rubber pushes the piston after the rig, and the force goes.
    model.advance(p, d, s, f, 0.045, 0.0, 0.0, 60.0)
    assert s.F_fluid == pytest.approx(0.0, abs=0.1)
    assert s.z == pytest.approx(0.045, abs=1e-6)


def test_a_progressive_mount_gives_less_under_more(dashpot: Damper) -> None:
    p, d, s, f = (
        dashpot.with_(C_mount=1e-5, tau_mount=0.0, hardening=1e5).parameters,
        blank(Derived),
        blank(State),
        blank(Flow),
    )
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    for i in range(1, 16):
        model.advance(p, d, s, f, 0.003 * i, 0.3, 0.3, 0.01)
    # 600 N are 6 mm of the linear mount.
    assert s.F_fluid == pytest.approx(600.0, rel=1e-3)
    assert s.x_mount < 3.5e-3
    assert s.x_mount * (1.0 + 1e5 * s.x_mount**2) / 1e-5 == pytest.approx(600.0, rel=1e-3)


def test_a_step_without_time_changes_nothing(sa8: Damper) -> None:
    p, d, s, f = sa8.with_(C_mount=1e-5).parameters, blank(Derived), blank(State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    t, z, v = oscillations(0.5, 0.04, 1, 1e-3)
    for i in range(1, 150):
        model.advance(p, d, s, f, float(z[i]), float(v[i - 1]), float(v[i]), float(t[i] - t[i - 1]))
    before = (s.F_fluid, s.F_friction, s.x_mount, s.v_piston, s.z, s.work)
    model.advance(p, d, s, f, float(z[149]), float(v[149]), float(v[149]), 0.0)
    assert np.array(before) == pytest.approx([s.F_fluid, s.F_friction, s.x_mount, s.v_piston, s.z, s.work], rel=1e-6)
