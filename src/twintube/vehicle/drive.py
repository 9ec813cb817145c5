"""The quarter car with the compiled damper, coupled in every step."""

from dataclasses import dataclass

import numpy as np

from twintube.common.arrays import Array, freeze_arrays
from twintube.core.frame import stroke_limit
from twintube.core.variables import blank
from twintube.dampers import Damper
from twintube.engine import compiled
from twintube.engine.simulate import InputError, at_rest, rows
from twintube.rig.signals import AMPLITUDE, PRECONDITIONING, V_PRECONDITIONING, oscillations
from twintube.vehicle.quarter_car import Car, Motion


@dataclass(frozen=True)
class Drive:
    """Results of a drive; arrays (n,), one value per step."""

    time: Array  # [s]
    stroke: Array  # [m] of the damper
    velocity: Array  # [m/s] of the damper
    force: Array  # [N] of the damper
    wheel_load: Array  # [N]
    work: Array  # [J] dissipated by the damper since the start
    oil: Array  # [m3] of oil in the damper, including that in the foam

    def __post_init__(self) -> None:
        """Shared by all who read it."""
        freeze_arrays(self)


CONDITIONING_STEP = 5e-3  # [s]


def conditioning() -> Array:
    """Strokes [m] of the paper's preconditioning, one every CONDITIONING_STEP; the last one is 0."""
    return oscillations(V_PRECONDITIONING, AMPLITUDE, PRECONDITIONING, CONDITIONING_STEP)[1]


def slopes(heights: Array, dt: float) -> Array:
    """Rates [m/s] of heights [m] (n,) with the time step `dt` [s]: central differences, 0 at both ends."""
    rates = np.zeros(len(heights))
    rates[1:-1] = 0.5 * (heights[2:] - heights[:-2]) / dt
    return rates


def drive(
    damper: Damper,
    car: Car,
    heights: Array,
    dt: float,
    *,
    push: Array | None = None,
    rates: Array | None = None,
    preconditioned: bool = False,
) -> Drive:
    """Drive over the road `heights` [m] (n,) with the time step `dt` [s] and the `rates` [m/s], with the damper in the loop.

    `push` [N] (n,) presses the body down, as braking does at the front. `preconditioned` applies the paper's
    preconditioning first, six oscillations at 0.05 m/s. Raises InputError if the piston would leave the tube.
    """
    p, d, s, f = rows(at_rest(damper, 0.0))
    limit = stroke_limit(at_rest(damper, 0.0)[1])
    module = compiled.module()
    if preconditioned:
        # An FMU computes its outputs in a first step of length 0.
        module.run_held(p, d, s, f, np.zeros(2), 0.0)
        module.run_held(p, d, s, f, conditioning(), CONDITIONING_STEP)
    if push is None:
        push = np.zeros(len(heights))
    if rates is None:
        rates = slopes(heights, dt)
    out = np.empty((len(heights), 6))
    inputs = [np.ascontiguousarray(values, dtype=float) for values in (heights, rates, push)]
    steps: int = module.run_drive(p, d, s, f, *rows([car, blank(Motion)]), *inputs, dt, limit, out)
    if steps < len(heights):
        stroke = float(out[steps, 0] + out[steps, 1] * dt)
        raise InputError(
            f"{damper.name}, time {steps * dt:g} s: stroke = {stroke:.4g} m: must be from {-limit:g} to {limit:g} m"
        )
    return Drive(np.arange(len(heights)) * dt, *np.ascontiguousarray(out.T))
