"""Excitations of the paper's test rig (Section 2, Table 3)."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from twintube.arrays import Array

OSCILLATIONS = 19
PRECONDITIONING = 6
V_PRECONDITIONING = 0.05  # [m/s]
AMPLITUDE = 0.045  # [m]: given for SA7, SA8; for the others Figure 14 (assumed)

# Maximum velocities of the blocks [m/s]. The paper names 0.05, 0.08, 0.5, 1 and 1.572; the rest is assumed: the usual test
# velocities of a damper bench, of which 1.572 is one, so that "0.5" is 0.524 and "1" is 1.048.
BLOCKS = (0.05, 0.131, 0.262, 0.393, 0.524, 0.786, 1.048, 1.572)


@dataclass(frozen=True)
class Signal:
    """An excitation: arrays (n,) in SI units; `marks` are the samples where the measured oscillations begin and end."""

    time: Array
    stroke: Array
    velocity: Array
    marks: NDArray[np.int64]


def oscillations(velocity: float, amplitude: float, count: int, dt: float) -> tuple[Array, Array, Array]:
    """Time [s], stroke [m] and velocity [m/s] of `count` sinusoidal oscillations, a whole number of samples each."""
    omega = velocity / amplitude
    samples = max(32, round(2 * np.pi / omega / dt))
    phase = np.arange(count * samples + 1) * (2 * np.pi / samples)
    return phase / omega, amplitude * np.sin(phase), velocity * np.cos(phase)


@lru_cache(maxsize=64)
def harmonic_block(velocity: float, amplitude: float = AMPLITUDE, dt: float = 5e-4, rest: float = 0.0) -> Signal:
    """Six preconditioning oscillations and 19 of the maximum `velocity` [m/s] with steps of at most about `dt` [s].

    Between the two the damper rests for one step of `rest` [s], by default `dt`: in the paper's model nothing happens
    at rest, effects such as the decay of foam ask for its length. The block starts at full velocity, as a sine does.
    """
    t0, z0, v0 = oscillations(V_PRECONDITIONING, amplitude, PRECONDITIONING, max(dt, 2e-3))
    t, z, v = oscillations(velocity, amplitude, OSCILLATIONS, dt)
    per = (len(t) - 1) // OSCILLATIONS
    return Signal(
        time=np.concatenate([t0, t0[-1] + (rest if rest > 0.0 else dt) + t]),
        stroke=np.concatenate([z0, z]),
        velocity=np.concatenate([v0, v]),
        marks=len(t0) + per * np.arange(OSCILLATIONS + 1),
    )
