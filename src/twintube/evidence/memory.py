"""Noise with memory: white noise and an error that lasts (Ornstein-Uhlenbeck), and columns without it.

The innovations of a Kalman filter are independent; the gains do not depend on the values, so that all columns go through one
filter (Rasmussen and Williams 2006, appendix B; Särkkä and Solin 2019, section 12).
"""

import numba
import numpy as np

from twintube.common.arrays import Array


@numba.njit(nogil=True)
def innovations(values: Array, sigma: Array, size: Array, kept: Array, out: Array) -> float:
    """Write the independent, unit-variance innovations of `values` (n, k) to `out`; half the log determinant of 2 pi C.

    Noise: white of `sigma` (n,) plus `size` (n,) times a process of unit variance, of which each sample keeps the share
    `kept` (n,) of the sample before.
    """
    n, k = values.shape
    mean = np.zeros(k)
    spread = 1.0
    log_det = 0.0
    for i in range(n):
        a, phi = size[i], kept[i]
        spread = phi * phi * spread + 1.0 - phi * phi
        total = a * a * spread + sigma[i] * sigma[i]
        root = np.sqrt(total)
        gain = spread * a / total
        log_det += np.log(root)
        for j in range(k):
            m = phi * mean[j]
            e = values[i, j] - a * m
            out[i, j] = e / root
            mean[j] = m + gain * e
        spread *= sigma[i] * sigma[i] / total
    return float(log_det + 0.5 * n * np.log(2.0 * np.pi))


@numba.njit(nogil=True)
def lagged(values: Array, kept: Array) -> Array:
    """Values (n,) behind a filter of first order, of whose state each sample keeps the share `kept` (n,)."""
    out = np.empty_like(values)
    state = values[0]
    for i in range(len(values)):
        state = kept[i] * state + (1.0 - kept[i]) * values[i]
        out[i] = state
    return out
