"""A reference run for importers: input and output of the default experiment, computed by the interpreted model."""

import math
from functools import lru_cache

from twintube.core import model
from twintube.core.effects import Parameters, State
from twintube.core.outputs import total_force
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import Damper

AMPLITUDE = 0.9  # of the largest stroke
FREQUENCY = 2.0  # [Hz]
STEP, STEPS = 1e-3, 2000


def rows(damper: Damper) -> list[tuple[float, float, float, float, float]]:
    """Time [s], stroke [m], velocity [m/s] at the start of each step, force [N] and k_degr [1] then."""
    return rows_of(damper.parameters)


@lru_cache(maxsize=1)  # an FMU has them as a table and as a picture
def rows_of(p: Parameters) -> list[tuple[float, float, float, float, float]]:
    """`rows` of a parameter set."""
    d, s, f = blank(Derived), blank(State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, 0.0)
    model.advance(p, d, s, f, 0.0, 0.0, 0.0, 0.0)
    stroke = [AMPLITUDE * p.stroke_max * math.sin(2 * math.pi * FREQUENCY * i * STEP) for i in range(STEPS + 2)]
    run = []
    for i in range(STEPS + 1):
        # The mean velocity of the coming step, so that the damper meets the strokes.
        v = (stroke[i + 1] - stroke[i]) / STEP
        run.append((i * STEP, stroke[i], v, total_force(s), s.k_degr))
        model.advance(p, d, s, f, stroke[i] + v * STEP, v, v, STEP)
    return run


def files(damper: Damper) -> dict[str, str]:
    """`input.csv` (time, stroke, velocity) and `reference.csv` (time, force, k_degr), one row per communication point."""
    run = rows(damper)
    given = ['"time","stroke","velocity"', *(f"{t!r},{z!r},{v!r}" for t, z, v, _, _ in run)]
    computed = ['"time","force","k_degr"', *(f"{t!r},{force!r},{k!r}" for t, _, _, force, k in run)]
    return {"input.csv": "\n".join(given) + "\n", "reference.csv": "\n".join(computed) + "\n"}
