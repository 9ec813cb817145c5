"""`twintube car`: its figures, its page, the table beside an inspection, and bad input in a single line."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from twintube.cli import app
from twintube.report.conclusion import read_inspection, section

QUICK = ["car", "--maneuver", "braking", "--speed", "50", "--road-class", "smooth", "--oil-level", "0.5", "--seeds", "2"]


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
    assert len(content["drives"]) == 12  # two seeds: intact, four closures, scalar factor
    row = content["compared"][0]
    assert row["change_band"][0] <= row["change"] <= row["change_band"][1]
    page = (out / "car.html").read_text()
    assert "Seen in an inspection, felt on the road" in page and "stopping distance" in page
    assert (out / "car.png").read_bytes().startswith(b"\x89PNG")
    (table,) = section(read_inspection(inspection), content["compared"]).tables
    assert [cells[:3] for cells in table.rows] == [["50%", "full model", "20%"], ["50%", "scalar factor", "60%"]]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--maneuver", "drift"], "maneuver drift: must be one of ride, braking, cornering"),
        (["--road-class", "Z"], "road class Z: must be one of smooth, A"),
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
