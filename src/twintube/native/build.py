"""The library of kernel and loops: translated and compiled for a machine, with a mark of the equations that it is of."""

import hashlib
import shutil
import tempfile
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from twintube.common.files import write_bytes
from twintube.native import compiler, sources
from twintube.native.translate import translated

LIBRARIES = sources.PACKAGE / "native" / "lib"
NAME = "twintube"
# Of a function of math.h only the value is wanted.
FLAGS = (*compiler.EQUAL, "-O3", "-fno-math-errno", "-fno-trapping-math", "-fvisibility=hidden", "-shared", "-s")
MARK = b"twintube equations "
HEAD = """\
/* Translated by twintube/native; do not edit. */
#include <stddef.h>

#ifdef _WIN32
#define EXPORTED __declspec(dllexport)
#else
#define EXPORTED __attribute__((visibility("default")))
#endif
"""
COMMAND = "python -m twintube.native"


def digest(first: str, *names: str) -> str:
    """A digest of a text and of all that the C of sources of these names follows from."""
    parts = [first]
    for path in sources.paths(names):
        parts += [path.name, path.read_text(encoding="utf-8")]
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()


@cache
def key() -> str:
    """A digest of what the library is made of."""
    return digest("\0".join([*FLAGS, HEAD]), *sources.CAR, *sources.LOOPS, *sources.RIG)


def source() -> str:
    """The C of the library."""
    parts, calls = [HEAD], []
    for each in (sources.loops(), sources.rig()):
        made = translated(each, exported=True)
        parts.append(made.text)
        calls.append(made.calls)
    said = "".join(f'\n    "{line}\\n"' for line in "\n".join(calls).splitlines())
    parts.append(f'EXPORTED const char twintube_equations[] = "{MARK.decode()}{key()}";\n')
    parts.append(f"/* How each function is called. */\nEXPORTED const char twintube_calls[] ={said};\n")
    return "\n".join(parts)


def library_path(platform: str) -> Path:
    """Where the library for a platform is."""
    return LIBRARIES / platform / f"{NAME}.{compiler.TARGETS.get(platform, ('', 'so'))[1]}"


def made(platform: str, usual: Sequence[str] = ()) -> Path:
    """Translate and compile the library for a platform; raises CompilerError, SubsetError where an equation is at fault."""
    path = library_path(platform)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        (folder / "library.c").write_text(source(), encoding="utf-8")
        output = folder / "out" / path.name
        output.parent.mkdir()
        compiler.compiled([folder / "library.c"], platform, output, FLAGS, usual)
        write_bytes(path, output.read_bytes())
    return path


def usual() -> tuple[str, ...]:
    """The compiler that this machine has, unless `CC` names one: what it makes may not run on older machines."""
    return ("cc",) if not compiler.own_compiler() and shutil.which("cc") else ()


def current(path: Path) -> bool:
    """Whether a library is there and of the present equations."""
    return path.is_file() and MARK + key().encode() in path.read_bytes()
