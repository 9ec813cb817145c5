"""Trials: datasets as a rig would have measured them, in which something is hidden.

trial      draw and simulate one
write      as a dataset folder
dataset    as the data door of `twintube` reads it
"""

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from zlib import crc32

import numpy as np
import pyarrow
import pyarrow.parquet
import tomlkit

from twintube.dampers import Damper, load
from twintube.data import LoadedDataset, load_dataset
from twintube.lab.blind_trials.damper import march, tube
from twintube.lab.blind_trials.excitation import LONG_PAUSE, V_REST, VELOCITIES, Drive, harmonic, quasi_static, recovery
from twintube.lab.blind_trials.hidden import EFFECTS, FAULTS, KINDS, OUTSIDE, Secret, secret
from twintube.lab.blind_trials.model import CELL
from twintube.lab.blind_trials.quantities import Array, Hidden
from twintube.rig.signals import AMPLITUDE

__all__ = ["DAMPER", "EFFECTS", "FAULTS", "KINDS", "OUTSIDE", "Trial", "TrialRecord", "dataset", "trial", "write"]

DAMPER = {"smooth_transition": "SA7"}  # the damper that shows a kind where SA8 hardly does
SLOWEST, FASTEST, QUASI_STATIC = 100.0, 2000.0, 50.0  # [Hz] sampling
WARM = 273.15 + 25.0  # [K]
RESTS, FULLER = (10.0, 180.0), 0.9  # [s] and [1] rests and oil level of the recovery records beside the measured level
MAINS = 49.98  # [Hz] not quite 50, or sampling at 50 Hz would see a constant
TARE = 0.003  # of the peak: the largest standard deviation of the zeros of the records; 0.05 % of a 20 kN cell is 10 N


@dataclass(frozen=True)
class TrialRecord:
    """One measured record; arrays (n,), SI units, stroke and force positive in rebound unless a fault says otherwise."""

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
    """A dataset and, for reports only, what is hidden in it."""

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
    drive: Drive
    velocity: float  # [m/s] of its blocks, 0: quasi-static


@dataclass(frozen=True)
class Taken:
    """A record's channels before noise."""

    plan: Plan
    time: Array
    stroke: Array
    velocity: Array
    force: Array
    start: float  # [K]


def plans(damper: Damper, blocks: Sequence[float], recover: Sequence[float] = (), seconds: float = 20.0) -> list[Plan]:
    """The records of a dataset; those with a long rest belong to the block of their velocity.

    With velocities to `recover` at [m/s] also long blocks of some `seconds`, a rest and a block again, without preload.
    """
    found = [Plan("intact_quasi_static", 1.0, True, quasi_static(), 0.0)]
    for level, preload in ((1.0, True), *((round(level, 4), False) for level in damper.measured_levels)):
        name = "intact" if preload else f"oil_{100 * level:.0f}"
        found += [Plan(f"{name}_v{1000 * v:04.0f}", level, preload, harmonic(v), v) for v in blocks]
        if not preload and V_REST in blocks:
            found.append(Plan(f"{name}_rest", level, preload, harmonic(V_REST, LONG_PAUSE), V_REST))
    for v, level, slow, rest in product(recover, (FULLER, damper.measured_levels[0]), (False, True), RESTS):
        name = f"oil_{100 * level:.0f}_v{1000 * v:04.0f}_{seconds:.0f}s_rest_{rest:.0f}s{'_slow' if slow else ''}"
        found.append(Plan(name, round(level, 4), False, recovery(v, seconds, rest, slow), v))
    return found


def take(
    plan: Plan, damper: Damper, s: Secret, start: float, samples: float, jitter: float, rng: np.random.Generator
) -> Taken:
    """Simulate and sample a record; `samples` per oscillation, `jitter` as a share of the interval."""
    rate = QUASI_STATIC
    if plan.velocity > 0.0:
        rate = float(np.clip(samples * plan.velocity / (2 * np.pi * AMPLITUDE), SLOWEST, FASTEST))
    count = int(plan.drive.duration * rate)
    time = (np.arange(count) + jitter * rng.uniform(-0.5, 0.5, count)) / rate
    time = np.asarray(np.round(np.clip(time, 0.0, plan.drive.duration), 6), dtype=np.float64)
    level = plan.level if plan.preload else plan.level + s.level_error
    numbers = s.always | ({} if plan.velocity == 0.0 else s.moving) | ({} if plan.preload else s.degraded)
    hidden = Hidden(**(numbers | {"start": start}))
    c = tube(damper, level, plan.preload, s.parameters)
    # The load cell's amplifier takes the mean of the force over the interval around each sample.
    late = np.maximum(time + 0.5 / rate - s.measurement.get("force_late", 0.0), 0.0)
    force = march(c, hidden, plan.drive, late)[:, CELL].copy()
    stroke, velocity = plan.drive.sampled(np.maximum(time - s.measurement.get("stroke_late", 0.0), 0.0))
    return Taken(plan, time, stroke, velocity, force, start)


def trial(
    kind: str,
    seed: int,
    *,
    damper: str | None = None,
    strength: float | None = None,
    blocks: Sequence[float] = VELOCITIES,
    recover: Sequence[float] = (),
    seconds: float = 20.0,
) -> Trial:
    """The trial of a kind, also "a+b"; the same arguments give the same numbers.

    `strength` 1 is typical; None draws it from 0.5 to 1.5. `damper` None is SA8, or what `DAMPER` says for the kind;
    `blocks` are the velocities [m/s] to be measured, and `recover` those of long blocks of some `seconds` with a rest.
    """
    name = damper or DAMPER.get(kind.split("+", maxsplit=1)[0], "SA8")
    given = load(name)
    s, drawn = secret(kind, seed, given.parameters, strength)
    rng = np.random.default_rng([seed, crc32(kind.encode())])
    samples, jitter = rng.uniform(250, 400), rng.uniform(0.0, 0.2)
    tolerance, with_velocity, phase = rng.uniform(-0.003, 0.003), rng.random() < 0.3, rng.uniform(0, 2 * np.pi)
    room = WARM + rng.uniform(-1.5, 1.5)
    wanted = plans(given, blocks, recover, seconds)
    taken = [take(plan, given, s, room + rng.uniform(-0.5, 0.5), samples, jitter, rng) for plan in wanted]
    peak = max(float(np.abs(one.force).max()) for one in taken)
    cell = max(float(np.abs(one.force).max()) for one in taken if not one.plan.preload)
    # The load cell is tared before every record, none too well.
    own = np.random.default_rng([seed, crc32(kind.encode()), 1])
    zeros = own.uniform(0.0, TARE) * peak * own.standard_normal(len(taken))
    records = []
    for one, zero in zip(taken, zeros.tolist(), strict=True):
        noise = rng.uniform(0.005, 0.03) * float(np.abs(one.force).max())
        records.append(
            measured(one, s, (tolerance * peak + zero, peak, cell), noise, bool(with_velocity), float(phase), rng)
        )
    return Trial(kind, seed, drawn, s.truth, name, records)


def measured(
    one: Taken,
    s: Secret,
    forces: tuple[float, float, float],
    noise: float,
    speed: bool,
    phase: float,
    rng: np.random.Generator,
) -> TrialRecord:
    """The record with noise and the faults of the measurement; `forces`: offset, peak, peak of the degraded states [N]."""
    wrong = s.measurement
    offset, peak, cell = forces
    force = one.force + offset + wrong.get("offset", 0.0) * peak
    if "hum" in wrong:
        angle = 2 * np.pi * MAINS * one.time + phase
        force = force + wrong["hum"] * peak * (np.sin(angle) + 0.3 * np.sin(2 * angle) + 0.2 * np.sin(3 * angle))
    force = force + noise * rng.standard_normal(len(force))
    if "clip" in wrong:
        limit = (1.0 - wrong["clip"]) * cell
        force = np.clip(force, -limit, limit)
    force = force * (1.0 + wrong.get("gain", 0.0)) * wrong.get("force_factor", 1.0)
    scale = wrong.get("stroke_factor", 1.0)
    stroke = scale * (one.stroke + 5e-6 * rng.standard_normal(len(force)))
    velocity = scale * (one.velocity + 2e-3 * rng.standard_normal(len(force))) if speed and one.plan.velocity > 0.0 else None
    return TrialRecord(
        file=one.plan.file + ".parquet",
        measurement="harmonic" if one.plan.velocity > 0.0 else "quasi-static",
        oil_level=one.plan.level,
        gas_preload=one.plan.preload,
        start_temperature_degC=round(one.start - 273.15, 1),
        time=one.time,
        stroke=stroke,
        force=force,
        velocity=velocity,
        noise_N=noise,
    )


def write(trial: Trial, folder: str | Path) -> Path:
    """Write the dataset, without the truth, into the folder, made where it is missing; returns the folder."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    document = tomlkit.document()
    document["title"] = f"Bench, damper {trial.damper}"
    document["damper"] = trial.damper
    tables = tomlkit.aot()
    for one in trial.records:
        table = tomlkit.table()
        for name in ("file", "measurement", "oil_level", "gas_preload", "start_temperature_degC"):
            table[name] = getattr(one, name)
        tables.append(table)
        columns = {
            "time [s]": one.time,
            "stroke [mm]": (one.stroke * 1e3).astype(np.float32),
            "force [N]": one.force.astype(np.float32),
        }
        if one.velocity is not None:
            columns["velocity [mm/s]"] = (one.velocity * 1e3).astype(np.float32)
        pyarrow.parquet.write_table(pyarrow.table(columns), folder / one.file, compression="zstd", use_dictionary=False)
    document["record"] = tables
    (folder / "dataset.toml").write_text(tomlkit.dumps(document), encoding="utf-8")
    return folder


def dataset(trial: Trial) -> LoadedDataset:
    """The trial as the data door reads it; raises `twintube.data.DataError` where the door refuses it."""
    with tempfile.TemporaryDirectory() as folder:
        return load_dataset(write(trial, folder))
