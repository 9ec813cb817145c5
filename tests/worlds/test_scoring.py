"""Marks and figures of answers whose marks are known."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from worlds.__main__ import app
from worlds.scoring import Pair, Truth, read_pairs, score, tables
from worlds.scoring.answer import answer_of, contradictions, read_answer, smallest_set
from worlds.scoring.figures import by_chance, calibration_error, groups
from worlds.scoring.marks import (
    SUREST,
    accused,
    brier,
    holds,
    level_inside,
    level_log_score,
    level_narrow,
    log_score,
    missed,
    preload_right,
    right_alone,
    top_right,
    truth_probability,
    wrong_alone,
)

NOTHING = Truth("w", 1, "SA8", "none", ("none",), effect_over_noise=0.0)
HEAT = Truth("w", 1, "SA8", "effect", ("oil_temperature",), effect_over_noise=3.0)
SEAL = Truth("w", 1, "SA8", "outside", ("outside:seal_friction",), ("side_load_friction",), effect_over_noise=3.0)
BOTH = Truth("w", 1, "SA8", "effect", ("oil_temperature", "end_stop"), effect_over_noise=0.7)
FILL = Truth(
    "w",
    1,
    "SA8",
    "state",
    ("state",),
    ("none",),
    3.0,
    oil_level=0.6,
    gas_preload=False,
    stated_as_full=False,
    level_seen=True,
)


def says(verdict: str, probabilities: dict[str, float], causes: list[str] | None = None, **more: Any) -> dict[str, Any]:
    """A diagnosis.json of the present form."""
    return {
        "verdict": verdict, "hypotheses": [{"name": n, "kind": "", "probability": p} for n, p in probabilities.items()],
        "credible_set": list(smallest_set(probabilities)), "causes": [{"effect": name} for name in causes or []],
        "seconds": 2.0, **more,
    }  # fmt: skip


def pair(truth: Truth, content: dict[str, Any], name: str = "d") -> Pair:
    return Pair(name, truth, answer_of(content))


def filled(value: float, low: float, high: float, gas_lost: float, **grid: Any) -> dict[str, Any]:
    level = {"value": value, "interval": [low, high], **grid}
    return says("state", {"state": 0.99, "none": 0.01}, state=[{"records": [], "oil_level": level, "gas_lost": gas_lost}])


def test_the_smallest_set_holds_nine_tenths() -> None:
    assert smallest_set({"a": 0.3, "b": 0.61, "c": 0.09}) == ("b", "a")
    assert smallest_set({"a": 0.1, "b": 0.9}) == ("b",)
    assert smallest_set({}) == ()


@pytest.mark.parametrize(
    ("truth", "content", "marks"),
    [  # in the set, right alone, wrong alone, none
        (HEAT, says("cause", {"oil_temperature": 0.95, "none": 0.05}, ["oil_temperature"]), (1, 1, 0, 0)),
        (HEAT, says("cause", {"end_stop": 0.95, "none": 0.05}, ["end_stop"]), (0, 0, 1, 0)),
        (HEAT, says("ambiguous", {"end_stop": 0.5, "oil_temperature": 0.5}), (1, 0, 0, 0)),
        (HEAT, says("none", {"none": 0.95, "oil_temperature": 0.05}), (0, 0, 0, 1)),
        (HEAT, says("tolerance", {"none": 0.95, "oil_temperature": 0.05}), (0, 0, 0, 1)),
        (HEAT, says("unexplained", {"unknown": 1.0}), (0, 0, 0, 0)),
        (HEAT, says("recalibrate", {"recalibrate": 1.0}), (0, 0, 1, 0)),
        (HEAT, says("state", {"state": 1.0}), (0, 0, 1, 0)),
        (SEAL, says("unexplained", {"unknown": 1.0}), (1, 1, 0, 0)),
        (SEAL, says("cause", {"side_load_friction": 1.0}, ["side_load_friction"]), (1, 1, 0, 0)),
        (SEAL, says("measurement_fault", {"force_gain": 1.0}, ["force_gain"]), (0, 0, 1, 0)),
        (BOTH, says("cause", {"oil_temperature+end_stop": 1.0}, ["end_stop", "oil_temperature"]), (1, 1, 0, 0)),
        (BOTH, says("cause", {"end_stop+oil_temperature": 1.0}), (1, 1, 0, 0)),
        (BOTH, says("cause", {"end_stop": 1.0}, ["end_stop"]), (0, 0, 0, 0)),
        (BOTH, says("cause", {"end_stop+fluid_lag": 1.0}, ["end_stop", "fluid_lag"]), (0, 0, 1, 0)),
        (BOTH, says("ambiguous", {"end_stop": 0.5, "oil_temperature": 0.5}), (1, 0, 0, 0)),
    ],
)
def test_marks_of_a_verdict(truth: Truth, content: dict[str, Any], marks: tuple[int, ...]) -> None:
    found = pair(truth, content)
    assert (holds(found.answer.credible, found), right_alone(found), wrong_alone(found), missed(found)) == marks


@pytest.mark.parametrize(
    ("content", "heard"),
    [
        (says("none", {"none": 1.0}), False),
        (says("cause", {"end_stop": 1.0}, ["end_stop"]), True),
        (says("state", {"state": 1.0}), True),
        (says("ambiguous", {"end_stop": 0.5, "fluid_lag": 0.5}), True),
        (says("ambiguous", {"end_stop": 0.5, "none": 0.5}), False),
        (says("unexplained", {"unknown": 1.0}), False),
    ],
)
def test_a_good_damper_is_accused_by_a_name_without_none(content: dict[str, Any], heard: bool) -> None:
    assert accused(pair(NOTHING, content)) == heard


def test_scores_of_probabilities() -> None:
    found = pair(HEAT, says("ambiguous", {"oil_temperature": 0.6, "end_stop": 0.3, "none": 0.1}))
    assert log_score(found) == pytest.approx(math.log(0.6))
    assert brier(found) == pytest.approx(0.4**2 + 0.3**2 + 0.1**2)
    sure = pair(HEAT, says("cause", {"end_stop": 1.0}, ["end_stop"]))
    assert log_score(sure) == math.log(SUREST)
    assert brier(sure) == 2.0
    assert not top_right(sure)
    both = pair(BOTH, says("ambiguous", {"oil_temperature+end_stop": 0.5, "end_stop": 0.2, "none": 0.3}))
    assert truth_probability(both) == pytest.approx(0.7)


def test_marks_of_a_fill() -> None:
    good, bad = pair(FILL, filled(0.62, 0.57, 0.66, 0.9)), pair(FILL, filled(0.9, 0.8, 1.0, 0.2))
    assert (preload_right(good), level_inside(good), level_narrow(good)) == (True, True, True)
    assert (preload_right(bad), level_inside(bad), level_narrow(bad)) == (False, False, False)
    silent = pair(FILL, says("none", {"none": 1.0}))
    assert (preload_right(silent), level_inside(silent), level_narrow(silent)) == (False, False, False)


def test_silence_about_a_stated_fill_says_that_it_is_right() -> None:
    full = Truth("w", 1, "SA8", "none", ("none",), oil_level=1.0, gas_preload=True, stated_as_full=True)
    lost = Truth("w", 1, "SA8", "state", ("state",), oil_level=0.7, gas_preload=True, stated_as_full=True)
    for truth, inside in ((full, True), (lost, False)):
        found = pair(truth, says("none", {"none": 1.0}))
        assert (preload_right(found), level_inside(found)) == (True, inside)


def test_the_density_of_a_level_is_normalised_and_scored_where_the_truth_is() -> None:
    levels = np.linspace(0.5, 0.7, 41)
    peak = 7.0 * np.exp(-(((levels - 0.6) / 0.01) ** 2) / 2)
    found = pair(FILL, filled(0.6, 0.58, 0.62, 1.0, grid={"level": levels.tolist(), "density": peak.tolist()}))
    assert level_log_score(found) == pytest.approx(-math.log(0.01 * math.sqrt(2 * math.pi)), abs=1e-3)
    flat = pair(FILL, filled(0.5, 0.0, 1.0, 1.0, grid={"level": [0.0, 1.0], "density": [2.0, 2.0]}))
    assert level_log_score(flat) == pytest.approx(0.0)
    assert level_log_score(pair(FILL, filled(0.6, 0.58, 0.62, 1.0))) is None


def test_the_calibration_error_of_answers_that_are_as_sure_as_right() -> None:
    rng = np.random.default_rng(3)
    p = rng.uniform(0.3, 1.0, 20000)
    honest = np.column_stack([p, rng.random(len(p)) < p])
    assert calibration_error(honest) < 0.02
    boastful = np.column_stack([np.full(100, 0.95), np.arange(100) < 60])
    assert calibration_error(boastful) == pytest.approx(0.35)
    few = by_chance(honest[:60])
    assert few.low < few.value < few.high
    assert few.value > 0.05, "sixty answers cannot show less, however honest"


def test_contradictions_between_verdict_and_probabilities() -> None:
    assert contradictions(answer_of(says("cause", {"end_stop": 0.95, "none": 0.05}, ["end_stop"]))) == []
    assert contradictions(answer_of(says("cause", {"end_stop": 0.2, "none": 0.8}, ["end_stop"]))) == [
        "cause is less likely than none"
    ]
    assert contradictions(answer_of(says("none", {"none": 0.7}))) == ["probabilities sum to 0.7", "the set holds 0.7"]


def test_figures_of_a_world() -> None:
    right = says("cause", {"oil_temperature": 0.95, "none": 0.05}, ["oil_temperature"])
    wrong = says("cause", {"end_stop": 0.95, "none": 0.05}, ["end_stop"])
    rows = [pair(HEAT, right)] * 3 + [pair(HEAT, wrong), pair(NOTHING, says("none", {"none": 1.0})), pair(NOTHING, wrong)]
    scored = score(rows)
    groups = scored["worlds"]["w"]
    assert groups["nothing hidden"]["accused"] | {"low": 0, "high": 0} == {
        "value": 0.5, "low": 0, "high": 0, "of": 2, "count": 1
    }  # fmt: skip
    clear = groups["effect of 2 of the noise or more"]
    assert clear["named alone and right"]["value"] == 0.75
    assert clear["named alone and right"]["low"] == pytest.approx(0.194, abs=1e-3), "Clopper and Pearson, 3 of 4"
    assert clear["wrong name alone"]["count"] == 1
    assert "effect below 0.5 of the noise" not in groups, "of nothing there is no figure"
    assert "unknown fill" not in groups
    everything = groups["all"]
    assert everything["log score"]["low"] <= everything["log score"]["value"] <= everything["log score"]["high"]
    assert everything["top-1"]["count"] == 4
    text = tables(scored)
    assert "| effect of 2 of the noise or more | truth in the 90 % set | 75.0 % | 19.4 to 99.4 % | 3 of 4 |" in text
    assert "| oil_temperature | 4 | 3 | oil_temperature 3, end_stop 1 |" in text
    json.dumps(scored, allow_nan=False)


def truth_file(folder: Path, **entries: Any) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    content = {"world": "w", "seed": 1, "damper": "SA8", "kind": "none", "causes": ["none"], "effect_over_noise": 0.0}
    (folder / "truth.json").write_text(json.dumps(content | entries))


def answer_file(folder: Path, content: Any) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "diagnosis.json").write_text(json.dumps(content))


def ended(folder: Path, outcome: str) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "run.json").write_text(json.dumps({"outcome": outcome, "message": "why", "seconds": 5.0, "sources": ""}))


def test_no_answer_is_counted_and_never_dropped(tmp_path: Path) -> None:
    for name in ("a", "b", "c", "d"):
        truth_file(tmp_path / name)
    answer_file(tmp_path / "a" / "answer", says("none", {"none": 1.0}))
    ended(tmp_path / "b" / "answer", "timeout")
    answer_file(tmp_path / "c" / "answer", says("none", {"none": math.nan}))
    truth_file(tmp_path / "e", kind="fault", causes=["unit_error"])
    ended(tmp_path / "e" / "answer", "refused")
    pairs = read_pairs([tmp_path])
    assert [p.answer.verdict for p in pairs] == ["none", "timeout", "failed", "failed", "measurement_fault"]
    assert right_alone(pairs[-1]), "a refusal of the hidden fault names it"
    figures = score(pairs)["worlds"]["w"]
    assert figures["all"]["no answer"]["count"] == 3
    assert figures["nothing hidden"]["none"]["of"] == 4
    assert figures["all"]["log score"]["value"] == pytest.approx(3 / 5 * math.log(SUREST))


@pytest.mark.parametrize(
    "content", [[], {"verdict": "perhaps"}, {"hypotheses": []}, says("none", {"none": 1.2}), filled(0.5, 0.7, 0.6, 1.0)]
)
def test_an_answer_that_is_none_is_a_failure_with_its_reason(tmp_path: Path, content: Any) -> None:
    answer_file(tmp_path, content)
    found = read_answer(tmp_path)
    assert found.verdict == "failed"
    assert found.reason.startswith("diagnosis.json: ")


def test_the_command_reads_folders_tables_of_truths_and_answers_elsewhere(tmp_path: Path) -> None:
    entry = {"world": "t", "kind": "effect", "causes": ["end_stop"], "effect_over_noise": 1.0}
    (tmp_path / "table").mkdir()
    (tmp_path / "table" / "truth.json").write_text(json.dumps({"one": entry, "two": entry}))
    for name in ("one", "two"):
        answer_file(tmp_path / "elsewhere" / name, says("cause", {"end_stop": 1.0}, ["end_stop"]))
    arguments = [
        "score",
        str(tmp_path / "table"),
        "--answers",
        str(tmp_path / "elsewhere"),
        "--json",
        str(tmp_path / "f.json"),
    ]
    done = CliRunner().invoke(app, arguments)
    assert done.exit_code == 0, done.output
    assert "| end_stop | 2 | 2 | end_stop 2 |" in done.output
    assert [row["dataset"] for row in json.loads((tmp_path / "f.json").read_text())["datasets"]] == ["one", "two"]


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ({"kind": "cause"}, "kind = 'cause': must be one of none, state, effect, fault, outside"),
        ({"kind": "effect"}, "only nothing is none"),
        ({"causes": []}, "must name what is hidden"),
        ({"effect_over_noise": math.nan}, "effect_over_noise = nan: must be a number of at least 0"),
        ({"level_seen": "yes"}, "level_seen = 'yes': must be true or false"),
    ],
)
def test_a_truth_that_cannot_be_read_is_refused(tmp_path: Path, entries: dict[str, Any], message: str) -> None:
    truth_file(tmp_path, **entries)
    done = CliRunner().invoke(app, ["score", str(tmp_path)])
    assert done.exit_code == 2
    assert message in done.output
    assert "truth.json" in done.output
    assert CliRunner().invoke(app, ["score", str(tmp_path / "nowhere")]).exit_code == 2


def test_where_only_the_fill_was_asked_nothing_is_said_of_causes() -> None:
    content = filled(0.6, 0.5, 0.7, 0.98)
    del content["hypotheses"], content["credible_set"]
    pair = Pair("a", FILL, answer_of(content | {"verdict": "state"}))
    assert pair.answer.given
    figures = groups([pair])
    assert set(figures) == {"unknown fill"}
    assert figures["unknown fill"]["level inside its 90 % interval"].value == 1.0
