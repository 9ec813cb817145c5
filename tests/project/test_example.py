"""The example dataset: small, without error, copied as it is, and its cause is named."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from twintube.cli import app
from twintube.cli.dataset import EXAMPLE
from twintube.data import check_dataset

STORED = Path(__file__).parents[2] / "src" / "twintube" / "examples" / EXAMPLE
COOLING = 38.9  # [s] time constant of its hidden heat balance
RUNNER = CliRunner()


def test_it_is_small_and_without_error() -> None:
    assert sum(path.stat().st_size for path in STORED.iterdir()) <= 300_000
    dataset = check_dataset(STORED)
    assert not dataset.errors
    assert len(dataset.records) == 7
    assert {finding.severity for finding in dataset.findings} <= {"warning"}


def test_it_is_copied_and_nothing_overwritten(tmp_path: Path) -> None:
    folder = tmp_path / "my_example"
    run = RUNNER.invoke(app, ["example", str(folder)])
    assert run.exit_code == 0, run.output
    assert {path.name for path in folder.iterdir()} == {path.name for path in STORED.iterdir()}
    again = RUNNER.invoke(app, ["example", str(folder)])
    assert again.exit_code == 2
    assert again.stderr.count("\n") == 1
    assert "nothing is overwritten" in again.stderr


@pytest.mark.slow
def test_the_diagnosis_finds_its_cause(tmp_path: Path) -> None:
    run = RUNNER.invoke(app, ["diagnose", str(STORED), "--output", str(tmp_path)])
    assert run.exit_code == 0, run.output
    answer = json.loads((tmp_path / "diagnosis.json").read_text(encoding="utf-8"))
    assert answer["verdict"] == "cause"
    (cause,) = answer["causes"]
    assert cause["effect"] == "oil_temperature"
    assert cause["gain"]["heldout_interval"][0] > 0.9
    low, high = cause["parameters"]["cooling_time"]["interval"]
    assert low < COOLING < high
