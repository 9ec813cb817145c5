"""Marks on answers whose marks are known."""

import json
import math
from pathlib import Path
from typing import Any

import pytest

from benchmarks.challenge import append, draw_reliability, kept_outcomes
from benchmarks.challenge_tables import limits, tables
from twintube.lab.challenge.score import contradictions, score


def outcome(cause: str, kind: str, answer: dict[str, Any], ratio: float = 1.0, **values: float) -> dict[str, Any]:
    truth = {"cause": cause, "causes": cause.split("+"), "hidden": cause, "kind": kind, "effect_over_noise": ratio}
    return {"truth": {**truth, "values": values}, "answer": answer}


def says(
    verdict: str, *names: str, probabilities: dict[str, float] | None = None, gain: float = 0.5, **more: Any
) -> dict[str, Any]:
    causes = [{"effect": name, "parameters": more.get("parameters", {}), "gain": {"heldout": gain}} for name in names]
    sizes = {"base": {"force_rmse_N": 10.0}, "extended": {"force_rmse_N": 5.0}, "noise_floor": {"force_rmse_N": 4.0}}
    return {"verdict": verdict, "causes": causes, "error": sizes, "probabilities": probabilities or {"none": 1.0},
            "seconds": more.get("seconds", 2.0)}  # fmt: skip


def test_shares_brier_and_isolation() -> None:
    heat = outcome(
        "oil_temperature", "effect", says("cause", "oil_temperature", probabilities={"oil_temperature": 0.8, "none": 0.2})
    )
    alarm = outcome("none", "none", says("cause", "end_stop", probabilities={"end_stop": 0.5, "none": 0.5}), 0.0)
    quiet = outcome("none", "none", says("none", probabilities={"none": 1.0}), 0.0)
    pair = outcome(
        "foam_decay+end_stop",
        "pair",
        says("cause", "foam_decay", probabilities={"foam_decay": 0.6, "end_stop": 0.3, "none": 0.1}),
    )
    figures = score([heat, alarm, quiet, pair])
    assert figures["false_alarm_share"] == 0.5 and figures["none_right_share"] == 0.5
    assert figures["wrong_name_share"] == 0.25 and figures["right_share_clear"] == 0.5
    assert figures["detection_share"] == 1.0
    assert figures["isolation"] == pytest.approx((0.8 + 0.5 + 1.0 + 0.9) / 4)
    briers = (0.04 + 0.04, 0.25 + 0.25, 0.0, 0.01 + 0.01)
    assert figures["brier"] == pytest.approx(sum(briers) / 4)
    assert figures["reliability"]["0.9-1.0"] == {"count": 1, "mean": 1.0, "right": 1.0}
    assert figures["matrix"]["none"] == {"end_stop": 1, "none": 1}
    assert figures["contradictions"] == 0 and figures["median_seconds"] == 2.0


def test_outside_refused_and_ambiguous() -> None:
    clipped = outcome("clipping", "outside", says("unexplained", probabilities={"unknown": 0.7, "none": 0.3}))
    named = outcome("clipping", "outside", says("cause", "end_stop"))
    flipped = outcome("sign_flip", "fault", {"refused": "work below 0"})
    offset = outcome("force_offset", "fault", {"refused": "work below 0"})
    unsure = says("ambiguous", "fluid_lag")
    figures = score([clipped, named, flipped, offset, outcome("fluid_lag", "effect", unsure)])
    assert figures["outside_right_share"] == 0.5
    assert figures["right_share_clear"] == pytest.approx(1 / 3)
    assert figures["truth_first_share_clear"] == pytest.approx(2 / 3)
    assert figures["ambiguous_truth_first"] == 1 and figures["wrong_name_share"] == 0.2


def test_what_a_bench_hides_is_counted_apart() -> None:
    inside, outside = (
        outcome("seal_leak", "effect", says(word, *names)) for word, *names in (["none"], ["cause", "seal_leak"])
    )
    inside["truth"]["effect_beyond_bench"], outside["truth"]["effect_beyond_bench"] = 0.1, 0.8
    figures = score([inside, outside])
    assert figures["right_share_clear"] == 0.5 and figures["right_share_beyond_bench"] == 1.0


def test_a_delay_of_less_than_a_sample_need_not_be_named() -> None:
    short, long = (outcome("fluid_lag", "effect", says(word, *names)) for word, *names in (["none"], ["cause", "fluid_lag"]))
    short["truth"] |= {"effect_beyond_bench": 2.0, "late_samples": 0.4}
    long["truth"] |= {"effect_beyond_bench": 2.0, "late_samples": 1.4}
    figures = score([short, long])
    assert figures["right_share_beyond_bench"] == 0.5 and figures["right_share_nameable"] == 1.0


def test_tables_count_what_the_marks_do() -> None:
    alarm = outcome("none", "none", says("cause", "end_stop"), 0.0)
    quiet = outcome("none", "none", says("none"), 0.0)
    inside = outcome("seal_leak", "effect", says("none"))
    inside["truth"]["effect_beyond_bench"] = 0.1
    lines = tables([alarm, quiet, inside]).splitlines()
    assert "| false alarms where nothing is hidden | 1 of 2 | 50.0 % | 1.3 to 98.7 % |" in lines
    assert "| right where effect/noise is 0.5 or more | 0 of 1 | 0.0 % | 0.0 to 97.5 % |" in lines
    assert not any("beyond the bench is" in line for line in lines), "of nothing there is no share"
    assert "| seal_leak | 1 | 0 | 0 of 0 | none 1 |" in lines and "| none | 2 | 1 |  | end_stop 1, none 1 |" in lines


def test_contradictions_are_counted() -> None:
    assert contradictions(says("cause", "end_stop", gain=-0.1)) == ["end_stop with a held-out gain of -0.1"]
    doubtful = says("cause", "end_stop", parameters={"c": {"value": 1.0, "doubt": "at its bound"}})
    assert contradictions(doubtful) == ["end_stop: c in doubt"]
    answer = says("cause", "end_stop", probabilities={"end_stop": 0.7})
    answer["error"] |= {"base": {"force_rmse_N": 3.0}}
    assert len(contradictions(answer)) == 3
    assert contradictions({"refused": "no file"}) == []
    others = [{"effect": "fluid_lag", "heldout_gain": gain} for gain in (0.0, 0.4)]
    assert contradictions(says("ambiguous", "end_stop") | {"alternatives": others}) == [
        "fluid_lag as an alternative with a held-out gain of 0"
    ]


def test_coverage_and_detection_limit() -> None:
    def answer(ratio: float) -> dict[str, Any]:
        interval = {"side_load_N": {"value": 10.0, "interval": [8.0, 12.0]}}
        return says("cause", "side_load_friction", parameters=interval) if ratio > 0.9 else says("none")

    rows = [outcome("side_load_friction", "effect", answer(r), r, side_load_N=6.0 + 4.0 * r) for r in (0.3, 0.6, 1.0, 2.0)]
    figures = score(rows)
    assert figures["coverage"]["side_load_N"] == {"count": 2, "share": 0.5}
    assert figures["detection_limit"] == {"side_load_friction": 0.7}
    assert "| side_load_friction | 4 | 0.7 | not reached |" in limits(rows)


def test_no_outcomes_are_no_figures() -> None:
    figures = score([])
    assert figures["datasets"] == 0 and math.isnan(figures["brier"])


def test_a_run_that_was_broken_off_goes_on(tmp_path: Path) -> None:
    keep = tmp_path / "kept" / "outcomes.jsonl"
    append(keep, {"version": "a", "seed": 1})
    with keep.open("a", encoding="utf-8") as file:
        file.write('{"version": "a", "se')
    append(keep, {"version": "a", "seed": 2})
    append(keep, {"version": "b", "seed": 3})
    assert [entry["seed"] for entry in kept_outcomes(keep, "a")] == [1, 2]
    assert json.loads(keep.read_text(encoding="utf-8").splitlines()[-1])["seed"] == 3


def test_the_reliability_picture(tmp_path: Path) -> None:
    draw_reliability({"0.9-1.0": {"count": 3, "mean": 0.95, "right": 1.0}}, tmp_path / "r.png")
    assert (tmp_path / "r.png").stat().st_size > 1000
