"""Marks for answers to datasets with a hidden cause, as diagnosis competitions give them.

An outcome is a dictionary with `truth` (what `write` returns), `answer` (the content of diagnosis.json, or `refused` with
the reason of the data door, or `failed`). Terms of the DX competitions (Kurtoglu et al. 2009).
"""

import math
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np

Outcome = dict[str, Any]
ASSERTING = ("cause", "measurement_fault", "recalibrate")
CLEAR = 0.5  # effect over noise from which a cause should be named
EDGES = (0.0, 0.2, 0.35, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0, math.inf)  # of the detection limits, effect over noise
ENOUGH = 0.9  # share named first
BINS = 10
REFUSABLE = ("sign_flip", "unit_error")  # faults that the data door may name itself


def verdict_of(answer: dict[str, Any]) -> str:
    """The verdict, or `refused` or `failed`."""
    return next((word for word in ("refused", "failed") if word in answer), str(answer.get("verdict", "failed")))


def named(answer: dict[str, Any]) -> list[str]:
    """What the answer asserts: effects or faults, or `recalibrate`."""
    verdict = verdict_of(answer)
    if verdict == "recalibrate":
        return ["recalibrate"]
    return [item["effect"] for item in answer.get("causes", [])] if verdict in ASSERTING else []


def first(answer: dict[str, Any]) -> str:
    """What stands first, also of an ambiguous answer."""
    names = named(answer) or [item["effect"] for item in (*answer.get("causes", []), *answer.get("alternatives", []))]
    return names[0] if names and verdict_of(answer) in (*ASSERTING, "ambiguous") else ""


def answered(answer: dict[str, Any]) -> str:
    """The answer's column in the confusion matrix."""
    return "+".join(sorted(named(answer))) or verdict_of(answer)


def wanted(truth: dict[str, Any]) -> list[str]:
    """The names that are right: of a trouble outside the catalogue `unknown`."""
    return ["unknown"] if truth["kind"] == "outside" else list(truth["causes"])


def right(outcome: Outcome) -> bool:
    """All causes named and nothing else; for nothing hidden `none`; outside the catalogue nothing asserted."""
    truth, answer = outcome["truth"], outcome["answer"]
    verdict = verdict_of(answer)
    if truth["kind"] == "none":
        return verdict == "none"
    if truth["kind"] == "outside":
        return verdict != "failed" and not named(answer)
    if verdict == "refused":
        return truth["cause"] in REFUSABLE
    return set(named(answer)) == set(truth["causes"])


def wrong_name(outcome: Outcome) -> bool:
    """Something is asserted that was not hidden."""
    return not set(named(outcome["answer"])) <= set(outcome["truth"]["causes"])


def truth_first(outcome: Outcome) -> bool:
    """A hidden cause stands first, asserted or ambiguous."""
    refused = verdict_of(outcome["answer"]) == "refused" and outcome["truth"]["cause"] in REFUSABLE
    return refused or first(outcome["answer"]) in outcome["truth"]["causes"]


def nameable(outcome: Outcome) -> bool:
    """Whether a known cause is clear beyond the bench, and not just a delay of less than a sample."""
    truth = outcome["truth"]
    sizes = (truth.get(key, math.inf) for key in ("effect_over_noise", "effect_beyond_bench"))
    known = truth["kind"] not in ("none", "outside")
    return known and min(sizes) >= CLEAR and truth.get("late_samples", math.inf) >= 1.0


def share(outcomes: Sequence[Outcome], test: Callable[[Outcome], bool]) -> float:
    """Share that passes; NaN of none."""
    return sum(map(test, outcomes)) / len(outcomes) if outcomes else math.nan


def contradictions(answer: dict[str, Any]) -> list[str]:
    """Where the verdict and the figures of an answer disagree."""
    remarks = []
    error = {model: figures.get("force_rmse_N") for model, figures in answer.get("error", {}).items() if figures}
    base, extended, floor = (error.get(name) for name in ("base", "extended", "noise_floor"))
    if verdict_of(answer) in ("cause", "measurement_fault"):
        for item in answer.get("causes", []):
            gain = item.get("gain", {}).get("heldout")
            if gain is not None and gain <= 0.0:
                remarks.append(f"{item['effect']} with a held-out gain of {gain:.3g}")
            remarks += [
                f"{item['effect']}: {name} in doubt"
                for name, value in item.get("parameters", {}).items()
                if value.get("doubt")
            ]
        if base is not None and floor is not None and base < floor:
            remarks.append(f"a cause below the noise floor: {base:.4g} < {floor:.4g} N")
        if base is not None and extended is not None and extended > base:
            remarks.append(f"extended {extended:.4g} N above base {base:.4g} N")
    for item in answer.get("alternatives", []):
        gain = item.get("heldout_gain")
        if gain is not None and gain <= 0.0:
            remarks.append(f"{item['effect']} as an alternative with a held-out gain of {gain:.3g}")
    total = sum(answer.get("probabilities", {}).values())
    if verdict_of(answer) not in ("refused", "failed") and not abs(total - 1.0) < 1e-3:
        remarks.append(f"probabilities sum to {total:.4g}")
    return remarks


def truth_probability(outcome: Outcome) -> float:
    """Probability given to what was hidden, of a pair to both."""
    return float(sum(outcome["answer"]["probabilities"].get(name, 0.0) for name in wanted(outcome["truth"])))


def brier(outcome: Outcome) -> float:
    """Multi-class Brier score, 0 to 2; the causes of a pair count as one class."""
    names = wanted(outcome["truth"])
    others = [p for name, p in outcome["answer"]["probabilities"].items() if name not in names]
    return float((1.0 - truth_probability(outcome)) ** 2 + sum(p**2 for p in others))


def reliability(outcomes: Iterable[Outcome]) -> dict[str, dict[str, float]]:
    """Bins of the largest probability: how many, its mean, and how often the name was right."""
    rows: dict[int, list[tuple[float, bool]]] = defaultdict(list)
    for outcome in outcomes:
        name, p = max(outcome["answer"]["probabilities"].items(), key=lambda item: item[1])
        rows[min(int(p * BINS), BINS - 1)].append((p, name in wanted(outcome["truth"])))
    return {
        f"{i / BINS:.1f}-{(i + 1) / BINS:.1f}": {
            "count": len(row), "mean": float(np.mean([p for p, _ in row])), "right": float(np.mean([hit for _, hit in row])),
        }
        for i, row in sorted(rows.items())
    }  # fmt: skip


def covered(outcomes: Iterable[Outcome]) -> dict[str, dict[str, float]]:
    """By value: how many intervals were given, and the share that holds the truth."""
    hits: dict[str, list[bool]] = defaultdict(list)
    for outcome in outcomes:
        for item in outcome["answer"].get("causes", []):
            for name, value in item.get("parameters", {}).items():
                interval = value.get("interval")
                if name in outcome["truth"].get("values", {}) and interval and None not in interval:
                    hits[name].append(bool(interval[0] <= outcome["truth"]["values"][name] <= interval[1]))
    hits["all"] = [hit for row in hits.values() for hit in row]
    return {name: {"count": len(row), "share": float(np.mean(row)) if row else math.nan} for name, row in hits.items()}


def limit(outcomes: Sequence[Outcome], size: str = "effect_over_noise") -> float:
    """Smallest edge of a size from which on ENOUGH are named first; infinite where none is."""
    for low in EDGES[:-1]:
        above = [o for o in outcomes if o["truth"].get(size, -math.inf) >= low]
        if above and share(above, truth_first) >= ENOUGH:
            return low
    return math.inf


def score(outcomes: Sequence[Outcome]) -> dict[str, Any]:
    """All figures; shares from 0 to 1, NaN where there is nothing to count."""
    healthy = [o for o in outcomes if o["truth"]["kind"] == "none"]
    hidden = [o for o in outcomes if o["truth"]["kind"] != "none"]
    known = [o for o in hidden if o["truth"]["kind"] != "outside"]
    clear = [o for o in known if o["truth"].get("effect_over_noise", math.inf) >= CLEAR]
    outside_tolerance = [o for o in clear if o["truth"].get("effect_beyond_bench", math.inf) >= CLEAR]
    rated = [o for o in outcomes if o["answer"].get("probabilities")]
    matrix: dict[str, Counter[str]] = defaultdict(Counter)
    for o in outcomes:
        matrix[o["truth"]["hidden"]][answered(o["answer"])] += 1
    figures: dict[str, Any] = {
        "datasets": len(outcomes),
        "false_alarm_share": share(healthy, lambda o: bool(named(o["answer"]))),
        "none_right_share": share(healthy, right),
        "detection_share": share(clear, lambda o: verdict_of(o["answer"]) != "none"),
        "right_share_clear": share(clear, right),
        "right_share_all": share(known, right),
        "truth_first_share_clear": share(clear, truth_first),
        "right_share_beyond_bench": share(outside_tolerance, right),
        "truth_first_share_beyond_bench": share(outside_tolerance, truth_first),
        "right_share_nameable": share([o for o in known if nameable(o)], right),
        "truth_first_share_nameable": share([o for o in known if nameable(o)], truth_first),
        "wrong_name_share": share(outcomes, wrong_name),
        "outside_right_share": share([o for o in hidden if o["truth"]["kind"] == "outside"], right),
        "ambiguous_truth_first": sum(verdict_of(o["answer"]) == "ambiguous" and truth_first(o) for o in known),
        "ambiguous": sum(verdict_of(o["answer"]) == "ambiguous" for o in outcomes),
        "failed": sum(verdict_of(o["answer"]) == "failed" for o in outcomes),
        "contradictions": sum(len(contradictions(o["answer"])) for o in outcomes),
        "isolation": float(np.mean([truth_probability(o) for o in rated])) if rated else math.nan,
        "isolation_hidden": mean_of([truth_probability(o) for o in rated if o["truth"]["kind"] != "none"]),
        "brier": mean_of([brier(o) for o in rated]),
        "median_seconds": median_of([o["answer"]["seconds"] for o in outcomes if "seconds" in o["answer"]]),
        "matrix": {name: dict(row.most_common()) for name, row in sorted(matrix.items())},
        "reliability": reliability(rated),
        "coverage": covered(outcomes),
        "detection_limit": {
            name: limit([o for o in known if o["truth"]["hidden"] == name])
            for name in sorted({o["truth"]["hidden"] for o in known if "effect_over_noise" in o["truth"]})
        },
        "remarks": Counter(text for o in outcomes for text in contradictions(o["answer"])),
    }
    return figures


def mean_of(values: list[float]) -> float:
    """Mean, NaN of nothing."""
    return float(np.mean(values)) if values else math.nan


def median_of(values: list[float]) -> float:
    """Median, NaN of nothing."""
    return float(np.median(values)) if values else math.nan
