"""Hidden causes are named, nothing is named where nothing is hidden, and bad input gets a clear answer."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from twintube.cli import app
from twintube.dampers import load
from twintube.diagnosis import Diagnosis, diagnose
from twintube.diagnosis.fit import Free, Problem
from twintube.diagnosis.prepare import prepare
from twintube.diagnosis.result import Estimate, RecordResult
from twintube.diagnosis.where import structured
from twintube.diagnosis.zeros import zero_drift
from twintube.engine.simulate import InputError
from twintube.lab.blind_trials.trials import Trial, dataset, trial, write

BLOCKS = (0.131, 0.262, 0.524, 0.786, 1.048)


@pytest.fixture(scope="module")
def nothing() -> Trial:
    return trial("none", 2001, blocks=BLOCKS)


def answered(kind: str, folder: Path, seed: int = 2001) -> Diagnosis:
    return diagnose(write(trial(kind, seed, blocks=BLOCKS), folder))


def test_a_prepared_record_keeps_the_force_s_impulse_and_knows_its_noise(nothing: Trial) -> None:
    for prepared, record in zip(prepare(dataset(nothing)), nothing.records, strict=True):
        parts = np.diff(prepared.time) * prepared.measured()[1:]
        whole = np.interp(prepared.time[[0, -1]], prepared.dense_time, prepared.impulse)
        assert parts.sum() == pytest.approx(whole[1] - whole[0], rel=1e-9)
        assert len(prepared.time) < len(record.time)
        if record.measurement == "harmonic":
            per = len(record.time) / len(prepared.time)
            assert 0.3 < np.median(prepared.noise) / (record.noise_N / np.sqrt(per)) < 4.0


def test_the_model_is_at_the_noise_where_nothing_is_hidden(nothing: Trial) -> None:
    """Another scheme made the records: sampling, thinning and the model's steps cost less than the noise."""
    data = dataset(nothing)
    problem, _ = zero_drift(Problem(data.damper, prepare(data)))
    offset = Free("force_offset", 0.0, -50.0, 50.0)
    fit = problem.fit([offset])
    assert np.median(fit.misfit) < 1.5
    assert fit.misfit.max() < 4.0


def test_structure_is_more_than_white_noise_with_the_stated_false_alarms(nothing: Trial) -> None:
    rng = np.random.default_rng(3)
    records = prepare(dataset(nothing))

    def results(size: float) -> list[RecordResult]:
        several = []
        for record in records:
            zero = np.zeros(len(record.time))
            wave = size * np.sin(np.linspace(0.0, 20.0, len(zero)))
            several.append(RecordResult(record, "fit", wave + rng.standard_normal(len(zero)), zero, zero, zero))
        return several

    assert sum(bool(structured(results(0.0), "base")) for _ in range(200)) <= 8
    assert len(structured(results(1.0), "base")) == len(records)


def test_fit_recovers_a_parameter(nothing: Trial) -> None:
    data = dataset(nothing)
    problem = Problem(data.damper, prepare(data))
    free = [Free("X_Co2", 0.85, 0.0, 1.0), Free("force_offset", 0.0, -50.0, 50.0)]
    fit = problem.fit(free)
    assert fit.values["X_Co2"] == pytest.approx(data.damper.parameters.X_Co2, abs=0.01)


def test_nothing_hidden_is_nothing_named(nothing: Trial, tmp_path: Path) -> None:
    answer = diagnose(write(nothing, tmp_path))
    assert answer.verdict == "none"
    assert answer.causes == []
    assert len(answer.structure["base"]) <= 1
    assert answer.extended.parameters == load("SA8").parameters


def test_valve_wear_is_named_and_gains_on_held_out_records(tmp_path: Path) -> None:
    answer = answered("valve_wear", tmp_path)
    assert (answer.verdict, answer.causes[0].effect) == ("cause", "valve_wear")
    assert answer.causes[0].gain.heldout > 0.8
    assert len(answer.structure["extended"]) < len(answer.structure["base"]) / 2
    assert answer.errors["heldout"]["extended"].force_rmse_N < answer.errors["heldout"]["base"].force_rmse_N
    assert answer.extended.parameters.wear_re != 0.0  # type: ignore[attr-defined]
    assert answer.extended.sources["valve_wear"] == "added by diagnosis"


def test_values_at_the_end_of_their_range_and_undetermined_values_are_doubted() -> None:
    def share(value: float, width: float) -> str:
        return Estimate(value, value - width / 2, value + width / 2, "1", (0.0, 2.0), 0.0).doubt

    def change(value: float, width: float) -> str:
        return Estimate(value, value - width / 2, value + width / 2, "1", (-0.8, 1.0), 0.0).doubt

    assert share(1.9999, 0.1) == "at the end of its range, 0 to 2"
    assert change(-0.8, 0.1) == "at the end of its range, -0.8 to 1"
    assert share(0.5, 1.2) == "not determined by these records"
    assert share(0.0, 0.1) == share(0.5, 0.1) == change(0.2, 0.1) == ""
    assert Estimate(0.03, 0.0299, 0.03, "s", (-0.03, 0.03), 0.0).doubt == "at the end of its range, -0.03 to 0.03 s"


@pytest.mark.slow
def test_what_no_effect_makes_is_unexplained_and_described(tmp_path: Path) -> None:
    answer = answered("backlash", tmp_path)
    assert (answer.verdict, answer.causes) == ("unexplained", [])
    assert "play" in answer.sentence
    assert answer.extended.parameters == load("SA8").parameters


def test_what_the_records_cannot_tell_apart_is_ambiguous(tmp_path: Path) -> None:
    """Without the intact state, which has its preload, a zero of the load cell is the force of a residual pressure."""
    hidden = trial("force_offset", 2001, blocks=BLOCKS)
    records = [r for r in hidden.records if not r.gas_preload]
    answer = diagnose(write(replace(hidden, records=records), tmp_path))
    assert answer.verdict == "ambiguous"
    named = {answer.causes[0].effect, *(other.effect for other in answer.alternatives)}
    assert {"gas_spring", "force_offset"} <= named
    assert answer.next_measurements
    assert any("no record of the intact damper" in remark for remark in answer.remarks)


def test_zero_of_the_load_cell_is_a_fault_of_the_measurement(tmp_path: Path) -> None:
    answer = answered("force_offset", tmp_path)
    assert (answer.verdict, answer.causes[0].effect) == ("measurement_fault", "force_offset")
    value = answer.causes[0].parameters["force_offset"]
    assert value.low <= value.value <= value.high


def test_turned_sign_is_named_by_the_command(tmp_path: Path) -> None:
    folder = write(trial("sign_flip", 2001, blocks=BLOCKS[2:]), tmp_path / "data")
    result = CliRunner().invoke(app, ["diagnose", str(folder), "--output", str(tmp_path / "out")])
    assert result.exit_code == 0, result.output
    answer = json.loads((tmp_path / "out" / "diagnosis.json").read_text())
    assert answer["verdict"] == "measurement_fault"
    assert answer["causes"][0]["effect"] == "sign_flip"
    assert 0.9 < answer["causes"][0]["gain"]["heldout"] <= 1.0
    assert load(tmp_path / "out" / "extended.toml").name == "SA8"
    assert "sign" in (tmp_path / "out" / "report.html").read_text()


@pytest.mark.parametrize(
    ("keep", "split", "message"),
    [
        (1, "", "1 record, at least two"),
        (4, "heldout", "4 of 4 records are held out"),
        (2, "same", "all records have one velocity"),
    ],
)
def test_datasets_that_allow_no_judgement(nothing: Trial, tmp_path: Path, keep: int, split: str, message: str) -> None:
    records = [r for r in nothing.records if r.measurement == "harmonic"][:keep]
    if split == "same":
        records = [records[0], replace(records[0], file="again.parquet", force=records[0].force * 1.01)]
    folder = write(replace(nothing, records=records), tmp_path)
    if split == "heldout":
        toml = folder / "dataset.toml"
        toml.write_text(toml.read_text().replace("[[record]]\n", '[[record]]\nsplit = "heldout"\n'))
    with pytest.raises(InputError, match=message):
        diagnose(folder)


def test_empty_dataset_and_unknown_damper(tmp_path: Path) -> None:
    (tmp_path / "dataset.toml").write_text('title = "x"\ndamper = "SA9"\n')
    result = CliRunner().invoke(app, ["diagnose", str(tmp_path), "--output", str(tmp_path / "out")])
    assert result.exit_code == 2
    assert "no [[record]]" in result.output
    assert "SA9" in result.output
    assert not (tmp_path / "out").exists()
