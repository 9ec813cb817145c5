"""The kernel compiled by numba: one generated module per state of the sources.

numba's cache notices a change only in the file of the cached function itself. The kernel's files, the effects and the
loops are therefore joined into one module whose name is the digest of their text: another text is another module.
"""

import ast
import hashlib
import sys
from dataclasses import fields
from functools import cache
from pathlib import Path
from threading import Lock
from types import ModuleType
from typing import Any

import numpy as np

from twintube.common.parsing import parsed
from twintube.core import sources
from twintube.core.hooks import NEEDED
from twintube.core.variables import FV_POINTS
from twintube.engine.code_cache import CodeCache

PACKAGE = Path(__file__).parents[1]
LOOPS = (
    "engine/loops.py",
    "vehicle/quarter_car.py",
    "vehicle/loops.py",
    "vehicle/full/tyre.py",
    "vehicle/full/brakes.py",
    "vehicle/full/body.py",
    "vehicle/full/driver.py",
    "vehicle/full/steering.py",
    "vehicle/full/loop.py",
    "vehicle/full/unit_loop.py",
    "vehicle/full/rolling.py",
)
LOADING = Lock()
HEAD = f"import math\nimport numba\n\nFV_POINTS = {FV_POINTS}\n"


def joined_source() -> str:
    """The text of the generated module: constants and functions of all sources, compiled without fast-math."""
    parts = [HEAD]
    for text in sources.kernel_texts():
        parts += compilable(text)
    for text in sources.effect_texts():
        parts += compilable(text)
    for text in (
        sources.agreement_text(),
        sources.model_text(),
        *((PACKAGE / name).read_text(encoding="utf-8") for name in LOOPS),
    ):
        parts += compilable(text)
    return "\n\n".join(parts) + "\n"


def compilable(text: str) -> list[str]:
    """Constants and functions of a source, without what describes an effect."""
    parts = []
    for node in parsed(text).body:
        if isinstance(node, ast.FunctionDef):
            node.returns = None
            for argument in node.args.args:
                argument.annotation = None
            parts.append('@numba.njit(cache=True, error_model="numpy", nogil=True)\n' + ast.unparse(node))
        elif isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) not in NEEDED:
            parts.append(ast.unparse(node))
    return parts


def module() -> ModuleType:
    """The compiled kernel and loops, as functions of structured arrays' rows; threads that start together wait for one."""
    with LOADING:
        return loaded_module()


@cache
def loaded_module() -> ModuleType:
    """The module, joined and executed."""
    text = joined_source()
    name = "twintube_kernel_" + hashlib.sha256(text.encode()).hexdigest()[:16]
    stored = CodeCache.open(name, text)
    loaded = ModuleType(name)
    loaded.__file__ = str(stored.path)
    sys.modules[name] = loaded
    # From the text itself: bytecode beside the file is one more thing that can be damaged.
    exec(compile(text, stored.path, "exec"), vars(loaded))
    stored.seal_after_compiling(loaded)
    return loaded


@cache
def dtype(record: type) -> np.dtype[Any]:
    """The structured type of a record of `core/variables.py`."""
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
