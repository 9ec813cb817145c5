"""Spectra of the wheels over windows of a drive in which the car rolls straight on: what the monitor looks at.

A window is WINDOW long. Each is left out in which the car is slow, brakes, turns, or changes its speed: there the wheels
turn for other reasons than the road. The orders of the wheel's rotation are left out too: there lie imbalance and the
errors of the encoder's teeth.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from scipy import signal

from twintube.common.arrays import Array
from twintube.driving.channels import PLACES
from twintube.driving.sheet import NEEDED, length
from twintube.driving.signals import Signals
from twintube.errors import InputError

WINDOW: Final = 4.0  # [s]: steps of 0.25 Hz, a sixth of the width of a body resonance with a damping ratio of 0.3
SLOWEST: Final = 7.0  # [m/s]: below, the rear wheels come more than a tenth of a window after the front wheels
MOST_CHANGE: Final = 0.1  # of the speed within a window: a tenth moves an order of the wheel by its own width here
MOST_BRAKE: Final = 2e5  # [Pa]: pads touch the discs
MOST_LATERAL: Final = 2.0  # [m/s2]: a fifth of the load moves to the outer wheels
COARSEST: Final = 0.025  # [s]: its Nyquist frequency is 20 Hz, above the highest wheel-hop frequency
FINEST: Final = 0.008  # [s]: finer rasters are thinned out to about 100 Hz
HOP: Final = (9.0, 16.0)  # [Hz] wheel hop of passenger cars
ABOVE: Final = (17.0, 20.0)  # [Hz] above it, up to the Nyquist frequency of the coarsest raster
BETWEEN: Final = (3.0, 7.0)  # [Hz] between the resonances of body and wheel
BODY: Final = (0.8, 2.0)  # [Hz] bounce and pitch of the body
ORDER_WIDTH: Final = 0.5  # [Hz] to either side: a Hann window's main lobe
SENSORS: Final = ("speed", "accel")  # of a wheel: its rotation over the mean, its vertical acceleration


@dataclass(frozen=True)
class Spectra:
    """Of the usable windows of a drive: complex amplitudes (windows, frequencies) by signal, NaN where an order lies.

    Signals are `speed_fl` ... [1], the wheel speed over its mean; `accel_fl` ... [m/s2]; `body` [m/s2]. The mean square of
    an amplitude is a power density [unit^2/Hz].
    """

    frequency: Array  # (frequencies,) [Hz]
    amplitude: Mapping[str, Array]
    speed: Array  # (windows,) [m/s]
    start: Array  # (windows,) [s]
    delay: Array  # (windows,) [s] from front to rear wheels
    air: Array  # (windows,) [degC] outside, NaN where it is not known
    all_windows: int
    left_out: Mapping[str, int]  # windows, by what left them out first

    def __len__(self) -> int:
        return len(self.speed)

    @property
    def sensors(self) -> tuple[str, ...]:
        """Those of SENSORS that all four wheels have."""
        return tuple(name for name in SENSORS if all(f"{name}_{place}" in self.amplitude for place in PLACES))


def within(frequency: Array, band: tuple[float, float]) -> Array:
    """Which frequencies lie in a band."""
    return np.asarray((frequency >= band[0]) & (frequency < band[1]))


def hold(signals: Signals) -> int:
    """Samples for which the wheel speeds stand still: a slower channel repeats its last value on the raster."""
    speeds = np.array([signals.values[f"wheel_speed_{place}_rad_per_s"] for place in PLACES])
    changed = np.flatnonzero((np.diff(speeds, axis=1) != 0.0).any(axis=0))
    return max(1, round(float(np.median(np.diff(changed))))) if len(changed) > 2 else 1


def thinned(signals: Signals) -> tuple[float, dict[str, Array]]:
    """The sample interval [s] and the channels, without repeated values and at most as fine as FINEST."""
    held = hold(signals)
    interval = signals.interval * held
    if interval > COARSEST:
        raise InputError(
            f"wheel speeds every {1e3 * interval:.3g} ms: must be at most {1e3 * COARSEST:g} ms, for wheel hop at up to "
            f"{HOP[1]:g} Hz"
        )
    values = {name: x[held - 1 :: held] for name, x in signals.values.items()}
    if interval < FINEST:
        step = round(0.01 / interval)
        values = {name: signal.resample_poly(x, 1, step, padtype="line") for name, x in values.items()}
        interval *= step
    return interval, values


def windows(values: Array, count: int) -> Array:
    """Windows (w, count) of a signal, each half over the next."""
    return np.lib.stride_tricks.sliding_window_view(values, count)[:: count // 2]


def braked(values: Mapping[str, Array]) -> Array:
    """Where the car brakes; nowhere without the channel: then the change of speed must show it."""
    return np.asarray(values.get("brake_pressure_pa", np.zeros(len(values["accel_x_m_per_s2"]))) > MOST_BRAKE)


def spectra(signals: Signals) -> Spectra:
    """The spectra of a drive; raises InputError where the raster is too coarse, or the data sheet incomplete."""
    wheelbase, radius = (length(signals.car, name) for name in NEEDED)
    interval, values = thinned(signals)
    count = round(WINDOW / interval)
    if len(next(iter(values.values()))) < count:
        raise InputError(
            f"a drive of {len(signals) * signals.interval:.3g} s: must be at least {WINDOW:g} s, for one window"
        )
    rotation = {place: windows(values[f"wheel_speed_{place}_rad_per_s"], count) for place in PLACES}
    mean = np.mean([np.mean(each, axis=1) for each in rotation.values()], axis=0)
    slow = np.mean(list(rotation.values()), axis=0)
    half = count // 2
    change = np.abs(slow[:, half:].mean(axis=1) - slow[:, :half].mean(axis=1)) * 2.0
    # First the reason that says most about the drive.
    reasons = {
        f"slower than {SLOWEST * 3.6:.0f} km/h": mean * radius < SLOWEST,
        "braking": windows(braked(values), count).any(axis=1),
        "turning": np.abs(windows(values["accel_y_m_per_s2"], count).mean(axis=1)) > MOST_LATERAL,
        "changing speed": change > MOST_CHANGE * mean,
    }
    usable, left_out = np.ones(len(mean), dtype=bool), {}
    for reason, wrong in reasons.items():
        left_out[reason] = int(np.count_nonzero(usable & wrong))
        usable &= ~wrong
    frequency = np.fft.rfftfreq(count, interval)
    turns = mean[usable] / (2.0 * np.pi)
    order = np.maximum(np.round(frequency / turns[:, None]), 1.0)
    hidden = np.abs(frequency - order * turns[:, None]) < ORDER_WIDTH
    amplitude = {}
    for place in PLACES:
        each = rotation[place][usable]
        amplitude[f"speed_{place}"] = amplitudes(each / each.mean(axis=1, keepdims=True), interval)
        if (name := f"wheel_accel_{place}_m_per_s2") in values:
            amplitude[f"accel_{place}"] = amplitudes(windows(values[name], count)[usable], interval)
    if (name := "body_accel_z_m_per_s2") in values:
        amplitude["body"] = amplitudes(windows(values[name], count)[usable], interval)
    for each in amplitude.values():
        each[hidden] = np.nan
    speed = mean[usable] * radius
    start = signals.time[0] + np.flatnonzero(usable) * half * interval
    air = np.full(len(speed), np.nan)
    if (name := "ambient_temperature_degC") in values:
        air = windows(values[name], count).mean(axis=1)[usable]
    return Spectra(frequency, amplitude, speed, start, wheelbase / speed, air, len(mean), left_out)


def amplitudes(values: Array, interval: float) -> Array:
    """Complex amplitudes (w, frequencies) of windows (w, n), whose mean square is the one-sided power density."""
    taper = signal.windows.hann(values.shape[1], sym=False)
    straight = signal.detrend(values, axis=1) if len(values) else values
    return np.asarray(np.fft.rfft(straight * taper, axis=1) * np.sqrt(2.0 * interval / np.sum(taper**2)))


def mean_shown(values: Array) -> Array:
    """Means (frequencies,) over the windows that show a frequency; NaN where none does."""
    shown = np.isfinite(values)
    count = shown.sum(axis=0)
    mean = np.where(shown, values, 0.0).sum(axis=0) / np.maximum(count, 1)
    mean[count == 0] = np.nan
    return np.asarray(mean)


def density(amplitude: Array) -> Array:
    """Power density (frequencies,) over the windows."""
    return mean_shown(np.abs(amplitude) ** 2)


def cross(front: Array, rear: Array, frequency: Array, delay: Array) -> Array:
    """Cross density (frequencies,) of a rear with a front wheel, the delay (windows,) [s] of the road taken out."""
    return mean_shown(np.conj(front) * rear * np.exp(2j * np.pi * frequency * delay[:, None]))


def swing(some: Spectra, sensor: str) -> float:
    """Power of the wheels at their hop over that above it, where the sensor's own noise is not below: the median wheel's."""
    power = [density(some.amplitude[f"{sensor}_{place}"]) for place in PLACES]
    at, above = ([np.nanmean(each[within(some.frequency, band)]) for each in power] for band in (HOP, ABOVE))
    return float(np.median(np.array(at) / np.maximum(above, np.finfo(float).tiny)))


def coherence(some: Spectra, sensor: str) -> float:
    """Coherence [1] at wheel hop of the rear wheels with the front wheels that ran over the same road; mean of the sides."""
    there = within(some.frequency, HOP)
    found = []
    for side in "lr":
        front, rear = (some.amplitude[f"{sensor}_{end}{side}"] for end in "fr")
        shared = np.abs(cross(front, rear, some.frequency, some.delay)) ** 2
        found.append(np.nanmean(shared[there] / (density(front) * density(rear))[there]))
    return float(np.mean(found))


def taken(some: Spectra, which: slice) -> Spectra:
    """Some of the windows."""
    amplitude = {name: each[which] for name, each in some.amplitude.items()}
    return replace(
        some, amplitude=amplitude, speed=some.speed[which], start=some.start[which], delay=some.delay[which],
        air=some.air[which],
    )  # fmt: skip
