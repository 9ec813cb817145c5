"""Libraries that were compiled once: values put in, signed anew, refused where they are of other sources or missing."""

import ctypes
import re
import struct
import subprocess
import sys
from pathlib import Path
from typing import Any

import fmpy
import pytest
from typer.testing import CliRunner

from twintube.cli import app
from twintube.dampers import load
from twintube.fmu import BuildError, build_fmu, signature, sources
from twintube.fmu.binaries import MACHINES, binary, complete, filled, universal
from twintube.fmu.car import car_model
from twintube.fmu.description import damper_model
from twintube.fmu.standards import STANDARDS
from twintube.native import compiler, units
from twintube.native.compiler import TARGETS, CompilerError, this_machine
from twintube.native.units import KEY, MARK, UNITS, LibraryError, library
from twintube.vehicle.cars import load_car
from twintube.vehicle.full.run import full_car

GUID = "{8c4e810f-3df3-4a00-8276-176fa3c9f9e0}"
DAMPER = UNITS["damper", 2]
PAGE = 1 << 14  # of macOS on ARM, and the alignment in a universal file
HERE = this_machine()
MACS = tuple(MACHINES)


@pytest.fixture(scope="session")
def starts() -> list[float]:
    return sources.starts(damper_model(load("SA8")))


@pytest.fixture(scope="session", params=MACS)
def mac(request: pytest.FixtureRequest) -> bytes:
    """A library for macOS as it is compiled, without values; made where it is missing."""
    try:
        return library(DAMPER, request.param)
    except LibraryError:
        return DAMPER.made(request.param).read_bytes()


def test_a_library_holds_the_guid_and_start_values_that_are_put_in(starts: list[float]) -> None:
    raw = library(DAMPER, HERE)
    data = filled(raw, GUID, starts)
    at = data.index(MARK) + len(MARK)
    assert data[at : at + KEY] == DAMPER.key().encode()
    guid, *values = struct.unpack_from(f"<64s{len(starts)}d", data, at + KEY)
    assert guid.rstrip(b"\0").decode() == GUID
    assert values == starts
    changed = [i for i, (a, b) in enumerate(zip(raw, data, strict=True)) if a != b]
    assert min(changed) >= at + KEY and max(changed) < at + KEY + 64 + 8 * len(starts)


@pytest.mark.parametrize("unit", UNITS.values(), ids=[unit.name for unit in UNITS.values()])
def test_the_values_of_every_model_fit_their_place(unit: units.Unit) -> None:
    """What lies behind them in the file is not theirs: all of it is 0 before."""
    damper = load("SA8")
    model = damper_model(damper) if unit.name.startswith("damper") else car_model(full_car(load_car(), [damper] * 4), 14.0)
    starts = sources.starts(model, STANDARDS[2 if unit.name.endswith("2") else 3])
    text = unit.texts()["variables.h"]
    rows = len(re.findall(r"offsetof", text)) - unit.name.endswith("2")  # the time is none of FMI 2.0
    assert len(starts) == rows
    data = library(unit, HERE)
    at = data.index(MARK) + len(MARK) + KEY
    assert data[at : at + 64 + 8 * rows] == bytes(64 + 8 * rows)


def test_two_dampers_of_one_library_do_not_mix(tmp_path: Path) -> None:
    """The values of one are not those of the other, and each instance wants the GUID of its own FMU."""
    loaded = {}
    for name in ("SA7", "SA8"):
        fmu = build_fmu(load(name), tmp_path / f"{name}.fmu", platforms=(fmpy.platform,))
        guid = fmpy.read_model_description(str(fmu)).guid
        (path,) = (Path(fmpy.extract(str(fmu))) / "binaries" / fmpy.platform).iterdir()
        loaded[name] = guid, path.read_bytes(), ctypes.CDLL(str(path))
    assert loaded["SA7"][0] != loaded["SA8"][0]
    for own, other in (("SA7", "SA8"), ("SA8", "SA7")):
        assert loaded[own][0].encode() in loaded[own][1]
        assert loaded[other][0].encode() not in loaded[own][1]


def test_the_signature_of_macos_is_reproduced(mac: bytes) -> None:
    """The compiler signs for ARM: the digests that it wrote are those that are computed here."""
    found = signature.directory(mac)
    if found is None:
        assert mac[4:8] == struct.pack("<I", 0x01000007)  # x86-64, which needs none
        return
    assert found.stored(mac) == found.computed(mac)
    assert found.count * found.page >= found.signed > (found.count - 1) * found.page
    assert signature.signed(mac) == mac


def test_after_values_are_put_in_every_page_has_its_digest_again(mac: bytes, starts: list[float]) -> None:
    changed = filled(mac, GUID, starts)
    found = signature.directory(changed)
    if found is None:
        return
    assert found.stored(changed) != found.computed(changed)
    whole = signature.signed(changed)
    assert found.stored(whole) == found.computed(whole)
    pages = {i // found.page for i, (a, b) in enumerate(zip(mac, changed, strict=True)) if a != b}
    assert {i for i, (a, b) in enumerate(zip(found.stored(mac), found.stored(whole), strict=True)) if a != b} == pages


def test_a_signature_that_cannot_be_written_anew_is_refused(mac: bytes) -> None:
    start = signature.signature_at(mac)
    if start is None:
        return
    at = mac.index(struct.pack(">I", signature.DIRECTORY), start)
    with pytest.raises(signature.SignatureError, match="digests of kind 1"):
        signature.signed(mac[: at + 37] + b"\1" + mac[at + 38 :])
    with pytest.raises(signature.SignatureError, match="no directory"):
        signature.signed(mac[:at] + bytes(4) + mac[at + 4 :])
    with pytest.raises(signature.SignatureError, match="no Mach-O"):
        signature.signed(bytes(64) + mac[64:])


def test_a_universal_library_holds_both_as_they_are(starts: list[float]) -> None:
    for name in MACS:
        if not DAMPER.path(name).is_file():
            DAMPER.made(name)
    parts = {name: binary(DAMPER, name, GUID, starts) for name in MACS}
    whole = universal(parts)
    magic, count = struct.unpack_from(">II", whole)
    assert (magic, count) == (0xCAFEBABE, 2)
    for i, (name, part) in enumerate(parts.items()):
        kind, subtype, at, size, align = struct.unpack_from(">IIIII", whole, 8 + 20 * i)
        assert (kind, subtype) == MACHINES[name]
        assert whole[at : at + size] == part
        assert at % PAGE == 0 and 1 << align == PAGE


def macos_facts(data: bytes) -> tuple[str, tuple[int, int]]:
    """Install name and lowest system version of a Mach-O library."""
    commands, at, name, lowest = struct.unpack_from("<I", data, 16)[0], 32, "", (0, 0)
    for _ in range(commands):
        kind, size = struct.unpack_from("<II", data, at)
        if kind == 0xD:  # LC_ID_DYLIB
            name = data[at + struct.unpack_from("<I", data, at + 8)[0] : at + size].rstrip(b"\0").decode()
        if kind == 0x32:  # LC_BUILD_VERSION
            version = struct.unpack_from("<I", data, at + 12)[0]
            lowest = (version >> 16, version >> 8 & 255)
        at += size
    return name, lowest


def test_macos_libraries_run_on_macos_11_and_name_no_path(mac: bytes) -> None:
    assert macos_facts(mac) == ("@rpath/damper_fmi2.dylib", (11, 0))


@pytest.mark.parametrize("change", ["cut", "another key", "twice"])
def test_a_library_that_does_not_belong_is_refused(change: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    data = library(DAMPER, HERE)
    at = data.index(MARK)
    changed = {
        "cut": data[:at],
        "another key": data[: at + len(MARK)] + b"0" * KEY + data[at + len(MARK) + KEY :],
        "twice": data + MARK,
    }
    monkeypatch.setattr(units, "LIBRARIES", tmp_path / "lib")
    DAMPER.path(HERE).parent.mkdir(parents=True)
    DAMPER.path(HERE).write_bytes(changed[change])
    command = f"`python -m twintube.native {HERE}` does it"
    with pytest.raises(
        BuildError, match=f"{DAMPER.path(HERE).name}: is not compiled from these equations .*{re.escape(command)}"
    ):
        build_fmu(load("SA8"), tmp_path / "a.fmu", platforms=(fmpy.platform,))
    assert not (tmp_path / "a.fmu").exists()


def test_a_platform_without_a_library_names_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(units, "LIBRARIES", tmp_path / "lib")
    with pytest.raises(BuildError, match=r"no library is there: `python -m twintube\.native` makes that of this machine"):
        build_fmu(load("SA8"), tmp_path / "a.fmu")
    DAMPER.path("x86_64-linux").parent.mkdir(parents=True)
    DAMPER.path("x86_64-linux").write_bytes(b"")
    assert complete(DAMPER, STANDARDS[2]) == ("linux64",)
    with pytest.raises(
        BuildError, match=r"no library for x86_64-windows: `python -m twintube\.native x86_64-windows` makes it"
    ):
        build_fmu(load("SA8"), tmp_path / "a.fmu", platforms=("win64",))
    assert not (tmp_path / "a.fmu").exists()


def test_the_command_says_which_platforms_have_no_library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if HERE not in ("x86_64-linux", "aarch64-linux", "x86_64-windows"):
        pytest.skip("a library for macOS holds two")
    monkeypatch.setattr(units, "LIBRARIES", tmp_path / "lib")
    path = DAMPER.path(HERE)
    path.parent.mkdir(parents=True)
    monkeypatch.undo()
    path.write_bytes(library(DAMPER, HERE))
    monkeypatch.setattr(units, "LIBRARIES", tmp_path / "lib")
    done = CliRunner().invoke(app, ["fmu", "SA8", "--output", str(tmp_path / "a.fmu")])
    assert done.exit_code == 0, done.output
    lacking = [name for name in STANDARDS[2].platforms if name not in {fmpy.platform, HERE}]
    assert (
        f"no library for {', '.join(lacking)}: `pip install ziglang`, then `python -m twintube.native --all`" in done.output
    )


def test_a_compiler_is_named_by_cc_for_this_machine_only(monkeypatch: pytest.MonkeyPatch) -> None:
    other = next(name for name in TARGETS if name != HERE)
    monkeypatch.setenv("CC", "gcc -m64")
    assert compiler.command(HERE) == ["gcc", "-m64"]
    assert "ziglang" in compiler.command(other)
    monkeypatch.delenv("CC")
    assert "ziglang" in compiler.command(HERE)
    monkeypatch.setattr(compiler, "find_spec", lambda _: None)
    with pytest.raises(CompilerError, match="no C compiler: pip install ziglang"):
        compiler.command(HERE)
    with pytest.raises(CompilerError, match="sparc-linux: set CC to a C compiler of this machine; known are x86_64-linux"):
        compiler.command("sparc-linux")


@pytest.mark.parametrize(
    ("arguments", "environment", "message"),
    [
        (["sparc-linux"], {}, "sparc-linux: set CC to a C compiler of this machine; known are x86_64-linux, aarch64-linux"),
        ([], {"CC": "no-such-compiler"}, "no-such-compiler: No such file or directory"),
    ],
)
def test_the_command_refuses_with_a_line(
    arguments: list[str], environment: dict[str, str], message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    done = subprocess.run([sys.executable, "-m", "twintube.native", *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert done.stderr.startswith(f"error: {message}") and done.stderr.count("\n") == 1


@pytest.mark.slow
@pytest.mark.parametrize("name", TARGETS)
def test_a_library_is_the_same_bytes_again(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    unit: Any = units.EXPLORER if name == units.MODULE else DAMPER
    made = []
    for folder in ("a", "b"):
        monkeypatch.setattr(units, "LIBRARIES", tmp_path / folder)
        monkeypatch.setenv("ZIG_GLOBAL_CACHE_DIR", str(tmp_path / folder / "zig"))
        made.append(unit.made(name).read_bytes())
    assert made[0] == made[1]
    assert str(tmp_path).encode() not in made[0] and b"/tmp" not in made[0]
