"""What has happened since a reference is found in a damper that is off its parameter set; effects are in test_each_effect.py."""

import json
from dataclasses import replace
from pathlib import Path

import pytest
from typer.testing import CliRunner

from tests.diagnosis import small
from tests.diagnosis.specimen import own_law
from twintube.cli import app
from twintube.dampers import load
from twintube.data import LoadedDataset
from twintube.diagnosis import answer
from twintube.diagnosis.changes import priors
from twintube.report.diagnosis.changes import lines

SPEEDS = (0.3, 0.6)  # [m/s]


def test_oil_and_gas_lost_since_is_another_state_than_stated() -> None:
    records = []
    for i, (level, name) in enumerate([(small.INTACT, "before")] * 2 + [(small.DEGRADED, "after")] * 2):
        run = small.run(SPEEDS[i % 2], level)
        stated = {"oil_level": 1.0, "gas_preload": True, "reference": name == "before", "state": name}
        records.append(replace(small.record(run, own_law(run), seed=i), name=f"{name}_{i}", **stated))
    data = LoadedDataset("small", load("SA8", as_published=True), records, [])
    found = answer(data)
    assert found.verdict == "state"
    (state,) = found.states
    low, high = state.posterior.interval()
    assert low <= small.DEGRADED <= high
    assert state.posterior.gas_lost > 0.95
    assert "The file says otherwise" in lines(found)[0]


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
    """A moved zero: the page and the JSON tell its size, and that it was none of the damper."""
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
    (cause,) = content["causes"]
    assert cause["parameters"]["force_offset"]["value"] == pytest.approx(-60.0, abs=10.0)
    assert cause["gain"]["heldout"] > 0.5
    page = (tmp_path / "out/report.html").read_text(encoding="utf-8")
    assert "Changed since the reference: zero of the load cell" in page
    refused = CliRunner().invoke(app, ["diagnose", str(folder), "--output", str(tmp_path / "b"), "--tolerance", "3%"])
    assert refused.exit_code == 2
    assert "--tolerance" in refused.output
