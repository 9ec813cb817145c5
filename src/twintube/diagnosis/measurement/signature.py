"""Causes that no effect describes, recognised from the measured records alone, without any model.

saturation  the force stays at a limit
line        an oscillation of fixed frequency that the excitation does not repeat
ringing     a resonance: a frequency stands out of the mean oscillation at all velocities
backlash    no force over a fixed length of stroke after each reversal
"""

import itertools
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array
from twintube.data import Record
from twintube.data.check.defects import clipped
from twintube.data.records.condition import INTACT_LEVEL
from twintube.diagnosis.measurement.line import line
from twintube.diagnosis.measurement.outside import Signature
from twintube.diagnosis.rules import RULES
from twintube.engine.simulate import InputError
from twintube.fitting.averaging import RULES as AVERAGING
from twintube.fitting.averaging import spectrum
from twintube.fitting.harmonic import Harmonic
from twintube.fitting.oscillations import harmonic


def signatures(records: Sequence[Record]) -> list[Signature]:
    """All that is seen in the records of a dataset, at most one of each name."""
    blocks = oscillating(records)
    vibration, frequencies = line(records)
    several = [saturation(records), vibration, ringing([block for _, block in blocks], frequencies), backlash(blocks)]
    return [signature for signature in several if signature is not None]


def oscillating(records: Sequence[Record]) -> list[tuple[Record, Harmonic]]:
    """The harmonic records with their blocks, without those that hold no full oscillation."""
    blocks = []
    for record in records:
        try:
            if record.measurement == "harmonic":
                blocks.append((record, harmonic(record)))
        except InputError:
            continue
    return blocks


def saturation(records: Sequence[Record]) -> Signature | None:
    """The force of some records is cut at a limit; those samples are not compared, so nothing limits what they hide."""
    cut = {}
    for record in records:
        limits = clipped(record.force, np.abs(record.velocity))
        if limits.samples.any():
            cut[record.name] = (limits, int(limits.samples.sum()))
    if not cut:
        return None
    values = sorted({f"{x:.0f} N" for limits, _ in cut.values() for x in (limits.low, limits.high) if x is not None})
    text = (
        f"the force is clipped at {' and '.join(values)} in {', '.join(cut)} ({sum(n for _, n in cut.values())} samples, "
        "left out here): the load cell or its amplifier is at its limit"
    )
    return Signature("saturation", text, np.inf)


def ringing(blocks: Sequence[Harmonic], lines: Sequence[float] = ()) -> Signature | None:
    """A frequency, other than `lines` [Hz], that stands out of the mean oscillation at all velocities.

    Jumps and kinks of the force have spectra that fall smoothly with the frequency, or are shaped by the number of the
    harmonic. A resonance amplifies the harmonics near its frequency, whichever number they have.
    """
    spectra = [spectrum(block) for block in blocks if len(block.marks) > AVERAGING.turns]
    top = max((float(f[-1]) for f, *_ in spectra), default=0.0)
    lowest = np.log(RULES.ring_lowest)
    highest = np.log(max(RULES.ring_lowest, top / RULES.ring_outside[1]))
    bands = []
    for middle in np.exp(np.arange(lowest, highest, np.log(RULES.ring_step))):
        if not any(abs(middle / f - 1) < 2 * (RULES.ring_inside - 1) for f in lines):
            bands.append((*resonance(spectra, float(middle)), float(middle)))
    excess, count, size, middle = max(bands, default=(0.0, 0, 0.0, 0.0))
    if excess < RULES.ring_power:
        return None
    # The band that stands out most is not always in the middle of the resonance.
    near = [
        (f[some], amplitude[some] * f[some])
        for f, amplitude, _ in spectra
        if (some := np.abs(f / middle - 1) < RULES.ring_middle).any()
    ]
    frequency = float(np.median([f[np.argmax(weighted)] for f, weighted in near]))
    text = (
        f"the force rings at about {frequency:.0f} Hz in {count} records, at all velocities alike "
        f"({size:.0f} N RMS): the rig or the mounting of the load cell has a resonance"
    )
    return Signature("ringing", text, size, repeats=True)


def resonance(spectra: Sequence[tuple[Array, Array, Array]], middle: float) -> tuple[float, int, float]:
    """How far the band around a frequency [Hz] stands out of the median record, in how many it does, force RMS [N].

    Zeros where too few records of different velocities can show it.
    """
    excess, sizes, speeds = [], [], []
    inside, (near, far) = RULES.ring_inside, RULES.ring_outside
    edges = ((1 / inside, inside), (1 / far, 1 / near), (near, far))
    for f, amplitude, noise in spectra:
        bands = [(f > a * middle) & (f < b * middle) for a, b in edges]
        if not all(band.any() for band in bands) or f[0] > middle / RULES.ring_harmonic:
            continue
        # The amplitudes of a jump fall with the number of the harmonic.
        powers, noises = ([float(np.mean((x[band] * f[band]) ** 2)) for band in bands] for x in (amplitude, noise))
        if max(powers) > RULES.ring_seen * max(noises):
            excess.append(powers[0] / max(powers[1:]))
            sizes.append(float(np.sum(amplitude[bands[0]] ** 2)) / 2)
            speeds.append(float(f[0]))
    if len(excess) < RULES.ring_records or max(speeds) < RULES.speeds_apart * min(speeds):
        return 0.0, 0, 0.0
    return float(np.median(excess)), int(np.sum(np.array(excess) > RULES.ring_power)), float(np.sqrt(np.mean(sizes)))


def play(block: Harmonic) -> tuple[float, float, float]:
    """Play [m] that fits a record best, force of the jump after it relative to what varies in it, force RMS [N]."""
    sides: dict[float, list[Array]] = {1.0: [], -1.0: []}
    span = float(np.ptp(block.stroke[block.marks[0] : block.marks[-1]]))
    for (a, b), sign in itertools.product(itertools.pairwise(block.marks), sides):
        turn = a + int(np.argmax(sign * block.stroke[a:b]))
        rows = slice(turn, turn + (b - a) // 4)
        sides[sign].append(np.column_stack([sign * (block.stroke[turn] - block.stroke[rows]), block.force[rows]]))
    both = [np.concatenate(some) for some in sides.values()]
    least = RULES.play_even * float(np.abs(both[0][:, 1]).max())
    best = (0.0, 0.0, 0.0)
    low, high, edges = RULES.play_inside
    for length in np.geomspace(*RULES.plays) * span:
        # Just after the reversal the stroke hardly moves and friction still turns.
        inner = [means(side, np.linspace(low, high, edges) * length) for side in both]
        jump, later = (
            abs(float(np.subtract(*(means(side, np.array(some) * length)[0] for side in both))))
            for some in (RULES.play_after, RULES.play_later)
        )
        varies = max(float(np.std(np.concatenate(inner))), least)
        if jump > RULES.play_at_once * later and jump / varies > best[1]:
            # A sine is within the length after two reversals for this share of the time.
            share = np.arccos(np.clip(1 - 2 * length / span, -1, 1)) / np.pi
            best = (float(length), jump / varies, jump / 2 * float(np.sqrt(share)))
    return best


def means(side: Array, edges: Array) -> Array:
    """Mean force (n - 1,) [N] between edges (n,) [m] of the stroke since the reversal; NaN where there are few samples."""
    inside: list[NDArray[np.bool_]] = [(side[:, 0] >= a) & (side[:, 0] < b) for a, b in itertools.pairwise(edges)]
    return np.array([side[some, 1].mean() if some.sum() >= RULES.play_samples else np.nan for some in inside])


def backlash(blocks: Sequence[tuple[Record, Harmonic]]) -> Signature | None:
    """Equal forces after both reversals, over an equal length of stroke at all velocities of the intact damper.

    A damper without enough oil has dead strokes too, so only records with all of the gas decide. A compliance or air
    in the oil makes the force rise soon and slowly instead of late and at once.
    """
    intact = [block for _, block in blocks if block.gas_preload >= INTACT_LEVEL]
    if len(intact) < RULES.play_records:
        return None
    plays = [play(block) for block in intact]
    clear = [fit for fit in plays if fit[1] > RULES.play_jump]
    if not clear:
        return None
    length = float(np.median([fit[0] for fit in clear]))
    alike = [fit for fit in clear if 1 / RULES.play_alike < fit[0] / length < RULES.play_alike]
    if len(alike) < max(RULES.play_records, RULES.play_share * len(intact)):
        return None
    size = float(np.sqrt(np.mean([fit[2] ** 2 for fit in alike])))
    text = (
        f"after each reversal the force stays constant over {1e3 * length:.2f} mm of stroke and then jumps, in {len(alike)} "
        f"of {len(intact)} records of the intact damper: the joint of the rod or of the housing has play"
    )
    return Signature("backlash", text, size, repeats=True)
