"""Records of the virtual rig, stand-ins for the unpublished measurements: computed on all cores and stored."""

import os
from collections.abc import Iterable
from concurrent.futures import as_completed
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from twintube.common.bars import Bar
from twintube.common.files import replacing
from twintube.common.processes import pool
from twintube.dampers import load
from twintube.engine.simulate import InputError
from twintube.identification import Harmonic
from twintube.lab import virtual_rig
from twintube.lab.virtual_rig.rig import check
from twintube.provenance import fingerprint
from twintube.rig.plan import amplitude, oil_levels, quasi_static, velocities
from twintube.rig.signals import Signal, harmonic_block
from twintube.vehicle.maneuvers import MANEUVERS
from twintube.vehicle.plan import drive_signal

PER_OSCILLATION = 240  # samples of an oscillation
THINNING = 10  # one sample of so many is stored before the first oscillation
FEW_JOBS = 4  # jobs that finish in this process before worker processes would start


@dataclass(frozen=True, order=True)
class Job:
    """One record: a harmonic block (value: maximum velocity [m/s]), a drive (number in Table 3) or the slow ramps."""

    damper: str
    kind: str  # harmonic | drive | slow
    value: float
    level: float  # oil level

    @property
    def gas_preload(self) -> bool:
        """Whether the gas preload exists: at 100 % oil only, as in the paper."""
        return self.level >= 1.0

    @property
    def file(self) -> str:
        """Name of the file of its samples."""
        return f"{self.damper}_{self.kind}_{self.value:g}_{100 * self.level:.2f}.npz"


def levels(damper: str) -> tuple[float, ...]:
    """Intact and the two degraded states that the paper measured (Table 2)."""
    return oil_levels(load(damper, as_published=True))


def harmonic_jobs(damper: str, at: Iterable[float] | None = None) -> list[Job]:
    """The harmonic blocks of a damper in all states, all or those `at` these velocities [m/s]."""
    speeds = velocities(load(damper, as_published=True)) if at is None else at
    return [Job(damper, "harmonic", v, level) for v in speeds for level in levels(damper)]


def slow_jobs(damper: str) -> list[Job]:
    """The quasi-static measurement in all states."""
    return [Job(damper, "slow", 0.0, level) for level in levels(damper)]


def drive_jobs(damper: str, numbers: Iterable[int] | None = None) -> list[Job]:
    """The drives in all states, all ten or those with these numbers."""
    drive_numbers = [m.number for m in MANEUVERS] if numbers is None else numbers
    return [Job(damper, "drive", float(n), level) for n in drive_numbers for level in levels(damper)]


@lru_cache(maxsize=32)
def excitation(damper: str, kind: str, value: float) -> Signal:
    """The excitation of a job, the same at all oil levels."""
    loaded = load(damper, as_published=True)
    if kind == "harmonic":
        return harmonic_block(value, amplitude(loaded), 2 * np.pi * amplitude(loaded) / value / PER_OSCILLATION)
    if kind == "slow":
        return quasi_static(loaded)
    return drive_signal(loaded, next(m for m in MANEUVERS if m.number == int(value)))


def rig_oil_level(job: Job) -> float:
    """The oil level [1] of the rig: the job's, lowered in steps of 1 % until the reserve also holds gas."""
    rig, signal = virtual_rig.virtual_damper(job.damper), excitation(job.damper, job.kind, job.value)
    for level in (job.level - percent / 100 for percent in range(10)):
        with suppress(ValueError):
            check(rig, signal.time, signal.stroke, level, rig.constants(job.gas_preload, 25.0))
            return level
    raise InputError(f"{job.damper}: the virtual rig cannot hold {job.level:.0%} oil in {job.kind} {job.value:g}")


def compute(job: Job, folder: Path) -> None:
    """Run the rig and write time [s], stroke [m], velocity [m/s], force [N] and the marks of the oscillations to a file."""
    signal = excitation(job.damper, job.kind, job.value)
    rig = virtual_rig.virtual_damper(job.damper)
    record = virtual_rig.run(rig, signal.time, signal.stroke, rig_oil_level(job), gas_preload=job.gas_preload)
    samples = np.arange(len(signal.time))
    samples = samples[(samples >= signal.marks[0]) | (samples % THINNING == 0)]
    # The excitation's velocity: the rig uses the slope of a spline, which differs at the first sample of a block.
    columns = {"time": record.time, "stroke": record.stroke, "velocity": signal.velocity, "force": record.force}
    kept = {name: values[samples] for name, values in columns.items()}
    with replacing(folder / job.file) as temporary, temporary.open("wb") as file:
        np.savez_compressed(file, marks=np.searchsorted(samples, signal.marks), **kept)


class Records:
    """The records of a report, in `folder`; records of another version of the rig are not used."""

    def __init__(self, folder: Path, processes: int | None = None) -> None:
        self.folder = folder / fingerprint(__name__)
        self.processes = processes or os.cpu_count() or 1

    def prepare(self, jobs: Iterable[Job]) -> None:
        """Compute the missing records, longest first, in worker processes."""
        self.folder.mkdir(parents=True, exist_ok=True)
        missing = sorted({j for j in jobs if not (self.folder / j.file).exists()}, key=lambda j: (j.kind, j.value))
        with Bar(total=len(missing), unit="record", desc="virtual rig", leave=False) as bar:
            if len(missing) <= FEW_JOBS or self.processes == 1:
                for job in missing:
                    compute(job, self.folder)
                    bar.update()
                return
            with pool(min(self.processes, len(missing))) as workers:
                for future in as_completed([workers.submit(compute, job, self.folder) for job in missing]):
                    future.result()
                    bar.update()

    def get(self, job: Job) -> Harmonic:
        """A record, computed if it is missing. A drive and the ramps count as one oscillation."""
        file = self.folder / job.file
        if not file.exists():
            self.folder.mkdir(parents=True, exist_ok=True)
            compute(job, self.folder)
        with np.load(file) as columns:
            return Harmonic(job.level, int(job.gas_preload), **columns)
