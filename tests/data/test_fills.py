"""The fill in dataset.toml: stated or unknown, of one state or several; what needs it stated says so."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from tests.data.conftest import good
from twintube import load
from twintube.cli import app
from twintube.data import Record, check_dataset, load_dataset
from twintube.diagnosis.records.prepare import prepare
from twintube.engine.simulate import InputError

Make = Callable[..., Path]
RUNNER = CliRunner()
NOBODY = "oil_level = 'unknown'\ngas_preload = 'unknown'\n"
FULL = "oil_level = 1\ngas_preload = true\n"
HALF = "oil_level = 0.5\ngas_preload = false\n"
VOLUME = f"oil_volume_mL = {0.5e6 * load('SA8').parameters.V_oil:.9g}\ngas_preload = false\n"
A, B = "state = 'a'\n", "state = 'b'\n"


def written(folder: Make, *fills: str) -> Path:
    """A dataset with a record for each of the texts of its keys; the first begins in line 3, its fill in line 6."""
    toml = 'title = "Test"\ndamper = "SA8"\n'
    for i, fill in enumerate(fills):
        toml += f'[[record]]\nfile = "{i}.csv"\nmeasurement = "harmonic"\n{fill}'
    return folder({f"{i}.csv": good(1501 + i) for i in range(len(fills))}, toml=toml)


def read(folder: Make, *fills: str) -> list[Record]:
    return load_dataset(written(folder, *fills)).records


def test_a_fill_may_be_unknown(folder: Make) -> None:
    (record,) = read(folder, NOBODY)
    assert (record.oil_level, record.gas_preload, record.unknown) == (None, None, ["oil_level", "gas_preload"])
    with pytest.raises(InputError, match=r"record 0\.csv: oil_level and gas_preload are unknown"):
        _ = record.fill


def test_one_half_of_it_may_be_unknown(folder: Make) -> None:
    level, gas = read(folder, HALF.replace("false", "'unknown'"), FULL.replace("1", "'unknown'"))
    assert (level.oil_level, level.unknown) == (0.5, ["gas_preload"])
    assert (gas.gas_preload, gas.unknown) == (True, ["oil_level"])
    assert level.state != gas.state


@pytest.mark.parametrize(
    ("fills", "expected"),
    [
        ([NOBODY + A, HALF + A], [(0.5, False, "a")] * 2),  # what one states holds for all, before it and after it
        ([HALF + A, NOBODY + A, NOBODY + B], [(0.5, False, "a")] * 2 + [(None, None, "b")]),
        ([VOLUME + A, HALF + A], [(0.5, False, "a")] * 2),
        ([HALF.replace("0.5", "'unknown'") + A, HALF.replace("false", "'unknown'") + A], [(0.5, False, "a")] * 2),
        ([NOBODY, NOBODY], [(None, None, "1")] * 2),  # they follow each other
        ([NOBODY, FULL, NOBODY], [(None, None, "1"), (1.0, True, "2"), (None, None, "3")]),
        ([NOBODY, HALF + A, NOBODY], [(None, None, "1"), (0.5, False, "a"), (None, None, "2")]),
        ([FULL, HALF, FULL], [(1.0, True, "1"), (0.5, False, "2"), (1.0, True, "1")]),
        ([NOBODY + "reference = true\n", NOBODY], [(None, None, "1"), (None, None, "2")]),
        ([FULL + "reference = true\n", FULL], [(1.0, True, "1"), (1.0, True, "2")]),
        ([NOBODY + "state = '1'\n", NOBODY], [(None, None, "1"), (None, None, "2")]),  # a made name is nobody's label
    ],
)
def test_records_of_a_state_share_what_is_stated(folder: Make, fills: list[str], expected: list[Any]) -> None:
    found = [(r.oil_level, r.gas_preload, r.state) for r in read(folder, *fills)]
    assert [(level if level is None else pytest.approx(level), *rest) for level, *rest in expected] == found


def test_a_stated_pressure_holds_for_the_state(folder: Make) -> None:
    records = read(folder, FULL + "gas_pressure = '10 bar'\n" + A, NOBODY + A)
    assert [record.gas_pressure for record in records] == [pytest.approx(1e6)] * 2


@pytest.mark.parametrize(
    ("fills", "line", "message"),
    [
        ([HALF + A, FULL + A], 12, "record 2: oil_level = 1 contradicts oil_level = 0.5 of 0.csv, both are of state = 'a'"),
        ([HALF + A, FULL + A], 13, "record 2: gas_preload = true contradicts gas_preload = false of 0.csv"),
        ([NOBODY + A, FULL + A, "oil_volume_mL = 30\ngas_preload = true\n" + A], 18, "oil_volume_mL = 30 (oil_level 0."),
        ([FULL + "gas_pressure = '10 bar'\n" + A, FULL + "gas_pressure = '150 psi'\n" + A], 15,
         "gas_pressure = 10.3421 bar contradicts gas_pressure = 10 bar of 0.csv"),
        ([NOBODY + "gas_pressure = '10 bar'\n"], 8, "must be left out where gas_preload = 'unknown'"),
        ([NOBODY + "oil_volume_mL = 150\n"], 3, "oil_level or oil_volume_mL both are given"),
        (["oil_volume_mL = 'unknown'\ngas_preload = true\n"], 6, "where nobody knows it, oil_level = 'unknown' instead"),
        (["oil_level = 'unkown'\ngas_preload = true\n"], 6, "oil_level = 'unkown': must be a number from 0 to 1, the share"),
        (["oil_level = 1\ngas_preload = '?'\n"], 7, "gas_preload = '?': must be true (present), false (lost), a share from 0 to 1 or 'unknown'"),
        (["gas_preload = true\n"], 3, "must be one of the two; oil_level = 'unknown' where nobody knows it"),
        (["oil_level = 1\n"], 3, "gas_preload is missing; 'unknown' where nobody knows it"),
        ([NOBODY + "state = 1\n"], 8, "state = 1: must be a text like"),
        ([NOBODY + "state = 'a '\n"], 8, "state = 'a ': must be a text like"),
        ([NOBODY + f"state = '{'a' * 41}'\n"], 8, "of at most 40 characters"),
    ],
)  # fmt: skip
def test_what_contradicts_is_refused_with_its_line(folder: Make, fills: list[str], line: int, message: str) -> None:
    errors = check_dataset(written(folder, *fills)).errors
    (hit,) = [error for error in errors if message in error.message]
    assert (hit.file, hit.row) == ("dataset.toml", line)


def test_check_says_what_is_unknown(folder: Make) -> None:
    run = RUNNER.invoke(app, ["check", str(written(folder, FULL, NOBODY, NOBODY, HALF.replace("false", "'unknown'")))])
    assert run.exit_code == 0, run.output
    assert "unknown: oil level and gas preload of 1.csv, 2.csv (state 2), gas preload of 3.csv (state 3)" in run.output


def test_what_needs_a_fill_says_so_and_writes_nothing(folder: Make, tmp_path: Path) -> None:
    path = written(folder, FULL, NOBODY)
    run = RUNNER.invoke(app, ["identify", str(path), "--output", str(tmp_path / "out")])
    assert run.exit_code == 2
    assert "record 1.csv: oil_level and gas_preload are unknown; " in run.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ([], "100 % oil (assumed, it is unknown there), gas kept (assumed, it is unknown there)"),
        (["--oil-level", "0.7"], "70 % oil, gas kept (assumed, it is unknown there)"),
        (["--oil-level", "0.7", "--gas-lost"], "70 % oil, gas lost\n"),
        (["--gas", "0.4"], "100 % oil (assumed, it is unknown there), gas at 40 %\n"),
    ],
)
def test_a_simulation_says_what_it_assumed(folder: Make, options: list[str], said: str) -> None:
    path = written(folder, NOBODY)
    run = RUNNER.invoke(app, ["simulate", "--record", str(path / "0.csv"), "--output", str(path / "o.csv"), *options])
    assert run.exit_code == 0, run.output
    assert f"as its dataset.toml says: SA8, {said}" in run.output


def test_a_preload_may_be_a_share(folder: Make) -> None:
    """A simulation takes it, and so does a diagnosis."""
    path = written(folder, HALF.replace("false", "0.4"), HALF.replace("false", "0"))
    run = RUNNER.invoke(app, ["simulate", "--record", str(path / "0.csv"), "--output", str(path / "o.csv")])
    assert "SA8, 50 % oil, gas at 40 %\n" in run.output
    run = RUNNER.invoke(app, ["simulate", "--record", str(path / "1.csv"), "--output", str(path / "o.csv")])
    assert "SA8, 50 % oil, gas lost\n" in run.output
    assert [record.gas_preload for record in prepare(load_dataset(path))] == [0.4, 0.0]
    path = written(folder, HALF.replace("false", "1.4"))
    run = RUNNER.invoke(app, ["check", str(path)])
    assert "gas_preload = 1.4: must be true (present), false (lost), a share from 0 to 1 or 'unknown'" in run.output


def test_a_simulation_takes_the_fill_that_another_record_of_the_state_states(folder: Make) -> None:
    path = written(folder, NOBODY + A, HALF + A)
    run = RUNNER.invoke(app, ["simulate", "--record", str(path / "0.csv"), "--output", str(path / "o.csv")])
    assert "SA8, 50 % oil, gas lost\n" in run.output
