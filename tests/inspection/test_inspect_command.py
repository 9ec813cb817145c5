"""`twintube inspect`: its figures as JSON, its page, its answers to bad input, and its documentation."""

import json
from pathlib import Path
from types import SimpleNamespace

import pytest
from typer.testing import CliRunner

from twintube.cli import app
from twintube.cli.outputs import MARK
from twintube.dampers import load
from twintube.dampers.freed_gas import DEFAULT, VARIED
from twintube.inspection import METHODS, Condition, conditions, inspected
from twintube.inspection.tables import METHOD_HEAD, RANGE_HEAD, markdown, method_rows, range_rows
from twintube.inspection.tiring import LIMIT
from twintube.report.inspection.summary import by_way, down_from, gas
from twintube.vehicle.cars import load_car

RUNNER = CliRunner()
ROOT = Path(__file__).parents[2]


def test_entries_and_detection_as_json(tmp_path: Path) -> None:
    file = tmp_path / "inspect.json"
    levels = ["--oil-level", "1", "--oil-level", "0.4", "--gas-lost"]
    run = RUNNER.invoke(
        app,
        ["inspect", "SA8", "SA1", "--method", "eusama", *levels, "--scatter", "20", "--processes", "1", "--json", str(file)],
    )
    assert run.exit_code == 0, run.output
    found = json.loads(file.read_text())
    assert [(e["damper"], e["oil_level"], e["gas_preload"], e["passed"]) for e in found["entries"]] == [
        ("SA8", 1.0, 1, True), ("SA8", 0.4, 0, False), ("SA1", 1.0, 1, True), ("SA1", 0.4, 0, False),
    ]  # fmt: skip
    for entry in found["entries"]:
        assert {"method", "figure", "limit", "scalar_factor"} <= set(entry)
        assert entry["scalar_factor"]["factor"] == entry["oil_level"]
    assert {item["false_alarm_rate"] for item in found["detection"]} == {0.05}
    assert all(0 <= d["detected_band"][0] <= d["detected_share"] <= d["detected_band"][1] <= 1 for d in found["detection"])
    assert [item["oil_level"] for item in found["first_seen"]] == [0.4, 0.4]
    assert "eusama: 90% detected at 5% false alarms at 40% whatever freed gas does" in run.output
    for item in found["first_seen"]:
        assert set(item["freed_gas_ways"]) == set(VARIED) and item["freed_gas_ways"][DEFAULT] == item["oil_level"]
    assert all(set(entry["freed_gas_ways"]) == set(VARIED) for entry in found["entries"])


def test_the_page_has_all_methods_and_pictures(tmp_path: Path) -> None:
    run = RUNNER.invoke(
        app,
        [
            "inspect",
            "--oil-level",
            "1",
            "--oil-level",
            "0.5",
            "--gas-lost",
            "--scatter",
            "20",
            "--processes",
            "1",
            "--freed-gas",
            DEFAULT,
            "--output",
            str(tmp_path),
        ],
    )
    assert run.exit_code == 0, run.output
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    for method in METHODS.values():
        assert method.title in page
    names = {"verdicts.png", "SA8.png", "plate.png", "SA8_detected.png", "SA8_roc.png"}
    assert {path.name for path in tmp_path.iterdir()} == names | {"report.html", MARK}
    assert page.count("data:image/png") == 2 * len(names)  # for wide and for narrow screens


def test_without_scatter_there_are_only_figures(tmp_path: Path) -> None:
    file = tmp_path / "inspect.json"
    arguments = [
        "inspect",
        "--oil-level",
        "0.9",
        "--method",
        "bump",
        "--scatter",
        "0",
        "--json",
        str(file),
    ]
    run = RUNNER.invoke(app, [*arguments, "--output", str(tmp_path / "page")])
    assert run.exit_code == 0, run.output
    found = json.loads(file.read_text())
    assert found["detection"] == found["first_seen"] == []
    assert [entry["gas_preload"] for entry in found["entries"]] == [1]
    assert (tmp_path / "page" / "report.html").is_file()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--method", "shaking"], "error: method shaking: must be one of eusama, phase_shift"),
        (["--oil-level", "1.7", "--scatter", "0"], "error: SA8: oil_level = 1.7: must be a number from 0 to 1"),
        (["--scatter", "7"], "error: samples = 7: must be from 20 to 10000"),
        (["--freed-gas", "x"], "error: --freed-gas x: must be one of stays, dissolves"),
        (["--car", "x"], "error: unknown car x: neither a file nor one of "),
        (["SA9"], "error: unknown damper SA9"),
    ],
)
def test_bad_input_ends_with_one_line(arguments: list[str], message: str) -> None:
    run = RUNNER.invoke(app, ["inspect", *arguments])
    assert run.exit_code == 2
    assert run.stderr.startswith(message)
    assert run.stderr.count("\n") == 1


def test_the_documentation_has_the_tables_of_methods_and_ranges() -> None:
    page = (ROOT / "docs" / "inspection.md").read_text(encoding="utf-8")
    assert markdown(METHOD_HEAD, method_rows()) in page
    assert markdown(RANGE_HEAD, range_rows()) in page


def test_what_flips_from_way_to_way_is_said() -> None:
    assert by_way({"dissolves": "60%"}) == "60%"
    assert by_way({"dissolves": "60%", "stays": "60%"}) == "60% whatever freed gas does"
    texts = {"dissolves": "60%", "stays": "50%", "pushes_oil": "not seen", "limited": "50%"}
    assert by_way(texts) == "60%, but 50% with freed gas stays, limited, not seen with freed gas pushes_oil"


def test_the_page_about_tiring_says_its_limit_and_what_the_command_prints() -> None:
    page = (ROOT / "docs" / "inspection_tiring.md").read_text(encoding="utf-8")
    assert f"A damper fails above {LIMIT:g}." in " ".join(page.split())
    (row,) = [line for line in page.splitlines() if line.startswith("| SA8 | 1.00 |")]
    entries = inspected(load("SA8"), load_car(), conditions((0.9, 0.6), gas_preload=0.0), ("tiring",), ways=VARIED)
    for entry in entries:
        texts = [f"{figure:.2f}" for figure in entry.readings.values()]
        assert f"| **{texts[0]}** / {' / '.join(texts[1:])} |" in row


def test_only_levels_of_the_study_are_named() -> None:
    """From three levels nothing follows about those between and below them."""
    study = SimpleNamespace(detections=[SimpleNamespace(condition=Condition(level, 0)) for level in (1.0, 0.6, 0.5)])
    assert [down_from(study, level) for level in (None, 0.5, 0.6)] == [
        "at none of these oil levels", "at 50%", "from 60% down to 50%",
    ]  # fmt: skip


def test_the_sentence_names_the_state_of_the_gas() -> None:
    run = RUNNER.invoke(app, ["inspect", "SA8", "--method", "eusama", "--oil-level", "0.6", "--gas-lost", "--scatter", "0"])
    assert "down to 60% whatever freed gas does (below 100% its gas preload is lost)." in run.output
    assert "eusama [%]" in run.output
    kept, full = (SimpleNamespace(entries=[SimpleNamespace(condition=Condition(x, 1))]) for x in (0.6, 1.0))
    assert (gas(kept), gas(full)) == (" (below 100% its gas preload is kept)", "")
