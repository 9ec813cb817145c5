"""A ride of the quarter car over a random road, and its figures of road holding."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from twintube.common.arrays import Array, freeze_arrays
from twintube.dampers import Damper
from twintube.vehicle import road
from twintube.vehicle.drive import Drive, drive
from twintube.vehicle.quarter_car import Car, static_load

DT = 1e-3  # [s]
SETTLED = 5.0  # [s] not included in figures of the whole ride: the road fades in
FADE = 1.0  # [s] in which the road fades in
WINDOW = 10.0  # [s]
FAILED = 0.5  # of the intact damper's power in the same window


@dataclass(frozen=True)
class Track:
    """Road input of a wheel: heights [m] and their rates [m/s], arrays (n,) with the time step `dt` [s]."""

    speed_kmh: float
    dt: float
    heights: Array
    rates: Array

    def __post_init__(self) -> None:
        """Shared by all who read it."""
        freeze_arrays(self)


def track(speed_kmh: float, seconds: float, *, road_class: str = "D", seed: int = 1, dt: float = DT) -> Track:
    """The road input from the start of a road, equal for longer or faster rides. It begins at 0 and fades in."""
    speed = speed_kmh / 3.6
    time = np.arange(round(seconds / dt) + 2) * dt  # a sample beyond the end for its rate
    ground = road.generate(time[-1] * speed + 1.0, road_class=road_class, seed=seed).at(time * speed)
    heights = (ground - ground[0]) * np.clip(time / FADE, 0.0, 1.0)
    rates = np.zeros(len(heights) - 1)
    rates[1:] = 0.5 * (heights[2:] - heights[:-2]) / dt
    return Track(speed_kmh, dt, heights[:-1], rates)


def ride(damper: Damper, car: Car, route: Track) -> Drive:
    """Drive over a track after the paper's preconditioning; raises InputError if the piston would leave the tube."""
    return drive(damper, car, route.heights, route.dt, rates=route.rates, preconditioned=True)


def windows(time: Array) -> list[slice]:
    """The samples of every whole window of WINDOW seconds."""
    dt = float(time[1] - time[0])
    samples = round(WINDOW / dt)
    return [slice(i * samples, (i + 1) * samples) for i in range(round(time[-1] / dt) // samples)]


def dynamic_load_coefficient(load: Array, static: float) -> float:
    """Standard deviation of the wheel load over the static load [1]."""
    return float(np.std(load) / static)


def window_work(time: Array, work: Array) -> Array:
    """Work [J] of the damper in each window; `work` (n,) is cumulative since the start."""
    return np.array([work[min(w.stop, len(work) - 1)] - work[w.start] for w in windows(time)])


def time_to_failure(time: Array, work: Array, intact_work: Array) -> float | None:
    """Start [s] of the first window in which the damper does less than FAILED of the intact damper's work, else None."""
    share = window_work(time, work) / window_work(time, intact_work)
    failed = np.flatnonzero(share < FAILED)
    return float(failed[0] * WINDOW) if len(failed) else None


def measures(run: Drive, car: Car, intact: Drive | None = None) -> dict[str, Any]:
    """The figures of a ride for JSON: loads [N], work [J], times [s], coefficients and shares [1].

    With `intact`, the ride of the intact damper over the same track, also `time_to_failure_s` and `damping_work_share`.
    """
    static = static_load(car)
    load = run.wheel_load[run.time >= SETTLED]
    no_contact = load <= 0.0
    figures: dict[str, Any] = {
        "dlc": dynamic_load_coefficient(load, static),
        "dlc_window": [dynamic_load_coefficient(run.wheel_load[w], static) for w in windows(run.time)],
        "wheel_load_rms_N": float(np.sqrt(np.mean((load - static) ** 2))),
        "min_wheel_load_N": float(load.min()),
        "contact_loss_share": float(no_contact.mean()),
        "contact_losses": int(np.count_nonzero(no_contact[1:] & ~no_contact[:-1])),
        "largest_stroke_mm": float(np.abs(run.stroke).max() * 1e3),
        "damping_work_J": float(run.work[-1]),
        "damping_work_window_J": window_work(run.time, run.work).tolist(),
        "oil_mL_window_end": [float(run.oil[w.stop - 1] * 1e6) for w in windows(run.time)],
    }
    if intact is not None:
        figures["damping_work_share"] = float(run.work[-1] / intact.work[-1])
        figures["time_to_failure_s"] = time_to_failure(run.time, run.work, intact.work)
    return figures
