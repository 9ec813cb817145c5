"""A braked drive on an uneven road with a worn damper: car FMU, damper FMUs, and what the car in process does."""

from pathlib import Path

import fmpy
import numpy as np

from twintube.common.arrays import Array
from twintube.dampers import load
from twintube.dampers.freed_gas import condition
from twintube.fmu import build_fmu
from twintube.fmu.car import build_car_fmu
from twintube.vehicle.cars import load_car
from twintube.vehicle.full.maneuvers import Road
from twintube.vehicle.full.run import CarRun, drive_car, full_car
from twintube.vehicle.road import SPACING

SPEED, SECONDS = 50 / 3.6, 3.0
STATES = (("SA7", 1.0, 1), ("SA7", 0.5, 0), ("SA8", 1.0, 1), ("SA8", 1.0, 1))
PLATFORMS = (fmpy.platform,)
EXACT = 2.5e-4  # [s]
LONGEST_PART = 1e-3  # [s] of the car: its loads belong to the start of a step's last part


class Coupled:
    """The FMUs of the drive, and its errors against the car in process in steps of EXACT."""

    def __init__(self, folder: Path) -> None:
        dampers = [condition(load(name), level, preload) for name, level, preload in STATES]
        self.car = full_car(load_car(), dampers)
        self.car_file = build_car_fmu(self.car, SPEED, folder / "car.fmu", PLATFORMS)
        files = [build_fmu(d, folder / f"damper_{i}.fmu", platforms=PLATFORMS) for i, d in enumerate(dampers[:3])]
        self.damper_files = [*files, files[-1]]
        self.road = Road("C", seed=2).heights(self.car, 80.0)
        self.places = np.array([wheel.x + self.car.body.x_rear for wheel in self.car.wheels])
        self.exact = self.in_process(EXACT)

    def ground(self, way: float) -> tuple[Array, Array]:
        """Heights (4,) [m] and slopes (4,) [1] under the wheels after `way` [m]."""
        at = (way + self.places) / SPACING
        j, side = at.astype(int), np.array([0, 1, 0, 1])
        rise = self.road[side, j + 1] - self.road[side, j]
        return self.road[side, j] + (at - j) * rise, rise / SPACING

    @staticmethod
    def inputs(length: float) -> Array:
        """Steer angle, brake pressure and held speed (n, 3)."""
        return Coupled.inputs_at(np.arange(round(SECONDS / length)) * length)

    @staticmethod
    def inputs_at(times: Array) -> Array:
        """The same for steps that begin at these times [s]."""
        rows = np.zeros((len(times), 3))
        rows[:, 2] = SPEED
        rows[times > 0.5 * SECONDS - 1e-9, 1:] = (3e6, 0.0)
        return rows

    def in_process(self, dt: float) -> CarRun:
        """The drive with steps of `dt` [s]."""
        return drive_car(self.car, self.road, SPACING, self.inputs(dt), SPEED, dt=dt, preconditioned=False)

    def errors(self, loads: Array, strokes: Array, lengths: float | Array) -> float:
        """The larger of the RMS errors of loads and strokes (n, 4), each over the standard deviation."""
        steps = np.broadcast_to(lengths, len(loads))
        begins = np.cumsum(steps) - steps
        at = np.arange(0.3, SECONDS - 0.05, 0.008)
        shares = []
        for time, values, wanted in (
            (begins + steps - np.minimum(steps, LONGEST_PART), loads, self.exact.load),
            (begins, strokes, self.exact.stroke),
        ):
            exact = np.column_stack([np.interp(at, self.exact.time, wanted[:, i]) for i in range(4)])
            error = np.column_stack([np.interp(at, time, values[:, i]) for i in range(4)]) - exact
            shares.append(float(np.sqrt(np.mean(error**2)) / exact.std(axis=0).mean()))
        return max(shares)
