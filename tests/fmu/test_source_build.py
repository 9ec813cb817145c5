"""The C sources inside the FMU are complete: others compile them, and get the same bits."""

import ctypes
import math
import shutil
import sys
import zipfile
from pathlib import Path

import pytest
from fmpy.build import build_platform_binary
from fmpy.util import create_zip_archive

from twintube.dampers import load
from twintube.demo.damper_fmu import DamperFmu
from twintube.fmu import sources
from twintube.fmu.standards import STANDARDS
from twintube.native.compiler import FLAGS, compiled
from twintube.native.units import HEADERS

# fmpy's copy of the header leaves out the prefix, which is for static linking.
NO_PREFIX = "#define fmi2FullName(name) name"
PREFIX = """
#ifdef FMI2_FUNCTION_PREFIX
#define fmi2Paste(a, b) a##b
#define fmi2PasteB(a, b) fmi2Paste(a, b)
#define fmi2FullName(name) fmi2PasteB(FMI2_FUNCTION_PREFIX, name)
#else
#define fmi2FullName(name) name
#endif
"""
WORN = {"oil_level": 0.56, "gas_preload": 0}


def forces(fmu: Path) -> list[float]:
    with DamperFmu(fmu, **WORN) as damper:
        return [damper.step(0.04 * math.sin(0.03 * i), 1.2 * math.cos(0.03 * i), 1e-3) for i in range(2000)]


@pytest.mark.skipif(shutil.which("cmake") is None, reason="cmake is absent: fmpy compiles with it")
@pytest.mark.skipif(sys.platform != "win32" and shutil.which("cc") is None, reason="a C compiler is absent: no cc")
def test_fmpy_compiles_the_sources(sa8_native: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "fmu"
    with zipfile.ZipFile(sa8_native) as archive:
        archive.extractall(folder)
    shutil.rmtree(folder / "binaries")
    # Some compilers fuse multiplication and addition where the processor can.
    monkeypatch.setenv("CFLAGS", "-ffp-contract=off")
    build_platform_binary(folder)
    create_zip_archive(tmp_path / "compiled.fmu", folder)
    assert forces(tmp_path / "compiled.fmu") == forces(sa8_native)


@pytest.mark.skipif(sys.platform != "linux", reason="objects are linked as on Linux")
def test_two_dampers_are_linked_into_one_library(tmp_path: Path) -> None:
    """As a HiL target does it, with the standard's header: every function has the model identifier as prefix."""
    target, objects = "x86_64-linux", []
    for header in ("fmi2Functions.h", "fmi2FunctionTypes.h", "fmi2TypesPlatform.h"):
        text = (HEADERS / header).read_text()
        assert header != "fmi2Functions.h" or NO_PREFIX in text
        (tmp_path / header).write_text(text.replace(NO_PREFIX, PREFIX))
    for name in ("SA7", "SA8"):
        folder = tmp_path / name
        folder.mkdir()
        for file, text in sources.sources(load(name), "{}").items():
            (folder / file).write_text(text)
        objects.append(tmp_path / f"{name}.o")
        flags = ("-std=c99", "-O2", "-c", f"-I{tmp_path}")
        compiled([folder / STANDARDS[2].compiled], target, objects[-1], flags)
    compiled(objects, target, tmp_path / "both.so", FLAGS)
    linked = ctypes.CDLL(str(tmp_path / "both.so"))
    for name in ("SA7", "SA8"):
        version = linked[f"twintube_{name}_fmi2GetVersion"]
        version.restype = ctypes.c_char_p
        assert version() == b"2.0"
        assert hasattr(linked, f"twintube_{name}_fmi2DoStep")
    assert not hasattr(linked, "fmi2GetVersion")
