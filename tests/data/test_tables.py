"""Tables as benches write them: of all ways to read the rows the one that explains most cells, and no wrong guess in silence."""

import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from typer.testing import CliRunner

from tests.data.conftest import RECORD, as_csv, good
from tests.data.test_dyno_files import workbook
from twintube.cli import app
from twintube.data import Record, check_dataset, load_dataset
from twintube.data.sniff.blocks import sniff_records
from twintube.data.sniff.template import Fill, new_dataset

Make = Callable[..., Path]
RUNNER = CliRunner()
T, Z, F = "time [s]", "stroke [mm]", "force [N]"
HEAD = 'damper = "SA8"\n'
INCH, LBF = 25.4, 4.4482216152605
C = {name: np.asarray(good(301, 0.008)[name]) for name in (T, Z, F)}
COUNT = len(C[T])


def text_of(rows: list[list[str]], sep: str = ",") -> str:
    return "".join(sep.join(row) + "\n" for row in rows)


def numbers(*columns: Any, decimal: str = ".") -> list[list[str]]:
    return [
        [x if isinstance(x, str) else f"{x:.9g}".replace(".", decimal) for x in row] for row in zip(*columns, strict=True)
    ]


def made(tmp_path: Path, content: str | bytes, name: str = "a.csv") -> Path:
    """The folder that new-dataset makes of a file."""
    source = tmp_path / "source" / name
    source.parent.mkdir(exist_ok=True)
    source.write_bytes(content if isinstance(content, bytes) else content.encode())
    new_dataset(tmp_path / "new", [source], "SA8", Fill(0.56, False))
    return tmp_path / "new"


def single(path: Path) -> Record:
    (record,) = load_dataset(path).records
    return record


def said(path: Path) -> str:
    return "\n".join(map(str, check_dataset(path).findings))


def is_good(record: Record, factor: float = 1.0, count: int = COUNT) -> None:
    assert len(record.time) == count
    np.testing.assert_allclose(record.time - record.time[0], C[T][:count], atol=2e-5)
    np.testing.assert_allclose(record.stroke, factor * C[Z][:count] / 1e3, rtol=2e-5, atol=1e-7)
    np.testing.assert_allclose(record.force, factor * C[F][:count], rtol=2e-5, atol=2e-3)


LBF_ROWS = numbers(C[T], C[Z] / INCH, C[F] / LBF)
NAMES = ["Time (s)", "Stroke (in)", "Load (lbf)"]


def cells(row: list[str], more: list[str]) -> list[str]:
    return [*row, *more]


ENDS: dict[str, tuple[list[str], Callable[[int], list[str]]]] = {
    "two columns of empty cells": (["Temperature (degF)", "Remark"], lambda _: ["", ""]),
    "two names without cells": (["Temperature (degF)", "Remark"], lambda _: []),
    "an event in the first row": (["Event"], lambda i: ["Start"] if i == 0 else []),
    "events now and then": (["Event", "Flag"], lambda i: ["Start", "x"] if i in (0, 7) else ["", ""]),
    "a temperature in every tenth row": (["Temperature (degF)", "Remark"], lambda i: ["77" if i % 10 == 0 else "", ""]),
    "a temperature in every second row": (["Temperature (degF)"], lambda i: ["77"] if i % 2 == 0 else []),
}


@pytest.mark.parametrize("end", ENDS)
def test_what_ends_the_rows_hides_no_name(tmp_path: Path, end: str) -> None:
    names, more = ENDS[end]
    path = made(tmp_path, text_of([[*NAMES, *names], *(cells(row, more(i)) for i, row in enumerate(LBF_ROWS))]))
    record = single(path)
    is_good(record)
    assert "no header" not in said(path)
    assert "guessed" not in said(path)
    if end.startswith("a temperature"):
        assert record.temperature is not None
        np.testing.assert_allclose(record.temperature, 25.0, atol=1e-6)
        assert "of 301 rows; between them it is interpolated" in said(path)


def test_optional_columns_without_a_cell_are_left_out_and_named(tmp_path: Path, folder: Make) -> None:
    names = ["Time (s)", "Temp 1 (degC)", "Temp 2 (degC)", "Stroke (in)", "Force (lbf)"]
    path = made(tmp_path, text_of([names, *([row[0], "", "", *row[1:]] for row in LBF_ROWS)]))
    is_good(single(path))
    assert "left out, because no row has a cell for it: 'Temp 1 (degC)', 'Temp 2 (degC)'" in said(path)
    plain = as_csv({T: C[T], "temperature [degC]": [""] * COUNT, Z: C[Z], F: C[F]})
    record = single(folder({"a.csv": plain}))
    is_good(record)
    assert record.temperature is None
    errors = check_dataset(folder({"a.csv": as_csv({T: C[T], Z: C[Z], F: [""] * COUNT})})).errors
    assert "the cell is empty (301 such rows" in errors[0].message


def test_a_list_that_contradicts_the_header_is_refused(folder: Make) -> None:
    """What earlier versions wrote about such files: the header skipped, its inches and pounds taken for mm and N."""
    text = text_of([[*NAMES, "Temperature (degF)", "Remark"], *LBF_ROWS])
    path = folder({"a.csv": text}, HEAD + f'columns = ["{T}", "{Z}", "{F}"]\nskip_rows = 1\n')
    assert "column 'Load (lbf)' is named in lbf, dataset.toml says N" in said(path)
    exchanged = text_of([["Time (s)", "Force (kN)", "Stroke (mm)", "Remark"], *LBF_ROWS])
    path = folder({"a.csv": exchanged}, HEAD + f'columns = ["{T}", "{Z}", "{F}"]\nskip_rows = 1\n')
    assert "column 'Force (kN)' is named in kN, dataset.toml says mm; that is no unit of stroke" in said(path)


def test_a_logger_of_mcc_daq(tmp_path: Path) -> None:
    head = "Header Size:  7\nVersion:  2\nSampling Interval:  0.008\nSample Count:  301\nDevice Serial Number:  0\n"
    names = "Sample Number, Date/Time, Stroke (in), Load (lbf), Events\n"
    stamps = [
        f"05/13/2026 04:{m // 60000:02d}:{m // 1000 % 60:02d}.{m % 1000:03d} PM" for m in range(3000, 3000 + 8 * COUNT, 8)
    ]
    lines = [
        f"         {i + 1},   {stamp}, {row[1]}, {row[2]}" + (", DAQ Start" if i == 0 else "")
        for i, (stamp, row) in enumerate(zip(stamps, LBF_ROWS, strict=True))
    ]
    is_good(single(made(tmp_path, head + names + "\n".join(lines) + "\n", "a.txt")))


@dataclass(frozen=True)
class Layout:
    """One way to write a table."""

    sep: str
    decimal: str
    head: list[list[str]]
    order: list[str]  # of the columns: quantities, and others by their kind
    units: str  # in the names, or in a row of their own
    force: tuple[str, float]
    ends: bool  # whether empty cells at the end are written
    blank: bool  # a blank row over the names

    def rows(self) -> list[list[str]]:
        unit, size = self.force
        named = {"time": ("Time", "s"), "stroke": ("Stroke", "mm"), "force": ("Load", unit), "empty": ("Reserve", "V"),
                 "event": ("Event", ""), "slow": ("Temperature", "degC"), "remark": ("Remark", "")}  # fmt: skip
        values = {"time": C[T], "stroke": C[Z], "force": C[F] / size, "empty": [""] * COUNT,
                  "event": ["Start", *[""] * (COUNT - 1)], "slow": ["25" if i % 10 == 0 else "" for i in range(COUNT)],
                  "remark": [""] * COUNT}  # fmt: skip
        pairs = [named[name] for name in self.order]
        if self.units == "row":
            header = [[name for name, _ in pairs], [unit for _, unit in pairs]]
        else:
            header = [[self.units.format(name, unit) if unit else name for name, unit in pairs]]
        body = numbers(*(values[name] for name in self.order), decimal=self.decimal)
        if not self.ends:
            body = [row[: max(i for i, cell in enumerate(row, start=1) if cell)] for row in body]
        return [*self.head, *([[]] if self.blank else []), *header, *body]


WORDS = [
    "Operator",
    "Smith",
    "Damper",
    "SA8",
    "Prüfling",
    "HA links",
    "Date",
    "11.03.2024",
    "Nr. 17",
    "500",
    "12.5",
    "x",
    "",
]
layouts = st.builds(
    Layout,
    sep=st.just(","),
    decimal=st.just("."),
    head=st.lists(st.lists(st.sampled_from(WORDS), min_size=1, max_size=3), max_size=4),
    order=st.lists(st.sampled_from(["empty", "event", "slow", "remark"]), unique=True).flatmap(
        lambda more: st.permutations(["time", "stroke", "force", *more])
    ),
    units=st.sampled_from(["{} ({})", "{} [{}]", "{} in {}", "{}（{}）", "row"]),
    force=st.sampled_from([("N", 1.0), ("lbf", LBF), ("kN", 1000.0), ("daN", 10.0)]),
    ends=st.booleans(),
    blank=st.booleans(),
)
signs = st.sampled_from([(",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ","), ("|", ".")])


@given(layouts, signs)
@settings(max_examples=30, deadline=None)
def test_any_layout_is_read_by_its_names(layout: Layout, pair: tuple[str, str]) -> None:
    layout = Layout(**(layout.__dict__ | {"sep": pair[0], "decimal": pair[1]}))
    with tempfile.TemporaryDirectory() as name:
        path = made(Path(name), text_of(layout.rows(), layout.sep))
        is_good(single(path))
        assert "guessed" not in said(path)
        assert "no header" not in said(path)


@given(st.lists(layouts, min_size=4, max_size=4))
@settings(max_examples=4, deadline=None)
def test_any_layout_in_a_workbook(drawn: list[Layout]) -> None:
    """All in the sheets of one workbook, each a record; the cells are numbers, or texts with a decimal comma."""
    pytest.importorskip("python_calamine")
    sheets: dict[str, list[list[Any]]] = {"Info": [["Damper", "SA8"], ["Operator", "A"]]}
    for i, layout in enumerate(drawn):
        commas = Layout(**(layout.__dict__ | {"decimal": ","})).rows()
        plain = [[number_or_text(cell) for cell in row] for row in layout.rows()]
        sheets[f"S{i}"] = commas if i % 2 else plain
    with tempfile.TemporaryDirectory() as name:
        path = made(Path(name), workbook(sheets), "a.xlsx")
        records = load_dataset(path).records
        assert [record.file for record in records] == [f"a.xlsx, sheet S{i}" for i in range(len(drawn))]
        for record in records:
            is_good(record)
        assert "sheets without a record: 'Info'" in (path / "dataset.toml").read_text(encoding="utf-8")


def number_or_text(cell: str) -> Any:
    try:
        return float(cell) if cell else ""
    except ValueError:
        return cell


@pytest.mark.parametrize("sep", [",", ";", "\t"])
@pytest.mark.parametrize("count", [1, 2, 3])
def test_lines_over_the_header(tmp_path: Path, folder: Make, sep: str, count: int) -> None:
    head = [["Operator", "Smith"], ["Damper", "front left"], ["Datum", "11.03.2024", ""]][:count]
    decimal = "," if sep == ";" else "."
    rows = [*head, ["Time [s]", "Stroke [mm]", "Force [N]"], *numbers(C[T], C[Z], C[F], decimal=decimal)]
    is_good(single(made(tmp_path, text_of(rows, sep))))
    delimiter = {"\t": "\\t"}.get(sep, sep)
    path = folder({"b.csv": text_of(rows, sep)}, HEAD + f'delimiter = "{delimiter}"\ndecimal = "{decimal}"\n')
    assert f"row 1 is not that of the names, which is row {count + 1}: set block = 1" in said(path)


def test_the_delimiter_that_is_advised_is_not_the_decimal_sign(folder: Make) -> None:
    rows = [["Bench", "7,5"], *numbers(C[T], C[Z], C[F], decimal=",")]
    path = folder({"a.csv": text_of(rows, ";")}, HEAD + 'delimiter = ";"\ndecimal = ","\n')
    assert "3 cells where 2 columns are named; are the names in another row?" in said(path)


def test_a_first_row_with_a_cell_that_is_no_number_is_not_lost(tmp_path: Path) -> None:
    rows = numbers(C[T], C[Z], C[F])
    rows[0][2] = "over"
    assert "row 1, column 'force [N]': 'over' is not a finite number" in said(made(tmp_path, text_of(rows)))


RUN = "Run,Time (s),Stroke (mm),Force (N)\n"


@pytest.mark.parametrize("name", ["Run", ""])
def test_runs_one_under_the_other_are_records(tmp_path: Path, folder: Make, name: str) -> None:
    runs = [(str(k) if name else "", factor) for k, factor in ((1, 1.0), (2, 0.9), (3, 0.8))]
    rows = [row for k, factor in runs for row in numbers([k] * COUNT, C[T], factor * C[Z], factor * C[F])]
    text = text_of([[name, "Time (s)", "Stroke (mm)", "Force (N)"], *rows])
    new = made(tmp_path, text)
    records = load_dataset(new).records
    assert [record.file for record in records] == [f"a.csv, block {k}" for k in (1, 2, 3)]
    for record, (_, factor) in zip(records, runs, strict=True):
        is_good(record, factor)
        assert record.measurement == "harmonic"
    columns = HEAD + 'columns = {"time [s]" = "Time (s)", "stroke [mm]" = "Stroke (mm)", "force [N]" = "Force (N)"}\n'
    assert "the file has 3 blocks, which begin in rows 1, 303, 604: set block" in said(folder({"b.csv": text}, columns))
    run = RUNNER.invoke(
        app, ["simulate", "--record", str(new / "a.csv"), "--block", "2", "--output", str(tmp_path / "o.csv")]
    )
    assert run.exit_code == 0, run.output


def test_a_clock_that_goes_back_in_the_middle_begins_no_run(folder: Make) -> None:
    time = C[T].copy()
    time[150:] -= 0.5
    path = folder({"a.csv": as_csv({T: time, Z: C[Z], F: C[F]})})
    assert "time goes back: 0.7 s after 1.192 s" in said(path)
    assert "blocks" not in said(path)


BESIDE = {
    "names alike": ("Time (s),Stroke (mm),Force (N),,Time (s),Stroke (mm),Force (N)", ["1 to 3", "5 to 7"]),
    "counted": ("Time 1 (s),Stroke 1 (mm),Force 1 (N),,Time 2 (s),Stroke 2 (mm),Force 2 (N)", ["1 to 3", "5 to 7"]),
    "groups": ("Run 1,,,,Run 2,,\nTime,Stroke,Force,,Time,Stroke,Force\ns,mm,N,,s,mm,N", ["1 to 3", "5 to 7"]),
}


@pytest.mark.parametrize("name", BESIDE)
def test_runs_beside_each_other_are_records(tmp_path: Path, name: str) -> None:
    head, places = BESIDE[name]
    short = [[*row, ""] for row in numbers(C[T], 0.9 * C[Z], 0.9 * C[F])]
    rows = [
        [*first, "", *(second[:3] if i < 200 else [])]
        for i, (first, second) in enumerate(zip(numbers(*C.values()), short, strict=True))
    ]
    path = made(tmp_path, head + "\n" + text_of(rows))
    first, second = load_dataset(path).records
    assert [first.file, second.file] == [f"a.csv, columns {place}" for place in places]
    is_good(first)
    is_good(second, 0.9, 200)
    assert "2 runs side by side are taken for records of their own" in said(path)


def test_one_time_for_runs_beside_each_other(tmp_path: Path) -> None:
    head = "Time (s),Stroke 1 (mm),Force 1 (N),Stroke 2 (mm),Force 2 (N)\n"
    path = made(tmp_path, head + text_of(numbers(*C.values(), 0.9 * C[Z], 0.9 * C[F])))
    for record, factor in zip(load_dataset(path).records, (1.0, 0.9), strict=True):
        is_good(record, factor)
    command = "Time (s),Stroke cmd (mm),Force cmd (N),Stroke (mm),Force (N)\n"
    (tmp_path / "b.csv").write_text(command + text_of(numbers(C[T], 0.9 * C[Z], 0.9 * C[F], C[Z], C[F])))
    (guess,) = sniff_records(tmp_path / "b.csv")
    assert guess.reading["columns"] == {T: "Time (s)", Z: "Stroke (mm)", F: "Force (N)"}


def book(tmp_path: Path, sheets: dict[str, list[list[Any]]]) -> Path:
    pytest.importorskip("python_calamine")
    return made(tmp_path, workbook(sheets), "a.xlsx")


ROWS = [list(row) for row in zip(*(values.tolist() for values in C.values()), strict=True)]


def test_a_workbook_without_header(tmp_path: Path) -> None:
    path = book(tmp_path, {"Sheet": ROWS})
    is_good(single(path))
    assert "not confirmed: columns: the file has no header; the quantities and units are a guess" in said(path)


def test_a_workbook_with_merged_cells_over_the_numbers(tmp_path: Path) -> None:
    head = [["Test report 17", "", ""], [], ["Time", "Actuator", ""], ["", "Stroke", "Load"], ["s", "mm", "kN"]]
    path = book(tmp_path, {"Sheet": [*head, *([t, z, force / 1e3] for t, z, force in ROWS)]})
    is_good(single(path))
    assert "guessed" not in said(path)


def test_what_is_said_of_other_sheets(tmp_path: Path) -> None:
    path = book(tmp_path, {"Info": [["Damper", "SA8"], ["Operator", "A"]], "Data": [[T, Z, F], *ROWS]})
    is_good(single(path))
    (path / "dataset.toml").write_text(HEAD + RECORD.format("a.xlsx"))
    assert "remark: a.xlsx: read is the first sheet of 'Info', 'Data'; `sheet` chooses another" in said(path)
    (path / "a.xlsx").write_bytes(workbook({"Info": [], "Data": [[T, Z, F], *ROWS]}))
    assert "sheet 'Info' is empty; the workbook has other sheets: 'Data'; `sheet` chooses one" in said(path)
    two = {"v0131": [[T, Z, F], *ROWS], "v0524": [[T, Z, F], *([t, 0.9 * z, 0.9 * f] for t, z, f in ROWS)]}
    (tmp_path / "second").mkdir()
    path = book(tmp_path / "second", two)
    first, second = load_dataset(path).records
    is_good(first)
    is_good(second, 0.9)
    run = RUNNER.invoke(
        app, ["simulate", "--record", str(path / "a.xlsx"), "--block", "2", "--output", str(tmp_path / "o.csv")]
    )
    assert run.exit_code == 0, run.output


def test_a_workbook_without_a_table_is_refused(tmp_path: Path) -> None:
    pytest.importorskip("python_calamine")
    (tmp_path / "a.xlsx").write_bytes(workbook({"Info": [["Damper", "SA8"]], "More": [["x"]]}))
    run = RUNNER.invoke(app, ["new-dataset", str(tmp_path / "new"), "--from", str(tmp_path / "a.xlsx")])
    assert run.exit_code == 2
    assert "sheet 'Info': no table of at least two columns of numbers" in run.stderr
    assert "sheet 'More': no table" in run.stderr
    assert not (tmp_path / "new").exists()


def test_a_text_named_as_a_workbook(tmp_path: Path) -> None:
    rows = [["Time (s)", "Stroke (mm)", "Force (N)"], *numbers(*C.values())]
    is_good(single(made(tmp_path, text_of(rows, "\t"), "a.xls")))


TIMES: dict[str, tuple[Callable[[float], str], str]] = {
    "MATLAB": (lambda t: f"13-May-2026 16:04:{20 + t:09.6f}", "time"),
    "days of Excel": (lambda t: f"{46155.66972 + t / 86400:.9f}", "time [day]"),
    "microseconds": (lambda t: f"{123456 + t * 1e6:.0f}", "time [us]"),
    "milliseconds": (lambda t: f"{t * 1e3:.0f}", "time [ms]"),
}


@pytest.mark.parametrize("name", TIMES)
def test_times_without_unit(tmp_path: Path, name: str) -> None:
    stamp, header = TIMES[name]
    path = made(tmp_path, text_of([["Date Time", Z, F], *numbers([stamp(t) for t in C[T]], C[Z], C[F])]))
    record = single(path)
    np.testing.assert_allclose(record.time - record.time[0], C[T], atol=6e-5)
    assert f'"{header}" = "Date Time"' in (path / "dataset.toml").read_text().replace("{time =", '{"time" =')
    assert (f"not confirmed: time: the file gives no unit, {header[6:-1]} is guessed" in said(path)) == ("[" in header)


def test_a_month_that_is_none(folder: Make) -> None:
    path = folder({"a.csv": as_csv({"time": [f"13-Mai-2026 16:04:{t + 20:09.6f}" for t in C[T]], Z: C[Z], F: C[F]})})
    assert "'13-Mai-2026' is not a date" in said(path)


def test_days_taken_for_seconds(folder: Make) -> None:
    path = folder({"a.csv": as_csv({T: [f"{46155 + t / 86400:.9f}" for t in C[T]], Z: C[Z], F: C[F]})})
    assert "must be from 1e-05 to 0.5 s; days, as Excel counts them? then write [day]" in said(path)


def test_an_fv_table_in_place_of_a_record(tmp_path: Path, folder: Make) -> None:
    text = "Velocity (mm/s),Compression (N),Rebound (N)\n50.0,-36.8,110.5\n100.0,-59.9,179.6\n200.0,-97.2,291.7\n"
    (tmp_path / "fv.csv").write_text(text)
    run = RUNNER.invoke(app, ["new-dataset", str(tmp_path / "new"), "--from", str(tmp_path / "fv.csv")])
    assert run.exit_code == 2
    assert "an F-v table, not a record of time, stroke and force: its points go into [fv] of a parameter file" in run.stderr
    (error,) = check_dataset(folder({"a.csv": text})).errors
    assert error.message.startswith("an F-v table")


FOREIGN = {
    "full-width": ("时间（s）,位移（mm）,力（kN）", "utf-8"),
    "Cyrillic": ("Время, с;Перемещение, мм;Усилие, кН", "utf-8"),
    "Cyrillic of Windows": ("Время (с);Перемещение (мм);Усилие (кН)", "cp1251"),
    "French": ("Temps (s);Course stroke (mm);Force (kN)", "utf-8"),
    "Italian": ("Tempo [s];Corsa stroke [mm];Force [kN]", "cp1252"),
    "UTF-16 without its mark": ("time [s],stroke [mm],force [kN]", "utf-16-le"),
    "big UTF-16 without its mark": ("time [s],stroke [mm],force [kN]", "utf-16-be"),
}


@pytest.mark.parametrize("name", FOREIGN)
def test_names_and_units_of_other_languages(tmp_path: Path, name: str) -> None:
    head, encoding = FOREIGN[name]
    sep = ";" if ";" in head else ","
    text = head + "\n" + text_of(numbers(C[T], C[Z], C[F] / 1e3, decimal="," if sep == ";" else "."), sep)
    path = made(tmp_path, text.encode(encoding))
    is_good(single(path))
    assert "guessed" not in said(path)
    assert "temperature" not in said(path)


def test_a_text_in_utf_16_says_its_encoding(folder: Make) -> None:
    path = folder({"a.csv": None})
    (path / "a.csv").write_bytes(as_csv(C).encode("utf-16-le"))
    assert "every second byte is 0, as in a text in UTF-16: set encoding = 'utf-16-le'" in said(path)


def test_repeated_times_say_nothing_of_the_work(folder: Make) -> None:
    rounded = np.floor(C[T] / 0.5) * 0.5
    (finding,) = check_dataset(folder({"a.csv": as_csv({T: rounded, Z: C[Z], F: C[F]})})).findings
    assert "time is repeated" in finding.message


def test_decimal_commas_in_quotes(tmp_path: Path) -> None:
    rows = [[f'"{cell}"' for cell in row] for row in numbers(*C.values(), decimal=",")]
    is_good(single(made(tmp_path, text_of([[T, Z, F], *rows]))))


def test_a_unit_and_a_name_that_begin_with_a_digit(tmp_path: Path) -> None:
    head = [["Time", "1st stroke", "2 Load", "Speed"], ["s", "in", "lbf", "1/min"]]
    path = made(tmp_path, text_of([*head, *([*row, "300"] for row in LBF_ROWS)]))
    is_good(single(path))
    assert "guessed" not in said(path)
