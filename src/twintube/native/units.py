"""Libraries of FMUs, one of each model and version of FMI for each platform, and the module of the explorer.

All are compiled once, when the package is built. A library holds no damper: GUID and start values stand behind MARK, and are
put in when an FMU is built. The key beside them is that of the sources, so that a library of others is refused.
"""

import hashlib
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from twintube.common.files import write_bytes
from twintube.native.build import LIBRARIES
from twintube.native.compiler import FLAGS, TARGETS, compiled
from twintube.native.headers import header
from twintube.native.sources import PACKAGE

# Inside the installed package, or beside `src` in a checkout.
SOURCES = next(folder for folder in (PACKAGE / "fmu_sources", PACKAGE.parents[1] / "fmu_src") if folder.is_dir())
NATIVE, HEADERS = SOURCES / "native", SOURCES / "fmi"
MARK = b"twintube values\0"
KEY = 64  # characters

MODELS = {"damper": "", "car": "car"}  # with the folder of what is its own, below NATIVE
SHARED = ("unit.h", "checks.h", "instance.h", "access.h", "state.h", "messages.h")
OWN = ("memory.h", "step.h", "variables.h")
OF_VERSION = {2: ("fmi2.c", "fmi2/version.h"), 3: ("fmi3.c", "fmi3_absent.h", "fmi3/version.h")}
MODULE = "wasm32-wasi"
# As the libraries; a module without a main function in place of a shared library.
MODULE_FLAGS = (*(flag for flag in FLAGS if flag != "-shared"), "-mexec-model=reactor", "-Wl,--export-dynamic")

# In place of an FMU's own `model.h`; the numbers are in a file of their own, so that no compiler takes them for known.
APART = """/* The values of a library are put in when an FMU is built. */
#ifndef MODEL_H
#define MODEL_H

extern const struct marked {
    char mark[16], key[64];
    struct values values;
} MARKED;

#define VALUES (MARKED.values)

#endif
"""


class LibraryError(RuntimeError):
    """A library is missing or does not belong to the sources; the message says what to do."""


@dataclass(frozen=True)
class Unit:
    """What a library is compiled of: the file that includes all others, and these by name.

    `files` are those with their places in SOURCES, `equations` those that are translated, as `headers.py` calls them.
    """

    name: str
    main: str
    files: Mapping[str, str]
    equations: Mapping[str, str]
    flags: Sequence[str] = FLAGS

    @property
    def platforms(self) -> tuple[str, ...]:
        """The platforms that it is made for."""
        return tuple(name for name in TARGETS if (name == MODULE) == (self.flags is MODULE_FLAGS))

    def texts(self) -> dict[str, str]:
        """The files as they are in an FMU, but for `model.h`."""
        texts = {name: (SOURCES / place).read_text(encoding="utf-8") for name, place in self.files.items()}
        return texts | {name: header(place) for name, place in self.equations.items()}

    def key(self) -> str:
        """A digest of sources and flags."""
        parts = [*self.flags, *(part for pair in sorted(self.texts().items()) for part in pair)]
        return hashlib.sha256("\0".join(parts).encode()).hexdigest()

    def path(self, platform: str) -> Path:
        """Where the library for a platform is."""
        return LIBRARIES / platform / f"{self.name}.{TARGETS[platform][1]}"

    def made(self, platform: str) -> Path:
        """Compile the library for a platform; raises CompilerError."""
        texts = {**self.texts(), "model.h": APART, "library.c": numbers(self.key())}
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary)
            for name, text in texts.items():
                (folder / name).write_text(text, encoding="utf-8")
            output = folder / "out" / self.path(platform).name
            output.parent.mkdir()
            sources = [folder / self.main, folder / "library.c"]
            compiled(sources, platform, output, (*self.flags, f"-I{HEADERS}"))
            write_bytes(self.path(platform), output.read_bytes())
        return self.path(platform)


def unit_of(model: str, version: int) -> Unit:
    """The unit of a model for a version of FMI."""
    folder = Path("native", MODELS[model])
    files = {name: f"native/{name}" for name in SHARED} | {name: (folder / name).as_posix() for name in OWN}
    files |= {Path(name).name: f"native/{name}" for name in OF_VERSION[version]}
    equations = {"kernel.h": Path(MODELS[model], "kernel.h").as_posix()}
    return Unit(f"{model}_fmi{version}", f"fmi{version}.c", files, equations)


UNITS = {(model, version): unit_of(model, version) for model in MODELS for version in OF_VERSION}
EXPLORER = Unit(
    "explorer",
    "explorer.c",
    {**UNITS["damper", 2].files, "explorer.c": "explorer/explorer.c"},
    {**UNITS["damper", 2].equations, "quarter_car.h": "quarter_car.h"},
    MODULE_FLAGS,
)


def numbers(key: str) -> str:
    """The C of the marked values, still without any."""
    mark = MARK.rstrip(b"\0").decode()
    return f'#include "unit.h"\n\nconst struct marked MARKED = {{"{mark}", "{key}", {{"", {{0}}}}}};\n'


def library(unit: Unit, platform: str) -> bytes:
    """A library as it was compiled, without values; raises LibraryError where it is missing or of other sources."""
    path = unit.path(platform)
    if not path.is_file():
        raise LibraryError(f"no library for {platform}: `python -m twintube.native {platform}` makes it")
    data = path.read_bytes()
    if data.count(MARK) != 1 or data[data.index(MARK) + len(MARK) :][:KEY] != unit.key().encode():
        raise LibraryError(
            f"{path}: is not compiled from these equations and sources; `python -m twintube.native {platform}` does it"
        )
    return data
