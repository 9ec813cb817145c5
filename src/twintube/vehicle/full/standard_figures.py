"""Figures of the standards' manoeuvres, as the standards name them."""

from typing import Any

import numpy as np

from twintube.common.arrays import Array
from twintube.vehicle.full.figures import LINEAR, STANDING, loads, smoothed
from twintube.vehicle.full.lane_change import entry_of, excess, highest_entry
from twintube.vehicle.full.maneuvers import APPROACH, Road
from twintube.vehicle.full.run import CarRun, FullCar
from twintube.vehicle.full.standards import RADIUS, SINE_AMPLITUDE, SINE_SECONDS, TURN_APPROACH, sine_with_dwell
from twintube.vehicle.quarter_car import GRAVITY

STEADY = 2.0  # [s] at the end of a step over which the steady values are averaged
SHARE = 0.9  # of the steady value, at which the response time ends; it begins at half of the steer angle
AFTER_STEER = (1.0, 1.75)  # [s] after the steering is completed, FMVSS 126 S5.2.1 and S5.2.2
RATIOS = (0.35, 0.20)  # the largest that pass
LEAST_DISPLACED = 1.83  # [m] from SINE_AMPLITUDE on
AMPLITUDES = tuple(
    np.arange(1.5, 6.51, 0.5).tolist()
)  # [A], S7.9.2 to S7.9.4; the 270 degrees of S7.9.4 need a steering ratio
DISPLACED = 1.07  # [s] after the steering begins, S5.2.3
MOVING = 3.0  # [m/s] below which the slip angle loses its sense and a turn is no longer judged
RISING = 0.2  # [s] over which a turn's yaw rate is averaged: an uneven road's shocks are not the turn's


def side_slip(run: CarRun) -> Array:
    """Side slip angle (n,) [rad] of the body's centre of gravity; NaN where the car hardly moves."""
    moves = np.hypot(run.v_x, run.v_y) > MOVING
    return np.where(moves, np.arctan2(run.v_y, run.v_x), np.nan)


def peak(values: Array) -> float:
    """Largest amount in degrees, of the values that are there."""
    return float(np.degrees(np.nanmax(np.abs(values))))


def step_figures(car: FullCar, run: CarRun) -> dict[str, Any]:
    """ISO 7401, step input: response times [s], overshoots, yaw rate gain [1/s], steady and largest values."""
    begin = int(np.searchsorted(run.time, APPROACH))
    late = run.time > run.time[-1] - STEADY
    half = run.time[np.argmax(run.steer >= 0.5 * run.steer[-1])]
    figures: dict[str, Any] = {}
    for name, values in (("yaw_rate", run.yaw_rate), ("lateral_acceleration", run.a_y), ("roll", run.roll)):
        steady, after = float(values[late].mean()), values[begin:]
        figures[f"{name}_t90_s"] = float(run.time[begin + int(np.argmax(after >= SHARE * steady))] - half)
        figures[f"{name}_peak_ratio"] = float(after.max() / steady)
        figures[f"{name}_peak_time_s"] = float(run.time[begin + int(np.argmax(after))] - half)
    gain = run.yaw_rate[late].mean() / run.steer[-1]
    return figures | {
        "yaw_rate_gain_1_s": float(gain),
        "steady_lateral_acceleration_m_s2": float(run.a_y[late].mean()),
        "side_slip_max_deg": peak(side_slip(run)[begin:]),
        "roll_max_deg": peak(run.roll[begin:]),
        **loads(car, run.load[begin:]),
    }


def sine_figures(car: FullCar, run: CarRun, speed_kmh: float, road: Road) -> dict[str, Any]:
    """FMVSS 126: the largest amplitude passed [A]; of the given one `sine_response`, side slip and roll [deg]."""
    begin = int(np.searchsorted(run.time, APPROACH))
    return sine_response(run) | {
        "amplitude_passed_A": largest_passed(car, speed_kmh, road),
        "yaw_rate_max_deg_s": peak(run.yaw_rate[begin:]),
        "side_slip_max_deg": peak(side_slip(run)[begin:]),
        "roll_max_deg": peak(run.roll[begin:]),
        **loads(car, run.load[begin:]),
    }


def largest_passed(car: FullCar, speed_kmh: float, road: Road) -> float | None:
    """Largest amplitude [A] that passes, as all smaller ones do; None if none does."""
    passed = None
    for amplitude in AMPLITUDES:
        response = sine_response(sine_with_dwell(car, speed_kmh, road, amplitude))
        stable = all(response[f"yaw_ratio_{after:g}_s"] <= most for after, most in zip(AFTER_STEER, RATIOS, strict=True))
        if not stable or (amplitude >= SINE_AMPLITUDE and response["displacement_1.07_s_m"] < LEAST_DISPLACED):
            break
        passed = amplitude
    return passed


def sine_response(run: CarRun) -> dict[str, float]:
    """Yaw rate after the steering over its second peak, and the lateral displacement [m]."""
    dt = float(run.time[1] - run.time[0])
    begin, end = (int(np.searchsorted(run.time, t)) for t in (APPROACH, APPROACH + SINE_SECONDS))
    back = begin + int(np.argmax(run.steer[begin:end] < 0.0))
    second = float(-run.yaw_rate[back:end].min())
    at = begin + round(DISPLACED / dt)
    dx, dy = run.x[at] - run.x[begin], run.y[at] - run.y[begin]
    after = {f"yaw_ratio_{seconds:g}_s": float(-run.yaw_rate[end + round(seconds / dt)] / second) for seconds in AFTER_STEER}
    return after | {"displacement_1.07_s_m": float(np.cos(run.yaw[begin]) * dy - np.sin(run.yaw[begin]) * dx)}


def lane_figures(car: FullCar, run: CarRun, speed_kmh: float, road: Road) -> dict[str, Any]:
    """ISO 3888-2: highest entry speed passed [km/h]; at the given one how far out of the lanes [m], steering, side slip."""
    entry = entry_of(speed_kmh / 3.6)
    on = run.x > entry - car.body.x_front
    rate = np.gradient(run.steer, run.time)[on]
    return {
        "entry_speed_max_kmh": highest_entry(car, road),
        "out_of_lane_m": excess(car, run, entry),
        "steer_rate_rms_deg_s": float(np.degrees(np.sqrt(np.mean(rate**2)))),
        "steer_max_deg": peak(run.steer[on]),
        "exit_speed_kmh": float(3.6 * run.v_x[-1]),
        "side_slip_max_deg": peak(side_slip(run)[on]),
        "roll_max_deg": peak(run.roll[on]),
        **loads(car, run.load[on]),
    }


def circle_figures(car: FullCar, run: CarRun) -> dict[str, Any]:
    """ISO 4138: gradients of steer, roll and side slip angle [deg/g], and the largest lateral acceleration [m/s2]."""
    lateral = smoothed(run.a_y, run.time)
    on = (run.time > TURN_APPROACH) & (run.a_y > LINEAR[0]) & (run.a_y < LINEAR[1])
    g = run.a_y[on] / GRAVITY
    # The circle driven is within half a metre of the given one; its own radius counts.
    ackermann = car.body.wheelbase * run.yaw_rate / np.maximum(run.v_x, 1.0)

    def gradient(angle: Array) -> float:
        return float(np.degrees(np.polyfit(g, angle[on], 1)[0]))

    return {
        "understeer_deg_per_g": gradient(run.steer - ackermann),
        "roll_deg_per_g": gradient(run.roll),
        "side_slip_deg_per_g": gradient(side_slip(run)),
        "lateral_acceleration_max_m_s2": float(lateral.max()),
        **loads(car, run.load[on]),
    }


def turn_figures(car: FullCar, run: CarRun) -> dict[str, Any]:
    """ISO 7975: yaw rate over that of the circle at the speed of the moment, side slip, path and stopping distance."""
    begin = int(np.searchsorted(run.time, TURN_APPROACH))
    standing = np.flatnonzero(run.v_x[begin:] < STANDING)
    end = begin + int(standing[0]) if len(standing) else len(run.time) - 1
    judged = slice(begin, begin + int(np.argmax(run.v_x[begin:] < MOVING)) if len(standing) else end)
    yaw_rate = smoothed(run.yaw_rate, run.time, RISING)[judged]
    ratio = yaw_rate * RADIUS / run.v_x[judged]
    slip = side_slip(run)[judged]
    steps = np.hypot(np.diff(run.x[begin : end + 1]), np.diff(run.y[begin : end + 1]))
    # The circle's middle lies across the direction of travel at the brakes' application.
    course = run.yaw[begin] + np.arctan2(run.v_y[begin], run.v_x[begin])
    middle = run.x[begin] - RADIUS * np.sin(course), run.y[begin] + RADIUS * np.cos(course)
    off = np.hypot(run.x[begin:end] - middle[0], run.y[begin:end] - middle[1]) - RADIUS
    first = min(round(1.0 / float(run.time[1])), len(slip) - 1)
    return {
        "yaw_ratio_braked": float(ratio[first]),
        "yaw_rate_max_deg_s": peak(yaw_rate),
        "side_slip_change_deg": peak(slip - slip[0]),
        "off_circle_m": float(off[np.argmax(np.abs(off))]),
        "stopping_distance_m": float(steps.sum()) if len(standing) else None,
        "deceleration_m_s2": float(run.v_x[begin] ** 2 / (2.0 * steps.sum())) if len(standing) else None,
        "roll_max_deg": peak(run.roll[begin:end]),
        **loads(car, run.load[begin:end]),
    }
