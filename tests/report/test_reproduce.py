"""The report as a whole, with the virtual rig."""

import json

import pytest

from twintube.dampers import ParameterError, load
from twintube.engine.simulate import InputError
from twintube.report.paper.figures import FIGURES
from twintube.report.paper.figures.validation import filling
from twintube.report.paper.records import Job, Records
from twintube.report.paper.reproduce import figure_numbers, reproduce


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    return reproduce(tmp_path_factory.mktemp("out"), figures=["7", "12", "18"], processes=1)


def test_files(report):
    assert [path.name for path in report.pictures] == ["figure_07.png", "figure_12.png", "figure_18.png"]
    for path in report.pictures:
        assert path.read_bytes().startswith(b"\x89PNG")
    page = report.page.read_text(encoding="utf-8")
    assert page.count("data:image/png;base64,") == 3
    assert "http" not in page.replace("data:image", "")
    assert not list(report.page.parent.rglob("*.part"))


def test_json(report):
    content = json.loads(report.json.read_text(encoding="utf-8"))
    assert [entry["figure"] for entry in content["figures"]] == [7, 12, 18]
    seven = content["figures"][0]
    assert seven["stand_ins"] and seven["statements"][0]["claim"] == "C11"
    assert {entry["figure"]: entry["verdict"] for entry in content["figures"]} == report.verdicts
    slopes = seven["statements"][0]["numbers"]["at_100_60_40"]
    assert set(slopes) == {"model", "virtual rig"} and len(slopes["virtual rig"]) == 3


def test_records_are_kept(report):
    records = Records(report.page.parent / "records", 1)
    job = Job("SA7", "slow", 0.0, 1.0)
    file = records.folder / job.file
    before = file.stat().st_mtime_ns
    records.prepare([job])
    assert file.stat().st_mtime_ns == before
    record = records.get(job)
    assert len(record.time) == len(record.force) and record.marks[-1] < len(record.time)


def test_no_process_is_refused(tmp_path):
    with pytest.raises(InputError, match="processes = 0"):
        reproduce(tmp_path / "out", figures=["18"], processes=0)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(("level", "verb"), [(1.0, "fills"), (0.2, "does not fill")])
def test_reason_states_whether_the_oil_fills_the_chambers(level, verb):
    assert f" mL and {verb} the two working chambers" in filling(load("SA4", as_published=True), level)


def test_figures_are_chosen():
    assert figure_numbers(None) == sorted(FIGURES)
    assert figure_numbers(["19-21", 3]) == [3, 19, 20, 21]
    for bad in (["x"], ["13"], ["3-y"]):
        with pytest.raises(ParameterError):
            figure_numbers(bad)
