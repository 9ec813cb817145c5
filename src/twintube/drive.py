"""The quarter car with the damper of this process, for strokes as a drive makes them."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from twintube import compiled, kernel, quarter_car
from twintube.arrays import Array
from twintube.checks import stroke_limit
from twintube.parameters import Damper
from twintube.simulate import InputError
from twintube.variables import Derived, Flow, State, blank


@dataclass(frozen=True)
class Drive:
    """What the damper and the road got; arrays (n,), one value per step."""

    time: Array  # [s]
    stroke: Array  # [m]
    velocity: Array  # [m/s]
    force: Array  # [N] of the damper
    wheel_load: Array  # [N]


def drive(damper: Damper, car: dict[str, float], heights: Array, dt: float) -> Drive:
    """Drive over the road `heights` [m] (n,), one every `dt` [s], with the damper coupled in every step.

    `car` holds the values of `quarter_car.Car` but for the damper's force at rest. Raises InputError where the piston
    would leave the tube.
    """
    p = damper.parameters
    d, s, f = blank(Derived), blank(State), blank(Flow)
    kernel.prepare(p, d)
    kernel.fill(p, d, s, 0.0)
    corner = quarter_car.Car(**car, F_rest=-p.F_0)
    records: list[Any] = [compiled.as_row(x)[0] for x in (p, d, s, f, corner, blank(quarter_car.Motion))]
    out = np.empty((len(heights), 4))
    done: int = compiled.module().run_drive(*records, heights, dt, stroke_limit(d), out)
    if done < len(heights):
        raise InputError(f"time {done * dt:g} s: stroke must be from {-stroke_limit(d):g} to {stroke_limit(d):g} m")
    return Drive(np.arange(len(heights)) * dt, *out.T)
