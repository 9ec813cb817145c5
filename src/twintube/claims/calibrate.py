"""Calibration of the dead lengths of the chambers, which are unpublished, from all claims about a damper.

Done once; the result is in the parameter sets and marked as assumed. Each claim gives deviations in units of its own
tolerance: two-sided where the text gives a number, one-sided where it gives a limit, 1 where a stated effect is absent.
The sum of their squares is evaluated on a grid within physical bounds.
"""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from twintube.claims import fast, levels, slow, variants
from twintube.claims.claim import BENCH, FRONT, MODEL_ERROR, VISIBLE, Bench
from twintube.claims.lengths import candidates
from twintube.dampers import Damper, ParameterError
from twintube.dampers.dead_length import HIGHEST, SHORTEST
from twintube.rig.plan import oil_levels
from twintube.rig.signals import FASTEST, ONE_METRE

FLAT = 0.05  # misfits within this of the smallest one are equivalent
SHORTFALL_TOLERANCE = 0.5 * (variants.LONGEST - variants.SHORTEST)


@dataclass(frozen=True)
class Fit:
    """One dead length [m]: its deviations by claim, each in units of the claim's tolerance, and the sum of their squares."""

    dead_length: float
    deviations: dict[str, float]
    misfit: float


@dataclass(frozen=True)
class Calibration:
    """Fits of all admissible dead lengths, the range [m] of equivalent ones, and the chosen one in its middle."""

    fits: tuple[Fit, ...]
    range: tuple[float, float]
    chosen: Fit


def excess(value: float, limit: float, tolerance: float) -> float:
    """Excess of a value over its limit, in tolerances [1]."""
    return max(0.0, value - limit) / tolerance


def deviations(damper: Damper, bench: Bench = BENCH) -> dict[str, float]:
    """Deviation of the damper from each claim about it, in tolerances [1]."""
    low, states = damper.measured_levels[-1], oil_levels(damper)
    terms = {
        "C1": float(max(slow.spread(damper, level, bench) for level in states) > VISIBLE),
        "C2": float(sum(not rise.exists for rise in slow.rises(damper, bench).values())),
        "C3": max(excess(fast.growth(damper, low, v, bench), 0.0, MODEL_ERROR) for v in (ONE_METRE, FASTEST)),
        "C16": len(levels.not_falling(damper, bench)) / levels.comparisons(damper) / MODEL_ERROR,
    }
    if damper.name in FRONT:
        terms["C4"] = excess(fast.drop_at_top(damper, bench), 1.0, MODEL_ERROR)
    if damper.name == "SA1":
        terms["C3 rise"] = float(sum(late <= early for early, late in fast.travel_to_rise(damper, low, bench).values()))
    if damper.name in ("SA1", "SA7"):
        terms["C15"] = float(max(slow.steps(damper, bench).values()) < MODEL_ERROR)
    return terms | (sa8_deviations(damper, bench) if damper.name == "SA8" else {})


def sa8_deviations(damper: Damper, bench: Bench) -> dict[str, float]:
    """Deviations from the claims of Sections 3.4 and 4, which concern SA8 only."""
    shortfalls = variants.shortfalls(damper, bench)
    first, last = levels.half_full(damper, bench)
    table = levels.transition(damper, bench)
    remaining = max(levels.remaining_at_40(table))
    return {
        "C5 largest": (max(shortfalls) - variants.SHORT) / SHORTFALL_TOLERANCE,
        "C5 least": excess(min(shortfalls), variants.SHORTEST, SHORTFALL_TOLERANCE),
        "C5 variants": excess(variants.ratio(damper, bench), variants.APART, MODEL_ERROR),
        "C7 first": (first - levels.FIRST) / (levels.FIRST * MODEL_ERROR),
        "C7 last": excess(last, levels.ALMOST_ZERO, MODEL_ERROR),
        "C9 60%": excess(-min(table["60%"]), -levels.HALF, levels.HALF * MODEL_ERROR),
        "C9 40%": excess(remaining, levels.ALMOST_ZERO, MODEL_ERROR),
    }


def fit(damper: Damper, bench: Bench = BENCH) -> Fit:
    """The fit of the damper's present dead length."""
    terms = deviations(damper, bench)
    return Fit(damper.parameters.dead_length, terms, sum(x * x for x in terms.values()))


def calibrate(damper: Damper, bench: Bench = BENCH) -> Calibration:
    """Calibrate the dead length: the middle of all that are equivalent to the smallest misfit; raises ParameterError."""
    trial_dampers = list(candidates(damper))
    if not trial_dampers:
        raise ParameterError(
            f"{damper.name}: the gas pressure exceeds {HIGHEST:g} bar at every dead length from {SHORTEST * 1e3:g} mm"
        )
    with ThreadPoolExecutor() as pool:
        fits = list(pool.map(lambda candidate: fit(candidate, bench), trial_dampers))
    smallest = min(f.misfit for f in fits)
    equivalent = [f for f in fits if f.misfit <= smallest + FLAT]
    middle = 0.5 * (equivalent[0].dead_length + equivalent[-1].dead_length)
    chosen = min(equivalent, key=lambda f: (round(abs(f.dead_length - middle), 6), f.misfit))
    return Calibration(tuple(fits), (equivalent[0].dead_length, equivalent[-1].dead_length), chosen)
