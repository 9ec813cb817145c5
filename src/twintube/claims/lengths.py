"""Dead lengths that are physically possible, and those at which a claim would hold."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from twintube.claims.claim import Bench
from twintube.dampers import Damper, ParameterError
from twintube.rig.signals import STARTS

STEP = 0.005  # [m]
# Piston with its valves 30-40 mm, foot valve 15-25 mm, rebound stop 15-35 mm and clearances; stops fill the annulus only.
SHORTEST, LONGEST = 0.060, 0.110  # [m]
# Absolute pressures [bar]: a twin-tube damper is filled to 6-8 bar (PMG Sinter, 18 Nov 2021) or 3.4-6.9 bar (KYB), a
# monotube to 20-30 bar (kfz-tech.de). No pressure is published for full compression; a low-pressure seal is assumed to stay
# below the monotube's filling pressure.
FILLED, HIGHEST = 6.0, 20.0


def pressure(damper: Damper) -> float:
    """Absolute gas pressure [bar] of the intact damper at full compression; infinite if the oil leaves no volume for it."""
    p = damper.parameters
    rod, piston = 0.25 * math.pi * p.D_PR**2, 0.25 * math.pi * p.D_li**2
    chambers = (2 * piston - rod) * 0.5 * (p.h_l - p.dead_length)
    gas = 0.25 * math.pi * (p.D_a**2 - p.D_la**2) * p.h_l - (p.V_oil - chambers)
    gas_compressed = gas - rod * p.stroke_max
    return FILLED * gas / gas_compressed if gas_compressed > 0.0 else math.inf


def candidates(damper: Damper) -> Iterator[Damper]:
    """The damper with every dead length of the grid that is within the bounds."""
    for dead_length in np.arange(SHORTEST, LONGEST + 0.5 * STEP, STEP):
        try:
            candidate = damper.with_(dead_length=round(float(dead_length), 6), oil_level=1.0, gas_preload=1)
        except ParameterError:
            continue
        if pressure(candidate) <= HIGHEST:
            yield candidate


def dead_lengths_that_hold(damper: Damper, test: Callable[[Damper], bool]) -> str:
    """The dead lengths at which a test holds, as text."""
    lengths = [f"{candidate.parameters.dead_length * 1e3:.0f}" for candidate in candidates(damper) if test(candidate)]
    if not lengths:
        return f"at no admissible dead length from {SHORTEST * 1e3:.0f} mm on"
    return f"at dead lengths of {', '.join(lengths)} mm"


def starts_that_hold(bench: Bench, test: Callable[[Bench], bool]) -> list[str]:
    """The starts of the blocks (keys of STARTS) with which a test holds."""
    return [start for start in STARTS if test(replace(bench, start=start))]


def starts_in_words(starts: list[str]) -> str:
    """Starts of blocks as text."""
    return f"with blocks that begin at: {', '.join(starts)}" if starts else "with no start of the blocks"
