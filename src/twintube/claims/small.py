"""Claim about small strokes, which the paper expects and did not measure: C17."""

from dataclasses import replace

from twintube.claims.claim import (
    BENCH,
    DEAD,
    EXPECTATION,
    FV_STANDIN,
    MODEL_ERROR,
    PAPER,
    Bench,
    Claim,
    Dampers,
    fluid_relative,
    rounded,
)
from twintube.dampers import Damper
from twintube.dampers.dead_length import collapse_level
from twintube.rig.plan import amplitude
from twintube.rig.signals import BLOCKS

SMALL = (0.010, 0.005, 0.0025)  # [m]: the paper's limit and two amplitudes below it
VELOCITY = BLOCKS[1]  # [m/s]: slow, so that neither foam nor cavitation decides
HALF = 0.5  # oil level between the two measured ones, where the model's dampers differ most
GONE = MODEL_ERROR  # relative work [1] of which not enough is left to lose


def by_amplitude(damper: Damper, level: float, bench: Bench = BENCH) -> list[float]:
    """Mean fluid work of 19 oscillations at 0.131 m/s over intact [1], at the full amplitude and at those of SMALL."""
    strokes = (bench.reach or amplitude(damper), *SMALL)
    return [rounded(fluid_relative(damper, level, VELOCITY, replace(bench, reach=a)).mean()) for a in strokes]


def answer(shares: list[float]) -> str:
    """`more`, `less` or `the same` effect below 10 mm than at the full amplitude, or `gone`: nothing left to lose."""
    full, *_, below, smallest = shares
    if full <= GONE:
        return "gone"
    gains = [full - below, full - smallest]
    return "more" if min(gains) > MODEL_ERROR else "less" if min(gains) < -MODEL_ERROR else "the same"


def c17(dampers: Dampers, bench: Bench = BENCH) -> Claim:
    """Amplitudes below 10 mm."""
    table = {
        f"{name} at {level:.0%}": by_amplitude(damper, level, bench)
        for name, damper in dampers.items()
        for level in sorted({*damper.measured_levels, HALF}, reverse=True)
    }
    answers = {state: answer(shares) for state, shares in table.items()}
    without = [state for state, found in answers.items() if found in ("less", "the same")]
    count = {kind: sum(found == kind for found in answers.values()) for kind in ("more", "the same", "less", "gone")}
    levels = ", ".join(f"{name} {collapse_level(damper):.1%}" for name, damper in dampers.items())
    return Claim(
        id="C17",
        quote="It is likely that small excitation amplitudes of less than 10 mm significantly increase the effect of oil "
        "and gas loss on the SA properties. These small amplitudes were not considered in this study, as the authors do not "
        "consider them to be part of safety critical driving dynamics.",
        statement="amplitudes below 10 mm: oil and gas loss have more effect than at 45 mm (expected, not measured)",
        source="Section 4 (Discussion)",
        tested="fluid work over intact at 0.131 m/s, mean of the 19 oscillations about the middle, every damper at both "
        f"levels of Table 2 and at 50 %: with 5 and with 2.5 mm by more than {MODEL_ERROR:.0%} of the intact work (the "
        f"model's own error) below that of the blocks' amplitude, unless at most {GONE:.0%} is left there",
        holds=not without,
        figures={
            "amplitudes_mm": [rounded(1e3 * (bench.reach or amplitude(next(iter(dampers.values())))), 1)]
            + [1e3 * a for a in SMALL],
            "mean_work_relative_to_intact": table,
            "effect_below_10_mm": answers,
            "states": count,
        },
        needs=f"{DEAD}, {FV_STANDIN}; the paper expects this and did not measure it",
        because="" if not without else PAPER,
        reason=""
        if not without
        else f"no more effect in {', '.join(without)}: equation 23 leaves the whole force while the oil fills both working "
        f"chambers, which in the middle position is so down to (A_1 + A_2) l / 2: {levels}. With a large stroke the rod "
        "takes oil out of them at one end, with a small one it does not",
        no_evidence=EXPECTATION,
    )
