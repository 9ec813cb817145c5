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
from twintube.claims.lengths import dead_lengths_that_hold
from twintube.dampers import Damper
from twintube.dampers.variants import NO_CAVITATION, NO_FOAM
from twintube.rig.plan import velocities
from twintube.rig.signals import STARTS

SHORT = 0.25  # shortfall of the scalar factor below the measurement, "in some cases"
# The measurement is unpublished; variant 4 replaces it, within the model's error of 10 %. A shortfall of 25 % below the
# measurement is then one of 17 to 32 % below variant 4.
SHORTEST, LONGEST = (rounded(1 - (1 - SHORT) / (1 + side * MODEL_ERROR)) for side in (-1, 1))
APART = rounded((1 + MODEL_ERROR) / (1 - MODEL_ERROR))  # ratio of two variants, each within 10 % of the same measurement
LOW = 0.5  # [m/s]: the paper's "up to a maximum excitation velocity of 0.5 m/s" of the slow records
MEASURED = "measured work (replaced by variant 4, within the paper's 10 %)"


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
    """Shortfall [1] of the scalar factor below the first oscillation of the full model, by velocity."""
    level = damper.measured_levels[0]
    return [rounded(1 - level / relative(damper, level, v, bench)[0]) for v in velocities(damper)]


def ratio(damper: Damper, bench: Bench = BENCH) -> float:
    """Largest ratio [1] of two of the variants 2 to 4 in the first oscillation at one velocity."""
    table = variant_table(damper, 0, bench)
    full = np.array([table[2], table[3], table[4]])
    return float((full.max(axis=0) / full.min(axis=0)).max())


def c5_violations(damper: Damper, bench: Bench = BENCH) -> list[str]:
    """Statements of C5 that do not hold, as text; empty if it holds."""
    shortfall, largest_ratio = shortfalls(damper, bench), ratio(damper, bench)
    violations = [f"variants 2 to 4 differ by a factor of {largest_ratio:.2f}"] * (largest_ratio > APART)
    if not SHORTEST <= max(shortfall) <= LONGEST:
        side = "above" if max(shortfall) > LONGEST else "below"
        violations.append(f"the factor falls short by up to {max(shortfall):.0%}, {side} {SHORTEST:.0%} to {LONGEST:.0%}")
    if min(shortfall) >= SHORTEST:
        violations.append(f"it falls short by {min(shortfall):.0%} or more everywhere, not in some cases")
    return violations


def stated_with(bench: Bench) -> Callable[[Damper], bool]:
    """A test of a damper: whether C5 holds on this bench. The variants are run only if the shortfalls fit."""

    def test(damper: Damper) -> bool:
        shortfall = shortfalls(damper, bench)
        fits = SHORTEST <= max(shortfall) <= LONGEST and min(shortfall) < SHORTEST
        return fits and ratio(damper, bench) <= APART

    return test


def c5(dampers: Dampers, bench: Bench = BENCH) -> Claim:
    """First oscillation at 60 %: the variants agree, the scalar factor is too low."""
    damper = dampers["SA8"]
    table, shortfall = variant_table(damper, 0, bench), shortfalls(damper, bench)
    reason = c5_violations(damper, bench)
    holds = not reason
    if not holds:
        other_starts = [
            f"{start} {dead_lengths_that_hold(damper, stated_with(replace(bench, start=start)))}" for start in STARTS
        ]
        reason.append("with another start of the blocks it would hold: " + "; ".join(other_starts))
    return Claim(
        id="C5",
        quote="The figure shows that Model Variants 2 to 4 can reproduce the work performed during the first oscillation "
        "with a maximum error of 10%. A simple scalar factor (Model Variant 1) underestimates the work performed by the "
        "first harmonic oscillation by 25% in some cases.",
        statement="SA8, 60 %: variants 2-4 agree on the first oscillation (each within 10 % of the measurement); the scalar "
        "factor is in some cases 25 % below",
        source="Section 3.4, Figure 33",
        tested="variant 4 replaces the measurement, within 10 %: at every velocity variants 2 to 4 within a factor of "
        f"{APART}; the scalar factor's largest shortfall between {SHORTEST:.0%} and {LONGEST:.0%}, its smallest below that",
        holds=holds,
        figures={
            "velocities": list(velocities(damper)),
            "work_relative_to_intact_by_variant": table,
            "largest_ratio_of_variants_2_to_4": rounded(ratio(damper, bench)),
            "largest_shortfall_of_the_scalar_factor": max(shortfall),
            "least_shortfall": min(shortfall),
            "shortfalls": shortfall,
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
    overestimated = min(top[1], top[2], top[3]) > top[4] / (1 - MODEL_ERROR)
    return Claim(
        id="C6",
        quote="When analyzing the 19th oscillation, it can be seen that only Model Variant 4, which takes cavitation "
        "into account, is able to reproduce the decrease in damping work performed for a maximum excitation velocity of "
        "1.6 m/s. All other model variants overestimate the damping work performed for these excitations.",
        statement="SA8, 60 %, 19th oscillation, 1.6 m/s: only variant 4 (cavitation) drops; all others overestimate",
        source="Section 3.4, Figure 33",
        tested="19th oscillation at 1.572 m/s: variant 4 more than 10 % below its own first oscillation and below its "
        "own best velocity; variants 1, 2 and 3 above any measurement that is within 10 % of variant 4",
        holds=dropped and overestimated,
        figures={
            "velocities": list(velocities(dampers["SA8"])),
            "work_relative_to_intact_by_variant": table,
            "at_1.572": top,
        },
        needs=f"{MEASURED}, {DEAD}",
        because="" if dropped and overestimated else READING,
        reason=""
        if dropped and overestimated
        else "cavitation reduces the work too little, or the other variants drop as well",
    )


def c14(dampers: Dampers, bench: Bench = BENCH) -> Claim:
    """Errors of a scalar factor."""
    damper = dampers["SA8"]
    level = damper.measured_levels[0]
    ratios = {v: relative(damper, level, v, bench)[[0, -1]] for v in velocities(damper)}
    violations = [f"{v:g} m/s: {w.min():.2f}" for v, w in ratios.items() if v <= LOW and w.min() <= level]
    violations += [f"{v:g} m/s, first: {w[0]:.2f}" for v, w in ratios.items() if v > 1.0 and w[0] <= level]
    violations += [f"{v:g} m/s, 19th: {w[-1]:.2f}" for v, w in ratios.items() if v > 1.0 and w[-1] >= level]
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
        holds=not violations,
        figures={
            "scalar_factor": rounded(level),
            "first_and_19th_by_velocity": {f"{v:g}": [rounded(x) for x in w] for v, w in ratios.items()},
        },
        needs=f"measured work (replaced by the full model), {DEAD}",
        because="" if not violations else STAND_IN,
        reason="" if not violations else f"on the wrong side of {level:.2f}: {', '.join(violations)}",
    )
