"""The plate of a suspension tester: its motion under the wheel, and the answer of the force cycle by cycle.

The plate stands under the wheel and moves up and down by a crank: its amplitude is the same at every frequency. A motor runs
it up, then a flywheel lets it coast to rest, and the frequency passes the resonance of the wheel slowly.
"""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from twintube.common.arrays import Array, freeze_arrays
from twintube.core.checks import outside
from twintube.engine.simulate import InputError

SLOWEST = 1.0  # [Hz] the last cycles of the coast are not evaluated: too few of them, too long
POINTS = 64  # per cycle, at which its harmonic is taken


BOUNDS = {  # of a plate's values: smallest, largest, unit
    "amplitude": (1e-4, 0.02, "m"),
    "top": (10.0, 40.0, "Hz"),
    "run_up": (0.5, 30.0, "s"),
    "hold": (0.0, 30.0, "s"),
    "coast": (3.0, 600.0, "s"),
    "drift": (-0.05, 0.05, "1"),
}


@dataclass(frozen=True)
class Plate:
    """How the plate moves; raises InputError for a value that no tester has."""

    amplitude: float = 3e-3  # [m] half of the plate's whole way
    top: float = 25.0  # [Hz] highest frequency
    run_up: float = 3.0  # [s] in which the motor reaches it (assumed)
    hold: float = 2.0  # [s] at the highest frequency (assumed)
    coast: float = 15.0  # [s] to rest without the motor (assumed)
    drift: float = 0.0  # share by which the frequency changes while it is held

    def __post_init__(self) -> None:
        """Refuse what no tester does."""
        for name, (low, high, unit) in BOUNDS.items():
            message = outside(f"plate.{name}", getattr(self, name), low, high, unit)
            if message:
                raise InputError(message)


@dataclass(frozen=True)
class Motion:
    """The plate's motion; arrays (n,) with the time step `dt` [s]."""

    plate: Plate
    dt: float
    time: Array  # [s]
    frequency: Array  # [Hz]
    angle: Array  # [rad] of the crank, 0 at the start
    heights: Array  # [m]
    rates: Array  # [m/s]
    coasting: slice  # the samples after the motor is off

    def __post_init__(self) -> None:
        """Shared by all who read it."""
        freeze_arrays(self)


@dataclass(frozen=True)
class Cycles:
    """The whole cycles of the coast, from fast to slow; arrays (n,)."""

    frequency: Array  # [Hz] in the middle of the cycle
    answer: Array  # complex [N/m]: first harmonic of the plate force over that of the plate's height

    def __post_init__(self) -> None:
        """Shared by all who read it."""
        freeze_arrays(self)

    @property
    def phase(self) -> Array:
        """Angle [deg] by which the force leads the plate's height, from -90 to 270."""
        degrees: Array = np.mod(np.degrees(np.angle(self.answer)) + 90.0, 360.0) - 90.0
        return degrees

    @property
    def wheel_frequency(self) -> float:
        """Resonance [Hz] of the wheel in the record: the cycle of the largest force."""
        return float(self.frequency[np.argmax(np.abs(self.answer))])


def motion(plate: Plate, dt: float) -> Motion:
    """The plate run up, held and coasting to rest at a constant deceleration (assumed: friction, not air, brakes it)."""
    corners = np.cumsum([0.0, plate.run_up, plate.hold, plate.coast])
    time = np.arange(0.0, corners[-1] + 0.5 * dt, dt)
    frequency = np.interp(time, corners, [0.0, plate.top, plate.top * (1.0 + plate.drift), 0.0])
    angle = 2 * np.pi * np.concatenate([[0.0], np.cumsum(0.5 * (frequency[1:] + frequency[:-1])) * dt])
    return Motion(
        plate=plate,
        dt=dt,
        time=time,
        frequency=frequency,
        angle=angle,
        heights=plate.amplitude * np.sin(angle),
        rates=plate.amplitude * np.cos(angle) * 2 * np.pi * frequency,
        coasting=slice(int(np.searchsorted(time, corners[2])), len(time)),
    )


def cycles(run: Motion, force: Array) -> Cycles:
    """First harmonic of the plate force (n,) [N] in each whole cycle of the coast down to SLOWEST."""
    used = np.flatnonzero(run.frequency >= SLOWEST)
    used = used[used >= run.coasting.start]
    angle = run.angle[used]
    turns = np.arange(np.ceil(angle[0] / (2 * np.pi)), np.floor(angle[-1] / (2 * np.pi)))
    at = 2 * np.pi * (turns[:, None] + np.arange(POINTS) / POINTS)
    harmonic = (CubicSpline(angle, force[used])(at) * np.exp(-1j * at)).mean(axis=1)
    # The height is a sin(angle), whose harmonic is a / 2j.
    return Cycles(np.interp(2 * np.pi * (turns + 0.5), run.angle, run.frequency), harmonic * 2j / run.plate.amplitude)
