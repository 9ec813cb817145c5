"""ISO 3888-2, obstacle avoidance: the lanes, the driver's line through them, and whether a car passed.

Lengths and widths are those of ISO 3888-2:2011, Table 1, as open implementations of it give them (12, 13.5, 11, 12.5, 12 m;
61 m in all is confirmed by the standard's summary); the throttle is released 2 m after the entry, and
the last lane is at least 3 m wide (both from memory; implementations differ on the latter).
"""

from dataclasses import dataclass

import numpy as np

from twintube.common.arrays import Array
from twintube.vehicle.full.maneuvers import APPROACH, Road, checked_speed
from twintube.vehicle.full.run import DT, CarRun, FullCar, Pursuit, drive_car
from twintube.vehicle.full.steering import PATH_SPACING
from twintube.vehicle.road import SPACING

LENGTHS = (12.0, 13.5, 11.0, 12.5, 12.0)  # [m] of the sections; the second and the fourth are free
ASIDE = 1.0  # [m] between the first lane's left and the third section's right limit
RELEASE = 2.0  # [m] after the entry, where the throttle is released
FLANKS = 0.25  # [m] by which a car is wider than its track: a tyre of 225 mm, and a Passat's 1.83 m less 1.58 m
RUN_OUT = 30.0  # [m] after the lanes
# The driver's line: that of a trained driver, as his values in `steering.py`.
BEND = 18.0  # [m] of his bends through the free sections
LATER = (-1.2, -0.9)  # [m] by which their middles lie behind those of the sections
NEAR = (0.1, 0.15, -0.15)  # [m] of his line off the middle of the lanes, towards the other one
SLOWEST, FASTEST = 50.0, 120.0  # [km/h] entries that are tried: below, he would take another line


@dataclass(frozen=True)
class Lane:
    """A section with cones: from where to where, and between which limits [m]."""

    begin: float
    end: float
    right: float
    left: float


def width_of(car: FullCar) -> float:
    """Width of the car [m], without mirrors."""
    return max(wheel.track for wheel in car.wheels) + FLANKS


def lanes(width: float, entry: float = 0.0) -> tuple[Lane, Lane, Lane]:
    """The three lanes for a car of this `width` [m], the first from `entry` [m] on, its middle at 0."""
    first, third, fifth = 1.1 * width + 0.25, width + 1.0, max(1.3 * width + 0.25, 3.0)
    at = entry + np.concatenate([[0.0], np.cumsum(LENGTHS)])
    right = 0.5 * first + ASIDE
    return (
        Lane(at[0], at[1], -0.5 * first, 0.5 * first),
        Lane(at[2], at[3], right, right + third),
        Lane(at[4], at[5], -0.5 * fifth, 0.5 * fifth),
    )


def line(width: float, entry: float) -> Array:
    """The driver's line (m, 2) [m]."""
    first, third, fifth = lanes(width, entry)
    middles = [0.5 * (lane.left + lane.right) for lane in (first, third, fifth)]
    heights = [middles[0] - NEAR[0], middles[1] - NEAR[1], middles[2] + NEAR[2]]
    x = np.arange(int((fifth.end + 2.0 * RUN_OUT) / PATH_SPACING)) * PATH_SPACING
    y = np.zeros(len(x))
    # He goes to the right side of his lane first, over twice the length.
    turns = ((entry - 2.0 * BEND, 2.0 * BEND, 0.0, heights[0]),
             (0.5 * (first.end + third.begin - BEND) + LATER[0], BEND, *heights[:2]),
             (0.5 * (third.end + fifth.begin - BEND) + LATER[1], BEND, *heights[1:]))  # fmt: skip
    for begin, length, low, high in turns:
        y += (high - low) * 0.5 * (1.0 - np.cos(np.pi * np.clip((x - begin) / length, 0.0, 1.0)))
    return np.column_stack([x, y])


def entry_of(speed: float) -> float:
    """Where the lanes begin [m] for an approach at a `speed` [m/s]."""
    return speed * APPROACH


def lane_change(car: FullCar, speed_kmh: float, road: Road, dt: float = DT) -> CarRun:
    """Through the lanes from an entry speed on, throttle released RELEASE after the entry; raises InputError."""
    speed = checked_speed(speed_kmh)
    entry, width = entry_of(speed), width_of(car)
    time = np.arange(round((APPROACH + (sum(LENGTHS) + RUN_OUT) / speed) / dt)) * dt
    inputs = np.zeros((len(time), 3))
    # The nose of the car, here its front axle, is in the lane.
    inputs[:, 2] = speed * (speed * time < entry + RELEASE - car.body.x_front)
    length = 1.2 * (entry + sum(LENGTHS) + RUN_OUT)
    pursuit = Pursuit(line(width, entry))
    return drive_car(
        car, road.heights(car, length), SPACING, inputs, speed, grips=road.grips, pursuit=pursuit, dt=dt
    )  # fmt: skip


def corners(car: FullCar, run: CarRun) -> tuple[Array, Array]:
    """Places (n, 4) [m] of the car's corners along and aside: a rectangle between its axles; overhangs are left out."""
    half = 0.5 * width_of(car)
    ahead = np.array([car.body.x_front, car.body.x_front, -car.body.x_rear, -car.body.x_rear])
    left = np.array([half, -half, half, -half])
    cosine, sine = np.cos(run.yaw)[:, None], np.sin(run.yaw)[:, None]
    return run.x[:, None] + cosine * ahead - sine * left, run.y[:, None] + sine * ahead + cosine * left


def excess(car: FullCar, run: CarRun, entry: float) -> float:
    """How far [m] the car came out of the lanes at most; below 0 what room was left."""
    x, y = corners(car, run)
    furthest = [-np.inf]
    for lane in lanes(width_of(car), entry):
        inside = (x >= lane.begin) & (x <= lane.end)
        if not inside.any():
            return float("inf")
        furthest.append(float(np.maximum(y - lane.left, lane.right - y)[inside].max()))
    return max(furthest)


def highest_entry(car: FullCar, road: Road) -> float | None:
    """Highest entry speed [km/h] passed before the first that is not, in steps of 5 and then 1 km/h; None if none is."""
    passed, speed, step = None, SLOWEST, 5.0
    while speed <= FASTEST:
        if excess(car, lane_change(car, speed, road), entry_of(speed / 3.6)) <= 0.0:
            passed = speed
        elif passed is not None:
            if step == 1.0:
                break
            step, speed = 1.0, passed
        speed += step
    return passed
