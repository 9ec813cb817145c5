"""Motions of damper benches: pieces (time [s], stroke [m], velocity [m/s]), (n,) each, that begin at rest at stroke 0.

All but a triangle of an odd number of quarters end there, too.

Sources: sines and triangles of constant velocity, and the usual test speeds: Dixon, The Shock Absorber Handbook, "Testing";
slow strokes that settle the oil: Schramm et al. 2025; a road through body and wheel: Mitschke, Dynamik der Kraftfahrzeuge.
"""

import numpy as np
from scipy.integrate import cumulative_trapezoid

from twintube.common.arrays import Array
from worlds.bench.plan import RNG, Motion

Piece = tuple[Array, Array, Array]
STEP = 4e-5  # [m] longest stroke of a step
RAMP = 0.1  # of a period, in which a sine starts and ends: a rig cannot jump to full velocity
V_SLOW = 0.05  # [m/s] of the strokes that settle the oil
LINES = 80  # of the spectrum of a road


def step_of(speed: float, longest: float, coarser: float = 1.0) -> float:
    """Step [s] at a speed [m/s]: fine in stroke, and at most `longest` [s]."""
    return min(coarser * STEP / speed, longest)


def grid(seconds: float, dt: float) -> Array:
    """Times from 0 in steps of `dt` to the end, or less than a step behind it."""
    return dt * np.arange(max(2, int(np.ceil(seconds / dt - 1e-9)) + 1))


def swing(speed: float, amplitude: float, cycles: float, dt: float, ramp: float = 0.0) -> Piece:
    """A sine of the largest `speed`, taken up and left within `ramp` [s], by default RAMP of a period."""
    omega = speed / amplitude
    ramp = ramp or RAMP * 2 * np.pi / omega
    seconds = 2 * np.pi * cycles / omega + ramp
    time = grid(seconds, dt)
    rate = omega * np.interp(time, [0.0, ramp, seconds - ramp, seconds], [0.0, 1.0, 1.0, 0.0])
    phase = cumulative_trapezoid(rate, time, initial=0.0)
    phase *= 2 * np.pi * cycles / phase[-1]
    return time, amplitude * np.sin(phase), amplitude * rate * np.cos(phase)


def rest(seconds: float, dt: float) -> Piece:
    """Nothing moves; a single step of any length does."""
    time = grid(seconds, dt)
    return time, np.zeros(len(time)), np.zeros(len(time))


def triangle(speed: float, amplitude: float, quarters: int, dt: float, turn: float) -> Piece:
    """Constant velocity to and fro, `quarters` of a cycle long; the rig turns within `turn` [s]."""
    quarter = max(amplitude / speed, 1.5 * turn)
    ends = quarter * np.arange(1, quarters, 2) + turn / 2  # where it turns
    end = quarter * quarters + turn
    knots = np.concatenate([[0.0, turn], np.ravel([(t - turn / 2, t + turn / 2) for t in ends]), [end - turn, end]])
    signs = [1.0 if i % 2 == 0 else -1.0 for i in range(len(ends) + 1)]
    speeds = np.concatenate([[0.0], np.repeat(signs, 2), [0.0]])
    time = grid(end, dt)
    velocity = speed * np.interp(time, knots, speeds)
    return time, cumulative_trapezoid(velocity, time, initial=0.0), velocity


def sweep(speed: float, amplitude: float, low: float, high: float, *, seconds: float, dt: float) -> Piece:
    """Frequency rising exponentially from `low` to `high` [Hz]; the amplitude falls where the speed would be exceeded."""
    time = grid(seconds, dt)
    hertz = low * (high / low) ** (time / seconds)
    phase = 2 * np.pi * cumulative_trapezoid(hertz, time, initial=0.0)
    size = np.minimum(amplitude, speed / (2 * np.pi * hertz))
    stroke = faded(time, 0.2) * size * np.sin(phase)
    return time, stroke, np.gradient(stroke, time)


def road(rng: RNG, speed: float, amplitude: float, seconds: float, dt: float) -> Piece:
    """A drive: body near 1.3 Hz, wheel near 11 Hz, noise in between; neither `speed` nor `amplitude` is exceeded."""
    time = grid(seconds, dt)
    stroke = np.zeros_like(time)
    for f, phase in zip(
        np.exp(rng.uniform(np.log(0.3), np.log(25.0), LINES)), rng.uniform(0, 2 * np.pi, LINES), strict=True
    ):
        body, wheel = np.hypot(1 - (f / 1.3) ** 2, 0.5 * f / 1.3), np.hypot(1 - (f / 11.0) ** 2, 0.3 * f / 11.0)
        stroke += (1.0 / body + 0.06 / wheel) * np.sin(2 * np.pi * f * time + phase)
    stroke *= faded(time, 1.0)
    velocity = np.gradient(stroke, time)
    size = min(amplitude / np.abs(stroke).max(), speed / np.abs(velocity).max())
    return time, size * stroke, size * velocity


def faded(time: Array, seconds: float) -> Array:
    """0 at both ends, 1 in between."""
    share = np.clip(np.minimum(time, time[-1] - time) / seconds, 0.0, 1.0)
    return np.asarray(share**2 * (3 - 2 * share))


def joined(pieces: list[Piece], recorded: int = 0, period: float = 0.0) -> Motion:
    """One piece after the other; the file begins with the piece `recorded`."""
    time, stroke, velocity = pieces[0]
    first = 0
    for i, (t, z, v) in enumerate(pieces[1:], 1):
        if i == recorded:
            first = len(time) - 1
        time = np.concatenate([time, time[-1] + t[1:]])
        stroke, velocity = np.concatenate([stroke, z[1:]]), np.concatenate([velocity, v[1:]])
    return Motion(time, stroke, velocity, first, period, len(time) - len(pieces[-1][0]))
