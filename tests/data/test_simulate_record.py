"""`twintube simulate --record`: a listed record is read as its dataset.toml says, and compared with the simulation."""

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from tests.data.conftest import RECORD, as_csv, good
from twintube import load, simulate
from twintube.cli import app
from twintube.dampers import to_toml
from twintube.dampers.freed_gas import with_freed_gas
from twintube.report.simulated_record import deviation
from twintube.rig.signals import harmonic_block

Make = Callable[..., Path]
RUNNER = CliRunner()


def test_a_listed_record_needs_no_arguments(folder: Make, tmp_path: Path) -> None:
    """A record of the model itself, with the signs of another rig, agrees but for a zero of 5 N."""
    c = good()
    stroke, velocity = c["stroke [mm]"] / 1e3, c["velocity [mm/s]"] / 1e3
    damper = load("SA7").with_(oil_level=0.6, gas_preload=0)
    force = simulate(damper, stroke, velocity, c["time [s]"]).force
    text = as_csv({"t": c["time [s]"], "z": -c["stroke [mm]"], "v": -c["velocity [mm/s]"], "F": -(force - 5.0)})
    toml = 'damper = "SA7"\nforce_sign = -1\nstroke_sign = -1\n' + RECORD.format("a.csv").replace("0.56", "0.6")
    toml += 'columns = {"time [s]" = "t", "stroke [mm]" = "z", "velocity [mm/s]" = "v", "force [N]" = "F"}\n'
    path = folder({"a.csv": text}, toml=toml)
    arguments = ["simulate", "--record", str(path / "a.csv"), "--output", str(tmp_path / "out.csv")]
    run = RUNNER.invoke(app, [*arguments, "--plot", str(tmp_path / "out.png")])
    assert run.exit_code == 0, run.output
    assert "as its dataset.toml says: SA7, 60 % oil, gas lost" in run.output
    assert re.search(
        r"measured against simulated: 5\.0 N RMSE, \d\.\d% of the peak of \d+ N; .* mean is \+5\.0 N off", run.output
    )
    work = re.search(r"work per cycle: measured (\S+) J, simulated (\S+) J", run.output)
    assert work is not None
    assert float(work[1]) == pytest.approx(float(work[2]), abs=0.02)
    assert (tmp_path / "out.csv").read_text(encoding="utf-8").splitlines()[0].endswith(",measured_force [N]")
    assert (tmp_path / "out.png").read_bytes().startswith(b"\x89PNG")
    intact = RUNNER.invoke(app, [*arguments, "--oil-level", "1", "--gas-kept"])
    assert "SA7, 100 % oil, gas kept" in intact.output


def test_what_it_needs_without_a_dataset(folder: Make) -> None:
    path = folder({"a.csv": good()})
    (path / "b.csv").write_text(as_csv(good()), encoding="utf-8")
    run = RUNNER.invoke(app, ["simulate", "--record", str(path / "b.csv"), "--output", str(path / "o.csv")])
    assert run.exit_code == 2
    assert "names it; name a damper, e.g. twintube simulate SA8" in run.output
    run = RUNNER.invoke(app, ["simulate", "SA8", "--record", str(path / "b.csv"), "--output", str(path / "o.csv")])
    assert run.exit_code == 0, run.output
    assert "measured against simulated: " in run.output


def test_an_error_of_the_record_is_said_and_one_of_another_is_not(folder: Make) -> None:
    bad = good()
    bad["force [N]"] = -bad["force [N]"]
    path = folder({"a.csv": good(), "b.csv": bad})
    for name, status in (("a.csv", 0), ("b.csv", 2)):
        run = RUNNER.invoke(app, ["simulate", "--record", str(path / name), "--output", str(path / f"{name}.out")])
        assert run.exit_code == status, run.output
    assert "error: b.csv: row " in run.output
    assert "force_sign = -1" in run.output
    assert not (path / "b.csv.out").exists()


def test_samples_that_are_not_usable_do_not_count() -> None:
    t = np.linspace(0.0, 3.0, 3001)
    stroke, force = 0.03 * np.sin(2 * np.pi * t), 500.0 * np.cos(2 * np.pi * t)
    measured = force.copy()
    measured[1000:1100] = 9999.0
    usable = measured < 9999.0
    result = deviation(stroke, measured, force + 3.0, usable)
    assert (result.rmse, result.mean) == (pytest.approx(3.0), pytest.approx(3.0))
    assert result.peak == pytest.approx(500.0, rel=1e-3)
    assert result.simulated_work == pytest.approx(result.measured_work, rel=0.03)


def said(arguments: list[str]) -> tuple[str, str]:
    """What `simulate` prints of the measured force, and of the freed gas."""
    run = RUNNER.invoke(app, ["simulate", *arguments])
    assert run.exit_code == 0, run.output
    (gas,) = re.findall(r"freed gas: (\w+)", run.output)
    return run.output[run.output.index("measured against simulated") :], gas


@pytest.mark.parametrize("way", ["dissolves", "stays", "limited"])
@pytest.mark.parametrize("noise", [0.0, 2e-5])
def test_a_dataset_toml_beside_a_file_changes_nothing(tmp_path: Path, way: str, noise: float) -> None:
    """Above the speed of cavitation, where freed gas decides: force and measured work, by what the parameter file says."""
    (tmp_path / "mine.toml").write_text(to_toml(with_freed_gas(load("SA8"), way)))
    block = harmonic_block(1.048, dt=2e-3)
    worn = load(tmp_path / "mine.toml").with_(oil_level=0.7, gas_preload=0)
    stroke = block.stroke + np.random.default_rng(1).normal(0.0, noise, len(block.time))
    columns = {"time [s]": block.time, "stroke [mm]": 1e3 * stroke, "force [N]": simulate(worn, block).force}
    (tmp_path / "block.csv").write_text(as_csv(columns))
    alone, listed = tmp_path / "alone.csv", tmp_path / "listed.csv"
    arguments = [str(tmp_path / "mine.toml"), "--record", str(tmp_path / "block.csv"), "--oil-level", "0.7", "--gas-lost"]
    without, gas = said([*arguments, "--output", str(alone)])
    assert gas == way
    entry = RECORD.format("block.csv").replace("0.56", "0.7")
    (tmp_path / "dataset.toml").write_text(f'damper = "mine.toml"\n{entry}')
    assert said([*arguments[1:3], "--output", str(listed)]) == (without, way)
    assert listed.read_text() == alone.read_text()
    works = [float(x) for x in re.findall(r"(\d+\.\d+) J", without)]
    assert works[0] == pytest.approx(works[1], rel=0.02)


def test_a_record_has_its_own_temperatures(tmp_path: Path) -> None:
    """A column is taken where it is asked for, and each sample holds until the next."""
    block = harmonic_block(0.524, dt=2e-3)
    warm = np.linspace(0.0, 60.0, len(block.time))
    damper = load("SA8")
    force = simulate(damper, block, temperature=warm + 273.15).force
    columns = {"time [s]": block.time, "stroke [mm]": 1e3 * block.stroke, "velocity [mm/s]": 1e3 * block.velocity}
    files = {"motion": {}, "record": {"force [N]": force}}
    for name, more in files.items():
        (tmp_path / f"{name}.csv").write_text(as_csv({**columns, **more, "temperature [degC]": warm}))
        arguments = ["simulate", "SA8", "--record", str(tmp_path / f"{name}.csv"), "--output", str(tmp_path / "o.csv")]
        run = RUNNER.invoke(app, [*arguments, "--temperature", "column"])
        assert run.exit_code == 0, run.output
        assert "SA8, 100 % oil, gas kept, temperatures of the record" in run.output
        names = (tmp_path / "o.csv").read_text().partition("\n")[0].split(",")
        table = np.loadtxt(tmp_path / "o.csv", delimiter=",", skiprows=1)
        np.testing.assert_allclose(table[:, names.index("temperature [K]")], warm + 273.15)
        np.testing.assert_allclose(table[:, names.index("force [N]")], force, rtol=0, atol=2.0)
    error = re.search(r"measured against simulated: (\S+) N RMSE", run.output)
    assert error is not None and float(error[1]) < 0.5
    plain = RUNNER.invoke(app, arguments)
    error = re.search(r"measured against simulated: (\S+) N RMSE", plain.output)
    assert error is not None and float(error[1]) > 20.0  # as if it were at 23 degC all the time


def test_a_temperature_is_a_number_or_the_column(tmp_path: Path) -> None:
    (tmp_path / "motion.csv").write_text("time [s],stroke [mm]\n" + "".join(f"{i / 100},{i / 10}\n" for i in range(50)))
    plain = ["simulate", "SA8", "--output", str(tmp_path / "o.csv")]
    record = ["--record", str(tmp_path / "motion.csv")]
    cases = [
        ([*record, "--temperature", "column"], "is the column of temperatures of a record; .*motion.csv has none"),
        (["--temperature", "column"], "is the column of temperatures of a record; a block has none, give --record"),
        (["--temperature", "warm"], "--temperature warm: must be a number of degC, or column"),
        (["--temperature", "-400"], "--temperature = -400 degC: must be a number from -123.15 to 226.85 degC"),
        (["--temperature", "nan"], "--temperature = nan degC: must be a number from -123.15 to 226.85 degC"),
    ]
    for options, said in cases:
        run = RUNNER.invoke(app, [*plain, *options])
        assert run.exit_code == 2 and re.search(said, run.stderr), run.stderr
    run = RUNNER.invoke(app, [*plain, *record, "--temperature", "-10", "--for-fmu"])
    assert run.exit_code == 0, run.output
    assert "SA8, 100 % oil, gas kept, -10 degC\n" in run.output
    assert (tmp_path / "o.csv").read_text().startswith("time,stroke,velocity,temperature,force,")
    run = RUNNER.invoke(app, [*plain, *record, "--temperature", "-40"])
    assert run.exit_code == 0 and "warning: " in run.stderr and "holds from 243.15 to 353.15 K" in run.stderr
