"""Lines: oscillations of fixed frequency that the excitation does not repeat, such as the hum of the mains."""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.fft import next_fast_len, rfft, rfftfreq

from twintube.common.arrays import Array
from twintube.data import Record
from twintube.diagnosis.measurement.outside import Signature
from twintube.diagnosis.rules import RULES
from twintube.fitting.averaging import RULES as AVERAGING
from twintube.fitting.oscillations import beginnings, segments


@dataclass(frozen=True)
class Rest:
    """What does not repeat from oscillation to oscillation, arrays (n,)."""

    time: Array  # [s]
    force: Array  # [N] less what repeats, outliers cut
    scatter: Array  # [N] its usual size at that phase
    every: Array  # (m,) [s] times of the whole record
    turns: list[list[tuple[int, int]]]  # begin and end in `every` of the oscillations of each stretch
    period: float  # [s] of the shortest oscillation
    dt: float  # [s]

    def amplitude(self, frequency: float) -> float:
        """Amplitude [N] of a line in the force, from what a swing of 1 N keeps without what repeats."""
        swing = np.exp(2j * np.pi * frequency * self.every)
        probe = np.concatenate([less_repeated(self.every, swing, turns) for turns in self.turns])
        return 2 * float(np.abs(np.vdot(probe, self.force)) / np.vdot(probe, probe).real)


def less_repeated(t: Array, force: NDArray[Any], turns: Sequence[tuple[int, int]]) -> NDArray[Any]:
    """The force [N] of oscillations (n,), less a constant, a trend and a fade of it at each phase."""
    grid = np.linspace(0.0, 1.0, int(np.median(np.diff(turns))) + 1)
    number = np.arange(len(turns))
    shapes = np.column_stack([np.ones(len(turns)), number, np.exp(-number / RULES.line_fade)])
    loops = np.array([np.interp(t[a] + grid * (t[b] - t[a]), t, force) for a, b in turns])
    repeated = shapes @ (np.linalg.pinv(shapes) @ loops)
    pairs = zip(turns, repeated, strict=True)
    return np.concatenate([force[a:b] - np.interp((t[a:b] - t[a]) / (t[b] - t[a]), grid, row) for (a, b), row in pairs])


def unrepeated(record: Record) -> Rest | None:
    """What is left of a record's oscillations; None where there are too few of equal period.

    White noise stays white in it but for the harmonics of the excitation.
    """
    t, parts, stretches = record.time, [], []
    for part in segments(record.time, record.stroke):
        marks = part[beginnings(record.stroke[part])].tolist()
        usual = np.median(np.diff(t[marks])) if len(marks) > 1 else 0.0
        turns = [
            (a, b)
            for a, b in itertools.pairwise(marks)
            if usual / RULES.line_periods < t[b] - t[a] < usual * RULES.line_periods
        ]
        if len(turns) < RULES.line_turns:
            continue
        force = less_repeated(t, record.force, turns)
        bins = np.concatenate([(RULES.line_phases * (t[a:b] - t[a]) / (t[b] - t[a])).astype(int) for a, b in turns])
        size = np.abs(force)
        medians = np.array([np.median(size[bins == k]) if np.any(bins == k) else 0.0 for k in range(RULES.line_phases)])
        scatter = np.maximum(medians, np.median(size) * RULES.line_least_scatter)[bins]
        time = np.concatenate([t[a:b] for a, b in turns])
        most = RULES.line_outlier * scatter
        parts.append((time, np.clip(force, -most, most), scatter))
        stretches.append(turns)
    if not parts:
        return None
    time, force, scatter = (np.concatenate(column) for column in zip(*parts, strict=True))
    period = float(min(t[b] - t[a] for turns in stretches for a, b in turns))
    return Rest(time, force, scatter, t, stretches, period, float(np.median(np.diff(t)))) if scatter.min() > 0 else None


def peaks(rest: Rest) -> Array:
    """Frequencies [Hz] and powers (n, 2) of the lines of a record, the strongest first.

    The power of white noise relative to its mean is distributed exponentially: the largest of n exceeds ln(n / p) with the
    probability p.
    """
    grid = np.arange(rest.time[0], rest.time[-1], rest.dt)
    white = np.interp(grid, rest.time, rest.force / rest.scatter)
    gaps = np.flatnonzero(np.diff(rest.time) > RULES.line_gap * rest.dt)
    for i in gaps:
        white[(grid > rest.time[i]) & (grid < rest.time[i + 1])] = 0.0
    size = next_fast_len(RULES.line_padding * len(grid))
    power, f = np.abs(rfft(white, size)) ** 2, rfftfreq(size, rest.dt)
    block = RULES.line_padding * RULES.line_background
    rows = power[: len(power) // block * block].reshape(-1, block)
    ratio = (rows / np.maximum(np.median(rows, axis=1, keepdims=True) / np.log(2), 1e-300)).ravel()
    f = f[: len(ratio)]
    used = visible(rest, f)
    ratio = np.where(used, ratio, 0.0)
    chance = RULES.line_slack * np.log(max(2, used.sum()) / RULES.line_alarm)
    least = max(chance, RULES.line_strong * float(ratio.max(initial=0.0)))
    top = np.flatnonzero(ratio > least)
    top = top[np.argsort(-ratio[top])]
    return np.column_stack([f[top], ratio[top]])


def visible(rest: Rest, f: Array) -> Array:
    """Whether lines of the frequencies f (n,) [Hz] can be seen: above the excitation, below half the sampling rate."""
    return np.asarray((f > RULES.line_slowest / rest.period) & (f < AVERAGING.nyquist / rest.dt))


def line(records: Sequence[Record]) -> tuple[Signature | None, list[float]]:
    """An oscillation of fixed frequency in several records of different excitation, and its frequencies [Hz].

    White noise passes for a line in a small share of the records, and then not at equal frequencies in several of them.
    """
    rests = [rest for rest in map(unrepeated, records) if rest is not None]
    tops = [peaks(rest) for rest in rests]
    lines: list[tuple[float, float, int]] = []  # frequency, amplitude, records
    while any(len(top) for top in tops):
        f = max((top[0] for top in tops if len(top)), key=lambda row: float(row[1]))[0]
        near = [np.abs(top[:, 0] / f - 1) < RULES.line_width for top in tops]
        with_it = [i for i, some in enumerate(near) if some.any()]
        periods = [rests[i].period for i in with_it]
        could = [rest for rest in rests if visible(rest, f)]
        enough = len(with_it) >= max(RULES.line_records, RULES.line_share * len(could))
        if enough and max(periods) > RULES.line_periods * min(periods):
            own = [tops[i][np.argmax(near[i]), 0] for i in with_it]
            sizes = [rests[i].amplitude(float(x)) for i, x in zip(with_it, own, strict=True)]
            lines.append((float(np.median(own)), float(np.median(sizes)), len(with_it)))
        # The side lobes of a line are not lines of their own.
        tops = [top[np.abs(top[:, 0] / f - 1) > RULES.line_side] for top in tops]
    if not lines:
        return None, []
    lines = sorted(lines, key=lambda row: -row[1])[: RULES.lines_named]
    swings = ", ".join(f"{f:.2f} Hz ({a:.3g} N)" for f, a, _ in lines)
    text = (
        f"the force swings at {swings} in {max(n for *_, n in lines)} of {len(records)} records "
        f"whatever the excitation: {origin(lines[0][0], float(np.median([1 / rest.dt for rest in rests])))}"
    )
    return Signature("line", text, float(np.sqrt(sum(a**2 for _, a, _ in lines) / 2))), [f for f, *_ in lines]


def origin(frequency: float, rate: float) -> str:
    """What makes a line of a frequency [Hz], as seen by sampling at a rate [Hz]."""
    for m in reversed(RULES.mains):
        if m > rate / 2 and agree(frequency, abs(m - rate * round(m / rate))):
            return f"hum of the {m} Hz mains, as seen by sampling at {rate:.0f} Hz"
    for m in RULES.mains:
        if agree(frequency, m):
            return f"hum of the {m} Hz mains"
    return "hum or a vibration of the machine"


def agree(f: float, other: float) -> bool:
    """Whether two frequencies are equal within what mains and sampling keep."""
    return abs(f - other) < 2 * RULES.line_width * other
