"""Speed of the whole car with four dampers, in process and as FMUs; what its time step does to the wheel loads."""

import tempfile
import time
from contextlib import ExitStack
from pathlib import Path

import fmpy
import numpy as np

from twintube.common.arrays import Array
from twintube.dampers import load
from twintube.dampers.freed_gas import condition
from twintube.demo.car_ride import drive_car_with_fmus
from twintube.demo.damper_fmu import DamperFmu
from twintube.demo.four_dampers import SingleFmus
from twintube.fmu import build_fmu
from twintube.vehicle.cars import load_car
from twintube.vehicle.full.maneuvers import Road, ride
from twintube.vehicle.full.run import DT, FullCar, drive_car, full_car
from twintube.vehicle.ride import SETTLED
from twintube.vehicle.road import SPACING

SECONDS, SPEED, RUNS = 60.0, 50 / 3.6, 5
WORN = {"intact": (), "rear left at 40 %": (2,), "all at 40 %": (0, 1, 2, 3)}  # oil, without preload
FASTER = 80.0  # [km/h], as docs/car.md
FINE, STEPS, SEEDS = DT / 4, (2 * DT, DT, DT / 2), range(1, 6)  # [s]


def bench_car() -> dict[str, float]:
    """Times real time on one core, on a class D road at 50 km/h with steps of 1 ms; the road is made before."""
    front, rear = (load(name) for name in ("SA7", "SA8"))
    car = full_car(load_car(), [front, front, rear, rear])
    road = Road("D").heights(car, SECONDS * SPEED)
    inputs = np.zeros((round(SECONDS / DT), 3))
    inputs[:, 2] = SPEED
    drive_car(car, road, SPACING, inputs[:2000], SPEED)  # compiles
    with_fmus, alone = paired(car, road, inputs)
    return {
        "times_real_time": SECONDS / alone,
        "us_per_step": 1e6 * alone * DT / SECONDS,
        "times_real_time_with_fmus": SECONDS / with_fmus,
        "with_fmus_over_in_process": with_fmus / alone,
    }


def paired(car: FullCar, road: Array, inputs: Array) -> tuple[float, float]:
    """Shortest times of the processor [s] with four native FMUs and in process, by turns."""
    times = []
    with tempfile.TemporaryDirectory() as folder, ExitStack() as stack:
        files = [build_fmu(d, Path(folder) / f"{d.name}.fmu", platforms=(fmpy.platform,)) for d in car.dampers[1:3]]
        fmus = [stack.enter_context(DamperFmu(files[i // 2])) for i in range(len(car.dampers))]
        four = SingleFmus(fmus, car.dampers)
        drive_car_with_fmus(car, four, road, SPACING, inputs[:2000], speed=SPEED)
        for _ in range(RUNS):
            begun = time.process_time()
            drive_car_with_fmus(car, four, road, SPACING, inputs, speed=SPEED, preconditioned=False)
            between = time.process_time()
            drive_car(car, road, SPACING, inputs, SPEED, preconditioned=False)
            times.append((between - begun, time.process_time() - between))
    with_fmus, alone = (min(column) for column in zip(*times, strict=True))
    return with_fmus, alone


def wheel_loads(worn: tuple[int, ...], seed: int, dt: float) -> Array:
    """DLC (4,) of the wheels of a car on a class D road, the dampers of `worn` at 40 % oil without preload."""
    several = [load(name) for name in ("SA7", "SA7", "SA8", "SA8")]
    dampers = [condition(damper, 0.4, 0) if i in worn else damper for i, damper in enumerate(several)]
    run = ride(full_car(load_car(), dampers), FASTER, SECONDS, Road("D", seed), dt=dt)
    loads = run.load[run.time > SETTLED]
    return np.asarray(loads.std(axis=0) / loads.mean(axis=0))


def bench_car_steps() -> dict[str, dict[str, dict[str, float]]]:
    """DLC of each wheel over that with a quarter of the step: mean, lowest and highest of wheels and roads."""
    found: dict[str, dict[str, dict[str, float]]] = {}
    for name, worn in WORN.items():
        fine = np.array([wheel_loads(worn, seed, FINE) for seed in SEEDS])
        table = found[name] = {}
        for dt in STEPS:
            ratio = np.array([wheel_loads(worn, seed, dt) for seed in SEEDS]) / fine
            ends = {"mean": ratio.mean(), "lowest": ratio.min(), "highest": ratio.max()}
            table[f"{1e3 * dt:g} ms"] = {what: round(float(value), 3) for what, value in ends.items()}
    return found
