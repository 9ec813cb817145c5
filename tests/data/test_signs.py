"""Stroke and force both of the other sign: found by the F-v curve, by a slow record or by the force at rest; no false alarm."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.diagnosis import small
from twintube.dampers import Damper, load
from twintube.data import Finding, Record, check_dataset
from twintube.data.records.signs import AS_STATED, PULLED, TURNED, UNTOLD, quasi_steady, told_by

WEAK = {"v_co": load("SA8").parameters.v_re, "F_co": load("SA8").parameters.F_re, "F_0": 40.0}  # symmetric, little gas


def record(damper: Damper, *, speed: float = 0.4, amplitude: float = 0.03, rest: float = 0.0, zero: float = 0.0) -> Record:
    """Three sines of a damper's quasi-steady force after a rest [s] in the middle, under a zero of the load cell [N]."""
    time = np.arange(0.0, rest + 6 * np.pi * amplitude / speed, 0.002)
    phase = np.maximum(time - rest, 0.0) * speed / amplitude
    stroke, velocity = amplitude * np.sin(phase), np.where(time > rest, speed * np.cos(phase), 0.0)
    force = quasi_steady(damper, stroke, velocity, damper.parameters.F_0) + zero
    force += np.random.default_rng(4).normal(0.0, 0.005 * np.abs(force).max(), len(force))
    return replace(small.record(small.run(0.3, turns=1)), time=time, stroke=stroke, velocity=velocity, force=force,
                   usable=np.ones(len(time), dtype=bool), measurement="quasi-static" if speed < 0.005 else "harmonic")  # fmt: skip


def turned(r: Record) -> Record:
    return replace(r, stroke=-r.stroke, velocity=-r.velocity, force=-r.force)


@pytest.mark.parametrize("name", ["SA1", "SA3", "SA8"])
@pytest.mark.parametrize("speed", [0.1, 1.0])
def test_the_sign_is_told_at_any_speed(name: str, speed: float) -> None:
    r = record(load(name), speed=speed)
    assert (told_by(load(name), r), told_by(load(name), turned(r))) == (AS_STATED, TURNED)


def test_a_slow_record_tells_it_by_the_gas_alone() -> None:
    """As a zero of the load cell would."""
    r = record(load("SA8"), speed=0.001)
    assert (told_by(load("SA8"), r), told_by(load("SA8"), turned(r))) == (AS_STATED, PULLED)


def test_a_slow_record_tells_it_with_oil_lost_and_gas_present() -> None:
    slow, fast = (replace(record(load("SA8"), speed=speed), oil_level=0.5) for speed in (0.001, 0.8))
    assert (told_by(load("SA8"), slow), told_by(load("SA8"), turned(slow))) == (AS_STATED, PULLED)
    assert told_by(load("SA8"), fast) == told_by(load("SA8"), turned(fast)) == UNTOLD


def test_another_gas_pressure_is_that_of_the_record() -> None:
    damper = load("SA8")
    high = replace(record(damper.with_(F_0=265.0), speed=0.001), gas_pressure=20e5)
    assert (told_by(damper, high), told_by(damper, turned(high))) == (AS_STATED, PULLED)


@pytest.mark.parametrize("other", ["SA1", "SA5", "SA7"])
def test_another_damper_is_not_called_turned(other: str) -> None:
    for speed in (0.1, 0.5, 1.0):
        assert told_by(load("SA8"), record(load(other), speed=speed)) != TURNED


def test_a_damper_that_is_stronger_in_compression_is_not_called_turned() -> None:
    p = load("SA8").parameters
    stronger = load("SA8").with_(F_re=[0.3 * F for F in p.F_re], F_co=[1.2 * F for F in p.F_co])
    assert told_by(load("SA8"), record(stronger, speed=0.5)) == UNTOLD


def test_a_worn_rebound_valve_is_not_called_turned() -> None:
    p = load("SA8").parameters
    for share in (0.5, 0.2, 0.05):
        worn = load("SA8").with_(F_re=[share * F for F in p.F_re])
        assert told_by(load("SA8"), record(worn, speed=1.0)) != TURNED


@pytest.mark.parametrize(("friction", "told"), [(12.0, (AS_STATED, PULLED)), (80.0, (UNTOLD, UNTOLD))])
def test_the_force_at_rest_tells_it_unless_friction_hides_it(friction: float, told: tuple[str, str]) -> None:
    """With an F-v curve that is unlike the record's, which tells nothing."""
    damper = load("SA8").with_(**WEAK, F_FrS=friction)
    weaker = damper.with_(F_re=[0.5 * F for F in damper.parameters.F_re], F_co=[0.5 * F for F in damper.parameters.F_co])
    fast = record(weaker, speed=0.8)
    assert told_by(damper, fast) == told_by(damper, turned(fast)) == UNTOLD
    resting = record(weaker, speed=0.8, rest=4.0)
    assert (told_by(damper, resting), told_by(damper, turned(resting))) == told


def warned(several: list[Record], folder: Path) -> list[Finding]:
    return [finding for finding in check_dataset(small.write(several, folder)).findings if "sign" in finding.message]


def test_check_names_the_keys_to_set(tmp_path: Path) -> None:
    good = small.records(speeds=(0.3, 0.6))
    assert warned(good, tmp_path / "good") == []
    (finding,) = warned([turned(r) for r in good], tmp_path / "turned")
    assert finding.severity == "warning" and "set force_sign = -1 and stroke_sign = -1" in finding.message
    (finding,) = warned([good[0], turned(good[1])], tmp_path / "one")
    assert f"both ({good[1].file})" in finding.message and "in these records" in finding.message


def test_signs_that_are_turned_in_vain_are_turned_back(tmp_path: Path) -> None:
    folder = small.write(small.records(speeds=(0.4,)), tmp_path)
    toml = folder / "dataset.toml"
    toml.write_text("force_sign = -1\nstroke_sign = -1\n" + toml.read_text())
    (finding,) = [finding for finding in check_dataset(folder).findings if "sign" in finding.message]
    assert "set force_sign = 1 and stroke_sign = 1" in finding.message


def test_degraded_records_alone_are_not_judged_by_the_intact_curve(tmp_path: Path) -> None:
    lost = small.records(speeds=(0.3, 0.8), levels=(0.3,))
    assert warned(lost, tmp_path) == []


def test_a_zero_of_a_slow_record_is_no_sign(tmp_path: Path) -> None:
    slow = replace(record(load("SA8"), speed=0.001, amplitude=0.005, zero=130.0), name="slow", file="slow.csv")
    findings = check_dataset(small.write([slow, *small.records(speeds=(0.4,))], tmp_path)).findings
    (finding,) = [finding for finding in findings if "pulls the rod in" in finding.message]
    assert finding.message.endswith("the load cell has a zero")
    (finding,) = warned([turned(replace(slow, force=slow.force - 130.0))], tmp_path / "alone")
    assert "set force_sign = -1 and stroke_sign = -1" in finding.message and "has a zero" in finding.message
