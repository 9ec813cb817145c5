"""What is built for FMI 3.0: sources, SSP 2.0, and what is refused before."""

import ctypes
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from typer.testing import CliRunner

from twintube.cli import app
from twintube.dampers import load
from twintube.fmu import BuildError, build_fmu, sources
from twintube.fmu.platforms import Fmi, known
from twintube.fmu.ssp import described
from twintube.fmu.standards import STANDARDS
from twintube.native import units
from twintube.native.compiler import compiled
from twintube.vehicle.cars import load_car
from twintube.vehicle.full.run import full_car

SPEED = 14.0


@pytest.mark.skipif(sys.platform != "linux", reason="objects are linked as on Linux")
def test_functions_of_the_sources_have_the_prefix_of_the_model(tmp_path: Path) -> None:
    """So that several are linked into one program; `test_source_build.py` links two of FMI 2.0."""
    for file, text in sources.sources(load("SA7"), "{}", STANDARDS[3]).items():
        (tmp_path / file).write_text(text)
    flags = ("-std=c99", "-O0", "-shared", f"-I{units.HEADERS}")
    compiled([tmp_path / STANDARDS[3].compiled], "x86_64-linux", tmp_path / "linked.so", flags)
    linked = ctypes.CDLL(str(tmp_path / "linked.so"))
    version = linked.twintube_SA7_fmi3GetVersion
    version.restype = ctypes.c_char_p
    assert version() == b"3.0"
    assert not hasattr(linked, "fmi3GetVersion")


def numbers(text: bytes, kind: str) -> dict[str, tuple[list[float], str | None]]:
    """Values and units of the parameters in an SSV, arrays under the names of their elements."""
    found = {}
    for parameter in ET.fromstring(text).iter("{*}Parameter"):
        value = parameter[0]
        assert value.tag.partition("}")[2] in (kind, "Int32", "Integer")
        values, dimension = [float(x) for x in value.get("value", "").split()], parameter.find("{*}Dimension")
        assert (dimension is None) == (len(values) == 1)
        name = parameter.get("name", "")
        for i, number in enumerate(values, 1):
            found[name if dimension is None else f"{name}[{i}]"] = ([number], value.get("unit"))
    return found


def test_ssp_2_says_the_same_in_the_types_of_fmi_3() -> None:
    """Both texts were also checked with the schemas of SSP 2.0, which fmpy does not bring."""
    car = full_car(load_car(), [load("SA7")] * 2 + [load("SA8")] * 2)
    old, new = described(car, SPEED), described(car, SPEED, 2)
    assert list(old) == list(new)
    for name in old:
        assert [ET.fromstring(files[name]).get("version") for files in (old, new)] == ["1.0", "2.0"]
        if name.endswith(".ssv"):
            assert numbers(old[name], "Real") == numbers(new[name], "Float64")
    connectors = [ET.fromstring(files["SystemStructure.ssd"]).findall(".//{*}Connector") for files in (old, new)]
    kinds = [{connector[0].tag.partition("}")[2] for connector in each} for each in connectors]
    assert kinds == [{"Real"}, {"Float64"}]
    assert [[c.get("name"), c[0].get("unit")] for c in connectors[0]] == [
        [c.get("name"), c[0].get("unit")] for c in connectors[1]
    ]


@pytest.fixture
def stale(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str, str, str], None]:
    """Changes a text in a file of a copy of the sources, which is used in their place."""

    def change(file: str, old: str, new: str) -> None:
        shutil.copytree(units.SOURCES, tmp_path / "sources")
        path = tmp_path / "sources" / "native" / file
        text = path.read_text(encoding="utf-8")
        assert old in text
        path.write_text(text.replace(old, new, 1), encoding="utf-8")
        monkeypatch.setattr(units, "SOURCES", tmp_path / "sources")

    return change


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            ("variables.h", '"oil_level"', '"oil"'),
            r"variables\.h is not that of these variables: run `python -m twintube\.fmu`",
        ),
        (("messages.h", "must be", "may be"), r"messages\.h is not that"),
        (("state.h", "no memory", "no room"), r"damper_fmi[23]\.\w+: is not compiled from these equations and sources"),
    ],
)
def test_stale_c_is_refused(
    stale: Callable[[str, str, str], None], fmi: Any, change: tuple[str, str, str], message: str, tmp_path: Path
) -> None:
    stale(*change)
    with pytest.raises(BuildError, match=message):
        build_fmu(load("SA8"), tmp_path / "a.fmu", fmi=fmi)
    assert not (tmp_path / "a.fmu").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--fmi", "3", "--kind", "python"], "fmi = 3, kind = python: the Python kind is built for FMI 2 only"),
        (["--fmi", "3", "--platform", "linux46"], "platform = linux46: must be one of x86_64-linux, aarch64-linux, x86_64-windows"),
        (["--test", "a.fmu", "--oil-level", "1"], "--test a.fmu: a test builds nothing, leave out oil_level, damper"),
    ],
)  # fmt: skip
def test_what_does_not_go_together_is_refused_with_a_line(
    arguments: list[str], message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    run = CliRunner().invoke(app, ["fmu", "SA8", *arguments])
    assert run.exit_code == 2 and run.stderr.startswith(f"error: {message}") and run.stderr.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("fmi", "named", "found"),
    [
        (2, "linux64", ("linux64",)),
        (2, "x86_64-linux", ("linux64",)),
        (2, "x86_64-windows", ("win64",)),
        (2, "aarch64-linux", ("aarch64-linux",)),
        (2, "aarch64-darwin", ("darwin64",)),  # its library is for both processors
        (3, "linux64", ("x86_64-linux",)),
        (3, "win64", ("x86_64-windows",)),
        (3, "darwin64", ("x86_64-darwin", "aarch64-darwin")),
        (3, "x86_64-darwin", ("x86_64-darwin",)),
    ],
)
def test_a_platform_has_its_names_of_both_versions(fmi: Fmi, named: str, found: tuple[str, ...]) -> None:
    assert known([named], fmi) == found
    assert known([*found, named], fmi) == found
