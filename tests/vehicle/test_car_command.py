"""`twintube car`: its figures, its page, the table beside an inspection, and bad input in a single line."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from twintube.cli import app
from twintube.cli.base import standalone
from twintube.cli.tables import car_sensitivity
from twintube.dampers.freed_gas import DEFAULT
from twintube.report.car.conclusion import read_inspection, section, seen_first
from twintube.report.car.page import headline
from twintube.vehicle.cars import FOLDER
from twintube.vehicle.maneuvers import MANEUVERS

QUICK = [
    "car",
    "--maneuver",
    "braking",
    "--speed",
    "50",
    "--road-class",
    "smooth",
    "--oil-level",
    "0.5",
    "--gas-lost",
    "--seeds",
    "2",
]


def test_figures_page_and_table_of_an_inspection(tmp_path: Path) -> None:
    shares = [
        {"damper": "SA8", "method": "eusama", "oil_level": 0.5, "scalar_factor": scalar, "detected_share": share}
        for scalar, share in ((False, 0.2), (True, 0.6))
    ]
    inspection = tmp_path / "inspect.json"
    inspection.write_text(json.dumps({"detection": shares, "scatter": {"samples": 100}}))
    out, figures = tmp_path / "car", tmp_path / "car.json"
    result = CliRunner().invoke(app, [*QUICK, "--inspection", str(inspection), "--json", str(figures), "--output", str(out)])
    assert result.exit_code == 0, result.output
    content = json.loads(figures.read_text())
    assert {row["model"] for row in content["compared"]} == {"full model", "scalar factor"}
    assert len(content["drives"]) == 12  # two seeds: intact, four ways of the freed gas, scalar factor
    row = content["compared"][0]
    assert row["change_band"][0] <= row["change"] <= row["change_band"][1]
    page = (out / "car.html").read_text()
    for name in (
        "stopping distance [m]",
        "DLC, rear left",
        "share of the time without contact, front right",
        "work of the damper",
    ):
        assert name in page, name
    assert "mean (range over 2 seeds and the ways of the freed gas)" in page
    assert "Seen in an inspection, felt on the road" in page and "stopping distance" in page
    assert (out / "car.png").read_bytes().startswith(b"\x89PNG")
    (table,) = section(read_inspection(inspection), content["compared"]).tables
    assert [cells[:3] for cells in table.rows] == [["50%", "full model", "20%"], ["50%", "scalar factor", "60%"]]


def test_the_ten_drives_of_table_3(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("twintube.vehicle.full.study.VARIED", (DEFAULT,))
    file = tmp_path / "car.json"
    run = CliRunner().invoke(
        app,
        [
            "car",
            "--maneuver",
            "table3",
            "--oil-level",
            "0.5",
            "--gas-lost",
            "--seeds",
            "1",
            "--json",
            str(file),
            "--output",
            str(tmp_path),
        ],
    )
    assert run.exit_code == 0, run.output
    drives = json.loads(file.read_text())["drives"]
    assert len({entry["road"] for entry in drives}) == 10
    wanted = {
        "dlc",
        "min_load_share",
        "contact_loss_share",
        "comfort_m_s2",
        "roll_rms_deg",
        "pitch_rms_deg",
        "damping_work_J",
    }
    assert all(wanted <= set(entry) for entry in drives)
    page = (tmp_path / "car.html").read_text()
    assert all(drive.name in page for drive in MANEUVERS)


def test_a_car_that_nothing_holds_on_the_road_is_a_line(tmp_path: Path) -> None:
    """A piston that leaves its tube in every drive: the road of class E at 200 km/h with stops that hold nothing."""
    file = tmp_path / "car.toml"
    file.write_text((FOLDER / "passat_b8.toml").read_text().replace("c_stop = 1e9", "c_stop = 0"))
    run = CliRunner().invoke(
        app, ["car", "--car", str(file), "--maneuver", "ride", "--speed", "200", "--road-class", "E", "--seeds", "1"]
    )
    assert run.exit_code == 2
    assert run.output.startswith("error: ride at 200 km/h on E, 100% oil: time ") and run.output.count("\n") == 1
    assert "damper: must stay within" in run.output


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('m_body = "405 kg"', 'm_body = "-5 kg"', r"line 6: front.m_body = -5 kg: must be a number from 20 to 5000 kg"),
        ('c_bar = "16 N/mm"\n', "", r"line 40: front_axle.c_bar is missing: must be from 0 to 1e+06 N/m"),
        (
            "slip_release = 0.10",
            "slip_release = nan",
            "line 119: brakes.slip_release = nan: must be a number from 0.01 to 1",
        ),
        ("slip_build = 0.02", "slip_build = 0.5", "line 120: brakes.slip_build = 0.5: must be below slip_release = 0.1"),
        ("s_slide_x = 0.95", "s_slide_x = 0.05", "line 70: front_tyre.s_slide_x = 0.05: must not be below s_most_x = 0.106"),
        ("drive = 1.0", "drive = 0.5", "line 57: rear_axle.drive: the shares of both axles, 0.5 + 0, must add up to 1"),
        ("steers = 1.0", "steers = 0.0", "line 46: front_axle.steers = 0: must be above 0 at one axle at least"),
        ("[brakes]", "[breaks]", "unknown breaks, did you mean brakes?"),
    ],
)
def test_a_car_file_is_refused_with_quantity_value_range_and_line(tmp_path: Path, old: str, new: str, message: str) -> None:
    text = (FOLDER / "passat_b8.toml").read_text()
    assert old in text
    file = tmp_path / "car.toml"
    file.write_text(text.replace(old, new))
    for program, words in ((app, ["car"]), (app, ["inspect"]), (standalone(car_sensitivity), [])):
        run = CliRunner().invoke(program, [*words, "--car", str(file)])
        assert run.exit_code == 2
        assert run.output.startswith("error: ") and "car.toml: " in run.output and message in run.output
        assert run.output.count("\n") == 1


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--maneuver", "drift"], "maneuver drift: must be one of ride, braking, cornering, step_steer, "),
        (["--road-class", "Z"], "road class Z: must be one of smooth, A"),
        (["--grip", "slick"], "grip slick: must be one number, or two for left and right"),
        (["--grip", "1,0"], "grip 0 on the right: must be from 0.1 to 1.5"),
        (["--maneuver", "circle", "--road-class", "D"], "nothing to drive: a circle is not driven on the road class D"),
        (
            ["--maneuver", "ride", "--road-class", "smooth"],
            "nothing to drive: a ride is not driven on the road class smooth",
        ),
        (["--speed", "nan"], "speed nan km/h: must be from 1 to 250 km/h"),
        (["--speed", "0"], "speed 0 km/h: must be from 1 to 250 km/h"),
        (["--worn", "left"], "worn left: must be one of all, front, rear, front_left"),
        (["--oil-level", "1.5"], "oil_level = 1.5: must be"),
        (["--car", "bus"], "unknown car bus"),
        (["--inspection", "pyproject.toml"], "pyproject.toml: is not a file of `twintube inspect"),
    ],
)
def test_bad_input_is_a_line(options: list[str], message: str) -> None:
    result = CliRunner().invoke(app, ["car", *options])
    assert result.exit_code == 2
    assert message in result.output and result.output.count("\n") == 1


@pytest.mark.parametrize(
    ("levels", "told"),
    [
        ((0.5,), "At 50% oil (gas preload lost in the worn dampers) are felt: stop +20%."),
        ((0.7, 0.5), "Driven with 70%, 50% oil (gas preload lost in the worn dampers). Felt first at 50%: stop +20%."),
    ],
)
def test_what_is_felt_first_names_the_levels_driven_and_the_gas(levels: tuple[float, ...], told: str) -> None:
    row = {"maneuver": "braking", "speed_kmh": 80.0, "road": "D", "model": "full model", "figure": "stop", "seeds": 1}
    rows = [row | {"oil_level": x, "change": 0.2, "change_band": (0.1, 0.3) if x == 0.5 else (-0.1, 0.3)} for x in levels]
    assert headline(rows, None, "lost in the worn dampers").text == told


def test_what_an_inspection_sees_stands_beside_the_levels_that_it_looked_at() -> None:
    seen = {"first_seen": [{"damper": "SA8", "oil_level": 0.5}], "detection": [{"oil_level": x} for x in (0.6, 0.5, 0.5)]}
    assert seen_first(seen) == "Seen by an inspection, of 60%, 50% oil: SA8 at 50%."
    assert seen_first(seen | {"first_seen": []}) == "Seen by an inspection, of 60%, 50% oil: none."
