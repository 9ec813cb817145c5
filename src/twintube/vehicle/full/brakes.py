"""Wheel brakes with a slip control: pressure is built up, held or released by the slip of each wheel alone.

A switching control with two thresholds and rates of pressure, the simplest that is documented (MathWorks, "Modeling an
Anti-Lock Braking System", decides by the sign of a slip error alone; a zone between the thresholds holds). It knows the true
speed of the car, which a real one estimates.

In the kernel's own subset of Python.
"""

from dataclasses import dataclass

from twintube.core.variables import var
from twintube.vehicle.full.car import Wheel, WheelMotion


@dataclass(slots=True)
class Brakes:
    """The slip control; all values assumed."""

    slip_release: float = var("brakes", "", "1", "slip from which pressure is released", lower=0.01, upper=1, default=0.15)
    slip_build: float = var("brakes", "", "1", "slip below which it is built up", lower=0.01, upper=1, default=0.09)
    build: float = var("brakes", "", "Pa/s", "rate of the build-up under control", lower=1e5, upper=1e9, default=2.0e7)
    release: float = var("brakes", "", "Pa/s", "rate of the release", lower=1e5, upper=1e10, default=8.0e7)
    apply: float = var(
        "brakes", "", "Pa/s", "rate at which the driver builds up pressure", lower=1e5, upper=1e10, default=5e7
    )
    cycle: float = var("brakes", "", "s", "time between two decisions", lower=1e-3, upper=0.1, default=0.005)
    slowest: float = var("brakes", "", "m/s", "speed below which the control rests", lower=0.1, upper=10, default=1.5)


def control_brake(h: Brakes, k: Wheel, w: WheelMotion, speed: float, wanted: float, dt: float) -> None:
    """Carry the pressure of a wheel's brake over `dt` [s]; the driver wants `wanted` [Pa], the car goes at `speed` [m/s]."""
    w.waiting -= dt
    if w.waiting <= 0.0:
        w.waiting += h.cycle
        slip = 1.0 - k.radius * w.spin / max(speed, 0.1)
        if speed < h.slowest or w.pressure <= 0.0:
            w.order = 1.0
        elif slip > h.slip_release:
            w.order = -1.0
            w.controlled = 1.0
        elif slip < h.slip_build:
            w.order = 1.0
        else:
            w.order = 0.0
    if w.order < 0.0:
        w.pressure = max(0.0, w.pressure - h.release * dt)
    elif w.order > 0.0:
        rate = h.build if w.controlled > 0.0 and speed >= h.slowest else h.apply
        w.pressure = min(wanted, w.pressure + rate * dt)
    w.pressure = min(w.pressure, wanted)
