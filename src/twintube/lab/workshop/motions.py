"""Motions of test rigs on a fine time grid: strokes (n,) [m] that start and end at rest speed, 0 in the middle.

Sources: sinusoidal and constant-velocity (triangular) testing and the usual set of test speeds: Dixon, The Shock Absorber
Handbook, chapter "Testing"; Reimpell, Fahrwerktechnik: Stossdaempfer; slow strokes before the block: Schramm et al. 2025.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.signal import bilinear, lfilter

Array = NDArray[np.float64]


def smoothed(values: Array, width: int) -> Array:
    """Moving Hann mean over `width` samples, ends held: what the servo makes of corners."""
    if width < 3:
        return values
    window = np.hanning(width + 2)[1:-1]
    padded = np.pad(values, (width // 2, width - 1 - width // 2), mode="edge")
    result: Array = np.convolve(padded, window / window.sum(), mode="valid")
    return result


def phase(pieces: list[tuple[float, float]], rate: float, blend: float) -> Array:
    """Phase [rad] at `rate` [Hz] of pieces (angular speed [rad/s], duration [s]); the speed changes over `blend` [s]."""
    speeds = [np.full(max(1, round(duration * rate)), omega) for omega, duration in pieces]
    speed = np.concatenate([np.zeros(round(0.06 * rate)), *speeds])
    speed = smoothed(speed, max(3, round(blend * rate)))
    speed[0] = 0.0
    return np.cumsum(speed) / rate


def slow_pieces(amplitude: float, strokes: int, longest: float) -> list[tuple[float, float]]:
    """Slow strokes at 0.05 m/s, or faster where they would last more than `longest` [s]."""
    if strokes == 0:
        return []
    way = 2 * np.pi * amplitude * strokes
    speed = max(0.05, way / longest)
    return [(speed / amplitude, way / speed)]


def sine(amplitude: float, speed: float, rate: float, strokes: int, block: float, rest: float = 0.0) -> Array:
    """Slow strokes, a rest, then a sine of the largest `speed` [m/s] for about `block` [s]."""
    omega = speed / amplitude
    period = 2 * np.pi / omega
    cycles = max(2 if period < 3.0 else 1, round(block / period))
    pieces = slow_pieces(amplitude, strokes, 4.5)
    if rest > 0:
        pieces.append((0.0, rest))
    pieces.append((omega, cycles * 2 * np.pi / omega))
    return amplitude * np.sin(phase(pieces, rate, 0.1))


def triangle(amplitude: float, speed: float, rate: float, strokes: int, block: float) -> Array:
    """Constant velocity to and fro, corners rounded over 14 ms."""
    omega = 0.5 * np.pi * speed / amplitude
    period = 2 * np.pi / omega
    cycles = max(2 if period < 3.0 else 1, round(block / period))
    pieces = [*slow_pieces(amplitude, strokes, 4.5), (omega, cycles * 2 * np.pi / omega)]
    sharp = amplitude * 2 / np.pi * np.arcsin(np.sin(phase(pieces, rate, 0.1)))
    return smoothed(sharp, round(0.014 * rate))


def sweep(amplitude: float, speed: float, rate: float, strokes: int, block: float) -> Array:
    """Sine from 0.6 Hz upward, logarithmic, the amplitude lowered so that `speed` [m/s] is not exceeded."""
    count = round(block * rate)
    frequency = 0.6 * (12.0 / 0.6) ** (np.arange(count) / count)
    slow = phase(slow_pieces(amplitude, strokes, 4.0) or [(0.0, 0.05)], rate, 0.1)
    omega = np.concatenate([np.zeros(len(slow)), 2 * np.pi * frequency])
    angle = np.concatenate([slow, slow[-1] + np.cumsum(2 * np.pi * frequency) / rate])
    size = np.minimum(amplitude, speed / np.maximum(omega, 1e-9))
    size = smoothed(size, round(0.2 * rate))
    result: Array = size * np.sin(angle)
    return smoothed(result, round(0.05 * rate))


def road(limit: float, speed: float, rate: float, strokes: int, block: float, draw: np.random.Generator) -> Array:
    """Damper stroke on an uneven road: white road velocity through body (1.3 Hz) and wheel (11 Hz) resonance.

    Shape of the transfer functions: quarter car, e.g. Mitschke, Dynamik der Kraftfahrzeuge. `speed` [m/s] is
    the RMS of the velocity, `limit` [m] the largest stroke.
    """
    count = round(block * rate)
    white = draw.standard_normal(count)
    moved = np.zeros(count)
    for frequency, damping, share in ((1.3, 0.35, 1.0), (11.0, 0.2, 0.12)):
        w = 2 * np.pi * frequency
        b, a = bilinear([0.0, w, 0.0], [1.0, 2 * damping * w, w * w], rate)
        part = lfilter(b, a, white)
        moved += share * part / np.std(part)
    fade = np.minimum(1.0, np.minimum(np.arange(count), np.arange(count)[::-1]) / (0.4 * rate))
    moved = (moved - moved.mean()) * np.sin(0.5 * np.pi * fade) ** 2
    moved *= speed / float(np.std(np.gradient(moved) * rate))
    largest = float(np.abs(moved).max())
    moved = smoothed(moved * min(1.0, limit / largest), round(0.012 * rate))
    moved[0] = 0.0
    if strokes == 0:
        return moved
    pieces = slow_pieces(0.6 * limit, strokes, 4.0)
    angle = phase(pieces, rate, 0.1)
    angle *= 2 * np.pi * strokes / angle[-1]
    return np.concatenate([0.6 * limit * np.sin(angle), moved])


def fast_rest_fast(amplitude: float, speed: float, rate: float, first: float, rest: float, second: float) -> Array:
    """A slow stroke, a fast block, a rest, the block again."""
    omega = speed / amplitude
    whole = [2 * np.pi / omega * max(2, round(x * omega / (2 * np.pi))) for x in (first, second)]
    pieces = [*slow_pieces(amplitude, 1, 2.5), (omega, whole[0]), (0.0, rest), (omega, whole[1])]
    return amplitude * np.sin(phase(pieces, rate, 0.1))
