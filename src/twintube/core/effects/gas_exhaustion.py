"""The oil runs out of gas to free: it holds 9.3 to 11.3 % of its volume at ambient pressure (Section 3.2).

The freed gas fills V_cav at the pressure of the place where it is, not at ambient pressure: gas of 1 mL at 1 bar fills
10 mL at 0.1 bar. Cavitation fades as V_cav nears solubility * p_ambient / p_gas of the oil left; `exhaustion` is the
inverse of that share, p_gas / (solubility p_ambient): 9.7 for gas at ambient pressure, 0 for a void without gas.
"""

from dataclasses import dataclass

from twintube.core import variables
from twintube.core.frame import Frame
from twintube.core.variables import Derived, var

TITLE = "The oil runs out of dissolved gas"
CAUSE = "Oil holds a limited volume of gas; once it is freed, a cavitating valve frees no more."
ABSENCE = "In a long block above the threshold the model goes on losing force where the measured damper settles."
DECIDES = "a block of 60 s above the cavitation threshold, and a rest before it is repeated"
NEEDS_TIME = False


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """The limit."""

    exhaustion: float = var("gas_exhaustion", "", "1", "oil volume over largest volume of freed gas", lower=0, upper=10,
                            source="Section 3.2",
                            default=0.0, role="strength")  # fmt: skip


def gas_exhaustion_motion(p: Parameters, d: Derived, s: Frame, z: float, v0: float, v1: float, dt: float) -> None:
    """Weaken the cavitation of this step by the gas that is free already."""
    oil = s.V1_oil + s.V1_foam_oil + s.V2_oil + s.V2_foam_oil + s.V3_oil + s.V3_foam_oil + s.V_cav
    left = max(0.0, 1.0 - p.exhaustion * s.V_cav / oil) if oil > 0.0 else 0.0
    d.Y_Co = left * d.cavitation * p.Y_Co_cav
    d.Y_Re = left * d.cavitation * p.Y_Re_cav
