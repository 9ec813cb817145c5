"""The car as a native FMU: its rules, and with four damper FMUs in two masters against the car in process."""

import fmpy
import numpy as np
import pytest
from coupled import SECONDS, SPEED, Coupled
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from masters import Unit, drive

from twintube.core.variables import blank
from twintube.vehicle.cars import load_car
from twintube.vehicle.full import exchange, signals
from twintube.vehicle.full.car import WHEELS, BodyMotion, WheelMotion
from twintube.vehicle.full.run import FullCar, full_car


@pytest.fixture(scope="module")
def coupled(tmp_path_factory: pytest.TempPathFactory) -> Coupled:
    return Coupled(tmp_path_factory.mktemp("car"))


def test_it_is_valid_and_describes_itself(coupled: Coupled) -> None:
    assert validate_fmu(str(coupled.car_file)) == []
    description = fmpy.read_model_description(str(coupled.car_file))
    by_name = {v.name: v for v in description.modelVariables}
    assert by_name["front_left.force"].unit == "N" and by_name["rear_right.stroke"].unit == "m"
    assert float(by_name["start.speed"].start) == SPEED
    assert float(by_name["body.wheelbase"].start) == coupled.car.body.wheelbase
    assert all(v.description for v in by_name.values() if v.name != "time")
    assert all(output.dependencies == [] for output in description.outputs)


def test_the_car_stepped_first_drives_as_in_process(coupled: Coupled) -> None:
    rows = drive(coupled.car_file, coupled.damper_files, coupled.inputs(1e-3), coupled.ground, 1e-3, parallel=False)
    run = coupled.in_process(1e-3)
    assert np.abs(rows["stroke"] - run.stroke).max() <= 1e-9 * np.abs(run.stroke).max()
    assert np.abs(rows["load"] - run.load).max() <= 1e-9 * run.load.max()


@pytest.mark.parametrize("parallel", [False, True])
def test_the_coupling_error_falls_with_the_communication_step(coupled: Coupled, parallel: bool) -> None:
    errors = []
    for length in (4e-3, 2e-3, 1e-3):
        rows = drive(
            coupled.car_file, coupled.damper_files, coupled.inputs(length), coupled.ground, length, parallel=parallel
        )  # fmt: skip
        errors.append(coupled.errors(rows["load"], rows["stroke"], length))
    assert all(fine < 0.8 * coarse for coarse, fine in zip(errors, errors[1:], strict=False))
    assert errors[-1] < 0.02  # of the loads' standard deviation


@pytest.mark.parametrize("parallel", [False, True])
def test_mixed_steps_are_as_good_as_steps_twice_as_long(coupled: Coupled, parallel: bool) -> None:
    """Steps of 0 to 2 ms at random, a third of them of no length: after a short one no slope of the force is known."""
    random = np.random.default_rng(1)
    mixed = random.choice([0.0, 0.0, 1e-6, 1e-4, 1e-3, 2e-3], 9000) * random.uniform(0.5, 1.0, 9000)
    mixed = mixed[np.cumsum(mixed) < SECONDS]
    errors = []
    for lengths in (mixed, np.full(round(SECONDS / 4e-3), 4e-3)):
        inputs = coupled.inputs_at(np.cumsum(lengths) - lengths)
        rows = drive(coupled.car_file, coupled.damper_files, inputs, coupled.ground, lengths, parallel=parallel)
        some = lengths > 0.0  # else the load is still that of the step before
        errors.append(coupled.errors(rows["load"][some], rows["stroke"][some], lengths[some]))
    assert errors[0] < errors[1]


def interpreted(car: FullCar, lengths: list[float], forces: np.ndarray, roads: np.ndarray) -> list[list[float]]:
    """Loads and strokes of the interpreted equations, as the FMU steps them."""
    body, wheels = blank(BodyMotion), [blank(WheelMotion) for _ in WHEELS]
    inputs = [blank(signals.WheelInputs) for _ in WHEELS]
    driver, course = blank(signals.DriverInputs), blank(signals.Course)
    driver.grip, driver.steer, driver.speed = 0.8, 0.02, SPEED
    for given, wheel in zip(inputs, car.wheels, strict=True):
        given.force = wheel.F_rest
    exchange.set_up_car(car.body, *car.wheels)
    exchange.start_car(body, *car.wheels, *wheels, *inputs, SPEED)
    rows = []
    for length, force, road in zip(lengths, forces, roads, strict=True):
        for i, given in enumerate(inputs):
            given.force, given.road_rate = force[i], road[i]
        exchange.communication_step(
            car.body, body, *car.wheels, *wheels, car.brakes, driver, *inputs, course, length
        )  # fmt: skip
        out = [blank(signals.WheelOutputs) for _ in WHEELS]
        for k, w, o in zip(car.wheels, wheels, out, strict=True):
            exchange.publish_wheel(body, k, w, o, course)
        rows.append([body.x, body.roll, *(o.load for o in out), *(o.stroke for o in out), *(o.velocity for o in out)])
    return rows


def test_the_library_computes_what_the_equations_say_in_steps_of_any_length(coupled: Coupled) -> None:
    random = np.random.default_rng(7)
    lengths = random.choice([0.0, 2e-4, 1e-3, 1.7e-3, 5e-3], 300).tolist()
    forces, roads = 300.0 * random.standard_normal((300, 4)), 0.05 * random.standard_normal((300, 4))
    wanted = interpreted(full_car(load_car(), coupled.car.dampers), lengths, forces, roads)
    names = ["motion.x", "motion.roll", *(f"{w}.{n}" for n in ("load", "stroke", "velocity") for w in WHEELS)]
    with Unit(coupled.car_file) as car:
        car.set({"grip": 0.8, "steer": 0.02, "speed": SPEED})
        time = 0.0
        for length, force, road, row in zip(lengths, forces, roads, wanted, strict=True):
            for i, wheel in enumerate(WHEELS):
                car.set({f"{wheel}.force": force[i], f"{wheel}.road_rate": road[i]})
            car.step(time, length)
            time += length
            assert car.get(*names) == row


def test_a_state_brings_the_car_back(coupled: Coupled) -> None:
    with Unit(coupled.car_file) as car:
        car.set({"brake_pressure": 3e6, "steer": 0.01})
        for n in range(50):
            car.step(n * 1e-3, 1e-3)
        state = car.fmu.serializeFMUstate(car.fmu.getFMUState())
        paths = []
        for _ in range(2):
            for n in range(50, 100):
                car.step(n * 1e-3, 1e-3)
            paths.append(car.get("motion.x", "motion.yaw", "front_left.slip_x", "rear_right.load"))
            car.fmu.setFMUState(car.fmu.deSerializeFMUstate(state))
        assert paths[0] == paths[1]


@pytest.mark.parametrize(
    ("name", "value"),
    [("grip", 0.0), ("front_left.force", 2e6), ("steer", 2.0), ("brake_pressure", -1.0), ("steer", np.nan)],
)
def test_values_out_of_range_are_refused(coupled: Coupled, name: str, value: float) -> None:
    with Unit(coupled.car_file) as car:
        car.step(0.0, 1e-3)
        before = car.get("motion.x", "front_left.load")
        with pytest.raises(FMICallException):
            car.set({name: value})
        assert car.get("motion.x", "front_left.load") == before


def test_a_step_beyond_a_second_is_refused(coupled: Coupled) -> None:
    with Unit(coupled.car_file) as car:
        with pytest.raises(FMICallException):
            car.step(0.0, 1.5)
        car.step(0.0, 1e-3)


def test_absurd_parameters_of_the_car_are_refused(coupled: Coupled) -> None:
    with pytest.raises(FMICallException):
        Unit(coupled.car_file, **{"body.wheelbase": 0.0})
    with Unit(coupled.car_file, **{"body.height": 0.9, "start.speed": 5.0}) as car:
        assert car.get("motion.v_x") == [5.0]


def test_a_drive_that_the_numbers_cannot_hold_is_refused(coupled: Coupled) -> None:
    with Unit(coupled.car_file) as car, pytest.raises(FMICallException):
        for n in range(4000):
            car.set({"front_left.force": 1e6 * (-1) ** n, "rear_right.force": -1e6 * (-1) ** n})
            car.step(n * 0.5, 0.5)
            assert np.isfinite(car.get("motion.z", "motion.roll", "front_left.load")).all()
