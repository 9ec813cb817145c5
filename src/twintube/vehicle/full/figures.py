"""Figures of drives of the whole car."""

from typing import Any

import numpy as np
from scipy import signal

from twintube.common.arrays import Array
from twintube.vehicle.full.car import WHEELS
from twintube.vehicle.full.maneuvers import APPROACH
from twintube.vehicle.full.run import CarRun, FullCar

SETTLED = 5.0  # [s] of a ride not included
STANDING = 0.2  # [m/s] below which the car stands
LINEAR = (1.0, 4.0)  # [m/s2] lateral accelerations of the understeer gradient
SMOOTHING = 4.0  # [s] over which the lateral acceleration is averaged
# ISO 2631-1:1997, weighting W_k: band limits, acceleration-velocity transition, upward step [Hz] and their qualities.
W_K = {"f1": 0.4, "q1": 0.5**0.5, "f2": 100.0, "q2": 0.5**0.5, "f3": 12.5, "f4": 12.5, "q4": 0.63,
       "f5": 2.37, "q5": 0.91, "f6": 3.35, "q6": 0.91}  # fmt: skip


def comfort_filter(dt: float) -> Array:
    """Second-order sections of W_k for the time step `dt` [s], ISO 2631-1:1997 Annex A."""
    w = {name: 2 * np.pi * value for name, value in W_K.items() if name[0] == "f"}
    sections = [
        ([1.0, 0.0, 0.0], [1.0, w["f1"] / W_K["q1"], w["f1"] ** 2]),
        ([w["f2"] ** 2], [1.0, w["f2"] / W_K["q2"], w["f2"] ** 2]),
        ([w["f4"] ** 2 / w["f3"], w["f4"] ** 2], [1.0, w["f4"] / W_K["q4"], w["f4"] ** 2]),
        (np.array([1.0, w["f5"] / W_K["q5"], w["f5"] ** 2]), [1.0, w["f6"] / W_K["q6"], w["f6"] ** 2]),
    ]
    rows = [signal.tf2sos(*signal.bilinear(b, a, 1 / dt)) for b, a in sections]
    return np.vstack(rows)


def comfort(acceleration: Array, dt: float, settled: float = SETTLED) -> float:
    """Weighted vertical acceleration [m/s2], root mean square after `settled` [s]."""
    weighted = signal.sosfilt(comfort_filter(dt), acceleration)
    return float(np.sqrt(np.mean(weighted[round(settled / dt) :] ** 2)))


def by_wheel(values: Array) -> dict[str, float]:
    """Values (4,) by the wheels' names."""
    return {name: float(value) for name, value in zip(WHEELS, values, strict=True)}


def loads(car: FullCar, load: Array) -> dict[str, Any]:
    """Dynamic load coefficient, smallest load over the load at rest and share of the time without contact, per wheel."""
    rest = np.array([wheel.weight for wheel in car.wheels])
    return {
        "dlc": by_wheel(load.std(axis=0) / rest),
        "min_load_share": by_wheel(load.min(axis=0) / rest),
        "contact_loss_share": by_wheel((load <= 0.0).mean(axis=0)),
    }


def ride_figures(car: FullCar, run: CarRun, settled: float = SETTLED) -> dict[str, Any]:
    """Of a ride, after `settled` [s]: loads, comfort [m/s2], angles [deg], work of the dampers [J]."""
    dt = float(run.time[1] - run.time[0])
    on = run.time >= settled
    return {
        **loads(car, run.load[on]),
        "comfort_m_s2": comfort(run.a_z, dt, settled),
        "roll_rms_deg": float(np.degrees(run.roll[on].std())),
        "pitch_rms_deg": float(np.degrees(run.pitch[on].std())),
        "damping_work_J": by_wheel(run.damper_work[-1] - run.damper_work[on][0]),
    }


def swerve(run: CarRun, begin: int, end: int) -> dict[str, float]:
    """Where a straight drive goes from sample `begin` to `end`: largest yaw rate [deg/s], heading [deg] and side offset [m].

    Heading and offset, to the left positive, are those against the direction of travel at `begin`; amounts end with `max`.
    """
    on = slice(begin, end + 1)
    aside = (run.y[on] - run.y[begin]) * np.cos(run.yaw[begin]) - (run.x[on] - run.x[begin]) * np.sin(run.yaw[begin])
    heading, offset = float(np.degrees(largest(run.yaw[on] - run.yaw[begin]))), largest(aside)
    return {
        "yaw_rate_max_deg_s": float(np.degrees(np.abs(run.yaw_rate[on]).max())),
        "heading_deg": heading,
        "heading_max_deg": abs(heading),
        "side_offset_m": offset,
        "side_offset_max_m": abs(offset),
    }


def largest(values: Array) -> float:
    """The value of largest amount, with its sign."""
    return float(values[np.argmax(np.abs(values))])


def braking_figures(car: FullCar, run: CarRun) -> dict[str, Any]:
    """Of a stop: distance [m] from the brakes' application to standstill, deceleration [m/s2], loads, work [J]."""
    begin = int(np.searchsorted(run.time, APPROACH))
    standing = np.flatnonzero(run.v_x[begin:] < STANDING)
    end = begin + int(standing[0]) if len(standing) else len(run.time) - 1
    distance = float(np.hypot(run.x[end] - run.x[begin], run.y[end] - run.y[begin]))
    return {
        "stopping_distance_m": distance if len(standing) else None,
        "deceleration_m_s2": float(run.v_x[begin] ** 2 / (2.0 * distance)) if len(standing) else None,
        "pitch_max_deg": float(np.degrees(run.pitch[begin:end].max())),
        **swerve(run, begin, end),
        "stopping_time_s": float(run.time[end] - run.time[begin]),
        **loads(car, run.load[begin:end]),
        "damping_work_J": by_wheel(run.damper_work[end] - run.damper_work[begin]),
    }


def smoothed(values: Array, time: Array, seconds: float = SMOOTHING) -> Array:
    """Running mean over some `seconds`, without the end where it would fall."""
    count = max(1, round(seconds / float(time[1] - time[0])))
    mean: Array = np.convolve(values, np.ones(count) / count, mode="same")[:-count]
    return mean


def cornering_figures(car: FullCar, run: CarRun) -> dict[str, Any]:
    """Of growing steering: largest lateral acceleration [m/s2], gradients of steer and roll angle [deg/g], loads, work."""
    lateral = smoothed(run.a_y, run.time)
    most = int(np.argmax(lateral))
    # The averaged acceleration would bend where it grows from nothing within the time of averaging.
    linear = (run.a_y > LINEAR[0]) & (run.a_y < LINEAR[1]) & (np.arange(len(run.a_y)) < most)
    straight = np.degrees(run.steer - car.body.wheelbase * run.a_y / np.maximum(run.v_x, 1.0) ** 2)
    g = run.a_y[linear] / 9.80665
    on = (run.time > APPROACH) & (run.time <= run.time[most])
    return {
        "lateral_acceleration_max_m_s2": float(lateral[most]),
        "understeer_deg_per_g": float(np.polyfit(g, straight[linear], 1)[0]),
        "roll_deg_per_g": float(np.polyfit(g, np.degrees(run.roll[linear]), 1)[0]),
        "roll_max_deg": float(np.degrees(np.abs(run.roll[on]).max())),
        **loads(car, run.load[on]),
        "damping_work_J": by_wheel(run.damper_work[on][-1] - run.damper_work[on][0]),
    }
