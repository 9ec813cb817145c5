"""Write the dataset of a seed, and return what is hidden in it."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from scipy.signal import lfilter

from twintube import simulate
from twintube.dampers import Damper
from twintube.lab.workshop.bench import measure
from twintube.lab.workshop.catalogue import Case, case_of
from twintube.lab.workshop.cause import Array, Cause, Trial
from twintube.lab.workshop.files import LAYOUTS, WRITERS, manifest, rounded
from twintube.lab.workshop.plan import Day, plan_day

Record = tuple[Array, Array, Array]
TITLES = ("Bench, damper of a used car", "Workshop series", "Damper bench, week 14", "Servo-hydraulic rig, second series",
          "Comparison of fill levels", "Damper test, customer part")  # fmt: skip


def bench_of(day: Day, causes: list[Cause]) -> list[Record]:
    """All records without noise and without the nuisance of the sensors."""
    for cause in causes:
        cause.begin()
    return [measure(trial, day.damper, causes, day.recorder) for trial in day.trials]


def predicted(damper: Damper, trial: Trial, record: Record) -> Array:
    """The plain model's force from the record's own stroke and times."""
    time, stroke, _ = record
    true = damper.with_(oil_level=trial.level, gas_preload=int(trial.preload))
    return np.array(simulate(true, stroke, np.gradient(stroke, time)).force)


def difference(day: Day, with_it: list[Record], without: list[Record]) -> Array:
    """What the causes change in the force; where they change stroke or clock, in what the model leaves of it."""
    parts = []
    for trial, a, b in zip(day.trials, with_it, without, strict=True):
        change = a[2] - b[2]
        if not (np.array_equal(a[1], b[1]) and np.array_equal(a[0], b[0])):
            change = change - predicted(day.damper, trial, a) + predicted(day.damper, trial, b)
        parts.append(change)
    return np.concatenate(parts)


def rms(values: Array) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(values**2)))


def noise(draw: np.random.Generator, size: int, memory: float) -> Array:
    """Noise of RMS 1: white, or AR(1) with `memory`."""
    white = draw.standard_normal(size + 200)
    if memory == 0:
        return white[200:]
    coloured: Array = lfilter([np.sqrt(1 - memory**2)], [1.0, -memory], white)[200:]
    return coloured


def save(seed: int, day: Day, records: Sequence[Record], noise_N: float, zero: float, folder: Path) -> str:
    """Nuisance, noise, files and manifest; returns the layout."""
    draw = np.random.default_rng((seed, 5))
    layout = str(draw.choice(LAYOUTS))
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.iterdir():
        old.unlink()
    listed: list[dict[str, Any]] = []
    for trial, (time, stroke, force) in zip(day.trials, records, strict=True):
        x = stroke * day.stroke_gain + day.stroke_noise * draw.standard_normal(len(stroke))
        y = force + zero + noise_N * noise(draw, len(force), day.noise_memory)
        columns = rounded({"time [s]": time, "stroke [mm]": x * 1e3, "force [N]": y})
        file = WRITERS[layout](folder, f"{trial.index + 1:02d}_{trial.name}", columns)
        listed.append({"file": file, "measurement": trial.measurement, "level": trial.level, "preload": trial.preload})
    time = records[0][0]
    rate = (len(time) - 1) / float(time[-1] - time[0])
    content = manifest(str(draw.choice(TITLES)), day.name, layout, rate, listed)
    (folder / "dataset.toml").write_text(content, encoding="utf-8")
    return layout


def write(seed: int, folder: Path) -> dict[str, Any]:
    """Write the dataset of `seed` into `folder` and return the truth."""
    case: Case = case_of(seed)
    day = plan_day(seed, case.wish)
    without = bench_of(day, [])
    largest = max(float(np.abs(force).max()) for _, _, force in without)
    causes = case.make(np.random.default_rng((seed, 3)), day)
    with_it = bench_of(day, causes) if causes else without
    noise_N = day.noise_share * largest
    layout = save(seed, day, with_it, noise_N, day.zero * largest, folder)
    values: dict[str, Any] = {}
    for cause in causes:
        values.update({f"{cause.name}.{key}": value for key, value in cause.values.items()})
        if len(causes) > 1:
            values[f"{cause.name}.alone_over_noise"] = rms(difference(day, bench_of(day, [cause]), without)) / noise_N
    return {
        "seed": seed,
        "cause": case.causes[0],
        "causes": list(case.causes),
        "hidden": case.hidden,
        "kind": case.kind,
        "formulation": " + ".join(cause.formulation for cause in causes),
        "values": values,
        "effect_over_noise": rms(difference(day, with_it, without)) / noise_N if causes else 0.0,
        "fs": day.recorder.fs,
        "noise_N": noise_N,
        "largest_N": largest,
        "damper": day.name,
        "style": day.style,
        "recorder": day.recorder.kind,
        "noise_memory": day.noise_memory,
        "layout": layout,
        "records": len(day.trials),
    }
