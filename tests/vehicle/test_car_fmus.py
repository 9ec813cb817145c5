"""The whole car with four native damper FMUs through fmpy: the in-process car, and convergence with the communication step."""

from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import fmpy
import numpy as np
import pytest
from typer.testing import CliRunner

from twintube.cli import app
from twintube.common.arrays import Array
from twintube.dampers import load
from twintube.dampers.freed_gas import condition
from twintube.demo.car_ride import drive_car_with_fmus
from twintube.demo.damper_fmu import DamperFmu
from twintube.demo.four_dampers import ContainerFmu, SingleFmus
from twintube.engine.simulate import InputError
from twintube.fmu import BuildError, build_fmu
from twintube.fmu.container import build_container
from twintube.fmu.instance import FmuError
from twintube.vehicle.cars import load_car
from twintube.vehicle.full.maneuvers import Road
from twintube.vehicle.full.run import CarRun, FullCar, drive_car, full_car
from twintube.vehicle.road import SPACING

SPEED = 50 / 3.6
LEVELS = (1.0, 0.5, 1.0, 1.0)  # the front right damper has lost oil
LOST = (1, 0, 1, 1)


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    folder = tmp_path_factory.mktemp("fmus")
    front, rear = (build_fmu(load(name), folder / f"{name}.fmu", platforms=(fmpy.platform,)) for name in ("SA7", "SA8"))
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


def assert_equal(run: CarRun, wanted: CarRun) -> None:
    for name in ("force", "stroke", "load", "v_x", "roll", "damper_work", "slip_x"):
        a, b = getattr(run, name), getattr(wanted, name)
        assert np.abs(a - b).max() <= 1e-9 * np.abs(b).max(), name


def test_four_fmus_drive_as_the_compiled_dampers_do(car: FullCar, fmus: list[DamperFmu]) -> None:
    road, inputs = Road("C", seed=2).heights(car, 80.0), drive(4.0, 1e-3)
    with_fmus = drive_car_with_fmus(car, SingleFmus(fmus, car.dampers), road, SPACING, inputs, speed=SPEED)
    assert_equal(with_fmus, drive_car(car, road, SPACING, inputs, SPEED))


def test_a_container_drives_as_the_compiled_dampers_do(car: FullCar, tmp_path: Path) -> None:
    arguments = [
        "--worn",
        "front_right",
        "--oil-level",
        "0.5",
        "--gas-lost",
        "--platform",
        fmpy.platform,
        "--output",
        str(tmp_path),
    ]
    command = CliRunner().invoke(app, ["ssp", "--container", *arguments])
    assert command.exit_code == 0, command.output
    file = tmp_path / "twintube_dampers.fmu"
    description = fmpy.read_model_description(str(file))
    units = {v.name: v.unit for v in description.modelVariables}
    assert (units["front_left.stroke"], units["rear_right.velocity"], units["rear_left.force"]) == ("m", "m/s", "N")
    assert all(output.dependencies == [] for output in description.outputs)
    road, inputs = Road("C", seed=2).heights(car, 80.0), drive(4.0, 1e-3)
    with ContainerFmu(file) as dampers:
        run = drive_car_with_fmus(car, dampers, road, SPACING, inputs, speed=SPEED)
    assert_equal(run, drive_car(car, road, SPACING, inputs, SPEED))
    with ContainerFmu(file, **{"front_left.oil_level": 0.5, "front_left.gas_preload": 0}) as dampers:
        assert dampers.forces()[0] != run.force[0, 0]


def test_a_container_for_a_platform_without_one_is_refused(car: FullCar, tmp_path: Path) -> None:
    with pytest.raises(
        BuildError, match="platform = aarch64-linux: a container must be for one of linux64, win64, darwin64"
    ):
        build_container(car.dampers, tmp_path, platforms=("aarch64-linux",))
    assert list(tmp_path.iterdir()) == []


def test_an_fmu_of_another_damper_is_named(car: FullCar, fmus: list[DamperFmu], built: list[Path]) -> None:
    with pytest.raises(
        FmuError, match=r"rear_left: the FMU is not that of SA8: its geometry\.\w+ is [\d.]+, must be [\d.]+"
    ):
        SingleFmus([fmus[0], fmus[1], fmus[0], fmus[3]], car.dampers)
    with pytest.raises(FmuError, match=r"front_left\.stroke is missing, this is not the FMU it should be"):
        ContainerFmu(built[0])


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
        drive_car_with_fmus(
            car,
            SingleFmus(fmus, car.dampers),
            np.zeros((2, 201)),
            SPACING,
            drive(1.0, 1e-3),
            speed=SPEED,
            preconditioned=False,
        )
