"""diagnosis.json of an answer."""

from typing import Any

import numpy as np

from twintube.evidence.answer import Answer
from twintube.evidence.changes import Hypothesis
from twintube.evidence.heldout import HeldOut

HALF = 1.645  # standard deviations of half a 90 % interval


def as_json(answer: Answer) -> dict[str, Any]:
    """The contents of diagnosis.json."""
    content: dict[str, Any] = {"verdict": answer.verdict, "state": [one.as_json() for one in answer.states]}
    if answer.changes is not None:
        several = answer.changes.hypotheses
        content |= {
            "hypotheses": [entry(h) for h in several],
            "probabilities": {h.name: h.probability for h in several},
            "credible_set": list(answer.changes.credible),
            "causes": [cause(h, answer.held_out) for h in answer.named if h.found is not None],
            "always": [m.effect for m in answer.changes.base],
            "held_out": [vars(h) for h in answer.held_out],
        }
    return content | {"seconds": round(answer.seconds, 1)}


def entry(h: Hypothesis) -> dict[str, Any]:
    """A hypothesis."""
    log_evidence = round(h.log_evidence, 3) if np.isfinite(h.log_evidence) else None  # too slight to be told from nothing
    return {"name": h.name, "kind": h.kind, "probability": h.probability, "log_evidence": log_evidence}


def cause(h: Hypothesis, held_out: tuple[HeldOut, ...]) -> dict[str, Any]:
    """A mechanism with its strengths, and what it is worth where it was not fitted."""
    assert h.found is not None
    values = {
        n: {"value": x, "interval": [x - HALF * h.found.spread[n], x + HALF * h.found.spread[n]]}
        for n, x in h.found.values.items()
    }
    known = [one for one in held_out if one.with_cause is not None]
    content: dict[str, Any] = {"effect": h.name, "way": h.found.mechanism.way, "parameters": values}
    if known:
        base, extended, noise = (
            float(np.mean(np.square(x)))
            for x in zip(*((one.without, one.with_cause or 0.0, one.noise) for one in known), strict=True)
        )
        content["gain"] = {"heldout": (base - extended) / (base - noise) if base > noise else 0.0}
    return content
