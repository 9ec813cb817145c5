"""Manoeuvres of the standards: step steer, sine with dwell, obstacle avoidance, steady circle, braking in a turn.

Steer angles are those of the wheels. What the standards say stands here as far as it is known; "from memory" marks what
has not been seen in print. A circle and a lane change are driven by the driver of `steering.py`, all else open-loop.
"""

import numpy as np

from twintube.common.arrays import Array
from twintube.vehicle.full.maneuvers import APPROACH, PRESSURE, SMOOTH, STEER_RATE, Road, checked_speed
from twintube.vehicle.full.run import DT, CarRun, FullCar, Pursuit, drive_car
from twintube.vehicle.full.steering import PATH_SPACING
from twintube.vehicle.quarter_car import GRAVITY
from twintube.vehicle.road import SPACING

# ISO 7401, clause 10 (step input): 80 km/h and a steady 4 m/s2; the steer rises from 10 to 90 % within 0.15 s (from memory).
STEP_LATERAL, STEP_TIME, STEP_HELD = 4.0, 0.1, 5.0  # [m/s2], [s], [s]
# FMVSS 126 (49 CFR 571.126) S7.6, S7.9: A is the angle of 0.3 g at 80 km/h; a sine of 0.7 Hz with 500 ms at its second peak.
SINE_LATERAL, SINE_FREQUENCY, DWELL = 0.3 * GRAVITY, 0.7, 0.5
SINE_AMPLITUDE = 5.0  # times A; from there on S5.2.3 asks for a displacement
SINE_SECONDS = 1.0 / SINE_FREQUENCY + DWELL
AFTER = 3.0  # [s] driven after the steering
LINEAR = (0.1 * GRAVITY, 0.375 * GRAVITY)  # lateral accelerations of the straight line that gives A, S7.6.1
# ISO 4138 and ISO 7975: a radius of 100 m; the lateral acceleration of the circle grows by 0.1 m/s2 a second (from memory).
RADIUS = 100.0
GROWTH, FROM, UPTO = 0.1, 1.0, 11.0  # [m/s2/s], [m/s2]
LEAD_IN, TURN_IN = 1.0, 2.0  # [s] straight ahead and of growing curvature before a circle
TURN_APPROACH = LEAD_IN + TURN_IN + APPROACH  # [s] after which the brakes are applied in the turn


def straight_inputs(speed: float, seconds: float, dt: float) -> tuple[Array, Array]:
    """Time (n,) [s] and inputs (n, 3) of a drive at constant speed."""
    time = np.arange(round(seconds / dt)) * dt
    inputs = np.zeros((len(time), 3))
    inputs[:, 2] = speed
    return time, inputs


def steer_per_lateral(car: FullCar, speed: float) -> float:
    """Steer angle [rad] per lateral acceleration [m/s2] at a `speed` [m/s] on a smooth dry road, of a slowly growing angle.

    The slope only: the lateral acceleration lags behind the angle.
    """
    most = car.body.wheelbase * LINEAR[1] / speed**2 + 2.0 * car.wheels[0].steer_compliance * car.wheels[0].weight
    time, inputs = straight_inputs(speed, 1.0 + 2.0 * most / np.radians(STEER_RATE), DT)
    inputs[:, 0] = np.radians(STEER_RATE) * np.clip(time - 1.0, 0.0, None)
    run = drive_car(car, Road(SMOOTH).heights(car, 1.1 * speed * time[-1]), SPACING, inputs, speed)
    on = (run.a_y > LINEAR[0]) & (run.a_y < LINEAR[1])
    return float(np.polyfit(run.a_y[on], run.steer[on], 1)[0])


def step_steer(car: FullCar, speed_kmh: float, road: Road, dt: float = DT) -> CarRun:
    """ISO 7401: at constant speed, from APPROACH on a step to the left; raises InputError."""
    speed = checked_speed(speed_kmh)
    time, inputs = straight_inputs(speed, APPROACH + STEP_HELD, dt)
    inputs[:, 0] = STEP_LATERAL * steer_per_lateral(car, speed) * np.clip((time - APPROACH) / STEP_TIME, 0.0, 1.0)
    return drive_car(car, road.heights(car, 1.1 * speed * time[-1]), SPACING, inputs, speed, grips=road.grips, dt=dt)


def sine_with_dwell(car: FullCar, speed_kmh: float, road: Road, amplitude: float = SINE_AMPLITUDE, dt: float = DT) -> CarRun:
    """FMVSS 126: the car coasts from APPROACH on, steered left and then right by `amplitude` times A; raises InputError."""
    speed = checked_speed(speed_kmh)
    time, inputs = straight_inputs(speed, APPROACH + SINE_SECONDS + AFTER, dt)
    since, dwells = time - APPROACH, 0.75 / SINE_FREQUENCY
    phase = np.where(since < dwells, since, np.maximum(since - DWELL, dwells))
    on = (since >= 0.0) & (since < SINE_SECONDS)
    most = amplitude * SINE_LATERAL * steer_per_lateral(car, speed)
    inputs[:, 0] = most * on * np.sin(2.0 * np.pi * SINE_FREQUENCY * phase)
    inputs[:, 2] = speed * (since < 0.0)
    return drive_car(car, road.heights(car, 1.1 * speed * time[-1]), SPACING, inputs, speed, grips=road.grips, dt=dt)


def turn(curvature: Array) -> Array:
    """Points (m, 2) [m] of a path that begins along x, from its curvature (m,) [1/m] every PATH_SPACING."""
    yaw = PATH_SPACING * np.cumsum(curvature) - 0.5 * PATH_SPACING * curvature
    return PATH_SPACING * np.column_stack([np.cumsum(np.cos(yaw)), np.cumsum(np.sin(yaw))])


def circle_path(speed: float, length: float) -> Array:
    """A straight of LEAD_IN at a `speed` [m/s], TURN_IN of growing curvature, and the circle, `length` [m] in all."""
    way = np.arange(int(length / PATH_SPACING)) * PATH_SPACING
    return turn(np.clip((way / speed - LEAD_IN) / TURN_IN, 0.0, 1.0) / RADIUS)


def circle(car: FullCar, speed_kmh: float, road: Road, dt: float = DT) -> CarRun:
    """ISO 4138, constant radius: faster and faster up to `speed_kmh`, steered along the circle; raises InputError."""
    most = checked_speed(speed_kmh) ** 2 / RADIUS
    begin = np.sqrt(FROM * RADIUS)
    seconds = TURN_APPROACH + max(0.0, min(most, UPTO) - FROM) / GROWTH
    time = np.arange(round(seconds / dt)) * dt
    inputs = np.zeros((len(time), 3))
    inputs[:, 2] = np.sqrt(RADIUS * (FROM + GROWTH * np.clip(time - TURN_APPROACH, 0.0, None)))
    length = 1.1 * float(inputs[:, 2].sum()) * dt + 50.0
    pursuit = Pursuit(circle_path(begin, length))
    return drive_car(
        car, road.heights(car, length), SPACING, inputs, begin, grips=road.grips, pursuit=pursuit, dt=dt
    )  # fmt: skip


def braking_in_turn(car: FullCar, speed_kmh: float, road: Road, dt: float = DT) -> CarRun:
    """ISO 7975: from TURN_APPROACH on the steering is held and the car stopped as by `braking`; raises InputError."""
    speed = checked_speed(speed_kmh)
    slow = min(1.0, float(np.mean(road.grips)))
    seconds = TURN_APPROACH + 1.0 + speed / (3.0 * slow)
    time, inputs = straight_inputs(speed, seconds, dt)
    inputs[:, 1] = PRESSURE * (time >= TURN_APPROACH)
    inputs[:, 2] *= time < TURN_APPROACH
    length = 1.1 * speed * TURN_APPROACH + speed**2 / (4.0 * slow) + 50.0
    pursuit = Pursuit(circle_path(speed, length), until=TURN_APPROACH)
    return drive_car(
        car, road.heights(car, length), SPACING, inputs, speed, grips=road.grips, pursuit=pursuit, dt=dt
    )  # fmt: skip
