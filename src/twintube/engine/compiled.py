"""The compiled kernel and loops, and the records that they take: rows of structured arrays, which are structs in C."""

from dataclasses import fields
from functools import cache
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


def as_row(record: Any) -> np.ndarray[Any, Any]:
    """A record as a structured array of length 1."""
    kind: type = type(record)
    row = np.zeros(1, dtype(kind))
    for item in fields(record):
        row[0][item.name] = getattr(record, item.name)
    return row
