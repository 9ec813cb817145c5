"""Whether a velocity belongs to its stroke: the rule over whole records, and what `simulate` says."""

import warnings
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from tests.motions import RIGHT, WRONG, block, drive, noisy, sine
from twintube import load, simulate
from twintube.cli import app
from twintube.core.agreement import Agreement, followed, parted
from twintube.core.variables import blank
from twintube.engine.simulate import disagreement
from twintube.errors import InputWarning


def when(text: str) -> float:
    """The time [s] that a warning names."""
    return float(text.split()[1])


@pytest.mark.parametrize("name", RIGHT)
def test_right_inputs_agree(name: str) -> None:
    assert disagreement(*RIGHT[name]()) == ""


@pytest.mark.parametrize("wrong", WRONG)
@pytest.mark.parametrize("h", [1e-4, 1e-3, 1e-2, 4e-2])
@pytest.mark.parametrize(("amplitude", "frequency"), [(0.05, 2.0), (0.03, 1.2), (0.01, 1.5)])
def test_a_wrong_velocity_is_found_within_two_reversals(wrong: str, h: float, amplitude: float, frequency: float) -> None:
    t, z, v = sine(amplitude, frequency, h, 4.0 / frequency)
    text = disagreement(t, z, WRONG[wrong](v))
    assert text.endswith("check sign, unit and connection of velocity")
    assert when(text) <= 0.75 / frequency  # the second reversal


@pytest.mark.parametrize("h", [1e-3, 1e-2, 4e-2])
def test_a_stroke_that_is_not_connected_is_found(h: float) -> None:
    t, z, v = sine(0.05, 2.0, h, 2.0)
    assert "stroke went 0 m, velocity led" in disagreement(t, 0.0 * z, v)


@pytest.mark.parametrize("wrong", WRONG)
def test_an_error_that_comes_late_is_found_on_the_road(wrong: str) -> None:
    """Ten seconds of right inputs do not hide it for longer than some swings of the body."""
    t, z, v = drive(90.0)
    found = disagreement(t, z, np.where(t < 10.0, v, WRONG[wrong](v)))
    assert 10.0 < when(found) < 11.0


def test_a_long_rest_with_noise_hides_nothing() -> None:
    """Ten minutes of it, then a sine of half the velocity: found within two periods."""
    noise = 0.005 * np.random.default_rng(3).standard_normal(600_000)
    t, z, v = sine(0.05, 2.0, 1e-3, 2.0)
    time = np.arange(len(noise) + len(t)) * 1e-3
    text = disagreement(time, np.append(np.zeros(len(noise)), z), np.append(noise, 0.5 * v))
    assert 600.0 < when(text) < 601.0


def test_a_late_jump_of_the_stroke_is_found() -> None:
    """However far the damper went before it."""
    for last in np.arange(3.0, 3.5, 0.01):
        t, z, v = sine(0.05, 2.0, 1e-3, 4.0)
        assert when(disagreement(t, np.where(t > last, z + 0.035, z), v)) == pytest.approx(last, abs=2e-3)


def test_the_ways_of_a_warning_show_the_factor() -> None:
    """Up to the first reversal nothing is lost in the play."""
    t, z, v = sine(0.05, 2.0, 1e-4, 1.0)
    words = disagreement(t, z, 0.5 * v).split()
    assert float(words[words.index("led") + 1]) / float(words[words.index("went") + 1]) == pytest.approx(0.5, abs=1e-3)


def test_the_interpreter_finds_the_same() -> None:
    for factor in (1.0, -1.0, 0.5, 3.6):
        t, z, v = noisy(sine(0.03, 3.0, 2e-3, 1.0), stroke=0.005, velocity=0.005)
        assert disagreement(t, z, factor * v) == disagreement(t, z, factor * v, interpreted=True)


def test_a_record_has_the_numbers_of_one_that_follows() -> None:
    """Steps of no length, the longest ones and jumps leave a record that can be restored."""
    a = blank(Agreement)
    random = np.random.default_rng(2)
    for h in random.choice([0.0, 1e-4, 1e-3, 1.0, 1e12], 2000):
        found = parted(a, random.uniform(-1e4, 1e4), random.uniform(-1e3, 1e3), h)
        assert followed(a) == 1
        if found:  # after a warning nobody follows any more
            a = blank(Agreement)


@pytest.mark.parametrize("interpreted", [False, True])
def test_simulate_warns_once_where_the_caller_stands(interpreted: bool) -> None:
    t, z, v = sine(0.03, 2.0, 5e-3, 2.0)
    with pytest.warns(InputWarning, match="check sign, unit and connection of velocity") as said:
        simulate(load("SA8"), z, -v, t, interpreted=interpreted)
    assert len(said) == 1 and said[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        simulate(load("SA8"), z, v, t, interpreted=interpreted)
        simulate(load("SA8", as_published=True), z, -v)  # without times nothing says how far a velocity leads


@pytest.mark.parametrize("factor", [1.0, -1.0])
def test_the_command_warns_beside_its_result(tmp_path: Path, factor: float) -> None:
    t, z, v = block(0.524)
    table = np.column_stack([t, 1e3 * z, factor * 1e3 * v])
    record = tmp_path / "record.csv"
    np.savetxt(record, table, delimiter=",", header="time [s],stroke [mm],velocity [mm/s]", comments="")
    run = CliRunner().invoke(app, ["simulate", "SA8", "--record", str(record), "--output", str(tmp_path / "out.csv")])
    assert run.exit_code == 0, run.output
    wanted = [f"warning: {record}: time "] if factor < 0.0 else []
    assert [line[: len(wanted[0])] for line in run.stderr.splitlines()] == wanted
    assert (tmp_path / "out.csv").is_file()
