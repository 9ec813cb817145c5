"""The loop over the whole car and its four dampers, in the kernel's subset of Python; compiled with the kernel."""

import math
from collections.abc import Sequence

from twintube.common.arrays import Table, Vector
from twintube.core.effects import Parameters, State
from twintube.core.frame import stroke_limit
from twintube.core.model import advance
from twintube.core.outputs import total_force
from twintube.core.variables import Derived, Flow
from twintube.vehicle.full.body import corner_stroke, corner_velocity
from twintube.vehicle.full.brakes import Brakes
from twintube.vehicle.full.car import Body, BodyMotion, Wheel, WheelMotion
from twintube.vehicle.full.driver import drive_step
from twintube.vehicle.full.steering import Pursuer, follow_path

# Columns of a step: the body's, then those of each wheel in turn.
BODY_COLUMNS = 16
WHEEL_COLUMNS = 12


def road_step(
    c: Body, b: BodyMotion, ks: Sequence[Wheel], ws: Sequence[WheelMotion], h: Brakes, road: Table, spacing: float,
    grips: Vector, steer: float, wanted: float, held: float, dt: float,
) -> bool:  # fmt: skip
    """One step of `dt` [s] of road, driver and car; false where the road ends.

    The dampers' forces stand in `ws`, which receives the strokes and velocities under which they do their step. `road`
    (2, m) [m] are the heights under left and right wheels every `spacing` [m], position 0 is at the rear axle at the start.
    `grips` (2,) are the factors of the tyre forces on either of them. `steer` [rad], brake pressure `wanted` [Pa] and `held`
    speed [m/s], 0 where he coasts, are the driver's.
    """
    speed = b.v_x + 0.5 * b.dv_x
    for i in range(4):
        at = (b.way + ks[i].x + c.x_rear) / spacing
        j = int(at)
        if at < 0.0 or j + 2 > road.shape[1]:
            return False
        w, side = ws[i], i % 2
        w.grip = grips[side]
        w.road = road[side, j] + (at - j) * (road[side, j + 1] - road[side, j])
        w.road_rate = speed * (road[side, j + 1] - road[side, j]) / spacing
        w.acting = 1.5 * w.damper - 0.5 * w.before
        w.stroke = ks[i].ratio * corner_stroke(b, ks[i], w)
    drive_step(
        c, b, ks[0], ks[1], ks[2], ks[3], ws[0], ws[1], ws[2], ws[3], h, steer, wanted, held, 0.0, dt
    )  # fmt: skip
    b.way += dt * math.sqrt(b.v_x * b.v_x + b.v_y * b.v_y)
    for i in range(4):
        ws[i].velocity = ks[i].ratio * corner_velocity(b, ks[i], ws[i])
    return True


def write_body(b: BodyMotion, row: Vector) -> None:
    """The body's columns at the start of a step."""
    row[0], row[1], row[2], row[3], row[4], row[5] = b.x, b.y, b.yaw, b.z, b.pitch, b.roll
    row[6], row[7], row[8] = b.v_x + 0.5 * b.dv_x, b.v_y + 0.5 * b.dv_y, b.w_yaw + 0.5 * b.dw_yaw
    row[14] = b.work


def write_step(b: BodyMotion, ws: Sequence[WheelMotion], row: Vector, steer: float, dt: float) -> None:
    """The accelerations of a step of `dt` [s], the steer angle [rad] and the wheels' columns, but for the dampers' work."""
    row[9], row[10], row[11] = b.a_x, b.a_y, b.dv_z / dt
    row[12], row[13], row[15] = b.dw_roll / dt, b.dw_pitch / dt, steer
    for i in range(4):
        w = ws[i]
        at = BODY_COLUMNS + WHEEL_COLUMNS * i
        row[at], row[at + 1], row[at + 2], row[at + 3] = w.stroke, w.velocity, w.damper, w.load
        row[at + 4], row[at + 5], row[at + 6], row[at + 7] = w.F_x, w.F_y, w.slip_x, w.slip_y
        row[at + 8], row[at + 9], row[at + 11] = w.spin, w.pressure, w.dv / dt


def run_car(
    p: Sequence[Parameters], d: Sequence[Derived], s: Sequence[State], f: Sequence[Flow],
    c: Body, b: BodyMotion, ks: Sequence[Wheel], ws: Sequence[WheelMotion], h: Brakes, road: Table, spacing: float,
    grips: Vector, q: Pursuer, path: Table, inputs: Table, begin: int, dt: float, out: Table,
) -> int:  # fmt: skip
    """Drive the car with its dampers, whose records `p`, `d`, `s`, `f` (4,) are, from step `begin` on; else as `road_step`.

    `inputs` (n, 3) are `steer`, `wanted` and `held`, step by step; to the angle comes that by which `q` follows a `path`
    (m, 4), if there is one. `out` (n, BODY_COLUMNS + 4 WHEEL_COLUMNS) is written.

    Returns the number of finished steps: less than n where a piston would leave its tube, a step failed, or the road ends.
    """
    if begin == 0:
        for i in range(4):
            ws[i].damper = total_force(s[i])
            ws[i].before = ws[i].damper
    for n in range(len(inputs)):
        row = out[n]
        write_body(b, row)
        steer = follow_path(q, b, path, (begin + n) * dt, dt)
        steer += inputs[n, 0]
        if not road_step(c, b, ks, ws, h, road, spacing, grips, steer, inputs[n, 1], inputs[n, 2], dt):
            return n
        write_step(b, ws, row, steer, dt)
        for i in range(4):
            w = ws[i]
            row[BODY_COLUMNS + WHEEL_COLUMNS * i + 10] = s[i].work
            end = w.stroke + w.velocity * dt
            limit = stroke_limit(d[i])
            if not (-limit <= end <= limit) or not advance(p[i], d[i], s[i], f[i], end, w.velocity, w.velocity, dt):
                return n
            w.before = w.damper
            w.damper = total_force(s[i])
    return len(inputs)
