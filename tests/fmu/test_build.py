"""Building: the same bytes twice, files as the standard places them, refusals before anything is built."""

import re
import stat
import zipfile
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

import fmpy
import pytest
from fmpy.validation import validate_fmu
from lxml import etree
from typer.testing import CliRunner

from twintube.cli import app
from twintube.dampers import Damper, load
from twintube.fmu import BuildError, binaries, build_fmu, description, documentation
from twintube.fmu.description import model_name
from twintube.fmu.platforms import Kind
from twintube.fmu.ssv import to_ssv

HERE = (fmpy.platform,)
SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"
LS = "{http://fmi-standard.org/fmi-ls-manifest}"


def files(fmu: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(fmu) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def test_two_builds_are_the_same_bytes(kind: Kind, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    built = [build_fmu(load("SA8"), tmp_path / name / "a.fmu", kind, HERE) for name in "ab"]
    assert built[0].read_bytes() == built[1].read_bytes()
    assert b'generationDateAndTime="2023-11-14T22:13:20Z"' in files(built[0])["modelDescription.xml"]


def test_only_the_date_differs_without_source_date_epoch(
    kind: Kind, sa8_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "0")
    old, new = files(build_fmu(load("SA8"), tmp_path, kind, HERE)), files(sa8_fmu)
    assert list(old) == list(new)
    assert [name for name in old if old[name] != new[name]] == ["modelDescription.xml"]


def test_entries_are_files_that_all_may_read(sa8_fmu: Path) -> None:
    with zipfile.ZipFile(sa8_fmu) as archive:
        for entry in archive.infolist():
            assert entry.external_attr >> 16 == stat.S_IFREG | 0o644
            assert entry.date_time == (1980, 1, 1, 0, 0, 0)
            assert entry.compress_type == zipfile.ZIP_DEFLATED
            assert entry.filename.isascii() and "\\" not in entry.filename


def test_validation_by_fmpy_finds_nothing(sa8_fmu: Path) -> None:
    """It also parses every name, which takes longer than the build."""
    assert validate_fmu(str(sa8_fmu)) == []


def test_a_description_that_the_schema_refuses_is_not_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(description, "EXPERIMENT", {"startTime": "soon"})
    with pytest.raises(BuildError, match=r"modelDescription\.xml is not valid: .*'soon' is not a valid value"):
        build_fmu(load("SA8"), tmp_path / "a.fmu", platforms=HERE)
    assert list(tmp_path.iterdir()) == []


def test_terminals_are_valid_and_their_members_are_variables(sa8_fmu: Path) -> None:
    content = files(sa8_fmu)
    text = content["terminalsAndIcons/terminalsAndIcons.xml"]
    etree.XMLSchema(etree.parse(str(SCHEMA))).assertValid(etree.fromstring(text))
    members = [m.get("variableName") for m in ET.fromstring(text).findall("Terminals/Terminal/TerminalMemberVariable")]
    assert members == ["stroke", "velocity", "force"]
    known = {v.name for v in fmpy.read_model_description(str(sa8_fmu)).modelVariables}
    assert set(members) <= known
    assert content["terminalsAndIcons/icon.png"].startswith(b"\x89PNG")


def test_the_manifest_names_the_reference_run(sa8_fmu: Path) -> None:
    content = files(sa8_fmu)
    folder = "extra/org.fmi-standard.fmi-ls-ref"
    root = ET.fromstring(content[f"{folder}/fmi-ls-manifest.xml"])
    assert root.tag == "fmiReferences"
    assert root.get(f"{LS}fmi-ls-name") == "org.fmi-standard.fmi-ls-ref"
    named = {related.get("source", ""): related.get("role") for related in root.findall("Related")}
    assert named == {"input.csv": "testcase", "reference.csv": "result"}
    for name in named:
        assert content[f"{folder}/{name}"].startswith(b'"time",')


def test_licences_of_what_is_inside_travel_along(sa8_fmu: Path, kind: Kind) -> None:
    content = files(sa8_fmu)
    folder = "documentation/licenses"
    inside = {name.removeprefix(f"{folder}/") for name in content if name.startswith(folder)}
    assert inside == {"license.txt"} | ({"fmi_headers.txt", "zig.txt"} if kind == "native" else {"pythonfmu.txt"})
    for name in inside - {"license.txt"}:
        assert name in content[f"{folder}/license.txt"].decode()
        assert b"opyright" in content[f"{folder}/{name}"]
    assert ("documentation/externalDependencies.txt" in content) == (kind == "python")


def named(name: str) -> Damper:
    return replace(load("SA8"), name=name, title=f"title of {name}")


def test_identifiers_are_ascii_and_tell_dampers_apart() -> None:
    assert model_name(named("SA8")) == "twintube_SA8"
    assert model_name(named("7 Dämpfer, hinten")) == "twintube_7_Dampfer__hinten"
    odd = ["減衰器", "アブソーバ", "Ж1", "a" * 80, "a" * 81, "x\x1b[31m", "../../x", "nul\0", "\ud800", "٣"]
    identifiers = [model_name(named(name)) for name in odd]
    assert len(set(identifiers)) == len(odd)
    for identifier in identifiers:
        assert identifier.isascii() and identifier.isidentifier() and len(identifier) <= 48


def test_control_characters_of_a_name_reach_neither_page_nor_files() -> None:
    damper = named("<b>\x1b[31mred\x07\ufffe\ud800")
    texts = [
        documentation.page(damper, "native"),
        to_ssv(damper),
        description.described(damper, "{}", "", {}, sources=[], categories=[]).decode(),
    ]
    for text in texts:
        text.encode()
        assert not re.search(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\ufffe]", text)
    for text in texts[1:]:
        ET.fromstring(text)
    assert "&lt;b&gt;" in texts[0]


def test_control_characters_of_a_file_do_not_reach_the_terminal(tmp_path: Path) -> None:
    text = CliRunner().invoke(app, ["dampers", "SA8"]).output.replace('"SA8"', '"\\u001b[31mred\\u0007"', 1)
    (tmp_path / "odd.toml").write_text(text, encoding="utf-8")
    for command in (["fmu", str(tmp_path / "odd.toml"), "--kind", "python"], ["fmu", "--ssv", str(tmp_path / "odd.toml")]):
        run = CliRunner().invoke(app, [*command, "--output", str(tmp_path / "out")])
        assert "red" in run.output
        assert "\x1b" not in run.output and "\x07" not in run.output


@pytest.fixture
def nothing_is_built(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> bytes:
        raise AssertionError("a library was taken")

    monkeypatch.setattr(binaries, "library", refuse)


def test_bad_arguments_are_refused_before_anything_is_built(
    nothing_is_built: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("")
    (tmp_path / "folder.fmu").mkdir()
    with pytest.raises(OSError, match="file"):
        build_fmu(load("SA8"), tmp_path / "file" / "a.fmu")
    with pytest.raises(IsADirectoryError, match=r"folder\.fmu: is a folder"):
        build_fmu(load("SA8"), tmp_path / "folder.fmu")
    with pytest.raises(BuildError, match="platform = linux46: must be one of linux64, aarch64-linux, win64, darwin64"):
        build_fmu(load("SA8"), tmp_path / "a.fmu", platforms=("linux46",))
    sa8 = load("SA8")
    with pytest.raises(BuildError, match=r"SA8: oil_level = 1\.7"):
        build_fmu(replace(sa8, parameters=replace(sa8.parameters, oil_level=1.7)), tmp_path / "a.fmu")
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "yesterday")
    with pytest.raises(BuildError, match="SOURCE_DATE_EPOCH = yesterday: must be a whole number"):
        build_fmu(load("SA8"), tmp_path / "a.fmu")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "folder.fmu"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["mine.toml", "SA7"], "Got unexpected extra argument"),
        (["SA8", "--ssv", "--kind", "python"], "--ssv: holds parameters for every library, leave out kind"),
        (["SA8", "--platform", "linux46"], "platform = linux46: must be one of linux64, aarch64-linux, win64, darwin64"),
        (["SA8", "--kind", "python", "--platform", "linux64"], "--platform linux64: only for the native kind"),
        (["SA8", "--output", "file/a.fmu"], "file"),
    ],
)
def test_command_refuses_with_a_line(
    arguments: list[str], message: str, nothing_is_built: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.toml").write_text(CliRunner().invoke(app, ["dampers", "SA8"]).output)
    (tmp_path / "file").write_text("")
    run = CliRunner().invoke(app, ["fmu", *arguments])
    assert run.exit_code == 2
    assert message in run.stderr
    assert run.stderr.startswith("error: ") and run.stderr.count("\n") == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "mine.toml"]
