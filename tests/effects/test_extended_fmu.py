"""An extended parameter set is a full model: built into an FMU and driven in the quarter car."""

import math
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from typer.testing import CliRunner

from twintube.cli import app
from twintube.core import model
from twintube.core.effects import EFFECTS, State
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import Damper, to_toml
from twintube.demo.damper_fmu import DamperFmu
from twintube.vehicle.cars import load_car
from twintube.vehicle.drive import drive


def motion(i: int) -> tuple[float, float]:
    t = i * 1e-3
    return 0.03 * math.sin(30 * t), 0.9 * math.cos(30 * t)


def test_extended_fmu_is_the_model_to_the_bit(sa8: Damper, everything: dict[str, Any], kind: str, tmp_path: Path) -> None:
    damper = sa8.with_(**everything)
    (tmp_path / "extended.toml").write_text(to_toml(damper))
    arguments = [str(tmp_path / "extended.toml"), "--output", str(tmp_path / "extended.fmu")]
    arguments += ["--kind", kind, *(["--platform", fmpy.platform] if kind == "native" else [])]
    run = CliRunner().invoke(app, ["fmu", *arguments])
    assert run.exit_code == 0, run.output
    fmu = tmp_path / "extended.fmu"
    p, d, s, f = damper.parameters, blank(Derived), blank(State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    model.advance(p, d, s, f, 0.0, 0.0, 0.0, 0.0)
    with DamperFmu(fmu) as unit:
        for i in range(500):
            z, v = motion(i)
            model.advance(p, d, s, f, z + v * 1e-3, v, v, 1e-3)
            assert unit.step(z, v, 1e-3) == s.F_fluid + s.F_friction + s.F_gas
    described = {v.name: v for v in fmpy.read_model_description(str(fmu)).modelVariables}
    for name, effect in EFFECTS.items():
        for item in effect.parameters:
            assert float(described[f"{name}.{item.name}"].start) == pytest.approx(getattr(p, item.name))


def test_quarter_car_with_every_effect(sa8: Damper, everything: dict[str, Any]) -> None:
    road = 0.01 * np.sin(np.arange(3000) * 1e-3 * 8)
    plain, extended = (drive(damper, load_car().corner(damper), road, 1e-3) for damper in (sa8, sa8.with_(**everything)))
    assert np.all(np.isfinite(extended.force))
    assert np.abs(extended.force - plain.force).max() > 1.0
