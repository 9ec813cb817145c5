"""Excitations of the paper's test rig (Section 2, Table 3)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array, freeze_arrays
from twintube.common.words import shown
from twintube.core.checks import VELOCITY, outside
from twintube.engine.simulate import InputError

OSCILLATIONS = 19
PRECONDITIONING = 6
V_PRECONDITIONING = 0.05  # [m/s]
AMPLITUDE = 0.045  # [m]: given for SA7, SA8; for the others Figure 14 (assumed)

# Maximum velocities of the blocks [m/s]. The paper names 0.05, 0.08, 0.5, 1 and 1.572; the rest is assumed: the usual test
# velocities of a damper bench. 1.572 belongs to them, so that "0.5" is 0.524 and "1" is 1.048.
BLOCKS = (0.05, 0.131, 0.262, 0.393, 0.524, 0.786, 1.048, 1.572)
LEAST_VELOCITY = 0.001  # [m/s] of an oscillation
LEAST_AMPLITUDE, MOST_AMPLITUDE = 1e-4, 0.5  # [m]
LONGEST = 30.0  # [s] of an oscillation: a million samples in a block
SLOWEST, ONE_METRE, FASTEST = BLOCKS[0], BLOCKS[-2], BLOCKS[-1]  # the paper's "0.05 m/s", "1 m/s" and "1.6 m/s"

# Where the first oscillation of a block begins, as a share of a cycle from the middle into rebound; the paper does not say.
STARTS = {"rebound": 0.0, "top": 0.25, "compression": 0.5, "bottom": 0.75}
START = "bottom"
RUN_UP = 0.05  # cycles over which the rig takes up full velocity in 0.1 of a period: about 90 m/s2 at 1.572 m/s (assumed)


@dataclass(frozen=True, repr=False)
class Signal:
    """An excitation: read-only arrays (n,), SI units; `marks` are the bounds of the measured oscillations as samples."""

    time: Array
    stroke: Array
    velocity: Array
    marks: NDArray[np.int64]

    def __post_init__(self) -> None:
        """Freeze the arrays: blocks are cached and shared."""
        freeze_arrays(self)

    def __repr__(self) -> str:
        size, speed, count = np.abs(self.stroke).max(), np.abs(self.velocity).max(), max(len(self.marks) - 1, 0)
        return (
            f"<Signal: {len(self.time)} samples, {self.time[-1] - self.time[0]:.4g} s, {count} measured oscillations, "
            f"up to {size:.4g} m and {speed:.4g} m/s>"
        )


def oscillations(velocity: float, amplitude: float, count: int, dt: float, phase: float = 0.0) -> tuple[Array, Array, Array]:
    """Time [s], stroke [m] and velocity [m/s] of `count` oscillations, each a whole number of samples.

    `phase` [cycles] is the start: 0 in the middle into rebound, 0.25 at the largest stroke.
    """
    omega = velocity / amplitude
    samples = max(32, round(2 * np.pi / omega / dt))
    angle = np.arange(count * samples + 1) * (2 * np.pi / samples)
    at = angle + 2 * np.pi * phase
    return angle / omega, amplitude * np.sin(at), velocity * np.cos(at)


def run_up(velocity: float, amplitude: float, dt: float, phase: float) -> tuple[Array, Array, Array]:
    """Run-up to an oscillation that begins at `phase` [cycles]; arrays as in `oscillations`, without the last sample.

    From rest the speed of the phase rises linearly over RUN_UP cycles. At the ends of the stroke no run-up is needed.
    """
    if phase in (0.25, 0.75):
        return (np.zeros(0),) * 3
    period = 2 * np.pi * amplitude / velocity
    duration = 2 * RUN_UP * period
    share = np.linspace(0.0, 1.0, max(10, int(np.ceil(duration / dt))), endpoint=False)
    at = 2 * np.pi * (phase + RUN_UP * (share**2 - 1.0))
    return share * duration, amplitude * np.sin(at), velocity * share * np.cos(at)


def approach(begin: float, end: float, dt: float) -> tuple[Array, Array, Array]:
    """Slow motion from the stroke `begin` to `end` [m], half a cosine of at most V_PRECONDITIONING, as `oscillations`."""
    distance = end - begin
    duration = 0.5 * np.pi * abs(distance) / V_PRECONDITIONING
    time = np.linspace(0.0, duration, max(2, round(duration / dt) + 1))
    angle = np.pi * time / max(duration, dt)
    speed = 0.5 * np.pi * distance / max(duration, dt)
    return time, begin + 0.5 * distance * (1 - np.cos(angle)), speed * np.sin(angle)


def joined(segments: list[tuple[Array, Array, Array]], pauses: list[float]) -> tuple[Array, Array, Array]:
    """Time [s], stroke [m] and velocity [m/s] of consecutive segments, with a pause [s] before each except the first."""
    time = segments[0][0]
    for (t, _, _), pause in zip(segments[1:], pauses, strict=True):
        time = np.concatenate([time, time[-1] + pause + t])
    return time, np.concatenate([segment[1] for segment in segments]), np.concatenate([segment[2] for segment in segments])


def check_block(velocity: float, amplitude: float, dt: float, start: str) -> None:
    """Raise InputError for a block that no bench drives, or that would have millions of samples."""
    if not LEAST_VELOCITY <= velocity <= VELOCITY["upper"]:
        raise InputError(outside("velocity", velocity, LEAST_VELOCITY, VELOCITY["upper"], "m/s"))
    if not LEAST_AMPLITUDE <= amplitude <= MOST_AMPLITUDE:
        raise InputError(outside("amplitude", amplitude, LEAST_AMPLITUDE, MOST_AMPLITUDE, "m"))
    period = 2 * np.pi * amplitude / velocity
    if period > LONGEST:
        raise InputError(
            f"an oscillation of {amplitude * 1e3:g} mm at {velocity:g} m/s takes {period:.0f} s: at most {LONGEST:g} s"
        )
    if not 0.0 < dt <= LONGEST:
        raise InputError(f"dt = {dt:g} s: must be above 0 and at most {LONGEST:g} s")
    if start not in STARTS:
        raise InputError(f"start = {shown(start)}: must be one of {', '.join(STARTS)}")


def harmonic_block(
    velocity: float,
    amplitude: float = AMPLITUDE,
    dt: float = 5e-4,
    rest: float = 0.0,
    *,
    start: str = START,
    position: float = 0.0,
) -> Signal:
    """Six preconditioning oscillations and 19 of the maximum `velocity` [m/s] with steps of at most about `dt` [s].

    Between the two the damper rests for one step of `rest` [s], by default `dt`: the paper's model does not change at
    rest, but effects such as the decay of foam depend on its length. `start` is one of STARTS. A rig cannot jump to full
    velocity, so a block that starts in the middle begins with a run-up. `position` [m] is the middle of all strokes.

    `velocity` is from 0.001 to 20 m/s, `amplitude` [m] from 0.1 to 500 mm, and an oscillation takes at most 30 s; raises
    InputError.
    """
    return block(velocity, amplitude, dt, rest, start=start, position=position)


@lru_cache(maxsize=64)
def block(velocity: float, amplitude: float, dt: float, rest: float, *, start: str, position: float) -> Signal:
    """As `harmonic_block`, which is made once for the same arguments."""
    check_block(velocity, amplitude, dt, start)
    pause, slow, phase = rest if rest > 0.0 else dt, max(dt, 2e-3), STARTS[start]
    conditioning = oscillations(V_PRECONDITIONING, amplitude, PRECONDITIONING, slow, phase)
    measured = oscillations(velocity, amplitude, OSCILLATIONS, dt, phase)
    lead = run_up(velocity, amplitude, dt, phase)
    segments, pauses = [conditioning, measured], [pause]
    if len(lead[0]):
        transfer = approach(float(conditioning[1][-1]), float(lead[1][0]), slow)
        segments, pauses = [conditioning, transfer, lead, measured], [slow, pause, float(lead[0][1])]
    time, stroke, speed = joined(segments, pauses)
    first, samples = len(time) - len(measured[0]), (len(measured[0]) - 1) // OSCILLATIONS
    return Signal(time, stroke + position, speed, first + samples * np.arange(OSCILLATIONS + 1))
