"""Friction that depends on the position: F_Fr (1 + friction_slope z + friction_bow z^2 + a spot), not below 0.

Side forces press guide and piston to the walls with a lever: the further the rod is out, the shorter the span between the
two and the longer the overhang. A tube worn where the piston usually runs rubs less there than at both ends. A dent in the
tube or a score on the rod rubs at a spot: friction_spot exp(-((z - spot_at) / spot_width)^2).
"""

import math
from dataclasses import dataclass

from twintube.core import variables
from twintube.core.frame import Frame
from twintube.core.variables import var

TITLE = "Friction that depends on the position"
CAUSE = "A side force with its lever, a tube worn in the middle or dented: rod and piston rub more at some strokes."
ABSENCE = "The residual has the sign of the velocity and grows with the stroke, the same at every velocity and oil level."
DECIDES = "slow records about other middles of the stroke"
NEEDS_TIME = False
ORDER = 130


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Relative change of the friction with the stroke."""

    friction_slope: float = var("position_friction", "", "1/m", "rise of the friction with the stroke (extension)",
                                lower=-60, upper=60, source="lever of guide and piston", default=0.0,
                                role="strength")  # fmt: skip
    friction_bow: float = var("position_friction", "", "1/m2", "rise of the friction to both ends",
                              lower=0, upper=4000, source="tube worn in the middle", default=0.0,
                              role="strength")  # fmt: skip
    friction_spot: float = var("position_friction", "", "1", "rise of the friction at a spot", lower=0, upper=20,
                               source="dent or score", default=0.0, role="strength")  # fmt: skip
    spot_at: float = var("position_friction", "", "m", "stroke of the spot (extension)", lower=-0.12, upper=0.12,
                         source="anywhere in the stroke", default=0.0, role="place")  # fmt: skip
    spot_width: float = var("position_friction", "", "m", "half width of the spot", lower=1e-3, upper=0.05,
                            source="length of piston and guide", default=0.01, role="scale")  # fmt: skip


def position_friction_scale_friction(p: Parameters, s: Frame, z: float, v: float) -> float:
    """Factor of the friction force [1] at the stroke `z` [m]."""
    x = (z - p.spot_at) / p.spot_width
    return max(0.0, 1.0 + z * (p.friction_slope + z * p.friction_bow) + p.friction_spot * math.exp(-x * x))
