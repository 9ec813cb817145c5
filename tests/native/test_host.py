"""A host in plain C steps the native FMU's library: states, threads, memory, speed, and calls that must be refused."""

import platform
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from twintube.dampers import load
from twintube.fmu import build_fmu
from twintube.native.compiler import compiled
from twintube.native.units import HEADERS

pytestmark = pytest.mark.skipif(
    sys.platform != "linux" or platform.machine() != "x86_64", reason="the host is for linux on x86-64"
)

HERE = Path(__file__).parent


@pytest.fixture(scope="module")
def host(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """The command that a subcommand is added to."""
    folder = tmp_path_factory.mktemp("host")
    fmu = build_fmu(load("SA8"), folder, platforms=("linux64",))
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(folder)
    flags = ("-std=gnu99", "-O2", f"-I{folder / 'sources'}", f"-I{HEADERS}", "-pthread", "-ldl")
    compiled([HERE / "host.c"], "x86_64-linux", folder / "host", flags)
    (library,) = (folder / "binaries" / "linux64").iterdir()
    return [str(folder / "host"), str(library)]


def run(host: list[str], *command: str) -> subprocess.CompletedProcess[str]:
    done = subprocess.run([*host, *command], capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    return done


def test_a_million_steps_take_no_memory(host: list[str]) -> None:
    done = run(host, "speed", "1000000")
    assert float(done.stdout) > 0.0
    assert int(done.stderr) < 512  # kB; one byte per step would be 1000, reading it makes some


@pytest.mark.parametrize("command", ["state 1", "state 2", "threads 6", "abuse", "forged", "leak"])
def test_host(host: list[str], command: str) -> None:
    """Restored, serialised and parallel instances agree to the bit; refused calls change nothing; nothing leaks."""
    run(host, *command.split())


def test_the_host_tells_what_is_wrong(host: list[str]) -> None:
    done = subprocess.run([*host, "nothing"], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "no command nothing" in done.stderr
