"""The bench: what the operator drives, and what load cell, stroke sensor and recorder make of it."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.signal import butter, iirpeak, lfilter

from worlds.imperfect.law import RATE, Array, Law, curve

SPEEDS: Final = (0.025, 0.05, 0.1, 0.131, 0.262, 0.393, 0.524, 0.786, 1.048, 1.572)  # [m/s], VDA style
AMPLITUDES: Final = (0.02, 0.025, 0.03, 0.04, 0.045, 0.05)  # [m]
FASTEST: Final = 7.0  # [Hz] that a bench drives
LONGEST: Final = 30.0  # [s] of a record
V_SETTLING: Final = 0.05  # [m/s] of the slow oscillations that settle the oil before every record
SETTLING: Final = 6
HEAT: Final = (1100.0, 1600.0)  # [J/K] of damper and oil: 2 kg of steel, 0.2 to 0.3 kg of oil, and what sits on them
COOLING: Final = 600.0  # [s], time constant of a damper in still air with a fan somewhere in the room
THERMOCOUPLE: Final = 40.0  # [s] by which the tube's surface follows the oil
STROKE_STEP: Final = 2e-6  # [m], resolution of a magnetostrictive sensor


@dataclass(frozen=True)
class Motion:
    """What one record is to contain."""

    measurement: str
    name: str
    z: Array  # (n,) [m] at RATE, with what is driven before the recording
    first: int  # sample at which the recording begins
    period: float = 0.0  # [s] of a cycle, 0 where there is none
    steady: int = 0  # sample from which cycles are equal


@dataclass(frozen=True)
class Fault:
    """What is wrong with the channels; the defaults are a channel in order."""

    gain: float = 1.0
    zero: float = 0.0  # [N]
    delay: float = 0.0  # [s]
    stroke_gain: float = 1.0
    sign: int = 1  # -1: the machine counts compression positive, both channels
    unit: float = 1.0  # newtons in what the recorder calls a newton
    ringing: tuple[float, float, float] = (0.0, 40.0, 0.05)  # share of the force, frequency [Hz], damping of the frame
    contact: float = 0.0  # [N] of steps from a loose connector


@dataclass(frozen=True)
class Bench:
    """A bench, the same on every day."""

    rate: int  # [Hz]
    noise: float  # RMS [N]
    corner: float  # [Hz] below which the noise has its memory
    hum: float  # amplitude [N] at 50 Hz
    delay: float  # [s] of the force behind the stroke
    stroke_noise: float  # RMS [m]
    compliance: float  # [m/N] of frame, clevis and load cell
    heat: float  # [J/K] of a damper on it
    temperature: str  # column | start | none: what the files say about it
    slow_lead: bool  # whether recording begins with a slow cycle or in the steady motion
    style: int  # of the recorder's files

    @property
    def noise_rms(self) -> float:
        """Of noise and hum together [N]."""
        return float(np.hypot(self.noise, self.hum / np.sqrt(2)))


def draw_bench(rng: np.random.Generator) -> Bench:
    """Load cells of 10 to 25 kN and class 0.1 to 0.5, hydraulic and crank benches of 5 to 30 kN/mm."""
    return Bench(
        rate=int(rng.choice([200, 250, 500, 1000, 2000], p=[0.1, 0.15, 0.35, 0.3, 0.1])),
        noise=float(np.exp(rng.uniform(np.log(1.0), np.log(8.0)))), corner=float(rng.uniform(5.0, 40.0)),
        hum=float(rng.uniform(0.0, 3.0)), delay=float(rng.uniform(0.0, 0.5e-3)),
        stroke_noise=float(rng.uniform(2e-6, 15e-6)), compliance=float(1.0 / rng.uniform(5e6, 30e6)),
        heat=float(rng.uniform(*HEAT)),
        temperature=str(rng.choice(["column", "start", "none"], p=[0.4, 0.3, 0.3])), slow_lead=bool(rng.random() < 0.5),
        style=int(rng.integers(0, 3)),
    )  # fmt: skip


def settled(amplitude: float) -> Array:
    """Slow oscillations that begin softly and end in the middle, on the way into rebound."""
    omega = V_SETTLING / amplitude
    t = np.arange(0.0, SETTLING * 2 * np.pi / omega, 1.0 / RATE)
    return amplitude * np.sin(omega * t) * np.clip(t / 1.0, 0.0, 1.0)


def sine(bench: Bench, speed: float, amplitude: float, tag: str = "") -> Motion:
    """A sine after slow oscillations, taken up within a second; 5 to 8 s of it where fast, five cycles where slow."""
    amplitude = max(amplitude, round(speed / (2 * np.pi * FASTEST), 3))
    before, period = settled(amplitude), 2 * np.pi * amplitude / speed
    lasts = float(np.clip(5 * period, 5.0 if speed > 0.8 else 8.0, 22.0))
    omega = np.concatenate([np.linspace(V_SETTLING, speed, RATE), np.full(round(lasts * RATE), speed)]) / amplitude
    z = np.concatenate([before, amplitude * np.sin(np.cumsum(omega) / RATE)])
    slow = round(2 * np.pi * amplitude / V_SETTLING * RATE) if bench.slow_lead else 0
    steady = len(before) + RATE
    return Motion("harmonic", f"sine{tag}_{1000 * speed:04.0f}", z, len(before) - slow if slow else steady, period, steady)


def triangle(bench: Bench, speed: float, amplitude: float, tag: str = "") -> Motion:
    """Nearly two cycles of a slow triangle, of at most LONGEST; a controller leaves its corners round over 0.1 s."""
    amplitude = min(amplitude, round(LONGEST / 1.75 * speed / 4, 3))
    before, period = settled(amplitude), 4 * amplitude / speed
    t = np.arange(0.0, min(1.75 * period, LONGEST), 1.0 / RATE)
    ramp = amplitude * 2 / np.pi * np.arcsin(np.sin(2 * np.pi * t / period))
    corner = np.hanning(RATE // 10)
    z = np.convolve(np.concatenate([before, ramp, np.full(RATE // 20, ramp[-1])]), corner / corner.sum(), "same")
    return Motion("quasi-static", f"slow{tag}_{1000 * speed:03.0f}", z[: len(before) + len(t)], len(before))


def road(bench: Bench, amplitude: float, rng: np.random.Generator, tag: str = "") -> Motion:
    """A drive: body near 1.3 Hz, wheel near 11 Hz, coloured noise in between, as a damper stroke."""
    before, n = settled(amplitude), round(rng.uniform(15.0, LONGEST) * RATE)
    f = np.fft.rfftfreq(n, 1.0 / RATE)[1:]
    shape = 1.0 / np.hypot(1 - (f / 1.3) ** 2, 0.5 * f / 1.3) + 0.06 / np.hypot(1 - (f / 11.0) ** 2, 0.3 * f / 11.0)
    spectrum = shape * (f > 0.3) * (f < 25.0) * np.exp(2j * np.pi * rng.random(len(f))) / np.sqrt(f)
    z = np.fft.irfft(np.concatenate([[0.0], spectrum]), n)
    z *= amplitude * rng.uniform(0.6, 1.0) / np.abs(z).max() * np.clip(np.arange(n) / RATE, 0.0, 1.0)
    return Motion("stochastic", f"road{tag}", np.concatenate([before, z]), len(before))


def warmed(law: Law, bench: Bench, motion: Motion, start: float, room: float) -> Array:
    """Temperature of the oil [degC] (n,): the damper's own work heats it, the room cools it."""
    v = np.gradient(motion.z) * RATE
    heating = lfilter([1.0 / RATE], [1.0, -np.exp(-1.0 / (RATE * COOLING))], curve(law.damper, v) * v / bench.heat)
    return np.asarray(room + (start - room) * np.exp(-np.arange(len(v)) / (RATE * COOLING)) + heating)


def noise(bench: Bench, n: int, rng: np.random.Generator) -> Array:
    """Half of the power white, half below the corner; hum with its third harmonic."""
    memory = np.exp(-2 * np.pi * bench.corner / bench.rate)
    slow = lfilter([np.sqrt(1 - memory**2)], [1.0, -memory], rng.standard_normal(n))
    phase = 2 * np.pi * (50.0 * np.arange(n) / bench.rate + rng.random())
    hum = bench.hum * (np.sin(phase) * np.sqrt(0.9) + np.sin(3 * phase) * np.sqrt(0.1))
    return np.asarray(bench.noise * np.sqrt(0.5) * (slow + rng.standard_normal(n)) + hum)


def seen(bench: Bench, fault: Fault, z: Array, force: Array, contact: Array) -> tuple[Array, Array]:
    """Stroke and force as the amplifiers give them, at RATE; without noise, zero and gain of the day."""
    share, frequency, damping = fault.ringing
    if share > 0.0:
        force = force + share * lfilter(*iirpeak(frequency, 1.0 / (2 * damping), RATE), force)
    force = force + contact
    at = np.arange(len(z)) - (bench.delay + fault.delay) * RATE
    force = fault.sign * (fault.gain * np.interp(at, np.arange(len(z)), force) + fault.zero) / fault.unit
    return fault.sign * fault.stroke_gain * z, force


def recorded(bench: Bench, motion: Motion, stroke: Array, force: Array) -> tuple[Array, Array]:
    """Both channels behind the recorder's filter, as samples (m,) at its rate."""
    if bench.rate < RATE:
        b, a = butter(2, 0.4 * bench.rate, fs=RATE)
        stroke = lfilter(b, a, stroke - stroke[0]) + stroke[0]
        force = lfilter(b, a, force - force[0]) + force[0]
    return stroke[motion.first :: RATE // bench.rate], force[motion.first :: RATE // bench.rate]
