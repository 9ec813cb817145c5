"""From a dataset folder to an identified parameter set with its origin and its validation."""

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from twintube.dampers import Damper
from twintube.data import LoadedDataset
from twintube.engine.simulate import InputError
from twintube.identification.averaging import averaging, through
from twintube.identification.objective import TABLE_6, Harmonic
from twintube.identification.oscillations import harmonic
from twintube.identification.validation import Validated, intact, validate_drives, validate_harmonic
from twintube.identification.workflow import PAPER, Budget, Identification, identify_damper

ENOUGH = 5  # distinct velocities from which on some are held out, if dataset.toml splits nothing itself
HELD_OUT = (3, 1)  # every third velocity from the second on; not the two highest, between which cavitation begins
SAME_SPEED = 1.03  # velocities within 3 % are one


@dataclass(frozen=True)
class Result:
    """What `twintube identify` found."""

    dataset: LoadedDataset
    harmonics: list[tuple[Harmonic, str]]  # with their split, in the order of the dataset
    identification: Identification
    validation: list[Validated]
    remarks: list[str]


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
    found = [harmonic(r) for r in dataset.records if r.measurement == "harmonic"]
    if not found:
        raise InputError(f"{dataset.title}: no harmonic record to identify from")
    stated = {r.name: r.split for r in dataset.records}
    split, remarks = splits(found, stated)
    smoothed = averaging(found)
    if smoothed is not None:
        found = through(found, smoothed)
        remarks.append(f"{smoothed.text}; the model is seen through the same mean where sines are fitted and validated")
    fitted = [h for h, kind in zip(found, split, strict=True) if kind == "fit"]
    if not fitted:
        raise InputError(f"{dataset.title}: all harmonic records are held out, none is left to identify from")
    result = identify_damper(
        dataset.damper,
        next(((r.stroke, r.force) for r in slow if intact(r) and r.split != "heldout"), None),
        [h for h in fitted if is_intact(h)],
        [h for h in fitted if not is_intact(h)],
        slow_lost=[(r.oil_level, (r.stroke, r.force)) for r in slow if not r.gas_preload and r.split != "heldout"],
        method=method, budget=budget, seed=seed, journal=journal, progress=progress,
    )  # fmt: skip
    levels = sorted({h.oil_level for h in found if not is_intact(h)}, reverse=True)
    damper = with_origin(replace(result.damper, measured_levels=tuple(levels)), dataset, result, method, seed, len(fitted))
    result = replace(result, damper=damper)
    rows = [validate_harmonic(damper, h, kind, result.offset) for h, kind in zip(found, split, strict=True)]
    return Result(
        dataset, list(zip(found, split, strict=True)), result, rows + validate_drives(damper, drives),
        remarks + result.remarks,
    )  # fmt: skip


def is_intact(record: Harmonic) -> bool:
    """Whether the record is of the full damper with its preload."""
    return bool(record.gas_preload) and record.oil_level >= 0.995


def splits(records: Sequence[Harmonic], stated: dict[str, str | None]) -> tuple[list[str], list[str]]:
    """`fit` or `heldout` for every record, and a remark on what was decided here."""
    if any(stated[r.name] for r in records):
        return [stated[r.name] or "fit" for r in records], []
    judged = [not is_intact(r) for r in records]
    judged = judged if any(judged) else [True] * len(records)
    speeds: list[float] = []
    for v in sorted(r.top_speed for r, counts in zip(records, judged, strict=True) if counts):
        if not speeds or v > SAME_SPEED * speeds[-1]:
            speeds.append(v)
    every, first = HELD_OUT
    held = [v for i, v in enumerate(speeds[:-2]) if len(speeds) >= ENOUGH and i % every == first]
    kinds = [
        "heldout" if counts and any(v <= r.top_speed <= SAME_SPEED * v for v in held) else "fit"
        for r, counts in zip(records, judged, strict=True)
    ]
    if not held:
        return kinds, [f"{len(speeds)} velocities, fewer than {ENOUGH}: no record is held out, the validation is of the fit"]
    told = ", ".join(f"{v:.3g}" for v in held)
    return kinds, [f"dataset.toml splits nothing: the records at {told} m/s are held out"]


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
    found = result.identification
    return {
        "dataset": result.dataset.title,
        "damper": found.damper.name,
        "remarks": result.remarks,
        "steps": [
            {
                "title": s.title, "parameters": s.names, "error": s.best.error, "unit": s.unit,
                "evaluations": s.best.evaluations,
            }
            for s in found.steps
        ],
        "parameters": {
            e.name: {
                "value": e.value, "interval": [e.low, e.high], "bounds": e.bounds,
                "determined": e.determined, "at_bound": e.at_bound,
            }
            for e in found.estimates
        },
        "not_told_apart": [{"parameters": [a, b], "correlation": c} for a, b, c in found.pairs],
        "force_offset_N": found.offset,
        "validation": [asdict(row) for row in result.validation],
        "heldout": totals(result.validation, "heldout"),
        "fit": totals(result.validation, "fit"),
    }  # fmt: skip


def totals(rows: Sequence[Validated], split: str) -> dict[str, float | None] | None:
    """Errors over the harmonic records of a split: force as RMSE, works relative to the measured one and to the intact one.

    The latter says more where a degraded damper does little work: 3 J of 10 J are nothing beside the intact 100 J.
    """
    harmonics = [row for row in rows if row.measurement == "harmonic" and row.split == split]
    if not harmonics:
        return None
    errors = np.array([
        [abs(s - m) / abs(m) for s, m in zip(row.work_simulated, row.work_measured, strict=True)] for row in harmonics
    ])  # fmt: skip
    found: dict[str, float | None] = {
        "records": len(harmonics),
        "force_rmse_N": float(np.sqrt(np.mean([row.force_rmse**2 for row in harmonics]))),
        "force_rmse_of_peak": float(np.mean([row.force_rmse / row.force_peak for row in harmonics])),
    }
    for i, which in enumerate(("first", "last")):
        found[f"work_error_{which}"] = float(np.median(errors[:, i]))
        found[f"work_error_{which}_worst"] = float(errors[:, i].max())
        relative = [of_intact(row, rows, i) for row in harmonics]
        known = [value for value in relative if value is not None]
        found[f"work_error_{which}_of_intact"] = float(np.median(known)) if known else None
        found[f"work_error_{which}_of_intact_worst"] = max(known) if known else None
    return found


def of_intact(row: Validated, rows: Sequence[Validated], i: int) -> float | None:
    """Error of a record's first or last work relative to that of the intact damper at the same velocity."""
    for other in rows:
        full = other.gas_preload and other.oil_level >= 0.995 and other.measurement == "harmonic"
        if full and row.top_speed / SAME_SPEED <= other.top_speed <= SAME_SPEED * row.top_speed:
            return abs(row.work_simulated[i] - row.work_measured[i]) / abs(other.work_measured[i])
    return None
