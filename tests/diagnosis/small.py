"""Small datasets: a few short sines of SA8 through the simulation itself, with whatever is hidden in them added here."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import tomlkit

from twintube.common.arrays import Array
from twintube.dampers import Damper, load
from twintube.data import MEASURED, LoadedDataset, Record
from twintube.diagnosis.problem import Problem
from twintube.diagnosis.records.prepare import prepare
from twintube.engine.simulate import simulate
from twintube.rig.signals import AMPLITUDE

SPEEDS = (0.1, 0.3, 0.6, 1.0)  # [m/s]
SLOW = 0.05  # [m/s] of the strokes before the fast ones
FINE = 10  # steps of the simulation per sample
INTACT, DEGRADED = 1.0, 0.56


@dataclass(frozen=True)
class Run:
    """What happens in the rig, much finer than it is sampled: arrays (n,) in SI units; the force is that of SA8."""

    level: float
    speed: float
    time: Array
    stroke: Array
    velocity: Array
    force: Array
    fluid: Array
    friction: Array
    gas: Array

    def at(self, values: Array, time: Array) -> Array:
        """Values (n,) at other times [s]."""
        return np.interp(time, self.time, values)


Formula = Callable[[Run], Array]


def run(
    speed: float,
    level: float = INTACT,
    *,
    turns: int = 8,
    samples: int = 160,
    slow: int = 0,
    damper: Damper | None = None,
    gas: float | None = None,
) -> Run:
    """Sines of a top speed [m/s] that begin at the lowest stroke, after a number of `slow` strokes.

    A damper that has lost oil has lost its gas, unless a share of it is given.
    """
    parts, begin = [], 0.0
    for velocity, count in ((SLOW, slow), (speed, turns)):
        if count:
            omega = velocity / AMPLITUDE
            t = np.linspace(0.0, 2 * np.pi * count / omega, FINE * samples * count + 1)[bool(parts) :]
            parts.append((begin + t, -AMPLITUDE * np.cos(omega * t), velocity * np.sin(omega * t)))
            begin = float(parts[-1][0][-1])
    time, stroke, velocities = (np.concatenate(some) for some in zip(*parts, strict=True))
    share = float(level == INTACT) if gas is None else gas
    given = (damper or load("SA8", as_published=True)).with_(oil_level=level, gas_preload=share)
    result = simulate(given, stroke, velocities, time)
    return Run(level, speed, time, stroke, velocities, result.force, result.F_fluid, result.F_friction, result.F_gas)


def record(
    r: Run,
    force: Array | None = None,
    *,
    noise: float = 0.005,
    seed: int = 0,
    begin: float = 0.0,
    temperature: Array | None = None,
) -> Record:
    """The run as points sampled at every FINE-th step from a time on, with a share of the largest force as noise."""
    rows = slice(int(np.searchsorted(r.time, begin)), None, FINE)
    seen = (r.force if force is None else force)[rows]
    seen = seen + noise * np.abs(seen).max() * np.random.default_rng(seed).standard_normal(len(seen))
    name = f"oil_{100 * r.level:.0f}_v{1000 * r.speed:.0f}"
    warm = None if temperature is None else temperature[rows]
    return Record(
        name, name + ".csv", "harmonic", r.level, r.level == INTACT, None, None, r.time[rows], r.stroke[rows], seen,
        r.velocity[rows], MEASURED, warm, (),
    )  # fmt: skip


def records(
    formula: Formula | None = None, speeds: Sequence[float] = SPEEDS, levels: Sequence[float] = (INTACT,)
) -> list[Record]:
    """A record of every speed and level; `formula` is the force that a run shows."""
    runs = [run(speed, level, slow=0 if level == INTACT else 2) for level in levels for speed in speeds]
    return [record(r, None if formula is None else formula(r), seed=i) for i, r in enumerate(runs)]


def problem(several: Sequence[Record]) -> Problem:
    """The model against the records."""
    damper = load("SA8", as_published=True)
    return Problem(damper, prepare(LoadedDataset("Small", damper, list(several), [])))


def write(several: Sequence[Record], folder: Path, **keys: Mapping[str, object]) -> Path:
    """The dataset folder; `keys` are further entries of a record by its name."""
    folder.mkdir(parents=True, exist_ok=True)
    tables = tomlkit.aot()
    for r in several:
        columns = {"time [s]": r.time, "stroke [mm]": 1e3 * r.stroke, "force [N]": r.force}
        if r.temperature is not None:
            columns["temperature [degC]"] = r.temperature
        np.savetxt(
            folder / r.file, np.column_stack(list(columns.values())), fmt="%.6f", delimiter=",", header=",".join(columns),
            comments="",
        )  # fmt: skip
        entry = {"file": r.file, "measurement": r.measurement, "oil_level": r.oil_level, "gas_preload": r.gas_preload}
        tables.append(tomlkit.item(entry | dict(keys.get(r.name, {}))))
    document = tomlkit.document()
    document["title"], document["damper"], document["record"] = "Small", "SA8", tables
    (folder / "dataset.toml").write_text(tomlkit.dumps(document), encoding="utf-8")
    return folder
