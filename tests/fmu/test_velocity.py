"""The FMUs warn once where a velocity does not belong to its stroke, and never of right inputs."""

from pathlib import Path

import fmpy
import numpy as np
import pytest

from tests.motions import RIGHT, WRONG, Motion, block, reversal, sine
from twintube import load
from twintube.core.variables import blank
from twintube.demo.damper_fmu import DamperFmu
from twintube.fmu.car import build_car_fmu
from twintube.fmu.instance import FmuError, Instance
from twintube.fmu.platforms import Kind
from twintube.vehicle.cars import load_car
from twintube.vehicle.full.car import WHEELS
from twintube.vehicle.full.run import full_car
from twintube.vehicle.quarter_car import Motion as CarMotion
from twintube.vehicle.quarter_car import damper_stroke, damper_velocity, leapfrog_step
from twintube.vehicle.ride import track

STEPS = (1e-4, 1e-3, 1e-2, 4e-2)
SAID = "check sign, unit and connection of velocity"


def driven(damper: DamperFmu, motion: Motion) -> None:
    t, z, v = (values.tolist() for values in motion)
    for i in range(len(t) - 1):
        damper.step(z[i], v[i], t[i + 1] - t[i])


def of_velocity(damper: DamperFmu) -> list[str]:
    """What was said but for the communication step, which `test_step_length.py` is about."""
    return [message for message in damper.messages if "communication step" not in message]


def until(motion: Motion, end: float) -> Motion:
    t, z, v = motion
    return t[t <= end], z[t <= end], v[t <= end]


@pytest.mark.parametrize("h", STEPS)
@pytest.mark.parametrize("wrong", WRONG)
@pytest.mark.parametrize("of", ["50 mm at 2 Hz", "10 mm at 1.5 Hz", "the paper's block"])
def test_a_wrong_velocity_is_warned_of_once(sa8_native: Path, of: str, wrong: str, h: float) -> None:
    motions = {"50 mm at 2 Hz": lambda: sine(0.05, 2.0, h, 1.2), "10 mm at 1.5 Hz": lambda: sine(0.01, 1.5, h, 1.6)}
    if of in motions:
        t, z, v = motions[of]()
    else:
        time, stroke, velocity = block(0.524)
        t = np.arange(round(8.0 / h)) * h
        z, v = np.interp(t, time, stroke), np.interp(t, time, velocity)
    with DamperFmu(sa8_native) as damper:
        driven(damper, (t, z, WRONG[wrong](v)))
        (said,) = of_velocity(damper)
        assert said.startswith("Warning: time ") and said.endswith(SAID)
        assert float(said.split()[2]) <= reversal((t, z, v), 2)


@pytest.mark.parametrize("h", [1e-3, 4e-2])
@pytest.mark.parametrize("wrong", WRONG)
def test_both_kinds_say_the_same(sa8_fmu: Path, sa8_native: Path, wrong: str, h: float) -> None:
    t, z, v = sine(0.05, 2.0, h, 0.6)
    said = []
    for file in (sa8_fmu, sa8_native):
        with DamperFmu(file) as damper:
            driven(damper, (t, z, WRONG[wrong](v)))
            said.append(damper.messages)
    assert said[0] == said[1] and len(said[0]) == 1 + (h > 2e-3)


@pytest.mark.parametrize("h", [1e-3, 4e-2])
def test_a_stroke_that_is_not_connected_is_warned_of(sa8_fmu: Path, h: float) -> None:
    t, z, v = sine(0.02, 2.0, h, 1.0)
    with DamperFmu(sa8_fmu) as damper:
        driven(damper, (t, 0.0 * z, v))
        (said,) = of_velocity(damper)
        assert "stroke went 0 m, velocity led" in said


@pytest.mark.parametrize("name", RIGHT)
def test_right_inputs_are_not_warned_of(sa8_native: Path, name: str) -> None:
    motion = RIGHT[name]()
    stroke, velocity = float(motion[1][0]), float(motion[2][0])
    with DamperFmu(sa8_native, stroke=stroke, velocity=velocity) as damper:
        driven(damper, motion)
        assert of_velocity(damper) == []
        assert len(damper.messages) == int(np.diff(motion[0]).max() > 2.1e-3)


@pytest.mark.parametrize("speed", [30.0, 90.0])
@pytest.mark.parametrize("dt", [1e-3, 2e-3])
def test_a_drive_in_the_loop_is_not_warned_of(sa8_fmu: Path, kind: Kind, speed: float, dt: float) -> None:
    """On the class D road, with the damper's force of each step."""
    car, m, on = load_car().corner(load("SA8")), blank(CarMotion), track(speed, 6.0 if kind == "native" else 2.0, dt=dt)
    with DamperFmu(sa8_fmu) as damper:
        force = damper.outputs()["force"]
        for height, rate in zip(on.heights.tolist(), on.rates.tolist(), strict=True):
            z = damper_stroke(car, m)
            leapfrog_step(car, m, height, rate, force, 0.0, dt)
            force = damper.step(z, damper_velocity(car, m), dt)
        assert damper.messages == []


def test_a_step_that_is_refused_or_taken_back_does_not_count(sa8_native: Path) -> None:
    """The state brings back what was followed; a warning comes at the same step as without the detour."""
    t, z, v = sine(0.02, 2.0, 1e-3, 0.2)
    said = []
    for detour in (False, True):
        with DamperFmu(sa8_native) as damper:
            for i in range(len(t)):
                if detour and i == 30:
                    with pytest.raises(FmuError, match=r"stroke = 0\.4 m"):
                        damper.step(0.4, 0.0, 1e-3)
                if detour and i == 50:
                    kept, now = damper.fmu.getFMUState(), damper.now.value
                    driven(damper, (t[:10], z[50:60] + 0.01, v[50:60]))
                    damper.fmu.setFMUState(kept)
                    damper.now.value = now
                    damper.messages.clear()
                damper.step(z[i], 0.5 * v[i], 1e-3)
            said.append(damper.messages)
    assert len(said[0]) == 1 and said[0] == said[1]


def test_a_reset_unit_warns_again(sa8_native: Path) -> None:
    t, z, v = sine(0.05, 2.0, 1e-2, 0.5)
    with DamperFmu(sa8_native) as damper:
        for _ in range(2):
            driven(damper, (t, z, -v))
            damper.fmu.reset()
            damper.fmu.setupExperiment(startTime=0.0)
            damper.fmu.enterInitializationMode()
            damper.fmu.exitInitializationMode()
            damper.now.value = 0.0
        said = of_velocity(damper)
        assert len(said) == 2 and said[0] == said[1]


def test_a_derivative_of_the_velocity_changes_nothing(sa8_native: Path) -> None:
    """What the velocity is at the end of a step is given at the next one."""
    for factor in (1.0, 0.5):
        t, z, v = sine(0.05, 2.0, 1e-2, 1.0)
        with DamperFmu(sa8_native) as damper:
            reference = damper.variables["velocity"].valueReference
            for i in range(len(t)):
                damper.fmu.setRealInputDerivatives([reference], [1], [-factor * z[i] * (4.0 * np.pi) ** 2])
                damper.step(z[i], factor * v[i], 1e-2)
            assert len(of_velocity(damper)) == (factor != 1.0)


@pytest.fixture(scope="module")
def car_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    car = full_car(load_car(), [load(name) for name in ("SA7", "SA7", "SA8", "SA8")])
    return build_car_fmu(car, 90.0 / 3.6, tmp_path_factory.mktemp("car") / "car.fmu", (fmpy.platform,))


def on_road(file: Path, h: float, factors: dict[str, float], speed: float = 90.0) -> list[str]:
    """What the car's FMU says on the class D road, with road rates times `factors` by wheels."""
    on = track(speed, 6.0, dt=h)
    with Instance(file, {}, ("front_left.road",)) as car:
        given = car.buffer(*(f"{wheel}.{name}" for wheel in WHEELS for name in ("road", "road_rate")))
        for height, rate in zip(on.heights.tolist(), on.rates.tolist(), strict=True):
            for i, wheel in enumerate(WHEELS):
                given[2][2 * i], given[2][2 * i + 1] = height, factors.get(wheel, 1.0) * rate
            car.advance(given, h)
        return car.messages


@pytest.mark.parametrize("h", [1e-3, 2e-3, 4e-3, 1e-2])
@pytest.mark.parametrize("speed", [30.0, 90.0])
def test_the_car_does_not_warn_of_a_right_road(car_file: Path, h: float, speed: float) -> None:
    assert on_road(car_file, h, {}, speed) == []


@pytest.mark.parametrize("wheel", WHEELS)
@pytest.mark.parametrize("wrong", WRONG)
def test_the_car_warns_once_of_a_wrong_rate_of_the_road(car_file: Path, wheel: str, wrong: str) -> None:
    factor = {"sign": -1.0, "not connected": 0.0, "motion ratio": 0.5, "km/h": 3.6}[wrong]
    said = on_road(car_file, 1e-3, {wheel: factor})
    assert len(said) == 1
    assert f" {wheel}.road went " in said[0] and said[0].endswith(f"check sign, unit and connection of {wheel}.road_rate")


def test_the_car_warns_once_where_all_roads_are_wrong(car_file: Path) -> None:
    assert len(on_road(car_file, 1e-3, dict.fromkeys(WHEELS, -1.0))) == 1
