"""The loop over the whole car and its four dampers, in the kernel's subset of Python; numba compiles it with the kernel."""

import math
from typing import Any

from twintube.core.frame import stroke_limit
from twintube.core.model import advance
from twintube.core.outputs import total_force
from twintube.vehicle.full.body import car_step, corner_stroke, corner_velocity
from twintube.vehicle.full.brakes import control_brake

# Columns of a step: the body's, then those of each wheel in turn.
BODY_COLUMNS = 15
WHEEL_COLUMNS = 12
GAIN, RESET = 6000.0, 2000.0  # [N.s/m], [N/m] of the driver who holds a speed: assumed


def run_car(
    p: Any, d: Any, s: Any, f: Any, c: Any, b: Any, ks: Any, ws: Any, h: Any,
    road: Any, spacing: float, inputs: Any, grip: float, dt: float, out: Any, heights: Any, rates: Any,
) -> int:  # fmt: skip
    """Drive the car over `road` (2, m) [m], the heights under left and right wheels every `spacing` [m].

    Position 0 of the road is at the rear axle at the start. `inputs` (n, 3) are, step by step, the steer angle [rad], the
    brake pressure the driver wants [Pa] and the speed he holds [m/s], 0 where he coasts. `p`, `d`, `s`, `f` (4,) are the
    dampers' records. `out` (n, BODY_COLUMNS + 4 WHEEL_COLUMNS) is written; `heights`, `rates` (4,) are room to work in.

    Returns the number of finished steps: less than n where a piston would leave its tube, a step failed, or the road ends.
    """
    way = 0.0
    error = 0.0
    for i in range(4):
        ws[i].damper = total_force(s[i])
        ws[i].before = ws[i].damper
    for n in range(len(inputs)):
        speed = b.v_x + 0.5 * b.dv_x
        for i in range(4):
            at = (way + ks[i].x + c.x_rear) / spacing
            j = int(at)
            if at < 0.0 or j + 2 > road.shape[1]:
                return n
            side = i % 2
            heights[i] = road[side, j] + (at - j) * (road[side, j + 1] - road[side, j])
            rates[i] = speed * (road[side, j + 1] - road[side, j]) / spacing
            control_brake(h, ks[i], ws[i], speed, inputs[n, 1], dt)
        torque = 0.0
        if inputs[n, 2] > 0.0:
            error += dt * (inputs[n, 2] - speed)
            torque = ks[0].radius * (GAIN * (inputs[n, 2] - speed) + RESET * error)
        row = out[n]
        row[0], row[1], row[2], row[3], row[4], row[5] = b.x, b.y, b.yaw, b.z, b.pitch, b.roll
        row[6], row[7], row[8] = speed, b.v_y + 0.5 * b.dv_y, b.w_yaw + 0.5 * b.dw_yaw
        row[14] = b.work
        for i in range(4):
            row[BODY_COLUMNS + WHEEL_COLUMNS * i] = ks[i].ratio * corner_stroke(b, ks[i], ws[i])
        car_step(c, b, ks, ws, heights, rates, inputs[n, 0], torque, grip, dt)
        row[9], row[10], row[11] = b.a_x, b.a_y, b.dv_z / dt
        row[12], row[13] = b.dw_roll / dt, b.dw_pitch / dt
        way += dt * math.sqrt(b.v_x * b.v_x + b.v_y * b.v_y)
        for i in range(4):
            w, k = ws[i], ks[i]
            at = BODY_COLUMNS + WHEEL_COLUMNS * i
            stroke, velocity = row[at], k.ratio * corner_velocity(b, k, w)
            row[at + 1] = velocity
            row[at + 2] = w.damper
            row[at + 3] = w.load
            row[at + 4] = w.F_x
            row[at + 5] = w.F_y
            row[at + 6] = w.slip_x
            row[at + 7] = w.slip_y
            row[at + 8] = w.spin
            row[at + 9] = w.pressure
            row[at + 10] = s[i].work
            row[at + 11] = w.dv / dt
            end = stroke + velocity * dt
            limit = stroke_limit(d[i])
            if not (-limit <= end <= limit) or not advance(p[i], d[i], s[i], f[i], end, velocity, velocity, dt):
                return n
            w.before = w.damper
            w.damper = total_force(s[i])
    return len(inputs)
