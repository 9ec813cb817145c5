"""Probabilities of an answer: they sum to one, follow the verdict, and their weights can be fitted."""

import numpy as np
import pytest

from benchmarks.calibrate import fitted_weights
from twintube.diagnosis.fits.candidates import RECALIBRATE
from twintube.diagnosis.measurement.faults import PUT_RIGHT
from twintube.diagnosis.result import Tried
from twintube.diagnosis.verdict.confidence import WEIGHTS, evidence, features, probabilities

KNOWN = ("valve_wear", "fluid_lag", "force_gain")


def attempt(name: str, gain: float, decision: str = "rejected", number: int = 1) -> Tried:
    return Tried(number, name, gain, (gain, gain), decision, "")


@pytest.mark.parametrize(
    ("verdict", "causes", "tried", "first"),
    [
        ("none", [], [attempt("valve_wear", 0.01)], "none"),
        ("unexplained", [], [attempt("valve_wear", 0.1)], "unknown"),
        ("cause", ["valve_wear"], [attempt("valve_wear", 0.9, "chosen"), attempt("fluid_lag", 0.3)], "valve_wear"),
        ("recalibrate", [], [attempt(RECALIBRATE, 0.9, "chosen")], RECALIBRATE),
        ("measurement_fault", ["sign_flip"], [], "sign_flip"),
    ],
)
def test_probabilities_sum_to_one_and_the_verdict_has_the_largest(
    verdict: str, causes: list[str], tried: list[Tried], first: str
) -> None:
    shares = probabilities(evidence(verdict, causes, [], tried), KNOWN)
    assert set(shares) == {*KNOWN, *PUT_RIGHT, RECALIBRATE, "none", "unknown"}
    assert sum(shares.values()) == pytest.approx(1.0, abs=1e-12)
    assert next(iter(shares)) == first
    assert list(shares.values()) == sorted(shares.values(), reverse=True)


def test_a_rival_gets_more_than_other_candidates() -> None:
    tried = [attempt("valve_wear", 0.9, "chosen"), attempt("fluid_lag", 0.9), attempt("force_gain", 0.2)]
    shares = probabilities(evidence("ambiguous", ["valve_wear"], ["fluid_lag"], tried), KNOWN)
    assert shares["valve_wear"] == pytest.approx(shares["fluid_lag"])
    assert shares["fluid_lag"] > 3 * shares["force_gain"]


def test_fitted_weights_state_how_often_the_verdict_is_right() -> None:
    # A verdict that is right in seven of ten, else it is something unknown.
    table = [
        (
            evidence("cause", ["valve_wear"], [], [attempt("valve_wear", 0.9, "chosen")]),
            ["valve_wear"] if i < 7 else ["unknown"],
        )
        for i in range(10)
    ] * 20
    weights = fitted_weights([(*features(seen, KNOWN), truth) for seen, truth in table])
    names, rows = features(table[0][0], KNOWN)
    p = np.exp(rows @ np.array([weights[name] for name in WEIGHTS]))
    p /= p.sum()
    assert p[names.index("valve_wear")] == pytest.approx(0.7, abs=0.03)
    assert p[names.index("unknown")] == pytest.approx(0.3, abs=0.03)
