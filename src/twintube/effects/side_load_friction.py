"""Side load on guide and piston: Coulomb friction in proportion to the normal force, F_Fr (1 + side_load)."""

from dataclasses import dataclass

from twintube import variables
from twintube.variables import var

TITLE = "Friction above the quasi-static value"
CAUSE = "A side load or a bent rod presses guide and piston to the wall, which multiplies the friction."
ABSENCE = "The residual is a constant force with the sign of the velocity, at every velocity and oil level."
STRENGTH = ("side_load",)
NEEDS_TIME = False


@dataclass(slots=True)
class Parameters(variables.Parameters):
    """Relative rise of the friction."""

    side_load: float = var("side_load_friction", "", "1", "relative rise of the friction by side load", lower=0, upper=10,
                           source="Coulomb", default=0.0)  # fmt: skip


def side_load_friction_scale_friction(p: Parameters) -> float:
    """Factor of the friction force [1]."""
    return 1.0 + p.side_load
