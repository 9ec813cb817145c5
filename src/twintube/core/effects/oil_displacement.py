"""Gas freed by cavitation displaces oil into the reserve, where the paper's equations 40 and 41 make oil vanish.

Of the oil that gives way to freed gas, Y Q_PV, the share displaced_share stays in the reserve:

    V3_oil' = ... + displaced_share Y Q_PV        V_cav' = (1 - displaced_share) Y Q_PV

In rebound the reserve gives so much less than the rod's volume, in compression the bottom valve takes so much more. The
gas flows in the working chambers stay the paper's, and leave through the rod guide in compression. With a share of 1 the
oil is conserved, and V_cav stays 0.
"""

from dataclasses import dataclass

from twintube.core import variables
from twintube.core.frame import Frame
from twintube.core.kernel.rebound import refill
from twintube.core.variables import Derived, Flow, var

TITLE = "Freed gas displaces oil"
CAUSE = "Gas that cavitation frees takes the place of oil, which stays in the reserve instead of being lost."
ABSENCE = "The model loses force over a long block above the threshold without end, where the measured damper settles."
DECIDES = "a block of 60 s above the cavitation threshold: it settles, and a rest changes nothing"
NEEDS_TIME = False
ORDER = 60


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """How much of the oil is kept."""

    displaced_share: float = var("oil_displacement", "", "1", "oil that freed gas pushes into the reserve",
                                 lower=0, upper=1, source="mass balance of the oil", default=0.0,
                                 role="strength")  # fmt: skip


def oil_displacement_flows(p: Parameters, d: Derived, s: Frame, f: Flow, dz: float, foaming: float) -> None:
    """Give the share of the oil that gives way to gas to the reserve."""
    freed = f.cavitated
    if freed <= 0.0:
        return
    displaced = p.displaced_share * freed
    f.cavitated = freed - displaced
    if dz < 0.0:
        f.V3_oil += displaced
        return
    # Where gas is freed V1 gives oil and no foam.
    oil = -f.V1_oil - f.cavitated
    gas = -f.V1_gas + freed
    supply = d.A_rod - displaced
    refill(p, s, f, foaming, max(0.0, supply), oil + min(0.0, supply), gas, 0.0, 0.0)
    if supply < 0.0:
        f.V3_oil = -supply
