"""Which samples of a record are kept: enough for the model to follow the motion from each to the next."""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicHermiteSpline, CubicSpline
from scipy.signal import find_peaks

from twintube.common.arrays import Array
from twintube.data import Record
from twintube.diagnosis.rules import RULES
from twintube.fitting.oscillations import beginnings, segments
from twintube.fitting.strokes import noise, quiet


@dataclass(frozen=True)
class Motion:
    """The motion of a stretch without its noise; arrays (n,) in SI units."""

    time: Array
    stroke: Array
    speed: Array
    slack: float  # [m/s] to which the speed must be followed
    noise: float  # [m] of the stroke, which is not followed


def motion_of(time: Array, stroke: Array) -> Motion:
    """The motion through the samples of a stretch."""
    smooth = quiet(time, stroke)
    speed = CubicSpline(time, smooth)(time, 1) if len(time) > 1 else np.zeros(len(time))
    slack = RULES.followed * float(np.quantile(np.abs(speed), RULES.speed_quantile)) + 1e-9
    return Motion(time, smooth, speed, slack, RULES.noise_followed * noise(stroke)[0])


def thin(record: Record) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """The samples to keep, the oscillation and the stretch of each."""
    kept, cycles, stretches = [], [], []
    number = 0
    for s, part in enumerate(from_rest(record.stroke, segments(record.time, record.stroke))):
        stroke = record.stroke[part]
        motion = motion_of(record.time[part], stroke)
        if record.measurement == "stochastic":
            picks = followed(motion, along(stroke))
            kept.append(part[picks])
            cycles.append(np.full(len(picks), -1))
            stretches.append(np.full(len(picks), s))
            continue
        marks = beginnings(stroke) if np.ptp(stroke) > 0 else np.array([], dtype=int)
        edges = [0, *marks.tolist(), len(part) - 1]
        durations = np.diff(record.time[part][marks]) if len(marks) > 1 else np.array([np.inf])
        for i, (a, b) in enumerate(itertools.pairwise(edges)):
            if b <= a:
                continue
            inside = 0 < i < len(edges) - 2
            span = record.time[part[b]] - record.time[part[a]]
            count = intervals(record, span, inside, float(durations.min()))
            if len(marks) * count > RULES.intervals_most:  # an endurance run
                count = min(count, RULES.intervals_endurance)
            picks = followed(motion, np.append(between(stroke, a, b, count), b))[:-1]
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


def from_rest(stroke: Array, parts: Sequence[NDArray[np.int64]]) -> list[NDArray[np.int64]]:
    """The stretches, each from the last sample of the rest before it on: the step across the rest has no speed in it."""
    begun = list(parts[:1])
    for before, part in itertools.pairwise(parts):
        rest = stroke[before[-1] + 1 : part[0]]
        away = np.abs(rest - np.median(rest)) if len(rest) else rest
        still = np.flatnonzero(away <= 3.0 * np.median(away)) if len(rest) else np.array([], dtype=np.int64)
        begun.append(np.arange(before[-1] + 1 + still[-1], part[-1] + 1) if len(still) else part)
    return begun


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


def along(stroke: Array) -> NDArray[np.int64]:
    """Samples of a random motion: its reversals, and between two of them as many as their share of the range asks for."""
    size = max(float(np.ptp(stroke)), 1e-9)
    turns = [find_peaks(sign * stroke, prominence=RULES.reversal * size)[0] for sign in (1, -1)]
    edges = np.unique(np.concatenate([[0, len(stroke) - 1], *turns]))
    pieces = [edges[:1]]
    for a, b in itertools.pairwise(edges.tolist()):
        count = np.clip(
            np.ceil(0.5 * RULES.intervals_fast * abs(stroke[b] - stroke[a]) / size), RULES.intervals_least, b - a
        )
        pieces.append(np.linspace(a, b, int(count) + 1).round().astype(np.int64)[1:])
    return np.unique(np.concatenate(pieces))


def followed(motion: Motion, picks: NDArray[np.int64]) -> NDArray[np.int64]:
    """The picked samples with as many between them as the model's cubic from pick to pick needs to follow the velocity."""
    for _ in range(RULES.halvings):
        some = slice(picks[0], picks[-1] + 1)
        path = CubicHermiteSpline(motion.time[picks], motion.stroke[picks], motion.speed[picks])
        within = np.clip(np.searchsorted(picks, np.arange(len(motion.time))[some], side="right") - 1, 0, len(picks) - 2)
        # A cubic over h that misses the speed by e in its middle misses the stroke by about e h / 4.
        slack = np.maximum(motion.slack * np.diff(motion.time[picks])[within] / 4.0, motion.noise)
        within = within[np.abs(path(motion.time[some]) - motion.stroke[some]) > slack]
        halves = [(picks[i] + picks[i + 1]) // 2 for i in np.unique(within) if i + 1 < len(picks)]
        more = np.unique(np.concatenate([picks, np.array(halves, dtype=np.int64)]))
        if len(more) == len(picks):
            break
        picks = more
    return picks


def intervals(record: Record, span: float, oscillation: bool, shortest: float) -> int:
    """Number of intervals for a part of a record that lasts `span` [s]."""
    if record.measurement == "quasi-static":
        return RULES.intervals_ramp
    if oscillation:
        return RULES.intervals_fast if span < RULES.block_factor * shortest else RULES.intervals_slow
    if np.isfinite(shortest):
        return max(1, min(RULES.intervals_fast, round(RULES.intervals_fast * span / shortest)))
    return max(1, round(span / RULES.interval_drive))
