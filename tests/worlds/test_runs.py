"""Datasets of every world with truths of one form, and runs over them that go on where they stopped."""

import json
import sys
from concurrent.futures import CancelledError
from functools import partial
from pathlib import Path
from threading import Event
from typing import Any

import pytest
from typer.testing import CliRunner

import worlds.run
from twintube.data import load_dataset
from worlds.__main__ import app
from worlds.bench.files import told, write_truth
from worlds.makers import WORLDS, Job, copied, jobs
from worlds.run import RunError, run, sources, work
from worlds.scoring import read_pairs, read_truths
from worlds.scoring.truth import truth_of

NONE = {"world": "w", "seed": 0, "damper": "SA8", "kind": "none", "causes": ["none"]}
SEEDS = {"challenge": 6, "workshop": 1, "unknown_fill": 4, "before_after": 1, "before_after_identified": 1}
QUICK = ("challenge", "workshop", "unknown_fill", "before_after")  # the others compile their models or identify a damper
SLOW = [pytest.param(world, marks=pytest.mark.slow) for world in WORLDS if world not in QUICK]


@pytest.mark.parametrize("world", [*QUICK, *SLOW])
def test_every_world_writes_a_truth_of_the_same_form(world: str, tmp_path: Path) -> None:
    (job,) = jobs(world, seed := SEEDS.get(world, 0), seed)
    job.make(tmp_path)
    truth = read_truths(tmp_path / "truth.json")[""]
    assert truth.world == world
    assert truth.damper.startswith("SA")
    assert (tmp_path / "dataset" / "dataset.toml").is_file()
    assert {path.name for path in tmp_path.iterdir()} == {"dataset", "truth.json"}
    damper = load_dataset(tmp_path / "dataset").damper.name
    assert damper == truth.damper + "-identified" * (world in ("before_after_identified", "virtual_rig"))


@pytest.mark.parametrize(
    ("causes", "kind", "wanted"),
    [
        (["none"], "none", ("none", {"none"}, {"none"})),
        (["valve_wear"], "effect", ("effect", {"valve_wear"}, {"valve_wear"})),
        (["oil_level_error"], "effect", ("state", {"oil_level_error"}, {"oil_level_error", "state"})),
        (["clock_error"], "fault", ("fault", {"clock_error"}, {"clock_error"})),
        (["backlash"], "outside", ("outside", {"unknown"}, {"unknown"})),
        (["end_stop", "valve_wear"], "effect", ("effect", {"end_stop", "valve_wear"}, {"end_stop", "valve_wear"})),
    ],
)
def test_truths_in_the_common_form(causes: list[str], kind: str, wanted: tuple[str, set[str], set[str]]) -> None:
    more = {"effect_over_noise": 0.4}
    truth = truth_of(told("challenge", 3, "SA1", causes, kind=kind, more=more), "here")
    assert (truth.kind, truth.wanted, truth.names) == wanted
    assert truth.effect_over_noise == 0.4


def stub(folder: Path, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A program in place of `twintube`; its arguments are diagnose DATASET --output ANSWER."""
    path = folder / "program.py"
    path.write_text("import json, pathlib, sys, time\nout = pathlib.Path(sys.argv[4])\n" + text)
    monkeypatch.setattr(worlds.run, "PROGRAM", [sys.executable, str(path)])


ANSWER = {"verdict": "none", "hypotheses": [{"name": "none", "probability": 1.0}], "seconds": 1.0}
ENDS = {
    "answered": f"out.mkdir(); (out / 'diagnosis.json').write_text('''{json.dumps(ANSWER)}''')",
    "refused": "print('working\\rerror: oil_level = 3'); sys.exit(2)",
    "failed": "raise ValueError('no such thing')",
    "timeout": "print('begun', flush=True); time.sleep(60)",
}
SAID = {"answered": "", "refused": "error: oil_level = 3", "failed": "ValueError: no such thing", "timeout": "after 1 s"}


def nothing(folder: Path) -> None:
    (folder / "dataset").mkdir()
    write_truth(folder, NONE)


@pytest.mark.parametrize("outcome", ENDS)
def test_how_a_diagnosis_ends_is_recorded(outcome: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    stub(tmp_path, ENDS[outcome], monkeypatch)
    (tmp_path / "out" / "one" / "answer").mkdir(parents=True)  # half made, half answered
    (tmp_path / "out" / "one" / "answer" / "diagnosis.json").write_text("{")
    assert work(Job("one", nothing), tmp_path / "out", 1.0, "v", Event()) == outcome
    told = json.loads((tmp_path / "out" / "one" / "answer" / "run.json").read_text())
    assert (told["outcome"], told["message"], told["sources"]) == (outcome, SAID[outcome], "v")
    (pair,) = read_pairs([tmp_path / "out"])
    assert pair.answer.verdict == ("none" if outcome == "answered" else outcome)
    assert pair.answer.reason == SAID[outcome]


def test_an_answered_dataset_is_not_run_again_and_other_sources_are_not_mixed(tmp_path: Path) -> None:
    def never(folder: Path) -> Any:
        raise AssertionError

    folder = tmp_path / "one"
    folder.mkdir()
    nothing(folder)
    (folder / "answer").mkdir()
    (folder / "answer" / "diagnosis.json").write_text(json.dumps(ANSWER))
    kept = {"sources": sources(), "outcome": "answered", "message": "", "seconds": 2.0}
    (folder / "answer" / "run.json").write_text(json.dumps(kept))
    (pair,) = run([Job("one", never)], tmp_path)
    assert pair.answer.verdict == "none"
    (folder / "answer" / "run.json").write_text(json.dumps(kept | {"sources": "0" * 16}))
    with pytest.raises(RunError, match=r"run\.json: the answer of another state of the program"):
        run([Job("one", never)], tmp_path)


def collection(folder: Path) -> list[str]:
    """A folder with a dataset that nobody can read, and the arguments to run over it."""
    (folder / "datasets" / "broken").mkdir(parents=True)
    (folder / "datasets" / "broken" / "dataset.toml").write_text('title = "no records"\n')
    truth = {"broken": told("w", 1, "SA1", ["unit_error"], kind="fault", more={"effect_over_noise": 5.0})}
    (folder / "datasets" / "truth.json").write_text(json.dumps(truth))
    return ["run", "--datasets", str(folder / "datasets"), "--output", str(folder / "out")]


def test_a_run_over_a_collection_ends_with_the_score(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    stub(tmp_path, ENDS["answered"], monkeypatch)
    done = CliRunner().invoke(app, collection(tmp_path))
    assert done.exit_code == 0, done.output
    assert "| unit_error | 1 | 0 | none 1 |" in done.output
    assert (tmp_path / "out" / "score.md").read_text(encoding="utf-8") in done.output
    assert not json.loads((tmp_path / "out" / "score.json").read_text())["datasets"][0]["right"]


def test_an_interrupted_diagnosis_is_no_failure(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    stub(tmp_path, ENDS["failed"], monkeypatch)
    stopping = Event()
    stopping.set()
    with pytest.raises(CancelledError):
        work(Job("one", nothing), tmp_path / "out", 9.0, "v", stopping)
    assert not (tmp_path / "out" / "one" / "answer" / "run.json").exists()


@pytest.mark.slow  # a program that imports everything
def test_a_run_of_the_diagnosis_itself(tmp_path: Path) -> None:
    done = CliRunner().invoke(app, collection(tmp_path))
    assert done.exit_code == 0, done.output
    told = json.loads((tmp_path / "out" / "broken" / "answer" / "run.json").read_text())
    assert told["outcome"] == "refused"
    assert "dataset.toml" in told["message"]
    assert "| unit_error | 1 | 1 | unit_error 1 |" in done.output


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--world", "mars", "--seeds", "1-2"], "--world mars: must be one of unknown_fill"),
        (["--world", "challenge", "--seeds", "5-2"], "--seeds 5-2: must be A-B with B not below A"),
        (["--world", "challenge"], "--seeds : must be A-B"),
        (["--world", "workshop", "--seeds", "0-3"], "--seeds 0-3: the seeds of workshop begin at 1"),
        ([], "--world, --datasets: give one of them"),
        (["--datasets", "nowhere"], "truth.json"),
    ],
)
def test_a_run_that_is_not_described_is_refused(arguments: list[str], message: str, tmp_path: Path) -> None:
    done = CliRunner().invoke(app, ["run", "--output", str(tmp_path / "out"), *arguments])
    assert done.exit_code == 2
    assert message in done.output
    assert not (tmp_path / "out").exists()


def test_a_dataset_is_copied_with_its_truth(tmp_path: Path) -> None:
    (tmp_path / "source").mkdir()
    (tmp_path / "source" / "dataset.toml").write_text("")
    (tmp_path / "made").mkdir()
    Job("one", partial(copied, tmp_path / "source", NONE)).make(tmp_path / "made")
    assert read_truths(tmp_path / "made" / "truth.json")[""].kind == "none"
