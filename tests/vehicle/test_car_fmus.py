"""The whole car with four native damper FMUs through fmpy: the in-process car, and convergence with the communication step."""

from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import fmpy
import numpy as np
import pytest

from twintube.arrays import Array
from twintube.dampers import load
from twintube.dampers.closures import closed, condition
from twintube.demo.car_ride import drive_car_with_fmus
from twintube.demo.damper_fmu import DamperFmu
from twintube.engine.simulate import InputError
from twintube.fmu import build_fmu
from twintube.vehicle.cars import load_car
from twintube.vehicle.full.maneuvers import Road
from twintube.vehicle.full.run import FullCar, drive_car, full_car
from twintube.vehicle.road import SPACING

SPEED = 50 / 3.6
LEVELS = (1.0, 0.5, 1.0, 1.0)  # the front right damper has lost oil
LOST = (1, 0, 1, 1)


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    folder = tmp_path_factory.mktemp("fmus")
    front, rear = (
        build_fmu(closed(load(name)), folder / f"{name}.fmu", platforms=(fmpy.platform,)) for name in ("SA7", "SA8")
    )
    return [front, front, rear, rear]


@pytest.fixture
def fmus(built: list[Path]) -> Iterator[list[DamperFmu]]:
    with ExitStack() as stack:
        yield [
            stack.enter_context(DamperFmu(file, oil_level=level, gas_preload=preload))
            for file, level, preload in zip(built, LEVELS, LOST, strict=True)
        ]


@pytest.fixture(scope="module")
def car() -> FullCar:
    names = ("SA7", "SA7", "SA8", "SA8")
    four = [condition(load(name), *state) for name, *state in zip(names, LEVELS, LOST, strict=True)]  # type: ignore[arg-type]
    return full_car(load_car(), four)


def drive(seconds: float, dt: float) -> Array:
    inputs = np.zeros((round(seconds / dt), 3))
    inputs[:, 2] = SPEED
    inputs[len(inputs) // 2 :, 1] = 3e6
    return inputs


def test_four_fmus_drive_as_the_compiled_dampers_do(car: FullCar, fmus: list[DamperFmu]) -> None:
    road, inputs = Road("C", seed=2).heights(car, 80.0), drive(4.0, 1e-3)
    with_fmus = drive_car_with_fmus(car, fmus, road, SPACING, inputs, SPEED)
    in_process = drive_car(car, road, SPACING, inputs, SPEED)
    for name in ("force", "stroke", "load", "v_x", "roll", "damper_work", "slip_x"):
        a, b = getattr(with_fmus, name), getattr(in_process, name)
        assert np.abs(a - b).max() <= 1e-9 * np.abs(b).max(), name


def test_the_coupling_error_falls_with_the_communication_step(car: FullCar) -> None:
    road = Road("B", seed=2).heights(car, 80.0)
    runs = {dt: drive_car(car, road, SPACING, drive(3.0, dt), SPEED, dt=dt) for dt in (2e-3, 1e-3, 2.5e-4)}
    at = np.arange(0.5, 2.9, 0.01)
    loads = {dt: np.column_stack([np.interp(at, run.time, run.load[:, i]) for i in range(4)]) for dt, run in runs.items()}
    errors = {dt: float(np.sqrt(np.mean((loads[dt] - loads[2.5e-4]) ** 2))) for dt in (2e-3, 1e-3)}
    assert errors[1e-3] < 0.55 * errors[2e-3]
    assert errors[1e-3] < 0.01 * loads[2.5e-4].mean()


def test_the_end_of_the_road_is_named(car: FullCar, fmus: list[DamperFmu]) -> None:
    with pytest.raises(InputError, match="the road of 4 m ends"):
        drive_car_with_fmus(car, fmus, np.zeros((2, 201)), SPACING, drive(1.0, 1e-3), SPEED, preconditioned=False)
