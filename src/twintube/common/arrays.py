"""The type of every array of numbers, and arrays that nobody can change."""

from dataclasses import fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.floating[Any]]
# As the translation to C reads them in the kernel's subset, C-contiguous: real numbers of one, two and three directions, and
# whole ones.
Vector = Array
Table = Array
Stack = Array
Counts = NDArray[np.int64]
Addresses = NDArray[np.int64]


def read_only(array: NDArray[Any]) -> NDArray[Any]:
    """A view of an array that cannot be written to."""
    view = array.view()
    view.flags.writeable = False
    return view


def freeze_arrays(record: Any) -> None:
    """Make all array fields of a frozen dataclass read-only; to be called in its `__post_init__`."""
    for item in fields(record):
        value = getattr(record, item.name)
        if isinstance(value, np.ndarray):
            object.__setattr__(record, item.name, read_only(value))
