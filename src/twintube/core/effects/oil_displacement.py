"""Gas freed by cavitation displaces oil into the reserve, where the paper's equations 40 and 41 make oil vanish.

In rebound the reserve gives so much less than the rod's volume, in compression the bottom valve takes so much more. The
gas flows in the working chambers stay the paper's, and leave through the rod guide in compression. With a share of 1 the
oil is conserved, and V_cav stays 0.
"""

from dataclasses import dataclass

from twintube.core import variables
from twintube.core.variables import Derived, var

TITLE = "Freed gas displaces oil"
CAUSE = "Gas that cavitation frees takes the place of oil, which stays in the reserve instead of being lost."
ABSENCE = "The model loses force over a long block above the threshold without end, where the measured damper settles."
DECIDES = "a block of 60 s above the cavitation threshold: it settles, and a rest changes nothing"
NEEDS_TIME = False


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """How much of the oil is kept."""

    displaced_share: float = var("oil_displacement", "", "1", "oil that freed gas pushes into the reserve",
                                 lower=0, upper=1, source="mass balance of the oil", default=0.0,
                                 role="strength")  # fmt: skip


def oil_displacement_derive(p: Parameters, d: Derived) -> None:
    """Hand the share to the kernel's flows."""
    d.displaced = p.displaced_share
