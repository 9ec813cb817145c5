"""What a record is to be: the motion of the rig, and what is said about it."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import numpy as np

from twintube.common.arrays import Array

RNG = np.random.Generator


@dataclass(frozen=True)
class Motion:
    """What the rig does in a record; arrays (n,), the file begins at the sample `first`."""

    time: Array  # [s]
    stroke: Array  # [m]
    velocity: Array  # [m/s]
    first: int
    period: float = 0.0  # [s] of a cycle, 0 where there is none
    steady: int = 0  # sample from which cycles are equal


@dataclass(frozen=True)
class Record:
    """What the file says about a record, and its place in the campaign."""

    name: str
    number: int
    measurement: str
    level: float  # as recorded
    preload: bool
    temperature: float  # [degC] at the start
    began: float  # [s] since the start of the campaign


def span(rng: RNG, low: float, high: float) -> float:
    """Evenly over the logarithm."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def chance(rng: RNG, share: float) -> bool:
    """True in a `share` [1] of the draws."""
    return bool(rng.random() < share)


def sign(rng: RNG) -> float:
    """Either sign."""
    return float(rng.choice([-1.0, 1.0]))


@dataclass(kw_only=True)
class Channels:
    """What the sensors give over the fine steps, arrays (n,); faults change it in place."""

    record: Record
    motion: Motion
    stroke: Array = field(default_factory=lambda: np.empty(0))
    force: Array = field(default_factory=lambda: np.empty(0))
    temperature: Array | None = None  # [degC] of the outer tube
    force_time: Callable[[Array], Array] | None = None  # when the force of a sample was taken, over its time in the file
    unit: tuple[float, float] = (1.0, 1.0)  # factors of force and stroke on the way to the file
    stretch: float = 1.0  # times in the file over true ones

    @property
    def time(self) -> Array:
        """Times [s] since the rig began to move."""
        return self.motion.time

    @property
    def start(self) -> float:
        """Time [s] of the first sample of the file."""
        return float(self.motion.time[self.motion.first])


def rms(values: Sequence[Array]) -> float:
    """Of all values together."""
    return math.sqrt(sum(float(np.sum(v**2)) for v in values) / sum(map(len, values)))


@cache
def with_numba(function: Callable[..., Any]) -> Callable[..., Any]:
    """A function compiled at its first call."""
    import numba

    compiled_function: Callable[..., Any] = numba.njit(error_model="numpy", nogil=True)(function)
    return compiled_function
