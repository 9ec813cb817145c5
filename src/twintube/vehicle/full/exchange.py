"""The car stepped from outside, in communication steps: what its FMU computes, in the kernel's own subset of Python.

A damper's force belongs to the middle of the communication step in which it was computed. Where steps are short it is
carried on in a line as `loop.py` does. The damper needs its mean velocity over the step to come, which the accelerations of
the last part foresee.
"""

import math

from twintube.vehicle.full.body import corner_stroke, corner_velocity
from twintube.vehicle.full.brakes import Brakes
from twintube.vehicle.full.car import Body, BodyMotion, Wheel, WheelMotion
from twintube.vehicle.full.driver import drive_step
from twintube.vehicle.full.layout import balance_body, place_wheel, start_wheel
from twintube.vehicle.full.signals import BodyOutputs, Course, DriverInputs, WheelInputs, WheelOutputs

LONGEST_PART = 1e-3  # [s]
LONGEST_CARRIED = 4e-3  # [s] of steps over which forces are carried on; over longer ones that would sway more than help
CARRIED_STEPS = 1.5  # [1] mean steps over which a force is carried on: to the end of a step as long as the last two
NO_TIME = 1e-9  # [s] of a step that is rounding


def set_up_car(c: Body, k1: Wheel, k2: Wheel, k3: Wheel, k4: Wheel) -> None:
    """Fill in what follows from the values of the file."""
    balance_body(c, k1.m_body, k3.m_body)
    place_wheel(k1, c.x_front, 1.0)
    place_wheel(k2, c.x_front, -1.0)
    place_wheel(k3, -c.x_rear, 1.0)
    place_wheel(k4, -c.x_rear, -1.0)


def start_car(
    b: BodyMotion, k1: Wheel, k2: Wheel, k3: Wheel, k4: Wheel,
    w1: WheelMotion, w2: WheelMotion, w3: WheelMotion, w4: WheelMotion,
    j1: WheelInputs, j2: WheelInputs, j3: WheelInputs, j4: WheelInputs, speed: float,
) -> None:  # fmt: skip
    """Let the car roll straight ahead at a `speed` [m/s]; its records hold zeros."""
    b.v_x = speed
    b.seen = speed
    start_wheel(k1, w1, speed)
    start_wheel(k2, w2, speed)
    start_wheel(k3, w3, speed)
    start_wheel(k4, w4, speed)
    w1.damper = j1.force
    w2.damper = j2.force
    w3.damper = j3.force
    w4.damper = j4.force


def change_part(b: BodyMotion, w1: WheelMotion, w2: WheelMotion, w3: WheelMotion, w4: WheelMotion, factor: float) -> None:
    """Take the speeds to half of the coming part before now, `factor` times as long as the last part."""
    b.v_x += 0.5 * (1.0 - factor) * b.dv_x
    b.v_y += 0.5 * (1.0 - factor) * b.dv_y
    b.v_z += 0.5 * (1.0 - factor) * b.dv_z
    b.w_yaw += 0.5 * (1.0 - factor) * b.dw_yaw
    b.w_pitch += 0.5 * (1.0 - factor) * b.dw_pitch
    b.w_roll += 0.5 * (1.0 - factor) * b.dw_roll
    b.dv_x *= factor
    b.dv_y *= factor
    b.dv_z *= factor
    b.dw_yaw *= factor
    b.dw_pitch *= factor
    b.dw_roll *= factor
    change_wheel(w1, factor)
    change_wheel(w2, factor)
    change_wheel(w3, factor)
    change_wheel(w4, factor)


def change_wheel(w: WheelMotion, factor: float) -> None:
    """`change_part` of a wheel."""
    w.v += 0.5 * (1.0 - factor) * w.dv
    w.spin += 0.5 * (1.0 - factor) * w.d_spin
    w.dv *= factor
    w.d_spin *= factor


def take_force(w: WheelMotion, j: WheelInputs) -> None:
    """The damper force of the last communication step."""
    w.before = w.damper
    w.damper = j.force


def meet_road(w: WheelMotion, j: WheelInputs, grip: float, ahead: float, at: float) -> None:
    """Road, its grip and damper force `at` [s] within a step; the force is carried on by `ahead` mean steps."""
    w.grip = grip
    w.road = j.road + at * j.road_rate
    w.road_rate = j.road_rate
    w.acting = w.damper + ahead * (w.damper - w.before)


def communication_step(
    c: Body, b: BodyMotion, k1: Wheel, k2: Wheel, k3: Wheel, k4: Wheel,
    w1: WheelMotion, w2: WheelMotion, w3: WheelMotion, w4: WheelMotion, h: Brakes, i: DriverInputs,
    j1: WheelInputs, j2: WheelInputs, j3: WheelInputs, j4: WheelInputs, t: Course, span: float,
) -> None:  # fmt: skip
    """A communication step of `span` [s] in parts of at most LONGEST_PART; inputs are those at its start."""
    if span <= NO_TIME:
        return
    parts = max(1, math.ceil(span / LONGEST_PART - 1e-6))
    dt = span / parts
    if t.part > 0.0 and t.part != dt:
        change_part(b, w1, w2, w3, w4, dt / t.part)
    take_force(w1, j1)
    take_force(w2, j2)
    take_force(w3, j3)
    take_force(w4, j4)
    # The force at the start is that of a rest before it, as long as a step.
    earlier = t.earlier if t.earlier > 0.0 else t.span
    apart = 0.5 * (t.span + earlier)
    for n in range(parts):
        at = n * dt
        ahead = min(CARRIED_STEPS, (0.5 * t.span + at) / apart) if apart > 0.0 and span <= LONGEST_CARRIED else 0.0
        meet_road(w1, j1, i.grip, ahead, at)
        meet_road(w2, j2, i.grip, ahead, at)
        meet_road(w3, j3, i.grip, ahead, at)
        meet_road(w4, j4, i.grip, ahead, at)
        drive_step(
            c, b, k1, k2, k3, k4, w1, w2, w3, w4, h, i.steer, i.brake_pressure, i.speed, i.torque, dt
        )  # fmt: skip
    t.earlier = t.span
    t.span = span
    t.part = dt


def publish_body(b: BodyMotion, o: BodyOutputs, t: Course) -> None:
    """Fill `o` after a step."""
    o.x = b.x
    o.y = b.y
    o.z = b.z
    o.yaw = b.yaw
    o.pitch = b.pitch
    o.roll = b.roll
    o.v_x = b.v_x + 0.5 * b.dv_x
    o.v_y = b.v_y + 0.5 * b.dv_y
    o.v_z = b.v_z + 0.5 * b.dv_z
    o.yaw_rate = b.w_yaw + 0.5 * b.dw_yaw
    o.a_x = b.a_x
    o.a_y = b.a_y
    o.a_z = b.dv_z / t.part if t.part > 0.0 else 0.0


def publish_wheel(b: BodyMotion, k: Wheel, w: WheelMotion, o: WheelOutputs, t: Course) -> None:
    """Fill `o` after a step."""
    change = b.dv_z + k.y * b.dw_roll - k.x * b.dw_pitch - w.dv
    parts = t.span / t.part if t.part > 0.0 else 1.0
    o.stroke = k.ratio * corner_stroke(b, k, w)
    o.velocity = k.ratio * (corner_velocity(b, k, w) + 0.5 * (1.0 + parts) * change)
    o.height = w.z
    o.load = w.load if t.part > 0.0 else k.weight
    o.F_x = w.F_x
    o.F_y = w.F_y
    o.slip_x = w.slip_x
    o.slip_y = w.slip_y
    o.spin = w.spin + 0.5 * w.d_spin
    o.pressure = w.pressure
