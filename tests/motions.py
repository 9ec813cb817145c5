"""Motions of a damper with velocities that belong to them, and wrong ones, for the promise that the latter are warned of."""

from collections.abc import Callable

import numpy as np

from twintube import harmonic_block, load
from twintube.common.arrays import Array
from twintube.vehicle.cars import load_car
from twintube.vehicle.maneuvers import MANEUVERS
from twintube.vehicle.plan import drive_signal
from twintube.vehicle.ride import ride, track

Motion = tuple[Array, Array, Array]  # time [s], stroke [m], velocity [m/s], each (n,)

WRONG: dict[str, Callable[[Array], Array]] = {
    "sign": lambda v: -v,
    "not connected": lambda v: 0.0 * v,
    "motion ratio": lambda v: 0.5 * v,
    "km/h": lambda v: 3.6 * v,
}


def sine(amplitude: float, frequency: float, h: float, seconds: float, phase: float = 0.0) -> Motion:
    t, w = np.arange(round(seconds / h)) * h, 2 * np.pi * frequency
    return t, amplitude * np.sin(w * t + phase), amplitude * w * np.cos(w * t + phase)


def sampled(motion: Motion, h: float) -> Motion:
    """The motion at every `h` [s], in a line between its samples."""
    time, *values = motion
    t = np.arange(int((time[-1] - time[0]) / h) + 1) * h
    stroke, velocity = (np.interp(t, time - time[0], v) for v in values)
    return t, stroke, velocity


def table(motion: Motion, h: float, between: float) -> Motion:
    """A table of samples every `h` [s], read every `between` [s]."""
    return sampled(sampled(motion, h), between)


def noisy(motion: Motion, *, stroke: float = 0.0, velocity: float = 0.0) -> Motion:
    """With noise, as shares of the largest values."""
    random = np.random.default_rng(5)
    t, z, v = motion
    return (
        t,
        z + stroke * np.abs(z).max() * random.standard_normal(len(z)),
        v + velocity * np.abs(v).max() * random.standard_normal(len(v)),
    )


def late(motion: Motion) -> Motion:
    """With a velocity that is 0 at the start and comes with the first step."""
    t, z, v = motion
    return t, z, np.where(np.arange(len(v)) > 0, v, 0.0)


def of_steps(motion: Motion) -> Motion:
    """With the mean velocity of the coming step."""
    t, z, _ = motion
    return t[:-1], z[:-1], np.diff(z) / np.diff(t)


def reversal(motion: Motion, number: int) -> float:
    """Time [s] of a reversal."""
    t, _, v = motion
    moving = v != 0.0
    turns = np.flatnonzero(np.diff(np.sign(v[moving])) != 0.0)
    return float(t[moving][turns[number - 1] + 1])


def block(velocity: float) -> Motion:
    signal = harmonic_block(velocity)
    return signal.time, signal.stroke, signal.velocity


def drive(speed_kmh: float, dt: float = 1e-3) -> Motion:
    """The damper's motion in a quarter car on the class D road, stepped every `dt` [s]."""
    run = ride(load("SA8"), load_car().corner(load("SA8")), track(speed_kmh, 12.0, dt=dt))
    return run.time, run.stroke, run.velocity


def table_3(number: int) -> Motion:
    signal = drive_signal(load("SA8"), next(m for m in MANEUVERS if m.number == number))
    return signal.time, signal.stroke, signal.velocity


def ramps(h: float) -> Motion:
    """Up, a rest, down, a rest."""
    t = np.arange(round(8.0 / h)) * h
    v = np.where((t >= 1.0) & (t < 2.0), 0.05, 0.0) - np.where((t >= 5.0) & (t < 6.0), 0.1, 0.0)
    return t, np.interp(t, [1.0, 2.0, 5.0, 6.0], [0.0, 0.05, 0.05, -0.05]), v


def chirp(h: float) -> Motion:
    """Up to 10 Hz in 10 s, the speed nearly even: the amplitude falls."""
    t = np.arange(round(10.0 / h)) * h
    angle, w = np.pi * t**2, 2 * np.pi * t
    amplitude, fall = 0.03 / (1.0 + t), -0.03 / (1.0 + t) ** 2
    return t, amplitude * np.sin(angle), amplitude * w * np.cos(angle) + fall * np.sin(angle)


RIGHT: dict[str, Callable[[], Motion]] = {
    **{f"50 mm at 2 Hz, {1e3 * h:g} ms": lambda h=h: sine(0.05, 2.0, h, 2.0) for h in (1e-4, 1e-3, 1e-2, 4e-2)},
    **{f"10 mm at 1.5 Hz, {1e3 * h:g} ms": lambda h=h: sine(0.01, 1.5, h, 4.0) for h in (1e-3, 1e-2, 4e-2)},
    **{f"paper's 1.048 m/s, {1e3 * h:g} ms": lambda h=h: sampled(block(1.048), h) for h in (1e-3, 1e-2, 4e-2)},
    **{f"1.9 m/s, {1e3 * h:g} ms": lambda h=h: sine(0.06, 5.0, h, 2.0) for h in (1e-3, 1e-2)},
    **{f"3 mm at 12 Hz, {1e3 * h:g} ms": lambda h=h: sine(0.003, 12.0, h, 4.0) for h in (1e-3, 1e-2, 4e-2)},
    **{f"noisy velocity, {1e3 * h:g} ms": lambda h=h: noisy(sine(0.05, 2.0, h, 10.0), velocity=0.005)
       for h in (1e-4, 1e-3, 1e-2, 4e-2)},
    "ramps and rests, noisy velocity": lambda: noisy(ramps(1e-2), velocity=0.005),
    "noisy stroke, 1 ms": lambda: noisy(sine(0.05, 2.0, 1e-3, 20.0), stroke=0.005),
    "noise of both, 0.1 ms": lambda: noisy(sine(0.05, 2.0, 1e-4, 4.0), stroke=0.005, velocity=0.005),
    **{f"table of {1e3 * h:g} ms at {1e3 * between:g} ms": lambda h=h, b=between: table(sine(0.05, 2.0, 1e-4, 3.0), h, b)
       for h in (1e-2, 4e-2) for between in (1e-4, 1e-3)},
    "paper's 1.048 m/s, table of 10 ms": lambda: table(block(1.048), 1e-2, 1e-3),
    "paper's 1.048 m/s, table of 40 ms": lambda: table(block(1.048), 4e-2, 1e-3),
    **{f"start in motion, {1e3 * h:g} ms": lambda h=h: sine(0.05, 2.0, h, 2.0, 0.6) for h in (1e-3, 4e-2)},
    **{f"velocity from the first step on, {1e3 * h:g} ms": lambda h=h: late(sine(0.05, 2.0, h, 2.0, 0.6))
       for h in (1e-4, 1e-3, 1e-2, 4e-2)},
    **{f"mean of the coming step, {1e3 * h:g} ms": lambda h=h: of_steps(sine(0.05, 2.0, h, 2.0, 0.6))
       for h in (1e-3, 1e-2, 4e-2)},
    **{f"class D at {v} km/h, {1e3 * dt:g} ms": lambda v=v, dt=dt: drive(v, dt) for v in (30, 90) for dt in (1e-3, 2e-3)},
    **{f"class D at {v} km/h, every {1e3 * h:g} ms": lambda v=v, h=h: sampled(drive(v), h)
       for v in (30, 90) for h in (1e-2, 2e-2, 4e-2)},
    "class D at 90 km/h, table of 10 ms": lambda: table(drive(90), 1e-2, 1e-3),
    **{f"Table 3, measurement {m.number}": lambda n=m.number: table_3(n) for m in MANEUVERS},
    **{f"ramps, {1e3 * h:g} ms": lambda h=h: ramps(h) for h in (1e-3, 1e-2, 4e-2)},
    **{f"chirp, {1e3 * h:g} ms": lambda h=h: chirp(h) for h in (1e-3, 1e-2)},
    "rest": lambda: (np.arange(5000) * 1e-2, np.full(5000, 0.03), np.zeros(5000)),
}  # fmt: skip
