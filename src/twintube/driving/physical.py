"""The damping ratio of wheel hop from the road's own excitation: a verdict without learning.

The density of what a wheel shows around its hop is that of an oscillator under a road whose density is a power of
frequency: ln S = a + b ln f - ln((1 - (f/f0)^2)^2 + (2 zeta f/f0)^2). For each pair of f0 and zeta, a and b follow by
least squares; the pair with the least rest is the answer. This is the half-power width of the peak, for damping ratios at
which the peak has no half-power points any more.
"""

from functools import lru_cache
from typing import Final

import numpy as np

from twintube.common.arrays import Array
from twintube.driving.spectra import within

FITTED: Final = (7.0, 19.0)  # [Hz] the hop and both its flanks, below the Nyquist frequency of the coarsest raster
NATURAL: Final = np.linspace(8.0, 17.0, 37)  # [Hz]
RATIOS: Final = np.geomspace(0.02, 0.7, 40)


@lru_cache
def oscillators(frequency: tuple[float, ...]) -> Array:
    """-ln((1 - r^2)^2 + (2 zeta r)^2) for all pairs of NATURAL and RATIOS: (pairs, frequencies)."""
    r = np.array(frequency) / NATURAL[:, None, None]
    return np.asarray(-np.log((1.0 - r**2) ** 2 + (2.0 * RATIOS[:, None] * r) ** 2)).reshape(-1, len(frequency))


def wheel_hop(frequency: Array, density: Array) -> tuple[float, float]:
    """Natural frequency [Hz] and damping ratio [1] of wheel hop from a power density (n,), NaN where none is known.

    NaN for both where fewer than half of the frequencies between FITTED are there.
    """
    band = within(frequency, FITTED)
    shown = band & np.isfinite(density) & (np.nan_to_num(density) > 0.0)
    if 2 * np.count_nonzero(shown) < np.count_nonzero(band):
        return float("nan"), float("nan")
    f = frequency[shown]
    line = np.linalg.qr(np.column_stack([np.ones_like(f), np.log(f)]))[0]
    rest = np.log(density[shown]) - oscillators(tuple(f.tolist()))
    rest = rest - (rest @ line) @ line.T
    best = int(np.argmin(np.sum(rest**2, axis=1)))
    return float(NATURAL[best // len(RATIOS)]), float(RATIOS[best % len(RATIOS)])
