"""A dead length that the parts of a car's damper do not take is refused, unless somebody measured it and says so."""

import re
import warnings
from pathlib import Path

import pytest
from typer.testing import CliRunner

from twintube import load
from twintube.cli import app
from twintube.dampers import ParameterError, to_toml

GOOD = to_toml(load("SA4"))
MEASURED = '"geometry.dead_length" = "measured on the dismantled damper"'


def file(folder: Path, length: str, *, source: str = "", assumed: bool = True) -> Path:
    text = re.sub(r"^dead_length = \S+", f"dead_length = {length}", GOOD, flags=re.MULTILINE)
    text = text.replace("[sources]", f"[sources]\n{source}")
    head, rest = text.split("[assumed]")
    rest = rest if assumed else re.sub(r'^"geometry\.dead_length" = .*$', "", rest, flags=re.MULTILINE)
    path = folder / "own.toml"
    path.write_text(f"{head}[assumed]{rest}")
    return path


@pytest.mark.parametrize("length", ["0.02", "0.0599", '"112 mm"', "0.117", "0.0"])
@pytest.mark.parametrize("assumed", [True, False])
def test_an_assumed_one_outside_the_parts_is_refused_with_the_reason(tmp_path: Path, length: str, assumed: bool) -> None:
    path = file(tmp_path, length, assumed=assumed)
    said = r"own\.toml: line \d+: geometry\.dead_length = [\d.]+ m: must be from 0\.06 to 0\.11 m, which piston with valves"
    with pytest.raises(ParameterError, match=said) as error:
        load(path)
    assert ("delete it under [assumed]" in str(error.value)) == assumed


@pytest.mark.parametrize("length", ["0.06", '"110 mm"', "0.093"])
def test_one_within_the_parts_is_read_without_a_word(tmp_path: Path, length: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        load(file(tmp_path, length))


@pytest.mark.parametrize("length", [0.02, 0.112])
def test_a_measured_one_is_read_and_written_again(tmp_path: Path, length: float) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        damper = load(file(tmp_path, f"{length}", source=MEASURED, assumed=False))
        again = tmp_path / "again.toml"
        again.write_text(to_toml(damper))
        assert load(again).parameters.dead_length == damper.parameters.dead_length == length


def test_what_is_measured_and_assumed_at_once_is_assumed(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match=r"delete it under \[assumed\]"):
        load(file(tmp_path, "0.112", source=MEASURED))


@pytest.mark.parametrize("length", ["0.2", "0.18"])
def test_a_measured_one_leaves_room_for_the_stroke(tmp_path: Path, length: str) -> None:
    with pytest.raises(ParameterError, match=r"half of h_l - dead_length"):
        load(file(tmp_path, length, source=MEASURED, assumed=False))


def test_a_command_ends_with_one_line_and_leaves_no_file(tmp_path: Path) -> None:
    path, out = file(tmp_path, "0.045"), tmp_path / "out.csv"
    done = CliRunner().invoke(app, ["simulate", str(path), "--output", str(out)])
    assert done.exit_code == 2 and done.stderr.count("\n") == 1
    assert done.stderr.startswith("error: own.toml: line ") and not out.exists()
