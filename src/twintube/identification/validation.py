"""How a parameter set does on measured records: force, work per oscillation, and work of drives relative to intact."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from twintube.common.arrays import Array
from twintube.dampers import Damper
from twintube.data import Record
from twintube.data.records.condition import is_intact
from twintube.fitting.harmonic import Harmonic
from twintube.fitting.prediction import calm, driven, predicted

ALIKE = 0.05  # of path length and duration, by which drives of equal strokes may differ


@dataclass(frozen=True)
class Validated:
    """One record against the model. Works are of the first and the last oscillation [J], for drives the total."""

    name: str
    measurement: str
    oil_level: float
    gas_preload: float
    split: str
    top_speed: float  # [m/s]
    force_rmse: float  # [N], every sample of the measured part
    force_rms: float  # [N], measured, root mean square
    force_peak: float  # [N], measured
    work_measured: tuple[float, ...]
    work_simulated: tuple[float, ...]
    relative_measured: float | None = None  # drives: work relative to that of the intact damper in this drive
    relative_simulated: float | None = None
    amplitude: float = 0.0  # [m], half the range of the stroke
    stroke_noise: float = 0.0  # [m] RMS, taken out of the stroke before anything is simulated
    force_rmse_recorded: float | None = None  # [N] simulated over the stroke as recorded, where that has noise
    force_rmse_full: float | None = None  # [N] of the same set as if no oil were lost, where some is


def recorded(record: Harmonic) -> Harmonic:
    """The record with the noise of its stroke."""
    return record if record.recorded is None else replace(record, stroke=record.recorded)


def validate_harmonic(damper: Damper, record: Harmonic, split: str, offset: float = 0.0) -> Validated:
    """Force and works of a harmonic record; `offset` is the zero of the load cell [N]."""
    force = predicted(damper, record, offset)
    span = slice(int(record.marks[0]), int(record.marks[-1]) + 1)
    measured = record.works()
    noise, usable = record.stroke_noise, record.counts(span)
    over_noise = predicted(damper, recorded(record), offset) if noise else force
    full = predicted(damper, replace(record, oil_level=1.0), offset) if record.oil_level < 1.0 else None
    cycles = [slice(a, b + 1) for a, b in zip(record.marks[:-1], record.marks[1:], strict=True)]
    simulated = [float(np.trapezoid(force[c], record.stroke[c])) for c in cycles]
    return Validated(
        record.name, "harmonic", record.oil_level, record.gas_preload, split, record.top_speed,
        rms((force - record.force)[span][usable]), rms(record.force[span][usable]),
        float(np.abs(record.force[span][usable]).max()), (float(measured[0]), float(measured[-1])),
        (simulated[0], simulated[-1]),
        amplitude=float(np.ptp(record.stroke[span])) / 2, stroke_noise=noise,
        force_rmse_recorded=rms((over_noise - record.force)[span][usable]) if noise else None,
        force_rmse_full=None if full is None else rms((full - record.force)[span][usable]),
    )  # fmt: skip


def validate_drives(damper: Damper, records: Sequence[Record], offset: float = 0.0) -> list[Validated]:
    """Force and work of the drives; relative to the record of the intact damper over an equal stroke, where there is one.

    `offset` is the zero of the load cell [N].
    """
    still = [calm(r) for r in records]
    forces = [driven(damper, r).force + offset for r in still]
    works = [
        [float(np.trapezoid(F, r.stroke)) for F in (r.force, simulated)] for r, simulated in zip(still, forces, strict=True)
    ]
    rows = []
    for r, clean, force, (measured, simulated) in zip(records, still, forces, works, strict=True):
        twin = next((i for i, other in enumerate(records) if intact(other) and equal_drives(other, r)), None)
        degraded = twin is not None and not intact(r)
        noise = rms(r.stroke - clean.stroke)
        rows.append(Validated(
            r.name, r.measurement, *r.fill, "heldout", float(np.abs(r.velocity).max()),
            rms((force - r.force)[r.usable]), rms(r.force[r.usable]), float(np.abs(r.force[r.usable]).max()),
            (measured,), (simulated,),
            measured / works[twin][0] if twin is not None and degraded else None,
            simulated / works[twin][1] if twin is not None and degraded else None,
            amplitude=float(np.ptp(clean.stroke)) / 2, stroke_noise=noise,
            force_rmse_recorded=rms((driven(damper, r).force + offset - r.force)[r.usable]) if noise else None,
        ))  # fmt: skip
    return rows


def intact(record: Record) -> bool:
    """Whether the record is of the full damper with its preload."""
    return is_intact(*record.fill)


def equal_drives(a: Record, b: Record) -> bool:
    """Whether two records follow equal strokes, by path length and duration."""
    paths = [float(np.abs(np.diff(r.stroke)).sum()) for r in (a, b)]
    durations = [float(r.time[-1] - r.time[0]) for r in (a, b)]
    return all(abs(x - y) <= ALIKE * x for x, y in (paths, durations))


def rms(x: Array) -> float:
    """Root of the mean square."""
    return float(np.sqrt(np.mean(x**2)))
