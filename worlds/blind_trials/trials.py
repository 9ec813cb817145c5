"""Trials: datasets as measured on a rig, with a hidden effect or fault.

trial      draw and simulate a trial
write      write it as a dataset folder
dataset    the trial as `twintube.data` reads it
"""

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from zlib import crc32

import numpy as np

from twintube.dampers import Damper, load
from twintube.data import LoadedDataset, load_dataset
from twintube.rig.signals import AMPLITUDE
from worlds.bench.files import FORCE, LAYOUTS, STROKE, TIME, write_dataset
from worlds.bench.plan import RNG, chance
from worlds.blind_trials.damper import march, tube
from worlds.blind_trials.excitation import LONG_PAUSE, V_REST, VELOCITIES, Excitation, harmonic, quasi_static, recovery
from worlds.blind_trials.hidden import EFFECTS, FAULTS, KINDS, OUTSIDE, Secret, secret
from worlds.blind_trials.model import CELL
from worlds.blind_trials.quantities import Array, Hidden

__all__ = ["DAMPER", "EFFECTS", "FAULTS", "KINDS", "OUTSIDE", "Trial", "TrialRecord", "dataset", "trial", "write"]

DAMPER = {"smooth_transition": "SA7"}  # the damper of a kind that has little effect in SA8
SLOWEST, FASTEST, QUASI_STATIC = 100.0, 2000.0, 50.0  # [Hz] sampling
WARM = 273.15 + 25.0  # [K]
RESTS, FULLER = (10.0, 180.0), 0.9  # [s], [1] pauses of the recovery records, and their level above the measured one
MAINS = 49.98  # [Hz] not exactly 50: sampling at 50 Hz would give a constant
TARE = 0.003  # of the peak: the largest standard deviation of the zeros of the records; 0.05 % of a 20 kN cell is 10 N


@dataclass(frozen=True)
class TrialRecord:
    """One measured record; arrays (n,), SI units, stroke and force positive in rebound unless a fault changes that."""

    file: str
    measurement: str  # quasi-static or harmonic
    oil_level: float  # [1] as recorded
    gas_preload: bool
    start_temperature_degC: float
    time: Array
    stroke: Array
    force: Array
    velocity: Array | None  # None where the rig does not measure it
    noise_N: float  # standard deviation of the noise of the force


@dataclass(frozen=True)
class Trial:
    """A dataset and, for reports only, its hidden content."""

    kind: str
    seed: int
    strength: float
    truth: dict[str, float]
    damper: str
    records: list[TrialRecord]


@dataclass(frozen=True)
class Plan:
    """One record before it is measured."""

    file: str
    level: float
    preload: bool
    excitation: Excitation
    velocity: float  # [m/s] of its blocks, 0: quasi-static


@dataclass(frozen=True)
class Channels:
    """A record's channels before noise."""

    plan: Plan
    time: Array
    stroke: Array
    velocity: Array
    force: Array
    start: float  # [K]


def plans(damper: Damper, blocks: Sequence[float], recover: Sequence[float] = (), seconds: float = 20.0) -> list[Plan]:
    """The records of a dataset; a record with a long pause belongs to the block of its velocity.

    With velocities `recover` [m/s] also long blocks of about `seconds`, a pause and a block, without preload.
    """
    records = [Plan("intact_quasi_static", 1.0, True, quasi_static(), 0.0)]
    for level, preload in ((1.0, True), *((round(level, 4), False) for level in damper.measured_levels)):
        name = "intact" if preload else f"oil_{100 * level:.0f}"
        records += [Plan(f"{name}_v{1000 * v:04.0f}", level, preload, harmonic(v), v) for v in blocks]
        if not preload and V_REST in blocks:
            records.append(Plan(f"{name}_rest", level, preload, harmonic(V_REST, LONG_PAUSE), V_REST))
    for v, level, slow, pause in product(recover, (FULLER, damper.measured_levels[0]), (False, True), RESTS):
        name = f"oil_{100 * level:.0f}_v{1000 * v:04.0f}_{seconds:.0f}s_rest_{pause:.0f}s{'_slow' if slow else ''}"
        records.append(Plan(name, round(level, 4), False, recovery(v, seconds, pause, slow), v))
    return records


def take(plan: Plan, damper: Damper, s: Secret, *, start: float, samples: float, jitter: float, rng: RNG) -> Channels:
    """Simulate and sample a record; `samples` per oscillation, `jitter` as a share of the interval."""
    rate = QUASI_STATIC
    if plan.velocity > 0.0:
        rate = float(np.clip(samples * plan.velocity / (2 * np.pi * AMPLITUDE), SLOWEST, FASTEST))
    count = int(plan.excitation.duration * rate)
    time = (np.arange(count) + jitter * rng.uniform(-0.5, 0.5, count)) / rate
    time = np.asarray(np.round(np.clip(time, 0.0, plan.excitation.duration), 6), dtype=np.float64)
    level = plan.level if plan.preload else plan.level + s.level_error
    numbers = s.always | ({} if plan.velocity == 0.0 else s.moving) | ({} if plan.preload else s.degraded)
    hidden = Hidden(**(numbers | {"start": start}))
    c = tube(damper, level, plan.preload, s.parameters)
    # The load cell's amplifier averages the force over the interval around each sample.
    late = np.maximum(time + 0.5 / rate - s.measurement.get("force_late", 0.0), 0.0)
    force = march(c, hidden, plan.excitation, late)[:, CELL].copy()
    stroke, velocity = plan.excitation.sampled(np.maximum(time - s.measurement.get("stroke_late", 0.0), 0.0))
    return Channels(plan, time, stroke, velocity, force, start)


def trial(
    kind: str, seed: int, *, damper: str | None = None, strength: float | None = None, blocks: Sequence[float] = VELOCITIES,
    recover: Sequence[float] = (), seconds: float = 20.0,
) -> Trial:  # fmt: skip
    """The trial of a kind, also "a+b"; the same arguments give the same numbers.

    `strength` 1 is typical; None draws it from 0.5 to 1.5. `damper` None is SA8, or the entry of `DAMPER` for the kind;
    `blocks` are the measured velocities [m/s], and `recover` those of long blocks of about `seconds` with a pause.
    """
    name = damper or DAMPER.get(kind.split("+", maxsplit=1)[0], "SA8")
    loaded = load(name, as_published=True)
    s, drawn = secret(kind, seed, loaded.parameters, strength)
    rng = np.random.default_rng([seed, crc32(kind.encode())])
    samples, jitter = rng.uniform(250, 400), rng.uniform(0.0, 0.2)
    tolerance, with_velocity, phase = rng.uniform(-0.003, 0.003), chance(rng, 0.3), rng.uniform(0, 2 * np.pi)
    room = WARM + rng.uniform(-1.5, 1.5)
    planned = plans(loaded, blocks, recover, seconds)
    channels = [
        take(plan, loaded, s, start=room + rng.uniform(-0.5, 0.5), samples=samples, jitter=jitter, rng=rng)
        for plan in planned
    ]
    peak = max(float(np.abs(record.force).max()) for record in channels)
    cell = max(float(np.abs(record.force).max()) for record in channels if not record.plan.preload)
    # The load cell is tared before every record, with an error.
    zero_rng = np.random.default_rng([seed, crc32(kind.encode()), 1])
    zeros = zero_rng.uniform(0.0, TARE) * peak * zero_rng.standard_normal(len(channels))
    records = []
    for record, zero in zip(channels, zeros.tolist(), strict=True):
        noise = rng.uniform(0.005, 0.03) * float(np.abs(record.force).max())
        forces = (tolerance * peak + zero, peak, cell)
        records.append(measured(record, s, forces, noise=noise, speed=bool(with_velocity), phase=float(phase), rng=rng))
    return Trial(kind, seed, drawn, s.truth, name, records)


def measured(
    channels: Channels, s: Secret, forces: tuple[float, float, float], *, noise: float, speed: bool, phase: float, rng: RNG
) -> TrialRecord:
    """The record with noise and the faults of the measurement; `forces`: offset, peak, peak of the degraded states [N]."""
    faults = s.measurement
    offset, peak, cell = forces
    force = channels.force + offset + faults.get("offset", 0.0) * peak
    if "hum" in faults:
        angle = 2 * np.pi * MAINS * channels.time + phase
        force = force + faults["hum"] * peak * (np.sin(angle) + 0.3 * np.sin(2 * angle) + 0.2 * np.sin(3 * angle))
    force = force + noise * rng.standard_normal(len(force))
    if "clip" in faults:
        limit = (1.0 - faults["clip"]) * cell
        force = np.clip(force, -limit, limit)
    force = force * (1.0 + faults.get("gain", 0.0)) * faults.get("force_factor", 1.0)
    scale = faults.get("stroke_factor", 1.0)
    stroke = scale * (channels.stroke + 5e-6 * rng.standard_normal(len(force)))
    velocity = None
    if speed and channels.plan.velocity > 0.0:
        velocity = scale * (channels.velocity + 2e-3 * rng.standard_normal(len(force)))
    plan, start = channels.plan, round(channels.start - 273.15, 1)
    measurement = "harmonic" if plan.velocity > 0.0 else "quasi-static"
    return TrialRecord(plan.file + ".parquet", measurement, plan.level, plan.preload, start, channels.time, stroke, force,
                       velocity, noise)  # fmt: skip


def write(trial: Trial, folder: str | Path) -> Path:
    """Write the dataset, without the truth, to the folder, which is created if it is missing; returns the folder."""
    records = []
    for record in trial.records:
        entries = {
            name: getattr(record, name) for name in ("measurement", "oil_level", "gas_preload", "start_temperature_degC")
        }
        columns = {TIME: record.time, STROKE: 1e3 * record.stroke, FORCE: record.force}
        if record.velocity is not None:
            columns["velocity [mm/s]"] = 1e3 * record.velocity
        records.append((record.file.removesuffix(".parquet"), entries, columns))
    write_dataset(
        Path(folder), f"Bench, damper {trial.damper}", load(trial.damper, as_published=True), LAYOUTS["parquet"], records
    )
    return Path(folder)


def dataset(trial: Trial) -> LoadedDataset:
    """The trial as `twintube.data` reads it; raises `twintube.data.DataError` if it is refused."""
    with tempfile.TemporaryDirectory() as folder:
        return load_dataset(write(trial, folder))
