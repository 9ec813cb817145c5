"""`twintube fmu --test`: an FMU against the reference run that it carries."""

import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import CliRunner

from twintube.cli import app
from twintube.fmu import archive
from twintube.fmu.related import FOLDER


def trial(fmu: Path) -> tuple[int, str]:
    """Exit status and the line."""
    run = CliRunner().invoke(app, ["fmu", "--test", str(fmu)])
    text = run.stdout + run.stderr
    assert text.count("\n") == 1, text
    return run.exit_code, text


def test_an_fmu_computes_its_reference_here(sa8_fmu: Path, sa8_fmi3: Path) -> None:
    for fmu in (sa8_fmu, sa8_fmi3):
        status, text = trial(fmu)
        assert status == 0
        assert "computes its reference run; largest difference: force 0 N of 1707 N, k_degr 0 of 1" in text


def changed(fmu: Path, folder: Path, change: Callable[[dict[str, bytes]], None]) -> Path:
    """An FMU with other files."""
    with zipfile.ZipFile(fmu) as packed:
        content = {name: packed.read(name) for name in packed.namelist()}
    change(content)
    archive.write(folder / "other.fmu", content)
    return folder / "other.fmu"


def scaled(name: str, column: int, factor: float) -> Callable[[dict[str, bytes]], None]:
    """Multiplies a column of a table from its row 100 on."""

    def change(content: dict[str, bytes]) -> None:
        lines = content[f"{FOLDER}/{name}"].decode().splitlines()
        for i in range(100, len(lines)):
            cells = lines[i].split(",")
            cells[column] = repr(float(cells[column]) * factor)
            lines[i] = ",".join(cells)
        content[f"{FOLDER}/{name}"] = "\n".join(lines).encode()

    return change


def test_a_difference_is_told_with_status_1(sa8_fmi3: Path, tmp_path: Path) -> None:
    status, text = trial(changed(sa8_fmi3, tmp_path, scaled("reference.csv", 1, 1.0 + 1e-8)))
    assert status == 1 and "differs from its reference run by more than 1e-09; largest difference: force 1.7" in text
    assert trial(changed(sa8_fmi3, tmp_path, scaled("reference.csv", 1, 1.0 + 1e-11)))[0] == 0
    status, text = trial(changed(sa8_fmi3, tmp_path, scaled("reference.csv", 2, float("nan"))))
    assert status == 1 and "k_degr inf" in text


def test_a_refused_step_is_told_with_status_1(sa8_fmi3: Path, tmp_path: Path) -> None:
    status, text = trial(changed(sa8_fmi3, tmp_path, scaled("input.csv", 1, 10.0)))
    assert status == 1 and "the step returned Error: Error: stroke" in text


def test_a_library_that_is_none_is_told_with_status_1(sa8_fmi3: Path, tmp_path: Path) -> None:
    def change(content: dict[str, bytes]) -> None:
        (library,) = (name for name in content if name.startswith("binaries/"))
        content[library] = b"no library"

    status, text = trial(changed(sa8_fmi3, tmp_path, change))
    assert status == 1 and "other.fmu: " in text


def test_a_library_of_another_fmu_is_told_with_status_1(sa8_fmi3: Path, tmp_path: Path) -> None:
    def change(content: dict[str, bytes]) -> None:
        content[archive.XML] = content[archive.XML].replace(b'instantiationToken="{', b'instantiationToken="{0')

    status, text = trial(changed(sa8_fmi3, tmp_path, change))
    assert status == 1 and "this binary belongs to" in text


def without(start: str) -> Callable[[dict[str, bytes]], None]:
    """Takes files away."""

    def change(content: dict[str, bytes]) -> None:
        for name in [name for name in content if name.startswith(start)]:
            del content[name]

    return change


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (without(f"{FOLDER}/reference.csv"), "reference.csv: the FMU carries no reference run"),
        (without("binaries/"), "only for none"),
        (lambda content: content.update({f"{FOLDER}/input.csv": b'"time","stroke"\n0.0,here\n'}), "is not an FMU that can be read"),
        (lambda content: content.update({f"{FOLDER}/input.csv": b""}), "input.csv: is not a table with a row of names"),
        (lambda content: content.update({f"{FOLDER}/input.csv": b'"time","strike"\n0.0,0.0\n'}), "strike is missing"),
        (lambda content: content.update({f"{FOLDER}/input.csv": b'"time","stroke"\n0.0,0.0\n'}), "has 1 rows, reference.csv 2001"),
    ],
)  # fmt: skip
def test_what_cannot_be_tried_is_refused(
    sa8_fmi3: Path, tmp_path: Path, change: Callable[[dict[str, bytes]], None], message: str
) -> None:
    status, text = trial(changed(sa8_fmi3, tmp_path, change))
    assert status == 2 and message in text


def test_a_file_that_is_no_fmu_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.fmu").write_text("no zip")
    assert trial(tmp_path / "a.fmu")[0] == 2
    assert trial(tmp_path / "b.fmu")[0] == 2
    with zipfile.ZipFile(tmp_path / "c.fmu", "w") as packed:
        packed.writestr("hello", "")
    status, text = trial(tmp_path / "c.fmu")
    assert status == 2 and "carries no reference run" in text
