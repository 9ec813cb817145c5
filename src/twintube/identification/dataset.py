"""From a dataset folder to an identified parameter set with its origin and its validation."""

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from twintube.dampers import Damper
from twintube.data import LoadedDataset, load_dataset
from twintube.data.condition import is_intact
from twintube.engine.simulate import InputError
from twintube.fitting.averaging import averaging, through
from twintube.fitting.harmonic import Harmonic
from twintube.fitting.oscillations import harmonic
from twintube.fitting.parameters import TABLE_6
from twintube.fitting.splits import distinct
from twintube.identification.validation import Validated, intact, validate_drives, validate_harmonic
from twintube.identification.workflow import PAPER, Budget, Identification, identify_damper

ENOUGH = 5  # distinct velocities from which on some are held out, where dataset.toml splits nothing
HELD_OUT = (3, 1)  # every third velocity from the second on; not the two highest, between which cavitation begins
EQUAL_SPEEDS = 1.03  # velocities of sines, free of noise, that differ by a smaller factor are taken for equal


@dataclass(frozen=True)
class Result:
    """What `twintube identify` reports."""

    dataset: LoadedDataset
    harmonics: list[tuple[Harmonic, str]]  # with their split, in the order of the dataset
    identification: Identification
    validation: list[Validated]
    remarks: list[str]


def identify(
    path: str | Path,
    *,
    method: str = "pso",
    budget: Budget = PAPER,
    seed: int = 1,
    journal: Path | None = None,
    progress: Callable[[str, float], None] | None = None,
) -> Result:
    """Identify the damper of a dataset folder and validate it on all records.

    Args:
        path: a folder with dataset.toml and its records, or that file.
        method: pso (the paper's), cma or de.
        budget: PAPER, QUICK or a Budget: how long to search.
        seed: of all random numbers.
        journal: a folder that makes a killed run resumable.
        progress: called with the step's title and its error after each generation.

    Raises DataError with all defects of the records, and InputError where they do not suffice.

    """
    dataset = load_dataset(path)
    return identify_dataset(dataset, method=method, budget=budget, seed=seed, journal=journal, progress=progress)


def identify_dataset(
    dataset: LoadedDataset,
    *,
    method: str = "pso",
    budget: Budget = PAPER,
    seed: int = 1,
    journal: Path | None = None,
    progress: Callable[[str, float], None] | None = None,
) -> Result:
    """Identify the dataset's damper from its records for fitting and validate it on all; raises InputError."""
    slow = [r for r in dataset.records if r.measurement == "quasi-static"]
    drives = [r for r in dataset.records if r.measurement == "stochastic"]
    sines = [harmonic(r) for r in dataset.records if r.measurement == "harmonic"]
    if not sines:
        raise InputError(f"{dataset.title}: no harmonic record to identify from")
    stated = {r.name: r.split for r in dataset.records}
    split, remarks = splits(sines, stated)
    smoothed = averaging(sines)
    if smoothed is not None:
        sines = through(sines, smoothed)
        remarks.append(f"{smoothed.text}; the model is passed through an equal mean where sines are fitted and validated")
    fitted = [h for h, kind in zip(sines, split, strict=True) if kind == "fit"]
    if not fitted:
        raise InputError(f"{dataset.title}: all harmonic records are held out, none is left to identify from")
    result = identify_damper(
        dataset.damper,
        next(((r.stroke, r.force) for r in slow if intact(r) and r.split != "heldout"), None),
        [h for h in fitted if h.intact],
        [h for h in fitted if not h.intact],
        slow_lost=[(r.oil_level, (r.stroke, r.force)) for r in slow if not r.gas_preload and r.split != "heldout"],
        method=method, budget=budget, seed=seed, journal=journal, progress=progress,
    )  # fmt: skip
    levels = sorted({h.oil_level for h in sines if not h.intact}, reverse=True)
    damper = with_origin(replace(result.damper, measured_levels=tuple(levels)), dataset, result, method, seed, len(fitted))
    result = replace(result, damper=damper)
    rows = [validate_harmonic(damper, h, kind, result.offset) for h, kind in zip(sines, split, strict=True)]
    return Result(
        dataset, list(zip(sines, split, strict=True)), result, rows + validate_drives(damper, drives),
        remarks + result.remarks,
    )  # fmt: skip


def splits(records: Sequence[Harmonic], stated: dict[str, str | None]) -> tuple[list[str], list[str]]:
    """`fit` or `heldout` for every record, and remarks on the choice."""
    if any(stated[r.name] for r in records):
        return [stated[r.name] or "fit" for r in records], []
    judged = [not r.intact for r in records]
    judged = judged if any(judged) else [True] * len(records)
    speeds = distinct((r.top_speed for r, counts in zip(records, judged, strict=True) if counts), EQUAL_SPEEDS)
    every, first = HELD_OUT
    held = [v for i, v in enumerate(speeds[:-2]) if len(speeds) >= ENOUGH and i % every == first]
    kinds = [
        "heldout" if counts and any(v <= r.top_speed <= EQUAL_SPEEDS * v for v in held) else "fit"
        for r, counts in zip(records, judged, strict=True)
    ]
    if not held:
        count = "1 velocity" if len(speeds) == 1 else f"{len(speeds)} velocities"
        return kinds, [f"{count}, fewer than {ENOUGH}: no record is held out, the validation is of the fit"]
    velocities = ", ".join(f"{v:.3g}" for v in held)
    return kinds, [f"dataset.toml splits nothing: the records at {velocities} m/s are held out"]


def with_origin(
    damper: Damper, dataset: LoadedDataset, result: Identification, method: str, seed: int, fitted: int
) -> Damper:
    """The damper with where its values come from."""
    origin = f"identified from '{dataset.title}': {fitted} harmonic records"
    sources, assumed = dict(damper.sources), dict(damper.assumed)
    changed = [
        name
        for name in ("fv", "friction", "gas_spring")
        if parameters_of(damper, name) != parameters_of(dataset.damper, name)
    ]
    if result.steps:
        changed += ["degradation", "foam", "cavitation"]
    for group in changed:
        sources[group] = f"{origin}, {method}, seed {seed}" if group not in ("fv", "friction", "gas_spring") else origin
        known = parameters_of(dataset.damper, group)
        for key in [key for key in assumed if key.split(".")[0] == group]:
            name = key.partition(".")[2]
            if not name or parameters_of(damper, group).get(name) != known.get(name):
                del assumed[key]
    for estimate in result.estimates:
        if not estimate.determined:
            group = "degradation" if estimate.name in TABLE_6 else "cavitation" if "cav" in estimate.name else "foam"
            assumed[f"{group}.{estimate.name}"] = "not determined by the records it was identified from"
    return replace(damper, name=f"{damper.name}-identified", title=dataset.title, sources=sources, assumed=assumed)


def parameters_of(damper: Damper, group: str) -> dict[str, Any]:
    """The parameters of a group by name."""
    table = damper.parameters
    return {n: getattr(table, n) for n, f in type(table).__dataclass_fields__.items() if f.metadata["group"] == group}


def summary(result: Result) -> dict[str, Any]:
    """The result as JSON takes it."""
    identified = result.identification
    return {
        "dataset": result.dataset.title,
        "damper": identified.damper.name,
        "remarks": result.remarks,
        "steps": [
            {
                "title": s.title, "parameters": s.names, "error": s.best.error, "unit": s.unit,
                "evaluations": s.best.evaluations,
            }
            for s in identified.steps
        ],
        "parameters": {
            e.name: {
                "value": e.value, "interval": [e.low, e.high], "bounds": e.bounds,
                "determined": e.determined, "at_bound": e.at_bound,
            }
            for e in identified.estimates
        },
        "not_told_apart": [{"parameters": [a, b], "correlation": c} for a, b, c in identified.pairs],
        "force_offset_N": identified.offset,
        "validation": [asdict(row) for row in result.validation],
        "heldout": totals(result.validation, "heldout"),
        "fit": totals(result.validation, "fit"),
    }  # fmt: skip


def totals(rows: Sequence[Validated], split: str) -> dict[str, float | None] | None:
    """Errors over the harmonic records of a split: force as RMSE, works relative to the measured and to the intact work.

    The latter says more where a degraded damper does little work: 3 J of 10 J are little against the intact 100 J.
    """
    harmonics = [row for row in rows if row.measurement == "harmonic" and row.split == split]
    if not harmonics:
        return None
    errors = np.array([
        [abs(s - m) / abs(m) for s, m in zip(row.work_simulated, row.work_measured, strict=True)] for row in harmonics
    ])  # fmt: skip
    figures: dict[str, float | None] = {
        "records": len(harmonics),
        "force_rmse_N": float(np.sqrt(np.mean([row.force_rmse**2 for row in harmonics]))),
        "force_rmse_of_peak": float(np.mean([row.force_rmse / row.force_peak for row in harmonics])),
    }
    for i, which in enumerate(("first", "last")):
        figures[f"work_error_{which}"] = float(np.median(errors[:, i]))
        figures[f"work_error_{which}_worst"] = float(errors[:, i].max())
        relative = [of_intact(row, rows, i) for row in harmonics]
        known = [value for value in relative if value is not None]
        figures[f"work_error_{which}_of_intact"] = float(np.median(known)) if known else None
        figures[f"work_error_{which}_of_intact_worst"] = max(known) if known else None
    return figures


def of_intact(row: Validated, rows: Sequence[Validated], i: int) -> float | None:
    """Error of a record's first or last work relative to that of the intact damper at an equal velocity."""
    for other in rows:
        full = is_intact(other.oil_level, other.gas_preload) and other.measurement == "harmonic"
        if full and row.top_speed / EQUAL_SPEEDS <= other.top_speed <= EQUAL_SPEEDS * row.top_speed:
            return abs(row.work_simulated[i] - row.work_measured[i]) / abs(other.work_measured[i])
    return None
