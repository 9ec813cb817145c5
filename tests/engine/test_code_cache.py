"""Compiled code on disk: damaged files are compiled anew, foreign folders are not used."""

import os
import stat
import sys
from pathlib import Path
from types import ModuleType

import pytest

from twintube.common import caches
from twintube.engine.code_cache import VOUCHED, CodeCache, vouched

TEXT = """
import numba

@numba.njit(cache=True)
def run_twice(x):
    return 2.0 * x
"""


def loaded(text: str = TEXT) -> tuple[ModuleType, CodeCache]:
    """The module as `compiled.module` loads it."""
    cache = CodeCache.open("generated", text)
    module = ModuleType("generated")
    module.__file__ = str(cache.path)
    sys.modules["generated"] = module
    exec(compile(text, cache.path, "exec"), vars(module))
    cache.seal_after_compiling(module)
    return module, cache


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(caches.platformdirs, "user_cache_dir", lambda name: str(tmp_path / "cache"))
    return tmp_path / "cache" / "kernel"


def test_compiled_files_are_vouched_for_and_used_again(folder: Path) -> None:
    module, cache = loaded()
    assert module.run_twice(1.5) == 3.0
    assert cache.compiled()
    assert all(vouched(file) for file in cache.compiled())
    before = {file: file.stat().st_mtime_ns for file in cache.compiled()}
    again, cache = loaded()
    assert again.run_twice(1.5) == 3.0
    assert {file: file.stat().st_mtime_ns for file in cache.compiled()} == before


@pytest.mark.parametrize("ending", ["nbc", "nbi"])
@pytest.mark.parametrize("damage", ["cut", "empty", "changed"])
def test_a_damaged_file_is_compiled_anew(folder: Path, ending: str, damage: str) -> None:
    module, cache = loaded()
    module.run_twice(1.0)
    victim = next(file for file in cache.compiled() if file.suffix == f".{ending}")
    data = bytearray(victim.read_bytes())
    if damage == "cut":
        del data[len(data) // 2 :]
    elif damage == "empty":
        data.clear()
    else:
        data[len(data) // 2] ^= 0xFF
    victim.write_bytes(data)
    module, cache = loaded()
    assert victim not in cache.compiled()
    assert module.run_twice(1.0) == 2.0
    assert all(vouched(file) for file in cache.compiled())


def test_a_changed_source_is_written_again(folder: Path) -> None:
    _, cache = loaded()
    cache.path.write_text(TEXT.replace("2.0", "3.0"))
    _, cache = loaded()
    assert cache.path.read_text() == TEXT


def test_machine_code_without_a_digest_is_not_run(folder: Path) -> None:
    module, cache = loaded()
    module.run_twice(1.0)
    for file in cache.compiled():
        file.with_name(file.name + VOUCHED).unlink()
    assert not CodeCache.open("generated", TEXT).compiled()


@pytest.mark.skipif(os.name != "posix", reason="owners and modes of POSIX")
def test_the_folder_belongs_to_the_user_alone(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    loaded()
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700
    folder.chmod(0o777)
    loaded()
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700
    monkeypatch.setattr(caches.os, "getuid", lambda: folder.stat().st_uid + 1)
    assert not caches.private(folder)


def test_a_cache_that_cannot_be_written_is_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setattr(caches.platformdirs, "user_cache_dir", lambda name: str(tmp_path / "file" / "cache"))
    module, cache = loaded()
    assert module.run_twice(2.0) == 4.0
    assert tmp_path not in cache.path.parents
