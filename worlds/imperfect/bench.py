"""The bench: what the operator drives, and what load cell, stroke sensor and recorder make of it."""

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from scipy.signal import iirpeak, lfilter

from twintube.common.arrays import Array
from worlds.bench import faults
from worlds.bench.motions import Piece, joined, swing
from worlds.bench.motions import road as road_of
from worlds.bench.motions import triangle as triangle_of
from worlds.bench.plan import RNG, Channels, Motion, Record, chance
from worlds.bench.sampler import Recorder, channels, coloured
from worlds.bench.valves import curve
from worlds.imperfect.law import RATE, Law

SPEEDS: Final = (0.025, 0.05, 0.1, 0.131, 0.262, 0.393, 0.524, 0.786, 1.048, 1.572)  # [m/s], VDA style
AMPLITUDES: Final = (0.02, 0.025, 0.03, 0.04, 0.045, 0.05)  # [m]
FASTEST: Final = 7.0  # [Hz] that a bench drives
BRISK: Final = 0.8  # [m/s] beyond which a record is shorter: the damper would get hot
LONGEST: Final = 30.0  # [s] of a record
V_SETTLING: Final = 0.05  # [m/s] of the slow oscillations that settle the oil before every record
SETTLING: Final = 6
HEAT: Final = (1100.0, 1600.0)  # [J/K] of damper and oil: 2 kg of steel, 0.2 to 0.3 kg of oil, and what sits on them
COOLING: Final = 600.0  # [s], time constant of a damper in still air with a fan somewhere in the room
THERMOCOUPLE: Final = 40.0  # [s] by which the tube's surface follows the oil
STROKE_STEP: Final = 2e-6  # [m], resolution of a magnetostrictive sensor


@dataclass(frozen=True)
class Test:
    """What one record is to contain."""

    measurement: str
    name: str
    motion: Motion  # at RATE, with what is driven before the recording


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


def draw_bench(rng: RNG) -> Bench:
    """Load cells of 10 to 25 kN and class 0.1 to 0.5, hydraulic and crank benches of 5 to 30 kN/mm."""
    return Bench(
        rate=int(rng.choice([200, 250, 500, 1000, 2000], p=[0.1, 0.15, 0.35, 0.3, 0.1])),
        noise=float(np.exp(rng.uniform(np.log(1.0), np.log(8.0)))), corner=float(rng.uniform(5.0, 40.0)),
        hum=float(rng.uniform(0.0, 3.0)), delay=float(rng.uniform(0.0, 0.5e-3)),
        stroke_noise=float(rng.uniform(2e-6, 15e-6)), compliance=float(1.0 / rng.uniform(5e6, 30e6)),
        heat=float(rng.uniform(*HEAT)),
        temperature=str(rng.choice(["column", "start", "none"], p=[0.4, 0.3, 0.3])), slow_lead=chance(rng, 0.5),
        style=int(rng.integers(0, 3)),
    )  # fmt: skip


def settled(amplitude: float) -> Piece:
    """Slow oscillations that begin softly and end in the middle."""
    return swing(V_SETTLING, amplitude, SETTLING, 1.0 / RATE, 1.0)


def sine(bench: Bench, speed: float, amplitude: float, tag: str = "") -> Test:
    """A sine after slow oscillations, taken up within a second; 5 to 8 s of it where fast, five cycles where slow."""
    amplitude = max(amplitude, round(speed / (2 * np.pi * FASTEST), 3))
    before, period = settled(amplitude), 2 * np.pi * amplitude / speed
    lasts = float(np.clip(5 * period, 5.0 if speed > BRISK else 8.0, 22.0))
    t, z, v = (part[:-RATE] for part in swing(speed, amplitude, (lasts + 1.0) / period, 1.0 / RATE, 1.0))
    steady = len(before[0]) - 1 + RATE
    slow = round(2 * np.pi * amplitude / V_SETTLING * RATE)
    motion = replace(joined([before, (t, z, v)]), first=len(before[0]) - slow if bench.slow_lead else steady)
    return Test("harmonic", f"sine{tag}_{1000 * speed:04.0f}", replace(motion, period=period, steady=steady))


def triangle(speed: float, amplitude: float, tag: str = "") -> Test:
    """Nearly two cycles of a slow triangle, of at most LONGEST; a controller leaves its corners round over 0.1 s."""
    amplitude = min(amplitude, round(LONGEST / 1.75 * speed / 4, 3))
    motion = joined([settled(amplitude), triangle_of(speed, amplitude, 7, 1.0 / RATE, 0.1)], 1)
    return Test("quasi-static", f"slow{tag}_{1000 * speed:03.0f}", motion)


def road(amplitude: float, rng: RNG, tag: str = "") -> Test:
    """A drive."""
    drive = road_of(rng, np.inf, amplitude * rng.uniform(0.6, 1.0), rng.uniform(15.0, LONGEST), 1.0 / RATE)
    return Test("stochastic", f"road{tag}", joined([settled(amplitude), drive], 1))


def warmed(law: Law, bench: Bench, motion: Motion, start: float, room: float) -> Array:
    """Temperature of the oil [degC] (n,): the damper's own work heats it, the room cools it."""
    v = np.gradient(motion.stroke) * RATE
    heating = lfilter([1.0 / RATE], [1.0, -np.exp(-1.0 / (RATE * COOLING))], curve(law.damper, v) * v / bench.heat)
    return np.asarray(room + (start - room) * np.exp(-np.arange(len(v)) / (RATE * COOLING)) + heating)


def noise(bench: Bench, n: int, rng: RNG) -> Array:
    """Half of the power white, half below the corner; hum with its third harmonic."""
    slow = coloured(rng, n, float(np.exp(-2 * np.pi * bench.corner / bench.rate)))
    phase = 2 * np.pi * (50.0 * np.arange(n) / bench.rate + rng.random())
    hum = bench.hum * (np.sin(phase) * np.sqrt(0.9) + np.sin(3 * phase) * np.sqrt(0.1))
    return np.asarray(bench.noise * np.sqrt(0.5) * (slow + rng.standard_normal(n)) + hum)


def recorded(bench: Bench, fault: Fault, motion: Motion, force: Array, contact: Array | float = 0.0) -> list[Array]:
    """Times, stroke and force (m,) that the recorder has of forces (n,) at RATE; without noise, zero and gain of the day."""
    share, frequency, damping = fault.ringing
    if share > 0.0:
        force = force + share * lfilter(*iirpeak(frequency, 1.0 / (2 * damping), RATE), force)
    nothing = Record("", 0, "", 1.0, True, 0.0, 0.0)
    c = Channels(record=nothing, motion=motion, stroke=motion.stroke, force=force + contact)
    faults.late(c, force=bench.delay + fault.delay)
    gain = fault.sign / fault.unit
    faults.scaled(c, gain * fault.gain, gain * fault.zero, fault.sign * fault.stroke_gain)
    kind = "filtered" if bench.rate < RATE else "point"
    return channels(c.time, c.start, [(c.stroke, kind, None), (c.force, kind, None)], Recorder(bench.rate, kind))
