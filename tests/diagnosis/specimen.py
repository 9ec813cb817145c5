"""A damper whose own law is not that of its parameter set."""

import numpy as np

from tests.diagnosis import small
from twintube.common.arrays import Array

OFF = 0.04  # of the fluid force, smooth in speed and other in each direction


def own_law(r: small.Run) -> Array:
    """The force (n,) [N] of a run with other valves."""
    other = OFF * np.where(r.velocity > 0, np.cos(4.0 * r.velocity), -np.exp(-((r.velocity / 0.4) ** 2)))
    return np.asarray(r.force + other * r.fluid)
