"""Equations of motion of the whole car in small angles of roll and pitch, after Kane: body, wheels, tyres, brakes.

Every mass's acceleration times its partial velocity, summed, is the sum of the applied forces times theirs (Kane and
Levinson, "Dynamics: Theory and Applications", 1985, ch. 6). So the work of the applied forces is the change of energy,
which `energy` and `BodyMotion.work` show. Partial velocities of a wheel's contact: the body's, its roll about the axle's
roll centre and its pitch about the wheels' centres, the roll of the axle about the roll centre, the support of the links.
The masses of the wheels move with the body along x and with the axle's roll centre along y. Left out: products of inertia,
gyroscopic moments of the wheels, camber, self-aligning torque, rolling resistance, the weight's moment as the body pitches.

In the kernel's own subset of Python: compiled with the damper.
"""

import math
from collections.abc import Sequence

from twintube.common.arrays import Array
from twintube.vehicle.full.car import Body, BodyMotion, Wheel, WheelMotion
from twintube.vehicle.full.tyre import roll_tyre
from twintube.vehicle.quarter_car import GRAVITY, rub, stop_force


def corner_stroke(b: BodyMotion, k: Wheel, w: WheelMotion) -> float:
    """Stroke of a wheel against the body [m], positive in rebound."""
    return b.z + k.y * b.roll - k.x * b.pitch - w.z


def corner_velocity(b: BodyMotion, k: Wheel, w: WheelMotion) -> float:
    """Mean velocity of that stroke [m/s] over the step to come: after `car_step` the speeds are half a step ahead."""
    return b.v_z + k.y * b.w_roll - k.x * b.w_pitch - w.v


def car_step(
    c: Body, b: BodyMotion, k1: Wheel, k2: Wheel, k3: Wheel, k4: Wheel,
    w1: WheelMotion, w2: WheelMotion, w3: WheelMotion, w4: WheelMotion,
    steer: float, torque: float, dt: float,
) -> None:  # fmt: skip
    """One leapfrog step of `dt` [s]; records of the wheels in the order of WHEELS.

    `steer` [rad] is the angle of the steered wheels, `torque` [N.m] that of the drive. Heights and rates of the road, the
    damper forces at the step's start (`acting`), grip and brake pressures stand in `w1` to `w4`.
    """
    begin_sums(c, b)
    push_wheel(c, b, k1, w1, w2, 1.0, steer, torque, dt)
    push_wheel(c, b, k2, w2, w1, -1.0, steer, torque, dt)
    push_wheel(c, b, k3, w3, w4, 1.0, steer, torque, dt)
    push_wheel(c, b, k4, w4, w3, -1.0, steer, torque, dt)
    lift_wheel(k1, w1, w2, dt)
    lift_wheel(k2, w2, w1, dt)
    lift_wheel(k3, w3, w4, dt)
    lift_wheel(k4, w4, w3, dt)
    move_body(c, b, dt)
    rub_wheel(b, k1, w1, dt)
    rub_wheel(b, k2, w2, dt)
    rub_wheel(b, k3, w3, dt)
    rub_wheel(b, k4, w4, dt)


def begin_sums(c: Body, b: BodyMotion) -> None:
    """Of the body alone: air drag, the inertial forces that speeds make, its mass and inertias."""
    v_x, v_y, w_yaw = b.v_x + 0.5 * b.dv_x, b.v_y + 0.5 * b.dv_y, b.w_yaw + 0.5 * b.dw_yaw
    drag = -c.drag * v_x * abs(v_x)
    b.q_x, b.q_y, b.q_z = drag + c.mass * w_yaw * v_y, -c.mass * w_yaw * v_x, 0.0
    b.q_yaw, b.q_pitch, b.q_roll = 0.0, 0.0, 0.0
    b.m_all, b.m_x, b.m_h, b.m_g, b.m_xg = c.mass, 0.0, 0.0, 0.0, 0.0
    b.i_pitch, b.i_yaw, b.i_roll = c.I_pitch, c.I_yaw, c.I_roll
    b.power = drag * v_x


def push_wheel(  # noqa: PLR0915 - the equations of a corner in their order
    c: Body, b: BodyMotion, k: Wheel, w: WheelMotion, other: WheelMotion, side: float,
    steer: float, torque: float, dt: float,
) -> None:  # fmt: skip
    """Forces of a wheel and its suspension, its tyre and spin carried over `dt` [s]; adds what it does to the body.

    `other` is the wheel at the axle's other end, `side` 1 for a left wheel and -1 for a right one.
    """
    v_x, v_y, v_z = b.v_x + 0.5 * b.dv_x, b.v_y + 0.5 * b.dv_y, b.v_z + 0.5 * b.dv_z
    w_yaw, w_pitch, w_roll = b.w_yaw + 0.5 * b.dw_yaw, b.w_pitch + 0.5 * b.dw_pitch, b.w_roll + 0.5 * b.dw_roll
    arm, lever = c.height - k.radius, c.height - k.h_roll
    v_corner = v_z + k.y * w_roll - k.x * w_pitch
    v_wheel = w.v + 0.5 * w.dv
    stroke = b.z + k.y * b.roll - k.x * b.pitch - w.z
    across = b.z - k.y * b.roll - k.x * b.pitch - other.z
    velocity = v_corner - v_wheel
    elastic = k.c_body * stroke + k.c_bar * (stroke - across)
    pull = elastic + k.d_links * velocity + w.friction + k.ratio * (w.acting - k.F_rest)
    stiff, damped = k.c_stop, k.d_stop
    pull += stop_force(stiff, damped, stroke - k.travel, velocity) - stop_force(stiff, damped, -stroke - k.travel, -velocity)
    press = k.weight + k.c_tyre * (w.road - w.z)
    w.load = press
    if press > 0.0:
        w.load += k.d_tyre * (w.road_rate - v_wheel)
    w.load = max(w.load, 0.0)
    # Speeds of wheel centre and contact along and across the body.
    u_x = v_x - k.y * w_yaw - arm * w_pitch
    u_y = v_y + k.x * w_yaw + lever * w_roll
    axle_roll = side * (v_wheel - other.v - 0.5 * other.dv) / k.track
    at_x = u_x - k.support * velocity
    at_y = u_y + k.h_roll * axle_roll
    angle = k.steers * steer - k.steer_compliance * w.F_y
    cosine, sine = math.cos(angle), math.sin(angle)
    roll_tyre(k, w, cosine * at_x + sine * at_y, cosine * at_y - sine * at_x, dt)
    f_x = cosine * w.F_x - sine * w.F_y
    f_y = sine * w.F_x + cosine * w.F_y
    drive = 0.5 * k.drive * torque
    spin = w.spin + 0.5 * w.d_spin
    braked = turn_wheel(k, w, drive, dt)
    lift = -k.support * f_x  # the links' share of the force along, on the body
    b.q_x += f_x
    b.q_y += f_y
    b.q_yaw += k.x * f_y - k.y * f_x
    b.q_z += lift - pull
    b.q_pitch += k.x * (pull - lift) - arm * f_x - drive - braked
    b.q_roll += k.y * (lift - pull) + lever * f_y
    # The mass of the wheel turns and is carried with the car.
    m = k.m_wheel
    b.q_x += m * w_yaw * u_y
    b.q_y -= m * w_yaw * u_x
    b.q_yaw -= m * w_yaw * (k.y * u_y + k.x * u_x)
    b.q_pitch -= m * arm * w_yaw * u_y
    b.q_roll -= m * lever * w_yaw * u_x
    b.q_roll += (k.weight - m * GRAVITY) * lever * b.roll
    b.m_all += m
    b.m_x += m * k.x
    b.m_h += m * arm
    b.m_g += m * lever
    b.m_xg += m * k.x * lever
    b.i_pitch += m * arm * arm
    b.i_yaw += m * (k.x * k.x + k.y * k.y)
    b.i_roll += m * lever * lever
    # What the tyre's lateral force does through the roll centre, half on either wheel of the axle.
    w.lifted = pull + w.load - k.weight - lift
    w.aside = side * f_y * k.h_roll / k.track
    b.power += w.load * w.road_rate - (w.load - max(press, 0.0)) * (w.road_rate - v_wheel)
    b.power -= (pull - elastic) * velocity
    b.power += f_x * at_x + f_y * at_y - w.F_x * k.radius * spin + k.c_x * w.e_x * w.de_x + k.c_y * w.e_y * w.de_y
    b.power += (drive + braked) * (spin - w_pitch)


def lift_wheel(k: Wheel, w: WheelMotion, other: WheelMotion, dt: float) -> None:
    """Move a wheel up or down: both wheels' lateral forces lift the left wheel and press the right one."""
    w.dv = dt * (w.lifted + w.aside - other.aside) / k.m_wheel
    w.v += w.dv
    w.z += dt * w.v


def move_body(c: Body, b: BodyMotion, dt: float) -> None:
    """Move the body by what is summed up. Forward and pitch share a matrix, and so do aside, yaw and roll."""
    v_x, v_y, w_yaw = b.v_x + 0.5 * b.dv_x, b.v_y + 0.5 * b.dv_y, b.w_yaw + 0.5 * b.dw_yaw
    b.work += dt * b.power
    determinant = b.m_all * b.i_pitch - b.m_h * b.m_h
    b.dv_x = dt * (b.q_x * b.i_pitch + b.q_pitch * b.m_h) / determinant
    b.dw_pitch = dt * (b.q_pitch * b.m_all + b.q_x * b.m_h) / determinant
    m11, m12, m13, m22, m23, m33 = b.m_all, b.m_x, b.m_g, b.i_yaw, b.m_xg, b.i_roll
    a11, a12, a13 = m22 * m33 - m23 * m23, m13 * m23 - m12 * m33, m12 * m23 - m13 * m22
    a22, a23, a33 = m11 * m33 - m13 * m13, m12 * m13 - m11 * m23, m11 * m22 - m12 * m12
    determinant = m11 * a11 + m12 * a12 + m13 * a13
    b.dv_y = dt * (a11 * b.q_y + a12 * b.q_yaw + a13 * b.q_roll) / determinant
    b.dw_yaw = dt * (a12 * b.q_y + a22 * b.q_yaw + a23 * b.q_roll) / determinant
    b.dw_roll = dt * (a13 * b.q_y + a23 * b.q_yaw + a33 * b.q_roll) / determinant
    b.dv_z = dt * b.q_z / c.mass
    b.a_x = b.dv_x / dt - w_yaw * v_y
    b.a_y = b.dv_y / dt + w_yaw * v_x
    b.v_x += b.dv_x
    b.v_y += b.dv_y
    b.v_z += b.dv_z
    b.w_yaw += b.dw_yaw
    b.w_pitch += b.dw_pitch
    b.w_roll += b.dw_roll
    middle = b.yaw + 0.5 * dt * b.w_yaw
    b.x += dt * (b.v_x * math.cos(middle) - b.v_y * math.sin(middle))
    b.y += dt * (b.v_x * math.sin(middle) + b.v_y * math.cos(middle))
    b.yaw += dt * b.w_yaw
    b.z += dt * b.v_z
    b.pitch += dt * b.w_pitch
    b.roll += dt * b.w_roll


def rub_wheel(b: BodyMotion, k: Wheel, w: WheelMotion, dt: float) -> None:
    """Carry a wheel's friction on by the stroke of the step."""
    w.friction = rub(k.friction, w.friction, dt * corner_velocity(b, k, w))


def turn_wheel(k: Wheel, w: WheelMotion, drive: float, dt: float) -> float:
    """Turn a wheel by its `drive` torque [N.m], tyre and brake; returns the torque of the brake, which can hold it."""
    free = w.spin + dt * (drive - w.F_x * k.radius) / k.I_spin
    most = dt * k.brake * w.pressure / k.I_spin
    braked = math.copysign(max(abs(free) - most, 0.0), free)
    w.d_spin = braked - w.spin
    w.spin = braked
    return (braked - free) * k.I_spin / dt


def energy(c: Body, b: BodyMotion, ks: Sequence[Wheel], ws: Sequence[WheelMotion], road: Array) -> float:
    """Energy [J] at the start of a step: motion, springs, stops, bars, tyres and the height of the body as it rolls."""
    v_x, v_y, v_z = b.v_x + 0.5 * b.dv_x, b.v_y + 0.5 * b.dv_y, b.v_z + 0.5 * b.dv_z
    w_yaw, w_pitch, w_roll = b.w_yaw + 0.5 * b.dw_yaw, b.w_pitch + 0.5 * b.dw_pitch, b.w_roll + 0.5 * b.dw_roll
    total = 0.5 * c.mass * (v_x * v_x + v_y * v_y + v_z * v_z)
    total += 0.5 * (c.I_pitch * w_pitch * w_pitch + c.I_yaw * w_yaw * w_yaw + c.I_roll * w_roll * w_roll)
    for i in range(4):
        k, w = ks[i], ws[i]
        other = ws[i + 1 - 2 * (i % 2)]
        u_x = v_x - k.y * w_yaw - (c.height - k.radius) * w_pitch
        u_y = v_y + k.x * w_yaw + (c.height - k.h_roll) * w_roll
        v, spin = w.v + 0.5 * w.dv, w.spin + 0.5 * w.d_spin
        stroke = b.z + k.y * b.roll - k.x * b.pitch - w.z
        across = b.z - k.y * b.roll - k.x * b.pitch - other.z
        total += 0.5 * k.m_wheel * (u_x * u_x + u_y * u_y + v * v) + 0.5 * k.I_spin * spin * spin
        total += 0.5 * k.c_body * stroke * stroke + 0.25 * k.c_bar * (stroke - across) * (stroke - across)
        press = max(k.weight / k.c_tyre + road[i] - w.z, 0.0)
        # Of the weight, the part that the springs carry at rest is in their preload.
        total += 0.5 * k.c_tyre * press * press + k.weight * w.z
        total += 0.5 * k.c_x * w.e_x * w.e_x + 0.5 * k.c_y * w.e_y * w.e_y
        total -= 0.5 * (k.weight - k.m_wheel * GRAVITY) * (c.height - k.h_roll) * b.roll * b.roll
    return total
