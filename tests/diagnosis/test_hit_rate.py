"""The benchmark of the diagnosis goes on where it stopped, and counts what it says it counts."""

import json
from dataclasses import asdict
from pathlib import Path

import pytest

from benchmarks.diagnosis import Outcome, given_up, kept, limit, outcomes, shares, sources, undecided

FOUND = Outcome("gas_spring", 100, 0.8, "cause", ("gas_spring",), (), 0.9, 0.9, 20.0)


def line(code: str, outcome: Outcome) -> str:
    return json.dumps({"code": code, "job": (outcome.kind, outcome.seed, None), "outcome": asdict(outcome)}) + "\n"


def test_kept_outcomes_are_not_run_again_and_those_of_other_sources_do_not_count(tmp_path: Path) -> None:
    file = tmp_path / "outcomes.jsonl"
    cut_off = line(sources(), FOUND)[:30]
    file.write_text(line("0" * 16, Outcome(**asdict(FOUND) | {"seed": 101})) + line(sources(), FOUND) + "\n" + cut_off)
    assert list(kept(file)) == [("gas_spring", 100, None)]
    assert list(outcomes([("gas_spring", 100, None)], file)) == [FOUND]


def test_shares_of_right_answers_false_alarms_and_named_outsiders() -> None:
    found = [
        FOUND,
        Outcome("gas_spring", 101, 0.5, "cause", ("valve_wear",), (), 0.1, 0.8, 20.0),
        Outcome("none", 100, 1.0, "unexplained", (), (), float("nan"), float("nan"), 20.0),
        Outcome("mains_hum", 100, 1.0, "unexplained", (), (), float("nan"), float("nan"), 20.0),
    ]
    figures = shares(found)
    assert figures["correct_share"] == pytest.approx(1 / 3)
    assert figures["false_alarm_share"] == 1.0
    assert figures["outside_named_share"] == 0.0
    assert figures["matrix"]["gas_spring"] == {"gas_spring": 1, "valve_wear": 1}


def test_the_detection_limit_is_sought_at_the_weakest_strength_and_then_by_bisection() -> None:
    assert undecided({}) == 0.0625
    assert undecided({0.0625: 0.9}) is None
    assert undecided({0.0625: 0.8}) == 0.25
    assert undecided({0.0625: 0.8, 0.25: 0.7}) == 0.5
    assert undecided({0.0625: 0.8, 0.25: 0.9, 0.125: 0.8}) is None
    assert limit({0.0625: 0.8, 0.25: 0.9, 1.0: 1.0}) == 0.25
    assert given_up([True, False, False], 10)
    assert not given_up([True, False], 10)
