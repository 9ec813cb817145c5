"""Datasets as a user makes them with the model itself: textbook formulas on its force, sampled at points.

The formulas are neither those of `effects/` nor those of `blind_trials`: each is the first one a text book has. Samples are at
points, equally many in every oscillation, so that what they miss at a jump of the force does not average out.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import tomlkit
from scipy.signal import lfilter

from twintube.arrays import Array
from twintube.dampers import Damper, load
from twintube.engine.simulate import Simulation, simulate
from twintube.rig.signals import AMPLITUDE

VELOCITIES = (0.04, 0.131, 0.262, 0.393, 0.524, 0.786, 1.048, 1.571)  # [m/s]
OSCILLATIONS, SAMPLES, FINE = 20, 300, 20


@dataclass
class Motion:
    """A sine that starts at full velocity, and what the model makes of it; arrays (n,) in SI units."""

    damper: Damper
    time: Array
    stroke: Array
    velocity: Array
    dt: float
    results: dict[float, Simulation] = field(default_factory=dict)  # by the oil level

    def at(self, level: float) -> Simulation:
        """The model at an oil level, in steps much finer than the samples."""
        if level not in self.results:
            fine = np.linspace(0.0, self.time[-1], FINE * (len(self.time) - 1) + 1)
            omega = self.velocity[0] / AMPLITUDE
            z, v = AMPLITUDE * np.sin(omega * fine), self.velocity[0] * np.cos(omega * fine)
            damper = self.damper.with_(oil_level=level, gas_preload=int(level == 1.0))
            result = simulate(damper, z, v, fine)
            columns = {name: column[::FINE] for name, column in result.columns.items()}
            self.results[level] = Simulation(z[::FINE], v[::FINE], **columns)
        return self.results[level]

    def late(self, values: Array, tau: float) -> Array:
        """Values (n,) behind a first-order lag of `tau` [s]."""
        share = 1.0 - np.exp(-self.dt / tau)
        return np.asarray(lfilter([share], [1.0, share - 1.0], values - values[0])) + values[0]


def none(m: Motion, level: float) -> Array:
    return m.at(level).force


def fluid_lag(m: Motion, level: float) -> Array:
    """tau dF/dt = F_static - F."""
    fluid = m.at(level).F_fluid
    return m.at(level).force - fluid + m.late(fluid, 0.004)


def smooth_transition(m: Motion, level: float) -> Array:
    """tau dk/dt = k_static - k."""
    k = m.at(level).k_degr
    return m.at(level).force + (m.late(k, 0.012) - k) * m.at(1.0).F_fluid


def oil_temperature(m: Motion, level: float) -> Array:
    """A lumped heat capacity, a fluid force that falls by 0.8 % per kelvin."""
    fluid, force, T = m.at(level).F_fluid, m.at(level).force.copy(), 0.0
    for i in range(len(force)):
        force[i] -= 0.008 * T * fluid[i]
        T += m.dt * (abs(force[i] * m.velocity[i]) - 2.0 * T) / 220.0
    return force


def gas_spring(m: Motion, level: float) -> Array:
    """A linear spring and a constant force, without the intact state's preload."""
    return m.at(level).force - (0.0 if level == 1.0 else 110.0 - 1400.0 * m.stroke)


def end_stop(m: Motion, level: float) -> Array:
    """A linear spring on one side."""
    return m.at(level).force + 1.2e5 * np.maximum(m.stroke - 0.8 * AMPLITUDE, 0.0)


def side_load_friction(m: Motion, level: float) -> Array:
    return m.at(level).force + 75.0 * np.tanh(m.velocity / 0.005)


def valve_wear(m: Motion, level: float) -> Array:
    """Another constant factor for each direction."""
    return m.at(level).force - np.where(m.velocity > 0, 0.15, 0.09) * m.at(level).F_fluid


def oil_level_error(m: Motion, level: float) -> Array:
    return m.at(level if level == 1.0 else level - 0.055).force


def force_offset(m: Motion, level: float) -> Array:
    return m.at(level).force + 110.0


def channel_delay(m: Motion, level: float) -> Array:
    return np.interp(m.time - 0.004, m.time, m.at(level).force)


FORMULAS: dict[str, Callable[[Motion, float], Array]] = {
    formula.__name__: formula
    for formula in (
        none, fluid_lag, smooth_transition, oil_temperature, gas_spring, end_stop, side_load_friction, valve_wear,
        oil_level_error, force_offset, channel_delay,
    )
}  # fmt: skip


def write(kind: str, folder: Path, seed: int = 0, noise: float = 0.01) -> Path:
    """A dataset of SA8 with every state and velocity; `noise` is a share of each record's largest force."""
    damper, rng = load("SA8", as_published=True), np.random.default_rng(seed)
    records = tomlkit.aot()
    for level in (1.0, *damper.measured_levels):
        for velocity in VELOCITIES:
            time = np.linspace(0.0, OSCILLATIONS * 2 * np.pi * AMPLITUDE / velocity, OSCILLATIONS * SAMPLES + 1)
            omega = velocity / AMPLITUDE
            motion = Motion(damper, time, AMPLITUDE * np.sin(omega * time), velocity * np.cos(omega * time), float(time[1]))
            force = FORMULAS[kind](motion, level)
            force = force + noise * np.abs(force).max() * rng.standard_normal(len(force))
            name = f"oil_{100 * level:.0f}_v{1000 * velocity:.0f}.csv"
            np.savetxt(
                folder / name, np.column_stack([time, 1e3 * motion.stroke, force]), fmt=("%.6f", "%.5f", "%.3f"),
                delimiter=",", header="time [s],stroke [mm],force [N]", comments="",
            )  # fmt: skip
            records.append(
                tomlkit.item({"file": name, "measurement": "harmonic", "oil_level": level, "gas_preload": level == 1.0})
            )
    document = tomlkit.document()
    document["title"], document["damper"], document["record"] = f"Textbook {kind}", "SA8", records
    (folder / "dataset.toml").write_text(tomlkit.dumps(document), encoding="utf-8")
    return folder
