"""The default search reaches what the truth explains, and what is said of its result."""

from dataclasses import replace

import numpy as np
import pytest

from benchmarks.identify import records_of
from twintube.dampers import load
from twintube.data import LoadedDataset
from twintube.fitting.parameters import DEGRADATION
from twintube.identification import Identification, Objective, Result, judgement, next_step
from twintube.identification.together import Scale, floor, together
from twintube.identification.uncertainty import Estimate
from twintube.identification.validation import Validated


@pytest.fixture(scope="module")
def objective() -> Objective:
    damper = load("SA8", as_published=True)
    return Objective(damper, DEGRADATION, records_of(damper, (0.262, 0.524, 1.048), 0.01), with_work=True)


def truth(objective: Objective) -> np.ndarray:
    return np.array([getattr(objective.given.parameters, name) for name in DEGRADATION])


def test_the_search_reaches_the_error_of_the_truth(objective: Objective) -> None:
    best = together(objective, (40, 50), seed=5)
    assert best.error <= float(objective(truth(objective)[None])[0])
    assert np.all(np.diff(best.trace) <= 0.0)
    assert best.error == pytest.approx(float(objective(best.x[None])[0]))


def test_least_squares_never_ends_above_its_start(objective: Objective) -> None:
    scale = Scale(objective)
    for u in np.random.default_rng(1).random((2, len(DEGRADATION))):
        x = scale.natural(u)
        assert scale.cube(x) == pytest.approx(u)
        end, error, used = floor(objective, x)
        assert error <= float(objective(x[None])[0])
        assert ((end >= objective.bounds[:, 0]) & (end <= objective.bounds[:, 1])).all()
        assert used > len(DEGRADATION)


FULL = Validated("full", "harmonic", 1.0, True, "fit", 0.5, 10.0, 500.0, 900.0, (9.0, 9.0), (9.0, 9.0))
LESS = replace(FULL, name="less", oil_level=0.6, split="heldout", top_speed=1.0, force_rmse_full=200.0)


def result(*rows: Validated, offset: float = 0.0, blind: bool = False) -> Result:
    damper = load("SA8")
    estimate = Estimate("X_Re", 0.5, 0.0 if blind else 0.49, 0.51 + 0.49 * blind, (0.0, 1.0))
    step: list = [None] if any(row.oil_level < 1.0 for row in rows) else []
    return Result(
        LoadedDataset("Bench", damper, [], []), [], Identification(damper, step, [estimate], [], offset, []), list(rows), []
    )  # fmt: skip


@pytest.mark.parametrize(
    ("error", "word"), [(10.0, "Usable for oil"), (120.0, "Rough, for a trend only, for oil"), (210.0, "Not usable for oil")]
)
def test_a_set_is_judged_by_the_effect_that_it_is_to_tell(error: float, word: str) -> None:
    sentences = judgement(result(FULL, replace(LESS, force_rmse=error)))
    assert sentences[0].startswith("Usable for the full damper up to 0.5 m/s: error 10.0 N of 500 N")
    assert sentences[1].startswith(word)
    assert "down to 60% up to 1 m/s" in sentences[1]
    assert "1 record that was not fitted" in sentences[1]
    assert ("2 % of the oil" in sentences[1]) == (error == 10.0)  # 40 % x 10 N of 200 N


@pytest.mark.parametrize(
    ("found", "step"),
    [
        (result(FULL, replace(LESS, force_rmse=150.0)), "look at less in out/report.html"),
        (result(replace(FULL, split="heldout"), offset=12.0), "zero of 12.0 N"),
        (result(FULL), "measure five velocities or more"),
        (result(replace(FULL, split="heldout")), "for oil loss, measure"),
        (result(FULL, LESS, blind=True), "for what is not determined"),
        (result(FULL, LESS), "twintube diagnose then looks"),
    ],
)
def test_the_next_step_is_the_most_important_one(found: Result, step: str) -> None:
    assert step in next_step(found, "out")
