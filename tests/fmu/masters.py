"""Two plain masters of the car's FMU and four damper FMUs of FMI 2.0 or 3.0, through fmpy."""

import shutil
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

from twintube.common.arrays import Array
from twintube.vehicle.full.car import WHEELS

Road = Callable[[float], tuple[Array, Array]]  # heights [m] and rates [m/s] (4,) at the way driven [m]


class Unit:
    """An FMU, variables by name; a context manager that frees it."""

    def __init__(self, file: Path, **start: float) -> None:
        self.folder = fmpy.extract(str(file))
        description = fmpy.read_model_description(str(file))
        assert description.coSimulation is not None
        identifier = description.coSimulation.modelIdentifier
        self.references = {v.name: v.valueReference for v in description.modelVariables}
        old = description.fmiVersion == "2.0"
        self.type = "Real" if old else "Float64"
        self.fmu = (FMU2Slave if old else FMU3Slave)(
            guid=description.guid, unzipDirectory=self.folder, modelIdentifier=identifier, instanceName=file.stem
        )
        self.fmu.instantiate()
        self.set(start)
        if old:
            self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def __enter__(self) -> "Unit":
        return self

    def __exit__(self, *error: object) -> None:
        self.fmu.terminate()
        self.fmu.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)

    def set(self, values: dict[str, Any]) -> None:
        references, numbers = [self.references[name] for name in values], [float(value) for value in values.values()]
        getattr(self.fmu, f"set{self.type}")(references, numbers)

    def get(self, *names: str) -> list[float]:
        return [float(value) for value in getattr(self.fmu, f"get{self.type}")([self.references[name] for name in names])]

    def step(self, time: float, length: float) -> None:
        self.fmu.doStep(currentCommunicationPoint=time, communicationStepSize=length)


def wheels_of(name: str) -> list[str]:
    """The names of a variable at the four wheels."""
    return [f"{wheel}.{name}" for wheel in WHEELS]


READ = ("stroke", "load", "height")


def drive(
    car_file: Path, dampers: Sequence[Path], inputs: Array, road: Road, lengths: float | Array, *, parallel: bool
) -> dict[str, Array]:
    """Strokes, loads and heights (n, 4) at the end of each communication step of `lengths` [s], one for all or (n,).

    `inputs` (n, 3) as `drive_car` takes them. A `parallel` master exchanges values between steps only, as others do; the
    other one steps the car first and moves the dampers as the car has moved.
    """
    rows, way, time = [], 0.0, 0.0
    units = [Unit(file) for file in dampers]
    with Unit(car_file) as car:
        force = [unit.get("force")[0] for unit in units]
        steps = np.broadcast_to(lengths, len(inputs)).tolist()
        for (steer, pressure, speed), length in zip(inputs.tolist(), steps, strict=True):
            heights, rates = road(way)
            x, y, forward = car.get("motion.x", "motion.y", "motion.v_x")
            stroke, velocity = car.get(*wheels_of("stroke")), car.get(*wheels_of("velocity"))
            values = {"steer": steer, "brake_pressure": pressure, "speed": speed}
            values |= dict(zip(wheels_of("force"), force, strict=True))
            values |= dict(zip(wheels_of("road"), heights, strict=True))
            values |= dict(zip(wheels_of("road_rate"), rates * forward, strict=True))
            car.set(values)
            car.step(time, length)
            after = car.get("motion.x", "motion.y")
            way += float(np.hypot(after[0] - x, after[1] - y))
            if not parallel:
                moved = car.get(*wheels_of("stroke"))
                if length > 0.0:
                    velocity = [(b - a) / length for a, b in zip(stroke, moved, strict=True)]
            for unit, z, v in zip(units, stroke, velocity, strict=True):
                unit.set({"stroke": z, "velocity": v})
                unit.step(time, length)
            force = [unit.get("force")[0] for unit in units]
            rows.append([*stroke, *car.get(*wheels_of("load")), *car.get(*wheels_of("height"))])
            time += length
    for unit in units:
        unit.__exit__()
    table = np.array(rows).reshape(len(rows), len(READ), len(WHEELS))
    return {name: table[:, i] for i, name in enumerate(READ)}
