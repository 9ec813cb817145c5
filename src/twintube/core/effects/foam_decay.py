"""Foam separates with time, at rest too: decay of every chamber's foam into its oil and its gas.

All bubbles may do so alike, a decay of first order, or those at a surface, a front that goes through the foam at its own
speed: order 0. `foam_decay_rate` is that of 10 mL of foam, a usual volume.
The oil drains out first; dry bubbles may burst slower, at `dry_share` of the rate.
"""

import math
from dataclasses import dataclass

from twintube.core import variables
from twintube.core.frame import Frame
from twintube.core.variables import var

TITLE = "Foam separates with time"
CAUSE = "Drainage and bursting bubbles separate foam into oil and gas at a rate of its own, at rest too."
ABSENCE = "After a rest or in slow motion the measured force is higher than the model's, whose foam stays."
DECIDES = "rests of 5, 20 and 60 s between blocks below the cavitation threshold"
NEEDS_TIME = True
ORDER = 20
V_USUAL = 1e-5  # [m3] foam
NO_FOAM = 1e-15  # [m3] that goes at once


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Rate of the decay, and how long dry foam lasts."""

    foam_decay_rate: float = var("foam_decay", "", "1/s", "share of the foam that separates per second", lower=0, upper=10,
                                 source="Bikerman, Foams", default=0.0, role="strength")  # fmt: skip
    foam_order: float = var("foam_decay", "", "1", "foam separates with its volume to this power", lower=0, upper=1,
                            source="Bikerman, Foams", default=1.0, role="law")  # fmt: skip
    dry_share: float = var("foam_decay", "", "1", "rate of the gas over that of the oil", lower=0.1, upper=1,
                           source="Bikerman, Foams", default=1.0,
                           role="law")  # fmt: skip


def foam_decay_phases(p: Parameters, s: Frame, way: float, dt: float) -> None:
    """Give the oil and the gas of the decayed foam back; the volumes of the chambers stay."""
    rate = p.foam_decay_rate
    foam = s.V1_foam + s.V2_foam + s.V3_foam
    if p.foam_order < 1.0 and foam > 0.0:
        rate *= math.pow(V_USUAL / foam, 1.0 - p.foam_order)
    drained = 1.0 - math.exp(-rate * dt)
    burst = 1.0 - math.exp(-p.dry_share * rate * dt)
    # A trace of 1e-9 mL would still count as foam.
    oil = s.V1_foam_oil if s.V1_foam < NO_FOAM else drained * s.V1_foam_oil
    gas = max(0.0, s.V1_foam - s.V1_foam_oil)
    gas = gas if s.V1_foam < NO_FOAM else burst * gas
    s.V1_foam = max(0.0, s.V1_foam - oil - gas)
    s.V1_foam_oil -= oil
    s.V1_oil += oil
    s.V1_gas += gas
    oil = s.V2_foam_oil if s.V2_foam < NO_FOAM else drained * s.V2_foam_oil
    gas = max(0.0, s.V2_foam - s.V2_foam_oil)
    gas = gas if s.V2_foam < NO_FOAM else burst * gas
    s.V2_foam = max(0.0, s.V2_foam - oil - gas)
    s.V2_foam_oil -= oil
    s.V2_oil += oil
    s.V2_gas += gas
    # The reserve's gas is the rest of its volume.
    oil = s.V3_foam_oil if s.V3_foam < NO_FOAM else drained * s.V3_foam_oil
    gas = max(0.0, s.V3_foam - s.V3_foam_oil)
    gas = gas if s.V3_foam < NO_FOAM else burst * gas
    s.V3_foam = max(0.0, s.V3_foam - oil - gas)
    s.V3_foam_oil -= oil
    s.V3_oil += oil
