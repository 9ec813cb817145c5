"""The example dataset: what the package carries is what the laboratory computes, and its cause is named."""

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from twintube.cli import app
from twintube.cli.dataset import EXAMPLE
from twintube.data import check_dataset, load_dataset
from worlds import example

STORED = Path(__file__).parents[2] / "src" / "twintube" / "examples" / EXAMPLE
RUNNER = CliRunner()


def test_it_is_small_and_without_error() -> None:
    assert sum(path.stat().st_size for path in STORED.iterdir()) <= 300_000
    dataset = check_dataset(STORED)
    assert not dataset.errors
    assert len(dataset.records) == 7
    assert {finding.severity for finding in dataset.findings} <= {"warning"}


def test_the_laboratory_computes_it_again() -> None:
    stored = {record.name: record for record in load_dataset(STORED).records}
    trial = example.example()
    assert len(trial.records) == len(stored)
    for record in trial.records:
        other = stored[record.file.removesuffix(".parquet")]
        assert (record.oil_level, record.gas_preload) == (other.oil_level, other.gas_preload)
        # As rounded in the files, by half a digit; another C library may turn a digit.
        np.testing.assert_allclose(other.time, record.time, atol=0.51e-3)
        np.testing.assert_allclose(other.stroke, record.stroke, atol=6e-6)
        np.testing.assert_allclose(other.force, record.force, atol=0.6)


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
    assert cause["effect"] == example.KIND
    assert cause["gain"]["heldout_interval"][0] > 0.9
    low, high = cause["parameters"]["cooling_time"]["interval"]
    assert low < example.example().truth["cooling_s"] < high
