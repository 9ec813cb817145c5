"""Errors and gains over records, and the intervals of gains by resampling the records."""

from collections.abc import Sequence

import numpy as np

from twintube.arrays import Array
from twintube.diagnosis.result import Errors, RecordResult
from twintube.diagnosis.rules import RULES


def rms(records: Sequence[RecordResult]) -> float:
    """Force error of the base model [N]."""
    return float(np.sqrt(np.mean(np.concatenate([(r.base - r.measured)[1:] ** 2 for r in records]))))


def errors(records: Sequence[RecordResult]) -> dict[str, Errors]:
    """Force and work errors of base, recalibrated and extended model over some records, and the noise floor."""
    models = {}
    for name in ("base", "recalibrated", "extended"):
        squares = np.concatenate([((getattr(r, name) - r.measured)[1:]) ** 2 for r in records])
        works = np.array([float(np.sum((getattr(r, name) - r.measured)[1:] * np.diff(r.record.stroke))) for r in records])
        turns = np.array([max(1, len(np.unique(r.record.cycle[r.record.cycle >= 0]))) for r in records])
        models[name] = Errors(float(np.sqrt(squares.mean())), float(np.sqrt(np.mean((works / turns) ** 2))))
    noise = np.concatenate([r.record.noise[1:] ** 2 for r in records])
    models["noise_floor"] = Errors(float(np.sqrt(noise.mean())), 0.0)
    return models


def gains(records: Sequence[RecordResult]) -> Array:
    """Squared error that goes away and that is explainable (r, 2) [N2] per record."""
    rows = []
    for r in records:
        base, extended = (float(np.sum((force - r.measured)[1:] ** 2)) for force in (r.base, r.extended))
        noise = float(np.sum(r.record.noise[1:] ** 2))
        rows.append((base - max(extended, noise), max(base - noise, 1e-9)))
    return np.array(rows)


def whole(rows: Array) -> float:
    """Gain of all records together from what goes away and what is explainable (r, 2)."""
    return float(rows[:, 0].sum() / rows[:, 1].sum())


def worst(rows: Array) -> float:
    """Gain of the record that gains least, of those that hold a share of the explainable error worth the name."""
    some = rows[rows[:, 1] >= RULES.worst_share * rows[:, 1].sum()]
    return float((some[:, 0] / some[:, 1]).min())


def removed(before: float, after: float, count: int) -> float:
    """Share of the explainable squared error that goes away between two scores of `count` samples (geometric mean)."""
    if before <= 0.0:
        return 0.0
    return float((1.0 - np.exp((max(after, 0.0) - before) / count)) / (1.0 - np.exp(-before / count)))


def bootstrap(rows: Array, seed: int = 1) -> tuple[float, float]:
    """Interval of the ratio of sums of the columns (r, 2), by resampling the rows."""
    rng = np.random.default_rng(seed)
    picks = rng.integers(0, len(rows), (RULES.resamples, len(rows)))
    sums = rows[picks].sum(axis=1)
    ratios = sums[:, 0] / np.where(np.abs(sums[:, 1]) > 0, sums[:, 1], np.nan)
    level = RULES.interval_level
    low, high = np.nanquantile(ratios, [(1 - level) / 2, (1 + level) / 2])
    return float(low), float(high)
