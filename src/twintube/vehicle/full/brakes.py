"""Wheel brakes with a slip control that cycles: pressure is built up, held and released wheel by wheel.

The cycle of anti-lock control as Bosch describes it (Automotive Handbook, "ABS control cycle"; Kiencke and Nielsen,
"Automotive Control Systems", ch. 8; both from memory). A wheel that falls faster than a car can is held; one that slips is
released until it speeds up, and held until it has recovered. Then pressure grows again, fast up to a share of what it was
and slowly up to the next fall. There is no slip at which the control comes to rest.

The control does not know the car's speed. It takes that of the second fastest rim, and while the rims slip what an
accelerometer along the car makes of it (as in Savaresi and Tanelli, "Active Braking Control Systems Design for Vehicles",
ch. 5, from memory). Left out: a common order for the rear wheels, and what softens the yaw on unequal grip.

In the kernel's own subset of Python.
"""

from dataclasses import dataclass

from twintube.core.variables import var
from twintube.vehicle.full.car import BodyMotion, Wheel, WheelMotion

# Orders of the control: hold a falling wheel, build up, release, hold a recovering wheel.
HOLD = 0.0
BUILD = 1.0
RELEASE = 2.0
RECOVER = 3.0


@dataclass(slots=True)
class Brakes:
    """The slip control; all values assumed."""

    slip_release: float = var("brakes", "", "1", "slip from which pressure is released", lower=0.01, upper=1, default=0.10)
    slip_build: float = var("brakes", "", "1", "slip below which a wheel has recovered", lower=0.001, upper=1, default=0.02)
    fall: float = var(
        "brakes", "", "m/s2", "deceleration of a rim from which pressure is held", lower=5, upper=500, default=25.0
    )
    rise: float = var(
        "brakes", "", "m/s2", "acceleration of a rim up to which pressure is released", lower=0, upper=500, default=1.5
    )
    drift: float = var(
        "brakes",
        "",
        "m/s2",
        "by which the estimated speed falls faster than the acceleration says",
        lower=0,
        upper=20,
        default=0.5,
    )
    catch: float = var(
        "brakes", "", "m/s2", "by which it rises faster after a rim that leads", lower=0, upper=500, default=5.0
    )
    regain: float = var(
        "brakes", "", "1", "share of the pressure before a release that is built up fast", lower=0, upper=1, default=0.9
    )
    build: float = var("brakes", "", "Pa/s", "rate of the build-up under control", lower=1e5, upper=1e9, default=2.0e7)
    release: float = var("brakes", "", "Pa/s", "rate of the release", lower=1e5, upper=1e10, default=8.0e7)
    apply: float = var(
        "brakes", "", "Pa/s", "rate at which the driver builds up pressure", lower=1e5, upper=1e10, default=5e7
    )
    cycle: float = var("brakes", "", "s", "time between two decisions", lower=1e-3, upper=0.1, default=0.005)
    slowest: float = var("brakes", "", "m/s", "speed below which the control rests", lower=0.1, upper=10, default=1.5)


def seen_speed(h: Brakes, b: BodyMotion, r1: float, r2: float, r3: float, r4: float, dt: float) -> None:
    """Carry the speed that the control takes for the car's over `dt` [s], by those of the rims [m/s].

    The second fastest counts, and only so fast: on an uneven road rims run ahead of the car again and again.
    """
    leading = min(max(r1, r2), max(r3, r4))
    behind = max(min(r1, r2), min(r3, r4))
    second = max(leading, behind)
    foreseen = b.seen + b.a_x * dt
    b.seen = min(max(second, foreseen - h.drift * dt), foreseen + h.catch * dt)


def next_order(h: Brakes, order: float, slip: float, rate: float) -> float:
    """What follows on an order, by the slip of a wheel and the acceleration of its rim [m/s2]."""
    if order == RELEASE:
        return RECOVER if rate > h.rise else RELEASE
    if slip > h.slip_release and rate <= h.rise:
        return RELEASE
    if order == RECOVER:
        return BUILD if slip < h.slip_build or rate < h.rise else RECOVER
    return HOLD if rate < -h.fall else BUILD


def control_brake(h: Brakes, k: Wheel, w: WheelMotion, seen: float, wanted: float, dt: float) -> None:
    """Carry the pressure of a wheel's brake over `dt` [s]; `wanted` [Pa] is the driver's, `seen` [m/s] the estimate."""
    w.waiting -= dt
    if w.waiting <= 0.0:
        w.waiting += h.cycle
        rim = k.radius * w.spin
        rate = (rim - w.rim) / h.cycle
        w.rim = rim
        if seen < h.slowest or w.pressure <= 0.0:
            w.order = BUILD
        else:
            order = next_order(h, w.order, 1.0 - rim / seen, rate)
            if order == RELEASE and w.order != RELEASE:
                w.controlled = w.pressure
            w.order = order
    if w.order == RELEASE:
        w.pressure = max(0.0, w.pressure - h.release * dt)
    elif w.order == BUILD:
        slow = seen >= h.slowest and w.controlled > 0.0 and w.pressure >= h.regain * w.controlled
        growth = h.build if slow else h.apply
        w.pressure = min(wanted, w.pressure + growth * dt)
    w.pressure = min(w.pressure, wanted)
