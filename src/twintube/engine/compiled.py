"""The compiled kernel and loops, and the records that they take: rows of structured arrays, which are structs in C."""

from collections.abc import Callable
from dataclasses import fields
from functools import cache
from operator import attrgetter
from typing import Any

import numpy as np

from twintube.native.library import module as module  # noqa: PLC0414  # others have it from here


@cache
def dtype(record: type) -> np.dtype[Any]:
    """The structured type of a record of `core/variables.py`."""
    layout: list[tuple[Any, ...]] = []
    for item in fields(record):
        kind = np.int64 if item.metadata["integer"] else np.float64
        size = item.metadata["size"]
        layout.append((item.name, kind) if size == 1 else (item.name, kind, (size,)))
    return np.dtype(layout, align=True)


@cache
def values(record: type) -> Callable[[Any], tuple[Any, ...]]:
    """What takes the values of a record, in their order."""
    return attrgetter(*(item.name for item in fields(record)))


def as_row(record: Any) -> np.ndarray[Any, Any]:
    """A record as a structured array of length 1."""
    kind: type = type(record)
    return np.array([values(kind)(record)], dtype(kind))
