"""A harmonic record with its oscillations marked."""

import itertools
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array, freeze_arrays
from twintube.data.records.condition import is_intact
from twintube.fitting.intervals import impulse, means


@dataclass(frozen=True)
class Harmonic:
    """A harmonic record: arrays (n,) in SI units, `marks` (c + 1,) where its oscillations begin and end."""

    oil_level: float
    gas_preload: float
    time: Array
    stroke: Array
    velocity: Array
    force: Array
    marks: NDArray[np.int64]
    name: str = ""
    averaged: float = 0.0  # [s] of the moving mean that the force channel went through, see averaging.py
    recorded: Array | None = None  # (n,) the stroke with its noise, where `stroke` is without
    usable: NDArray[np.bool_] | None = None  # (n,) False where the force says nothing; None: everywhere it does
    gas_pressure: float | None = None  # gauge, cold [Pa], of gas that is there

    def __post_init__(self) -> None:
        """Shared by all who read it."""
        freeze_arrays(self)

    @property
    def intact(self) -> bool:
        """Whether the record is of the full damper with its preload."""
        return is_intact(self.oil_level, self.gas_preload)

    @property
    def stroke_noise(self) -> float:
        """Root mean square [m] of what was taken out of the recorded stroke in the measured oscillations."""
        if self.recorded is None:
            return 0.0
        span = slice(int(self.marks[0]), int(self.marks[-1]) + 1)
        return float(np.sqrt(np.mean((self.recorded[span] - self.stroke[span]) ** 2)))

    def counts(self, span: slice) -> NDArray[np.bool_]:
        """Which samples of a span say something (m,)."""
        return np.ones(len(self.time[span]), dtype=bool) if self.usable is None else self.usable[span]

    @property
    def top_speed(self) -> float:
        """Largest speed of a sine with the measured amplitude and frequency [m/s]: free of the noise of a velocity."""
        first, last = int(self.marks[0]), int(self.marks[-1])
        turns = 2 * np.pi * (len(self.marks) - 1) / (self.time[last] - self.time[first])
        return float(turns * np.ptp(self.stroke[first:last]) / 2)

    def thinned(self, samples: int) -> "Harmonic":
        """The record with about `samples` per oscillation, before the first mark as densely as in an oscillation.

        Its force is the mean since the sample before, see intervals.py. Unlike a diagnosis, which looks at a record from end
        to end, a search needs whole oscillations only: their works are compared.
        """
        pieces, marks = [], [0]
        edges = [0, *self.marks.tolist()] if self.marks[0] > 0 else self.marks.tolist()
        for a, b in itertools.pairwise(edges):
            lead = a == 0 and self.marks[0] > 0
            count = min(b - a, 6 * samples if lead else samples)
            pieces.append(np.unique(np.linspace(a, b, count + 1).round().astype(np.int64))[:-1])
            marks.append(marks[-1] + len(pieces[-1]))
        pieces.append(np.array([edges[-1]]))
        kept = np.concatenate(pieces)
        new_marks = marks[1:] if self.marks[0] > 0 else marks
        time, stroke, velocity = (x[kept] for x in (self.time, self.stroke, self.velocity))
        force = np.concatenate([self.force[kept[:1]], means(time, impulse(self.time, self.force)[kept])])
        recorded = None if self.recorded is None else self.recorded[kept]
        usable = None if self.usable is None else self.usable[kept]
        return replace(
            self, time=time, stroke=stroke, velocity=velocity, force=force, marks=np.array(new_marks), recorded=recorded,
            usable=usable,
        )  # fmt: skip

    def works(self) -> Array:
        """Measured work [J] of each oscillation: the area of the loop."""
        slices = [slice(a, b + 1) for a, b in zip(self.marks[:-1], self.marks[1:], strict=True)]
        return np.array([np.trapezoid(self.force[s], self.stroke[s]) for s in slices])
