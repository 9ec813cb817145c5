"""Dead lengths that are physically possible, and those at which a claim would hold."""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from twintube.claims.claim import Bench
from twintube.dampers import Damper, ParameterError
from twintube.dampers.dead_length import HIGHEST, LONGEST, SHORTEST, pressure
from twintube.rig.signals import STARTS

STEP = 0.005  # [m]


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
