"""Drives of the rig as pieces of sines, ramps and rests."""

from dataclasses import dataclass

import numpy as np

from twintube.lab.blind_trials.model import path
from twintube.lab.blind_trials.quantities import Array
from twintube.rig.signals import AMPLITUDE, BLOCKS, OSCILLATIONS, PRECONDITIONING, V_PRECONDITIONING

VELOCITIES = BLOCKS  # [m/s]
PAUSE = 2.0  # [s] between preconditioning and block
LONG_PAUSE = 60.0  # [s]
V_REST = 1.048  # [m/s] of the blocks about the long pause
V_QUASI_STATIC = 1e-3  # [m/s]
RAMP = 0.1  # of a period, in which a sine starts and ends: no rig jumps to full velocity


@dataclass(frozen=True)
class Drive:
    """Pieces (n, 7): from [s], to [s], angular frequency [1/s], amplitude [m], ramp [s], first stroke [m], slope [m/s]."""

    pieces: Array
    blocks: tuple[tuple[float, float], ...]  # begin and end [s] of the measured oscillations

    @property
    def duration(self) -> float:
        """Length [s]."""
        return float(self.pieces[-1, 1])

    def sampled(self, times: Array) -> tuple[Array, Array]:
        """Stroke [m] and velocity [m/s] at the `times` (n,) [s]."""
        z, v = np.empty(len(times)), np.empty(len(times))
        path(self.pieces, times, z, v)
        return z, v


def joined(parts: list[tuple[float, float, float, float, float, float]]) -> Array:
    """Pieces from their durations [s] and what follows in a piece, one after another."""
    ends = np.cumsum([part[0] for part in parts])
    return np.array([(end - part[0], end, *part[1:]) for end, part in zip(ends, parts, strict=True)])


def sine(velocity: float, count: int, amplitude: float = AMPLITUDE) -> tuple[float, float, float, float, float, float]:
    """A piece of `count` oscillations of the maximum `velocity` [m/s]."""
    omega = velocity / amplitude
    period = 2 * np.pi / omega
    return (count * period + RAMP * period, omega, amplitude, RAMP * period, 0.0, 0.0)


def harmonic(velocity: float, pause: float = 0.0) -> Drive:
    """Preconditioning, a short rest, 19 oscillations; with a `pause` [s] these once more after it."""
    rest = (PAUSE, 0.0, 0.0, 0.0, 0.0, 0.0)
    parts = [sine(V_PRECONDITIONING, PRECONDITIONING), rest, sine(velocity, OSCILLATIONS)]
    if pause > 0.0:
        parts += [(pause, *rest[1:]), sine(velocity, OSCILLATIONS)]
    pieces = joined(parts)
    return Drive(pieces, tuple((float(row[0]), float(row[1])) for row in pieces[2:] if row[2] > 0.0))


def recovery(velocity: float, seconds: float, pause: float, slow: bool) -> Drive:
    """Preconditioning, a block of about `seconds`, a `pause` [s], slow strokes or none, and 19 oscillations.

    The blocks are the long one and the 19.
    """
    slowly, rest = sine(V_PRECONDITIONING, PRECONDITIONING), (PAUSE, 0.0, 0.0, 0.0, 0.0, 0.0)
    long = sine(velocity, round(seconds * velocity / (2 * np.pi * AMPLITUDE)))
    parts = [slowly, rest, long, (pause, *rest[1:]), *([slowly, rest] if slow else []), sine(velocity, OSCILLATIONS)]
    pieces = joined(parts)
    return Drive(pieces, tuple((float(pieces[i, 0]), float(pieces[i, 1])) for i in (2, -1)))


def quasi_static(amplitude: float = AMPLITUDE) -> Drive:
    """Out, in and back to the middle at 1 mm/s."""
    quarter = amplitude / V_QUASI_STATIC
    ways = ((quarter, 0.0, 1.0), (2 * quarter, amplitude, -1.0), (quarter, -amplitude, 1.0))
    pieces = joined([(time, 0.0, 0.0, 0.0, start, sign * V_QUASI_STATIC) for time, start, sign in ways])
    return Drive(pieces, ())
