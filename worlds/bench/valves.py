"""What a parameter set says about the valves, and where a motion turns."""

import numpy as np

from twintube.common.arrays import Array
from twintube.dampers import Damper


def curve(damper: Damper, velocity: Array) -> Array:
    """The F-v curve's force [N] at velocities [m/s] (n,), the last segments going on."""
    p = damper.parameters
    speed, sides = np.abs(velocity), []
    for velocities, forces in ((p.v_re, p.F_re), (p.v_co, p.F_co)):
        v, F = np.unique([0.0, *velocities]), np.append(0.0, [f for u, f in zip(velocities, forces, strict=True) if u > 0.0])
        slope = (F[-1] - F[-2]) / (v[-1] - v[-2])
        sides.append(np.interp(speed, v, F) + slope * np.maximum(speed - v[-1], 0.0))
    return np.asarray(np.where(velocity >= 0.0, sides[0], -sides[1]))


def since_reversal(stroke: Array, velocity: Array) -> Array:
    """Stroke (n,) [m] since the last change of direction."""
    way = np.append(0.0, np.cumsum(np.abs(np.diff(stroke))))
    side = np.sign(velocity)
    turn = np.append(True, (side[1:] != side[:-1]) & (side[1:] != 0))
    return np.asarray(way - way[np.maximum.accumulate(np.where(turn, np.arange(len(way)), 0))])
