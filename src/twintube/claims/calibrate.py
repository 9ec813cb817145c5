"""The dead lengths of the chambers, which no table gives, from all claims that speak of a damper.

Done once; the result stands in the parameter sets and is marked as assumed. Each claim gives deviations in units of its
own tolerance: two-sided where the text has a figure, one-sided where it has a limit, 1 where something is missing
altogether. Their squares are summed over a grid within physical bounds.
"""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from twintube.claims import fast, levels, slow, variants
from twintube.claims.claim import BENCH, FRONT, MODEL_ERROR, VISIBLE, Bench
from twintube.claims.lengths import HIGHEST, SHORTEST, candidates
from twintube.dampers import Damper, ParameterError

FLAT = 0.05  # misfits closer to the least than this are as good
SHORTFALL_TOLERANCE = 0.5 * (variants.LONGEST - variants.SHORTEST)


@dataclass(frozen=True)
class Fit:
    """One dead length [m]: its deviations by claim, each in units of the claim's tolerance, and the sum of their squares."""

    dead_length: float
    deviations: dict[str, float]
    misfit: float


@dataclass(frozen=True)
class Calibration:
    """All admissible dead lengths [m], those as good as the best one, and the chosen one, in the middle of these."""

    fits: tuple[Fit, ...]
    range: tuple[float, float]
    chosen: Fit


def beyond(value: float, limit: float, tolerance: float) -> float:
    """How far a value is above its limit, in tolerances [1]."""
    return max(0.0, value - limit) / tolerance


def deviations(damper: Damper, bench: Bench = BENCH) -> dict[str, float]:
    """How far the damper is from each claim that speaks of it, in tolerances [1]."""
    low, states = damper.measured_levels[-1], (1.0, *damper.measured_levels)
    found = {
        "C1": float(max(slow.apart(damper, level, bench) for level in states) > VISIBLE),
        "C2": float(sum(not rise.is_there for rise in slow.rises(damper, bench).values())),
        "C3": max(beyond(fast.growth(damper, low, v, bench), 0.0, MODEL_ERROR) for v in (fast.ONE, fast.TOP)),
        "C16": len(levels.not_falling(damper, bench)) / levels.comparisons(damper) / MODEL_ERROR,
    }
    if damper.name in FRONT:
        found["C4"] = beyond(fast.drop_at_top(damper, bench), 1.0, MODEL_ERROR)
    if damper.name == "SA1":
        found["C3 rise"] = float(sum(late <= early for early, late in fast.rise_way(damper, low, bench).values()))
    if damper.name in ("SA1", "SA7"):
        found["C15"] = float(max(slow.steps(damper, bench).values()) < MODEL_ERROR)
    return found | (of_sa8(damper, bench) if damper.name == "SA8" else {})


def of_sa8(damper: Damper, bench: Bench) -> dict[str, float]:
    """The deviations from the claims of Sections 3.4 and 4, which speak of SA8 only."""
    short = variants.shortfalls(damper, bench)
    first, last = levels.half_full(damper, bench)
    table = levels.transition(damper, bench)
    left = max(levels.left_at_40(table))
    return {
        "C5 largest": (max(short) - variants.SHORT) / SHORTFALL_TOLERANCE,
        "C5 least": beyond(min(short), variants.SHORTEST, SHORTFALL_TOLERANCE),
        "C5 variants": beyond(variants.ratio(damper, bench), variants.APART, MODEL_ERROR),
        "C7 first": (first - levels.FIRST) / (levels.FIRST * MODEL_ERROR),
        "C7 last": beyond(last, levels.ALMOST_ZERO, MODEL_ERROR),
        "C9 60%": beyond(-min(table["60%"]), -levels.HALF, levels.HALF * MODEL_ERROR),
        "C9 40%": beyond(left, levels.ALMOST_ZERO, MODEL_ERROR),
    }


def fit(damper: Damper, bench: Bench = BENCH) -> Fit:
    """The damper's own dead length with its deviations."""
    found = deviations(damper, bench)
    return Fit(damper.parameters.dead_length, found, sum(x * x for x in found.values()))


def calibrate(damper: Damper, bench: Bench = BENCH) -> Calibration:
    """The dead length with the least misfit, or the middle of those that are as good; raises ParameterError."""
    some = list(candidates(damper))
    if not some:
        raise ParameterError(
            f"{damper.name}: no dead length from {SHORTEST * 1e3:g} mm on keeps the gas below {HIGHEST:g} bar"
        )
    with ThreadPoolExecutor() as pool:
        fits = list(pool.map(lambda candidate: fit(candidate, bench), some))
    least = min(f.misfit for f in fits)
    good = [f for f in fits if f.misfit <= least + FLAT]
    middle = 0.5 * (good[0].dead_length + good[-1].dead_length)
    chosen = min(good, key=lambda f: (round(abs(f.dead_length - middle), 6), f.misfit))
    return Calibration(tuple(fits), (good[0].dead_length, good[-1].dead_length), chosen)
