"""Probabilities of all answers, calibrated on datasets whose truth was written by others (docs/challenge.md).

A multinomial logit of what stands in the answer itself: the verdict, what it names, and the share of the error that each
candidate removes. Its weights are fitted by `python -m benchmarks calibrate` to development seeds and stand in rules.py.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from twintube.arrays import Array
from twintube.diagnosis.fits.candidates import RECALIBRATE
from twintube.diagnosis.measurement.faults import PUT_RIGHT
from twintube.diagnosis.result import Tried
from twintube.diagnosis.rules import RULES

WEIGHTS = (
    "logit_share",
    "logit_named",
    "logit_rival",
    "logit_near",
    "logit_none",
    "logit_none_said",
    "logit_unknown",
    "logit_left",
    "logit_unexplained",
)


@dataclass(frozen=True)
class Evidence:
    """What an answer says of its candidates."""

    verdict: str
    named: tuple[str, ...]  # causes, faults or `recalibrate`
    rivals: tuple[str, ...]  # alternatives of an ambiguous verdict
    near: tuple[str, ...]  # chosen, but not good enough to be named
    shares: Mapping[str, float]  # of the explainable error that each removes, 0 to 1


def evidence(verdict: str, causes: Sequence[str], rivals: Sequence[str], tried: Iterable[Tried]) -> Evidence:
    """The evidence from the parts of an answer; what was put right before anything was fitted leaves nothing."""
    rows = list(tried)
    shares: dict[str, float] = {}
    for row in rows:
        shares[row.effect] = max(shares.get(row.effect, 0.0), float(np.clip(row.heldout_gain, 0.0, 1.0)))
    shares |= {name: 1.0 for name in causes if name in PUT_RIGHT}
    chosen = [row.effect for row in rows if row.decision == "chosen"]
    named = (RECALIBRATE,) if verdict == RECALIBRATE else tuple(causes)
    near = tuple(name for name in chosen if name not in named)
    return Evidence(verdict, named, tuple(rivals), near, shares)


def features(seen: Evidence, candidates: Iterable[str]) -> tuple[list[str], Array]:
    """The names of all answers and their features (names, weights), in the order of WEIGHTS."""
    table: dict[str, dict[str, float]] = {}
    for name in dict.fromkeys((*candidates, *PUT_RIGHT, RECALIBRATE)):
        table[name] = {
            "logit_share": seen.shares.get(name, 0.0),
            "logit_named": float(name in seen.named and seen.verdict != "ambiguous"),
            "logit_rival": float(name in seen.rivals or (name in seen.named and seen.verdict == "ambiguous")),
            "logit_near": float(name in seen.near),
        }
    best = max(seen.shares.values(), default=0.0)
    table["none"] = {"logit_none": 1.0, "logit_none_said": float(seen.verdict == "none")}
    table["unknown"] = {
        "logit_unknown": 1.0,
        "logit_left": 1.0 - best,
        "logit_unexplained": float(seen.verdict == "unexplained"),
    }
    return list(table), np.array([[row.get(weight, 0.0) for weight in WEIGHTS] for row in table.values()])


def probabilities(seen: Evidence, candidates: Iterable[str]) -> dict[str, float]:
    """The probabilities of all candidates and faults, `none`, `recalibrate` and `unknown`, the largest first; sum 1."""
    names, rows = features(seen, candidates)
    shares = softmax(rows @ np.array([getattr(RULES, weight) for weight in WEIGHTS]))
    return dict(sorted(((name, float(p)) for name, p in zip(names, shares, strict=True)), key=lambda item: -item[1]))


def softmax(logits: Array) -> Array:
    """Probabilities (n,) from logits (n,)."""
    weights = np.exp(logits - logits.max())
    return np.asarray(weights / weights.sum())
