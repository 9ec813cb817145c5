"""Text files of benches that need no conversion: each gives the numbers of a plain file, or the true reason and a key."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from tests.data.conftest import RECORD, as_csv, good
from twintube.cli import app
from twintube.common.words import short
from twintube.data import Record, check_dataset, load_dataset

Make = Callable[..., Path]
T, Z, F = "time [s]", "stroke [mm]", "force [N]"
HEAD = 'damper = "SA8"\n'
RUNNER = CliRunner()


def plain() -> dict[str, Any]:
    return {name: good()[name] for name in (T, Z, F)}


def single(path: Path) -> Record:
    (record,) = load_dataset(path).records
    return record


def is_good(record: Record, factor: float = 1.0) -> None:
    c = plain()
    np.testing.assert_allclose(record.time - record.time[0], c[T], atol=1e-9)
    np.testing.assert_allclose(record.stroke, factor * c[Z] / 1e3, rtol=2e-5, atol=1e-8)
    np.testing.assert_allclose(record.force, c[F], rtol=2e-5, atol=1e-3)


def body(*columns: Any, sep: str = ",", decimal: str = ".") -> str:
    return "".join(
        sep.join(x if isinstance(x, str) else f"{x:.9g}".replace(".", decimal) for x in row) + "\n"
        for row in zip(*columns, strict=True)
    )


def said(path: Path) -> str:
    return "\n".join(map(str, check_dataset(path).findings))


def new_dataset(tmp_path: Path, text: str, name: str) -> Path:
    """The folder that new-dataset makes of one file."""
    source = tmp_path / "source" / name
    source.parent.mkdir(exist_ok=True)
    source.write_bytes(text.encode())
    state = ["--oil-level", "0.56", "--gas-lost", "SA8"]
    run = RUNNER.invoke(app, ["new-dataset", str(tmp_path / "new"), "--from", str(source), *state])
    assert run.exit_code == 0, run.output
    return tmp_path / "new"


def every(rows: list[str], blank: str, step: int, count: int = 1) -> str:
    """A blank row, or several, after each `step` rows."""
    parts = [row + (blank * count if i % step == step - 1 else "") for i, row in enumerate(rows)]
    return "".join(parts)


@pytest.mark.parametrize(
    ("blank", "step", "count", "number"),
    [("\n", 1, 1, 1501), ("\n", 500, 7, 21), (",,\n", 3, 1, 500), ("  \n", 2, 1, 750), (" , ,\t\n", 50, 2, 60)],
)
def test_blank_rows_are_skipped(  # noqa: PLR0917 - pytest names them
    folder: Make, tmp_path: Path, blank: str, step: int, count: int, number: int
) -> None:
    text = every(as_csv(plain()).splitlines(keepends=True), blank, step, count)
    path = folder({"a.csv": text})
    is_good(single(path))
    found = said(path)
    assert found.count("blank row") == 1
    assert f"skipped {number} blank rows between the others" in found or step == 1
    is_good(single(new_dataset(tmp_path, text, "a.csv")))


def test_rows_of_separators_do_not_count_in_a_sample_rate(folder: Make) -> None:
    c = plain()
    text = every([f"{Z},{F}\n", *body(c[Z], c[F]).splitlines(keepends=True)], ",\n", 40)
    path = folder({"a.csv": text}, HEAD + "sample_rate_Hz = 500")
    assert "warning: a.csv: row 41: skipped 37 blank rows between the others; times by sample_rate_Hz do not" in said(path)


LVM = (
    "LabVIEW Measurement{s}\nWriter_Version{s}2\nReader_Version{s}2\nSeparator{s}{separator}\nDecimal_Separator{s}{d}\n"
    "Multi_Headings{s}Yes\nX_Columns{s}{x}\nTime_Pref{s}Relative\nDate{s}2026/03/02\n***End_of_Header***{s}\n{s}\n"
)
SEGMENT = (
    "Channels{s}2{s}{s}\nSamples{s}1501{s}1501{s}\nDate{s}2026/03/02{s}2026/03/02{s}\nY_Unit_Label{s}{units}{s}\n"
    "X_Dimension{s}Time{s}Time{s}\nX0{s}0{d}0E+0{s}0{d}0E+0{s}\nDelta_X{s}0{d}002{s}0{d}002{s}\n***End_of_Header***{s}{s}{s}\n"
)


def lvm(x: str, sep: str = "\t", d: str = ".", names: str = "Weg Kraft", units: str = "mm N", *, segments: int = 1) -> str:
    c = plain()
    texts = {name: [f"{v:.9g}".replace(".", d) for v in c[name]] for name in c}
    columns = {
        "No": [[""] * 1501, texts[Z], texts[F]],
        "One": list(texts.values()),
        "Multi": [texts[T], texts[Z], texts[T], texts[F]],
    }
    first, second = names.split()
    over = ["X_Value", first, "X_Value", second] if x == "Multi" else ["X_Value", first, second]
    part = (
        SEGMENT.format(s=sep, d=d, units=units.replace(" ", sep))
        + sep.join([*over, "Comment"])
        + "\n"
        + body(*columns[x], sep=sep)
    )
    head = LVM.format(s=sep, d=d, x=x, separator="Tab" if sep == "\t" else "Comma")
    return head + "\n".join([part] * segments)


@pytest.mark.parametrize("x", ["No", "One", "Multi"])
@pytest.mark.parametrize(("sep", "d"), [("\t", "."), ("\t", ","), (",", ".")])
def test_labview(folder: Make, tmp_path: Path, x: str, sep: str, d: str) -> None:
    text = lvm(x, sep, d)
    for name in ("a.lvm", "a.txt"):
        path = folder({name: text})
        is_good(single(path))
        assert "time [s] from 'X_Value', stroke [mm] from 'Weg', force [N] from 'Kraft'" in said(path)
    is_good(single(new_dataset(tmp_path, text, "a.lvm")))


def test_a_file_that_no_dataset_names(tmp_path: Path) -> None:
    (tmp_path / "a.lvm").write_text(lvm("No"))
    (tmp_path / "b.csv").write_text(",".join(plain()) + "\n" + body(*plain().values()))
    for name in ("a.lvm", "b.csv"):
        run = RUNNER.invoke(
            app, ["simulate", "SA8", "--record", str(tmp_path / name), "--output", str(tmp_path / f"{name}.csv")]
        )
        assert run.exit_code == 0, run.output
        assert ("stroke [mm] from 'Weg'" in run.output) == (name == "a.lvm")
    first, second = (np.loadtxt(tmp_path / f"{name}.csv", delimiter=",", skiprows=1) for name in ("a.lvm", "b.csv"))
    np.testing.assert_allclose(first, second, rtol=1e-5, atol=1e-3)


def test_labview_segments_and_doubts(folder: Make, tmp_path: Path) -> None:
    path = folder({"a.lvm": lvm("One", segments=3)})
    assert "the file has 3 blocks, which begin in rows 12, 1523, 3034: set block" in said(path)
    is_good(load_dataset(folder({}, toml=HEAD + RECORD.format("a.lvm") + "block = 3\n")).records[0])
    assert len(load_dataset(new_dataset(tmp_path, lvm("No", segments=2), "a.lvm")).records) == 2
    path = folder({"a.lvm": lvm("One", names="Soll Ist", units="N N")})
    assert "no column 'stroke [mm]' among X_Value, Soll, Ist" in said(path)
    path = folder({"a.lvm": lvm("No").replace("Delta_X\t0.002\t0.002", "Delta_X\t0.002\t0.004")})
    assert "Delta_X = 0.002, 0.004: must be one number for all channels" in said(path)
    path = folder({"a.lvm": lvm("Multi").replace("0.004\t", "0.0041\t", 1)})
    assert "'X_Value 2' has other times than 'X_Value'; nothing is resampled here" in said(path)
    path = folder({"a.lvm": lvm("One")[:300]})
    assert "a.lvm: row 12: the head of a segment has no ***End_of_Header***" in said(path)
    path = folder({"a.lvm": lvm("One").replace("1.998\t", "1.998\tx", 1)})
    assert "a.lvm: row 1020, column 'stroke [mm]': 'x" in said(path)


@pytest.mark.parametrize(
    ("ending", "sep"),
    [
        (".asc", "\t"),
        (".ASC", ";"),
        (".dat", "\t"),
        (".prn", "\t"),
        (".out", ";"),
        (".tab", "\t"),
        (".tsv", "\t"),
        (".txt", ";"),
    ],
)
def test_endings_of_text(folder: Make, tmp_path: Path, ending: str, sep: str) -> None:
    text = sep.join(plain()) + "\n" + body(*plain().values(), sep=sep)
    top = HEAD if sep == "\t" else HEAD + 'delimiter = ";"'
    is_good(single(folder({f"a{ending}": text}, top)))
    is_good(single(new_dataset(tmp_path, text, f"a{ending}")))


def machine(head: str, names: str, units: str, factors: tuple[float, ...], sep: str = "\t") -> str:
    c = plain()
    return "".join(head + names + units + body(c[T], k * c[Z], c[F], sep=sep) for k in factors)


MACHINES = {
    "mts": ("run.dat", "MTS793|MPT|ENU|1|2|.|/|:|1|0|0|A\n", "\nData Acquisition\t\t\tTime:\t4.5\tSec\t03/02/2026 1:00:01 PM\n",
            "Running Time\tAxial Displacement\tAxial Load\n", "Sec\tmm\tN\n", "\t"),
    "repeated header": ("run.csv", "", "", "Time [s],Stroke [mm],Force [N]\n", "", ","),
    "blank line, head, units": ("run.asc", "Bench 4\n", "\n\nCycle block: 3\n", "Zeit;Weg;Kraft\n", "[s];[mm];[N]\n", ";"),
}  # fmt: skip


@pytest.mark.parametrize("name", MACHINES)
def test_each_block_is_a_record(folder: Make, tmp_path: Path, name: str) -> None:
    file, top, head, names, units, sep = MACHINES[name]
    factors = (1.0, 0.5, 0.25)
    text = top + machine(head, names, units, factors, sep)
    new = new_dataset(tmp_path, text, file)
    records = load_dataset(new).records
    assert [record.file for record in records] == [f"{file}, block {k}" for k in (1, 2, 3)]
    for record, factor in zip(records, factors, strict=True):
        is_good(record, factor)
    columns = 'columns = {"time [s]" = "X", "stroke [mm]" = "Y", "force [N]" = "Z"}'
    for letter, foreign in zip("XYZ", names.strip().split(sep), strict=True):
        columns = columns.replace(f'"{letter}"', f'"{foreign}"')
    reading = HEAD + columns + f'\ndelimiter = "{sep}"\n'.replace("\t", "\\t")
    path = folder({file: text}, reading)
    rows = [i for i, line in enumerate(text.splitlines(), start=1) if line == names.strip()]
    assert f"the file has 3 blocks, which begin in rows {', '.join(map(str, rows))}: set block" in said(path)
    path = folder({}, toml=reading + RECORD.format(file) + "block = 2\n")
    is_good(single(path), 0.5)
    path = folder({}, toml=reading + RECORD.format(file) + "block = 4\n")
    assert "block = 4: the file has 3 blocks" in said(path)
    run = RUNNER.invoke(app, ["simulate", "--record", str(new / file), "--output", str(tmp_path / "o.csv")])
    assert run.exit_code == 2
    assert "names 3 records of this file" in run.stderr
    run = RUNNER.invoke(app, ["simulate", "--record", str(new / file), "--block", "3", "--output", str(tmp_path / "o.csv")])
    assert run.exit_code == 0, run.output


def test_one_block_under_a_head(folder: Make, tmp_path: Path) -> None:
    file, top, head, names, units, sep = MACHINES["mts"]
    text = top + machine(head, names, units, (1.0,), sep)
    columns = 'columns = {"time [s]" = "Running Time", "stroke [mm]" = "Axial Displacement", "force [N]" = "Axial Load"}\n'
    path = folder({file: text}, HEAD + columns)
    assert "row 1 is not that of the names, which is row 4: set block = 1" in said(path)
    is_good(single(folder({}, toml=HEAD + columns + RECORD.format(file) + "block = 1\n")))
    is_good(single(new_dataset(tmp_path, text, file)))


def test_an_error_in_the_last_row_of_a_block_is_not_cut_off(folder: Make) -> None:
    text = machine("Data Acquisition\t1\n", "\t".join(plain()) + "\n", "", (1.0, 1.0))
    lines = text.splitlines(keepends=True)
    last = 1 + 1501
    lines[last] = "over\t" + lines[last].split("\t", 1)[1]
    path = folder({"a.txt": "".join(lines)}, toml=HEAD + RECORD.format("a.txt") + "block = 1\n")
    assert f"a.txt: row {last + 1}, column 'time [s]': 'over' is not a finite number" in said(path)


def test_a_table_in_the_head_is_no_record(tmp_path: Path) -> None:
    text = (
        "Sensor;Gain;Zero\n1;2.5;0.1\n2;2.5;0.2\n3;2.6;0.3\n\n" + ";".join(plain()) + "\n" + body(*plain().values(), sep=";")
    )
    is_good(single(new_dataset(tmp_path, text, "a.csv")))


def test_a_block_of_a_binary_file_is_refused(folder: Make) -> None:
    path = folder({"a.json": "{}"}, toml=HEAD + RECORD.format("a.json") + "block = 1\n")
    assert "block = 1: is for several tables in a text file, not for .json" in said(path)


@pytest.mark.parametrize(
    "names",
    ["time [s],stroke [mm],force [N],Comment", "time [s],stroke [mm],force [N],", "time [s],stroke [mm],force [N],Flag"],
)
def test_a_name_without_cells_at_the_end(folder: Make, tmp_path: Path, names: str) -> None:
    text = names + "\n" + body(*plain().values())
    is_good(single(folder({"a.csv": text})))
    is_good(single(new_dataset(tmp_path, text, "a.csv")))


def test_which_name_is_without_cells_may_be_unclear(folder: Make) -> None:
    path = folder({"a.csv": f"No,{T},{Z},{F},Flag\n" + body(*plain().values(), np.arange(1501.0))})
    assert "no row has more than 4 cells under 5 names: is 'Flag' without cells, or 'No'? set `columns`" in said(path)
    path = folder({"a.csv": f"No,{T},{Z},{F},Remark\n" + body(np.arange(1501.0), *plain().values())})
    is_good(single(path))
    assert "no row has a cell for the last of the names, 'Remark'" in said(path)


def grouped(values: Any, sign: str, decimal: str) -> list[str]:
    return [f"{x:,.3f}".replace(".", "_").replace(",", sign).replace("_", decimal) for x in values]


@pytest.mark.parametrize("sign", [" ", "\N{NO-BREAK SPACE}", "\N{THIN SPACE}", "\N{NARROW NO-BREAK SPACE}", "'", "’"])
@pytest.mark.parametrize(("decimal", "ending"), [(".", ".csv"), (",", ".csv"), (",", ".txt")])
def test_thousands_by_space_and_apostrophe(folder: Make, tmp_path: Path, sign: str, decimal: str, ending: str) -> None:
    c = plain()
    sep = ";" if ending == ".csv" else " " if sign != " " else "\t"
    numbers = [[f"{x:.6f}".replace(".", decimal) for x in c[name]] for name in (T, Z)]
    names = ("time[s]", "stroke[mm]", "force[N]")
    text = sep.join(names) + "\n" + body(*numbers, grouped(3 * c[F], sign, decimal), sep=sep)
    top = HEAD + f'decimal = "{decimal}"' + ('\ndelimiter = ";"' if sep == ";" else "")
    path = folder({f"a{ending}": text}, top)
    np.testing.assert_allclose(single(path).force, 3 * c[F], atol=1e-3)
    assert said(path).count("is read as a thousands separator") == 1
    np.testing.assert_allclose(single(new_dataset(tmp_path, text, f"a{ending}")).force, 3 * c[F], atol=1e-3)


@pytest.mark.parametrize("cell", ["1 23", "12 34.5", "0 123", "1 2345", "1'23", "１２", "1２", "٣"])
def test_what_parts_no_thousands_is_refused(folder: Make, cell: str) -> None:
    c = plain()
    force = [f"{x:.6f}" for x in c[F]]
    force[3] = cell
    path = folder({"a.csv": ";".join(plain()) + "\n" + body(c[T], c[Z], force, sep=";")}, HEAD + 'delimiter = ";"')
    (error,) = [e for e in check_dataset(path).errors if "finite" in e.message]
    assert error.row == 5
    assert f"{cell!r} is not a finite number" in error.message


def clock(seconds: Any, form: str, comma: str) -> list[str]:
    texts = []
    for x in seconds:
        milli = round(x * 1000)
        hour, minute, second = milli // 3_600_000, milli // 60_000 % 60, milli // 1000 % 60
        texts.append(form.format(h=hour % 24, m=minute, s=second, f=f"{comma}{milli % 1000:03d}"))
    return texts


@pytest.mark.parametrize(
    ("form", "comma", "start"),
    [
        ("{m:02d}:{s:02d}{f}", ".", 83.456),
        ("{m:02d}:{s:02d}{f}", ",", 59 * 60 + 58.5),  # over the hour
        ("{m}:{s:02d}{f}", ".", 1.0),
        ("{h}:{m:02d}:{s:02d}{f}", ",", 3723.5),
        ("{h:02d}:{m:02d}:{s:02d}{f}", ".", 12.5),
        ("{h:02d}:{m:02d}:{s:02d}{f}", ".", 86398.5),  # over midnight
    ],
)
def test_minutes_and_seconds(folder: Make, tmp_path: Path, form: str, comma: str, start: float) -> None:
    c = plain()
    text = f"time;{Z};{F}\n" + body(clock(c[T] + start, form, comma), c[Z], c[F], sep=";")
    is_good(single(folder({"a.csv": text}, HEAD + 'delimiter = ";"')))
    is_good(single(new_dataset(tmp_path, text, "a.csv")))


def test_hours_or_minutes_is_refused(folder: Make) -> None:
    text = f"time;{Z};{F}\n" + body([f"12:{i % 60:02d}" for i in range(1501)], plain()[Z], plain()[F], sep=";")
    path = folder({"a.csv": text}, HEAD + 'delimiter = ";"')
    assert "'12:00' may be hours and minutes, or minutes and seconds: set sample_rate_Hz" in said(path)


@pytest.mark.parametrize("ends", ["\r", "\r\n", "mixed"])
def test_line_ends(folder: Make, tmp_path: Path, ends: str) -> None:
    lines = as_csv(plain()).splitlines()
    kinds = ["\n", "\r", "\r\n"] if ends == "mixed" else [ends]
    text = "".join(line + kinds[i % len(kinds)] for i, line in enumerate(lines))
    path = folder({"a.csv": None})
    (path / "a.csv").write_bytes(text.encode())
    is_good(single(path))
    is_good(single(new_dataset(tmp_path, text, "a.csv")))


@pytest.mark.parametrize("file", ["a.csv/", "./a.csv/.", "sub/.."])
def test_the_path_of_a_folder_is_refused(folder: Make, file: str) -> None:
    folder({"a.csv": as_csv(plain())})
    path = folder({}, toml=HEAD + RECORD.format(file))
    assert f"record 1: file = {file!r}: must be the name of a file, not of a folder" in said(path)


@pytest.mark.parametrize("absolute", [True, False])
def test_a_file_outside_of_the_folder_is_named(folder: Make, tmp_path: Path, absolute: bool) -> None:
    home = tmp_path / "home"
    home.mkdir()
    (tmp_path / "outside.csv").write_text(as_csv(plain()))
    (home / "inside.csv").write_text(as_csv(plain() | {F: 2 * plain()[F]}))
    outside = (tmp_path / "outside.csv").as_posix() if absolute else "../outside.csv"
    (home / "dataset.toml").write_text(HEAD + RECORD.format("../home/inside.csv") + RECORD.format(outside))
    found = said(home)
    assert f"remark: dataset.toml, line 7, file: outside of the dataset's folder: {short(outside)}; a copy" in found
    assert len(load_dataset(home).records) == 2


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("block = 0", "block = 0: must be an integer from 1 to 1000"),
        ("block = 1.0", "block = 1.0: must be an integer"),
        ("block = true", "block = True: must be an integer"),
        ("block = [1, 2]", "block = [1, 2]: must be an integer"),
        ("group = -1", "group = -1: must be the name of a channel group of an MDF file, or its number"),
        ('group = ""', "group = '': must be the name"),
        ("group = true", "group = True: must be the name"),
    ],
)
def test_keys_that_choose_a_part(folder: Make, line: str, message: str) -> None:
    (error,) = check_dataset(folder({"a.csv": plain()}, toml=HEAD + RECORD.format("a.csv") + line + "\n")).errors
    assert (error.file, error.row) == ("dataset.toml", 7)
    assert message in error.message


def test_the_same_part_twice_is_refused(folder: Make) -> None:
    record = RECORD.format("a.csv") + "block = 1\n"
    (error,) = check_dataset(folder({"a.csv": plain()}, toml=HEAD + 2 * record)).errors
    assert "record 2: file = 'a.csv' is named by a record before" in error.message
