"""The Python interface: names and signals in place of dampers and arrays work, what cannot work is said."""

import inspect
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib import pyplot
from typer.testing import CliRunner

import twintube
from twintube import InputError, ParameterError, build_fmu, diagnose, harmonic_block, identify, load, simulate
from twintube.cli import app
from twintube.dampers import to_toml
from twintube.errors import UserError

BLOCK = harmonic_block(1.2, 0.02)


def test_the_public_names_are_listed() -> None:
    assert dir(twintube) == sorted(twintube.__all__)


@pytest.mark.parametrize("function", [load, simulate, harmonic_block, build_fmu, identify, diagnose, twintube.Simulation])
def test_signatures_are_for_a_person(function: Callable[..., Any]) -> None:
    text = str(inspect.signature(function))
    assert not re.search(r"typing|numpy|collections|twintube\.|function|object", text)


@pytest.fixture(scope="module")
def result() -> twintube.Simulation:
    return simulate("SA1", BLOCK)


def test_a_simulation_has_time_units_and_a_table(result: twintube.Simulation) -> None:
    assert result.time is not None
    np.testing.assert_array_equal(result.time, BLOCK.time)
    frame = result.to_dataframe()
    assert frame.index.name == "time"
    assert list(frame) == ["stroke", "velocity", *result.columns]
    assert set(result.units) == {"time", *frame} and frame.attrs["units"]["V1_gas"] == "m3"
    np.testing.assert_array_equal(frame["force"], result.force)
    timeless = simulate(load("SA1", as_published=True), BLOCK.stroke, BLOCK.velocity)
    assert timeless.time is None and "time" not in timeless.to_dataframe() and len(timeless.plot().axes) == 2


def test_a_simulation_draws_itself_where_pyplot_shows_it(result: twintube.Simulation) -> None:
    drawn = result.plot()
    assert drawn is pyplot.gcf()
    assert {ax.get_xlabel() for ax in drawn.axes} == {"time [s]", "stroke [mm]", "velocity [m/s]"}
    assert all(re.search(r"\[.+\]", ax.get_ylabel()) for ax in drawn.axes)
    assert len(twintube.plot(result).axes) == len(drawn.axes)
    pyplot.close("all")
    with pytest.raises(TypeError, match="int has no picture"):
        twintube.plot(3)


def test_texts_of_results_are_short(result: twintube.Simulation) -> None:
    assert repr(load("SA1").with_(oil_level=0.6, gas_preload=0)).endswith("60 % oil, gas lost>")
    for shown in (result, BLOCK, load("SA1")):
        assert len(repr(shown)) < 150 and "\n" not in repr(shown)
    assert "J dissipated" in repr(result)


def test_a_table_without_pandas_says_what_to_install(monkeypatch: pytest.MonkeyPatch, result: twintube.Simulation) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(UserError, match="the package pandas is not installed"):
        result.to_dataframe()


def test_a_name_a_file_and_a_signal_stand_for_what_they_hold(tmp_path: Path) -> None:
    path = tmp_path / "own.toml"
    path.write_text(to_toml(load("SA3")))
    loaded = load("SA3")
    expected = simulate(loaded, BLOCK.stroke, BLOCK.velocity, BLOCK.time).force
    for damper in ("SA3", path, str(path)):
        np.testing.assert_array_equal(simulate(damper, BLOCK).force, expected)
    assert load(loaded) is loaded


WRONG: dict[str, tuple[type[Exception], str, Callable[[], Any]]] = {
    "another name": (ParameterError, "unknown damper SA12: .*", lambda: simulate("SA12", BLOCK)),
    "no damper": (ParameterError, "damper is a Signal: must be a Damper, a name, or the path", lambda: simulate(BLOCK, 0.0)),
    "no velocity": (InputError, "velocity is missing: .* or a signal", lambda: simulate("SA1", BLOCK.stroke)),
    "an FMU of another name": (ParameterError, "unknown damper SA12", lambda: build_fmu("SA12")),
    "an FMU of nothing": (ParameterError, "damper is a NoneType: must be", lambda: build_fmu(None)),
    "a damper to identify": (InputError, "path is a Damper: must be that of a folder with", lambda: identify(load("SA1"))),
    "a signal to diagnose": (InputError, "path is a Signal: must be that of a folder with", lambda: diagnose(BLOCK)),
    "mm/s": (InputError, r"velocity = 250 m/s: must be a number from 0\.001 to 20 m/s", lambda: harmonic_block(250)),
    "backwards": (InputError, "velocity = -0.3 m/s: must be a number from 0", lambda: harmonic_block(-0.3)),
    "not a number": (InputError, "velocity = nan m/s", lambda: harmonic_block(np.nan)),
    "mm": (InputError, r"amplitude = 30 m: must be a number from 0\.0001 to 0\.5 m", lambda: harmonic_block(0.3, 30)),
    "hours": (
        InputError,
        "an oscillation of 300 mm at 0.001 m/s takes 1885 s: at most 30 s",
        lambda: harmonic_block(1e-3, 0.3),
    ),
    "a step of nothing": (InputError, "dt = 0 s: must be above 0", lambda: harmonic_block(0.3, dt=0.0)),
    "another start": (InputError, "start = 'left': must be one of rebound, top", lambda: harmonic_block(0.3, start="left")),
    "percent": (
        ParameterError,
        r"oil_level = 1\.2: must be a number from 0 to 1",
        lambda: load("SA1").with_(oil_level="120 %"),
    ),
    "another quantity": (
        ParameterError,
        "SA1: geometry.D_PR: '3 kg' is not a quantity in m",
        lambda: load("SA1").with_(D_PR="3 kg"),
    ),
    "a word": (ParameterError, "SA1: gas_preload: 'lost' is not a quantity", lambda: load("SA1").with_(gas_preload="lost")),
    "nothing": (ParameterError, "SA1: oil_level: None is not a number", lambda: load("SA1").with_(oil_level=None)),
}


@pytest.mark.parametrize("kind", WRONG)
def test_wrong_input_is_refused_in_one_line(kind: str) -> None:
    error, message, call = WRONG[kind]
    with pytest.raises(error, match=message) as caught:
        call()
    assert "\n" not in str(caught.value)


def test_with_takes_quantities() -> None:
    p = load("SA1").with_(oil_level="60 %", D_PR="21.5 mm", gas_preload=False).parameters
    assert (p.oil_level, p.D_PR, p.gas_preload) == (0.6, 0.0215, 0)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--velocity", "250"], "velocity = 250 m/s: must be a number from 0.001 to 20 m/s"),
        (["--amplitude-mm", "700"], "amplitude = 0.7 m: must be a number from 0.0001 to 0.5 m"),
        (["--record", "bench/none.csv"], "bench/none.csv: the file does not exist"),
    ],
)
def test_the_command_says_the_same(arguments: list[str], message: str) -> None:
    done = CliRunner().invoke(app, ["simulate", "SA1", *arguments])
    assert (done.exit_code, done.stderr) == (2, f"error: {message}\n")


@pytest.mark.skipif(sys.platform == "win32", reason="pipes of POSIX")
@pytest.mark.parametrize("arguments", [["dampers"], ["--help"]])
def test_a_reader_that_has_enough_is_no_error(arguments: list[str]) -> None:
    with subprocess.Popen(
        [sys.executable, "-m", "twintube", *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as run:
        assert run.stdout is not None and run.stderr is not None
        run.stdout.close()
        assert run.stderr.read() == ""
