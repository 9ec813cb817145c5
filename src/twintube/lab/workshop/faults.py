"""Faults of the measurement, and what is none of the named causes (backlash, resonance, hum and others)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import bilinear, lfilter

from twintube import load
from twintube.dampers import Damper
from twintube.lab.workshop.cause import Cause, Channels, Run, Trial
from twintube.lab.workshop.motions import smoothed

Array = NDArray[np.float64]


@dataclass
class Scaled(Cause):
    """Gains and zeros of the channels, a factor of the clock; in one record alone where `only` is not -1."""

    force_gain: float = 1.0
    force_zero: float = 0.0  # [N]
    stroke_gain: float = 1.0
    clock: float = 1.0
    only: int = -1

    def measure(self, channels: Channels) -> None:
        """Change the channels."""
        if self.only in (-1, channels.trial.index):
            channels.force = channels.force * self.force_gain + self.force_zero
            channels.stroke = channels.stroke * self.stroke_gain
            channels.factor *= self.clock


@dataclass
class Late(Cause):
    """The force channel is `delay` [s] behind the stroke (filter of an amplifier, other bus)."""

    delay: float = 0.0

    def measure(self, channels: Channels) -> None:
        """Shift."""
        t = channels.trial.time
        channels.force = np.interp(t - self.delay, t, channels.force)


@dataclass
class Drift(Cause):
    """Zero of the load cell that creeps over the run: `size` (1 - exp(-t/tau)) or `size` t / tau (warm-up, creep)."""

    size: float = 0.0  # [N]
    tau: float = 100.0  # [s]
    settles: bool = False

    def measure(self, channels: Channels) -> None:
        """Add the drift at the time of the run."""
        x = (channels.trial.begin + channels.trial.time) / self.tau
        channels.force = channels.force + self.size * (1.0 - np.exp(-x) if self.settles else x)


@dataclass
class Stranger(Cause):
    """One record is of another damper."""

    only: int = 0
    other: str = "SA8"

    def damper(self, damper: Damper, trial: Trial) -> Damper:
        """The other damper with the level that stands on the sheet."""
        if trial.index != self.only:
            return damper
        return load(self.other, as_published=True).with_(oil_level=trial.level, gas_preload=int(trial.preload))


@dataclass
class Clipped(Cause):
    """Load cell or amplifier at its limit [N]."""

    limit: float = 1e9

    def measure(self, channels: Channels) -> None:
        """Cut."""
        channels.force = np.clip(channels.force, -self.limit, self.limit)


@dataclass
class Play(Cause):
    """Play [m] in a joint: the damper follows by the play operator; in between no force is transmitted."""

    play: float = 0.0
    soft: float = 0.002  # [s] over which the joint takes up speed

    def path(self, x: Array, trial: Trial) -> Array:
        """Stroke of the damper."""
        z, out = float(x[0]), np.empty(len(x))
        for i, at in enumerate(x.tolist()):
            z = min(max(z, at - 0.5 * self.play), at + 0.5 * self.play)
            out[i] = z
        return smoothed(out, round(self.soft * trial.rate)) if self.play > 0 else x

    def force(self, run: Run) -> None:
        """Nothing while the joint floats."""
        if self.play > 0:
            floating = np.abs(run.trial.x - run.z) < 0.5 * self.play - 2e-5
            run.extra -= np.where(floating, run.force, 0.0)


@dataclass
class Resonance(Cause):
    """Frame and load cell as mass and spring: H = w^2 / (s^2 + 2 D w s + w^2)."""

    frequency: float = 80.0
    damping: float = 0.03

    def measure(self, channels: Channels) -> None:
        """Filter, from rest at the first value."""
        w = 2 * np.pi * self.frequency
        b, a = bilinear([w * w], [1.0, 2 * self.damping * w, w * w], channels.trial.rate)
        channels.force = lfilter(b, a, channels.force - channels.force[0]) + channels.force[0]


@dataclass
class Hum(Cause):
    """50 Hz of the mains with a third harmonic in the force channel."""

    amplitude: float = 0.0

    def measure(self, channels: Channels) -> None:
        """Add."""
        angle = 2 * np.pi * 50.0 * (channels.trial.begin + channels.trial.time)
        channels.force = channels.force + self.amplitude * (np.sin(angle) + 0.3 * np.sin(3 * angle + 0.8))


@dataclass
class Lost(Cause):
    """Samples lost on the way of a telemetry: the force is 0 for some milliseconds, some times per record."""

    count: int = 5
    longest: float = 0.02
    seed: int = 0

    def sampled(self, force: Array, trial: Trial, fs: float) -> Array:
        """Zero pieces."""
        draw = np.random.default_rng((self.seed, trial.index))
        out = force.copy()
        for _ in range(self.count):
            start = int(draw.integers(len(out)))
            out[start : start + max(1, round(draw.uniform(0.3, 1.0) * self.longest * fs))] = 0.0
        return out


@dataclass
class Inertia(Cause):
    """Clamp and rod between load cell and damper: F + m z'' (d'Alembert)."""

    mass: float = 0.0

    def force(self, run: Run) -> None:
        """Add the inertia of the moved side."""
        run.extra += self.mass * smoothed(np.gradient(run.v, 1.0 / run.trial.rate), round(0.004 * run.trial.rate))
