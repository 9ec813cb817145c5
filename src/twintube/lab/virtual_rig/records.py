"""Measured data from the rig: noise, jitter, offset, and a dataset folder as `twintube` reads it."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import tomlkit
from scipy.interpolate import CubicSpline

from twintube.common.arrays import Array
from twintube.common.files import replacing, write_text
from twintube.lab.virtual_rig.rig import VirtualRecord

KINDS = ("quasi-static", "harmonic", "stochastic")
LARGEST_JITTER = 0.45  # share of the sampling interval: time stays increasing


@dataclass(frozen=True)
class Measured:
    """Channels of a rig: arrays (n,), SI units, time and temperature without error."""

    time: Array  # [s]
    stroke: Array  # [m], positive in rebound
    force: Array  # [N], positive when the damper is pulled in rebound
    temperature: Array  # [degC]


@dataclass(frozen=True)
class DatasetRecord:
    """One measurement of a dataset."""

    file: str  # name of the CSV, without a folder
    measurement: str  # quasi-static, harmonic or stochastic
    oil_level: float  # [1] as recorded, which may differ from the truth
    gas_preload: float  # [1] as recorded
    data: Measured
    split: str = ""  # fit, heldout or empty


def measured(
    record: VirtualRecord,
    seed: int,
    *,
    noise: float = 0.01,
    jitter: float = 0.0,
    force_offset_N: float = 0.0,
    rate_Hz: float = 500.0,
    stroke_noise_m: float = 0.0,
    start: float | None = None,
) -> Measured:
    """The record as a rig with errors samples it; the same seed gives the same arrays.

    `noise` is the standard deviation of the force as a share of its largest magnitude, `jitter` the standard deviation of
    the sampling instants as a share of the interval 1/`rate_Hz` (limited to 0.45 of it; the record contains them).
    Samples before `start` [s], e.g. a preconditioning, are not written.
    """
    if rate_Hz <= 0 or noise < 0 or jitter < 0 or stroke_noise_m < 0:
        raise ValueError("rate_Hz must be positive; noise, jitter and stroke_noise_m must not be negative")
    first = record.time[0] if start is None else max(start, record.time[0])
    count = int((record.time[-1] - first) * rate_Hz * (1 + 1e-12)) + 1
    if count < 2:
        raise ValueError(f"rate_Hz {rate_Hz} leaves fewer than two samples")
    rng = np.random.default_rng(seed)
    shift = np.clip(jitter * rng.standard_normal(count), -LARGEST_JITTER, LARGEST_JITTER)
    time = np.clip(first + (np.arange(count) + shift) / rate_Hz, first, record.time[-1])
    keep = np.concatenate([[True], np.diff(time) > 0])
    time = time[keep]
    force = np.interp(time, record.time, record.force)
    peak = float(np.abs(force).max())
    return Measured(
        time=time,
        stroke=CubicSpline(record.time, record.stroke)(time) + stroke_noise_m * rng.standard_normal(len(time)),
        force=force + force_offset_N + noise * peak * rng.standard_normal(len(time)),
        temperature=np.interp(time, record.time, record.temperature),
    )


def write_dataset(folder: str | Path, damper: str, records: Sequence[DatasetRecord], title: str = "Virtual rig") -> Path:
    """Write `dataset.toml` and a CSV per record to the folder, which is created if it is missing; returns the folder.

    `damper` is a named set of `twintube` or a path to a parameter file, relative to `dataset.toml`.
    """
    refuse(records)
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    document = tomlkit.document()
    document["title"] = title
    document["damper"] = damper
    tables = tomlkit.aot()
    for item in records:
        table = tomlkit.table()
        table["file"] = item.file
        table["measurement"] = item.measurement
        table["oil_level"] = item.oil_level
        table["gas_preload"] = item.gas_preload
        table["start_temperature_degC"] = round(float(item.data.temperature[0]), 3)
        if item.split:
            table["split"] = item.split
        tables.append(table)
        columns = (item.data.time, item.data.stroke * 1e3, item.data.force, item.data.temperature)
        with replacing(folder / item.file) as temporary:
            np.savetxt(
                temporary,
                np.column_stack(columns),
                fmt=("%.6f", "%.5f", "%.3f", "%.3f"),
                delimiter=",",
                header="time [s],stroke [mm],force [N],temperature [degC]",
                comments="",
            )
    document["record"] = tables
    write_text(folder / "dataset.toml", tomlkit.dumps(document))
    return folder


def refuse(records: Sequence[DatasetRecord]) -> None:
    """Raise ValueError with the first record that cannot be written."""
    files = [item.file for item in records]
    for item in records:
        if Path(item.file).name != item.file or files.count(item.file) > 1:
            raise ValueError(f"{item.file!r}: must be the name of one CSV, without a folder")
        if item.measurement not in KINDS:
            raise ValueError(f"{item.file}: measurement {item.measurement!r} must be one of {', '.join(KINDS)}")
        if item.split not in ("", "fit", "heldout"):
            raise ValueError(f"{item.file}: split {item.split!r} must be fit or heldout")
