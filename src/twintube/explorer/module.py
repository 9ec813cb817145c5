"""The WebAssembly module: the C sources of the native FMU, the loops of `explorer.c` and the translated quarter car."""

from collections.abc import Callable

from twintube.dampers import load
from twintube.explorer.translate import QUARTER_CAR
from twintube.fmu import binaries, sources
from twintube.fmu.assemble import BuildError
from twintube.fmu.equations import StaleTranslationError, checked

TARGET = "wasm32-wasi"
FILE = "explorer.wasm"
COMPILED = "explorer.c"
FOLDER = sources.FOLDER / "explorer"
# As the libraries of the FMU; a module without a main function in place of a shared library.
FLAGS = (*(flag for flag in binaries.FLAGS if flag != "-shared"), "-mexec-model=reactor", "-Wl,--export-dynamic")
# Any damper would do: a page sets all parameters before it starts a unit.
DAMPER = "SA8"


def texts() -> dict[str, str]:
    """All sources by name; raises StaleTranslationError where C is not the translation of the present equations."""
    own = {name: (FOLDER / name).read_text(encoding="utf-8") for name in (COMPILED, "quarter_car.h")}
    checked(own["quarter_car.h"], QUARTER_CAR)
    return sources.sources(load(DAMPER), "explorer") | own


def module(progress: Callable[[str], None] = lambda text: None) -> bytes:
    """The module, compiled by ziglang or from the cache of libraries; raises BuildError."""
    try:
        binaries.require_compiler()
        progress("the module; compiled once, which takes minutes")
        return binaries.library(texts(), TARGET, FILE, COMPILED, FLAGS)
    except (binaries.CompilerError, StaleTranslationError) as error:
        raise BuildError(str(error)) from error
