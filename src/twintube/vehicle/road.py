"""Random road profiles of ISO 8608."""

from dataclasses import dataclass

import numpy as np
from scipy import signal

from twintube.arrays import Array

N_0 = 0.1  # reference spatial frequency [cycles/m]
WAVINESS = 2.0
GD_N0 = {"A": 16e-6, "B": 64e-6, "C": 256e-6, "D": 1024e-6, "E": 4096e-6}  # geometric means of the classes [m3]
BAND = (0.011, 2.83)  # spatial frequencies for which ISO 8608 defines the classes [cycles/m]
SPACING = 0.02  # of the profile's samples [m]
CONTACT_LENGTH = 0.12  # of the tyre, over which it averages the road [m]; assumed


@dataclass(frozen=True)
class Road:
    """Heights [m] every `SPACING` metres: as it is, and as the tyre feels it. It repeats only after `length` [m]."""

    height: Array
    enveloped: Array
    length: float

    def at(self, position: Array) -> Array:
        """Enveloped heights [m] at the positions [m], linear between samples."""
        return np.interp(position, np.arange(len(self.enveloped)) * SPACING, self.enveloped, period=self.length)


def generate(length: float, *, road_class: str = "D", scale: float = 1.0, seed: int = 1) -> Road:
    """A road of at least `length` [m] whose spectrum is that of the class times `scale`, with random phases from `seed`.

    Every spatial frequency of the transform is its own wave, so that nothing repeats within the length. Below the
    band of ISO 8608 the road is flat; above it the spectrum goes on to the limit of the sampling.
    """
    count = 1 << int(np.ceil(np.log2(max(length, 100.0) / SPACING)))
    n = np.fft.rfftfreq(count, SPACING)
    density = np.zeros_like(n)
    inside = n >= BAND[0]
    density[inside] = scale * GD_N0[road_class] * (n[inside] / N_0) ** -WAVINESS
    phase = np.random.default_rng(seed).uniform(0, 2 * np.pi, len(n))
    spectrum = np.sqrt(density * n[1] / 2) * count * np.exp(1j * phase)
    # Averaging over the contact length is a product with sinc(n * length).
    return Road(
        height=np.fft.irfft(spectrum, count),
        enveloped=np.fft.irfft(spectrum * np.sinc(n * CONTACT_LENGTH), count),
        length=count * SPACING,
    )


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
