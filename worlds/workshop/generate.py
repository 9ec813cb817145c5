"""The dataset of a seed, and what is hidden in it."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from twintube import simulate
from twintube.common.arrays import Array
from twintube.dampers import Damper
from worlds.bench.files import FORCE, LAYOUTS, STROKE, TIME, told, write_dataset, write_truth
from worlds.bench.plan import Record, rms
from worlds.bench.sampler import coloured
from worlds.model.run import Step, begun, finished, sampled
from worlds.workshop.catalogue import case_of
from worlds.workshop.plan import Day, plan_day
from worlds.workshop.sizes import SIZES

Samples = tuple[Array, Array, Array]  # time, stroke, force
DRAWN = ("csv", "csv", "csv", "csv_german", "csv_kilo", "csv_volts", "csv_clock", "csv", "txt", "json", "json_rows", "mat",
         "parquet", "mat_struct", "txt", "tsv")  # fmt: skip
TITLES = ("Bench, damper of a used car", "Workshop series", "Damper bench, week 14", "Servo-hydraulic rig, second series",
          "Comparison of fill levels", "Damper test, customer part")  # fmt: skip


def measured(day: Day, steps: Sequence[Step] = ()) -> list[Samples]:
    """All records without noise and without the nuisance of the sensors."""
    found = []
    for record, motion in day.records:
        run = finished(begun(record, motion, day.damper), steps)
        time, stroke, force, *_ = sampled(run, day.recorder)
        found.append((time * run.stretch, stroke, force))
    return found


def predicted(damper: Damper, record: Record, samples: Samples) -> Array:
    """The plain model's force from the record's own stroke and times."""
    time, stroke, _ = samples
    true = damper.with_(oil_level=record.level, gas_preload=int(record.preload))
    return np.array(simulate(true, stroke, np.gradient(stroke, time)).force)


def effect(day: Day, with_it: list[Samples], without: list[Samples]) -> float:
    """RMS of what causes change in the force [N]; where they change stroke or clock, in what the model leaves of it."""
    parts = []
    for (record, _), a, b in zip(day.records, with_it, without, strict=True):
        change = a[2] - b[2]
        if not (np.array_equal(a[1], b[1]) and np.array_equal(a[0], b[0])):
            change = change - predicted(day.damper, record, a) + predicted(day.damper, record, b)
        parts.append(change)
    return rms(parts)


def save(seed: int, day: Day, samples: Sequence[Samples], *, noise_N: float, zero: float, folder: Path) -> str:
    """Nuisance, noise and files; returns the layout."""
    draw = np.random.default_rng((seed, 5))
    layout = str(draw.choice(DRAWN))
    records: list[tuple[str, dict[str, Any], dict[str, Array]]] = []
    for (record, _), (time, stroke, force) in zip(day.records, samples, strict=True):
        x = stroke * day.stroke_gain + day.stroke_noise * draw.standard_normal(len(stroke))
        y = force + zero + noise_N * coloured(draw, len(force), day.noise_memory)
        entries = {"measurement": record.measurement, "oil_level": record.level, "gas_preload": record.preload}
        records.append((record.name, entries, {TIME: time, STROKE: 1e3 * x, FORCE: y}))
    write_dataset(folder, str(draw.choice(TITLES)), day.damper, LAYOUTS[layout], records)
    return layout


def write(seed: int, folder: Path) -> dict[str, Any]:
    """Write FOLDER/dataset and FOLDER/truth.json of a seed from 1 on, and return the truth."""
    case = case_of(seed)
    day = plan_day(seed, case.wish)
    without = measured(day)
    largest = max(float(np.abs(force).max()) for _, _, force in without)
    noise_N, draw = day.noise_share * largest, np.random.default_rng((seed, 3))
    drawn = {key: SIZES[key].draw(draw, day) for key in case.keys}
    with_it = measured(day, [step for key, values in drawn.items() for step in SIZES[key].steps(values)])
    layout = save(seed, day, with_it, noise_N=noise_N, zero=day.zero * largest, folder=folder / "dataset")
    values = {f"{SIZES[key].name}.{name}": value for key, some in drawn.items() for name, value in some.items()}
    if len(drawn) > 1:
        for key, some in drawn.items():
            alone = effect(day, measured(day, SIZES[key].steps(some)), without)
            values[f"{SIZES[key].name}.alone_over_noise"] = alone / noise_N
    more = {
        "formulation": " + ".join(SIZES[key].formulation for key in case.keys), "values": values, "noise_N": noise_N,
        "effect_over_noise": effect(day, with_it, without) / noise_N if drawn else 0.0, "largest_N": largest,
        "recorder": vars(day.recorder), "noise_memory": day.noise_memory, "excitation": day.style, "format": layout,
    }  # fmt: skip
    truth = told("workshop", seed, day.damper.name, case.causes, kind=case.kind, more=more)
    write_truth(folder, truth)
    return truth
