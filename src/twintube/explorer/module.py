"""The WebAssembly module: the C sources of the native FMU, the loops of `explorer.c` and the translated quarter car."""

from collections.abc import Callable

from twintube.dampers import load
from twintube.fmu import binaries, sources
from twintube.fmu.assemble import BuildError
from twintube.native.headers import header

TARGET = "wasm32-wasi"
FILE = "explorer.wasm"
COMPILED = "explorer.c"
FOLDER = sources.FOLDER / "explorer"
# As the libraries of the FMU; a module without a main function in place of a shared library.
FLAGS = (*(flag for flag in binaries.FLAGS if flag != "-shared"), "-mexec-model=reactor", "-Wl,--export-dynamic")
# Any damper would do: a page sets all parameters before it starts a unit.
DAMPER = "SA8"


def texts() -> dict[str, str]:
    """All sources by name."""
    own = {COMPILED: (FOLDER / COMPILED).read_text(encoding="utf-8"), "quarter_car.h": header("quarter_car.h")}
    return sources.sources(load(DAMPER), "explorer") | own


def module(progress: Callable[[str], None] = lambda text: None) -> bytes:
    """The module, compiled by ziglang or from the cache of libraries; raises BuildError."""
    try:
        binaries.require_compiler()
        progress("the module; compiled once, which takes minutes")
        return binaries.library(texts(), TARGET, FILE, COMPILED, FLAGS)
    except binaries.CompilerError as error:
        raise BuildError(str(error)) from error
