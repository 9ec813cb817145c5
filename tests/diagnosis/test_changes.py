"""What has happened since a reference is found in a damper that is off its parameter set; where nothing has, nothing is named."""

import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from tests.diagnosis import small
from tests.diagnosis.specimen import own_law
from twintube.cli import app
from twintube.common.arrays import Array
from twintube.dampers import load
from twintube.data import LoadedDataset
from twintube.diagnosis import Answer, answer
from twintube.diagnosis.changes import priors
from twintube.diagnosis.mechanisms import CATALOGUE
from twintube.report.diagnosis.changes import lines

Formula = Callable[[small.Run], Array]
SPEEDS = (0.3, 0.6)  # [m/s]


def before_and_after(change: Formula, *, later_level: float = small.INTACT) -> Answer:
    """The answer to two records as delivered and two after a change, all said to be full with preload."""
    records = []
    for i, (level, formula, name) in enumerate(
        [(small.INTACT, own_law, "before")] * 2 + [(later_level, lambda r: change(r) + own_law(r) - r.force, "after")] * 2
    ):
        run = small.run(SPEEDS[i % 2], level)
        seen = small.record(run, formula(run), seed=i)
        reference = name == "before"
        records.append(replace(
            seen, name=f"{name}_{i}", oil_level=1.0, gas_preload=True, reference=reference, state=name,
        ))  # fmt: skip
    return answer(LoadedDataset("small", load("SA8", as_published=True), records, []))


def test_nothing_has_changed() -> None:
    found = before_and_after(lambda r: r.force)
    assert found.verdict == "none"
    assert found.extended is None
    assert found.states[0].posterior.as_stated > 0.9


def test_a_moved_zero() -> None:
    """A fault: the answer tells its size, and that it was none of the damper."""
    found = before_and_after(lambda r: r.force - 60.0)
    assert found.verdict == "measurement_fault"
    assert [h.name for h in found.named] == ["force_offset"]
    assert found.cause is not None
    assert found.cause.values["force_offset"] == pytest.approx(-60.0, abs=10.0)
    assert found.to_dataframe()["probability"].idxmax() == "force_offset"
    assert re.fullmatch(r"<Answer about SA8 from 4 records: measurement_fault: force_offset \(\d+%\)>", repr(found))


@pytest.fixture(scope="module")
def worn() -> Answer:
    return before_and_after(lambda r: r.force - 0.15 * np.where(r.velocity > 0.0, r.fluid, 0.0))


def test_wear_is_found_and_extends_the_model(worn: Answer) -> None:
    assert "valve_wear" in {h.name for h in worn.named}
    assert worn.verdict in ("cause", "ambiguous")
    assert all(h.with_cause is None or h.with_cause < h.without for h in worn.held_out)
    if worn.verdict == "cause":
        assert worn.extended is not None
        assert worn.extended.parameters != worn.damper.parameters


def test_oil_and_gas_lost_since_is_another_state_than_stated() -> None:
    found = before_and_after(lambda r: r.force, later_level=small.DEGRADED)
    assert found.verdict == "state"
    (state,) = found.states
    low, high = state.posterior.interval()
    assert low <= small.DEGRADED <= high
    assert state.posterior.gas_lost > 0.95
    assert "The file says otherwise" in lines(found)[0]


def test_an_answer_does_not_contradict_its_numbers(worn: Answer) -> None:
    assert worn.changes is not None
    shares = [h.probability for h in worn.changes.hypotheses]
    assert shares == sorted(shares, reverse=True)
    assert sum(shares) == pytest.approx(1.0)
    assert sum(h.probability for h in worn.named) >= 0.9
    # Each is its prior times its evidence.
    several = worn.changes.hypotheses
    prior = priors(CATALOGUE)
    own = np.array([prior(h.name) * np.exp(h.log_evidence) for h in several])
    assert own / own.sum() == pytest.approx([h.probability for h in several], abs=1e-6)


def test_prior_probabilities_sum_to_one() -> None:
    prior = priors(["tared_cell", "a", "b"])
    assert sum(map(prior, ["none", "tared_cell", "unknown", "a", "b", "a+b"])) == pytest.approx(1.0)
    assert prior("state") == prior("none")  # that of another fill stands with the fill


def test_a_turned_sign_beside_a_reference_is_refused(tmp_path: Path) -> None:
    """Nothing is put right in silence where the bench is not looked at."""
    right, turned = (
        replace(small.record(small.run(0.6, small.INTACT), seed=i), name=n, file=f"{n}.csv") for i, n in enumerate("ab")
    )
    folder = small.write(
        [right, replace(turned, force=-turned.force)], tmp_path / "bench", **{right.name: {"reference": True}}
    )
    done = CliRunner().invoke(app, ["diagnose", str(folder), "--output", str(tmp_path / "out")])
    assert done.exit_code == 2
    assert not (tmp_path / "out" / "diagnosis.json").exists()


def test_command(tmp_path: Path) -> None:
    """The page and the JSON; an option that is gone is refused."""
    runs = [small.run(speed) for speed in SPEEDS]
    before = [small.record(r, own_law(r), seed=i) for i, r in enumerate(runs)]
    after = [
        replace(small.record(r, own_law(r) - 60.0, seed=9 + i), name=f"after_{i}", file=f"after_{i}.csv")
        for i, r in enumerate(runs)
    ]
    folder = small.write([*before, *after], tmp_path / "bench", **{r.name: {"reference": True} for r in before})
    done = CliRunner().invoke(app, ["diagnose", str(folder), "--output", str(tmp_path / "out")])
    assert done.exit_code == 0, done.output
    assert "Changed since the reference: zero of the load cell" in done.output
    content = json.loads((tmp_path / "out/diagnosis.json").read_text())
    assert content["verdict"] == "measurement_fault"
    assert content["credible_set"] == ["force_offset"]
    assert sum(h["probability"] for h in content["hypotheses"]) == pytest.approx(1.0)
    assert content["causes"][0]["gain"]["heldout"] > 0.5
    page = (tmp_path / "out/report.html").read_text(encoding="utf-8")
    assert "Changed since the reference: zero of the load cell" in page
    refused = CliRunner().invoke(app, ["diagnose", str(folder), "--output", str(tmp_path / "b"), "--tolerance", "3%"])
    assert refused.exit_code == 2
    assert "--tolerance" in refused.output
