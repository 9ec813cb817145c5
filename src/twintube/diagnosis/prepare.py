"""Records prepared for comparison: thinned, with the mean of the measured force over each interval and its noise."""

import math
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline, PPoly
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from twintube.arrays import Array
from twintube.core.checks import tube_limit
from twintube.data import LoadedDataset, Record
from twintube.data.condition import is_intact
from twintube.data.defects import resolution
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.thinning import thin
from twintube.engine.simulate import checked
from twintube.fitting.intervals import impulse, means
from twintube.fitting.strokes import noise as noise_of_stroke
from twintube.fitting.strokes import quiet

SCATTER = 1.4826  # standard deviation of normal errors over their median absolute value
BEND = math.sqrt(6.0)  # standard deviation of a second difference over that of its values


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
    averaged: float = 0.0  # [s] of the moving mean that the force channel went through
    warmth_known: bool = False  # whether its temperature at the beginning is
    tenth: NDArray[np.int64] | None = None  # (n,) of its intervals, where every second tenth is compared
    before: tuple[float, float, float] = (0.0, 0.0, 0.0)  # `travelled` in the records before it in the dataset

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


def repeat_noise(force: Array, cycle: NDArray[np.int64]) -> float:
    """Standard deviation [N] of what does not repeat from oscillation to oscillation, slow trends apart."""
    numbers, counts = np.unique(cycle[cycle >= 0], return_counts=True)
    if len(numbers) < RULES.repeats:
        return 0.0
    usual = int(np.median(counts))
    rows = [np.interp(np.linspace(0, 1, usual), np.linspace(0, 1, n), force[cycle == i]) for i, n in
            zip(numbers, counts, strict=True) if n == usual]  # fmt: skip
    apart = np.diff(np.array(rows), 2, axis=0) / BEND if len(rows) >= RULES.repeats else np.zeros((0, 1))
    return SCATTER * float(np.median(np.abs(apart))) if apart.size else 0.0


def averaging_noise(held: NDArray[np.int64], alike: float = 0.0) -> Array:
    """Noise of the mean force over intervals of `held` samples (n,), in units of that of a sample: the trapezoidal rule.

    `alike` is the correlation of neighbouring samples.
    """
    counts, of = np.unique(held, return_inverse=True)
    return np.sqrt([covariance(int(n), 0, alike) for n in counts])[of]


@lru_cache(8192)
def covariance(held: int, apart: int, alike: float) -> float:
    """Covariance of the means over two intervals of `held` samples, so many intervals apart: neighbours share a sample.

    In units of the variance of a sample; `alike` is the correlation of neighbouring samples.
    """
    if held > RULES.few_samples:
        summed = held - 0.5 if alike == 0.0 else held * (1.0 + alike) / (1.0 - alike)
        return alike ** (held * apart) * min(summed / held**2, 1.0)
    weight = np.full(held + 1, 1.0 / held)
    weight[[0, -1]] /= 2.0
    at = np.arange(held + 1)
    return float(weight @ alike ** np.abs(apart * held + at[:, None] - at) @ weight)


def bend_variance(held: int, apart: int, alike: float) -> float:
    """Variance of second differences of such means, so many intervals apart."""
    return 6.0 * covariance(held, 0, alike) - 8.0 * covariance(held, apart, alike) + 2.0 * covariance(held, 2 * apart, alike)


def neighbour_noise(force: Array, held: NDArray[np.int64]) -> tuple[float, float]:
    """Standard deviation [N] of a sample from neighbouring intervals, for records without enough oscillations.

    Beside it the correlation of neighbouring samples.
    """
    if len(force) <= 2:
        return 0.0, 0.0
    alike = correlation(force, held)
    white = force / averaging_noise(held, alike)
    most = float(np.median(np.abs(white - np.median(white))))  # a model's errors are no smaller than their noise
    return SCATTER * min(bent(force, held, 1, alike), most), alike


def bent(force: Array, held: NDArray[np.int64], apart: int, alike: float) -> float:
    """Median second difference [N] of means (n,) so many intervals apart, in units of what a sample's noise makes it."""
    counts, of = np.unique(held[apart:-apart], return_inverse=True)
    expected = np.sqrt([bend_variance(int(n), apart, alike) for n in counts])[of]
    return float(np.median(np.abs(force[2 * apart :] - 2.0 * force[apart:-apart] + force[: -2 * apart]) / expected))


def correlation(force: Array, held: NDArray[np.int64]) -> float:
    """Correlation of neighbouring samples of noise, seen in mean forces (n,) [N]; 0 where it is none.

    Second differences of neighbours and of every second interval ask for the same noise with it, those of every third say
    whether it is noise: a model's error is smooth, and gains more.
    """
    if len(force) < RULES.coloured_least:
        return 0.0
    several = np.linspace(0.0, RULES.most_alike, 50) ** (1.0 / float(np.median(held)))
    gains = [bent(force, held, 2, c) / max(bent(force, held, 1, c), np.finfo(float).tiny) for c in several.tolist()]
    alike = float(several[int(np.argmin(np.abs(np.log(np.maximum(gains, np.finfo(float).tiny)))))])
    smooth = bent(force, held, 3, alike) > RULES.smooth * bent(force, held, 1, alike)
    return 0.0 if smooth else alike


def noise(record: "PreparedRecord", force: Array) -> Array:
    """Standard deviation [N] of the mean forces (n,) of a record's intervals, from what in a `force` (n,) does not repeat.

    Of a model's errors that is noise alone; a force itself is sampled at other phases in every oscillation. Oscillations of
    like duration and range share it; what belongs to none has that of the most common, by its number of samples.
    """
    cycle, held = record.cycle, np.maximum(record.samples, 1)
    numbers = np.unique(cycle[cycle >= 0])
    shape = np.array([(held[cycle == i].sum(), np.ptp(record.stroke[cycle == i])) for i in numbers])
    each = np.full(len(force), np.nan)
    left, most, common = list(range(len(numbers))), 0, 0.0
    while left:
        alike = [i for i in left if np.all(np.abs(np.log(shape[i] / shape[left[0]])) < np.log(RULES.alike_turns))]
        left = [i for i in left if i not in alike and i != left[0]]
        inside = np.isin(cycle, numbers[alike])
        size = repeat_noise(force[inside], cycle[inside])
        if size > 0.0:
            usual = round(float(np.median(held[inside])))
            sample = size / np.sqrt(covariance(usual, 0, 0.0))
            each[inside] = sample * averaging_noise(held[inside])
            if len(alike) > most:
                most, common = len(alike), float(sample)
    colour = 0.0
    if common == 0.0:
        common, colour = neighbour_noise(force[record.samples > 0], held[record.samples > 0])
    # Errors of rounding are like in neighbouring samples where no noise is larger than the step.
    rounding = record.resolution / np.sqrt(12.0) if common < record.resolution else 0.0
    every = np.where(np.isnan(each), common * averaging_noise(held, colour), each)
    return np.hypot(every, max(rounding, RULES.least_noise * record.peak))


def prepare(dataset: LoadedDataset) -> list[PreparedRecord]:
    """All records of a dataset; raises InputError where a stroke leaves the tube."""
    begins = [x for x in (beginning_temperature(record) for record in dataset.records) if x is not None]
    usual = float(np.median(begins)) if begins else 0.0
    ready = [prepared(record, tube_limit(dataset.damper.parameters), usual) for record in dataset.records]
    past = np.zeros(3)
    for i, record in enumerate(ready):
        duration, way, square = past.tolist()
        ready[i] = replace(record, before=(duration, way, square))
        past += travelled(record)
    return ready


def travelled(record: PreparedRecord) -> Array:
    """Integrals (3,) of the speed over the time of a record to the powers 0, 1 and 2: duration [s], way [m], and [m2/s]."""
    speed, span = np.abs(record.velocity), np.diff(record.time, prepend=record.time[0])
    return np.array([float(np.sum(span * speed**power)) for power in (0, 1, 2)])


def beginning_temperature(record: Record) -> float | None:
    """Temperature [degC] at the beginning of a record, where known."""
    return float(record.temperature[0]) if record.temperature is not None else record.start_temperature


def prepared(record: Record, limit: float, usual: float = 0.0) -> PreparedRecord:
    """A record prepared; `usual` [degC] is where the records begin, the temperature of the parameter set.

    Raises InputError where its stroke exceeds `limit` [m].
    """
    at, cycle, stretch = thin(record)
    path = CubicSpline(record.time, quiet(record.time, record.stroke))
    stroke, velocity = path(record.time[at]), path(record.time[at], 1)
    checked(stroke, velocity, limit)
    peak = float(np.quantile(np.abs(record.force), RULES.peak_quantile))
    top_speed = float(np.quantile(np.abs(velocity), RULES.speed_quantile))
    force = means(record.time[at], impulse(record.time, record.force)[at])
    levels = resolution(record.force)
    ready = PreparedRecord(
        name=record.name, measurement=record.measurement, oil_level=record.oil_level, gas_preload=int(record.gas_preload),
        split=record.split, top_speed=top_speed, path=path, stroke_noise=noise_of_stroke(record.stroke)[0],
        force=np.concatenate([record.force[:1], force]),
        time=record.time[at], stroke=stroke, velocity=velocity, cycle=cycle, stretch=stretch, noise=np.zeros(len(at)),
        peak=peak, resolution=levels[0] if levels else 0.0, period=float(np.median(np.diff(record.time))),
        samples=np.zeros(len(at), dtype=np.int64),
        judged=comparable(record, at, stretch), edges=np.zeros(len(at)),
        warm=np.zeros(len(at)), gas_pressure=record.gas_pressure if record.gas_preload else None,
    )  # fmt: skip
    held = np.maximum(1, np.diff(at, prepend=at[0] - 1))  # measured samples per interval
    begin = beginning_temperature(record)
    along = record.temperature[at] if record.temperature is not None else np.full(len(at), usual if begin is None else begin)
    ready = replace(ready, samples=held, warm=along - usual, warmth_known=begin is not None)
    return replace(ready, noise=noise(ready, ready.force))


def comparable(record: Record, at: NDArray[np.int64], stretch: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Intervals (n,) that hold usable samples only and no rest; the first sample has no interval before it."""
    bad = np.concatenate([[0], np.cumsum(~record.usable)])
    whole = np.diff(bad[at + 1], prepend=bad[at[0]]) == 0
    moving = np.diff(stretch, prepend=-1) == 0
    moving[0] = False
    # At rest friction holds whatever force it stopped with.
    way = np.abs(np.diff(record.stroke[at], prepend=record.stroke[at[0]]))
    still = (way < RULES.still * np.ptp(record.stroke)).astype(np.int8)
    resting = maximum_filter1d(minimum_filter1d(still, RULES.still_run), RULES.still_run).astype(bool)
    usable = np.asarray(whole & moving & ~resting)
    kicked = np.zeros(len(at), dtype=bool) if record.measurement == "stochastic" else kicks(record, at)
    calm = usable & ~kicked
    return calm if calm.sum() > RULES.kicked_most * usable.sum() else usable


def kicks(record: Record, at: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Intervals (n,) from where a rig changes its speed at once to the next reversal: between samples anything happened."""
    way, span = np.diff(record.stroke[at]), np.maximum(np.diff(record.time[at]), 1e-9)
    speed = np.abs(way) / span
    changes = np.abs(np.diff(speed, prepend=speed[0]))
    # With few samples per oscillation every change is large.
    change = changes > max(RULES.kick * float(speed.max()), RULES.kick_usual * float(np.quantile(changes, 0.9)))
    turned = np.diff(np.sign(way), prepend=np.sign(way[0])) != 0
    # The number of the latest kick lies behind that of the latest reversal.
    number = np.arange(len(way))
    latest = [np.maximum.accumulate(np.where(some, number, -1)) for some in (change, turned & ~change)]
    kicked = (latest[0] >= 0) & (latest[0] >= latest[1])
    return np.concatenate([[False], kicked | np.append(kicked[1:], False)])
