"""The whole car driven: from a car's file, four dampers, two road tracks and what the driver does."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from twintube.common.arrays import Array, freeze_arrays
from twintube.core.frame import stroke_limit
from twintube.core.variables import blank
from twintube.dampers import Damper, ParameterError
from twintube.engine import compiled
from twintube.engine.simulate import InputError, at_rest
from twintube.vehicle.cars import CarSet
from twintube.vehicle.drive import CONDITIONING_STEP, conditioning
from twintube.vehicle.full.brakes import Brakes
from twintube.vehicle.full.car import WHEELS, Body, BodyMotion, Wheel, WheelMotion
from twintube.vehicle.full.layout import balance_body, place_wheel, start_wheel
from twintube.vehicle.full.loop import BODY_COLUMNS, WHEEL_COLUMNS
from twintube.vehicle.full.steering import LAG, LEAD, MOST_ANGLE, MOST_RATE, PATH_SPACING, PREVIEW, Pursuer

DT = 1e-3  # [s]


@dataclass(frozen=True)
class FullCar:
    """A car with four dampers in the order of WHEELS."""

    name: str
    body: Body
    wheels: tuple[Wheel, ...]
    brakes: Brakes
    dampers: tuple[Damper, ...]

    @property
    def mass(self) -> float:
        """Mass of body and wheels [kg]."""
        return self.body.mass + sum(wheel.m_wheel for wheel in self.wheels)


@dataclass(frozen=True)
class CarRun:
    """A drive of the whole car: arrays (n,) of the body, (n, 4) of the wheels in the order of WHEELS; SI units."""

    time: Array
    x: Array
    y: Array
    yaw: Array
    z: Array
    pitch: Array  # nose down
    roll: Array  # left side up
    v_x: Array
    v_y: Array
    yaw_rate: Array
    a_x: Array
    a_y: Array
    a_z: Array  # of the body's centre of gravity
    roll_acceleration: Array
    pitch_acceleration: Array
    work: Array  # [J] of road, drive, brakes, damping and friction on the car since the start
    steer: Array  # of the steered wheels
    stroke: Array  # of the dampers
    velocity: Array
    force: Array
    load: Array
    F_x: Array
    F_y: Array
    slip_x: Array
    slip_y: Array
    spin: Array
    pressure: Array
    damper_work: Array  # [J] dissipated by each damper since the start
    a_wheel: Array  # vertical

    def __post_init__(self) -> None:
        """Shared by all who read it."""
        freeze_arrays(self)


def full_car(car: CarSet, dampers: Sequence[Damper]) -> FullCar:
    """The car with four dampers in the order of WHEELS; raises ParameterError where its file has no tables for it."""
    if not car.whole:
        raise ParameterError(f"car {car.name}: the tables of the whole car (body, front_axle, …) are missing")
    if len(dampers) != len(WHEELS):
        raise ParameterError(f"{len(dampers)} dampers: must be {len(WHEELS)}, for {', '.join(WHEELS)}")
    table = car.whole
    body = Body(**table["body"], mass=0.0, x_front=0.0, x_rear=0.0)
    balance_body(body, *(car.axles[name]["m_body"] for name in ("front", "rear")))
    wheels = []
    for i, damper in enumerate(dampers):
        axle = "front" if i < 2 else "rear"
        corner = car.corner_of(axle, damper)
        values = {item.name: getattr(corner, item.name) for item in fields(corner)}
        wheel = Wheel(**values, **table[f"{axle}_axle"], **table[f"{axle}_tyre"], x=0.0, y=0.0, weight=0.0)
        place_wheel(wheel, body.x_front if axle == "front" else -body.x_rear, 1.0 - 2.0 * (i % 2))
        wheels.append(wheel)
    return FullCar(car.name, body, tuple(wheels), Brakes(**table["brakes"]), tuple(dampers))


@dataclass(frozen=True)
class Pursuit:
    """A driver who follows a path (m, 2) [m], a point every PATH_SPACING, and holds the wheel still after `until` [s]."""

    path: Array
    until: float = math.inf


def pursuer(car: FullCar, pursuit: Pursuit | None) -> tuple[Any, Array]:
    """The record of the driver, who knows wheelbase and understeer of his car, and his path; without `pursuit` none."""
    if pursuit is None:
        return compiled.as_row(blank(Pursuer))[0], np.zeros((0, 4))
    front, rear = (sum(w.weight for w in car.wheels[i : i + 2]) for i in (0, 2))
    gives = car.wheels[0].steer_compliance * front / 2.0 - car.wheels[2].steer_compliance * rear / 2.0
    driver = Pursuer(PREVIEW, LEAD, LAG, MOST_RATE, MOST_ANGLE, car.body.wheelbase, gives, pursuit.until, 0.0, 0.0)
    return compiled.as_row(driver)[0], with_curvature(pursuit.path)


def with_curvature(path: Array) -> Array:
    """Points (m, 2) [m] of a path with their direction [rad] and curvature [1/m]: (m, 4)."""
    along = np.gradient(path, axis=0)
    yaw = np.unwrap(np.arctan2(along[:, 1], along[:, 0]))
    return np.column_stack([path, yaw, np.gradient(yaw) / PATH_SPACING])


def together(records: Sequence[Any]) -> np.ndarray[Any, Any]:
    """Records of one type as a structured array (r,)."""
    return np.concatenate([compiled.as_row(record) for record in records])


def started(car: FullCar, speed: float) -> tuple[BodyMotion, list[WheelMotion]]:
    """The car rolling straight ahead at a `speed` [m/s] on a flat road."""
    body = blank(BodyMotion)
    body.v_x, body.seen = speed, speed
    wheels = [blank(WheelMotion) for _ in WHEELS]
    for motion, wheel in zip(wheels, car.wheels, strict=True):
        start_wheel(wheel, motion, speed)
    return body, wheels


class Underway:
    """A car on its way over a road, driven on stretch by stretch; see `drive_car`."""

    def __init__(
        self, car: FullCar, road: Array, spacing: float, speed: float, *, grips: tuple[float, float] = (1.0, 1.0),
        pursuit: Pursuit | None = None, dt: float = DT, preconditioned: bool = True,
    ) -> None:  # fmt: skip
        self.car, self.road, self.spacing, self.dt = car, np.array(road, dtype=float), spacing, dt
        self.grips, self.steps = np.array(grips, dtype=float), 0
        each = [at_rest(damper, 0.0) for damper in car.dampers]
        self.limits = [stroke_limit(row[1]) for row in each]
        self.dampers = p, d, s, f = tuple(together(list(records)) for records in zip(*each, strict=True))
        if preconditioned:
            for i in range(len(WHEELS)):
                compiled.module().run_held(p[i], d[i], s[i], f[i], np.zeros(2), 0.0)
                compiled.module().run_held(p[i], d[i], s[i], f[i], conditioning(), CONDITIONING_STEP)
        self.before = s["work"].copy()
        body, wheels = started(car, speed)
        self.body, self.given = compiled.as_row(car.body)[0], together(car.wheels)
        self.brakes = compiled.as_row(car.brakes)[0]
        self.moving, self.turning = compiled.as_row(body), together(wheels)
        self.driver, self.path = pursuer(car, pursuit)

    def on(self, inputs: Array) -> CarRun:
        """Drive on by `inputs` (n, 3); raises InputError where a piston would leave its tube, and at the end of the road."""
        out = np.empty((len(inputs), BODY_COLUMNS + WHEEL_COLUMNS * len(WHEELS)))
        done = compiled.module().run_car(
            *self.dampers, self.body, self.moving[0], self.given, self.turning, self.brakes, self.road, self.spacing,
            self.grips, self.driver, self.path, np.array(inputs, dtype=float), self.steps, self.dt, out,
        )  # fmt: skip
        begin, self.steps = self.steps, self.steps + done
        if done < len(inputs):
            strokes = self.turning["stroke"] + self.turning["velocity"] * self.dt
            axles = self.moving["way"][0] + np.array([wheel.x for wheel in self.car.wheels]) + self.car.body.x_rear
            length = (self.road.shape[1] - 1) * self.spacing
            raise InputError(f"time {self.steps * self.dt:g} s: {why_stopped(strokes, self.limits, axles, length)}")
        return as_run(out, begin, self.dt, self.before)


def drive_car(  # noqa: PLR0913 - car, road and driver, and how they are run
    car: FullCar, road: Array, spacing: float, inputs: Array, speed: float, *, grips: tuple[float, float] = (1.0, 1.0),
    pursuit: Pursuit | None = None, dt: float = DT, preconditioned: bool = True,
) -> CarRun:  # fmt: skip
    """Drive over `road` (2, m) [m], heights of left and right track every `spacing` [m], from `speed` [m/s] on.

    `inputs` (n, 3): steer angle [rad], brake pressure that the driver wants [Pa], speed [m/s] that he holds (0: none).
    `grips` are the factors of the tyre forces on the left and the right track; `pursuit` steers along a path besides.
    Raises InputError where a piston would leave its tube, and at the end of the road.
    """
    way = Underway(car, road, spacing, speed, grips=grips, pursuit=pursuit, dt=dt, preconditioned=preconditioned)
    return way.on(inputs)


def why_stopped(strokes: Array, limits: Sequence[float], axles: Array, length: float) -> str:
    """Why a drive ended early, by the dampers' strokes (4,) [m] and limits, and the wheels' places (4,) [m] on the road."""
    if not (axles.min() >= 0.0 and axles.max() < length):
        return f"the road ends: the car must stay on its {length:g} m"
    outside = [
        f"stroke {stroke:.3g} m of the {wheel.replace('_', ' ')} damper: must stay within {limit:.3g} m"
        for wheel, stroke, limit in zip(WHEELS, strokes, limits, strict=True)
        if not abs(stroke) <= limit
    ]
    return ", ".join(outside) or "a damper's step could not be finished"


def as_run(out: Array, begin: int, dt: float, before: Array) -> CarRun:
    """The columns of the loop (n, BODY_COLUMNS + 4 WHEEL_COLUMNS) by name, from step `begin` on.

    `before` (4,) [J] is the dampers' earlier work.
    """
    columns = [out[:, i] for i in range(BODY_COLUMNS)]
    table = out[:, BODY_COLUMNS:].reshape(len(out), len(WHEELS), WHEEL_COLUMNS)
    each_wheel = [np.ascontiguousarray(table[:, :, i]) for i in range(WHEEL_COLUMNS)]
    each_wheel[10] = each_wheel[10] - before
    return CarRun((begin + np.arange(len(out))) * dt, *columns, *each_wheel)
