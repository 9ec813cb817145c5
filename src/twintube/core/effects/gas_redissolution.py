"""Gas freed by cavitation goes back into the oil: first-order decay of V_cav, the oil lost to gas.

A share of what comes back is in the reserve already; the rest takes the place of gas in V1 and V2, in proportion to the gas
they hold, and beyond that joins the reserve, too. Oil and V_cav together stay the same. A share of the rate may go with the
pressure, and so with the fluid force; it is stated at 1000 N.
"""

import math
from dataclasses import dataclass

from twintube.core import variables
from twintube.core.frame import Frame
from twintube.core.variables import var

TITLE = "Gas goes back into the oil"
CAUSE = "Bubbles freed by cavitation collapse and dissolve again under pressure, which the paper's model does not give back."
ABSENCE = "The model loses force from oscillation to oscillation where the measured damper recovers, at rest above all."
DECIDES = "rests of 5, 20 and 60 s between blocks above the cavitation threshold"
NEEDS_TIME = True
ORDER = 30
F_PRESSED = 1000.0  # [N] fluid force


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Rate of the return."""

    redissolution_rate: float = var("gas_redissolution", "", "1/s", "share of the freed gas that dissolves per second",
                                    lower=0, upper=10, source="Henry's law",
                                    default=0.0, role="strength")  # fmt: skip
    reserve_share: float = var("gas_redissolution", "", "1", "share of it that dissolves in the reserve", lower=0, upper=1,
                               source="unknown", default=0.0, role="law")  # fmt: skip
    pressed_share: float = var("gas_redissolution", "", "1", "share of the rate that goes with the fluid force", lower=0,
                               upper=1, source="Henry's law", default=0.0,
                               role="law")  # fmt: skip


def gas_redissolution_phases(p: Parameters, s: Frame, way: float, dt: float) -> None:
    """Turn gas back into oil."""
    rate = p.redissolution_rate * (1.0 - p.pressed_share + p.pressed_share * abs(s.F_fluid) / F_PRESSED)
    back = s.V_cav * (1.0 - math.exp(-rate * dt))
    s.V_cav -= back
    s.V3_oil += p.reserve_share * back
    back -= p.reserve_share * back
    gas = s.V1_gas + s.V2_gas
    if gas <= back:
        s.V1_oil += s.V1_gas
        s.V2_oil += s.V2_gas
        s.V3_oil += back - gas
        s.V1_gas = 0.0
        s.V2_gas = 0.0
        return
    part = back / gas
    s.V1_oil += part * s.V1_gas
    s.V2_oil += part * s.V2_gas
    s.V1_gas -= part * s.V1_gas
    s.V2_gas -= part * s.V2_gas
