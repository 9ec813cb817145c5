"""Motions of a damper bench: sine blocks, triangles, sweeps, band-limited noise; with the strokes that settle the oil."""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import cumulative_trapezoid

from twintube.arrays import Array
from twintube.rig.signals import approach, joined, oscillations

STEP = 4e-5  # [m] longest stroke of a step
SLOW = 2e-3  # [s] longest step
STYLES = ("amplitude", "frequency", "triangle", "sweep", "random")
HARMONIC = ("amplitude", "frequency")


@dataclass(frozen=True)
class Motion:
    """What the rig does in a record; arrays (n,), the file begins at the sample `first`."""

    time: Array  # [s]
    stroke: Array  # [m]
    velocity: Array  # [m/s]
    first: int


@dataclass(frozen=True)
class Order:
    """What a record is to be: style and size, without its samples."""

    style: str
    speed: float  # [m/s] largest
    reach: float  # [m] amplitude, or the largest stroke of styles that change it
    slow: float  # [m/s] preconditioning
    turns: int  # oscillations of the preconditioning
    rest: float  # [s] between preconditioning and block
    hertz: float  # of the style `frequency`
    cut: bool  # the preconditioning is not in the file
    count: int  # oscillations of the block
    seed: int  # of the noise


def step_of(speed: float, longest: float, scale: float) -> float:
    """Step [s] at a speed [m/s]: fine in stroke and in time; `scale` above 1 is coarser."""
    return min(scale * STEP / speed, longest)


def motion(order: Order, longest: float, scale: float = 1.0) -> Motion:
    """The motion of an order; `longest` [s] is the longest step."""
    dt = step_of(order.speed, longest, scale)
    slow_dt = step_of(order.slow, longest, scale)
    amplitude = order.speed / (2 * np.pi * order.hertz) if order.style == "frequency" else order.reach
    conditioning = oscillations(order.slow, order.reach, order.turns, slow_dt, 0.75)
    block = BLOCKS[order.style](order, dt, amplitude)
    transfer = approach(float(conditioning[1][-1]), float(block[1][0]), slow_dt)
    segments = [conditioning, transfer, block]
    if abs(float(conditioning[1][-1] - block[1][0])) < 1e-9:
        segments = [conditioning, block]
    pauses = [slow_dt] * (len(segments) - 2) + [max(order.rest, dt)]
    time, stroke, velocity = joined(segments, pauses)
    return Motion(time, stroke, velocity, len(time) - len(block[0]) if order.cut else 0)


def sine(order: Order, dt: float, amplitude: float) -> tuple[Array, Array, Array]:
    """A block of oscillations that begins at the bottom."""
    return oscillations(order.speed, amplitude, order.count, dt, 0.75)


def triangle(order: Order, dt: float, amplitude: float) -> tuple[Array, Array, Array]:
    """Constant velocity to and fro; a rig turns with a finite acceleration, here in a twelfth of a half cycle."""
    half = 2.0 * amplitude / order.speed
    turn = half / 12.0
    time = np.arange(0.0, 2.0 * half * order.count, dt)
    phase = np.mod(time, 2.0 * half)
    corners = np.array([0.0, turn, half - turn, half + turn, 2 * half - turn, 2 * half])
    velocity = order.speed * np.interp(phase, corners, np.array([0.0, 1.0, 1.0, -1.0, -1.0, 0.0]))
    stroke = cumulative_trapezoid(velocity, time, initial=0.0)
    return time, stroke - 0.5 * (stroke.max() + stroke.min()), velocity


def sweep(order: Order, dt: float, amplitude: float) -> tuple[Array, Array, Array]:
    """Frequency rising exponentially from 0.3 Hz at a constant amplitude until the speed is reached."""
    lowest, highest = 0.3, order.speed / (2 * np.pi * amplitude)
    seconds = 4.0 + 1.5 * order.count
    time = np.arange(0.0, seconds, dt)
    ratio = max(highest / lowest, 1.5)
    phase = 2 * np.pi * lowest * seconds / np.log(ratio) * (ratio ** (time / seconds) - 1.0)
    stroke = -amplitude * np.cos(phase)
    return time, stroke, np.gradient(stroke, time)


def noise(order: Order, dt: float, amplitude: float) -> tuple[Array, Array, Array]:
    """Band-limited noise, 0.4 to 12 Hz, whose speed falls with the frequency; faded in and out over a second."""
    rng = np.random.default_rng(order.seed)
    seconds = 6.0 + order.count
    time = np.arange(0.0, seconds, dt)
    frequencies = np.exp(rng.uniform(np.log(0.4), np.log(12.0), 60))
    stroke = np.zeros_like(time)
    for f, phase in zip(frequencies, rng.uniform(0, 2 * np.pi, 60), strict=True):
        stroke += np.sin(2 * np.pi * f * time + phase) / f**1.2
    share = np.clip(np.minimum(time, seconds - time), 0.0, 1.0)
    stroke *= share**2 * (3 - 2 * share)
    velocity = np.gradient(stroke, time)
    size = min(amplitude / np.abs(stroke).max(), order.speed / np.abs(velocity).max())
    return time, size * stroke, size * velocity


BLOCKS = {"amplitude": sine, "frequency": sine, "triangle": triangle, "sweep": sweep, "random": noise}
