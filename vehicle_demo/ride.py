"""One ride: the quarter car over a road, the damper FMU in the loop in every step.

Leapfrog: heights at whole steps, velocities at half steps. The damper gets its stroke at the start of a step and the mean
velocity within it, so that FMU and car move by exactly the same stroke; its force, which belongs to the middle of a step, is
carried to the start of the next one by its last change.
"""

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np

from twintube import road
from twintube.arrays import Array
from twintube.quarter_car import Car, Motion, kick
from twintube.rig import AMPLITUDE, PRECONDITIONING, V_PRECONDITIONING, oscillations
from twintube.variables import blank
from vehicle_demo.damper_fmu import VOLUMES, DamperFmu

EVERY = 20  # steps between two records of the volumes


@dataclass(frozen=True)
class Case:
    """What is driven.

    `scalar` replaces the degradation model by the paper's variant 1, the oil level as a factor; `off` are parameters of the
    FMU that are set to 0: the strengths of effects, for the damper without them.
    """

    speed_kmh: float
    oil_level: float
    gas_preload: int
    scalar: bool = False
    off: tuple[str, ...] = ()


@dataclass(frozen=True)
class Ride:
    """Results of a case; arrays (n,), one value per step, volumes (n / EVERY, 9) in the order of VOLUMES."""

    case: Case
    time: Array  # [s]
    stroke: Array  # [m]
    velocity: Array  # [m/s]
    force: Array  # [N] of the damper
    wheel_load: Array  # [N]
    work: Array  # [J] dissipated by the damper since the start, at the times of the volumes
    volumes: Array  # [m3]


def heights(case: Case, seconds: float, dt: float, seed: int) -> Array:
    """Enveloped heights [m] of the class D road under the wheel, one every `dt` [s]; they begin at 0 and fade in."""
    speed = case.speed_kmh / 3.6
    time = np.arange(round(seconds / dt) + 1) * dt
    profile = road.generate(seconds * speed, seed=seed).at(time * speed)
    faded: Array = (profile - profile[0]) * np.clip(time, 0.0, 1.0)
    return faded


def precondition(damper: DamperFmu) -> None:
    """The paper's six oscillations at 0.05 m/s, in steps of 5 ms; the damper ends at stroke 0."""
    _, stroke, _ = oscillations(V_PRECONDITIONING, AMPLITUDE, PRECONDITIONING, 5e-3)
    for z, following in pairwise(stroke):
        damper.step(float(z), float(following - z) / 5e-3, 5e-3)


def ride(fmu: Path, car: Car, case: Case, height: Array, dt: float) -> Ride:
    """Drive over the road `height` [m] (n,), one value every `dt` [s]; raises FmuError where the FMU refuses a step."""
    n = len(height)
    stroke, velocity, force, load = (np.empty(n) for _ in range(4))
    work, volumes = np.empty(len(range(0, n, EVERY))), np.empty((len(range(0, n, EVERY)), len(VOLUMES)))
    level, preload = (1.0, 0) if case.scalar else (case.oil_level, case.gas_preload)
    with DamperFmu(fmu, oil_level=level, gas_preload=preload, **dict.fromkeys(case.off, 0.0)) as damper:
        precondition(damper)
        started = damper.outputs()["work"]
        m = blank(Motion)
        earlier = None
        rates = np.gradient(height, dt).tolist()
        now = damper.outputs()["force_gas"]
        for i, h in enumerate(height.tolist()):
            if i % EVERY == 0:
                work[i // EVERY] = damper.outputs()["work"] - started
                volumes[i // EVERY] = damper.volumes()
            carried = now if earlier is None else 1.5 * now - 0.5 * earlier
            z = m.z_body - m.z_wheel
            load[i] = kick(car, m, h, rates[i], carried, 0.0, dt)
            v = m.v_body - m.v_wheel
            stroke[i], velocity[i], force[i] = z, v, now
            earlier = now
            now = damper.step(z, v, dt)
            if case.scalar:
                part = damper.outputs()
                now = part["force_gas"] + part["force_friction"] + case.oil_level * part["force_fluid"]
    return Ride(case, np.arange(n) * dt, stroke, velocity, force, load, work, volumes)
