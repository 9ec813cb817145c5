"""The weights of the probabilities, fitted by maximum likelihood to answers of the challenge whose truth is known.

`python -m benchmarks calibrate --keep FOLDER` prints them for rules.py. Answers of one set of seeds must not be marked
with weights that were fitted to the same.
"""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import minimize
from scipy.special import logsumexp

from twintube.arrays import Array
from twintube.diagnosis.fits.candidates import RECALIBRATE
from twintube.diagnosis.measurement.faults import PUT_RIGHT
from twintube.diagnosis.result import Tried
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.verdict.confidence import WEIGHTS, Evidence, evidence, features
from worlds.scoring.pairs import holding
from worlds.scoring.truth import read_truths

PRIOR = 4.0  # standard deviation of a weight: a feature that seldom occurs does not run away
OTHERS = (*PUT_RIGHT, RECALIBRATE, "none", "unknown")

Row = tuple[list[str], Array, Sequence[str]]  # names, features, and which of the names are true


def shown(answer: dict[str, Any]) -> Evidence:
    """The evidence in the entries of a diagnosis.json."""
    causes, rivals = ([item["effect"] for item in answer[key]] for key in ("causes", "alternatives"))
    tried = [Tried(**{**row, "interval": tuple(row["interval"])}) for row in answer["tried"]]
    return evidence(answer["verdict"], causes, rivals, tried)


def candidates(answer: dict[str, Any]) -> list[str]:
    """The candidates of an answer."""
    return [name for name in answer["probabilities"] if name not in OTHERS]


def fitted_weights(rows: Sequence[Row]) -> dict[str, float]:
    """The weights of greatest likelihood, by their names; of a pair both causes are right."""
    true = [np.isin(names, list(truth)) for names, _, truth in rows]

    def loss(weights: Array) -> tuple[float, Array]:
        total, slope = float(np.sum((weights / PRIOR) ** 2)) / 2, weights / PRIOR**2
        for (_, table, _), hit in zip(rows, true, strict=True):
            logits = table @ weights
            whole, part = logsumexp(logits), logsumexp(logits[hit])
            total += float(whole - part)
            slope = slope + np.exp(logits - whole) @ table - np.exp(logits[hit] - part) @ table[hit]
        return total, slope

    best = minimize(loss, np.array([getattr(RULES, name) for name in WEIGHTS]), jac=True, method="L-BFGS-B")
    return {name: float(x) for name, x in zip(WEIGHTS, best.x, strict=True)}


def bench_calibrate(keep: Path) -> dict[str, float]:
    """Weights fitted to the answers in the folder of a run."""
    rows: list[Row] = []
    for folder in holding([keep]):
        path = folder / "answer" / "diagnosis.json"
        if not path.is_file():
            continue
        answer = json.loads(path.read_text(encoding="utf-8"))
        names, table = features(shown(answer), candidates(answer))
        truth = [name for name in read_truths(folder / "truth.json")[""].wanted if name in names]
        if truth:
            rows.append((names, table, truth))
    return fitted_weights(rows)
