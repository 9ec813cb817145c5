"""Rubber stops near the ends of the stroke: a progressive spring on each side, part of the gas force, and its hysteresis.

F = F_stop ((|z| - onset) / 10 mm)^power_stop beyond the onset: F_stop is the force 10 mm beyond it. Power 1 is a spring, 1.5
a ball of rubber (Hertz), more a bellows that closes. Rubber loses a part of its work: loss_stop of the force is friction,
which turns with the direction.
"""

import math
from dataclasses import dataclass

from twintube.core import variables
from twintube.core.frame import Frame
from twintube.core.variables import var

TITLE = "Bump or rebound stop engaged"
CAUSE = "The stroke reaches a rubber stop inside the damper, which adds a springy force near the end of the stroke."
ABSENCE = "The residual is zero over most of the stroke and rises steeply at one end, nearly alike in both directions."
DECIDES = "the same velocity with half the amplitude"
NEEDS_TIME = False
ORDER = 100
REFERENCE = 0.01  # [m]
TURN = 0.01  # [m/s] over which the hysteresis turns


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Force and onset of each side."""

    F_stop_re: float = var("end_stop", "", "N", "force of the rebound stop 10 mm beyond onset", lower=0, upper=2e4,
                           source="power law of the depth", default=0.0, role="strength")  # fmt: skip
    onset_re: float = var("end_stop", "", "m", "stroke at which the rebound stop touches", lower=0, upper=0.4,
                          source="", default=0.04, role="place")  # fmt: skip
    F_stop_co: float = var("end_stop", "", "N", "force of the compression stop 10 mm beyond onset", lower=0,
                           upper=2e4, source="power law of the depth", default=0.0, role="strength")  # fmt: skip
    onset_co: float = var("end_stop", "", "m", "stroke (magnitude) at which the compression stop touches", lower=0,
                          upper=0.4, source="", default=0.04, role="place")  # fmt: skip
    power_stop: float = var("end_stop", "", "1", "power of the depth beyond the onset, both stops", lower=1, upper=3,
                            source="1 spring, 1.5 Hertz", default=1.5, role="law")  # fmt: skip
    loss_stop: float = var("end_stop", "", "1", "share of the stops' force that is friction", lower=0, upper=0.4,
                           source="filled rubber loses 10 to 25 %", default=0.15, role="law")  # fmt: skip


def end_stop_press(p: Parameters, force: float, over: float) -> float:
    """Force [N] of a stop pressed by `over` [m]."""
    if over <= 0.0:
        return 0.0
    return force * math.exp(p.power_stop * math.log(over / REFERENCE))


def end_stop_elastic(p: Parameters, s: Frame, z: float) -> float:
    """Force [N] at the stroke `z` [m]."""
    return end_stop_press(p, p.F_stop_re, z - p.onset_re) - end_stop_press(p, p.F_stop_co, -z - p.onset_co)


def end_stop_rub(p: Parameters, z: float, v: float) -> float:
    """Force [N] of the rubber's hysteresis at the stroke `z` [m] and the velocity `v` [m/s]."""
    pressed = end_stop_press(p, p.F_stop_re, z - p.onset_re) + end_stop_press(p, p.F_stop_co, -z - p.onset_co)
    return p.loss_stop * pressed * math.tanh(v / TURN)
