"""The sources of the native FMU under AddressSanitizer and UndefinedBehaviorSanitizer: misuse, states, random calls."""

import os
import platform
import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import pytest

from twintube.dampers import load
from twintube.fmu.sources import sources
from twintube.fmu.standards import STANDARDS, Standard
from twintube.native.units import HEADERS

pytestmark = pytest.mark.skipif(
    sys.platform != "linux" or platform.machine() != "x86_64", reason="the host is for linux on x86-64"
)

HERE = Path(__file__).parent
FLAGS = ("-std=gnu99", "-O1", "-g", "-fsanitize=address,undefined,float-cast-overflow", "-fno-sanitize-recover=all")
ROUNDS = 20_000  # of random calls, for each parameter set


def works(compiler: str, folder: Path) -> bool:
    """Whether it has the sanitizers, and what it makes with them runs here."""
    (folder / "empty.c").write_text("int main(void) { return 0; }\n", encoding="utf-8")
    command = [compiler, *FLAGS, "empty.c", "-o", "empty"]
    return (
        shutil.which(compiler) is not None
        and subprocess.run(command, cwd=folder, capture_output=True, check=False).returncode == 0
        and subprocess.run([folder / "empty"], capture_output=True, check=False).returncode == 0
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sources of a damper."""
    made = tmp_path_factory.mktemp("sanitized")
    for name, text in sources(load("SA8"), "{guid}").items():
        (made / name).write_text(text, encoding="utf-8")
    return made


@pytest.fixture(scope="module")
def folder3(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sources of a damper for FMI 3.0."""
    made = tmp_path_factory.mktemp("sanitized3")
    for name, text in sources(load("SA8"), "{guid}", STANDARDS[3]).items():
        (made / name).write_text(text, encoding="utf-8")
    return made


@pytest.fixture(scope="module")
def compiler(folder: Path) -> str:
    for name in ("gcc", "clang", "cc"):
        if works(name, folder):
            return name
    pytest.skip("no C compiler with AddressSanitizer and UndefinedBehaviorSanitizer")


def program(compiler: str, folder: Path, name: str, standard: Standard = STANDARDS[2]) -> Path:
    """A program of this folder, with the sources instead of the library."""
    command = [compiler, *FLAGS, "-DSTATIC", "-DFMI3_OVERRIDE_FUNCTION_PREFIX", "-pthread", f"-I{folder}", f"-I{HEADERS}"]
    files = [str(HERE / f"{name}.c"), str(folder / standard.compiled)]
    done = subprocess.run([*command, *files, "-o", str(folder / name), "-lm"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return folder / name


def run(command: Sequence[str | Path]) -> str:
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, f"{command}: {done.stderr}"
    return done.stdout


@pytest.fixture(scope="module")
def host(compiler: str, folder: Path) -> Path:
    return program(compiler, folder, "host")


@pytest.fixture(scope="module")
def fuzz(compiler: str, folder: Path) -> Path:
    return program(compiler, folder, "fuzz")


@pytest.fixture(scope="module")
def fuzz3(compiler: str, folder3: Path) -> Path:
    return program(compiler, folder3, "fuzz3", STANDARDS[3])


@pytest.mark.parametrize("command", ["abuse", "forged", "state 3", "threads 4", "leak"])
def test_host(host: Path, command: str) -> None:
    run([host, "sources", *command.split()])


@pytest.mark.parametrize("parameters", ["plain", "extended"])
def test_random_calls(fuzz: Path, parameters: str) -> None:
    seed = 1 if os.environ.get("CI") else int(time.time())
    counted = run([fuzz, str(ROUNDS), str(seed), parameters])
    calls, steps = (int(part.split()[0]) for part in counted.split(",")[:2])
    assert calls > steps > 1000


@pytest.mark.parametrize("parameters", ["plain", "extended"])
def test_random_calls_of_fmi_3(fuzz3: Path, parameters: str) -> None:
    seed = 1 if os.environ.get("CI") else int(time.time())
    counted = run([fuzz3, str(ROUNDS), str(seed), parameters])
    calls, steps = (int(part.split()[0]) for part in counted.split(",")[:2])
    assert calls > steps > 1000
