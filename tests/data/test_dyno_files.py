"""Files as dyno machines write them: every one of them gives the record that the plain CSV gives."""

import io
import json
import zipfile
from collections.abc import Callable
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

import numpy as np
import pytest

from tests.data.conftest import RECORD, Columns, as_csv, good
from twintube.data import DataError, Record, check_dataset, load_dataset

Make = Callable[..., Path]
T, Z, V, F = "time [s]", "stroke [mm]", "velocity [mm/s]", "force [N]"
START = datetime(2026, 11, 22, 23, 59, 59)
HEAD = 'damper = "SA8"\n'


def single(path: Path) -> Record:
    (record,) = load_dataset(path).records
    return record


def is_good(record: Record, first: int = 0, last: int | None = None) -> None:
    c = good()
    part = slice(first, last)
    np.testing.assert_allclose(record.time - record.time[0], (c[T] - c[T][first])[part], atol=1e-9)
    np.testing.assert_allclose(record.stroke, c[Z][part] / 1e3, rtol=2e-5, atol=1e-8)
    np.testing.assert_allclose(record.force, c[F][part], rtol=2e-5, atol=1e-3)


def stamps(form: str, points: str = ".") -> list[str]:
    """A stamp for each sample, over midnight."""
    times = [START + timedelta(milliseconds=2 * i) for i in range(len(good()[T]))]
    return [time.strftime(form) + points + f"{time.microsecond // 1000:03d}" for time in times]


def rows(c: Columns, delimiter: str = ",", decimal: str = ".", head: list[str] | None = None) -> str:
    lines = [delimiter.join(c), *(head or [])]
    for row in zip(*c.values(), strict=True):
        lines.append(delimiter.join(x if isinstance(x, str) else f"{x:.9g}".replace(".", decimal) for x in row))
    return "\n".join([*lines, ""])


@pytest.mark.parametrize(
    ("form", "points"),
    [
        ("%Y-%m-%dT%H:%M:%S", "."),
        ("%Y-%m-%d %H:%M:%S", ","),
        ("%d.%m.%Y %H:%M:%S", ","),
        ("%m/%d/%Y %H:%M:%S", "."),
        ("%H:%M:%S", "."),
    ],
)
def test_stamps_are_times(folder: Make, form: str, points: str) -> None:
    c = {"time": stamps(form, points)} | {name: good()[name] for name in (Z, F)}
    is_good(single(folder({"a.csv": rows(c, ";")}, HEAD + 'delimiter = ";"')))


def test_a_stamp_that_is_none_is_said(folder: Make) -> None:
    c = {"time": [*stamps("%H:%M:%S")[:-1], "25:00:00"], Z: good()[Z], F: good()[F]}
    (error,) = check_dataset(folder({"a.csv": rows(c)})).errors
    assert str(error) == "error: a.csv: row 1502, column 'time': '25:00:00' is no time like '23:59:59.000'"


def test_dates_whose_day_may_be_the_month(folder: Make) -> None:
    c = {"time": [f"0{1 + i // 800}/02/2026 12:00:{i * 0.002 % 60:06.3f}" for i in range(1501)], Z: good()[Z], F: good()[F]}
    (error,) = check_dataset(folder({"a.csv": rows(c)})).errors
    assert "'01/02/2026' and '02/02/2026': day or month first? set sample_rate_Hz" in str(error)


def test_a_sample_rate_instead_of_times(folder: Make) -> None:
    c = {name: good()[name] for name in (Z, F)}
    path = folder({"a.csv": c})
    assert "without times set sample_rate_Hz" in str(check_dataset(path).errors[0])
    is_good(single(folder({"a.csv": c}, HEAD + "sample_rate_Hz = 500")))
    toml = HEAD + RECORD.format("a.csv") + "sample_rate_Hz = 500\n" + RECORD.format("b.csv")
    for record in load_dataset(folder({"a.csv": c, "b.csv": good()}, toml=toml)).records:
        is_good(record)


def test_volts_become_newtons(folder: Make) -> None:
    c = good()
    volts = {T: c[T], "AI0 [V]": c[Z] / 10.0 + 0.2, "AI1 [mV]": (c[F] + 12.0) / 0.5, "AI2": c[V] / 40.0}
    channels = """
[channels]
stroke = {column = "AI0 [V]", scale = "10 mm/V", offset = "-2 mm"}
force = {column = "AI1 [mV]", scale = "500 N/V", offset = "-12 N"}
velocity = {column = "AI2", scale = "40 mm/s/V"}
"""
    is_good(single(folder({"a.csv": rows(volts)}, HEAD + channels)))
    own = c | {F: c[F] + 12.0}
    is_good(single(folder({"a.csv": rows(own)}, HEAD + 'channels = {force = {offset = "-12 N"}}')))
    wrong = volts | {"AI1 [bar]": volts["AI1 [mV]"]}
    del wrong["AI1 [mV]"]
    (error,) = check_dataset(folder({"a.csv": rows(wrong)}, HEAD + channels.replace("mV", "bar"))).errors
    assert "column 'AI1 [bar]': the file gives it in bar, its scale is per V" in str(error)


def test_a_thermocouple_in_volts(folder: Make) -> None:
    c = good() | {"AI3 [V]": np.linspace(2.5, 3.0, 1501)}
    record = single(
        folder({"a.csv": rows(c)}, HEAD + 'channels = {temperature = {column = "AI3 [V]", scale = "10 degC/V"}}')
    )
    assert record.temperature is not None
    np.testing.assert_allclose(record.temperature[[0, -1]], [25.0, 30.0])


@pytest.mark.parametrize("units", ["s;mm;mm/s;N", "[s];[mm];[mm/s];[N]", "(s);(mm);(mm/s);(N)"])
def test_a_row_of_units(folder: Make, units: str) -> None:
    c = good()
    plain = {"Time": c[T], "Stroke": c[Z], "Velocity": c[V], "Force": c[F]}
    record = single(folder({"a.csv": rows(plain, ";", head=[units])}, HEAD + 'delimiter = ";"'))
    is_good(record)
    columns = 'delimiter = ";"\ncolumns = {"time [s]" = "Time", "stroke [mm]" = "Stroke", "force [kN]" = "Force"}'
    errors = check_dataset(folder({"a.csv": rows(plain, ";", head=[units])}, HEAD + columns)).errors
    assert any("the file gives 'Force' in N, not in kN" in error.message for error in errors)


@pytest.mark.parametrize(
    ("names", "factors"),
    [
        (("time (s)", "stroke (mm)", "velocity (mm/s)", "force (N)"), (1, 1, 1, 1)),
        (("Time [s]", "STROKE [MM]", "Velocity [mm/s]", "Force [kn]"), (1, 1, 1, 1e-3)),
        (("Time (sec)", "Stroke (in)", "Velocity (in/s)", "Force (lbs)"), (1, 1 / 25.4, 1 / 25.4, 1 / 4.4482216152605)),
        (("time [ms]", "stroke [inch]", "velocity [ips]", "force [lbf]"), (1e3, 1 / 25.4, 1 / 25.4, 1 / 4.4482216152605)),
        (("TIME [s]", "stroke [m]", "velocity [m/s]", "force [kgf]"), (1, 1e-3, 1e-3, 1 / 9.80665)),
    ],
)
def test_names_and_units_as_machines_write_them(folder: Make, names: tuple[str, ...], factors: tuple[float, ...]) -> None:
    c = {name: values * factor for name, values, factor in zip(names, good().values(), factors, strict=True)}
    is_good(single(folder({"a.csv": rows(c)})))


def test_tabs_in_a_text_file_part_names_with_spaces(folder: Make) -> None:
    is_good(single(folder({"a.txt": rows(good(), "\t")})))
    spaces = {name.split(" ")[0]: values for name, values in good().items()}
    text = rows(spaces, " ")
    is_good(single(folder({"a.txt": text}, HEAD + f"columns = {list(good())}\nskip_rows = 1")))


@pytest.mark.parametrize("encoding", ["utf-16", "utf-8-sig"])
def test_byte_order_marks(folder: Make, encoding: str) -> None:
    path = folder({"a.csv": None})
    (path / "a.csv").write_bytes(as_csv(good()).encode(encoding))
    toml = (path / "dataset.toml").read_text(encoding="utf-8")
    (path / "dataset.toml").write_bytes(toml.encode(encoding))
    is_good(single(path))


def grouped(values: Any, digits: int) -> list[str]:
    """German numbers with a thousands dot."""
    return [f"{x:,.{digits}f}".replace(",", "_").replace(".", ",").replace("_", ".") for x in values]


def test_thousands_dots_are_read_where_they_are_clear(folder: Make) -> None:
    c = good()
    german = 'delimiter = ";"\ndecimal = ","'
    for digits in (0, 2):  # 2.189 beside 870, and 2.189,25
        text = rows({T: grouped(c[T], 3), Z: grouped(c[Z], 5), F: grouped(10 * c[F], digits)}, ";")
        dataset = load_dataset(folder({"a.csv": text}, HEAD + german))
        np.testing.assert_allclose(dataset.records[0].force, np.round(10 * c[F], digits), atol=1e-9)
        assert any("'.' is read as a thousands separator: '" in finding.message for finding in dataset.findings)


@pytest.mark.parametrize("cell", ["2.189", "0.125", "1.5", "12.34,5", "1234.567"])
def test_a_dot_that_may_be_a_decimal_sign_is_refused(folder: Make, cell: str) -> None:
    c = good()
    force = [f"{x:.2f}".replace(".", ",") for x in c[F]]
    force[700] = cell
    text = rows({T: grouped(c[T], 3), Z: grouped(c[Z], 5), F: force}, ";")
    (error,) = check_dataset(folder({"a.csv": text}, HEAD + 'delimiter = ";"\ndecimal = ","')).errors
    assert f"row 702, column 'force [N]': '{cell}' " in str(error)


def test_english_thousands_commas(folder: Make) -> None:
    c = good()
    text = rows({T: c[T], Z: c[Z], F: [f"{10 * x:,.2f}" for x in c[F]]}, ";")
    record = single(folder({"a.csv": text}, HEAD + 'delimiter = ";"'))
    np.testing.assert_allclose(record.force, np.round(10 * c[F], 2))


JSON: dict[str, Callable[[Columns], Any]] = {
    "lists": lambda c: {"machine": "D1", **c},
    "samples": lambda c: [dict(zip(c, row, strict=True)) for row in zip(*c.values(), strict=True)],
    "split": lambda c: {"columns": list(c), "data": [list(row) for row in zip(*c.values(), strict=True)]},
    "nested": lambda c: {"test": {"setting": "C3", "channels": {name: {"values": c[name]} for name in c}}},
    "units": lambda c: {"units": {"time": "s", "stroke": "mm", "force": "N"}, "time": c[T], "stroke": c[Z], "force": c[F]},
}


@pytest.mark.parametrize("shape", JSON.values(), ids=JSON)
def test_json(folder: Make, shape: Callable[[Columns], Any]) -> None:
    content = shape({name: [float(x) for x in values] for name, values in good().items()})
    is_good(single(folder({"a.json": json.dumps(content)})))


def workbook(sheets: dict[str, list[list[Any]]]) -> bytes:
    """An .xlsx of numbers, texts and date-times (style 1)."""
    office = "http://schemas.openxmlformats.org"
    names = "".join(f'<sheet name="{name}" sheetId="{i}" r:id="r{i}"/>' for i, name in enumerate(sheets, 1))
    links = "".join(
        f'<Relationship Id="r{i}" Type="{office}/officeDocument/2006/relationships/worksheet" Target="worksheets/sheet{i}.xml"/>'
        for i in range(1, len(sheets) + 1)
    )
    styles = f'<Relationship Id="s" Type="{office}/officeDocument/2006/relationships/styles" Target="styles.xml"/>'
    files = {
        "[Content_Types].xml": f'<Types xmlns="{office}/package/2006/content-types"/>',
        "_rels/.rels": f'<Relationships xmlns="{office}/package/2006/relationships"><Relationship Id="b" '
        f'Type="{office}/officeDocument/2006/relationships/officeDocument" Target="xl/workbook.xml"/></Relationships>',
        "xl/workbook.xml": f'<workbook xmlns="{office}/spreadsheetml/2006/main" '
        f'xmlns:r="{office}/officeDocument/2006/relationships"><sheets>{names}</sheets></workbook>',
        "xl/_rels/workbook.xml.rels": f'<Relationships xmlns="{office}/package/2006/relationships">{links}{styles}</Relationships>',
        "xl/styles.xml": f'<styleSheet xmlns="{office}/spreadsheetml/2006/main"><numFmts count="1"><numFmt numFmtId="164" '
        'formatCode="yyyy\\-mm\\-dd\\ hh:mm:ss.000"/></numFmts><cellXfs count="2"><xf numFmtId="0"/><xf numFmtId="164"/>'
        "</cellXfs></styleSheet>",
    }
    for i, content in enumerate(sheets.values(), 1):
        lines = "".join(f"<row>{''.join(cell(x) for x in line)}</row>" for line in content)
        files[f"xl/worksheets/sheet{i}.xml"] = (
            f'<worksheet xmlns="{office}/spreadsheetml/2006/main"><sheetData>{lines}</sheetData></worksheet>'
        )
    with io.BytesIO() as buffer:
        with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as file:
            for name, text in files.items():
                file.writestr(name, '<?xml version="1.0" encoding="UTF-8"?>' + text)
        return buffer.getvalue()


def cell(value: Any) -> str:
    if isinstance(value, str):
        return f'<c t="inlineStr"><is><t>{escape(value)}</t></is></c>' if value else "<c/>"
    if isinstance(value, datetime):
        return f'<c s="1"><v>{(value - datetime(1899, 12, 30)) / timedelta(days=1)!r}</v></c>'
    return f"<c><v>{float(value)!r}</v></c>"


def test_workbooks(folder: Make) -> None:
    pytest.importorskip("python_calamine")
    c = good()
    body = [list(row) for row in zip(*c.values(), strict=True)]
    path = folder({"a.xlsx": None})
    (path / "a.xlsx").write_bytes(workbook({"Data": [list(c), *body]}))
    is_good(single(path))
    dated = [[START + timedelta(milliseconds=2 * i), *row[1:]] for i, row in enumerate(body)]
    table = [["Machine D1"], [], ["Time", "Stroke", "Speed", "Force"], ["", "[mm]", "[mm/s]", "[N]"], *dated]
    (path / "a.xlsx").write_bytes(workbook({"Cover": [["x"]], "Data": table}))
    (path / "dataset.toml").write_text(HEAD + 'sheet = "Data"\nskip_rows = 2\n' + RECORD.format("a.xlsx"), encoding="utf-8")
    is_good(single(path))
    table[704][3] = "over"
    (path / "a.xlsx").write_bytes(workbook({"Cover": [["x"]], "Data": table}))
    (error,) = check_dataset(path).errors
    assert str(error) == "error: a.xlsx: row 705, column 'Force [N]': 'over' is not a finite number"
    (path / "dataset.toml").write_text(HEAD + 'sheet = "data"\n' + RECORD.format("a.xlsx"), encoding="utf-8")
    assert "no sheet 'data' among Cover, Data" in str(check_dataset(path).errors[0])


def test_what_to_install_for_a_workbook(folder: Make, monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "python_calamine", None)
    (error,) = check_dataset(folder({"a.xlsx": "x"})).errors
    assert error.message == ".xlsx files need the package python-calamine: pip install 'twintube[formats]'"


def test_a_window_cuts_what_is_wrong_outside(folder: Make) -> None:
    c = good()
    force = [f"{x:.9g}" for x in c[F]]
    force[5], force[1450] = "over", ""
    path = folder({"a.csv": {T: c[T], Z: c[Z], F: [f"{x}" for x in force]}})
    assert len(check_dataset(path).errors) == 1
    toml = HEAD + RECORD.format("a.csv")
    is_good(single(folder({}, toml=toml + "start_s = 0.1\nend_s = 2.8\n")), 50, 1401)
    with pytest.raises(DataError, match=r"0 samples for start_s = 5 to end_s = 6; the file has 0 to 3 s"):
        load_dataset(folder({}, toml=toml + "start_s = 5\nend_s = 6\n"))
    with pytest.raises(DataError, match=r"start_s = 2 must be before end_s = 1"):
        load_dataset(folder({}, toml=toml + "start_s = 2\nend_s = 1\n"))


def test_excluded_samples_keep_their_stroke(folder: Make) -> None:
    c = {name: np.array(values) for name, values in good().items() if name != V}
    for name in (Z, F):
        c[name][500:520] = c[name][500]
    path = folder({"a.csv": c})
    (error,) = check_dataset(path).errors
    assert "set exclude = [[1, 1.038]]" in error.message
    record = single(folder({}, toml=HEAD + RECORD.format("a.csv") + "exclude = [[1, 1.038], [2.0, 2.0]]\n"))
    assert np.flatnonzero(~record.usable).tolist() == [*range(500, 520), 1000]
    np.testing.assert_allclose(record.stroke, c[Z] / 1e3, rtol=2e-5, atol=1e-8)


def test_keys_of_a_record(folder: Make) -> None:
    intact = RECORD.format("a.csv").replace("0.56", "1").replace("false", "true")
    keys = 'setting = "C3"\ngas_pressure = "150 psi"\ntemperature_degC = 41\nstart_temperature_degC = 40\n'
    record = single(folder({"a.csv": good()}, toml=HEAD + intact + keys))
    assert (record.setting, record.start_temperature) == ("C3", 40)
    assert record.gas_pressure == pytest.approx(150 * 6894.757)
    assert record.temperature is not None
    assert set(record.temperature.tolist()) == {41.0}
    measured = single(folder({"a.csv": good() | {"Temperature (°C)": np.full(1501, 30.0)}}, toml=HEAD + intact + keys))
    assert measured.temperature is not None
    assert set(measured.temperature.tolist()) == {30.0}
    assert any("temperature_degC = 41 of dataset.toml is not used" in finding.message for finding in measured.findings)


def test_several_settings_are_named(folder: Make) -> None:
    other = good() | {F: good()[F] * 1.5}
    toml = HEAD + RECORD.format("a.csv") + 'setting = "C3"\n' + RECORD.format("b.csv") + 'setting = "R5"\n'
    findings = load_dataset(folder({"a.csv": good(), "b.csv": other}, toml=toml)).findings
    (finding,) = [finding for finding in findings if finding.severity == "warning"]
    assert "line 2, setting: records of several settings, no single damper: C3 (a.csv), R5 (b.csv)" in str(finding)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ('gas_pressure = "10"', "gas_pressure = '10': must be a gauge pressure like '10 bar' or '150 psi'"),
        ("gas_pressure = 10", "must be a gauge pressure like '10 bar'"),
        ('gas_pressure = "10 bar"', "must be left out where gas_preload = false"),
        ("exclude = [1, 2]", "must be a list like [[1.25, 1.3]]"),
        ("exclude = [[2, 1]]", "must be a list like [[1.25, 1.3]]"),
        ("sample_rate_Hz = 0", "must be a number from 2 to 100000"),
        ("channels = 3", "must be tables like {force = "),
        ("channels = {forc = {scale = '500 N/V'}}", "channels: unknown 'forc', did you mean force?"),
        ("channels = {force = {skale = '500 N/V'}}", "channels: force: unknown 'skale', did you mean scale?"),
        ("channels = {force = {scale = '500 mm/V'}}", "force: scale = '500 mm/V': must be like '500 N/V'"),
        ("channels = {force = {scale = '0 N/V'}}", "and not 0"),
        ("channels = {force = {scale = 500}}", "must be like '500 N/V'"),
        ("channels = {force = {offset = '-12 V'}}", "unit 'V' is not a unit of force"),
        ("channels = {force = {}}", "it is empty"),
    ],
)
def test_bad_keys(folder: Make, line: str, message: str) -> None:
    findings = check_dataset(folder({"a.csv": good()}, toml=HEAD + RECORD.format("a.csv") + line + "\n")).errors
    assert [(f.file, f.row) for f in findings if message in f.message] == [("dataset.toml", 7)], findings
