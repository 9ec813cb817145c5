"""Loops over noise with memory, in the kernel's own subset of Python; compiled with the kernel. Called by `memory.py`."""

import math

from twintube.common.arrays import Table, Vector


def filter_noise(values: Table, sigma: Vector, size: Vector, kept: Vector, mean: Vector, out: Table) -> float:
    """Write the independent, unit-variance innovations of `values` (n, k) to `out`; half the log determinant of 2 pi C.

    Noise: white of `sigma` (n,) plus `size` (n,) times a process of unit variance, of which each sample keeps the share
    `kept` (n,) of the sample before. `mean` (k,) are zeros, which the filter carries on.
    """
    n = len(values)
    spread = 1.0
    log_det = 0.0
    for i in range(n):
        a, phi = size[i], kept[i]
        spread = phi * phi * spread + 1.0 - phi * phi
        total = a * a * spread + sigma[i] * sigma[i]
        root = math.sqrt(total)
        gain = spread * a / total
        unit = 1.0 / root  # one division in place of one for each column
        log_det += math.log(root)
        for j in range(len(mean)):
            m = phi * mean[j]
            e = values[i, j] - a * m
            out[i, j] = e * unit
            mean[j] = m + gain * e
        spread *= sigma[i] * sigma[i] / total
    return log_det + 0.5 * n * math.log(2.0 * math.pi)


def lag(values: Vector, kept: Vector, out: Vector) -> None:
    """Values (n,) to `out` behind a filter of first order, of whose state each sample keeps the share `kept` (n,)."""
    state = values[0]
    for i in range(len(values)):
        state = kept[i] * state + (1.0 - kept[i]) * values[i]
        out[i] = state


def smooth_noise(
    values: Vector, sigma: Vector, size: Vector, kept: Vector, mean: Vector, spread: Vector, out: Vector
) -> None:
    """Write what is expected of the lasting part of `values` (n,) to `out`, with all of them known (Rauch, Tung, Striebel).

    Noise as in `filter_noise`; `mean` and `spread` (n,) are work space.
    """
    n = len(values)
    m = 0.0
    s = 1.0
    for i in range(n):
        a, phi = size[i], kept[i]
        m = phi * m
        s = phi * phi * s + 1.0 - phi * phi
        gain = s * a / (a * a * s + sigma[i] * sigma[i])
        m = m + gain * (values[i] - a * m)
        s = s * (1.0 - gain * a)
        mean[i] = m
        spread[i] = s
    later = mean[n - 1]
    out[n - 1] = size[n - 1] * later
    for j in range(n - 1):
        i = n - 2 - j
        phi = kept[i + 1]
        ahead = phi * phi * spread[i] + 1.0 - phi * phi
        later = mean[i] + spread[i] * phi / ahead * (later - phi * mean[i])
        out[i] = size[i] * later
