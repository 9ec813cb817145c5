"""Libraries of other platforms in a small program of their platform: Windows by wine, Linux on ARM by qemu."""

import math
import os
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Iterator, Mapping
from pathlib import Path

import fmpy
import pytest

from tests.conftest import ensure_made
from twintube.dampers import load
from twintube.demo.damper_fmu import DamperFmu
from twintube.fmu import build_fmu
from twintube.fmu.platforms import PLATFORMS, Fmi
from twintube.native.compiler import compiled
from twintube.native.units import HEADERS

WORN = {"oil_level": 0.56, "gas_preload": 0}
STEPS = 3000
WINE = shutil.which("wine64") or shutil.which("wine")
QEMU = shutil.which("qemu-aarch64")
ARM_SYSTEM = Path("/usr/aarch64-linux-gnu")  # where Debian puts a C library of ARM
HOST = Path(__file__).parent / "foreign_host.c"


def motion(i: int) -> tuple[float, float]:
    return 0.04 * math.sin(0.03 * i), 1.2 * math.cos(0.03 * i)


def compiled_host(platform: str, folder: Path, *flags: str) -> Path:
    """The program for a platform."""
    program = folder / "host.exe"
    compiled([HOST], PLATFORMS[platform][1][0], program, ("-O1", f"-I{HEADERS}", *flags))
    return program


def forces(
    platform: str, start: list[str], host: Path, folder: Path, *, environment: Mapping[str, str] | None = None, fmi: Fmi = 2
) -> list[float]:
    """Forces of the library in a program that `start` runs."""
    for target in PLATFORMS[platform][1]:
        ensure_made(target)
    fmu = build_fmu(load("SA8"), folder / "unit", platforms=(platform,), fmi=fmi)
    with zipfile.ZipFile(fmu) as archive:
        library = archive.extract(f"binaries/{platform}/twintube_SA8.{PLATFORMS[platform][0]}", folder)
    description = fmpy.read_model_description(str(fmu))
    references = {v.name: v.valueReference for v in description.modelVariables}
    values = [str(x) for name, value in WORN.items() for x in (references[name], value)]
    run = subprocess.run(
        [*start, str(host), library, description.guid, str(fmi), *values],
        input="".join(f"{z!r} {v!r} 1e-3\n" for z, v in map(motion, range(STEPS))),
        capture_output=True, text=True, env=environment, check=False, timeout=180,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    return [float(line) for line in run.stdout.split()]


@pytest.fixture
def expected(sa8_native: Path) -> list[float]:
    """Forces of the library of this platform."""
    with DamperFmu(sa8_native, **WORN) as damper:
        return [damper.step(*motion(i), 1e-3) for i in range(STEPS)]


@pytest.fixture
def wine_prefix(tmp_path: Path) -> Iterator[Path]:
    """A new prefix; it is large and does not stay."""
    prefix = tmp_path / "wine"
    yield prefix
    server = shutil.which("wineserver")
    if server is not None:
        subprocess.run([server, "-w"], env={**os.environ, "WINEPREFIX": str(prefix)}, check=False, timeout=60)
    shutil.rmtree(prefix, ignore_errors=True)


@pytest.mark.slow
@pytest.mark.skipif(WINE is None, reason="wine is absent: neither wine64 nor wine is on the path")
def test_the_dll_computes_what_the_linux_library_does(expected: list[float], wine_prefix: Path, tmp_path: Path) -> None:
    environment = {
        **os.environ,
        "WINEPREFIX": str(wine_prefix),
        "WINEDEBUG": "-all",
        "WINEDLLOVERRIDES": "mscoree=;mshtml=",  # no questions about what the new prefix lacks
    }
    computed = forces("win64", [str(WINE)], compiled_host("win64", tmp_path), tmp_path, environment=environment)
    # The same operations in the same order, but another library's exp and pow.
    assert computed == pytest.approx(expected, rel=1e-9)


@pytest.mark.skipif(sys.platform != "linux" or QEMU is None, reason="qemu-aarch64 is absent (Debian: qemu-user)")
@pytest.mark.skipif(not ARM_SYSTEM.is_dir(), reason="a C library of ARM is absent (Debian: libc6-arm64-cross)")
@pytest.mark.parametrize("fmi", [2, 3])
def test_the_arm_library_computes_what_that_of_x86_does(expected: list[float], fmi: Fmi, tmp_path: Path) -> None:
    host = compiled_host("aarch64-linux", tmp_path, "-ldl")
    computed = forces("aarch64-linux", [str(QEMU), "-L", str(ARM_SYSTEM)], host, tmp_path, fmi=fmi)
    assert computed == pytest.approx(expected, rel=1e-9)
