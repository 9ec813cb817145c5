"""Sources of the subset, translated, compiled by the compiler of this machine and loaded beside their Python."""

import ctypes
import math
from collections.abc import Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from twintube.native import build, compiler
from twintube.native.library import functions
from twintube.native.translate import Equations, translated

WARNINGS = ("-Wall", "-Wextra", "-Werror", "-Wno-unused-function")


def in_c(source: str, entries: list[str], folder: Path, warnings: Sequence[str] = WARNINGS) -> SimpleNamespace:
    """The entries of a source as the compiled functions that the library's are."""
    made = translated(Equations({"source.py": source}, entries, prefix="t_"), exported=True)
    said = made.calls.replace("\n", "\\n")
    text = f'{build.HEAD}{made.text}\nEXPORTED const char twintube_calls[] = "{said}";\n'
    (folder / "source.c").write_text(text, encoding="utf-8")
    library = folder / "source.so"
    here = compiler.this_machine()
    compiler.compiled([folder / "source.c"], here, library, (*build.FLAGS, *warnings), build.usual())
    return functions(ctypes.CDLL(str(library)))["t"]


def in_python(source: str) -> dict[str, Any]:
    """The same functions, executed."""
    space: dict[str, Any] = {"math": math}
    exec(compile("from __future__ import annotations\n" + source, "source.py", "exec"), space)
    return space
