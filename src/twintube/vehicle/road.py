"""Random road profiles of ISO 8608: a function of place, class and seed alone.

White noise along the road, shaped by a recursive filter that runs in the direction of travel: a longer road goes on where a
shorter one ends, and whoever drives faster sees the same metres.
"""

from dataclasses import dataclass

import numpy as np
from scipy import signal

from twintube.arrays import Array

N_0 = 0.1  # reference spatial frequency [cycles/m]
WAVINESS = 2.0
GD_N0 = {"A": 16e-6, "B": 64e-6, "C": 256e-6, "D": 1024e-6, "E": 4096e-6}  # geometric means of the classes [m3]
BAND = (0.011, 2.83)  # spatial frequencies for which ISO 8608 defines the classes [cycles/m]
SPACING = 0.02  # of the profile's samples [m]
CORNER = BAND[0] / 2  # below it the spectrum falls off, so that no height drifts away [cycles/m]
RUN_IN = 1500.0  # of the filter before place 0 [m]
CONTACT_LENGTH = 0.12  # of the tyre, over which it averages the road [m]; assumed


@dataclass(frozen=True)
class Road:
    """Heights [m] every `SPACING` metres from place 0: as it is, and as the tyre feels it."""

    height: Array
    enveloped: Array

    def at(self, position: Array) -> Array:
        """Enveloped heights [m] at the positions [m], linear between samples; raises ValueError beyond the road."""
        end = (len(self.enveloped) - 1) * SPACING
        if np.size(position) and not (np.min(position) >= 0.0 and np.max(position) <= end):
            raise ValueError(f"position {np.min(position):g} to {np.max(position):g} m: must be from 0 to {end:g} m")
        return np.interp(position, np.arange(len(self.enveloped)) * SPACING, self.enveloped)


def shaping() -> tuple[Array, Array]:
    """The filter that makes the heights of a road of Gd(n0) = 1 m3 from white noise: an integrator without drift."""
    corner = 2 * np.pi * CORNER
    # One-sided density of unit white noise: 2 SPACING. Far above the corner |H|^2 is (gain / (2 pi n))^2.
    gain = 2 * np.pi * N_0 / np.sqrt(2 * SPACING)
    b, a = signal.bilinear([gain, 0.0], [1.0, np.sqrt(2) * corner, corner**2], 1 / SPACING)
    return np.asarray(b), np.asarray(a)


def generate(length: float, *, road_class: str = "D", scale: float = 1.0, seed: int = 1) -> Road:
    """A road of at least `length` [m], whose spectrum is that of the class times `scale`, from noise of the `seed`.

    Within the band of ISO 8608 the density is that of waviness 2, within 4 % at its ends.
    """
    reach = round(CONTACT_LENGTH / SPACING) // 2  # samples that the tyre feels to each side
    before, count = round(RUN_IN / SPACING), int(np.ceil(length / SPACING)) + 1
    noise = np.random.default_rng(seed).standard_normal(before + count + reach)
    b, a = shaping()
    profile = np.sqrt(scale * GD_N0[road_class]) * signal.lfilter(b, a, noise)
    # The mean over the contact length, by trapezoids; as a recursive filter's, its bits do not depend on the length.
    weights = np.concatenate([[0.5], np.ones(2 * reach - 1), [0.5]]) / (2 * reach)
    felt = signal.lfilter(weights, [1.0], profile)
    return Road(height=profile[before : before + count], enveloped=felt[before + reach :])


def measured_density(height: Array) -> tuple[Array, Array]:
    """Spatial frequencies [cycles/m] and densities Gd [m3], smoothed over octaves as ISO 8608 asks.

    The bands are octaves around 0.1 cycles/m; the densities are means over the band times the ratio that a road of
    waviness 2 would have between its density at the centre and its mean over the band.
    """
    n, density = signal.welch(height, 1 / SPACING, nperseg=min(len(height), 1 << 14), detrend="linear")
    centres = N_0 * 2.0 ** np.arange(-2, 5)
    means = []
    for centre in centres:
        band = (n >= centre / np.sqrt(2)) & (n < centre * np.sqrt(2))
        means.append(density[band].mean() * centre**-WAVINESS / (n[band] ** -WAVINESS).mean())
    return centres, np.array(means)


def measured_gd_n0(height: Array) -> float:
    """Gd(n0) [m3] of the profile: the geometric mean over the octaves of its density brought to n0 with waviness 2."""
    centres, density = measured_density(height)
    return float(np.exp(np.mean(np.log(density * (centres / N_0) ** WAVINESS))))
