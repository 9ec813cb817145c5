"""Hostile inputs: a clear answer with status 2, soon and in bounded memory; no traceback, no signal, nothing written."""

import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from tests.hardening.cases import KINDS
from tests.hardening.hostile import Hostile
from twintube.cli import app
from twintube.common.words import CONTROL

resource = pytest.importorskip("resource", reason="timers, pipes and limits of POSIX")

SECONDS = 5.0  # of this process's own time; other work on the machine does not count
HANGING = 60.0  # on the clock
MEMORY = 400_000  # [kB] that one input may add
RUNNER = CliRunner()
CASES = {f"{kind}: {name}": case for kind, table in KINDS.items() for name, case in table.items()}
# Those that ended or stopped the process, once more in a process of their own, with limited memory.
ALONE = (
    "MATLAB: array class 5",
    "HDF5: declared 8 TB",
    "units: power tower",
    "pipes and folders: record",
    "CSV: 200,000 columns",
    "dataset.toml: a key of 100,000 parts",
)


@contextmanager
def clock() -> Iterator[None]:
    """Raise TimeoutError where it takes longer than HANGING."""

    def late(*_: Any) -> None:
        raise TimeoutError(f"more than {HANGING} s")

    before = signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, HANGING)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def assert_answers(case: Hostile, folder: Path, status: int, stderr: str, stdout: str) -> None:
    """Check what a command said, and that nothing but the input is there."""
    assert status == 2, (status, stderr[-2000:], stdout[-2000:])
    assert "Traceback" not in stderr + stdout
    lines = stderr.rstrip("\n").splitlines()
    assert lines[-1].lower().startswith("error: "), stderr[-2000:]
    assert len(lines) == 1 or lines[1].startswith("error: "), stderr[:2000]
    assert case.message in stderr + stdout, (stderr[-2000:], stdout[-2000:])
    assert not CONTROL.search(stderr + stdout)
    assert sorted(path.name for path in folder.iterdir()) == sorted(case.files)


def test_there_are_enough() -> None:
    assert len(CASES) >= 200
    assert len(KINDS) >= 10


@pytest.fixture(scope="module", autouse=True)
def warm() -> None:
    """Import what the commands import, so that it does not count."""
    from scipy.io import savemat  # noqa: F401

    RUNNER.invoke(app, ["simulate", "SA8", "--velocity", "nan"])
    RUNNER.invoke(app, ["ride", "SA8", "--car", "x"])
    RUNNER.invoke(app, ["study", "x"])


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_hostile_input(case: Hostile, tmp_path: Path) -> None:
    folder = tmp_path / "input"
    folder.mkdir()
    arguments = case.write(folder)
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    before = time.process_time()
    with clock():
        run = RUNNER.invoke(app, arguments)
    took = time.process_time() - before
    if run.exception is not None and not isinstance(run.exception, SystemExit):
        raise run.exception
    assert took < SECONDS
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - memory < MEMORY
    assert_answers(case, folder, run.exit_code, run.stderr, run.stdout)


@pytest.mark.parametrize("name", ALONE)
def test_in_a_process_of_its_own(name: str, tmp_path: Path) -> None:
    folder = tmp_path / "input"
    folder.mkdir()
    arguments = CASES[name].write(folder)

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))

    command = [sys.executable, "-m", "twintube", *arguments]
    run = subprocess.run(
        command, capture_output=True, text=True, timeout=HANGING, check=False, cwd=tmp_path, preexec_fn=limit
    )
    assert_answers(CASES[name], folder, run.returncode, run.stderr, run.stdout)
