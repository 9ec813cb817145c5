"""Lines: oscillations of one fixed frequency that the excitation does not repeat, such as the hum of the mains."""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.fft import next_fast_len, rfft, rfftfreq

from twintube.arrays import Array
from twintube.data import Record
from twintube.diagnosis.result import Signature
from twintube.identification.averaging import NYQUIST
from twintube.identification.oscillations import beginnings, segments

APART = 1.2  # periods at least this factor apart are different ones
FALSE_ALARM = 1e-4  # chance that white noise makes a line in one record; a line needs AGREE records
AGREE = 3
SHARE = 1 / 3  # of the records whose sampling and excitation let a line be seen, that must show it
SIDE = 0.1  # of the frequency of a line, up to which others are its side lobes
PADDING = 4  # bins of the spectrum per independent frequency
NEIGHBOURS = 64  # independent frequencies over which the background of the spectrum is taken
SLACK = 2.0  # above the threshold of a known background: that of few frequencies scatters, and noise is not quite white
STRONG = 0.02  # of the strongest line of a record: weaker ones may be its side lobes
SAME_LINE = 2e-3  # relative; mains keep their frequency within 0.1 Hz of 50
MAINS = (50, 60)  # [Hz]
PHASES = 64  # parts of an oscillation, each with a scatter of its own: force jumps wander
OUTLIER = 4.0  # scatters at which a sample is cut
LEAST_TURNS = 5  # oscillations of one period
FADE = 3.0  # of these, in which a force fades


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
        """Amplitude [N] of a line in the force: that of a swing of 1 N which loses the same with what repeats."""
        swing = np.exp(2j * np.pi * frequency * self.every)
        probe = np.concatenate([less_repeated(self.every, swing, turns) for turns in self.turns])
        return 2 * float(np.abs(np.vdot(probe, self.force)) / np.vdot(probe, probe).real)


def less_repeated(t: Array, force: NDArray[Any], turns: Sequence[tuple[int, int]]) -> NDArray[Any]:
    """The force [N] of oscillations (n,), less a constant, a trend and a fade of it at each phase."""
    grid = np.linspace(0.0, 1.0, int(np.median(np.diff(turns))) + 1)
    number = np.arange(len(turns))
    shapes = np.column_stack([np.ones(len(turns)), number, np.exp(-number / FADE)])
    loops = np.array([np.interp(t[a] + grid * (t[b] - t[a]), t, force) for a, b in turns])
    repeated = shapes @ (np.linalg.pinv(shapes) @ loops)
    pairs = zip(turns, repeated, strict=True)
    return np.concatenate([force[a:b] - np.interp((t[a:b] - t[a]) / (t[b] - t[a]), grid, row) for (a, b), row in pairs])


def unrepeated(record: Record) -> Rest | None:
    """What is left of a record's oscillations; None where there are too few of one period.

    White noise stays white in it but for the harmonics of the excitation.
    """
    t, found, stretches = record.time, [], []
    for part in segments(record.time, record.stroke):
        marks = part[beginnings(record.stroke[part])].tolist()
        usual = np.median(np.diff(t[marks])) if len(marks) > 1 else 0.0
        turns = [(a, b) for a, b in itertools.pairwise(marks) if usual / APART < t[b] - t[a] < usual * APART]
        if len(turns) < LEAST_TURNS:
            continue
        force = less_repeated(t, record.force, turns)
        bins = np.concatenate([(PHASES * (t[a:b] - t[a]) / (t[b] - t[a])).astype(int) for a, b in turns])
        size = np.abs(force)
        medians = np.array([np.median(size[bins == k]) if np.any(bins == k) else 0.0 for k in range(PHASES)])
        scatter = np.maximum(medians, np.median(size) / 2)[bins]
        time = np.concatenate([t[a:b] for a, b in turns])
        found.append((time, np.clip(force, -OUTLIER * scatter, OUTLIER * scatter), scatter))
        stretches.append(turns)
    if not found:
        return None
    time, force, scatter = (np.concatenate(column) for column in zip(*found, strict=True))
    period = float(min(t[b] - t[a] for turns in stretches for a, b in turns))
    return Rest(time, force, scatter, t, stretches, period, float(np.median(np.diff(t)))) if scatter.min() > 0 else None


def peaks(rest: Rest) -> Array:
    """Frequencies [Hz] and powers (n, 2) of the lines of one record, the strongest first.

    The power of white noise relative to its mean is distributed exponentially: the largest of n exceeds ln(n / p) with the
    probability p.
    """
    grid = np.arange(rest.time[0], rest.time[-1], rest.dt)
    white = np.interp(grid, rest.time, rest.force / rest.scatter)
    gaps = np.flatnonzero(np.diff(rest.time) > 10 * rest.dt)
    for i in gaps:
        white[(grid > rest.time[i]) & (grid < rest.time[i + 1])] = 0.0
    size = next_fast_len(PADDING * len(grid))
    power, f = np.abs(rfft(white, size)) ** 2, rfftfreq(size, rest.dt)
    block = PADDING * NEIGHBOURS
    rows = power[: len(power) // block * block].reshape(-1, block)
    ratio = (rows / np.maximum(np.median(rows, axis=1, keepdims=True) / np.log(2), 1e-300)).ravel()
    f = f[: len(ratio)]
    used = (f > 3 / rest.period) & (f < NYQUIST / rest.dt)
    ratio = np.where(used, ratio, 0.0)
    least = max(SLACK * np.log(max(2, used.sum()) / FALSE_ALARM), STRONG * float(ratio.max(initial=0.0)))
    top = np.flatnonzero(ratio > least)
    top = top[np.argsort(-ratio[top])]
    return np.column_stack([f[top], ratio[top]])


def line(records: Sequence[Record]) -> tuple[Signature | None, list[float]]:
    """An oscillation of one frequency in several records of different excitation, and the frequencies [Hz] found.

    White noise passes for a line in less than FALSE_ALARM of the records, and then not at one frequency in AGREE of them.
    """
    rests = [rest for rest in map(unrepeated, records) if rest is not None]
    tops = [peaks(rest) for rest in rests]
    found: list[tuple[float, float, int]] = []
    while any(len(top) for top in tops):
        f = max((top[0] for top in tops if len(top)), key=lambda row: float(row[1]))[0]
        with_it = [i for i, top in enumerate(tops) if len(top) and np.any(np.abs(top[:, 0] / f - 1) < SAME_LINE)]
        periods = [rests[i].period for i in with_it]
        could = [r for r in rests if 3 / r.period < f < NYQUIST / r.dt]
        if len(with_it) >= max(AGREE, SHARE * len(could)) and max(periods) > APART * min(periods):
            own = [tops[i][np.argmax(np.abs(tops[i][:, 0] / f - 1) < SAME_LINE), 0] for i in with_it]
            sizes = [rests[i].amplitude(float(x)) for i, x in zip(with_it, own, strict=True)]
            found.append((float(np.median(own)), float(np.median(sizes)), len(with_it)))
        # A line's side lobes are no lines of their own.
        tops = [top[np.abs(top[:, 0] / f - 1) > SIDE] for top in tops]
    if not found:
        return None, []
    found = sorted(found, key=lambda one: -one[1])[:4]
    told = ", ".join(f"{f:.2f} Hz ({a:.3g} N)" for f, a, _ in found)
    rate = float(np.median([1 / rest.dt for rest in rests]))
    guess = next((f"hum of the {m} Hz mains" for m in MAINS if same(found[0][0], m)), "hum or a vibration of the machine")
    for m in MAINS:
        if m > rate / 2 and same(found[0][0], abs(m - rate * round(m / rate))):
            guess = f"hum of the {m} Hz mains, as seen by sampling at {rate:.0f} Hz"
    text = (
        f"the force swings at {told} in {max(n for *_, n in found)} of {len(records)} records "
        f"whatever the excitation: {guess}"
    )
    return Signature("line", text, float(np.sqrt(sum(a**2 for _, a, _ in found) / 2))), [f for f, *_ in found]


def same(f: float, other: float) -> bool:
    """Whether two frequencies are one as far as mains and sampling keep theirs."""
    return abs(f - other) < 2 * SAME_LINE * other
