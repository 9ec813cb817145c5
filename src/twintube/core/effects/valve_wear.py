"""Worn or clogged valves: the F-v curve is scaled, rebound and compression each by itself."""

from dataclasses import dataclass

from twintube.core import variables
from twintube.core.frame import Frame
from twintube.core.variables import var

TITLE = "Change of the F-v curve"
CAUSE = "Worn, set or clogged valves make less or more force than the F-v curve of the parameter set."
ABSENCE = "The residual is proportional to the fluid force, with a factor for each direction, from the first oscillation."
DECIDES = "an intact reference measured on the same day"
NEEDS_TIME = False


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Relative change of each branch."""

    wear_re: float = var("valve_wear", "", "1", "relative change of the fluid force in rebound", lower=-0.8, upper=1,
                         source="scaled F-v curve", default=0.0, role="strength")  # fmt: skip
    wear_co: float = var("valve_wear", "", "1", "relative change of the fluid force in compression", lower=-0.8, upper=1,
                         source="scaled F-v curve", default=0.0, role="strength")  # fmt: skip


def valve_wear_scale_fluid(p: Parameters, s: Frame, v: float) -> float:
    """Factor of the fluid force [1] in the direction of `v`."""
    return 1.0 + (p.wear_re if v >= 0.0 else p.wear_co)
