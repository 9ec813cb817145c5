"""The compiled library as functions of Python: called without a copy, other threads run meanwhile.

A record is a row of a structured array with the layout of `engine/compiled.py`; several are such an array. Arrays must be
C-contiguous, of float64 or int64: what is not is refused by its name, nothing is converted. The library says itself how its
functions are called (`translate.call_of`).
"""

import ctypes
from collections.abc import Callable
from functools import cache
from operator import index
from pathlib import Path
from threading import Lock
from types import SimpleNamespace
from typing import Any

import numpy as np

from twintube.errors import UserError
from twintube.native import build
from twintube.native.compiler import CompilerError, this_machine
from twintube.native.sources import PACKAGE

LOADING = Lock()
NUMBERS = {"float": ctypes.c_double, "int": ctypes.c_int64, "bool": ctypes.c_bool, "none": None}
Convert = Callable[[Any], Any]


class LibraryError(UserError, RuntimeError):
    """The compiled library is missing or of other equations; the message says what to do."""


def struct(*parts: Any) -> type[ctypes.Structure]:
    """A struct of C with these members."""
    return type("Struct", (ctypes.Structure,), {"_fields_": [(f"m{i}", part) for i, part in enumerate(parts)]})


STRUCTS = {rank: struct(ctypes.c_void_p, *[ctypes.c_int64] * rank) for rank in (1, 2, 3)}


def array(where: str, kind: str, rank: int, *, changed: bool) -> tuple[Any, Convert]:
    """The type of an array in C, and what makes it of one of numpy."""
    dtype, made = np.dtype(f"{kind}64"), STRUCTS[rank]

    def convert(value: Any) -> Any:
        if value.dtype != dtype or value.ndim != rank or not value.flags.c_contiguous:
            raise TypeError(
                f"{where}: array {value.shape} of {value.dtype}, must be of {dtype}, {rank}-dimensional and C-contiguous"
            )
        if changed and not value.flags.writeable:
            raise TypeError(f"{where}: array is read-only, must be one that can be written to")
        return made(value.ctypes.data, *value.shape)

    return made, convert


def record(where: str, size: int) -> tuple[Any, Convert]:
    """The same of a record, or of several: their address."""

    def convert(value: Any) -> int:
        if value.dtype.itemsize != size:
            raise TypeError(f"{where}: record of {value.dtype.itemsize} bytes, must have {size}")
        return np.asarray(value).ctypes.data  # a row is a view, too

    return ctypes.c_void_p, convert


def bundle(where: str, codes: str, *, changed: bool) -> tuple[Any, Convert]:
    """The same of a NamedTuple of arrays and numbers."""
    parts = [converter(where, code, changed=changed) for code in codes.split(",")]
    made = struct(*(kind for kind, _ in parts))
    pointer = ctypes.POINTER(made)
    converts = [convert for _, convert in parts]

    def convert(value: Any) -> Any:
        return pointer(made(*[each(part) for each, part in zip(converts, value, strict=True)]))

    return pointer, convert


def converter(where: str, code: str, *, changed: bool) -> tuple[Any, Convert]:
    """The type in C and the conversion of an argument by its code."""
    if code.startswith("("):
        return bundle(where, code[1:-1], changed=changed)
    if code.startswith("record"):
        return record(where, int(code.removeprefix("records").removeprefix("record")))
    if code in NUMBERS:
        return NUMBERS[code], index if code == "int" else bool if code == "bool" else float
    return array(where, code[:-1], int(code[-1]), changed=changed)


def function(library: ctypes.CDLL, line: str) -> Callable[..., Any]:
    """A function of the library by the line that says how it is called."""
    result, name, *arguments = line.split()
    called = library[name]
    parts = []
    for argument in arguments:
        word, code = argument.split(":", 1)
        parts.append(converter(f"{name}: {word}", code.rstrip("!"), changed=code.endswith("!")))
    called.restype, called.argtypes = NUMBERS[result], [kind for kind, _ in parts]
    converts = [convert for _, convert in parts]

    def call(*values: Any) -> Any:
        return called(*[convert(value) for convert, value in zip(converts, values, strict=True)])

    call.__name__ = name
    return call


def present() -> Path:
    """The library of this machine, made where it is missing or stale in a checkout; raises LibraryError."""
    path = build.library_path(this_machine())
    if build.current(path):
        return path
    state = "is of other equations" if path.is_file() else "is missing"
    problem = f"{path}: the compiled library {state}: run `{build.COMMAND}`, which needs a C compiler"
    if not (PACKAGE.parents[1] / "pyproject.toml").is_file():
        raise LibraryError(problem)
    try:
        return build.made(this_machine(), build.usual())
    except (CompilerError, OSError) as error:
        raise LibraryError(f"{problem} ({error})") from error


@cache
def loaded() -> dict[str, SimpleNamespace]:
    """The functions of this machine's library."""
    return functions(ctypes.CDLL(str(present())))


def functions(library: ctypes.CDLL) -> dict[str, SimpleNamespace]:
    """The functions of a library by what their names begin with."""
    found: dict[str, SimpleNamespace] = {}
    calls = ctypes.string_at(ctypes.addressof(ctypes.c_char.in_dll(library, "twintube_calls"))).decode("ascii")
    for line in calls.splitlines():
        prefix, name = line.split()[1].split("_", 1)
        setattr(found.setdefault(prefix, SimpleNamespace()), name, function(library, line))
    return found


def module(prefix: str = "kernel") -> SimpleNamespace:
    """The functions of the library; threads that start together wait for one. Raises LibraryError."""
    with LOADING:
        return loaded()[prefix]
