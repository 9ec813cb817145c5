"""The oil runs out of gas to free: it holds 9.3 to 11.3 % of its volume at ambient pressure (Section 3.2).

Cavitation fades as the freed gas V_cav nears what the oil V_oil that is left can free:

    Y = Y_cav max(0, 1 - exhaustion V_cav / V_oil),        exhaustion = p_gas / (solubility p_ambient)

The freed gas fills V_cav at the pressure p_gas of the place where it is, not at ambient pressure: gas of 1 mL at 1 bar fills
10 mL at 0.1 bar. `exhaustion` is 9.7 for gas at ambient pressure, 0 for a void without gas.
"""

from dataclasses import dataclass

from twintube.core import variables
from twintube.core.frame import Frame
from twintube.core.variables import var

TITLE = "The oil runs out of dissolved gas"
CAUSE = "Oil holds a limited volume of gas; once it is freed, a cavitating valve frees no more."
ABSENCE = "In a long block above the threshold the model goes on losing force where the measured damper settles."
DECIDES = "a block of 60 s above the cavitation threshold, and a rest before it is repeated"
NEEDS_TIME = False
ORDER = 50


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """The limit."""

    exhaustion: float = var("gas_exhaustion", "", "1", "oil volume over largest volume of freed gas", lower=0, upper=10,
                            source="Section 3.2",
                            default=0.0, role="strength")  # fmt: skip


def gas_exhaustion_scale_cavitation(p: Parameters, s: Frame) -> float:
    """Share [1] of the cavitation that the gas already free leaves."""
    oil = s.V1_oil + s.V1_foam_oil + s.V2_oil + s.V2_foam_oil + s.V3_oil + s.V3_foam_oil + s.V_cav
    return max(0.0, 1.0 - p.exhaustion * s.V_cav / oil) if oil > 0.0 else 0.0
