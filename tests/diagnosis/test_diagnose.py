"""Hidden causes are named, nothing is named where nothing is hidden, and bad input gets a clear answer."""

import json
import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from typer.testing import CliRunner

from tests.diagnosis import small
from twintube.arrays import Array
from twintube.cli import app
from twintube.dampers import load
from twintube.dampers.freed_gas import as_published
from twintube.data import Record
from twintube.diagnosis import Diagnosis, diagnose, engine
from twintube.diagnosis.engine import contradicted, says_more, split
from twintube.diagnosis.fits.candidates import candidates
from twintube.diagnosis.fits.fit import Free, Problem
from twintube.diagnosis.measurement.edges import with_edges, with_noise
from twintube.diagnosis.measurement.zeros import zero_drift
from twintube.diagnosis.records.prepare import prepare
from twintube.diagnosis.result import Estimate, RecordResult
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.verdict.where import maps, structured
from twintube.engine.simulate import InputError
from twintube.lab.blind_trials.trials import Trial, dataset, trial, write

BLOCKS = (0.131, 0.262, 0.524, 0.786, 1.048)


@pytest.fixture(scope="module")
def nothing() -> Problem:
    """Records of another scheme, with nothing hidden in them."""
    data = dataset(trial("none", 2001, blocks=(0.262, 0.524, 1.048)))
    return Problem(as_published(data.damper), prepare(data))


@pytest.fixture(scope="module")
def good() -> list[Record]:
    return small.records()


def hidden(kind: str) -> Trial:
    return trial(kind, 2001, blocks=BLOCKS)


def answered(kind: str, folder: Path) -> Diagnosis:
    return diagnose(write(hidden(kind), folder))


def worn(r: small.Run) -> np.ndarray:
    return r.force - np.where(r.velocity > 0, 0.1, 0.06) * r.fluid


def test_the_model_is_at_the_noise_where_nothing_is_hidden(nothing: Problem) -> None:
    """Another scheme made the records: sampling, thinning and the model's steps cost less than the noise."""
    problem, _ = zero_drift(with_edges(with_noise(nothing)))
    fit = problem.fit([Free("force_offset", 0.0, -50.0, 50.0)])
    assert np.median(fit.misfit) < 1.5
    assert fit.misfit.max() < 4.0


def test_structure_is_more_than_white_noise_with_the_stated_false_alarms(nothing: Problem) -> None:
    rng = np.random.default_rng(3)

    def results(size: float) -> list[RecordResult]:
        several = []
        for record in nothing.records:
            zero = np.zeros(len(record.time))
            wave = size * np.sin(np.linspace(0.0, 20.0, len(zero)))
            noisy = wave + rng.standard_normal(len(zero))
            several.append(RecordResult(record, "fit", noisy, zero, zero, zero, np.ones(len(zero))))
        return several

    assert sum(bool(structured(results(0.0), "base")) for _ in range(200)) <= 8
    assert len(structured(results(2.0), "base")) == len(nothing.records)


def test_intervals_that_are_left_out_are_no_place_where_the_model_is_wrong(nothing: Problem) -> None:
    """Such as those beyond the limit of a load cell: they are neither in the maps nor in the structure."""
    record = nothing.records[0]
    zero = np.zeros(len(record.time))
    beyond = record.velocity > 0.5 * record.velocity.max()
    force = np.where(beyond, -1000.0, np.random.default_rng(5).standard_normal(len(zero)))
    results = {out: RecordResult(record, "fit", force, zero, zero, zero, np.where(beyond & out, 0.0, 1.0)) for out in (0, 1)}
    worst = {out: max(float(np.nanmax(m.base)) for m in maps([r])) for out, r in results.items()}
    assert worst[0] > 500.0 and worst[1] < 10.0
    assert structured([results[0]], "base") and not structured([results[1]], "base")


def test_fit_recovers_a_parameter(nothing: Problem) -> None:
    free = [Free("X_Co2", 0.85, 0.0, 1.0), Free("force_offset", 0.0, -50.0, 50.0)]
    assert nothing.fit(free).values["X_Co2"] == pytest.approx(nothing.given.parameters.X_Co2, abs=0.01)


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


def test_turned_sign_is_named_by_the_command_and_nothing_else(tmp_path: Path) -> None:
    records = small.records(speeds=(0.2, 0.4, 0.8), levels=(small.INTACT, small.DEGRADED))
    folder = small.write([replace(r, force=-r.force) for r in records], tmp_path / "data")
    result = CliRunner().invoke(app, ["diagnose", str(folder), "--output", str(tmp_path / "out")])
    assert result.exit_code == 0, result.output
    answer = json.loads((tmp_path / "out" / "diagnosis.json").read_text())
    assert answer["verdict"] == "measurement_fault"
    assert [cause["effect"] for cause in answer["causes"]] == ["sign_flip"]
    assert 0.9 < answer["causes"][0]["gain"]["heldout"] <= 1.0
    assert "Nothing is missing" in answer["sentence"]
    assert sum(answer["probabilities"].values()) == pytest.approx(1.0)
    assert answer["error"]["noise_floor"]["force_rmse_N"] <= answer["error"]["extended"]["force_rmse_N"]
    assert not (tmp_path / "out" / "extended.toml").exists()  # the damper is as given
    assert "sign" in (tmp_path / "out" / "report.html").read_text()


def test_a_record_of_another_damper_is_left_out_and_shown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engine, "candidates", lambda problem: [c for c in candidates(problem) if c.fault])
    records = small.records(speeds=(0.1, 0.3, 0.6, 1.0, 1.3))
    records[2] = replace(small.record(small.run(0.6, damper=load("SA7", as_published=True))), name="stray", file="stray.csv")
    folder = small.write(records, tmp_path / "data")
    result = CliRunner().invoke(app, ["diagnose", str(folder), "--output", str(tmp_path / "out")])
    assert result.exit_code == 0, result.output
    answer = json.loads((tmp_path / "out" / "diagnosis.json").read_text())
    assert [cause["effect"] for cause in answer["causes"]] == ["odd_record"]
    assert "Without it: Nothing is missing" in answer["sentence"]
    (left,) = answer["left_out"]
    assert left["record"] == "stray" and left["base_rmse_N"] > 10.0 * left["noise_N"]
    assert f"error {left['base_rmse_N']:.0f} N" in answer["sentence"]
    assert "stray" not in [r["record"] for r in answer["records"]]
    page = (tmp_path / "out" / "report.html").read_text()
    assert "Record stray (100 % oil, 0.6 m/s; left out)" in page
    assert re.search(r"<td[^>]*>stray</td><td[^>]*>left out</td>", page)


def test_records_of_a_single_velocity_are_split_and_judged(tmp_path: Path) -> None:
    stop = lambda r: r.force + 1.2e5 * np.maximum(r.stroke - 0.8 * small.AMPLITUDE, 0.0)  # noqa: E731
    runs = [small.run(0.5, turns=12), small.run(0.5, small.DEGRADED, slow=2)]
    answer = diagnose(small.write([small.record(r, stop(r), seed=i) for i, r in enumerate(runs)], tmp_path))
    assert (answer.verdict, [cause.effect for cause in answer.causes]) == ("cause", ["end_stop"])
    assert any("all records have one velocity" in remark for remark in answer.remarks)
    assert {r.split for r in answer.records} == {"heldout"}
    assert answer.causes[0].gain.heldout > 0.9
    assert answer.errors["heldout"]["extended"].force_rmse_N < answer.errors["heldout"]["base"].force_rmse_N
    assert answer.extended.sources["end_stop"] == "added by diagnosis"


def test_every_second_tenth_of_a_single_velocity_is_held_out_in_turn(good: list[Record]) -> None:
    record = small.problem(good[1:2]).records[0]
    folds, remarks = split("x", [record])
    assert len(folds) == 2 and "one velocity" in remarks[0]
    (fitted,), (held,) = folds[0]
    assert not np.any(fitted.judged & held.judged)
    assert np.array_equal(fitted.judged | held.judged, record.judged)
    assert 0.4 < fitted.judged.sum() / record.judged.sum() < 0.6
    (other,) = folds[1][0]
    assert np.array_equal(other.judged, held.judged)


def test_a_tolerance_turns_a_small_deviation_into_noise() -> None:
    records = small.problem(small.records(lambda r: 1.03 * r.force)).records
    strict, tolerant = (Problem(load("SA8", as_published=True), records, tolerance=x) for x in (0.0, 0.05))
    assert strict.misfits(strict.residual({})).min() > 10
    assert tolerant.misfits(tolerant.residual({})).max() < 1.0
    kept = tolerant.with_records(records[:2]).with_drift(1.0)
    assert kept.tolerance == tolerant.tolerance


@pytest.mark.slow
def test_a_good_damper_is_called_good_within_a_tolerance(tmp_path: Path) -> None:
    folder = small.write(small.records(worn, levels=(small.INTACT, small.DEGRADED)), tmp_path)
    assert diagnose(folder).verdict == "cause"
    answer = diagnose(folder, tolerance=0.15)
    assert (answer.verdict, answer.causes, answer.tolerance) == ("none", [], 0.15)


@pytest.mark.parametrize(
    ("keep", "entry", "message"),
    [
        (slice(4), {"split": "heldout"}, "4 of 4 records are held out"),
        (slice(1), {"measurement": "quasi-static"}, "only quasi-static records"),
    ],
)
def test_datasets_that_allow_no_judgement(
    good: list[Record], tmp_path: Path, keep: slice, entry: dict[str, object], message: str
) -> None:
    with pytest.raises(InputError, match=message):
        diagnose(small.write(good[keep], tmp_path, **{r.name: entry for r in good}))


def test_a_single_velocity_that_is_too_short_is_refused(good: list[Record]) -> None:
    (record,) = small.problem(good[1:2]).records
    with pytest.raises(InputError, match="too short to be split"):
        split("x", [replace(record, judged=record.judged & (record.time < 0.05 * record.time[-1]))])


@pytest.mark.parametrize("tolerance", [-0.01, 1.01 * RULES.most_tolerance, float("nan")])
def test_a_tolerance_out_of_range_is_refused(tmp_path: Path, tolerance: float) -> None:
    with pytest.raises(InputError, match=r"tolerance = .*must be from 0 to 0\.2"):
        diagnose(tmp_path, tolerance=tolerance)


def test_empty_dataset_and_unknown_damper(tmp_path: Path) -> None:
    (tmp_path / "dataset.toml").write_text('title = "x"\ndamper = "SA9"\n')
    result = CliRunner().invoke(app, ["diagnose", str(tmp_path), "--output", str(tmp_path / "out")])
    assert result.exit_code == 2
    assert "no [[record]]" in result.output
    assert "SA9" in result.output
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_nothing_hidden_is_nothing_named(tmp_path: Path) -> None:
    answer = answered("none", tmp_path)
    assert (answer.verdict, answer.causes) == ("none", [])
    assert len(answer.structure["base"]) <= 1
    assert answer.extended.parameters == load("SA8", as_published=True).parameters


def test_spikes_in_several_records_that_nothing_explains_are_left_out(tmp_path: Path, good: list[Record]) -> None:
    spoilt = []
    for i, record in enumerate(good):
        force = record.force.copy()
        force[len(force) // 2 + 37 * i] += 2000.0
        spoilt.append(replace(record, force=force))
    answer = diagnose(small.write(spoilt, tmp_path))
    assert answer.verdict == "none" and answer.causes == []


@pytest.mark.slow
def test_valve_wear_is_named_and_gains_on_held_out_records(tmp_path: Path) -> None:
    answer = answered("valve_wear", tmp_path)
    assert (answer.verdict, answer.causes[0].effect) == ("cause", "valve_wear")
    assert answer.causes[0].gain.heldout > 0.8
    assert len(answer.structure["extended"]) < len(answer.structure["base"]) / 2
    assert answer.errors["heldout"]["extended"].force_rmse_N < answer.errors["heldout"]["base"].force_rmse_N
    assert answer.extended.parameters.wear_re != 0.0  # type: ignore[attr-defined]
    assert answer.extended.sources["valve_wear"] == "added by diagnosis"


@pytest.mark.slow
def test_what_no_effect_makes_is_unexplained_and_described(tmp_path: Path) -> None:
    answer = answered("backlash", tmp_path)
    assert (answer.verdict, answer.causes) == ("unexplained", [])
    assert "play" in answer.sentence
    assert answer.extended.parameters == load("SA8", as_published=True).parameters


@pytest.mark.slow
def test_what_the_records_cannot_tell_apart_is_ambiguous(tmp_path: Path) -> None:
    """Without the intact state, which has its preload, a zero of the load cell is the force of a residual pressure."""
    whole = hidden("force_offset")
    answer = diagnose(write(replace(whole, records=[r for r in whole.records if not r.gas_preload]), tmp_path))
    assert answer.verdict == "ambiguous"
    named = {answer.causes[0].effect, *(other.effect for other in answer.alternatives)}
    assert {"gas_spring", "force_offset"} <= named
    first = answer.causes[0].gain.heldout
    assert all(other.heldout_gain == pytest.approx(first, abs=0.05) for other in answer.alternatives)
    assert answer.next_measurements
    assert any("no record of the intact damper" in remark for remark in answer.remarks)


@pytest.mark.slow
def test_zero_of_the_load_cell_is_a_fault_of_the_measurement(tmp_path: Path) -> None:
    answer = answered("force_offset", tmp_path)
    assert (answer.verdict, answer.causes[0].effect) == ("measurement_fault", "force_offset")
    value = answer.causes[0].parameters["force_offset"]
    assert value.low <= value.value <= value.high


def test_records_in_which_an_answer_leaves_more_than_noise(good: list[Record]) -> None:
    """One of them is wrong by far in many intervals, one in two: the first is looked at once more, with others."""
    problem = with_edges(with_noise(small.problem(good)))
    forces = np.split(problem.forces({}), problem.starts[1:-1])
    weights = np.split(problem.weight, problem.starts[1:-1])

    def left(wrong: dict[int, int], verdict: str = "cause") -> Diagnosis:
        rows = []
        for i, (record, force, weight) in enumerate(zip(problem.records, forces, weights, strict=True)):
            error = np.zeros(len(force))
            error[np.flatnonzero(record.judged)[: wrong.get(i, 0)]] = 1e3
            models = (force + error, force, force) if verdict == "recalibrate" else (force, force, force + error)
            rows.append(RecordResult(record, "heldout", force, *models, weight))
        return cast(Diagnosis, SimpleNamespace(records=rows, verdict=verdict))

    assert contradicted(problem, left({})) is None
    assert contradicted(problem, left({1: RULES.few_intervals})) is None
    some = contradicted(problem, left({1: 40}))
    assert some is not None and some.records[0].name == problem.records[1].name
    # Other degradation parameters leave nothing there, but hardly any other record asks for them.
    assert contradicted(problem, left({1: 40}, "recalibrate")) is not None
    assert contradicted(problem, left(dict.fromkeys(range(len(good)), 40))) is None  # all: not a matter of few records


def answer_of(names: tuple[str, ...], error: Array, records: int = 2) -> Diagnosis:
    """An answer that names these and leaves errors (n,) in each of its records, of errors of ten times the noise."""
    size, base = len(error), np.full(len(error), 10.0)
    rows = [
        SimpleNamespace(
            record=SimpleNamespace(name=f"{i}"), measured=np.zeros(size), base=base, extended=error, weight=np.ones(size)
        )
        for i in range(records)
    ]
    verdict = "recalibrate" if "recalibrate" in names else "cause"
    causes = [SimpleNamespace(effect=name) for name in names if name != "recalibrate"]
    return cast(Diagnosis, SimpleNamespace(verdict=verdict, causes=causes, records=rows))


@pytest.mark.parametrize(
    ("before", "after", "left", "more"),
    [
        ((), ("gas_redissolution",), 0.9, True),
        (("valve_wear",), ("end_stop", "valve_wear"), 0.9, True),
        (("valve_wear",), ("end_stop",), 0.9, False),
        (("valve_wear",), ("end_stop",), 0.1, True),
        (("valve_wear",), ("fluid_lag",), 0.1, False),
        ((), (), 0.1, False),
        ((), ("fluid_lag",), 0.1, False),
        ((), ("recalibrate",), 0.9, True),
        (("valve_wear",), ("recalibrate",), 0.9, False),
        (("valve_wear",), ("valve_wear", "channel_delay"), 0.1, False),
        (("recalibrate",), ("gas_redissolution",), 1.0, True),
        (("recalibrate",), ("gas_redissolution",), 1.5, False),
        (("recalibrate",), ("recalibrate",), 0.5, False),
    ],
)
def test_an_answer_within_records_must_name_more_or_leave_far_less(
    before: tuple[str, ...], after: tuple[str, ...], left: float, more: bool
) -> None:
    ripple = np.array([1.0, -1.0] * 5)
    assert says_more(answer_of(before, ripple), answer_of(after, left * ripple)) == more


def test_what_makes_the_force_late_is_seen_within_several_records_that_are_far_off() -> None:
    far = np.resize([5.0, -5.0], 10)
    for records, left, more in ((2, 0.1, True), (2, 0.6, False), (1, 0.1, False)):
        assert says_more(answer_of((), far, records), answer_of(("fluid_lag",), left * far, records)) == more


def test_other_degradation_parameters_are_not_known_from_a_single_record() -> None:
    ripple = np.resize([1.0, -1.0], 10)
    for records, more in ((1, False), (2, True)):
        assert says_more(answer_of((), ripple, records), answer_of(("recalibrate",), 0.1 * ripple, records)) == more


def test_within_records_the_zero_of_a_single_record_names_nothing() -> None:
    zero = np.ones(10)
    assert not says_more(answer_of((), zero), answer_of(("gas_spring",), 0.1 * zero))
