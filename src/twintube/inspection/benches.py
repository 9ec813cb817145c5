"""One corner of a car on the benches: plate run, push-down and slow bump, with the damper in the loop."""

from dataclasses import dataclass, field
from functools import lru_cache
from typing import Final

import numpy as np

from twintube.common.arrays import Array
from twintube.dampers import Damper
from twintube.inspection import figures, tiring
from twintube.inspection.plate import Motion, Plate, motion
from twintube.vehicle.drive import Drive, drive
from twintube.vehicle.maneuvers import BUMP_LENGTH, MANEUVERS
from twintube.vehicle.maneuvers import bump as bump_profile
from twintube.vehicle.quarter_car import GRAVITY, Car, static_load, stop_force

DT: Final = 1e-3  # [s]
PUSH: Final = 0.05  # [m]
SETTLE, PRESS, HOLD, SWING = 2.0, 1.0, 1.0, 4.0  # [s] of the push-down
BUMP_SPEED: Final = next(m.speed_kmh for m in MANEUVERS if m.profile is bump_profile)  # [km/h]
BUMP_SECONDS: Final = 4.0  # [s] of driving at BUMP_SPEED; slower or faster drives go as far
BUMP_END: Final = 1.0 + BUMP_LENGTH  # [m] from the start
ON_PLATE: Final = ("eusama", "phase_shift", "damping_ratio")


@dataclass(frozen=True)
class Setting:
    """How the benches are set, and the errors of their sensors."""

    plate: Plate = field(default_factory=Plate)
    push: float = PUSH  # [m]
    speed_kmh: float = BUMP_SPEED
    force_noise: float = 0.0  # [N] root mean square
    height_noise: float = 0.0  # [m] root mean square
    acceleration_noise: float = 0.0  # [m/s2] root mean square
    phase_error: float = 0.0  # [deg]
    shaker: tuple[Plate, ...] = tiring.PLATES  # in turn, of `tiring`
    velocity_noise: float = 0.0  # [m/s] root mean square, of the damper's velocity
    fade: float = 0.0  # [1/K] of the fluid force, by the heat of the run of `tiring`


@lru_cache(maxsize=8)
def plate_motion(plate: Plate, dt: float) -> Motion:
    """The plate's motion; the dampers of a comparison share it."""
    return motion(plate, dt)


def on_plate(damper: Damper, car: Car, run: Motion) -> Drive:
    """The corner on the moving plate, after the paper's preconditioning; raises InputError if the piston leaves the tube."""
    return drive(damper, car, run.heights, run.dt, rates=run.rates, preconditioned=True)


def pushed(damper: Damper, car: Car, depth: float, dt: float = DT) -> tuple[Array, int]:
    """Height of the body [m] (n,) that is pressed down by `depth` [m] and let go, and the sample of the release.

    The force is that which presses springs and tyre together by `depth`. Before, the corner settles: without gas preload it
    stands lower.
    """
    released = round((SETTLE + PRESS + HOLD) / dt)
    time = np.arange(released + round(SWING / dt)) * dt
    force = depth / (1.0 / car.c_body + 1.0 / car.c_tyre)
    push = force * np.clip((time - SETTLE) / PRESS, 0.0, 1.0)
    push[released:] = 0.0
    still = np.zeros(len(time))
    run = drive(damper, car, still, dt, push=push, rates=still, preconditioned=True)
    # The tyre's damping is below 1 % of its force at the body's frequency.
    wheel = (static_load(car) - run.wheel_load) / car.c_tyre
    return run.stroke / car.ratio + wheel, released


def axle_acceleration(run: Drive, car: Car) -> Array:
    """Vertical acceleration of the axle [m/s2] (n,), from the forces on the wheel."""
    stroke, velocity = run.stroke / car.ratio, run.velocity / car.ratio
    pull = car.c_body * stroke + car.d_links * velocity + car.ratio * (run.force - car.F_rest)
    for i in np.flatnonzero(np.abs(stroke) > car.travel):
        z, v = float(stroke[i]), float(velocity[i])
        stiff, damped = car.c_stop, car.d_stop
        pull[i] += stop_force(stiff, damped, z - car.travel, v) - stop_force(stiff, damped, -z - car.travel, -v)
    acceleration: Array = (pull + run.wheel_load - (car.m_body + car.m_wheel) * GRAVITY) / car.m_wheel
    return acceleration


def after_bump(damper: Damper, car: Car, speed_kmh: float, dt: float = DT) -> Array:
    """Acceleration of the axle [m/s2] (n,) behind the paper's speed bump; on it the bump's shape outweighs the damper."""
    speed = speed_kmh / 3.6
    time = np.arange(0.0, BUMP_SECONDS * BUMP_SPEED / speed_kmh, dt)
    run = drive(damper, car, bump_profile(speed * time, 0), dt, preconditioned=True)
    return axle_acceleration(run, car)[speed * time >= BUMP_END]


def read(
    damper: Damper,
    car: Car,
    methods: tuple[str, ...],
    setting: Setting,
    *,
    noise: int | None = None,
    dt: float = DT,
) -> dict[str, float]:
    """The figures by method; that of `bump` in m/s2, not yet over the intact damper's.

    `noise` is the seed of the sensors' noise, which does not depend on the methods; without it they are exact. Raises
    InputError if the piston would leave the tube.
    """
    found: dict[str, float] = {}

    def sensed(sensor: int, values: Array, size: float) -> Array:
        if noise is None:
            return values
        return values + size * np.random.default_rng([noise, sensor]).standard_normal(len(values))

    if any(name in methods for name in ON_PLATE):
        run = plate_motion(setting.plate, dt)
        force = sensed(0, on_plate(damper, car, run).wheel_load, setting.force_noise)
        measured = figures.measured_cycles(run, force, setting.phase_error)
        found["eusama"] = figures.eusama(run, force, static_load(car))
        found["phase_shift"] = figures.phase_shift(measured)
        found["damping_ratio"] = figures.damping_ratio(measured)
    if "push_down" in methods:
        body, released = pushed(damper, car, setting.push, dt)
        found["push_down"] = figures.push_down(sensed(1, body, setting.height_noise), released)
    if "bump" in methods:
        acceleration = after_bump(damper, car, setting.speed_kmh, dt)
        found["bump"] = figures.bump(sensed(2, acceleration, setting.acceleration_noise))
    if "tiring" in methods:

        def by_sensor(velocity: Array) -> Array:
            return sensed(3, velocity, setting.velocity_noise)

        shaken = tiring.runs(damper, car, setting.shaker, dt, fade=setting.fade, measured=by_sensor)
        found["tiring"] = max(run.growth for run in shaken)
    return {name: found[name] for name in methods}
