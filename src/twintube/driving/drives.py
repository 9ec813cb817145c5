"""A drive of the whole car as its bus shows it: the driver's course, the car's motion, its sensors."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np

from twintube.common.arrays import Array
from twintube.driving.channels import CHANNELS, PLACES
from twintube.driving.sensors import (
    INERTIAL,
    OUTSIDE,
    RASTER,
    STEERING,
    VERTICAL,
    Encoder,
    resolutions,
    rounded,
    sensed,
    wheel_speed,
)
from twintube.driving.signals import Signals
from twintube.engine import compiled
from twintube.errors import InputError
from twintube.vehicle.full.car import WHEELS
from twintube.vehicle.full.maneuvers import Road, checked_speed
from twintube.vehicle.full.rolling import ROLL_COLUMNS, ROLL_STATES
from twintube.vehicle.full.run import DT, CarRun, FullCar, Underway, together
from twintube.vehicle.quarter_car import GRAVITY
from twintube.vehicle.road import CONTACT_LENGTH, SPACING

ROOM: Final = 23.0  # [degC] at which F-v curve, friction and gas of the parameter sets hold (assumed)
SETTLED: Final = 5.0  # [s] that a drive begins before its signals do
STRETCH: Final = 60.0  # [s] computed at a time
# The driver: assumed, a calm drive on a country road.
WANDER: Final = (0.04, 0.02)  # slow changes of speed over the mean, root mean square, and their frequency [Hz]
CURVES: Final = (0.5, 0.05)  # [m/s2] lateral acceleration, root mean square, and its frequency [Hz]
STOPS: Final = 90.0  # [s] between two brakings, mean
BRAKED: Final = (2.0, 2.0)  # deceleration [m/s2], and how long [s]
REGAINED: Final = 0.7  # [m/s2] after it
SLOWEST: Final = 5.0  # [m/s] below which nobody brakes
HILL: Final = 400.0  # [m] within which the grade changes
GIVES: Final = 1.0  # share of the speed lost per grade: 5 % uphill, 5 % slower


@dataclass(frozen=True)
class Bushings:
    """How the links hold a wheel along the body: stiffness [N/m] and damping [N.s/m], (4,) each."""

    stiff: Array
    soft: Array


@dataclass(frozen=True)
class Scene:
    """A drive: which car with which dampers, where, how fast [km/h] and how long [s]; `random` is for driver and sensors.

    `scale` is the factor of the road's spectrum within its class, `sheet` what a data sheet says, `labels` the truth.
    """

    car: FullCar
    bushings: Bushings
    encoders: tuple[Encoder, ...]
    road: Road
    scale: float
    speed_kmh: float
    seconds: float
    random: int
    sheet: Mapping[str, Any]
    labels: Mapping[str, Any] = field(default_factory=dict)
    hills: float = 0.0  # grade [1], root mean square
    ambient: float = ROOM  # [degC] of the air


def slow_noise(count: int, dt: float, frequency: float, random: np.random.Generator) -> Array:
    """Noise (count,) of variance 1 that changes within 1 / `frequency` [Hz]."""
    knots = random.standard_normal(int(count * dt * frequency * 2.0) + 4)
    places = np.arange(count) * dt * frequency * 2.0
    noise = np.interp(places, np.arange(len(knots)), knots)
    return np.asarray(noise / np.sqrt(2.0 / 3.0))  # what a line between knots leaves of the variance


def grades(scene: Scene, speed: float, count: int) -> Array:
    """The grade [1] (count,) of the road under the car, every DT."""
    return scene.hills * slow_noise(count, DT, speed / HILL, np.random.default_rng([scene.random, 1]))


def course(car: FullCar, speed: float, seconds: float, grade: Array, random: np.random.Generator) -> Array:
    """What the driver does: inputs (n, 3) of `drive_car` around a `speed` [m/s], with curves, and brakings now and then.

    Uphill, by a `grade` (n,), he gets slower.
    """
    count = round(seconds / DT)
    wanted = speed * (1.0 + WANDER[0] * slow_noise(count, DT, WANDER[1], random) - GIVES * grade)
    lateral = CURVES[0] * slow_noise(count, DT, CURVES[1], random)
    braked = np.zeros(count, dtype=bool)
    at = SETTLED + random.exponential(STOPS)
    while at + BRAKED[1] < seconds and speed - BRAKED[0] * BRAKED[1] > SLOWEST:
        begin, end = round(at / DT), round((at + BRAKED[1]) / DT)
        braked[begin:end] = True
        lost = BRAKED[0] * BRAKED[1] - REGAINED * DT * np.arange(count - end)
        wanted[end:] -= np.clip(lost, 0.0, None)
        at += BRAKED[1] + BRAKED[0] * BRAKED[1] / REGAINED + random.exponential(STOPS)
    gain = 2.0 * sum(wheel.brake / wheel.radius for wheel in car.wheels[::2])
    gives = car.wheels[0].steer_compliance * car.wheels[0].weight - car.wheels[2].steer_compliance * car.wheels[2].weight
    inputs = np.zeros((count, 3))
    inputs[:, 0] = lateral * (car.body.wheelbase / speed**2 + gives / GRAVITY)
    inputs[:, 1] = np.where(braked, car.mass * BRAKED[0] / gain, 0.0)
    inputs[:, 2] = np.where(braked, 0.0, wanted)
    return inputs


def ground(scene: Scene, length: float) -> tuple[Array, Array]:
    """Heights and slopes (2, m) of the tracks; the slope is that between the ends of the tyre's contact."""
    heights = scene.road.heights(scene.car, length) * np.sqrt(scene.scale)
    reach = round(CONTACT_LENGTH / SPACING) // 2
    slopes = np.zeros_like(heights)
    slopes[:, reach:-reach] = (heights[:, 2 * reach :] - heights[:, : -2 * reach]) / (2 * reach * SPACING)
    return heights, slopes


def rolled(scene: Scene, run: CarRun, slopes: Array, way: float, state: Array) -> tuple[Array, float]:
    """Spins and push (n, ROLL_COLUMNS) of a stretch from a `way` [m] on, and the way at its end; carries `state` on."""
    speed = np.hypot(run.v_x, run.v_y)
    ways = way + np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * DT)])
    places = [(ways + wheel.x + scene.car.body.x_rear) / SPACING for wheel in scene.car.wheels]
    grid = np.arange(slopes.shape[1])
    slope = np.column_stack([np.interp(place, grid, slopes[i % 2]) for i, place in enumerate(places)])
    out = np.empty((len(run.time), ROLL_COLUMNS))
    bushings = scene.bushings
    given = [np.array(values) for values in (run.load, slope, run.spin, run.F_x, run.a_x)]
    compiled.module().roll_wheels(
        together(scene.car.wheels), np.array(bushings.stiff), np.array(bushings.soft), *given, DT, state, out
    )
    return out, float(ways[-1] + speed[-1] * DT)


def seen(scene: Scene, run: CarRun, out: Array, grade: Array) -> dict[str, Array]:
    """What moves the sensors in a stretch, (n,) or (n, 4); accelerometers feel the weight as the body pitches and rolls.

    So they do on a hill, which moves the car by the engine only.
    """
    push = out[:, ROLL_COLUMNS - 1] / scene.car.body.mass
    columns = {
        "spin": out[:, : ROLL_COLUMNS - 1],
        "steer": run.steer,
        "accel_x_m_per_s2": run.a_x + push + GRAVITY * (grade - run.pitch),
        "accel_y_m_per_s2": run.a_y + GRAVITY * run.roll,
        "yaw_rate_rad_per_s": run.yaw_rate,
        "brake_pressure_pa": run.pressure.max(axis=1),
        "body_accel_z_m_per_s2": run.a_z,
    }
    return columns | {f"wheel_accel_{place}_m_per_s2": run.a_wheel[:, i] for i, place in enumerate(PLACES)}


def driven(scene: Scene) -> Signals:
    """Drive; raises InputError where a piston would leave its tube."""
    random = np.random.default_rng(scene.random)
    speed = checked_speed(scene.speed_kmh)
    grade = grades(scene, speed, round((scene.seconds + SETTLED) / DT))
    inputs = course(scene.car, speed, scene.seconds + SETTLED, grade, random)
    # The speed that is held swings on a rough road, and the road must not end before the time.
    heights, slopes = ground(scene, 1.1 * float(np.sum(np.where(inputs[:, 2] > 0, inputs[:, 2], speed))) * DT + 100.0)
    way = Underway(scene.car, heights, SPACING, speed, grips=scene.road.grips)
    state, at = np.zeros((len(WHEELS), ROLL_STATES)), 0.0
    parts: list[dict[str, Array]] = []
    size = round(STRETCH / DT)
    for begin in range(0, len(inputs), size):
        run = way.on(inputs[begin : begin + size])
        out, at = rolled(scene, run, slopes, at, state)
        parts.append(seen(scene, run, out, grade[begin : begin + len(out)]))
    moved = {name: np.concatenate([part[name] for part in parts])[round(SETTLED / DT) :] for name in parts[0]}
    return on_bus(scene, moved, random)


def on_bus(scene: Scene, moved: Mapping[str, Array], random: np.random.Generator) -> Signals:
    """The signals of what moves the sensors, every DT."""
    radius = float(scene.sheet["wheel_radius_m"])
    fastest = float(moved["spin"].max())
    most = CHANNELS["wheel_speed_fl_rad_per_s"].upper
    if fastest > most:
        wheel = WHEELS[int(np.argmax(moved["spin"].max(axis=0)))].replace("_", " ")
        raise InputError(
            f"the {wheel} wheel races at {fastest:.0f} rad/s off the ground: must be at most {most:g} rad/s; "
            "drive slower, or on a better road"
        )
    values = {
        f"wheel_speed_{place}_rad_per_s": wheel_speed(moved["spin"][:, i], DT, scene.encoders[i], radius)
        for i, place in enumerate(PLACES)
    }
    values |= {name: sensed(moved[name], DT, sensor, random) for name, sensor in INERTIAL.items()}
    values["steering_angle_rad"] = rounded(moved["steer"][:: round(RASTER / DT)], float(STEERING))
    values |= {name: sensed(moved[name], DT, sensor, random) for name, sensor in VERTICAL.items()}
    time = np.arange(len(values["steering_angle_rad"])) * RASTER
    values["ambient_temperature_degC"] = np.full(len(time), rounded(np.array(scene.ambient), OUTSIDE))
    about = {"seconds": scene.seconds}
    return Signals(time, values, scene.sheet, about, resolutions(radius, values), scene.labels)
