"""What the benchmarks of the diagnosis say of ranks, probabilities and other priors."""

import numpy as np
import pytest

from benchmarks.calibration_figures import alike, of_changes, told
from benchmarks.priors import Variant, scaled, summary, varied
from twintube.diagnosis import changes
from twintube.diagnosis.mechanisms import faults
from twintube.diagnosis.numbers import numbers


def test_probabilities_that_are_too_sure() -> None:
    """Of ten that are called true with 90 % five are: nine are expected, and the spread is the root of ten times 0.09."""
    found = told(np.full(10, 0.9), np.arange(10) < 5)
    assert found["expected"] == pytest.approx(9.0)
    assert found["off"] == pytest.approx(-4.0 / 0.9**0.5)
    assert found["brier"] == pytest.approx(0.5 * 0.01 + 0.5 * 0.81)


def test_two_causes_are_the_same_in_either_order() -> None:
    assert alike("b+a", "a+b")
    assert not alike("a", "a+b")
    row = {"truth": "a+b", "probabilities": {"none": 0.2, "b+a": 0.8}, "credible": ["b+a", "none"]}
    found = of_changes([row])
    assert (found["right"]["hits"], found["in_the_90_set"]["hits"]) == (1, 1)
    assert found["truth"]["mean"] == pytest.approx(0.8)


def test_other_priors_hold_only_inside() -> None:
    law, usual = numbers().law_usual, changes.mechanisms
    with varied(Variant("D doubled", law=2.0), lambda *_: None):
        assert numbers().law_usual == 2.0 * law
        assert changes.mechanisms is not usual
    assert numbers().law_usual == law
    assert changes.mechanisms is usual
    gain = faults(1000.0, 10.0, 0.1)[0]
    assert scaled(gain, 0.5).strengths[0].scale == 0.5 * gain.strengths[0].scale


def test_an_answer_that_turns_with_the_priors_is_counted() -> None:
    rows = [
        {"dataset": "d", "variant": name, "verdict": verdict, "probabilities": {"none": p, "a": 1.0 - p}}
        for name, verdict, p in (("as they are", "none", 0.95), ("D halved", "cause", 0.05), ("D doubled", "none", 0.97))
    ]
    by_variant = summary(rows)["by_variant"]
    assert by_variant["D halved"]["verdict_differs"] == by_variant["D halved"]["likeliest_differs"] == 1.0
    assert by_variant["D halved"]["largest_move"] == pytest.approx(0.9)
    assert by_variant["D doubled"]["verdict_differs"] == 0.0
