"""Random road profiles of ISO 8608: a function of position, class and seed only.

White noise along the road, shaped by a recursive filter that runs in the direction of travel: a longer road continues a
shorter one, and the profile does not depend on the speed.
"""

from dataclasses import dataclass

import numpy as np
from scipy import signal

from twintube.common.arrays import Array, freeze_arrays

N_0 = 0.1  # reference spatial frequency [cycles/m]
WAVINESS = 2.0
GD_N0 = {"A": 16e-6, "B": 64e-6, "C": 256e-6, "D": 1024e-6, "E": 4096e-6}  # geometric means of the classes [m3]
BAND = (0.011, 2.83)  # spatial frequencies for which ISO 8608 defines the classes [cycles/m]
SPACING = 0.02  # of the profile's samples [m]
CORNER = BAND[0] / 2  # below it the spectrum falls off, so that the height does not drift [cycles/m]
RUN_IN = 1500.0  # of the filter before position 0 [m]
CONTACT_LENGTH = 0.12  # length over which the tyre averages the road [m]; assumed


@dataclass(frozen=True)
class Road:
    """Heights [m] every `SPACING` metres from position 0: of the road, and averaged over the tyre's contact length."""

    height: Array
    enveloped: Array

    def __post_init__(self) -> None:
        """Shared by all who read it."""
        freeze_arrays(self)

    def at(self, position: Array) -> Array:
        """Enveloped heights [m] at the positions [m], linear between samples; raises ValueError outside the road."""
        end = (len(self.enveloped) - 1) * SPACING
        if np.size(position) and not (np.min(position) >= 0.0 and np.max(position) <= end):
            raise ValueError(f"position {np.min(position):g} to {np.max(position):g} m: must be from 0 to {end:g} m")
        return np.interp(position, np.arange(len(self.enveloped)) * SPACING, self.enveloped)


def shaping() -> tuple[Array, Array]:
    """Filter from white noise to the heights of a road with Gd(n0) = 1 m3: an integrator without drift."""
    corner = 2 * np.pi * CORNER
    # One-sided density of unit white noise: 2 SPACING. Far above the corner |H|^2 is (gain / (2 pi n))^2.
    gain = 2 * np.pi * N_0 / np.sqrt(2 * SPACING)
    b, a = signal.bilinear([gain, 0.0], [1.0, np.sqrt(2) * corner, corner**2], 1 / SPACING)
    return np.asarray(b), np.asarray(a)


def generate(length: float, *, road_class: str = "D", scale: float = 1.0, seed: int = 1) -> Road:
    """A road of at least `length` [m] from noise of the `seed`; its spectrum is that of the class times `scale`.

    Within the band of ISO 8608 the density is that of waviness 2, within 4 % at its ends.
    """
    reach = round(CONTACT_LENGTH / SPACING) // 2  # samples of the contact length to each side
    run_in, count = round(RUN_IN / SPACING), int(np.ceil(length / SPACING)) + 1
    noise = np.random.default_rng(seed).standard_normal(run_in + count + reach)
    b, a = shaping()
    profile = np.sqrt(scale * GD_N0[road_class]) * signal.lfilter(b, a, noise)
    # The mean over the contact length, by trapezoids; as a recursive filter's, its bits do not depend on the length.
    weights = np.concatenate([[0.5], np.ones(2 * reach - 1), [0.5]]) / (2 * reach)
    enveloped = signal.lfilter(weights, [1.0], profile)
    return Road(height=profile[run_in : run_in + count], enveloped=enveloped[run_in + reach :])


def measured_density(height: Array) -> tuple[Array, Array]:
    """Spatial frequencies [cycles/m] and densities Gd [m3], smoothed over octaves as ISO 8608 requires.

    The bands are octaves around 0.1 cycles/m. Each density is the mean over the band, times the ratio of the density at
    the centre to the mean over the band for a road of waviness 2.
    """
    n, density = signal.welch(height, 1 / SPACING, nperseg=min(len(height), 1 << 14), detrend="linear")
    centres = N_0 * 2.0 ** np.arange(-2, 5)
    means = []
    for centre in centres:
        band = (n >= centre / np.sqrt(2)) & (n < centre * np.sqrt(2))
        means.append(density[band].mean() * centre**-WAVINESS / (n[band] ** -WAVINESS).mean())
    return centres, np.array(means)


def measured_gd_n0(height: Array) -> float:
    """Gd(n0) [m3] of the profile: geometric mean over the octaves of the density, converted to n0 with waviness 2."""
    centres, density = measured_density(height)
    return float(np.exp(np.mean(np.log(density * (centres / N_0) ** WAVINESS))))
