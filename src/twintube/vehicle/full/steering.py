"""A driver who steers along a path: by the curvature to come, and back to the path where he is off it.

Two levels as in Donges ("A two-level model of driver steering behavior", Human Factors 20, 1978, from memory): anticipation
takes the curvature some time ahead, compensation the circle that meets the path's tangent again after a preview. Wheelbase
and understeer of the steady car make an angle of a curvature. The arms lag and have a largest rate.
In the kernel's own subset of Python.
"""

import math
from dataclasses import dataclass

from twintube.common.arrays import Table
from twintube.core.variables import var
from twintube.vehicle.full.car import BodyMotion
from twintube.vehicle.quarter_car import GRAVITY

PATH_SPACING = 0.1  # [m] of a path's points
# A trained driver: with the line of `lane_change.py`, what left the intact Passat most room in its lanes from 44 to 68 km/h.
PREVIEW = 0.7  # [s] after which he means to be back on the path
LEAD = 0.17  # [s] by which he anticipates
LAG = 0.1  # [s] of the arms: assumed, 0.1 to 0.2
MOST_RATE = 1.1  # [rad/s] at the wheels: 1000 deg/s at a hand wheel of ratio 16, assumed
MOST_ANGLE = 0.6  # [rad] at the wheels, where the rack ends: assumed


@dataclass(slots=True)
class Pursuer:
    """The driver, and where he is on his path."""

    preview: float = var("driver", "", "s", "time after which he means to be back on the path", default=0.0)
    lead: float = var("driver", "", "s", "time by which he anticipates the curvature", default=0.0)
    lag: float = var("driver", "", "s", "time constant of his arms", default=0.0)
    most_rate: float = var("driver", "", "rad/s", "largest steer rate", default=0.0)
    most: float = var("driver", "", "rad", "largest steer angle", default=0.0)
    wheelbase: float = var("driver", "l", "m", "distance of the axles", default=0.0)
    understeer: float = var("driver", "", "rad", "steer angle that he adds per lateral acceleration of g", default=0.0)
    until: float = var("driver", "", "s", "time from which he holds the wheel still", default=0.0)
    at: float = var("driver", "", "1", "point of the path that is nearest", default=0.0)
    steer: float = var("driver", "", "rad", "his steer angle", default=0.0)


def off_path(b: BodyMotion, path: Table, j: int) -> float:
    """Square of the distance [m2] to a point of the path."""
    x, y = path[j, 0] - b.x, path[j, 1] - b.y
    squares: float = x * x + y * y
    return squares


def follow_path(q: Pursuer, b: BodyMotion, path: Table, time: float, dt: float) -> float:
    """The steer angle [rad] for the step of `dt` [s] at a `time` [s]; 0 without a path.

    `path` (m, 4) are places [m], direction [rad] and curvature [1/m], a point every PATH_SPACING.
    """
    last = len(path) - 1
    steer: float = q.steer
    if last < 0 or time >= q.until:
        return steer
    near = int(q.at)
    while near < last and off_path(b, path, near + 1) <= off_path(b, path, near):
        near += 1
    q.at = float(near)
    v_x, v_y = b.v_x + 0.5 * b.dv_x, b.v_y + 0.5 * b.dv_y
    speed = math.sqrt(v_x * v_x + v_y * v_y)
    to_come = min(last, near + int(speed * q.lead / PATH_SPACING))
    ahead = max(speed * q.preview, 1.0)
    # Off the path to the left, and away from its direction as he travels; the body's own differs by the side slip.
    off = math.cos(path[near, 2]) * (b.y - path[near, 1]) - math.sin(path[near, 2]) * (b.x - path[near, 0])
    away = b.yaw + math.atan2(v_y, max(v_x, 0.1)) - path[near, 2]
    curvature = path[to_come, 3] - 2.0 * (off + ahead * away) / (ahead * ahead)
    wanted = (q.wheelbase + q.understeer / GRAVITY * speed * speed) * curvature
    wanted = max(-q.most, min(q.most, wanted))
    rate = max(-q.most_rate, min(q.most_rate, (wanted - steer) / q.lag))
    steer += dt * rate
    q.steer = steer
    return steer
