"""One ride with the damper FMU: the quarter car over a road, the FMU in the loop in every step.

Leapfrog: heights at whole steps, velocities at half steps. The FMU receives the damper stroke at the start of a step and
the mean velocity within the step, so that FMU and car move by exactly the same stroke. The force of the FMU belongs to the
middle of a step and is extrapolated linearly to the start of the next one.
"""

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np

from twintube.common.arrays import Array
from twintube.core.variables import blank
from twintube.demo.damper_fmu import VOLUMES, DamperFmu
from twintube.vehicle.drive import CONDITIONING_STEP, Drive, conditioning
from twintube.vehicle.quarter_car import Car, Motion, damper_stroke, damper_velocity, leapfrog_step
from twintube.vehicle.ride import Track

EVERY = 20  # steps between two records of work and volumes


@dataclass(frozen=True)
class RideCase:
    """One ride: speed and state of the damper; `off` names FMU parameters to set to 0 (strengths of effects)."""

    speed_kmh: float
    oil_level: float
    gas_preload: float
    off: tuple[str, ...] = ()


@dataclass(frozen=True)
class Ride(Drive):
    """Results of a ride; `volumes` (n / EVERY, 9) [m3] in the order of VOLUMES; work and oil change every EVERY steps."""

    case: RideCase
    volumes: Array


def precondition(damper: DamperFmu) -> None:
    """The paper's six oscillations at 0.05 m/s; the damper ends at stroke 0."""
    for z, following in pairwise(conditioning().tolist()):
        damper.step(z, (following - z) / CONDITIONING_STEP, CONDITIONING_STEP)
    damper.messages.clear()  # of these long steps: the motion is given, no wheel answers


def interpolated(values: Array, n: int) -> Array:
    """Values recorded every EVERY steps, interpolated linearly to each of `n` steps."""
    return np.interp(np.arange(n), np.arange(len(values)) * EVERY, values)


def ride(fmu: Path, car: Car, case: RideCase, route: Track) -> Ride:
    """Drive over a track; raises FmuError if the FMU refuses a step."""
    n, dt = len(route.heights), route.dt
    stroke, velocity, force, load = (np.empty(n) for _ in range(4))
    work, volumes = np.empty(len(range(0, n, EVERY))), np.empty((len(range(0, n, EVERY)), len(VOLUMES)))
    start = {"oil_level": case.oil_level, "gas_preload": case.gas_preload} | dict.fromkeys(case.off, 0.0)
    with DamperFmu(fmu, **start) as damper:
        precondition(damper)
        started = damper.outputs()["work"]
        m = blank(Motion)
        current = damper.outputs()["force"]
        earlier = current
        for i, (height, rate) in enumerate(zip(route.heights.tolist(), route.rates.tolist(), strict=True)):
            if i % EVERY == 0:
                work[i // EVERY] = damper.outputs()["work"] - started
                volumes[i // EVERY] = damper.volumes()
            z = damper_stroke(car, m)
            load[i] = leapfrog_step(car, m, height, rate, 1.5 * current - 0.5 * earlier, 0.0, dt)
            v = damper_velocity(car, m)
            stroke[i], velocity[i], force[i] = z, v, current
            earlier = current
            current = damper.step(z, v, dt)
    oil = volumes[:, [0, 3, 6]].sum(axis=1)
    return Ride(np.arange(n) * dt, stroke, velocity, force, load, interpolated(work, n), interpolated(oil, n), case, volumes)
