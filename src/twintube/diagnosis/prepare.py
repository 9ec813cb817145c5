"""Records prepared for comparison: thinned, with the mean of the measured force over each interval and its noise."""

import itertools
import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from twintube.arrays import Array
from twintube.core.checks import tube_limit
from twintube.data import LoadedDataset, Record
from twintube.data.condition import is_intact
from twintube.diagnosis.rules import RULES
from twintube.engine.simulate import checked
from twintube.fitting.intervals import impulse, means
from twintube.fitting.oscillations import beginnings, reaches, segments, slopes

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
    dense_time: Array
    impulse: Array  # integral of the measured force over time [N s], at the dense samples
    time: Array
    stroke: Array
    velocity: Array
    cycle: NDArray[np.int64]  # number of the oscillation in its stretch, -1 outside any
    stretch: NDArray[np.int64]  # number of the stretch between rests
    noise: Array  # (n,) standard deviation [N] of each interval's mean force
    peak: float  # largest measured force [N], outliers apart
    averaged: float = 0.0  # [s] of the moving mean that the force channel went through

    @property
    def intact(self) -> bool:
        """Whether the record is of the full damper with its preload."""
        return is_intact(self.oil_level, self.gas_preload)

    def measured(self, delay: float = 0.0) -> Array:
        """Mean measured force (n,) [N] of the interval before each sample, the force read `delay` [s] later."""
        times = np.clip(self.time + delay, self.dense_time[0], self.dense_time[-1])
        force = means(times, np.interp(times, self.dense_time, self.impulse))
        return np.concatenate([force[:1], force])


def thin(record: Record) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """The samples to keep, the oscillation and the stretch of each."""
    kept, cycles, stretches = [], [], []
    number = 0
    parts = segments(record.time, record.stroke)
    for s, part in enumerate(parts):
        stroke = record.stroke[part]
        marks = beginnings(stroke) if record.measurement != "stochastic" and np.ptp(stroke) > 0 else np.array([], dtype=int)
        edges = [0, *marks.tolist(), len(part) - 1]
        durations = np.diff(record.time[part][marks]) if len(marks) > 1 else np.array([np.inf])
        for i, (a, b) in enumerate(itertools.pairwise(edges)):
            if b <= a:
                continue
            inside = 0 < i < len(edges) - 2
            span = record.time[part[b]] - record.time[part[a]]
            count = intervals(record, span, inside, float(durations.min()))
            picks = between(stroke, a, b, count)
            kept.append(part[picks])
            cycles.append(np.full(len(picks), number if inside else -1))
            stretches.append(np.full(len(picks), s))
            number += inside
        kept.append(part[-1:])
        cycles.append(np.array([number - 1 if len(marks) > 1 else -1]))
        stretches.append(np.array([s]))
    at = np.concatenate(kept)
    first = np.unique(at, return_index=True)[1]
    return at[first], np.concatenate(cycles)[first], np.concatenate(stretches)[first]


def between(stroke: Array, a: int, b: int, count: int) -> NDArray[np.int64]:
    """About `count` samples from a to b, b apart, evenly between the extremes of the stroke, which are among them.

    An interval across a reversal would have two directions, of which a step of the model knows a single one.
    """
    turns = sorted({a, b, a + int(np.argmax(stroke[a : b + 1])), a + int(np.argmin(stroke[a : b + 1]))})
    pieces = []
    for low, high in itertools.pairwise(turns):
        share = max(1, min(high - low, round(count * (high - low) / (b - a))))
        pieces.append(np.linspace(low, high, share + 1).round().astype(np.int64)[:-1])
    return np.unique(np.concatenate(pieces))


def intervals(record: Record, span: float, oscillation: bool, shortest: float) -> int:
    """Number of intervals for a part of a record that lasts `span` [s]."""
    if record.measurement == "quasi-static":
        return RULES.intervals_ramp
    if oscillation:
        return RULES.intervals_fast if span < RULES.block_factor * shortest else RULES.intervals_slow
    if record.measurement == "harmonic" and np.isfinite(shortest):
        return max(1, min(RULES.intervals_fast, round(RULES.intervals_fast * span / shortest)))
    return max(1, round(span / RULES.interval_drive))


def repeat_noise(force: Array, cycle: NDArray[np.int64]) -> float:
    """Standard deviation [N] of what does not repeat from oscillation to oscillation, slow trends apart."""
    numbers, counts = np.unique(cycle[cycle >= 0], return_counts=True)
    if len(numbers) < RULES.repeats:
        return 0.0
    usual = int(np.median(counts))
    rows = [np.interp(np.linspace(0, 1, usual), np.linspace(0, 1, n), force[cycle == i]) for i, n in
            zip(numbers, counts, strict=True) if n == usual]  # fmt: skip
    bent = np.diff(np.array(rows), 2, axis=0) / BEND if len(rows) >= RULES.repeats else np.zeros((0, 1))
    return SCATTER * float(np.median(np.abs(bent))) if bent.size else 0.0


def sample_noise(record: Record, per_interval: float) -> float:
    """Standard deviation [N] of an interval's mean from neighbouring samples, for records without enough oscillations."""
    bent = np.diff(record.force, 2) / BEND
    return SCATTER * float(np.median(np.abs(bent))) / np.sqrt(max(1.0, per_interval)) if len(bent) else 0.0


def jumps(record: Record, at: NDArray[np.int64]) -> Array:
    """Error bound [N] of the mean forces (n,) of the intervals that end at the samples `at`, from jumps of the force.

    Where between two samples it jumped is not known. Where samples lie at equal phases in all oscillations that does not
    average out.
    """
    change = np.abs(np.diff(record.force, prepend=record.force[0]))
    around = np.maximum(np.roll(change, 1), np.roll(change, -1))
    beyond = np.maximum(change - around - RULES.jump_scatters * sample_noise(record, 1.0), 0.0)
    unknown = 0.5 * beyond * np.diff(record.time, prepend=record.time[0])
    sums = np.concatenate([[0.0], np.cumsum(unknown**2)])[at + 1]
    spans = np.diff(record.time[at], prepend=np.inf)
    return np.sqrt(np.diff(sums, prepend=sums[0])) / np.maximum(spans, 1e-9)


def prepare(dataset: LoadedDataset) -> list[PreparedRecord]:
    """All records of a dataset; raises InputError where a stroke leaves the tube."""
    return [prepared(record, tube_limit(dataset.damper.parameters)) for record in dataset.records]


def prepared(record: Record, limit: float) -> PreparedRecord:
    """A record prepared; raises InputError where its stroke exceeds `limit` [m]."""
    at, cycle, stretch = thin(record)
    stroke, velocity = record.stroke[at], slopes(record.time, record.stroke, at, reaches(at, len(record.time)))
    checked(stroke, velocity, limit)
    peak = float(np.quantile(np.abs(record.force), RULES.peak_quantile))
    top_speed = float(np.quantile(np.abs(velocity), RULES.speed_quantile))
    ready = PreparedRecord(
        name=record.name, measurement=record.measurement, oil_level=record.oil_level, gas_preload=int(record.gas_preload),
        split=record.split, top_speed=top_speed, dense_time=record.time, impulse=impulse(record.time, record.force),
        time=record.time[at], stroke=stroke, velocity=velocity, cycle=cycle, stretch=stretch, noise=np.zeros(len(at)),
        peak=peak,
    )  # fmt: skip
    held = np.maximum(1, np.diff(at, prepend=at[0] - 1))  # measured samples per interval
    fastest = (stretch == stretch[np.argmax(np.abs(velocity))]) & (cycle >= 0)
    usual = float(np.median(held[fastest])) if fastest.any() else float(np.median(held))
    noise = repeat_noise(ready.measured()[fastest], cycle[fastest]) or sample_noise(record, usual)
    noises = np.maximum(noise * np.sqrt(usual / held), RULES.least_noise * peak)
    return replace(ready, noise=np.hypot(noises, jumps(record, at)))
