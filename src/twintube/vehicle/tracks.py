"""The road under left and right wheels: two profiles of ISO 8608 that agree in long waves and not in short ones.

The coherence is that of an isotropic surface of waviness 2, x K_1(x) with x = 2 pi n T for tracks T apart (K. M. A. Kamash
and J. D. Robson, "The application of isotropy in road surface modelling", J. Sound Vib. 57 (1978) 89-100).
"""

from functools import lru_cache

import numpy as np
from scipy import signal
from scipy.special import kv

from twintube.common.arrays import Array
from twintube.vehicle.road import CONTACT_LENGTH, GD_N0, RUN_IN, SPACING, generate, shaping

TAPS = 4096  # of the filters of what both tracks share and of what they do not: 82 m


def coherence(n: Array, apart: float) -> Array:
    """Coherence [1] of two tracks `apart` [m] at spatial frequencies `n` [cycles/m]: cross density over density."""
    x = 2.0 * np.pi * np.maximum(n, 1e-9) * apart
    return np.asarray(np.minimum(x * kv(1, x), 1.0))


@lru_cache
def shares(apart: float) -> tuple[Array, Array]:
    """Symmetric filters (TAPS + 1,) of what both tracks share and of what has the other sign in the other track."""
    shared = coherence(np.fft.rfftfreq(TAPS, SPACING), apart)
    window = signal.windows.hann(TAPS + 1)
    taps = []
    for size in (np.sqrt((1.0 + shared) / 2.0), np.sqrt((1.0 - shared) / 2.0)):
        middle = np.roll(np.fft.irfft(size), TAPS // 2)
        taps.append(np.append(middle, middle[0]) * window)
    return taps[0], taps[1]


def tracks(length: float, apart: float, *, road_class: str = "D", seed: int = 1, equal: bool = False) -> Array:
    """Heights (2, m) [m] of left and right track every `SPACING`, averaged over the tyre's contact length.

    `equal` gives the single profile of `road.generate` to both. A longer road continues a shorter one.
    """
    if equal:
        single = generate(length, road_class=road_class, seed=seed).enveloped
        return np.vstack([single, single])
    run_in, count = round(RUN_IN / SPACING), int(np.ceil(length / SPACING)) + 1
    reach = round(CONTACT_LENGTH / SPACING) // 2
    size = run_in + count + reach + TAPS
    parts = [
        signal.oaconvolve(np.random.default_rng([seed, i]).standard_normal(size), taps, mode="valid")
        for i, taps in enumerate(shares(apart))
    ]
    b, a = shaping()
    weights = np.concatenate([[0.5], np.ones(2 * reach - 1), [0.5]]) / (2 * reach)
    profiles = []
    for noise in (parts[0] + parts[1], parts[0] - parts[1]):
        profile = np.sqrt(GD_N0[road_class]) * signal.lfilter(b, a, noise)
        profiles.append(signal.lfilter(weights, [1.0], profile)[run_in + reach :])
    return np.array(profiles)
