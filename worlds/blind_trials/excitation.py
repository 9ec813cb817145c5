"""Excitations of the rig, composed of sines, ramps and rests."""

from dataclasses import dataclass

import numpy as np

from twintube.rig.plan import V_QUASI_STATIC
from twintube.rig.signals import AMPLITUDE, BLOCKS, ONE_METRE, OSCILLATIONS, PRECONDITIONING, V_PRECONDITIONING
from worlds.blind_trials.model import sample
from worlds.blind_trials.quantities import Array

VELOCITIES = BLOCKS  # [m/s]
PAUSE = 2.0  # [s] between preconditioning and block
LONG_PAUSE = 60.0  # [s]
V_REST = ONE_METRE  # [m/s] of the blocks before and after the long pause
RAMP = 0.1  # of a period, in which a sine starts and ends: a rig cannot jump to full velocity


@dataclass(frozen=True)
class Excitation:
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
        sample(self.pieces, times, z, v)
        return z, v


def joined(segments: list[tuple[float, float, float, float, float, float]]) -> Array:
    """Pieces from consecutive segments: duration [s], then the columns of a piece from the angular frequency on."""
    ends = np.cumsum([segment[0] for segment in segments])
    return np.array([(end - segment[0], end, *segment[1:]) for end, segment in zip(ends, segments, strict=True)])


def sine(velocity: float, count: int, amplitude: float = AMPLITUDE) -> tuple[float, float, float, float, float, float]:
    """A segment of `count` oscillations with the maximum `velocity` [m/s]."""
    omega = velocity / amplitude
    period = 2 * np.pi / omega
    return (count * period + RAMP * period, omega, amplitude, RAMP * period, 0.0, 0.0)


def harmonic(velocity: float, pause: float = 0.0) -> Excitation:
    """Preconditioning, a short rest, 19 oscillations; with a `pause` [s] another 19 oscillations after it."""
    pause_segment = (PAUSE, 0.0, 0.0, 0.0, 0.0, 0.0)
    segments = [sine(V_PRECONDITIONING, PRECONDITIONING), pause_segment, sine(velocity, OSCILLATIONS)]
    if pause > 0.0:
        segments += [(pause, *pause_segment[1:]), sine(velocity, OSCILLATIONS)]
    pieces = joined(segments)
    return Excitation(pieces, tuple((float(row[0]), float(row[1])) for row in pieces[2:] if row[2] > 0.0))


def recovery(velocity: float, seconds: float, pause: float, slow: bool) -> Excitation:
    """Preconditioning, a block of about `seconds`, a `pause` [s], slow strokes or none, and 19 oscillations.

    `blocks` are the long block and the 19 oscillations.
    """
    slow_segment, pause_segment = sine(V_PRECONDITIONING, PRECONDITIONING), (PAUSE, 0.0, 0.0, 0.0, 0.0, 0.0)
    long_block = sine(velocity, round(seconds * velocity / (2 * np.pi * AMPLITUDE)))
    segments = [slow_segment, pause_segment, long_block, (pause, *pause_segment[1:])]
    segments += [slow_segment, pause_segment] if slow else []
    segments.append(sine(velocity, OSCILLATIONS))
    pieces = joined(segments)
    return Excitation(pieces, tuple((float(pieces[i, 0]), float(pieces[i, 1])) for i in (2, -1)))


def quasi_static(amplitude: float = AMPLITUDE) -> Excitation:
    """Ramps out, in and back to the middle at 1 mm/s."""
    quarter = amplitude / V_QUASI_STATIC
    ramps = ((quarter, 0.0, 1.0), (2 * quarter, amplitude, -1.0), (quarter, -amplitude, 1.0))
    pieces = joined([(time, 0.0, 0.0, 0.0, start, sign * V_QUASI_STATIC) for time, start, sign in ramps])
    return Excitation(pieces, ())
