"""How a parameter set does on measured records: force, work per oscillation, and work of drives relative to intact."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from twintube.arrays import Array
from twintube.dampers import Damper
from twintube.data import Record
from twintube.data.condition import is_intact
from twintube.engine.simulate import simulate
from twintube.fitting.averaging import averaged
from twintube.fitting.harmonic import Harmonic
from twintube.fitting.oscillations import smooth_velocity
from twintube.fitting.simulation import tolerant

ALIKE = 0.05  # of path length and duration, by which drives of equal strokes may differ


@dataclass(frozen=True)
class Validated:
    """One record against the model. Works are of the first and the last oscillation [J], for drives the total."""

    name: str
    measurement: str
    oil_level: float
    gas_preload: bool
    split: str
    top_speed: float  # [m/s]
    force_rmse: float  # [N], every sample of the measured part
    force_peak: float  # [N], measured
    work_measured: tuple[float, ...]
    work_simulated: tuple[float, ...]
    relative_measured: float | None = None  # drives: work relative to that of the intact damper in this drive
    relative_simulated: float | None = None


def state(damper: Damper, level: float, preload: bool | int) -> Damper:
    """The damper in the condition of a record, for a measured velocity."""
    return tolerant(damper.with_(oil_level=level, gas_preload=int(preload)))


def predicted(damper: Damper, record: Harmonic, offset: float) -> Array:
    """What the force channel would show of the model (n,) [N]: with its zero and through its moving mean."""
    condition = state(damper, record.oil_level, record.gas_preload)
    force = simulate(condition, record.stroke, record.velocity, record.time).force
    return averaged(record.time, force + offset, record.averaged)


def validate_harmonic(damper: Damper, record: Harmonic, split: str, offset: float = 0.0) -> Validated:
    """Force and works of a harmonic record; `offset` is the zero of the load cell [N]."""
    force = predicted(damper, record, offset)
    span = slice(int(record.marks[0]), int(record.marks[-1]) + 1)
    measured = record.works()
    cycles = [slice(a, b + 1) for a, b in zip(record.marks[:-1], record.marks[1:], strict=True)]
    simulated = [float(np.trapezoid(force[c], record.stroke[c])) for c in cycles]
    return Validated(
        record.name, "harmonic", record.oil_level, bool(record.gas_preload), split, record.top_speed,
        rms(force[span] - record.force[span]), float(np.abs(record.force[span]).max()),
        (float(measured[0]), float(measured[-1])), (simulated[0], simulated[-1]),
    )  # fmt: skip


def validate_drives(damper: Damper, records: Sequence[Record]) -> list[Validated]:
    """Force and work of the drives; relative to the record of the intact damper over an equal stroke, where there is one."""
    forces = [
        simulate(state(damper, r.oil_level, r.gas_preload), r.stroke, smooth_velocity(r), r.time).force for r in records
    ]
    works = [
        [float(np.trapezoid(F, r.stroke)) for F in (r.force, simulated)]
        for r, simulated in zip(records, forces, strict=True)
    ]
    rows = []
    for r, force, (measured, simulated) in zip(records, forces, works, strict=True):
        twin = next((i for i, other in enumerate(records) if intact(other) and equal_drives(other, r)), None)
        degraded = twin is not None and not intact(r)
        rows.append(Validated(
            r.name, r.measurement, r.oil_level, r.gas_preload, "heldout", float(np.abs(r.velocity).max()),
            rms(force - r.force), float(np.abs(r.force).max()), (measured,), (simulated,),
            measured / works[twin][0] if twin is not None and degraded else None,
            simulated / works[twin][1] if twin is not None and degraded else None,
        ))  # fmt: skip
    return rows


def intact(record: Record) -> bool:
    """Whether the record is of the full damper with its preload."""
    return is_intact(record.oil_level, record.gas_preload)


def equal_drives(a: Record, b: Record) -> bool:
    """Whether two records follow equal strokes, by path length and duration."""
    paths = [float(np.abs(np.diff(r.stroke)).sum()) for r in (a, b)]
    durations = [float(r.time[-1] - r.time[0]) for r in (a, b)]
    return all(abs(x - y) <= ALIKE * x for x, y in (paths, durations))


def rms(x: Array) -> float:
    """Root of the mean square."""
    return float(np.sqrt(np.mean(x**2)))
