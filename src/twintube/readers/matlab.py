"""MATLAB v5 to v7.3: a matrix by columns, a struct by fields, a cell array by cells."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from twintube.readers import is_hdf5
from twintube.readers.columns import MOST_VALUES, MOST_WIDE, Columns, Request, UnreadableError

MOST_NESTED = 8  # structs and cells within each other


def matlab(path: str, _: Request) -> Columns:
    """MATLAB v5 to v7.3."""
    columns = Columns()
    if is_hdf5(Path(path)):
        import h5py

        with h5py.File(path) as hdf:
            hdf.visititems(lambda name, item: hdf_item(name.replace("/", "."), item, columns))
    else:
        from scipy.io import loadmat, whosmat

        try:
            declared = sum(math.prod(shape) for _, shape, _ in whosmat(path))  # a compressed file may be small
        except TypeError:  # of an object nothing is declared; the memory of this process is limited
            declared = 0
        if declared > MOST_VALUES:
            raise UnreadableError(f"declares {declared} values, at most {MOST_VALUES} are read")
        for name, item in loadmat(path, struct_as_record=False).items():
            if hasattr(item, "dtype") and item.dtype.names and "s2" in item.dtype.names:  # an object, with its name inside
                columns.refuse(text_of(item["s0"]) or name, an_object(text_of(item["s2"])))
            elif not name.startswith("__"):
                flatten(name, item, columns)
    return columns


def text_of(value: Any) -> str:
    """What an object's part says, which the library gives as bytes or text within arrays."""
    while isinstance(value, np.ndarray) and value.size:
        value = value.flat[0]
    return value.decode("ascii", "replace") if isinstance(value, bytes) else str(value)


def an_object(kind: str) -> str:
    """What a variable is that only MATLAB reads."""
    return f"an object of class {kind}, which only MATLAB reads (save its Time and Data, or its columns, as arrays)"


def hdf_item(name: str, item: Any, columns: Columns, depth: int = 0) -> None:
    """Put an HDF5 dataset, or a group that a cell refers to, into `columns`, if its declared size allows."""
    too_deep(name, depth)
    if name.startswith(("#refs#", "#subsystem#")):
        return
    if not hasattr(item, "dtype"):
        for key in item if depth else ():  # other groups are visited one by one
            hdf_item(f"{name}.{key}", item[key], columns, depth + 1)
        return
    if item.external or item.is_virtual:
        raise UnreadableError(f"{name!r} has its values in another file")
    kind = text_of(item.attrs.get("MATLAB_class", b""))
    shape = [count for count in reversed(item.shape) if count > 1]
    if "MATLAB_object_decode" in item.attrs:
        columns.refuse(name, an_object(kind))
    elif "MATLAB_empty" in item.attrs or not item.size:
        columns.refuse(name, "an empty array")
    elif "ref" in (item.dtype.metadata or {}):
        references(name, item, kind, columns, depth)
    elif item.dtype.kind not in "fiu" or kind == "char":
        columns.refuse(name, "complex numbers" if item.dtype.names else "text")
    elif len(shape) > 2 or (len(shape) == 2 and min(shape) > MOST_WIDE):
        columns.refuse(name, f"an array of {sizes(shape)}")
    elif item.size > MOST_VALUES:
        raise UnreadableError(f"{name!r} declares {item.size} values, at most {MOST_VALUES} are read")
    else:
        flatten(name, item[()], columns)


def references(name: str, item: Any, kind: str, columns: Columns, depth: int) -> None:
    """Put the cells of a cell array into `columns`, or one field of all elements of a struct array."""
    if item.size > MOST_WIDE:
        columns.refuse(name, f"{item.size} cells, at most {MOST_WIDE} are read")
        return
    parent, _, field = name.rpartition(".")
    of_cells = kind == "cell" or depth or not parent
    own = [f"{name}[{i}]" if of_cells else f"{parent}[{i}].{field}" for i in range(item.size)]
    if item.size == 1:
        own = [name]
    else:
        columns.refuse(name, f"{item.size} cells ({own[0]} to {own[-1]})")
    for called, reference in zip(own, item[()].flat, strict=True):
        hdf_item(called, item.file[reference], columns, depth + 1)


def too_deep(name: str, depth: int) -> None:
    """Raise UnreadableError where structs and cells are within each other without end."""
    if depth > MOST_NESTED:
        raise UnreadableError(f"{name[:60]!r}: structs within structs, more than {MOST_NESTED}")


def sizes(shape: Sequence[int]) -> str:
    """The size of an array in words."""
    return " x ".join(map(str, shape))


def flatten(name: str, item: Any, columns: Columns, depth: int = 0) -> None:
    """Put a MATLAB variable into `columns`: a matrix by columns, a struct by fields, a cell array by cells."""
    too_deep(name, depth)
    if not isinstance(item, np.ndarray):
        columns.refuse(name, "a sparse matrix" if hasattr(item, "toarray") else type(item).__name__)
        return
    if hasattr(item, "classname"):
        columns.refuse(name, an_object(str(item.classname)))
    elif item.dtype == object:
        elements(name, list(item.flat), columns, depth)
    else:
        numbers(name, np.asarray(item), columns)


def elements(name: str, parts: list[Any], columns: Columns, depth: int) -> None:
    """Put the elements of a struct array or the cells of a cell array into `columns`; a single one under the name itself."""
    structs = bool(parts) and all(hasattr(part, "_fieldnames") for part in parts)
    what = f"a struct array of {len(parts)} elements" if structs else f"a cell array of {len(parts)} cells"
    if len(parts) > MOST_WIDE:
        columns.refuse(name, f"{what}, at most {MOST_WIDE} are read")
        return
    if len(parts) != 1:
        columns.refuse(name, what + (f" ({name}[0] to {name}[{len(parts) - 1}])" if parts else ""))
    for i, part in enumerate(parts):
        own = name if len(parts) == 1 else f"{name}[{i}]"
        if hasattr(part, "_fieldnames"):
            for key in part._fieldnames:
                flatten(f"{own}.{key}", getattr(part, key), columns, depth + 1)
        else:
            flatten(own, part, columns, depth + 1)


def numbers(name: str, values: np.ndarray[Any, Any], columns: Columns) -> None:
    """Put an array into `columns`: one of one row or column as it is (1 x 1 x N, too), a matrix column by column."""
    shape = [count for count in values.shape if count > 1]
    if values.dtype.kind not in "fiu":
        kinds = {"c": "complex numbers", "U": "text", "S": "text"}
        columns.refuse(name, kinds.get(values.dtype.kind, f"values of the kind {values.dtype}"[:60]))
    elif not values.size:
        columns.refuse(name, "an empty array")
    elif len(shape) > 2 or (len(shape) == 2 and min(shape) > MOST_WIDE):
        columns.refuse(name, f"an array of {sizes(values.shape)}")
    elif len(shape) < 2:
        columns.expect(name, values.size)
        columns.values[name] = values.ravel()
    else:
        matrix = values.reshape(shape)
        table = matrix if shape[0] >= shape[1] else matrix.T
        columns.refuse(name, f"a matrix of {table.shape[1]} columns ({name}[0] to {name}[{table.shape[1] - 1}])")
        for i in range(table.shape[1]):
            columns.expect(f"{name}[{i}]", len(table))
            columns.values[f"{name}[{i}]"] = table[:, i]
