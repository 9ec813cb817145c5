"""A record prepared for comparison: thinned, with the mean of the measured force over each interval and its noise."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PPoly

from twintube.common.arrays import Array
from twintube.data.records.condition import is_intact


@dataclass(frozen=True)
class PreparedRecord:
    """A record thinned to intervals, each of which ends at its sample; arrays (n,) in SI units."""

    name: str
    measurement: str
    oil_level: float
    gas_preload: float  # share [1]
    top_speed: float  # [m/s]
    path: PPoly  # stroke [m] over time [s], through all measured samples
    stroke_noise: float  # [m] standard deviation of the noise in the samples of the stroke, 0 where it has none
    time: Array
    stroke: Array
    velocity: Array
    cycle: NDArray[np.int64]  # number of the oscillation in its stretch, -1 outside any
    force: Array  # mean measured force [N] of the interval before each sample
    noise: Array  # (n,) standard deviation [N] of each interval's mean force
    peak: float  # largest measured force [N], outliers apart
    resolution: float  # [N] step of the force channel, 0 where none shows
    period: float  # usual time between two measured samples [s]
    samples: NDArray[np.int64]  # measured samples of each interval, 0 where it was not recorded
    judged: NDArray[np.bool_]  # intervals that are compared
    edges: Array  # (n,) standard deviation [N] from what the model's own steps leave open
    kelvins: Array  # (n,) temperature [K]: measured, else the usual one of the other records, else T_curve
    gas_pressure: float | None  # gauge [Pa], where known
    colour: float = 0.0  # correlation of the noise of neighbouring samples of the force
    averaged: float = 0.0  # [s] of the moving mean that the force channel went through
    before: float = 0.0  # [s] that the records before it in the dataset last

    @property
    def intact(self) -> bool:
        """Whether the record is of the full damper with its preload."""
        return is_intact(self.oil_level, self.gas_preload)

    @property
    def begin(self) -> float:
        """Time of the first measured sample [s]; what is simulated before it was not recorded."""
        return float(self.path.x[0])

    def moved(self, delay: float, clock: float) -> tuple[Array, Array]:
        """Stroke [m] and velocity [m/s] (n,) at the moments when the force was measured.

        The force channel is late by `delay` [s] and by the share `clock` of the time since the beginning.
        """
        recorded = self.time >= self.begin
        then = self.time - delay - clock * (self.time - self.begin)
        at = np.clip(then, self.path.x[0], self.path.x[-1])
        speed = np.where(at == then, self.path(at, 1), 0.0)
        return np.where(recorded, self.path(at), self.stroke), np.where(recorded, speed, self.velocity)
