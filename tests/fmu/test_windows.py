"""The Windows library in a Windows program, run by wine."""

import math
import os
import shutil
import subprocess
import zipfile
from collections.abc import Iterator
from pathlib import Path

import fmpy
import pytest

from twintube.dampers import load
from twintube.demo.damper_fmu import DamperFmu
from twintube.fmu import binaries, build_fmu

WORN = {"oil_level": 0.56, "gas_preload": 0}
WINE = shutil.which("wine64") or shutil.which("wine")
HOST = Path(__file__).parent / "windows_host.c"


@pytest.fixture
def wine_prefix(tmp_path: Path) -> Iterator[Path]:
    """A new one; it is large and does not stay."""
    prefix = tmp_path / "wine"
    yield prefix
    server = shutil.which("wineserver")
    if server is not None:
        subprocess.run([server, "-w"], env={**os.environ, "WINEPREFIX": str(prefix)}, check=False, timeout=60)
    shutil.rmtree(prefix, ignore_errors=True)


def motion(i: int) -> tuple[float, float]:
    return 0.04 * math.sin(0.03 * i), 1.2 * math.cos(0.03 * i)


@pytest.mark.slow
@pytest.mark.skipif(WINE is None, reason="wine is absent: neither wine64 nor wine is found")
def test_the_dll_computes_what_the_linux_library_does(sa8_native: Path, wine_prefix: Path, tmp_path: Path) -> None:
    fmu = build_fmu(load("SA8"), tmp_path, platforms=("win64",))
    with zipfile.ZipFile(fmu) as archive:
        dll = archive.extract("binaries/win64/twintube_SA8.dll", tmp_path)
    binaries.compiled(HOST, "x86_64-windows-gnu", tmp_path / "host.exe", ("-O1",))
    description = fmpy.read_model_description(str(fmu))
    references = {v.name: v.valueReference for v in description.modelVariables}
    start = [str(x) for name, value in WORN.items() for x in (references[name], value)]
    environment = {
        **os.environ,
        "WINEPREFIX": str(wine_prefix),
        "WINEDEBUG": "-all",
        "WINEDLLOVERRIDES": "mscoree=;mshtml=",  # no questions about what the new prefix lacks
    }
    steps = "".join(f"{z!r} {v!r} 1e-3\n" for z, v in map(motion, range(3000)))
    assert WINE is not None
    run = subprocess.run(
        [WINE, str(tmp_path / "host.exe"), dll, description.guid, *start],
        input=steps, capture_output=True, text=True, env=environment, check=False, timeout=180,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    found = [float(line) for line in run.stdout.split()]
    with DamperFmu(sa8_native, **WORN) as damper:
        expected = [damper.step(*motion(i), 1e-3) for i in range(3000)]
    # The same operations in the same order, but another library's exp and pow.
    assert found == pytest.approx(expected, rel=1e-9)
