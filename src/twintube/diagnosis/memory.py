"""Noise with memory: white noise and an error that lasts (Ornstein-Uhlenbeck), and columns without it.

The innovations of a Kalman filter are independent; the gains do not depend on the values, so that all columns go through one
filter (Rasmussen and Williams 2006, appendix B; Särkkä and Solin 2019, section 12).
"""

import numpy as np

from twintube.common.arrays import Array
from twintube.engine import compiled


def innovations(values: Array, sigma: Array, size: Array, kept: Array, out: Array) -> float:
    """Write the independent, unit-variance innovations of `values` (n, k) to `out`; half the log determinant of 2 pi C.

    Noise: white of `sigma` (n,) plus `size` (n,) times a process of unit variance, of which each sample keeps the share
    `kept` (n,) of the sample before.
    """
    half: float = compiled.module().filter_noise(values, sigma, size, kept, np.zeros(values.shape[1]), out)
    return half


def lagged(values: Array, kept: Array) -> Array:
    """Values (n,) behind a filter of first order, of whose state each sample keeps the share `kept` (n,)."""
    out = np.empty(len(values))
    compiled.module().lag(values, kept, out)
    return out


def lasting(values: Array, sigma: Array, size: Array, kept: Array) -> Array:
    """What is expected (n,) of the lasting part of `values` (n,), the noise as in `innovations`."""
    out = np.empty(len(values))
    work = np.empty((2, len(values)))
    compiled.module().smooth_noise(np.ascontiguousarray(values), sigma, size, kept, *work, out)
    return out
