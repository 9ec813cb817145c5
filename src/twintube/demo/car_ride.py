"""The whole car in process with four damper FMUs, stepped through fmpy as any tool would step them."""

import numpy as np

from twintube.arrays import Array
from twintube.demo.four_dampers import FourDampers, precondition_four
from twintube.engine import compiled
from twintube.engine.simulate import InputError
from twintube.vehicle.full.car import WHEELS
from twintube.vehicle.full.loop import BODY_COLUMNS, WHEEL_COLUMNS
from twintube.vehicle.full.run import DT, CarRun, FullCar, as_run, started, together


def drive_car_with_fmus(
    car: FullCar, dampers: FourDampers, road: Array, spacing: float, inputs: Array, speed: float, *,
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
    ws["damper"] = ws["before"] = dampers.forces()
    before = np.array(dampers.works())
    out = np.empty((len(inputs), BODY_COLUMNS + WHEEL_COLUMNS * len(WHEELS)))
    work = BODY_COLUMNS + 10 + WHEEL_COLUMNS * np.arange(len(WHEELS))
    ground, sides = np.array(road, dtype=float), np.array(grips, dtype=float)
    for n, (steer, wanted, held) in enumerate(np.asarray(inputs, dtype=float).tolist()):
        module.write_body(b, out[n])
        if not module.road_step(c, b, ks, ws, h, ground, spacing, sides, steer, wanted, held, dt):
            raise InputError(f"time {n * dt:g} s: the road of {(road.shape[1] - 1) * spacing:g} m ends")
        module.write_step(b, ws, out[n], steer, dt)
        out[n, work] = dampers.works()
        ws["before"] = ws["damper"]
        ws["damper"] = dampers.step(ws["stroke"].tolist(), ws["velocity"].tolist(), dt)
    return as_run(out, dt, before)
