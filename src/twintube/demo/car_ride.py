"""The whole car in process with four damper FMUs, stepped by their addresses as a tool in C steps them."""

import numpy as np

from twintube.common.arrays import Array
from twintube.demo.four_dampers import FourDampers, precondition_four
from twintube.engine import compiled
from twintube.engine.simulate import InputError
from twintube.vehicle.full.car import WHEELS
from twintube.vehicle.full.loop import BODY_COLUMNS, WHEEL_COLUMNS
from twintube.vehicle.full.run import DT, CarRun, FullCar, as_run, started, together


def drive_car_with_fmus(  # noqa: PLR0913 - as `drive_car`
    car: FullCar, dampers: FourDampers, road: Array, spacing: float, inputs: Array, *, speed: float,
    grips: tuple[float, float] = (1.0, 1.0), dt: float = DT, preconditioned: bool = True,
) -> CarRun:  # fmt: skip
    """As `drive_car`, but the dampers are FMUs, just initialised; of `car.dampers` only preload and stroke are used.

    The communication step is `dt` [s]. Raises FmuError where an FMU refuses a step, InputError at the end of the road.
    """
    module = compiled.module()
    body, wheels = started(car, speed)
    c, b, h = (compiled.as_row(record)[0] for record in (car.body, body, car.brakes))
    ks, ws = together(car.wheels), together(wheels)
    if preconditioned:
        precondition_four(dampers)
    before = dampers.works()
    out, refused = np.empty((len(inputs), BODY_COLUMNS + WHEEL_COLUMNS * len(WHEELS))), np.zeros(1, np.int64)
    done = module.run_car_with_units(
        dampers.calls, dampers.moved, dampers.found, dampers.now, dampers.moves, dampers.parts(dt), c, b, ks, ws, h,
        np.ascontiguousarray(road), spacing, np.array(grips), np.ascontiguousarray(inputs), dt, out, refused,
    )  # fmt: skip
    dampers.check(refused[0])
    if done < len(inputs):
        raise InputError(f"time {done * dt:g} s: the road of {(road.shape[1] - 1) * spacing:g} m ends")
    return as_run(out, 0, dt, before)
