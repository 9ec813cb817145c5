"""Claims about the model variants of Section 3.4: C5, C6 and C14."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from twintube.claims.claim import (
    BENCH,
    DEAD,
    FV_STANDIN,
    MODEL_ERROR,
    READING,
    STAND_IN,
    Bench,
    Claim,
    Dampers,
    relative,
    rounded,
)
from twintube.claims.lengths import holding
from twintube.dampers import Damper
from twintube.dampers.variants import NO_CAVITATION, NO_FOAM
from twintube.rig.plan import velocities
from twintube.rig.signals import STARTS

SHORT = 0.25  # of the scalar factor below the measurement, "in some cases"
# The measurement is unpublished; variant 4 stands for it within the model's error of 10 %. A work measured 25 % above the
# factor is 0.67 to 0.83 of variant 4.
SHORTEST, LONGEST = (rounded(1 - (1 - SHORT) / (1 + side * MODEL_ERROR)) for side in (-1, 1))
APART = rounded((1 + MODEL_ERROR) / (1 - MODEL_ERROR))  # ratio of two variants, each within 10 % of the same measurement
LOW = 0.5  # [m/s]: the paper's "up to a maximum excitation velocity of 0.5 m/s" of the slow records
MEASURED = "measured work (variant 4 stands for it within the paper's 10 %)"


def variants(damper: Damper) -> dict[int, Damper]:
    """Model variants 2 to 4 of Section 3.4."""
    return {2: damper.with_(**NO_FOAM, **NO_CAVITATION), 3: damper.with_(**NO_CAVITATION), 4: damper}


def variant_table(damper: Damper, oscillation: int, bench: Bench = BENCH) -> dict[int, list[float]]:
    """Work relative to intact per variant and block at the higher measured state; variant 1 is the oil level."""
    level = damper.measured_levels[0]
    table = {1: [rounded(level)] * len(velocities(damper))}
    for number, variant in variants(damper).items():
        table[number] = [rounded(relative(variant, level, v, bench)[oscillation]) for v in velocities(damper)]
    return table


def shortfalls(damper: Damper, bench: Bench = BENCH) -> list[float]:
    """How far the scalar factor is below the first oscillation of the full model at each velocity [1]."""
    level = damper.measured_levels[0]
    return [rounded(1 - level / relative(damper, level, v, bench)[0]) for v in velocities(damper)]


def ratio(damper: Damper, bench: Bench = BENCH) -> float:
    """Largest ratio [1] of two of the variants 2 to 4 in the first oscillation at one velocity."""
    table = variant_table(damper, 0, bench)
    full = np.array([table[2], table[3], table[4]])
    return float((full.max(axis=0) / full.min(axis=0)).max())


def first_as_stated(damper: Damper, bench: Bench = BENCH) -> list[str]:
    """What is not as C5 says; empty if it holds."""
    short, widest = shortfalls(damper, bench), ratio(damper, bench)
    found = [f"variants 2 to 4 differ by a factor of {widest:.2f}"] * (widest > APART)
    if not SHORTEST <= max(short) <= LONGEST:
        way = "above" if max(short) > LONGEST else "below"
        found.append(f"the factor falls short by up to {max(short):.0%}, {way} {SHORTEST:.0%} to {LONGEST:.0%}")
    found += [f"it falls short by {min(short):.0%} or more everywhere, not in some cases"] * (min(short) >= SHORTEST)
    return found


def stated_with(bench: Bench) -> Callable[[Damper], bool]:
    """Whether C5 holds for a damper on this bench; the variants are run only where the shortfalls fit."""

    def test(damper: Damper) -> bool:
        short = shortfalls(damper, bench)
        fits = SHORTEST <= max(short) <= LONGEST and min(short) < SHORTEST
        return fits and ratio(damper, bench) <= APART

    return test


def c5(dampers: Dampers, bench: Bench = BENCH) -> Claim:
    """First oscillation at 60 %: the variants agree, the scalar factor is too low."""
    damper = dampers["SA8"]
    table, short = variant_table(damper, 0, bench), shortfalls(damper, bench)
    reason = first_as_stated(damper, bench)
    holds = not reason
    if not holds:
        others = [f"{b.start} {holding(damper, stated_with(b))}" for b in (replace(bench, start=x) for x in STARTS)]
        reason.append("by the start of the blocks it would hold with " + "; ".join(others))
    return Claim(
        id="C5",
        quote="The figure shows that Model Variants 2 to 4 can reproduce the work performed during the first oscillation "
        "with a maximum error of 10%. A simple scalar factor (Model Variant 1) underestimates the work performed by the "
        "first harmonic oscillation by 25% in some cases.",
        statement="SA8, 60 %: variants 2-4 agree on the first oscillation (each within 10 % of the measurement); the scalar "
        "factor is in some cases 25 % below",
        source="Section 3.4, Figure 33",
        tested="variant 4 stands for the measurement within 10 %: at every velocity variants 2 to 4 within a factor of "
        f"{APART}; the scalar factor's largest shortfall between {SHORTEST:.0%} and {LONGEST:.0%}, its least below that",
        holds=holds,
        figures={
            "velocities": list(velocities(damper)),
            "work_relative_to_intact_by_variant": table,
            "largest_ratio_of_variants_2_to_4": rounded(ratio(damper, bench)),
            "largest_shortfall_of_the_scalar_factor": max(short),
            "least_shortfall": min(short),
            "shortfalls": short,
        },
        needs=f"{MEASURED}, {DEAD}, {FV_STANDIN}",
        because="" if holds else STAND_IN,
        reason="; ".join(reason),
        calibrated=("SA8",),
    )


def c6(dampers: Dampers, bench: Bench = BENCH) -> Claim:
    """19th oscillation at 60 % and 1.6 m/s: only cavitation makes it drop."""
    first, table = variant_table(dampers["SA8"], 0, bench), variant_table(dampers["SA8"], 18, bench)
    top = {number: row[-1] for number, row in table.items()}
    dropped = top[4] < min(max(table[4]), first[4][-1]) * (1 - MODEL_ERROR)
    over = min(top[1], top[2], top[3]) > top[4] / (1 - MODEL_ERROR)
    return Claim(
        id="C6",
        quote="When analyzing the 19th oscillation, it can be seen that only Model Variant 4, which takes cavitation "
        "into account, is able to reproduce the decrease in damping work performed for a maximum excitation velocity of "
        "1.6 m/s. All other model variants overestimate the damping work performed for these excitations.",
        statement="SA8, 60 %, 19th oscillation, 1.6 m/s: only variant 4 (cavitation) drops; all others overestimate",
        source="Section 3.4, Figure 33",
        tested="19th oscillation at 1.572 m/s: variant 4 more than 10 % below its own first oscillation and below its "
        "own best velocity; variants 1, 2 and 3 above any measurement that is within 10 % of variant 4",
        holds=dropped and over,
        figures={
            "velocities": list(velocities(dampers["SA8"])),
            "work_relative_to_intact_by_variant": table,
            "at_1.572": top,
        },
        needs=f"{MEASURED}, {DEAD}",
        because="" if dropped and over else READING,
        reason="" if dropped and over else "cavitation takes too little of the work, or the others drop as well",
    )


def c14(dampers: Dampers, bench: Bench = BENCH) -> Claim:
    """What is wrong with a scalar factor."""
    damper = dampers["SA8"]
    level = damper.measured_levels[0]
    found = {v: relative(damper, level, v, bench)[[0, -1]] for v in velocities(damper)}
    wrong = [f"{v:g} m/s: {w.min():.2f}" for v, w in found.items() if v <= LOW and w.min() <= level]
    wrong += [f"{v:g} m/s, first: {w[0]:.2f}" for v, w in found.items() if v > 1.0 and w[0] <= level]
    wrong += [f"{v:g} m/s, 19th: {w[-1]:.2f}" for v, w in found.items() if v > 1.0 and w[-1] >= level]
    return Claim(
        id="C14",
        quote="A scalar factor underestimates the work performed by the SA for excitations at low velocities and for "
        "excitations at velocities higher than 1 m/s and a low number of oscillations. In the case of continuous "
        "excitation with excitation velocities higher than 1 m/s, a scalar factor overestimates the work performed by "
        "the SA.",
        statement="SA8, 60 %: a scalar factor underestimates slow excitation and the first oscillations above 1 m/s, and "
        "overestimates sustained excitation above 1 m/s",
        source="Section 3.4",
        tested=f"the full model's work against the oil level: above it up to {LOW} m/s (1st and 19th oscillation) and in "
        "the first oscillation above 1 m/s; below it in the 19th above 1 m/s",
        holds=not wrong,
        figures={
            "scalar_factor": rounded(level),
            "first_and_19th_by_velocity": {f"{v:g}": [rounded(x) for x in w] for v, w in found.items()},
        },
        needs=f"measured work (the full model stands for it), {DEAD}",
        because="" if not wrong else STAND_IN,
        reason="" if not wrong else f"on the wrong side of {level:.2f}: {', '.join(wrong)}",
    )
