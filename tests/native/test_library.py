"""The library: calls without a copy, refusals by name, and none that is not of the present equations."""

import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Event

import numpy as np
import pytest

from twintube.core.publishing import NAMES
from twintube.dampers import load
from twintube.engine import compiled
from twintube.engine.simulate import rows, started
from twintube.native import build, compiler, library
from twintube.rig.signals import harmonic_block


def test_arrays_are_refused_by_the_name_of_the_argument() -> None:
    call, n = compiled.module().lag, np.zeros(4)
    for wrong, message in [
        (np.zeros(4, np.float32), r"array \(4,\) of float32, must be of float64, 1-dimensional and C-contiguous"),
        (np.zeros((4, 2)), r"array \(4, 2\) of float64, must be of float64, 1-dimensional"),
        (np.zeros(8)[::2], r"C-contiguous"),
    ]:
        with pytest.raises(TypeError, match=f"kernel_lag: values: .*{message}"):
            call(wrong, n, n)
    fixed = np.zeros(4)
    fixed.flags.writeable = False
    call(fixed, fixed, n)  # what is only read may be read-only
    with pytest.raises(TypeError, match="kernel_lag: out: array is read-only"):
        call(n, n, fixed)
    with pytest.raises(ValueError, match="argument"):
        call(n, n)


def test_a_record_of_another_size_is_refused() -> None:
    records, t, z, v = started(load("SA8"), [0.0, 0.01], [0.1, 0.1], [0.0, 0.1])
    p, d, s, f = rows(records)
    out = np.zeros((2, len(NAMES)))
    with pytest.raises(TypeError, match=rf"kernel_run_record: d: record of {s.nbytes} bytes, must have {d.nbytes}"):
        compiled.module().run_record(p, s, d, f, t, z, v, np.full(len(z), 296.15), out)


def test_records_and_arrays_are_changed_in_place() -> None:
    records, t, z, v = started(load("SA8"), [0.0, 0.01], [0.1, 0.1], [0.0, 0.1])
    p, d, s, f = rows(records)
    out = np.zeros((2, len(NAMES)))
    assert compiled.module().run_record(p, d, s, f, t, z, v, np.full(len(z), 296.15), out) == 2
    assert s["z"] == 0.01 and out[1, 0] != 0.0


def test_other_threads_run_during_a_call() -> None:
    block = harmonic_block(0.262, dt=1e-4)
    records, t, z, v = started(load("SA8"), block.stroke, block.velocity, block.time)
    out, begun, done = np.empty((len(z), len(NAMES))), Event(), Event()

    def long_call() -> int:
        given = rows(records)
        begun.set()
        steps: int = compiled.module().run_record(*given, t, z, v, np.full(len(z), 296.15), out)
        done.set()
        return steps

    with ThreadPoolExecutor(1) as threads:
        running = threads.submit(long_call)
        begun.wait()
        turns = 0
        while not done.is_set():
            turns += 1
        assert running.result() == len(z)
    assert turns > 100  # with the lock held it would be a turn or two


def test_a_stale_or_missing_library_names_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(build, "LIBRARIES", tmp_path)
    monkeypatch.setattr(library, "PACKAGE", tmp_path / "site-packages" / "twintube")  # not a checkout
    path = build.library_path(compiler.this_machine())
    with pytest.raises(
        library.LibraryError, match=r"the compiled library is missing: run `python -m twintube\.native`"
    ) as error:
        library.present()
    assert str(error.value).startswith(str(path)) and "\n" not in str(error.value)
    path.parent.mkdir()
    path.write_bytes(b"twintube equations " + 64 * b"0")
    with pytest.raises(library.LibraryError, match="the compiled library is of other equations: run"):
        library.present()


def test_a_checkout_makes_a_stale_library_anew_or_says_that_there_is_no_compiler(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(build, "LIBRARIES", tmp_path)
    monkeypatch.setenv("CC", str(tmp_path / "no-compiler"))
    with pytest.raises(library.LibraryError, match=re.escape(f"({tmp_path / 'no-compiler'}: No such file or directory)")):
        library.present()
    monkeypatch.delenv("CC")
    assert build.current(library.present())


def test_the_digest_is_of_equations_translator_and_flags(monkeypatch: pytest.MonkeyPatch) -> None:
    names = {path.name for path in library.build.sources.paths(("engine/loops.py",))}
    assert {"variables.py", "forces.py", "oil_temperature.py", "hooks.py", "loops.py", "translate.py"} <= names
    before = build.key()
    build.key.cache_clear()
    monkeypatch.setattr(build, "FLAGS", (*build.FLAGS, "-O1"))
    assert build.key() != before
    build.key.cache_clear()
