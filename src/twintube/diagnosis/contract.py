"""diagnosis.json of an answer."""

from typing import Any

import numpy as np

from twintube.diagnosis.answer import Answer
from twintube.diagnosis.bench import Bench
from twintube.diagnosis.changes import NONE, Hypothesis
from twintube.diagnosis.found import Found
from twintube.diagnosis.heldout import HeldOut
from twintube.diagnosis.measurement.faults import Fault
from twintube.diagnosis.mechanisms import Mechanism, unit_of
from twintube.diagnosis.records.seen import TARE

HALF = 1.645  # standard deviations of half a 90 % interval


def as_json(answer: Answer) -> dict[str, Any]:
    """The contents of diagnosis.json."""
    content: dict[str, Any] = {"verdict": answer.verdict, "state": [one.as_json() for one in answer.states]}
    if answer.changes is not None:
        several = [(name_of(h, answer.faults), h) for h in answer.changes.hypotheses]
        named = [] if answer.verdict == "unexplained" else answer.named
        known = answer.budget()
        content |= {
            "compared_with_reference": answer.compared,
            "unexplained": answer.unexplained,
            "budget": known.as_json() if known is not None else None,
            "hypotheses": [entry(name, h) | {"left_out_weight": answer.weights.get(h.name)} for name, h in several],
            "probabilities": {name: h.probability for name, h in several},
            "credible_set": [name_of(h, answer.faults) for h in answer.named],
            "causes": [
                *map(faulty, answer.faults),
                *(c for h in named if h.found for c in causes(h.found, h.name, answer)),
            ],
            "always": [m.effect for m in answer.changes.base],
            "left_out": list(answer.measured.odd) if answer.measured is not None else [],
            "held_out": [vars(h) for h in answer.held_out],
            "remarks": list(answer.remarks),
        }
    return content | {"seconds": round(answer.seconds, 1)}


def name_of(h: Hypothesis, faults: tuple[Fault, ...]) -> str:
    """The name of a hypothesis; nothing beside faults that were put right has theirs."""
    return "+".join(dict.fromkeys(fault.effect for fault in faults)) if h.kind == NONE and faults else h.name


def entry(name: str, h: Hypothesis) -> dict[str, Any]:
    """A hypothesis."""
    log_evidence = round(h.log_evidence, 3) if np.isfinite(h.log_evidence) else None  # too slight to be told from nothing
    return {"name": name, "kind": h.kind, "probability": h.probability, "log_evidence": log_evidence}


def faulty(fault: Fault) -> dict[str, Any]:
    """A fault that was put right."""
    low, high = fault.factor - fault.spread, fault.factor + fault.spread
    value = {"value": fault.factor, "interval": [low, high], "unit": fault.unit}
    return {"effect": fault.effect, "put_right": True, "text": fault.explanation, "parameters": {fault.name: value}}


def causes(found: Found, name: str, answer: Answer) -> list[dict[str, Any]]:
    """The mechanisms that are named, with strengths and what is gained where they were not fitted."""
    gain = gained(answer.held_out)
    assert answer.changes is not None, "it has causes"
    bench = answer.changes.search.bench
    parts = [m for m in found.mechanism.parts or (found.mechanism,) if m.effect in name.split("+") and m.strengths]
    return [cause(part, found, bench) | ({"gain": {"heldout": gain}} if gain is not None else {}) for part in parts]


def cause(m: Mechanism, found: Found, bench: Bench) -> dict[str, Any]:
    """A mechanism with its strengths."""
    values = {}
    for s in m.strengths:
        if s.name == TARE:
            gas = bench.damper.parameters.F_0
            x, half = gas * found.values[TARE], gas * HALF * found.spread[TARE]
            values["force_offset"] = {"value": x, "interval": [x - half, x + half], "unit": "N"}
            continue
        x, half = found.values[s.name], HALF * found.spread[s.name]
        values[s.name] = {"value": x, "interval": [x - half, x + half], "unit": unit_of(s.name)}
    return {"effect": m.effect, "way": m.way, "parameters": values}


def gained(held_out: tuple[HeldOut, ...]) -> float | None:
    """Share of the squared error above the noise that goes away on records that a cause was not fitted to."""
    known = [one for one in held_out if one.with_cause is not None]
    if not known:
        return None
    base, extended, noise = (
        float(np.mean(np.square(x)))
        for x in zip(*((one.without, one.with_cause or 0.0, one.noise) for one in known), strict=True)
    )
    return (base - extended) / (base - noise) if base > noise else 0.0
