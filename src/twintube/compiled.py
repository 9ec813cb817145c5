"""The kernel compiled by numba: one generated module per state of the sources.

numba's cache notices a change only in the file of the cached function itself. The kernel's files, the effects and the
drivers are therefore joined into one module whose name is the digest of their text: another text is another module.
"""

import ast
import hashlib
import importlib.util
import os
import sys
import tempfile
from dataclasses import fields
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import platformdirs

from twintube import effects
from twintube.variables import FV_POINTS

PACKAGE = Path(__file__).parent
SOURCES = (
    "kernel/prepare.py",
    "kernel/forces.py",
    "kernel/rebound.py",
    "kernel/compression.py",
    "kernel/step.py",
    "frame.py",
)
DRIVERS = ("model.py", "vehicle/quarter_car.py", "drivers.py")
HEAD = f"import math\nimport numba\n\nFV_POINTS = {FV_POINTS}\n"


def joined_source() -> str:
    """The text of the generated module: constants and functions of all sources, compiled without fast-math."""
    parts = [HEAD]
    for name in SOURCES:
        parts += compilable((PACKAGE / name).read_text(encoding="utf-8"))
    for text in (*effects.sources().values(), effects.dispatch_source(), effects.reset_source()):
        parts += compilable(text, described=True)
    for name in DRIVERS:
        parts += compilable((PACKAGE / name).read_text(encoding="utf-8"))
    return "\n\n".join(parts) + "\n"


def compilable(text: str, *, described: bool = False) -> list[str]:
    """Constants and functions of a source; of one that is `described` by constants of other types, numbers only."""
    parts = []
    for node in ast.parse(text).body:
        if isinstance(node, ast.FunctionDef):
            node.returns = None
            for argument in node.args.args:
                argument.annotation = None
            parts.append('@numba.njit(cache=True, error_model="numpy", nogil=True)\n' + ast.unparse(node))
        elif isinstance(node, ast.Assign):
            number = isinstance(node.value, ast.Constant) and type(node.value.value) in (int, float)
            if number or not described:
                parts.append(ast.unparse(node))
    return parts


@cache
def module() -> ModuleType:
    """The compiled kernel and drivers, as functions of structured arrays' rows."""
    text = joined_source()
    name = "twintube_kernel_" + hashlib.sha256(text.encode()).hexdigest()[:16]
    for folder in (Path(platformdirs.user_cache_dir("twintube")), Path(tempfile.gettempdir()) / "twintube"):
        try:
            folder.mkdir(parents=True, exist_ok=True)
            path = folder / f"{name}.py"
            if not path.exists():
                part = path.with_suffix(f".{os.getpid()}.part")
                part.write_text(text, encoding="utf-8")
                part.replace(path)
            break
        except OSError:
            continue
    else:
        raise OSError("no writable folder for the compiled kernel, neither the user's cache nor the temporary folder")
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None and spec.loader is not None
    loaded = importlib.util.module_from_spec(spec)
    sys.modules[name] = loaded
    spec.loader.exec_module(loaded)
    return loaded


@cache
def dtype(record: type) -> np.dtype[Any]:
    """The structured type of a record of `variables.py`."""
    layout: list[tuple[Any, ...]] = []
    for item in fields(record):
        kind = np.int64 if item.metadata["integer"] else np.float64
        size = item.metadata["size"]
        layout.append((item.name, kind) if size == 1 else (item.name, kind, (size,)))
    return np.dtype(layout, align=True)


def as_row(record: Any) -> np.ndarray[Any, Any]:
    """A record as a structured array of length 1."""
    kind: type = type(record)
    row = np.zeros(1, dtype(kind))
    for item in fields(record):
        row[0][item.name] = getattr(record, item.name)
    return row
