"""`twintube new-dataset`: what bench files say about themselves, in German and English, is read off them."""

import contextlib
import time
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from typer.testing import CliRunner

from twintube.cli import app
from twintube.data import check_dataset, load_dataset
from twintube.data.dataset_toml.manifest import RECORD, TOP
from twintube.data.sniff.text import sniff
from twintube.engine.simulate import InputError

RUNNER = CliRunner()
Array = NDArray[np.float64]
TIME: Array = np.arange(0.0, 6.0, 0.002)
STROKE: Array = 45.0 * np.sin(2 * np.pi / 1.5 * TIME)  # [mm]
SPEED: Array = np.gradient(STROKE, TIME)
FORCE: Array = 2000.0 * np.sign(SPEED) * np.abs(SPEED / 200.0) ** 0.7 + 3.0 * np.sin(97.0 * TIME)  # [N]
STATE = ["--oil-level", "0.6", "--gas-lost", "SA8"]


def table(head: str, columns: Sequence[Array], delimiter: str = ",", decimal: str = ".") -> str:
    rows = [delimiter.join(f"{x:.7g}".replace(".", decimal) for x in row) for row in zip(*columns, strict=True)]
    return head + "\n".join(rows) + "\n"


FILES: dict[str, tuple[str, str]] = {  # name: text, encoding
    "plain.csv": (table("time [s],stroke [mm],force [N]\n", (TIME, STROKE, FORCE)), "utf-8"),
    "german.csv": (
        table("Zeit [s];Weg [mm];Kraft [kN];Öltemperatur [°C]\n", (TIME, STROKE, FORCE / 1e3, 25 + 0 * TIME), ";", ","),
        "cp1252",
    ),
    "unit_row.csv": (
        table("Prüfstand 7\nDatum;12.03.2026\n\nZeit;Kolbenweg;Dämpferkraft\ns;mm;N\n", (TIME, STROKE, FORCE), ";", ","),
        "utf-8",
    ),
    "english.txt": (
        table("Time(ms)\tDisplacement (mm)\tLoad (kN)\tSpeed mm/s\n", (1e3 * TIME, STROKE, FORCE / 1e3, SPEED), "\t"),
        "utf-8",
    ),
    "spaces.dat": (table("Time [s]   Stroke [mm]  Force [N]\n", (TIME, STROKE, FORCE), "  "), "utf-8"),
    "no_header.csv": (table("", (TIME, STROKE, FORCE)), "utf-8"),
    "no_units.csv": (table("t,x_soll,x_ist,F,remark\n", (TIME, STROKE + 1.0, STROKE, FORCE, 0 * TIME)), "utf-8"),
    "underscores.csv": (table("# rate 500\ntime_s,stroke_mm,force_N\n", (TIME, STROKE, FORCE)), "utf-8"),
    "windows.csv": (table("Hub / mm;Kraft / N;Zeit / s\n", (STROKE, FORCE, TIME), ";").replace("\n", "\r\n"), "utf-16"),
    "in.csv": (table("Weg in mm;Kraft in N;Zeit in s\n", (STROKE, FORCE, TIME), ";", ","), "utf-8"),
}


@pytest.mark.parametrize("name", FILES)
def test_a_foreign_file_gives_its_record(name: str, tmp_path: Path) -> None:
    text, encoding = FILES[name]
    source = tmp_path / name
    source.write_bytes(text.encode(encoding))
    run = RUNNER.invoke(app, ["new-dataset", str(tmp_path / "set"), "--from", str(source), *STATE])
    assert run.exit_code == 0, run.output
    (record,) = load_dataset(tmp_path / "set").records
    assert (record.measurement, record.oil_level, record.gas_preload) == ("harmonic", 0.6, False)
    np.testing.assert_allclose(record.time, TIME, atol=1e-9)
    np.testing.assert_allclose(record.stroke, STROKE * 1e-3, atol=1e-7)
    np.testing.assert_allclose(record.force, FORCE, rtol=1e-5, atol=1e-3)
    assert f"then run: twintube check {tmp_path / 'set'}" in run.output


def test_what_is_not_sure_is_said(tmp_path: Path) -> None:
    for name in ("no_header.csv", "no_units.csv"):
        (tmp_path / name).write_text(FILES[name][0], encoding="utf-8")
    run = RUNNER.invoke(app, ["new-dataset", str(tmp_path)])
    assert run.exit_code == 0, run.output
    toml = (tmp_path / "dataset.toml").read_text(encoding="utf-8")
    for said in (
        "damper: none was given, SA8 is assumed",
        "columns: the file has no header",
        "stroke: taken from 'x_ist'; 'x_soll' would fit too",
        "force: the file gives no unit, N is guessed",
    ):
        assert f'    "{said}' in toml
        assert f"not sure: {said}" in run.output
    assert "Next: confirm what is not sure" in run.output


def test_what_no_file_tells_is_unknown_and_the_reference_comes_first(tmp_path: Path, monkeypatch: Any) -> None:
    """A workshop's case: two records of a damper, one of them from before, and nobody knows its fill."""
    monkeypatch.chdir(tmp_path)
    for name, gain in (("after.csv", 0.8), ("before.csv", 1.0)):
        Path(name).write_text(table("time [s],stroke [mm],force [N]\n", (TIME, STROKE, gain * FORCE)))
    run = RUNNER.invoke(app, ["new-dataset", "set", "--from", "after.csv", "--reference", "before.csv", "SA8"])
    assert run.exit_code == 0, run.output
    records = load_dataset("set").records
    assert [(r.file, r.reference, r.state) for r in records] == [("before.csv", True, "1"), ("after.csv", False, "2")]
    assert {(r.oil_level, r.gas_preload) for r in records} == {(None, None)}
    assert "where you know it, write a number such as 0.6" in Path("set/dataset.toml").read_text()
    assert "unknown: oil level and gas preload of before.csv (state 1), " in run.output
    assert run.output.endswith("which needs oil level and gas preload stated\n")


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["--reference", "set/b.csv"], [("b.csv", True), ("a.csv", False)]),  # it lies in the folder with others
        (["--from", "set/a.csv", "--from", "set/b.csv", "--reference", "set/b.csv"], [("b.csv", True), ("a.csv", False)]),
        (["--reference", "set/a.csv", "--reference", "set/b.csv"], [("a.csv", True), ("b.csv", True)]),
    ],
)
def test_a_reference_is_taken_once(
    arguments: list[str], expected: list[tuple[str, bool]], tmp_path: Path, monkeypatch: Any
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("set").mkdir()
    for name, gain in (("a.csv", 0.8), ("b.csv", 1.0)):
        Path("set", name).write_text(table("time [s],stroke [mm],force [N]\n", (TIME, STROKE, gain * FORCE)))
    assert RUNNER.invoke(app, ["new-dataset", "set", *arguments, "--oil-level", "0.6"]).exit_code == 0
    records = load_dataset("set").records
    assert [(record.file, record.reference) for record in records] == expected
    assert {(record.oil_level, record.gas_preload) for record in records} == {(0.6, None)}


def test_the_template_names_every_key(tmp_path: Path) -> None:
    assert RUNNER.invoke(app, ["new-dataset", str(tmp_path / "new")]).exit_code == 0
    toml = (tmp_path / "new" / "dataset.toml").read_text(encoding="utf-8")
    for key in {*TOP, *RECORD} - {"record"}:
        assert f"\n{key} = " in toml or f"\n# {key} = " in toml, key
    assert "[[record]]" in toml
    (error,) = check_dataset(tmp_path / "new").errors
    assert "the dataset is empty" in error.message
    uncommented = toml.replace("# file", "file")
    tomllib.loads(uncommented[: uncommented.index("# The records")])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--from", "text.csv"], "text.csv: no table of at least two columns of numbers"),
        (["--from", "commas.csv"], "commas.csv: delimiter and decimal sign seem to be the comma both"),
        (["--from", "a.pdf"], "a.pdf: unknown format '.pdf', must be one of .csv"),
        (["--from", "nowhere.csv"], "nowhere.csv"),
        (["--from", "good.csv", "--from", "text.csv"], "text.csv: no table"),
        (["--from", "good.csv", "sa9"], "error: unknown damper sa9"),
        (["--from", "empty.csv"], "empty.csv: no table"),
    ],
)
def test_what_cannot_be_used_leaves_nothing(arguments: list[str], message: str, tmp_path: Path, monkeypatch: Any) -> None:
    monkeypatch.chdir(tmp_path)
    Path("text.csv").write_text("This is a letter, not a record.\nIt goes on; and on.\n")
    Path("commas.csv").write_text(table("Zeit,Weg,Kraft\n", (TIME + 0.0005, STROKE + 0.0005, FORCE + 0.0005), ",", ","))
    Path("good.csv").write_text(FILES["plain.csv"][0])
    Path("a.pdf").write_text("")
    Path("empty.csv").write_text("")
    run = RUNNER.invoke(app, ["new-dataset", "set", *arguments])
    assert run.exit_code == 2
    assert message in run.stderr
    assert run.stderr.count("\n") == 1
    assert not Path("set").exists()


def test_nothing_is_overwritten(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("a.csv").write_text(FILES["plain.csv"][0])
    Path("set").mkdir()
    Path("set/a.csv").write_text("another\n")
    run = RUNNER.invoke(app, ["new-dataset", "set", "--from", "a.csv"])
    assert run.exit_code == 2
    assert "is there already; it is not overwritten" in run.stderr
    assert Path("set/a.csv").read_text() == "another\n"
    Path("set/a.csv").unlink()
    assert RUNNER.invoke(app, ["new-dataset", "set", "--from", "a.csv"]).exit_code == 0
    before = Path("set/dataset.toml").read_text()
    assert RUNNER.invoke(app, ["new-dataset", "set"]).exit_code == 2
    assert Path("set/dataset.toml").read_text() == before


def test_hostile_headers_make_valid_toml(tmp_path: Path) -> None:
    head = 'time [s],stroke [mm],force [N],"\x1b[2J"" = 3 # \x07",\u2028\n'
    (tmp_path / "a.csv").write_text(table(head, (TIME, STROKE, FORCE, 0 * TIME, 0 * TIME)), encoding="utf-8")
    run = RUNNER.invoke(app, ["new-dataset", str(tmp_path), *STATE])
    assert run.exit_code == 0
    assert "\x1b" not in run.output
    tomllib.loads((tmp_path / "dataset.toml").read_text(encoding="utf-8"))


def test_measurements_are_told_by_their_motion(tmp_path: Path) -> None:
    seconds = np.arange(0.0, 180.0, 0.05)
    ramp = 45 * (2 / np.pi) * np.arcsin(np.sin(2 * np.pi * seconds / 180.0))
    rng = np.random.default_rng(1)
    drive = np.convolve(rng.standard_normal(len(seconds)), np.ones(20), "same")
    for name, stroke in (("quasi-static", ramp), ("stochastic", drive)):
        path = tmp_path / f"{name}.csv"
        path.write_text(table("time [s],stroke [mm],force [N]\n", (seconds, stroke, stroke)))
        assert sniff(path)[0].measurement == name


@pytest.mark.parametrize("order", [("velocity", "force"), ("force", "velocity")])
def test_without_a_header_the_velocity_is_the_derivative_of_the_stroke(order: tuple[str, str], tmp_path: Path) -> None:
    seconds = np.arange(0.0, 4.0, 0.002)
    velocity = 314.0 * np.cos(2 * np.pi * seconds)  # the force lags, and has friction
    channels = {"velocity": velocity, "force": 3.0 * np.roll(velocity, 25) + 200.0 * np.sign(velocity)}
    path = tmp_path / "a.txt"
    path.write_text(table("", (seconds, 50.0 * np.sin(2 * np.pi * seconds), *(channels[name] for name in order))))
    units = {"velocity": "velocity [mm/s]", "force": "force [N]"}
    assert sniff(path)[0].reading["columns"] == ["time [s]", "stroke [mm]", *(units[name] for name in order)]


@pytest.mark.parametrize(
    "text",
    [
        "1;" * 5_000_000,
        "time [s],stroke [mm]," + "[" * 5_000_000 + "\n",
        "\0" * 100_000,
        "1,2\n" * 3_000_000,
        "9" * 100_000 + ",1\n",
    ],
    ids=["wide", "brackets", "zeros", "long", "digits"],
)
def test_hostile_files_end_soon(text: str, tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text(text)
    start = time.process_time()
    with contextlib.suppress(InputError):
        sniff(path)
    assert time.process_time() - start < 5.0


def test_a_binary_file_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_bytes(bytes(range(256)) * 1000)
    with pytest.raises(InputError, match="no table"):
        sniff(path)


@pytest.mark.parametrize(("head", "unit"), [("force_kN_filtered", "kN"), ("Load_kg", "kgf"), ("Kraft (daN) Mittel", "daN")])
def test_the_unit_within_a_name_is_proposed(head: str, unit: str, tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text(table(f"time [s],stroke [mm],{head}\n", (TIME, STROKE, FORCE / 9.80665)))
    assert RUNNER.invoke(app, ["new-dataset", str(tmp_path), *STATE]).exit_code == 0
    assert f'"force [{unit}]" = "{head}"' in (tmp_path / "dataset.toml").read_text()
    assert not [finding for finding in check_dataset(tmp_path).errors if "named in" in finding.message]


def test_a_guess_is_repeated_by_check(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text(FILES["plain.csv"][0])
    assert RUNNER.invoke(app, ["new-dataset", str(tmp_path), "--oil-level", "1", "--gas-kept"]).exit_code == 0
    run = RUNNER.invoke(app, ["check", str(tmp_path)])
    assert run.exit_code == 0 and "line 5, not_sure: not confirmed: damper: none was given, SA8 is assumed" in run.output
    assert "not confirmed: measurement: harmonic" in run.output
