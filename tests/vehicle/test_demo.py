"""The main job end to end, with short rides."""

import json
import subprocess
import sys
from pathlib import Path

import fmpy
from typer.testing import CliRunner

from twintube.cli import app
from twintube.dampers import load
from twintube.demo.job import cases, strengths
from twintube.demo.ride import RideCase, ride
from twintube.fmu import build_fmu
from twintube.vehicle.cars import load_car
from twintube.vehicle.ride import track

ROOT = Path(__file__).parents[2]


def test_demo_writes_the_summary_and_the_pictures(tmp_path: Path) -> None:
    run = subprocess.run(
        [sys.executable, "-m", "vehicle_demo", "--output", str(tmp_path / "out"), "--seconds", "20", "--seed", "3"],
        cwd=ROOT, capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert "intact" in run.stdout
    result = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert result["road"]["class"] == "D"
    assert 512e-6 < result["road"]["gd_n0_m3"] < 2048e-6
    assert [block["speed_kmh"] for block in result["speeds"]] == [30.0, 50.0]
    for block in result["speeds"]:
        assert [e["oil_level"] for e in block["oil_levels"]] == [1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3]
        for entry in [block["intact"], *block["oil_levels"]]:
            assert {"dlc", "wheel_load_rms_N", "min_wheel_load_N", "contact_loss_share", "damping_work_J"} <= set(entry)
            assert entry["min_wheel_load_N"] >= 0.0
        for entry in block["oil_levels"]:
            assert len(entry["dlc_window"]) == 2
            low, high = entry["bands"]["freed_gas_ways"]
            assert low <= entry["bands"]["freed_gas"]["dissolves"] <= high
            assert entry["bands"]["all_over_intact"][0] <= entry["bands"]["seeds_over_intact"][0]
            assert entry["bands"]["freed_gas"]["stays"] == entry["bare_paper_model"]["dlc"]
            assert entry["scalar_factor"]["dlc"] > 0
    assert "fv" in result["assumed"]
    assert result["largest_difference_of_dlc_fmu_to_kernel"] == 0.0  # the same road, the same bits
    table = result["time_to_failure"]
    assert all(len(row) == len(table["oil_levels"]) for rows in table["freed_gas_ways"].values() for row in rows)
    for sentence in result["sentences"]:
        assert sentence in run.stdout
    pictures = {p.name for p in (tmp_path / "out").glob("*.png")}
    assert pictures == {"dlc_over_oil_level.png", "wheel_load.png", "spectrum.png", "development.png", "loops.png",
                        "volumes.png", "bands.png", "time_to_failure.png"}  # fmt: skip


def test_demo_answers_bad_input_with_one_line(tmp_path: Path) -> None:
    run = CliRunner().invoke(app, ["demo", "SA9", "--output", str(tmp_path / "x")])
    assert run.exit_code == 2
    assert run.stderr.startswith("error: unknown damper SA9")
    (tmp_path / "file").write_text("")
    run = CliRunner().invoke(app, ["demo", "--output", str(tmp_path / "file" / "x")])
    assert run.exit_code == 2
    assert run.stderr.count("\n") == 1


def test_a_damper_with_effects_is_driven_without_them_too(tmp_path: Path) -> None:
    plain, worn = load("SA8"), load("SA8").with_(wear_re=-0.3, wear_co=-0.3)
    off = strengths(worn)
    assert strengths(plain) == ()
    assert sum(case.off == off for case in cases(off)) == 18
    assert len(cases(())) == 18
    case = RideCase(50.0, 1.0, 1)
    route = track(50.0, 10.0)
    (tmp_path / "b").mkdir()
    platforms = (fmpy.platform,)
    fmu, extended = build_fmu(plain, tmp_path, platforms=platforms), build_fmu(worn, tmp_path / "b", platforms=platforms)
    car = load_car().corner(plain)
    base = ride(fmu, car, case, route)
    without = ride(extended, car, RideCase(50.0, 1.0, 1, off=off), route)
    assert (without.wheel_load == base.wheel_load).all()
    assert ride(extended, car, case, route).wheel_load.std() > 1.02 * base.wheel_load.std()
