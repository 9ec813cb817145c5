"""Side load on guide and piston: Coulomb friction in proportion to the normal force, beside that of slow ramps.

It adds side_load (1 + side_lever z) (1 - exp(-(v / v_side)^2)) times the friction with all oil: the load does not ask for
the oil, and quasi-static ramps, from which the friction of the parameter set comes, show none of it, as a rig aligns itself
in them. The further the rod is out, the shorter is the span between guide and piston that carries the load; a bent rod
rubs more at either end.
"""

import math
from dataclasses import dataclass

from twintube.core import variables
from twintube.core.frame import Frame
from twintube.core.variables import var

TITLE = "Friction above the quasi-static value"
CAUSE = "A side load or a bent rod presses guide and piston to the wall, which multiplies the friction."
ABSENCE = "The residual is a constant force with the sign of the velocity, at every velocity and oil level."
DECIDES = "a quasi-static record with and without side load"
NEEDS_TIME = False
ORDER = 140


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Relative rise of the friction, where it begins, and how it changes along the stroke."""

    side_load: float = var("side_load_friction", "", "1", "relative rise of the friction by side load", lower=0, upper=30,
                           source="Coulomb", default=0.0, role="strength")  # fmt: skip
    v_side: float = var("side_load_friction", "", "m/s", "speed from which the side load shows", lower=1e-3, upper=0.1,
                        source="rigs align in slow ramps", default=0.02, role="scale")  # fmt: skip
    side_lever: float = var("side_load_friction", "", "1/m", "growth of that rise with the stroke (extension)",
                            lower=-25, upper=25, source="lever of guide and piston, bent rod", default=0.0,
                            role="law")  # fmt: skip


def side_load_friction_scale_friction(p: Parameters, s: Frame, z: float, v: float) -> float:
    """Factor of the friction force [1] at the stroke `z` [m] and the velocity `v` [m/s]."""
    x = v / p.v_side
    pressed = p.side_load * max(0.0, 1.0 + p.side_lever * z)
    return 1.0 + pressed * (1.0 - math.exp(-x * x)) / (1.0 + p.oil_loss_gain * (1.0 - p.oil_level))
