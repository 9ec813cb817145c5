"""Records of the virtual rig, which stand for the paper's unpublished measurements: from all cores, kept as Parquet."""

import os
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from functools import lru_cache
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray
from tqdm import tqdm

from twintube.arrays import Array
from twintube.dampers import load
from twintube.engine.simulate import InputError
from twintube.files import replacing
from twintube.identification import Harmonic
from twintube.lab import virtual_rig
from twintube.lab.virtual_rig.rig import check
from twintube.provenance import fingerprint
from twintube.rig.plan import amplitude, quasi_static, velocities
from twintube.rig.signals import Signal, harmonic_block
from twintube.vehicle.maneuvers import MANEUVERS
from twintube.vehicle.plan import drive_signal

PER_OSCILLATION = 240  # samples of an oscillation
KEPT_BEFORE = 10  # every so many samples of the preconditioning are kept
FEW = 4  # jobs that are done sooner in this process than others start


@dataclass(frozen=True, order=True)
class Job:
    """One record: a harmonic block (value: maximum velocity [m/s]), a drive (number in Table 3) or the slow ramps."""

    damper: str
    kind: str  # harmonic | drive | slow
    value: float
    level: float  # oil level; the gas preload is there at 1 only, as in the paper

    @property
    def file(self) -> str:
        """The name of its Parquet file."""
        return f"{self.damper}_{self.kind}_{self.value:g}_{100 * self.level:.2f}.parquet"


def levels(damper: str) -> tuple[float, ...]:
    """Intact and the two degraded states that the paper measured (Table 2)."""
    return (1.0, *load(damper).measured_levels)


def harmonic_jobs(damper: str, at: Iterable[float] | None = None) -> list[Job]:
    """All harmonic blocks of a damper in all states, or those `at` these velocities [m/s]."""
    chosen = velocities(load(damper)) if at is None else at
    return [Job(damper, "harmonic", v, level) for v in chosen for level in levels(damper)]


def slow_jobs(damper: str) -> list[Job]:
    """The quasi-static measurement in all states."""
    return [Job(damper, "slow", 0.0, level) for level in levels(damper)]


def drive_jobs(damper: str, numbers: Iterable[int] | None = None) -> list[Job]:
    """The drives in all states, all ten or those with these numbers."""
    chosen = [m.number for m in MANEUVERS] if numbers is None else numbers
    return [Job(damper, "drive", float(n), level) for n in chosen for level in levels(damper)]


@lru_cache(maxsize=32)
def excitation(damper: str, kind: str, value: float) -> Signal:
    """The stroke of a job, the same at all oil levels."""
    one = load(damper)
    if kind == "harmonic":
        return harmonic_block(value, amplitude(one), 2 * np.pi * amplitude(one) / value / PER_OSCILLATION)
    if kind == "slow":
        return quasi_static(one)
    return drive_signal(one, next(m for m in MANEUVERS if m.number == int(value)))


def path(job: Job) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Time [s] and stroke [m] of a job as the rig takes them."""
    signal = excitation(job.damper, job.kind, job.value)
    return np.asarray(signal.time, dtype=np.float64), np.asarray(signal.stroke, dtype=np.float64)


def filled(job: Job) -> float:
    """The oil level that the rig runs at: the job's, or in steps of 1 % the highest that leaves its reserve some gas."""
    rig = virtual_rig.virtual_damper(job.damper)
    time, stroke, constants = *path(job), rig.constants(job.level >= 1.0, 25.0)
    for less in range(10):
        try:
            check(rig, time, stroke, job.level - less / 100, constants)
        except ValueError:
            continue
        return job.level - less / 100
    raise InputError(f"{job.damper}: the virtual rig has no room for {job.level:.0%} oil in {job.kind} {job.value:g}")


def compute(job: Job, folder: Path) -> None:
    """Run the rig and write time [s], stroke [m], velocity [m/s] and force [N], whole or not at all."""
    signal = excitation(job.damper, job.kind, job.value)
    record = virtual_rig.run(virtual_rig.virtual_damper(job.damper), *path(job), filled(job), gas_preload=job.level >= 1.0)
    kept = np.arange(len(signal.time))
    kept = kept[(kept >= signal.marks[0]) | (kept % KEPT_BEFORE == 0)]
    names = ("time", "stroke", "velocity", "force")
    # The excitation's velocity: the rig's is that of a spline, which is at odds with it at the block's first sample.
    columns = (record.time, record.stroke, signal.velocity, record.force)
    table = pa.table({name: column[kept] for name, column in zip(names, columns, strict=True)})
    marks = np.searchsorted(kept, signal.marks)
    table = table.replace_schema_metadata({"marks": " ".join(str(m) for m in marks), "stand_in": "virtual rig"})
    with replacing(folder / job.file) as part:
        pq.write_table(table, part, compression="zstd")


class Records:
    """The records of a run, in `folder`; those of another version of the rig are not taken."""

    def __init__(self, folder: Path, processes: int | None = None, progress: bool = True) -> None:
        self.folder = folder / fingerprint(__name__)
        self.processes = processes or os.cpu_count() or 1
        self.progress = progress

    def prepare(self, jobs: Iterable[Job]) -> None:
        """Compute what is missing, longest first, in processes of this machine."""
        self.folder.mkdir(parents=True, exist_ok=True)
        missing = sorted({j for j in jobs if not (self.folder / j.file).exists()}, key=lambda j: (j.kind, j.value))
        with tqdm(total=len(missing), unit="record", desc="virtual rig", leave=False, disable=not self.progress) as bar:
            if len(missing) <= FEW or self.processes == 1:
                for job in missing:
                    compute(job, self.folder)
                    bar.update()
                return
            compute(missing.pop(), self.folder)  # compiles once, before the processes do so all at the same time
            bar.update()
            with ProcessPoolExecutor(min(self.processes, len(missing)), get_context("spawn")) as pool:
                for done in as_completed([pool.submit(compute, job, self.folder) for job in missing]):
                    done.result()
                    bar.update()

    def get(self, job: Job) -> Harmonic:
        """A record; computed now if nobody did. A drive and the ramps count as one oscillation."""
        file = self.folder / job.file
        if not file.exists():
            self.folder.mkdir(parents=True, exist_ok=True)
            compute(job, self.folder)
        table = pq.read_table(file)
        time, stroke, velocity, force = (table[n].to_numpy() for n in ("time", "stroke", "velocity", "force"))
        marks = np.array([int(m) for m in table.schema.metadata[b"marks"].split()])
        return Harmonic(job.level, int(job.level >= 1.0), time, stroke, velocity, force, marks)

    def works(self, jobs: Iterable[Job]) -> list[Array]:
        """Works [J] per oscillation of each record."""
        return [self.get(job).works() for job in jobs]
