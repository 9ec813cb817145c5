"""Probabilities of all answers, calibrated on datasets whose truth was written by others (docs/challenge.md).

A multinomial logit: every candidate by the share of the log error that it removes and by whether the verdict names it,
`none`, `recalibrate` and `unknown` by the verdict and by what is left. The weights are thresholds like others (rules.py).
"""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from twintube.diagnosis.faults import PUT_RIGHT, Fault
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.select import RECALIBRATE, Selection
from twintube.diagnosis.verdict import Judgement


def probabilities(
    judgement: Judgement, selection: Selection, candidates: Iterable[str], faults: Sequence[Fault]
) -> dict[str, float]:
    """The probabilities of all candidates and faults, `none`, `recalibrate` and `unknown`, the largest first; sum 1."""
    shares = removed_shares(selection) | {fault.effect: 1.0 for fault in faults}
    best = max(shares.values(), default=0.0)  # what was put right leaves nothing to explain
    named = [*judgement.causes, *(fault.effect for fault in faults)]
    if judgement.remaining == "recalibrate":
        named.append(RECALIBRATE)
    doubtful = {option.names[-1] for option in judgement.rivals}
    logits = {}
    for name in (*candidates, *PUT_RIGHT, RECALIBRATE):
        logits[name] = RULES.logit_share * shares.get(name, 0.0) + RULES.logit_named * (name in named)
        logits[name] += RULES.logit_rival * (name in doubtful)
    logits["none"] = RULES.logit_none + RULES.logit_said * (judgement.verdict == "none")
    logits["unknown"] = (
        RULES.logit_unknown + RULES.logit_left * (1.0 - best) + RULES.logit_said * (judgement.verdict == "unexplained")
    )
    return normalised(logits)


def removed_shares(selection: Selection) -> dict[str, float]:
    """The share of the log error beyond noise that each candidate removes, 0 to 1: alone, chosen candidates together."""
    whole = max(selection.start.score, RULES.right * selection.count)
    shares: dict[str, float] = {}
    for option in selection.rounds[0] if selection.rounds else []:
        shares[option.names[-1]] = float(np.clip((selection.start.score - option.score) / whole, 0.0, 1.0))
    for name in selection.chosen:
        shares[name] = max(shares.get(name, 0.0), float(np.clip(1 - selection.final.score / whole, 0.0, 1.0)))
    return shares


def normalised(logits: Mapping[str, float]) -> dict[str, float]:
    """Probabilities from logits, the largest first."""
    largest = max(logits.values())
    weights = {name: float(np.exp(value - largest)) for name, value in logits.items()}
    total = sum(weights.values())
    return dict(sorted(((name, weight / total) for name, weight in weights.items()), key=lambda item: -item[1]))
