"""Findings as text: one line a kind, with the other files; a first `columns` where a file's columns are not named."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat

from tests.data.conftest import RECORD, good
from twintube.data import Finding, check_dataset, report

NAMES = ("t_run", "weg", "kraft")


def test_findings_that_differ_in_their_numbers_share_a_line() -> None:
    several = [Finding("warning", f"{name}.csv", "force [N]", row, f"clipped: it stays at {x} N (3 such rows, the last is row 9)")
               for name, row, x in (("a", 3, 1e3), ("b", 5, -2.5), ("c", 7, 10), ("d", 1, 2), ("e", 1, 2))]  # fmt: skip
    (line,) = report(several).splitlines()
    assert line.startswith("warning: a.csv: row 3, column 'force [N]': clipped: it stays at 1000.0 N")
    assert line.endswith("(the like in 4 more files: b.csv, c.csv, d.csv and 1 more)")


@pytest.mark.parametrize("change", [{"severity": "error"}, {"column": "stroke [mm]"}, {"message": "unknown 'x2'"}])
def test_other_kinds_have_lines_of_their_own(change: dict[str, str]) -> None:
    first = {"severity": "warning", "file": "a.csv", "column": "", "row": None, "message": "unknown 'x1'"}
    assert len(report([Finding(**first), Finding(**(first | change))]).splitlines()) == 2  # type: ignore[arg-type]


def test_ten_equal_files_give_a_line_a_kind(tmp_path: Path) -> None:
    toml = 'title = "Ten"\ndamper = "SA8"\n'
    for i in range(10):
        values = dict(zip(NAMES, (np.arange(200) * 2.0, *np.random.default_rng(i).normal(size=(2, 200))), strict=True))
        savemat(tmp_path / f"run{i}.mat", values)
        toml += f'[[record]]\nfile = "run{i}.mat"\nmeasurement = "harmonic"\n'
    (tmp_path / "dataset.toml").write_text(toml)
    found = check_dataset(tmp_path).findings
    lines = report(found).splitlines()
    assert len(found) == 10 * len(lines) and len(lines) <= 6
    assert (
        "dataset.toml, line 3, gas_preload: record 1: gas_preload is missing; 'unknown' where nobody knows it (the like at "
        "9 more places: line 6" in lines[0]
    )
    assert any("no column 'time [s]'" in line and "did you mean t_run?" in line and "9 more files" in line for line in lines)
    assert any('columns = {"time [ms]" = "t_run", "stroke [mm]" = "weg", "force [kN]" = "kraft"}' in line for line in lines)


def test_a_column_that_rises_is_meant_by_time(folder: Callable[..., Path]) -> None:
    columns = {"Ti": good()["force [N]"], "Tout": good()["time [s]"], **{k: v for k, v in good().items() if "time" not in k}}
    (error,) = check_dataset(folder({"a.csv": columns})).errors
    assert "did you mean Tout?" in error.message


def test_names_without_units_give_the_key_to_set(folder: Callable[..., Path]) -> None:
    bare = {name.split(" [")[0]: values for name, values in good().items()}
    text = report(check_dataset(folder({"a.csv": bare})).findings)
    assert "no unit, must be like 'force [N]'" in text
    assert 'columns = {"time [s]" = "time", "stroke [mm]" = "stroke", "force [N]" = "force"}' in text


def test_a_place_in_dataset_toml_is_a_line(folder: Callable[..., Path]) -> None:
    toml = 'title = "T"\ndamper = "SA8"\n' + RECORD.format("a.csv") + "gas_presure = 3\n"
    (error,) = check_dataset(folder({"a.csv": good()}, toml=toml)).errors
    assert str(error).startswith("error: dataset.toml, line 8, gas_presure: record 1: unknown gas_presure")
