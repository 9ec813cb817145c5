"""The quarter car with the damper of this process, for strokes as a drive makes them."""

from dataclasses import dataclass

import numpy as np

from twintube import compiled, quarter_car
from twintube.arrays import Array
from twintube.checks import stroke_limit
from twintube.parameters import Damper
from twintube.simulate import InputError, at_rest, rows
from twintube.variables import blank


@dataclass(frozen=True)
class Drive:
    """What the damper and the road got; arrays (n,), one value per step."""

    time: Array  # [s]
    stroke: Array  # [m]
    velocity: Array  # [m/s]
    force: Array  # [N] of the damper
    wheel_load: Array  # [N]


CORNERS = {"front": quarter_car.PASSAT_FRONT, "rear": quarter_car.PASSAT_REAR}


def axle(damper: Damper) -> str:
    """`front` where the damper's title says so, else `rear`."""
    return "front" if "front" in damper.title.lower() else "rear"


def drive(damper: Damper, car: dict[str, float], heights: Array, dt: float, push: Array | None = None) -> Drive:
    """Drive over the road `heights` [m] (n,), one every `dt` [s], with the damper coupled in every step.

    `push` [N] (n,) presses the body down, as braking does at the front. `car` holds the values of `quarter_car.Car`
    but for the damper's force at rest. Raises InputError where the piston would leave the tube.
    """
    records = at_rest(damper, 0.0)
    corner = quarter_car.Car(**car, F_rest=-damper.parameters.F_0)
    limit = stroke_limit(records[1])
    if push is None:
        push = np.zeros(len(heights))
    out = np.empty((len(heights), 4))
    done: int = compiled.module().run_drive(
        *rows([*records, corner, blank(quarter_car.Motion)]), heights, push, dt, limit, out
    )
    if done < len(heights):
        raise InputError(f"time {done * dt:g} s: stroke must be from {-limit:g} to {limit:g} m")
    return Drive(np.arange(len(heights)) * dt, *out.T)
