"""What importers are given: the damper, the car and the car's system, their inputs, and the outputs that fmpy has."""

import csv
import zipfile
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path

import fmpy
import numpy as np

from benchmarks.fmu import VERSIONS
from twintube.common.arrays import Array
from twintube.dampers import load
from twintube.fmu import build_fmu
from twintube.fmu.car import build_car_fmu
from twintube.fmu.instance import Instance
from twintube.fmu.platforms import Ssp
from twintube.fmu.related import FOLDER
from twintube.fmu.ssp import CAR, TO_CAR, TO_DAMPER, build_ssp
from twintube.vehicle.cars import load_car
from twintube.vehicle.full.car import WHEELS
from twintube.vehicle.full.run import full_car

H, STEPS = 1e-3, 2000
SPEED = 15.0  # [m/s]
COLUMNS = ("damper, FMI 2.0", "car, FMI 2.0", "damper, FMI 3.0", "car, FMI 3.0", "car, SSP 1.0", "car, SSP 2.0")
CAR_OUTPUTS = ("motion.x", "motion.yaw", "motion.roll", "front_left.load", "rear_right.stroke")


class Job:
    """An FMU or SSP, its inputs as a file, and what it must give: (n, outputs) at the end of each step.

    Inputs and outputs of an SSP are those of its car.
    """

    def __init__(self, file: Path, inputs: Path, outputs: Sequence[str]) -> None:
        self.file, self.inputs, self.outputs = file, inputs, outputs
        with inputs.open(encoding="utf-8", newline="") as lines:
            self.names, *rows = csv.reader(lines)
        self.given = np.array(rows, dtype=float)[:STEPS, 1:]
        self.unit = file
        if self.system:
            with zipfile.ZipFile(file) as archive:
                archive.extractall(file.with_suffix(""))
            self.unit = file.with_suffix("") / "resources" / f"{CAR}.fmu"
        description = fmpy.read_model_description(str(self.unit))
        self.new = description.fmiVersion.startswith("3")
        self.references = {v.name: v.valueReference for v in description.modelVariables}
        self.expected = by_fmpy(self)

    @property
    def system(self) -> bool:
        """Whether this is an SSP."""
        return self.file.suffix == ".ssp"

    def difference(self, found: Array) -> float:
        """The largest difference of an output over its largest magnitude."""
        return float((np.abs(found - self.expected).max(axis=0) / np.abs(self.expected).max(axis=0)).max())

    def referred(self) -> tuple[list[int], list[int]]:
        """The value references of inputs and outputs."""
        return [self.references[name] for name in self.names[1:]], [self.references[name] for name in self.outputs]


def by_fmpy(job: Job) -> Array:
    """By fmpy's handles of the libraries; the units of an SSP side by side, values exchanged between the steps."""
    rows = []
    with ExitStack() as opened:
        car = opened.enter_context(Instance(job.unit, {}, (*job.names[1:], *job.outputs)))
        wheels = WHEELS if job.system else ()
        dampers = [opened.enter_context(Instance(job.unit.with_stem(wheel), {}, (*TO_DAMPER, *TO_CAR))) for wheel in wheels]
        write = car.buffer(*job.names[1:], *(f"{wheel}.{name}" for wheel in wheels for name in TO_CAR))
        read = car.buffer(*job.outputs)
        moved = car.buffer(*(f"{wheel}.{name}" for wheel in wheels for name in TO_DAMPER))
        ports = [(damper, damper.buffer(*TO_DAMPER), damper.buffer(*TO_CAR)) for damper in dampers]
        for row in job.given.tolist():
            motion = list(car.read(moved)) if ports else []
            write[2][:] = [*row, *(damper.read(force)[0] for damper, _, force in ports)]
            car.advance(write, H)
            for i, (damper, motions, _) in enumerate(ports):
                motions[2][:] = motion[2 * i : 2 * i + 2]
                damper.advance(motions, H)
            rows.append(list(car.read(read)))
    return np.array(rows)


def drive(file: Path) -> Path:
    """Inputs of a car as a file: it steers, holds its speed, and one wheel goes over waves."""
    time = np.arange(STEPS + 1) * H
    columns = {
        "time": time,
        "steer": 0.02 * np.sin(3 * time),
        "speed": np.full(len(time), SPEED),
        "front_left.road": 0.01 * np.sin(20 * time),
        "front_left.road_rate": 0.2 * np.cos(20 * time),
    }
    rows = np.column_stack(list(columns.values())).tolist()
    lines = [",".join(f'"{name}"' for name in columns), *(",".join(map(repr, row)) for row in rows)]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return file


def jobs(folder: Path) -> dict[str, Job]:
    """Damper and car of FMI 2.0 and 3.0, and the car with its dampers as SSP 1.0 and 2.0."""
    made = {}
    car = full_car(load_car(), [load("SA7")] * 2 + [load("SA8")] * 2)
    driven = drive(folder / "car.csv")
    versions: tuple[Ssp, ...] = (1, 2)
    for (fmi, platform), ssp in zip(VERSIONS, versions, strict=True):
        damper = build_fmu(load("SA8"), folder, platforms=(platform,), fmi=fmi)
        with zipfile.ZipFile(damper) as archive:
            archive.extract(f"{FOLDER}/input.csv", folder)
        made[f"damper, FMI {fmi}.0"] = Job(damper, folder / FOLDER / "input.csv", ("force",))
        made[f"car, FMI {fmi}.0"] = Job(build_car_fmu(car, SPEED, folder, (platform,), fmi=fmi), driven, CAR_OUTPUTS)
        system = build_ssp(car, SPEED, folder / f"car_ssp{ssp}.ssp", (platform,), ssp=ssp)
        made[f"car, SSP {ssp}.0"] = Job(system, driven, CAR_OUTPUTS)
    return {column: made[column] for column in COLUMNS}
