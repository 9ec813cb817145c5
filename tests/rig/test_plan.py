"""The measurement plan of Table 3 as signals."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from twintube.cli import app
from twintube.core.checks import stroke_limit
from twintube.core.kernel import prepare
from twintube.core.variables import Derived, blank
from twintube.dampers import load, names
from twintube.rig.plan import Measurement
from twintube.rig.signals import OSCILLATIONS
from twintube.vehicle.maneuvers import BRAKING, DT, MANEUVERS, SHIFT, wheel_input
from twintube.vehicle.plan import plan


def signals(name: str) -> list[Measurement]:
    return list(plan(load(name)))


@pytest.mark.parametrize("name", names())
def test_every_damper_gets_the_twelve_measurements(name: str) -> None:
    measurements = signals(name)
    assert sorted({m.number for m in measurements}) == list(range(1, 13))
    assert sum(m.number == 2 for m in measurements) == (17 if name in ("SA7", "SA8") else 8)
    d = blank(Derived)
    prepare(load(name).parameters, d)
    for m in measurements:
        assert np.all(np.diff(m.signal.time) > 0), m.name
        assert np.abs(m.signal.stroke).max() < stroke_limit(d), m.name
        # Stroke and velocity belong together.
        derived = np.gradient(m.signal.stroke, m.signal.time)
        inner = slice(m.signal.marks[0] + 2, m.signal.marks[-1] - 2)
        assert np.abs(derived[inner] - m.signal.velocity[inner]).mean() < 0.05 * np.abs(m.signal.velocity[inner]).max()


def test_harmonic_blocks_are_the_papers() -> None:
    blocks = [m for m in signals("SA8") if m.kind == "harmonic"]
    for m in blocks:
        measured = slice(m.signal.marks[0], m.signal.marks[-1] + 1)
        assert len(m.signal.marks) == OSCILLATIONS + 1
        assert np.abs(m.signal.stroke[measured]).max() == pytest.approx(0.045, rel=1e-3)
        slow = np.abs(m.signal.velocity) <= 0.05 * (1 + 1e-9)
        begin = int(np.argmin(slow)) if not slow.all() else int(m.signal.marks[0])
        crossings = np.count_nonzero(np.diff(np.sign(m.signal.stroke[:begin])) > 0)
        assert crossings == pytest.approx(6, abs=2)
        # A rig cannot jump in velocity: the largest acceleration is that of the sine, or less than twice it in the run-up.
        top = np.abs(m.signal.velocity).max()
        rates = np.abs(np.diff(m.signal.velocity)) / np.diff(m.signal.time)
        assert rates[begin - 1 :].max() < 2 * top**2 / 0.045


def test_quasi_static_ramp_is_1_mm_per_second() -> None:
    signal = next(m for m in signals("SA1") if m.number == 1).signal
    assert np.abs(signal.velocity).max() == pytest.approx(1e-3)
    assert signal.stroke.max() == pytest.approx(0.045, rel=1e-2)
    assert signal.stroke.min() == pytest.approx(-0.045, rel=1e-2)


def test_braking_loads_the_front_and_ends_at_rest() -> None:
    braked = next(m for m in MANEUVERS if m.number == 9)
    height, front = wheel_input(braked, "front")
    _, rear = wheel_input(braked, "rear")
    assert front.max() == pytest.approx(SHIFT)
    assert np.array_equal(front, -rear)
    stop = 3.0 + 50 / 3.6 / BRAKING
    late = round((stop + 0.1) / DT)
    assert np.all(front[late:] == 0)
    assert np.ptp(height[late:]) == 0


def test_rig_command_writes_the_plan(tmp_path: Path) -> None:
    run = CliRunner().invoke(app, ["paper", "rig", "SA6", "--output", str(tmp_path / "x")])
    assert run.exit_code == 0, run.output
    plan_file = json.loads((tmp_path / "x" / "plan.json").read_text())
    assert len(plan_file["signals"]) == 19
    for entry in plan_file["signals"]:
        with (tmp_path / "x" / entry["file"]).open() as file:
            assert next(csv.reader(file)) == ["time [s]", "stroke [mm]", "velocity [mm/s]"]
