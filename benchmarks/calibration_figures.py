"""What ranks and probabilities say of a calibration."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.stats import beta, chisquare, kstest

from twintube.common.arrays import Array
from twintube.diagnosis.changes import NONE

BINS = 10
EVEN = 0.5  # probability of the one and the other
SURE = 0.99
SUREST = 1e-6  # probability that counts for a truth which is all but excluded


def figures(state: Sequence[dict[str, Any]], changes: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """All figures, from the rows of both."""
    return {"state": of_state(state), "changes": of_changes(changes)}


def share(hits: int, n: int) -> dict[str, float]:
    """A share [1] with its 95 % interval (Clopper and Pearson)."""
    low = float(beta.ppf(0.025, hits, n - hits + 1)) if hits else 0.0
    high = float(beta.ppf(0.975, hits + 1, n - hits)) if hits < n else 1.0
    return {"share": hits / n, "low": low, "high": high, "hits": hits, "n": n}


def told(p: Array, true: Array) -> dict[str, float]:
    """Probabilities (n,) against what is true (n,); `off` is the difference in standard deviations."""
    spread = float(np.sqrt(np.sum(p * (1.0 - p))))
    off = float(np.sum(true) - np.sum(p)) / spread if spread > 0.0 else 0.0
    likely = np.where(true, p, 1.0 - p)
    log_score = float(np.mean(np.log(np.maximum(likely, SUREST))))
    return {"true": float(np.sum(true)), "expected": float(np.sum(p)), "off": off, "brier": float(np.mean((p - true) ** 2)),
            "log_score": log_score}  # fmt: skip


def of_state(rows: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Ranks of the true oil level, which are uniform; its 90 % interval; the preload."""
    ranks = np.array([row["rank"] for row in rows])
    count = np.histogram(ranks, BINS, (0.0, 1.0))[0]
    ecdf = kstest(ranks, "uniform")
    wide = np.array([row["interval"][1] - row["interval"][0] for row in rows])
    p = np.array([row["gas_lost"] for row in rows]).clip(0.0, 1.0)
    lost = np.array([row["gas_preload"] == 0 for row in rows])
    return {
        "draws": len(rows),
        "ranks": {f"{i / BINS:.1f} to {(i + 1) / BINS:.1f}": float(n) for i, n in enumerate(count)},
        "chi_square": {"value": float(chisquare(count).statistic), "p": float(chisquare(count).pvalue)},
        "ecdf": {"largest_gap": float(ecdf.statistic), "p": float(ecdf.pvalue), "band_95": 1.358 / len(rows) ** 0.5},
        "inside_90": share(sum(bool(row["inside"]) for row in rows), len(rows)),
        "width": {"median": float(np.median(wide))},
        "gas_lost": told(p, lost),
        "preload_right": share(int(np.sum((p > EVEN) == lost)), len(rows)),
    }


def probability(row: dict[str, Any]) -> float:
    """Probability of what is true; of two at once in either order."""
    return float(sum(p for name, p in row["probabilities"].items() if alike(name, row["truth"])))


def alike(name: str, truth: str) -> bool:
    """Whether two names hold the same causes."""
    return sorted(name.split("+")) == sorted(truth.split("+"))


def of_changes(rows: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Whether the likeliest hypothesis, nothing, and each that is asked are as often true as their probabilities say."""
    best = [max(row["probabilities"].items(), key=lambda item: float(item[1])) for row in rows]
    right = np.array([alike(name, row["truth"]) for (name, _), row in zip(best, rows, strict=True)])
    p = np.array([float(x) for _, x in best]).clip(0.0, 1.0)
    nothing = np.array([float(row["probabilities"][NONE]) for row in rows]).clip(0.0, 1.0)
    held = sum(any(alike(name, row["truth"]) for name in row["credible"]) for row in rows)
    several = np.array([probability(row) for row in rows])
    sure = p >= SURE
    return {
        "draws": len(rows),
        "likeliest": told(p, right),
        "none": told(nothing, np.array([row["truth"] == NONE for row in rows])),
        "truth": {"mean_log": float(np.mean(np.log(np.maximum(several, SUREST)))), "mean": float(several.mean())},
        "in_the_90_set": share(held, len(rows)),
        "right": share(int(right.sum()), len(rows)),
        "right_where_sure": share(int(right[sure].sum()), int(sure.sum())) if sure.any() else {"n": 0.0},
    }
