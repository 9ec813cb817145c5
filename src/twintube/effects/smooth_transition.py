"""Gradual build-up: where the paper's k_degr steps, the real one approaches its new value over a length of stroke.

Gas and oil do not part at a sharp level: d k / d|z| = (k_degr - k) / build_up within one direction, solved exactly over
the stroke. At reversal it starts at the new direction's own value, as other valves take over.
"""

import math
from dataclasses import dataclass

from twintube import variables
from twintube.frame import Frame
from twintube.variables import Flow, var

TITLE = "Gradual build-up of the force"
CAUSE = "Oil and gas are mixed near the level between them, so that the force builds up over a stroke instead of at once."
ABSENCE = "The model's force steps where the measured one rises gradually: a residual of both signs around the rise."
DECIDES = "the same velocity with half the amplitude: the build-up is a length of stroke, not a time"
STRENGTH = ("build_up",)
NEEDS_TIME = False


@dataclass(slots=True)
class Parameters(variables.Parameters):
    """Length of the transition."""

    build_up: float = var("smooth_transition", "", "m", "stroke over which k_degr builds up", lower=0, upper=0.03,
                          source="first-order relaxation over the stroke", default=0.0)  # fmt: skip


@dataclass(slots=True)
class State(Frame):
    """The relaxed factor and its direction."""

    k_relaxed: float = var("smooth_transition", "k_degr", "1", "k_degr after the relaxation", default=1.0)
    k_side: float = var("smooth_transition", "", "1", "direction that it belongs to: 1, -1, 0 before the start", default=0.0)


def smooth_transition_transition(p: Parameters, s: State, f: Flow, v: float, dz: float) -> None:
    """Relax the mean over the step, `f.k_mean`, and the value at its end."""
    settled = s.k_degr
    if dz != 0.0:
        side = 1.0 if dz > 0.0 else -1.0
        if side != s.k_side:
            s.k_relaxed = f.k_mean
            s.k_side = side
        way = abs(dz) / p.build_up
        gap = s.k_relaxed - f.k_mean
        s.k_relaxed = f.k_mean + gap * math.exp(-way)
        f.k_mean += gap * (1.0 - math.exp(-way)) / way if way > 1e-9 else gap
        s.k_degr = f.k_mean
    turned = 1.0 if v > 0.0 else -1.0 if v < 0.0 else s.k_side
    if turned != s.k_side:
        # The kernel has settled k_degr for the new direction.
        s.k_relaxed = settled
        s.k_side = turned
        s.k_degr = settled
    elif dz == 0.0:
        s.k_degr = s.k_relaxed
    f.k_degr = s.k_relaxed
