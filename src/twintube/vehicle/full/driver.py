"""What the driver does: he brakes by the slip control, holds a speed and steers. In the kernel's own subset of Python."""

from twintube.vehicle.full.body import car_step
from twintube.vehicle.full.brakes import Brakes, control_brake, seen_speed
from twintube.vehicle.full.car import Body, BodyMotion, Wheel, WheelMotion

GAIN = 6000.0  # [N.s/m] of the driver who holds a speed: assumed
RESET = 2000.0  # [N/m], the same


def hold_speed(b: BodyMotion, radius: float, speed: float, wanted: float, dt: float) -> float:
    """Drive torque [N.m] by which the driver holds the `wanted` speed [m/s] over `dt` [s]; none where that is 0."""
    if wanted <= 0.0:
        return 0.0
    b.behind += dt * (wanted - speed)
    return radius * (GAIN * (wanted - speed) + RESET * b.behind)


def drive_step(
    c: Body, b: BodyMotion, k1: Wheel, k2: Wheel, k3: Wheel, k4: Wheel,
    w1: WheelMotion, w2: WheelMotion, w3: WheelMotion, w4: WheelMotion, h: Brakes,
    steer: float, pressure: float, wanted: float, torque: float, dt: float,
) -> None:  # fmt: skip
    """One step of car, brakes and driver; road and damper forces stand in `w1` to `w4`.

    The driver steers by `steer` [rad], wants the brake `pressure` [Pa] and the `wanted` speed [m/s]; `torque` [N.m] comes on
    top of what holds the speed.
    """
    speed = b.v_x + 0.5 * b.dv_x
    seen_speed(h, b, k1.radius * w1.spin, k2.radius * w2.spin, k3.radius * w3.spin, k4.radius * w4.spin, dt)
    control_brake(h, k1, w1, b.seen, pressure, dt)
    control_brake(h, k2, w2, b.seen, pressure, dt)
    control_brake(h, k3, w3, b.seen, pressure, dt)
    control_brake(h, k4, w4, b.seen, pressure, dt)
    whole = torque + hold_speed(b, k1.radius, speed, wanted, dt)
    car_step(c, b, k1, k2, k3, k4, w1, w2, w3, w4, steer, whole, dt)
