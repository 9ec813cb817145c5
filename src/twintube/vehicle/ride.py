"""A ride of the quarter car over a random road, and what it says about road holding."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from twintube.arrays import Array
from twintube.dampers import Damper
from twintube.vehicle import road
from twintube.vehicle.drive import Drive, drive
from twintube.vehicle.quarter_car import Car, static_load

DT = 1e-3  # [s]
SETTLED = 5.0  # [s] left out of figures of the whole ride: the road fades in
FADE = 1.0  # [s] over which the road begins
WINDOW = 10.0  # [s]
FAILED = 0.5  # of the intact damper's power in the same window


@dataclass(frozen=True)
class Track:
    """A road as a wheel meets it: heights [m] and their rates [m/s], arrays (n,), one value every `dt` [s]."""

    speed_kmh: float
    dt: float
    heights: Array
    rates: Array


def track(speed_kmh: float, seconds: float, *, road_class: str = "D", seed: int = 1, dt: float = DT) -> Track:
    """The first metres of a road; a longer or faster ride sees the same. It begins at 0 and fades in."""
    speed = speed_kmh / 3.6
    time = np.arange(round(seconds / dt) + 2) * dt  # a sample beyond the end for its rate
    profile = road.generate(time[-1] * speed + 1.0, road_class=road_class, seed=seed).at(time * speed)
    heights = (profile - profile[0]) * np.clip(time / FADE, 0.0, 1.0)
    rates = np.zeros(len(heights) - 1)
    rates[1:] = 0.5 * (heights[2:] - heights[:-2]) / dt
    return Track(speed_kmh, dt, heights[:-1], rates)


def ride(damper: Damper, car: Car, on: Track) -> Drive:
    """Drive over a track after the paper's preconditioning; raises InputError where the piston would leave the tube."""
    return drive(damper, car, on.heights, on.dt, rates=on.rates, preconditioned=True)


def windows(time: Array) -> list[slice]:
    """The samples of every whole window of WINDOW seconds."""
    dt = float(time[1] - time[0])
    per = round(WINDOW / dt)
    return [slice(i * per, (i + 1) * per) for i in range(round(time[-1] / dt) // per)]


def dynamic_load_coefficient(load: Array, static: float) -> float:
    """Standard deviation of the wheel load over the static load [1]."""
    return float(np.std(load) / static)


def window_work(time: Array, work: Array) -> Array:
    """Work [J] of the damper in each window; `work` (n,) is that since the start."""
    return np.array([work[min(w.stop, len(work) - 1)] - work[w.start] for w in windows(time)])


def time_to_failure(time: Array, work: Array, intact_work: Array) -> float | None:
    """Start [s] of the first window in which the damper does less than FAILED of the intact one's work, else None."""
    share = window_work(time, work) / window_work(time, intact_work)
    failed = np.flatnonzero(share < FAILED)
    return float(failed[0] * WINDOW) if len(failed) else None


def measures(run: Drive, car: Car, intact: Drive | None = None) -> dict[str, Any]:
    """The figures of a ride, JSON ready: loads [N], work [J], times [s], coefficients and shares [1].

    With the ride of the intact damper over the same track also `time_to_failure_s` and `damping_work_share`.
    """
    static = static_load(car)
    load = run.wheel_load[run.time >= SETTLED]
    lost = load <= 0.0
    found: dict[str, Any] = {
        "dlc": dynamic_load_coefficient(load, static),
        "dlc_window": [dynamic_load_coefficient(run.wheel_load[w], static) for w in windows(run.time)],
        "wheel_load_rms_N": float(np.sqrt(np.mean((load - static) ** 2))),
        "min_wheel_load_N": float(load.min()),
        "contact_loss_share": float(lost.mean()),
        "contact_losses": int(np.count_nonzero(lost[1:] & ~lost[:-1])),
        "largest_stroke_mm": float(np.abs(run.stroke).max() * 1e3),
        "damping_work_J": float(run.work[-1]),
        "damping_work_window_J": window_work(run.time, run.work).tolist(),
        "oil_mL_window_end": [float(run.oil[w.stop - 1] * 1e6) for w in windows(run.time)],
    }
    if intact is not None:
        found["damping_work_share"] = float(run.work[-1] / intact.work[-1])
        found["time_to_failure_s"] = time_to_failure(run.time, run.work, intact.work)
    return found
