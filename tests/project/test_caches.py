"""Caches of a user without a home, with one that cannot be written, and with a number but no name."""

import os
import pwd
import stat
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from twintube import load, simulate
from twintube.cli import app
from twintube.common import caches
from twintube.errors import UserError
from twintube.native import compiler

HOMES = {
    "root of the file system": "/proc",
    "none": None,
    "missing": "/proc/x",
    "relative": "some/where",
    "a file": __file__,
}
pytestmark = pytest.mark.skipif(os.name != "posix", reason="homes, owners and modes of POSIX")


@pytest.fixture
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An own folder for temporary files, the user without a name and without other caches."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(caches.tempfile, "tempdir", str(folder))
    for name in ("XDG_CACHE_HOME", "MPLCONFIGDIR", *compiler.CACHES):
        monkeypatch.setenv(name, "")  # so that it is put back
        monkeypatch.delenv(name)

    def nobody(number: int) -> None:
        raise KeyError(number)

    monkeypatch.setattr(pwd, "getpwuid", nobody)
    monkeypatch.chdir(tmp_path)
    return folder


@pytest.fixture(params=HOMES.values(), ids=HOMES)
def no_home(request: pytest.FixtureRequest, temporary: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A home where nothing can be written, also not by root; the folder for temporary files."""
    if request.param is None:
        monkeypatch.delenv("HOME", raising=False)
    else:
        monkeypatch.setenv("HOME", request.param)
    return temporary


def mode(folder: Path) -> int:
    return stat.S_IMODE(folder.stat().st_mode)


def test_a_temporary_folder_of_this_user_alone_stands_in(no_home: Path, tmp_path: Path) -> None:
    folder = caches.cache_folder("kernel")
    assert no_home in folder.parents
    assert mode(folder) == mode(no_home / f"twintube-{os.getuid()}") == 0o700
    assert caches.cache_folder("kernel") == folder  # found again
    assert os.listdir(tmp_path) == ["temporary"]  # no "~", no home in the current folder


@pytest.mark.parametrize("foreign", ["owner", "link", "file"])
def test_a_folder_of_somebody_else_is_not_used(temporary: Path, monkeypatch: pytest.MonkeyPatch, foreign: str) -> None:
    monkeypatch.setenv("HOME", "/proc/x")
    caches.of_this_process.cache_clear()
    taken = temporary / f"twintube-{os.getuid()}"
    if foreign == "owner":
        taken.mkdir(mode=0o777)
        number = os.getuid()
        monkeypatch.setattr(caches.os, "getuid", lambda: number + 1 if taken.name.endswith(str(number)) else number)
        taken.rename(temporary / f"twintube-{number + 1}")
    elif foreign == "link":
        taken.symlink_to("/proc")
    else:
        taken.write_text("")
    root = caches.temporary()
    assert root.parent == temporary
    assert root.name.startswith("twintube_")
    assert mode(root) == 0o700


def test_the_users_cache_is_used_where_there_is_one(
    temporary: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "mine"))
    assert caches.cache_folder("zig") == tmp_path / "mine" / "twintube" / "zig"
    caches.lend()
    assert os.environ["XDG_CACHE_HOME"] == str(tmp_path / "mine")
    assert "MPLCONFIGDIR" not in os.environ
    assert list(temporary.iterdir()) == []


def test_without_any_folder_one_line_says_what_to_set(temporary: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def nowhere() -> str:
        raise FileNotFoundError(2, "No usable temporary directory found in ['/tmp']")

    monkeypatch.setenv("HOME", "/proc/x")
    monkeypatch.setattr(caches.tempfile, "gettempdir", nowhere)
    with pytest.raises(UserError, match="set TMPDIR"):
        caches.cache_folder("kernel")
    done = CliRunner().invoke(app, ["dampers", "SA8"])
    assert (done.exit_code, done.stderr) == (
        2,
        "error: no folder for temporary files: set TMPDIR to one that you can write\n",
    )


def test_the_compiler_keeps_its_files_in_our_folder(no_home: Path) -> None:
    environment = compiler.compiler_environment()
    assert {environment[name] for name in compiler.CACHES} == {str(caches.cache_folder("zig"))}


def test_the_compiler_keeps_its_files_where_the_user_says(
    temporary: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.setenv("ZIG_GLOBAL_CACHE_DIR", "own/global")
    monkeypatch.setenv("ZIG_LOCAL_CACHE_DIR", "/proc/zig")
    environment = compiler.compiler_environment()
    assert environment["ZIG_GLOBAL_CACHE_DIR"] == str(tmp_path / "own" / "global")
    assert environment["ZIG_LOCAL_CACHE_DIR"] == str(tmp_path / "home" / ".cache" / "twintube" / "zig")


def test_a_compiler_that_does_not_end_is_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "ziglang.py").write_text("import time\ntime.sleep(60)\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    monkeypatch.setattr(compiler, "LONGEST", 0.5)
    with pytest.raises(compiler.CompilerError, match=r"aarch64-linux: the compiler did not end within 0\.5 s; .*ZIG_GLOBAL"):
        compiler.compiled([tmp_path / "a.c"], "aarch64-linux", tmp_path / "a.so")


@pytest.fixture
def compiled_kernel() -> None:
    """The kernel, before the home goes: compiling it again takes long."""
    simulate(load("SA8", as_published=True), [0.0, 0.0], [0.0, 0.0])


@pytest.mark.parametrize("arguments", [["dampers", "SA8"], ["simulate", "SA8", "--velocity", "1.5", "--amplitude-mm", "5"]])
def test_commands_do_without_a_home(compiled_kernel: None, no_home: Path, arguments: list[str]) -> None:
    done = CliRunner().invoke(app, arguments)
    assert (done.exit_code, done.stderr) == (0, "")


def test_pictures_need_no_home_and_say_nothing(temporary: Path) -> None:
    script = "from twintube.common import caches; caches.lend(); import matplotlib.pyplot as p; p.figure().savefig('a.png')"
    environment = {**os.environ, "HOME": "/proc/x", "TMPDIR": str(temporary)}
    done = subprocess.run([sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
