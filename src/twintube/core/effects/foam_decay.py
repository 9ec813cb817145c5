"""Foam separates with time, at rest too: first-order decay of every chamber's foam into its oil and its gas."""

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


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Rate of the decay."""

    foam_decay_rate: float = var("foam_decay", "", "1/s", "share of the foam that separates per second", lower=0, upper=10,
                                 source="first-order foam decay; Bikerman, Foams", default=0.0, role="strength")  # fmt: skip


def foam_decay_phases(p: Parameters, s: Frame, way: float, dt: float) -> None:
    """Give the oil and the gas of the decayed foam back; the volumes of the chambers stay."""
    share = 1.0 - math.exp(-p.foam_decay_rate * dt)
    # A trace of 1e-9 mL would still count as foam.
    gone = s.V1_foam if s.V1_foam < 1e-15 else share * s.V1_foam
    oil = s.V1_foam_oil if s.V1_foam < 1e-15 else share * s.V1_foam_oil
    s.V1_foam -= gone
    s.V1_foam_oil -= oil
    s.V1_oil += oil
    s.V1_gas += max(0.0, gone - oil)
    gone = s.V2_foam if s.V2_foam < 1e-15 else share * s.V2_foam
    oil = s.V2_foam_oil if s.V2_foam < 1e-15 else share * s.V2_foam_oil
    s.V2_foam -= gone
    s.V2_foam_oil -= oil
    s.V2_oil += oil
    s.V2_gas += max(0.0, gone - oil)
    # The reserve's gas is the rest of its volume.
    gone = s.V3_foam if s.V3_foam < 1e-15 else share * s.V3_foam
    oil = s.V3_foam_oil if s.V3_foam < 1e-15 else share * s.V3_foam_oil
    s.V3_foam -= gone
    s.V3_foam_oil -= oil
    s.V3_oil += oil
