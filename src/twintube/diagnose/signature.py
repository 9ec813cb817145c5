"""Causes that no effect describes, recognised from the measured records alone, without any model.

saturation  the force stays at one limit
line        an oscillation of one fixed frequency that the excitation does not repeat
ringing     a resonance: the same frequency stands out of the mean oscillation at all velocities
backlash    no force over the same length of stroke after each reversal
"""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.fft import next_fast_len, rfft, rfftfreq

from twintube.arrays import Array
from twintube.data import Record
from twintube.identify.averaging import NYQUIST, spectrum
from twintube.identify.objective import Harmonic
from twintube.identify.oscillations import beginnings, harmonic, segments, smooth_velocity
from twintube.simulate import InputError

APART = 1.2  # velocities or frequencies at least this factor apart are different ones

SAME_FORCE = 1e-6  # of the limit: forces within it are one value; float32 keeps 6e-8
AT_LIMIT = 20  # samples at the limit, over all records ...
PILE = 5.0  # ... and this many times those at any of the values ...
BELOW = 10  # ... next below it: quantised forces thin out towards their largest, cut ones pile up

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

STEP = 1.03  # from one frequency sought for a resonance to the next
NEAR = 0.2  # of the frequency, in which the middle of the resonance is sought
INSIDE, OUTSIDE = 1.05, (1.5, 2.2)  # its band reaches to these factors, those beside it lie between these
SEEN = 4.0  # power of a band relative to noise
STANDS_OUT = 10 ** (6.0 / 10)  # power of a resonance's band relative to the stronger one beside, in the median record
LOWEST = 5.0  # [Hz]
MANY = 5  # records that must show a resonance

PLAYS = np.geomspace(1e-3, 2e-2, 40)  # lengths of play sought, relative to the range of the stroke
AFTER, LATER = (1.25, 1.6), (2.0, 2.5)  # stretches behind the play, relative to it ...
AT_ONCE = 0.6  # ... and least force of the first relative to the second: a spring that hardens has less
EVEN = 1e-3  # of the largest force: the least that a force is taken to vary
JUMP = 20.0  # force after the play relative to what varies in it: hardly 15 by chance, more than 30 of a play
SAME_PLAY = 1.25  # plays within this factor are the same


@dataclass(frozen=True)
class Signature:
    """What was seen: its name, one sentence about it and the force RMS [N] that it stands for."""

    name: str
    text: str
    size: float


def signatures(records: Sequence[Record]) -> list[Signature]:
    """All that is seen in the records of a dataset, at most one of a name."""
    blocks = oscillating(records)
    vibration, frequencies = line(records)
    found = [saturation(records), vibration, ringing([block for _, block in blocks], frequencies), backlash(blocks)]
    return [one for one in found if one is not None]


def oscillating(records: Sequence[Record]) -> list[tuple[Record, Harmonic]]:
    """The harmonic records with their blocks, without those that hold no full oscillation."""
    found = []
    for record in records:
        try:
            if record.measurement == "harmonic":
                found.append((record, harmonic(record)))
        except InputError:
            continue
    return found


def saturation(records: Sequence[Record]) -> Signature | None:
    """The force at one and the same extreme in several records.

    Quantised forces have many samples of equal value, but fewer and fewer towards the largest one; cut forces pile up there.
    """
    for sign in (1.0, -1.0):
        forces = [sign * record.force for record in records]
        limit = max(float(force.max()) for force in forces)
        near = SAME_FORCE * abs(limit)
        at = [force >= limit - near for force in forces]
        hit = [i for i, some in enumerate(at) if some.any()]
        depths = (limit - np.concatenate([forces[i] for i in hit])) // max(near, 1e-12)
        count, *below = np.unique(depths, return_counts=True)[1][: BELOW + 1].tolist()
        if len(hit) < 2 or not below or count < max(AT_LIMIT, PILE * max(below)):
            continue
        cut = 0.0  # the force as if it went on rising with the velocity from where it first reaches the limit
        for i in hit:
            v = np.abs(smooth_velocity(records[i])[at[i]])
            cut += float(np.sum((limit * np.maximum(v / max(float(np.quantile(v, 0.05)), 1e-9) - 1.0, 0.0)) ** 2))
        size = float(np.sqrt(cut / sum(len(forces[i]) for i in hit)))
        side = "largest" if sign > 0 else "smallest"
        text = (
            f"the force stays at its {side} value of {sign * limit:.0f} N in {len(hit)} of {len(records)} records "
            f"({count} samples): the load cell or its amplifier is at its limit"
        )
        return Signature("saturation", text, size)
    return None


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


def ringing(blocks: Sequence[Harmonic], lines: Sequence[float] = ()) -> Signature | None:
    """One frequency, none of `lines` [Hz], that stands out of the mean oscillation at all velocities.

    Jumps and kinks of the force have spectra that fall smoothly with the frequency, or are shaped by the number of the
    harmonic. A resonance amplifies the harmonics near one frequency, whichever number they have.
    """
    spectra = [spectrum(block) for block in blocks if len(block.marks) > 3]
    top = max((float(f[-1]) for f, *_ in spectra), default=0.0)
    found = []
    for middle in np.exp(np.arange(np.log(LOWEST), np.log(max(LOWEST, top / OUTSIDE[1])), np.log(STEP))):
        if not any(abs(middle / f - 1) < 2 * (INSIDE - 1) for f in lines):
            found.append((*resonance(spectra, float(middle)), float(middle)))
    excess, count, size, middle = max(found, default=(0.0, 0, 0.0, 0.0))
    if excess < STANDS_OUT:
        return None
    # The band that stands out most is not always in the middle of the resonance.
    near = [
        (f[some], amplitude[some] * f[some]) for f, amplitude, _ in spectra if (some := np.abs(f / middle - 1) < NEAR).any()
    ]
    frequency = float(np.median([f[np.argmax(weighted)] for f, weighted in near]))
    text = (
        f"the force rings at about {frequency:.0f} Hz in {count} records, the same at all velocities "
        f"({size:.0f} N RMS): the rig or the mounting of the load cell has a resonance"
    )
    return Signature("ringing", text, size)


def resonance(spectra: Sequence[tuple[Array, Array, Array]], middle: float) -> tuple[float, int, float]:
    """How far the band around a frequency [Hz] stands out of the median record, in how many it does, force RMS [N].

    Zeros where fewer than MANY records of different velocities can show it.
    """
    excess, sizes, speeds = [], [], []
    for f, amplitude, noise in spectra:
        bands = [
            (f > a * middle) & (f < b * middle) for a, b in ((1 / INSIDE, INSIDE), (1 / OUTSIDE[1], 1 / OUTSIDE[0]), OUTSIDE)
        ]
        if not all(band.any() for band in bands) or f[0] > middle / 3:
            continue
        # The amplitudes of a jump fall with the number of the harmonic.
        powers, noises = ([float(np.mean((x[band] * f[band]) ** 2)) for band in bands] for x in (amplitude, noise))
        if max(powers) > SEEN * max(noises):
            excess.append(powers[0] / max(powers[1:]))
            sizes.append(float(np.sum(amplitude[bands[0]] ** 2)) / 2)
            speeds.append(float(f[0]))
    if len(excess) < MANY or max(speeds) < APART * min(speeds):
        return 0.0, 0, 0.0
    return float(np.median(excess)), int(np.sum(np.array(excess) > STANDS_OUT)), float(np.sqrt(np.mean(sizes)))


def play(block: Harmonic) -> tuple[float, float, float]:
    """Play [m] that fits a record best, force of the jump after it relative to what varies in it, force RMS [N]."""
    sides: dict[float, list[Array]] = {1.0: [], -1.0: []}
    span = float(np.ptp(block.stroke[block.marks[0] : block.marks[-1]]))
    for (a, b), sign in itertools.product(itertools.pairwise(block.marks), sides):
        turn = a + int(np.argmax(sign * block.stroke[a:b]))
        rows = slice(turn, turn + (b - a) // 4)
        sides[sign].append(np.column_stack([sign * (block.stroke[turn] - block.stroke[rows]), block.force[rows]]))
    both = [np.concatenate(some) for some in sides.values()]
    least = EVEN * float(np.abs(both[0][:, 1]).max())
    best = (0.0, 0.0, 0.0)
    for length in PLAYS * span:
        # Just after the reversal the stroke hardly moves and friction still turns.
        inner = [means(side, np.linspace(0.2, 0.9, 4) * length) for side in both]
        jump, later = (
            abs(float(np.subtract(*(means(side, np.array(some) * length)[0] for side in both)))) for some in (AFTER, LATER)
        )
        varies = max(float(np.std(np.concatenate(inner))), least)
        if jump > AT_ONCE * later and jump / varies > best[1]:
            # A sine is within the length after two reversals for this share of the time.
            share = np.arccos(np.clip(1 - 2 * length / span, -1, 1)) / np.pi
            best = (float(length), jump / varies, jump / 2 * float(np.sqrt(share)))
    return best


def means(side: Array, edges: Array) -> Array:
    """Mean force (n - 1,) [N] between edges (n,) [m] of the stroke since the reversal; NaN where there are few samples."""
    inside: list[NDArray[np.bool_]] = [(side[:, 0] >= a) & (side[:, 0] < b) for a, b in itertools.pairwise(edges)]
    return np.array([side[some, 1].mean() if some.sum() >= 3 else np.nan for some in inside])


def backlash(blocks: Sequence[tuple[Record, Harmonic]]) -> Signature | None:
    """The same force after both reversals, over the same length of stroke at all velocities of the intact damper.

    A damper without enough oil has dead strokes too, so only records with gas preload decide. A compliance or air in the oil
    makes the force rise soon and slowly instead of late and at once.
    """
    intact = [block for _, block in blocks if block.gas_preload]
    if len(intact) < AGREE:
        return None
    plays = [play(block) for block in intact]
    clear = [one for one in plays if one[1] > JUMP]
    if not clear:
        return None
    length = float(np.median([one[0] for one in clear]))
    alike = [one for one in clear if 1 / SAME_PLAY < one[0] / length < SAME_PLAY]
    if len(alike) < max(AGREE, 0.6 * len(intact)):
        return None
    size = float(np.sqrt(np.mean([one[2] ** 2 for one in alike])))
    text = (
        f"after each reversal the force stays the same over {1e3 * length:.2f} mm of stroke and then jumps, in {len(alike)} "
        f"of {len(intact)} records of the intact damper: the joint of the rod or of the housing has play"
    )
    return Signature("backlash", text, size)
