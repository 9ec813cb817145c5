"""Causes that no effect describes, recognised from the measured records alone, without any model.

saturation  the force stays at one limit
line        an oscillation of one fixed frequency that the excitation does not repeat
ringing     a resonance: the same frequency stands out of the mean oscillation at all velocities
backlash    no force over the same length of stroke after each reversal
"""

import itertools
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from twintube.arrays import Array
from twintube.data import Record
from twintube.diagnosis.line import line
from twintube.diagnosis.result import Signature
from twintube.engine.simulate import InputError
from twintube.identification.averaging import spectrum
from twintube.identification.objective import Harmonic
from twintube.identification.oscillations import harmonic, smooth_velocity

APART = 1.2  # velocities or frequencies at least this factor apart are different ones

SAME_FORCE = 1e-6  # of the limit: forces within it are one value; float32 keeps 6e-8
AT_LIMIT = 20  # samples at the limit, over all records ...
PILE = 5.0  # ... and this many times those at any of the values ...
BELOW = 10  # ... next below it: quantised forces thin out towards their largest, cut ones pile up

AGREE = 3  # records that must show a play

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
