"""The dead lengths of the chambers, which no table gives, from what the paper states about results.

Done once; its result stands in the parameter sets and is marked as assumed. SA8: the first-oscillation work of C5 and
C7. SA1 to SA7: C2, read as "the force rises in the middle of the stroke", the least committal reading of Figure 8.
"""

from dataclasses import dataclass

import numpy as np

from twintube.checks import problems
from twintube.parameters import Damper, ParameterError
from twintube.rig import BLOCKS, harmonic_block
from twintube.simulate import simulate, work_between

GRID = np.arange(0.040, 0.1301, 0.005)  # [m]
C5_SHORTFALL = 0.25  # of the scalar factor below the first oscillation, Figure 33
C7_FIRST = 0.65  # work of the first oscillation at 50 % oil and 1.572 m/s, relative to intact, Figure 34
RAISED = 0.5  # share of the stroke with raised force, C2


@dataclass(frozen=True)
class Fit:
    """One candidate dead length [m], the figures it leads to and its misfit (sum of squares)."""

    dead_length: float
    figures: dict[str, float]
    misfit: float


def relative_work(damper: Damper, oil_level: float, velocity: float) -> tuple[float, float]:
    """Work of the 1st and the 19th oscillation relative to the intact damper [1]."""
    block = harmonic_block(velocity)
    intact = damper.with_(oil_level=1.0, gas_preload=1)
    degraded = damper.with_(oil_level=oil_level, gas_preload=0)
    signal = (block.stroke, block.velocity, block.marks, block.time)
    ratio = [work_between(state, *signal)[[0, -1]] for state in (degraded, intact)]
    first, last = ratio[0] / ratio[1]
    return float(first), float(last)


def raised_share(damper: Damper) -> float:
    """Share [1] of the stroke at the lowest measured oil level and 0.05 m/s where k_degr is above the mixed flow's."""
    block = harmonic_block(BLOCKS[0])
    state = damper.with_(oil_level=damper.measured_levels[-1], gas_preload=0)
    result = simulate(state, block.stroke, block.velocity, block.time)
    last = slice(block.marks[-2], block.marks[-1])
    way = np.abs(np.diff(result.stroke[last]))
    p = damper.parameters
    k = result.k_degr[last][1:]
    mixed = np.where(np.diff(result.stroke[last]) > 0, p.X_Re, p.X_Co1)
    return float(way[k > mixed + 0.05].sum() / way.sum())


def figures(damper: Damper) -> tuple[dict[str, float], dict[str, float]]:
    """The figures that the calibration uses for this damper, and their targets."""
    if damper.name != "SA8":
        return {"raised_share": raised_share(damper)}, {"raised_share": RAISED}
    level = damper.measured_levels[0]
    shortfall = max(1 - level / relative_work(damper, level, v)[0] for v in BLOCKS)
    first = relative_work(damper, 0.5, BLOCKS[-1])[0]
    return {"shortfall": shortfall, "first": first}, {"shortfall": C5_SHORTFALL, "first": C7_FIRST}


def calibrate(damper: Damper) -> list[Fit]:
    """All admissible dead lengths of the grid, best first."""
    fits = []
    for dead_length in GRID:
        try:
            candidate = damper.with_(dead_length=float(dead_length), oil_level=1.0, gas_preload=1)
        except ParameterError:
            continue
        if problems(candidate.parameters):
            continue
        found, targets = figures(candidate)
        if damper.name == "SA8":  # not part of the misfit: what C9 would ask for
            found["left_at_40_percent"] = relative_work(candidate, 0.4, BLOCKS[4])[1]
        misfit = sum((found[name] - targets[name]) ** 2 for name in targets)
        fits.append(Fit(float(dead_length), found, misfit))
    return sorted(fits, key=lambda fit: fit.misfit)
