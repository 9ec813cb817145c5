"""Mean forces over intervals.

A single sample at a jump of the force tells only on which side of the jump it lies; a mean over an interval changes smoothly
with the parameters of a model.
"""

import numpy as np
from scipy.integrate import cumulative_trapezoid

from twintube.common.arrays import Array

SHORTEST = 1e-9  # [s] intervals of repeated times are not divided by less


def impulse(time: Array, force: Array) -> Array:
    """Integral (n,) [N s] of a sampled force (n,) [N] since the first sample."""
    return np.concatenate([[0.0], cumulative_trapezoid(force, time)])


def means(time: Array, integral: Array) -> Array:
    """Mean forces (n - 1,) [N] between the times (n,) [s] from the integral (n,) [N s] of the force at these times."""
    return np.asarray(np.diff(integral) / np.maximum(np.diff(time), SHORTEST))
