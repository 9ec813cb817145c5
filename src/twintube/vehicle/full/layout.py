"""What follows from a car's given values, in the kernel's own subset of Python."""

from twintube.vehicle.full.car import Body, Wheel, WheelMotion
from twintube.vehicle.quarter_car import GRAVITY


def balance_body(c: Body, front: float, rear: float) -> None:
    """Mass and places of the axles from the sprung masses of a front and a rear corner [kg]."""
    c.mass = 2.0 * front + 2.0 * rear
    c.x_front = c.wheelbase * (2.0 * rear) / c.mass
    c.x_rear = c.wheelbase * (2.0 * front) / c.mass


def place_wheel(k: Wheel, x: float, side: float) -> None:
    """Place and load at rest of a wheel at `x` [m]; `side` is 1 for a left wheel and -1 for a right one."""
    k.x = x
    k.y = k.track / 2.0 * side
    k.weight = (k.m_body + k.m_wheel) * GRAVITY


def start_wheel(k: Wheel, w: WheelMotion, speed: float) -> None:
    """A wheel that rolls freely at a `speed` [m/s] on a flat road; its brake may be applied."""
    w.spin = speed / k.radius
    w.rim = speed
    w.order = 1.0
    w.grip = 1.0
