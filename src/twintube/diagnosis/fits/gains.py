"""Errors and gains over records, and the intervals of gains by resampling the records."""

from collections.abc import Sequence

import numpy as np

from twintube.arrays import Array
from twintube.diagnosis.result import Errors, RecordResult
from twintube.diagnosis.rules import RULES


def errors(records: Sequence[RecordResult]) -> dict[str, Errors]:
    """Force and work errors of base, recalibrated and extended model over some records, and the noise floor.

    An interval counts by its uncertainty, in all of these errors of the force alike; the work is that of the intervals that
    are compared.
    """
    weights = np.concatenate([r.weight for r in records]) ** 2
    models = {}
    for name in ("base", "recalibrated", "extended"):
        squares = np.concatenate([(getattr(r, name) - r.measured) ** 2 for r in records])
        works = np.array([float((getattr(r, name) - r.measured)[1:] @ (np.diff(r.record.stroke) * (r.weight[1:] > 0)))
                          for r in records])  # fmt: skip
        turns = np.array([max(1, len(np.unique(r.record.cycle[r.record.cycle >= 0]))) for r in records])
        force = float(np.sqrt(np.sum(weights * squares) / weights.sum()))
        models[name] = Errors(force, float(np.sqrt(np.mean((works / turns) ** 2))))
    noise = np.sqrt(floor(records) * np.sum(weights > 0) / weights.sum())
    least = min(float(noise), *(model.force_rmse_N for model in models.values()))  # equal but for rounding
    models["noise_floor"] = Errors(least, 0.0)
    return models


def floor(records: Sequence[RecordResult]) -> float:
    """Mean squared weighted error that noise leaves, 1 or what the best model leaves: no model predicts noise."""
    squares = [sum(np.sum((r.weight * (force - r.measured)) ** 2) for r, force in zip(records, some, strict=True))
               for some in zip(*((r.base, r.recalibrated, r.extended) for r in records), strict=True)]  # fmt: skip
    return float(min(1.0, min(squares) / sum(np.sum(r.weight > 0) for r in records)))


def gains(records: Sequence[RecordResult], *, parts: bool = False, least: float | None = None) -> Array:
    """Squared weighted error that goes away and that is explainable (r, 2) per record, or per part of a record.

    `least` is the mean squared weighted error that noise leaves, that of these models where it is not given.
    """
    rows = []
    least = floor(records) if least is None else least
    for r in records:
        part = r.record.part if parts else np.zeros(len(r.weight), dtype=np.int64)
        base, extended = (np.bincount(part, (r.weight * (force - r.measured)) ** 2) for force in (r.base, r.extended))
        rows.append(np.column_stack([base - extended, base - least * np.bincount(part, r.weight > 0)]))
    return np.concatenate(rows)


def whole(rows: Array) -> float:
    """Gain of all records together from what goes away and what is explainable (r, 2), as of the errors of the models."""
    explainable = float(rows[:, 1].sum())
    return float(min(1.0, rows[:, 0].sum() / explainable)) if explainable > 0.0 else 0.0


def worst(rows: Array) -> float:
    """Gain of the record that gains least, of those that hold a share of the explainable error worth the name."""
    some = rows[rows[:, 1] >= RULES.worst_share * max(rows[:, 1].sum(), 0.0)]
    some = some[some[:, 1] > 0.0]
    return float((some[:, 0] / some[:, 1]).min()) if len(some) else 0.0


def removed(before: float, after: float, count: int) -> float:
    """Share of the explainable squared error that goes away between two scores of `count` samples (geometric mean)."""
    if before <= 0.0:
        return 0.0
    return float((1.0 - np.exp((max(after, 0.0) - before) / count)) / (1.0 - np.exp(-before / count)))


def bootstrap(
    rows: Array, seed: int = 1, level: float = RULES.interval_level, size: Array | None = None
) -> tuple[float, float]:
    """Interval at a `level` of the ratio of sums of the columns (r, 2), by resampling the rows.

    Rows that hold hardly anything, by `size` (r,) or by their numbers, stay in every resample: what acts in two of many
    records would be missing in some.
    """
    rng = np.random.default_rng(seed)
    size = np.abs(rows).max(axis=1) if size is None else size
    idle = size < RULES.idle * size.max()
    some = rows[~idle] if np.sum(~idle) > 1 else rows
    picks = rng.integers(0, len(some), (RULES.resamples, len(some)))
    sums = some[picks].sum(axis=1) + (rows.sum(axis=0) - some.sum(axis=0))
    ratios = sums[:, 0] / np.where(sums[:, 1] > 0, sums[:, 1], np.nan)
    if np.isnan(ratios).all():
        return 0.0, 0.0
    low, high = np.nanquantile(np.minimum(ratios, 1.0), [(1 - level) / 2, (1 + level) / 2])
    return float(low), float(high)
