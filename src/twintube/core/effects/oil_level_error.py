"""The recorded fill is wrong: the damper starts with another oil level in its degraded states, those without full preload.

The level is oil_level + level_error within 0 to 1. Friction and cavitation go with the oil that is truly lost.
"""

from dataclasses import dataclass

from twintube.core import variables
from twintube.core.kernel.prepare import lose
from twintube.core.variables import Derived, var

TITLE = "The recorded fill is wrong"
CAUSE = "The oil drained or filled in is not what the records say, in every state by the same share, or in a single state."
ABSENCE = (
    "In the degraded states, or in one, the model's force rises at another stroke than the measured one, from the first "
    "oscillation."
)
DECIDES = "the oil weighed"
NEEDS_TIME = False
ORDER = 10


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Error of the level."""

    level_error: float = var("oil_level_error", "", "1", "true oil level beyond the recorded one", lower=-0.3, upper=0.3,
                             source="", default=0.0, role="strength")  # fmt: skip


def oil_level_error_level(p: Parameters, level: float) -> float:
    """The true level [1]."""
    return max(0.0, min(1.0, level + p.level_error)) if p.gas_preload < 1.0 else level


def oil_level_error_derive(p: Parameters, d: Derived) -> None:
    """What follows from the oil that is truly lost."""
    lose(p, d, oil_level_error_level(p, p.oil_level))
