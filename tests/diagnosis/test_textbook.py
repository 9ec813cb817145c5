"""Causes are named in formulations that are neither the effects' nor the blind trials', and in records sampled at points."""

from pathlib import Path

import pytest

from tests.diagnosis import textbook
from twintube.diagnosis import diagnose
from twintube.lab.blind_trials.trials import FAULTS


@pytest.mark.slow
@pytest.mark.parametrize("kind", textbook.FORMULAS)
def test_a_textbook_formula_is_named(kind: str, tmp_path: Path) -> None:
    answer = diagnose(textbook.write(kind, tmp_path))
    if kind == "none":
        assert answer.verdict == "none"
        return
    assert answer.verdict == ("measurement_fault" if kind in FAULTS else "cause")
    assert [cause.effect for cause in answer.causes] == [kind]
    # The lag goes from sample to sample, which are up to six of its time constants apart.
    assert answer.causes[0].gain.heldout > (0.8 if kind == "fluid_lag" else 0.9)
