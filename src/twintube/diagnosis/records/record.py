"""A record prepared for comparison: thinned, with the mean of the measured force over each interval and its noise."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PPoly

from twintube.arrays import Array
from twintube.data.condition import is_intact
from twintube.diagnosis.rules import RULES


@dataclass(frozen=True)
class PreparedRecord:
    """A record thinned to intervals, each of which ends at its sample; arrays (n,) in SI units."""

    name: str
    measurement: str
    oil_level: float
    gas_preload: int
    split: str | None
    top_speed: float  # [m/s]
    path: PPoly  # stroke [m] over time [s], through all measured samples
    stroke_noise: float  # [m] standard deviation of the noise in the samples of the stroke, 0 where it has none
    time: Array
    stroke: Array
    velocity: Array
    cycle: NDArray[np.int64]  # number of the oscillation in its stretch, -1 outside any
    stretch: NDArray[np.int64]  # number of the stretch between rests
    force: Array  # mean measured force [N] of the interval before each sample
    noise: Array  # (n,) standard deviation [N] of each interval's mean force
    peak: float  # largest measured force [N], outliers apart
    resolution: float  # [N] step of the force channel, 0 where none shows
    period: float  # usual time between two measured samples [s]
    samples: NDArray[np.int64]  # measured samples of each interval, 0 where it was not recorded
    judged: NDArray[np.bool_]  # intervals that are compared
    edges: Array  # (n,) standard deviation [N] from what the model's own steps leave open
    warm: Array  # (n,) [K] warmer than records usually begin, 0 where no temperature is known
    gas_pressure: float | None  # gauge [Pa], where known
    colour: float = 0.0  # correlation of the noise of neighbouring samples of the force
    averaged: float = 0.0  # [s] of the moving mean that the force channel went through
    warmth_known: bool = False  # whether its temperature at the beginning is
    tenth: NDArray[np.int64] | None = None  # (n,) of its intervals, where every second tenth is compared
    before: tuple[float, float, float] = (0.0, 0.0, 0.0)  # `travelled` in the records before it in the dataset
    before_fill: tuple[float, float, float] = (0.0, 0.0, 0.0)  # the like in those before the damper got its present fill

    @property
    def intact(self) -> bool:
        """Whether the record is of the full damper with its preload."""
        return is_intact(self.oil_level, self.gas_preload)

    @property
    def begin(self) -> float:
        """Time of the first measured sample [s]; what is simulated before it was not recorded."""
        return float(self.path.x[0])

    @property
    def part(self) -> NDArray[np.int64]:
        """The part of the record (n,) that each interval belongs to; 0 where it is not divided."""
        return self.tenth if self.tenth is not None else np.zeros(len(self.time), dtype=np.int64)

    def alternate(self, half: int) -> "PreparedRecord":
        """The record with every second tenth of its compared intervals, from the first or the second on."""
        before: NDArray[np.int64] = np.cumsum(self.judged) - self.judged
        tenth = (RULES.parts * before) // max(1, int(self.judged.sum()))
        tenth = np.minimum(tenth, RULES.parts - 1).astype(np.int64)
        return replace(self, tenth=tenth, judged=self.judged & (tenth % 2 == half))

    def moved(self, delay: float, clock: float) -> tuple[Array, Array]:
        """Stroke [m] and velocity [m/s] (n,) at the moments when the force was measured.

        The force channel is late by `delay` [s] and by the share `clock` of the time since the beginning.
        """
        recorded = self.time >= self.begin
        then = self.time - delay - clock * (self.time - self.begin)
        at = np.clip(then, self.path.x[0], self.path.x[-1])
        speed = np.where(at == then, self.path(at, 1), 0.0)
        return np.where(recorded, self.path(at), self.stroke), np.where(recorded, speed, self.velocity)
