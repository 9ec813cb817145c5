"""Causes are named in formulations that are neither the effects' nor the blind trials', and in records sampled at points."""

from pathlib import Path

import numpy as np
import pytest

from tests.diagnosis import textbook
from twintube.data import load_dataset
from twintube.diagnosis import diagnose
from twintube.diagnosis.fit import Problem
from twintube.diagnosis.prepare import prepare
from twintube.lab.blind_trials.trials import FAULTS

QUICK = ("none", "valve_wear")


@pytest.mark.parametrize("kind", [k if k in QUICK else pytest.param(k, marks=pytest.mark.slow) for k in textbook.FORMULAS])
def test_a_textbook_formula_is_named(kind: str, tmp_path: Path) -> None:
    answer = diagnose(textbook.write(kind, tmp_path))
    if kind == "none":
        assert answer.verdict == "none"
        return
    assert answer.verdict == ("measurement_fault" if kind in FAULTS else "cause")
    assert [cause.effect for cause in answer.causes] == [kind]
    assert answer.causes[0].gain.heldout > 0.9


def test_what_samples_miss_at_a_jump_is_known(tmp_path: Path) -> None:
    """The model is exactly right, and its force jumps between samples at the same place in every oscillation."""
    data = load_dataset(textbook.write("none", tmp_path, noise=0.0))
    records = prepare(data)
    problem = Problem(data.damper, records)
    errors = problem.errors({})
    jumped = 0
    for record, a, b in zip(records, problem.starts[:-1], problem.starts[1:], strict=True):
        missed = np.abs(errors[a + 1 : b]) > 0.01 * record.peak
        jumped += int(missed.sum())
        if missed.any():
            assert (np.abs(errors[a + 1 : b][missed]) < 1.5 * record.noise[1:][missed]).mean() > 0.9
    assert jumped > 100
