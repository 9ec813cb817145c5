"""Names of columns in the file against what dataset.toml takes them for: units, masses, set points, other quantities."""

from collections.abc import Callable
from pathlib import Path

import pytest

from tests.data.conftest import good
from twintube.data import Finding, check_dataset
from twintube.data.check.column_claims import check_unit
from twintube.data.convert.column_names import assigned
from twintube.data.findings import Notes


def found(name: str, stated: str) -> list[Finding]:
    """The findings on a column of this name where `columns` says `stated`, as in `force [N]`."""
    quantity, unit = stated[:-1].split(" [")
    notes = Notes("a.csv")
    check_unit(name, quantity, unit, stated, scaled=False, notes=notes)
    return notes.findings


@pytest.mark.parametrize("unit", ["kN", "daN", "kgf", "kp", "lbf", "lb", "lbs", "kip", "mN", "dyn"])
@pytest.mark.parametrize("form", ["Load ({})", "Kraft [{}]", "Axial Load ({}) avg"])
def test_a_force_in_another_unit_is_refused(unit: str, form: str) -> None:
    (finding,) = found(form.format(unit), "force [N]")
    assert finding.severity == "error"
    assert f"is named in {unit}, dataset.toml says N; write" in finding.message


@pytest.mark.parametrize(
    ("stated", "units"),
    [
        ("stroke [mm]", ["m", "cm", "um", "µm", "in", "inch", "ft", "mil", '"']),
        ("stroke [in]", ["mm", "ft"]),
        ("velocity [m/s]", ["mm/s", "in/s", "ft/s", "km/h", "mph", "cm/s", "mm/min"]),
        ("time [s]", ["ms", "min", "us", "h"]),
        ("time [ms]", ["s", "sec"]),
        ("temperature [degC]", ["K", "°F", "degF"]),
    ],
)
def test_other_quantities_in_another_unit_are_refused(stated: str, units: list[str]) -> None:
    for unit in units:
        for form in ("Channel 3 [{}]", "Channel 3 ({})"):
            (finding,) = found(form.format(unit), stated)
            assert finding.severity == "error" and f"is named in {unit}, dataset" in finding.message


@pytest.mark.parametrize(
    "name", ["Load_lbf", "Load, lbf", "load/lbf", "Load lbf", "Load in lbf", "Load-lbf", "rig.load_lbf_f", "lbf", "lbf load"]
)
def test_every_way_to_write_a_unit_counts(name: str) -> None:
    (finding,) = found(name, "force [N]")
    assert finding.severity == "error" and f'write "force [lbf]" = "{name}"' in finding.message
    assert found(name, "force [lbf]") == []


@pytest.mark.parametrize(("mass", "advice"), [("kg", "force [kgf]"), ("g", "force [gf]"), ("t", "9806.65 N/t")])
def test_a_mass_is_no_force(mass: str, advice: str) -> None:
    (finding,) = found(f"Last ({mass})", "force [N]")
    assert finding.severity == "error" and f"{mass} is a mass" in finding.message and advice in finding.message


def test_a_mass_is_read_where_the_user_states_its_weight() -> None:
    assert found("Last [kg]", "force [kgf]") == found("Last_kg", "force [kgf]") == []


@pytest.mark.parametrize(
    ("name", "stated"),
    [
        ("Load (actual)", "force [N]"), ("Force (filtered)", "force [N]"), ("Force (F)", "force [N]"),
        ("Weg (s)", "stroke [mm]"), ("x_F[0]", "stroke [mm]"), ("x_F", "stroke [mm]"), ("Force min", "force [N]"),
        ("Load cell 25kN", "force [N]"), ("Load (-)", "force [N]"), ("Kraft (F) [N]", "force [N]"),
        ("Time (sec)", "time [s]"), ("Temp (C)", "temperature [degC]"), ("Last (kp)", "force [kgf]"), ("F_N", "force [N]"),
    ],
)  # fmt: skip
def test_words_and_symbols_are_no_units(name: str, stated: str) -> None:
    assert found(name, stated) == []


@pytest.mark.parametrize(
    ("name", "stated"),
    [("Load [div]", "force [N]"), ("Load (N/mm²)", "force [N]"), ("x_m", "stroke [mm]"), ("x_in", "stroke [mm]"),
     ("Load cell 10 kN", "force [N]")],
)  # fmt: skip
def test_what_may_be_a_unit_is_a_warning(name: str, stated: str) -> None:
    assert [finding.severity for finding in found(name, stated)] == ["warning"]


@pytest.mark.parametrize("unit", ["V", "bar", "%", "mm"])
def test_a_unit_of_something_else_is_refused(unit: str) -> None:
    (finding,) = found(f"Force ({unit})", "force [N]")
    assert finding.severity == "error" and "that is no unit of force" in finding.message


def renamed(columns: dict[str, str]) -> dict[str, object]:
    return {columns.get(name, name): values for name, values in good().items()}


def test_check_refuses_the_file_and_says_what_to_write(folder: Callable[..., Path]) -> None:
    top = 'damper = "SA8"\ncolumns = {"time [s]" = "time [s]", "stroke [mm]" = "stroke [mm]", "force [N]" = "Load (lbf)"}'
    (error,) = check_dataset(folder({"a.csv": renamed({"force [N]": "Load (lbf)"})}, top)).errors
    assert error.file == "a.csv" and 'write "force [lbf]" = "Load (lbf)"' in error.message


@pytest.mark.parametrize(
    "head", ["time,stroke,speed,Load (lbf)\n", "Rig 3,,,\ntime,stroke,speed,Load\ns,mm,mm/s,lbf\n"], ids=["name", "unit row"]
)
def test_a_header_that_is_skipped_is_read_for_its_units(folder: Callable[..., Path], head: str) -> None:
    rows = "".join(",".join(f"{x:.6g}" for x in row) + "\n" for row in zip(*good().values(), strict=True))
    top = 'damper = "SA8"\ncolumns = ["time [s]", "stroke [mm]", "velocity [mm/s]", "force [N]"]\n'
    path = folder({"a.csv": head + rows}, top + f"skip_rows = {head.count(chr(10))}")
    (error,) = check_dataset(path).errors
    assert "is named in lbf, dataset.toml says N" in error.message


def test_a_row_of_masses_is_read_where_its_weight_is_stated(folder: Callable[..., Path]) -> None:
    rows = "".join(",".join(f"{x:.6g}" for x in row) + "\n" for row in zip(*good().values(), strict=True))
    text = "t,x,v,F\ns,mm,mm/s,kg\n" + rows
    for unit, right in (("kgf", True), ("N", False)):
        top = f'damper = "SA8"\ncolumns = {{"time [s]" = "t", "stroke [mm]" = "x", "force [{unit}]" = "F"}}'
        assert bool(check_dataset(folder({"a.csv": text}, top)).errors) is not right


@pytest.mark.parametrize(
    ("column", "told"),
    [("Sollkraft", "set point"), ("Load Ref", "set point"), ("LoadCmd", "set point"), ("Kraft (nominal)", "set point"),
     ("Axial Displacement", "named like a stroke"), ("Istkraft", ""), ("Load set 2 actual", "")],
)  # fmt: skip
def test_a_column_of_something_else_is_a_warning(folder: Callable[..., Path], column: str, told: str) -> None:
    top = f'damper = "SA8"\ncolumns = {{"time [s]" = "time [s]", "stroke [mm]" = "stroke [mm]", "force [N]" = "{column}"}}'
    findings = check_dataset(folder({"a.csv": renamed({"force [N]": column})}, top)).findings
    assert any(told in finding.message for finding in findings if finding.severity == "warning") or not told
    assert told or not any("named" in finding.message for finding in findings)


@pytest.mark.parametrize(
    ("names", "taken"),
    [
        (["Sollweg [mm]", "Istweg [mm]"], 1), (["Axial Displacement Cmd (mm)", "Axial Displacement (mm)"], 1),
        (["Displacement Setpoint (mm)", "Feedback (mm)"], 1), (["x_target (mm)", "Travel (mm)"], 1),
        (["StrokeRef [mm]", "StrokeAct [mm]"], 1), (["Position demand (mm)", "Position (mm)"], 1),
    ],
)  # fmt: skip
def test_the_measured_one_of_two_is_taken(names: list[str], taken: int) -> None:
    pairs = [(name.rsplit(" ", 1)[0], "mm") for name in names]
    assert assigned(pairs, [])["stroke"][0] == taken


def test_a_set_point_alone_is_doubtful() -> None:
    doubts: list[str] = []
    assert assigned([("Sollweg", "mm")], doubts)["stroke"] == (0, "mm")
    assert any("named as a set point" in doubt for doubt in doubts)
