"""Reads .mat, .parquet, .mf4, .xlsx and .json files in a process of its own: a damaged file can crash these libraries.

Run as a script by `binary.py` with a folder as its argument. `requests.json` there lists number, path and request of each
file: the wanted columns, and for workbooks the sheet and the rows to skip. File i becomes `i.npz` with the columns `c0`,
`c1`, ... and `i.json` with their names, or with the message why it cannot be read. Imports nothing of this package, which
would take a second.
"""

import json
import math
import os
import re
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

MEMORY = 4 << 30  # [bytes] address space where the system can limit it
MOST_VALUES = 64_000_000  # numbers in all columns of a file
MOST_COLUMNS = 1000
MOST_WIDE = 64  # columns of a matrix; a wider one is not a recording of channels
LONGEST_NAME = 500
LONGEST_CELL = 100  # characters of a text in a column
DEEPEST = 3  # tables within tables of a JSON file
HDF5 = b"\x89HDF"
NUMERIC = re.compile(r"\s*[+-]?[0-9](?!/)")  # how a number or a date begins, and not the unit 1/min
QUANTITIES = ("time", "stroke", "force", "velocity", "temperature")
Request = dict[str, Any]  # wanted: names in the file, or None; sheet: a name or None; skip_rows: before the header


class UnreadableError(ValueError):
    """A file that cannot be read, with the whole message."""


class Columns:
    """The columns of a file, within bounds on their number and size."""

    def __init__(self) -> None:
        self.values: dict[str, np.ndarray[Any, Any]] = {}
        self.empty: dict[str, np.ndarray[Any, Any]] = {}  # where a cell holds nothing
        self.units: dict[str, str] = {}
        self.refused: dict[str, str] = {}  # columns that hold no numbers, and what they hold
        self.first_row: int | None = None  # of the samples in a workbook
        self.count = 0

    def expect(self, name: str, count: int) -> None:
        """Raise UnreadableError if a column of `count` values is too many; called before it is read."""
        if len(name) > LONGEST_NAME:
            raise UnreadableError(f"a column's name has {len(name)} characters, at most {LONGEST_NAME} are read")
        if len(self.values) + len(self.refused) >= MOST_COLUMNS:
            raise UnreadableError(f"more than {MOST_COLUMNS} columns")
        self.count += count
        if self.count > MOST_VALUES:
            raise UnreadableError(f"more than {MOST_VALUES} values up to column {name!r}")

    def put(self, name: str, cells: list[Any]) -> None:
        """Add a column of numbers, of texts (times, numbers with a comma), or of both; None is an empty cell."""
        self.expect(name, len(cells))
        kinds = {type(cell) for cell in cells} - {type(None)}
        if kinds <= {int, float}:
            self.values[name] = np.array([np.nan if cell is None else cell for cell in cells], dtype=float)
            self.empty[name] = np.array([cell is None for cell in cells])
        elif kinds <= {int, float, str} and max(len(cell) for cell in cells if isinstance(cell, str)) <= LONGEST_CELL:
            self.values[name] = np.array(["" if cell is None else str(cell) for cell in cells])
        else:
            self.refused[name] = ", ".join(sorted(kind.__name__ for kind in kinds))


def parquet(path: str, _: Request) -> Columns:
    """Parquet, by its column names."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    columns = Columns()
    with pq.ParquetFile(path, memory_map=False) as file:
        rows = file.metadata.num_rows
        if rows < 0 or file.metadata.num_columns > MOST_COLUMNS:
            raise UnreadableError(f"{file.metadata.num_columns} columns, at most {MOST_COLUMNS} are read")
        for field in file.schema_arrow:
            kind = field.type
            number = pa.types.is_integer(kind) or pa.types.is_floating(kind) or pa.types.is_decimal(kind)
            columns.expect(field.name, rows if number else 0)
            if not number:
                columns.refused[field.name] = str(kind)[:60]
                continue
            column = file.read([field.name]).column(field.name).cast(pa.float64(), safe=False)
            columns.empty[field.name] = column.is_null().to_numpy()
            columns.values[field.name] = column.to_numpy()
    return columns


def is_hdf5(path: Path) -> bool:
    """Whether a file is HDF5, at its start or behind MATLAB's header of 512 bytes."""
    with path.open("rb") as file:
        start = file.read(516)
    return start.startswith(HDF5) or start[512:] == HDF5


def matlab(path: str, _: Request) -> Columns:
    """MATLAB v5 to v7.3."""
    columns = Columns()
    if is_hdf5(Path(path)):
        import h5py

        with h5py.File(path) as hdf:
            hdf.visititems(lambda name, item: hdf_item(name.replace("/", "."), item, columns))
    else:
        from scipy.io import loadmat, whosmat

        declared = sum(math.prod(shape) for _, shape, _ in whosmat(path))  # a compressed file may be small
        if declared > MOST_VALUES:
            raise UnreadableError(f"declares {declared} values, at most {MOST_VALUES} are read")
        for name, item in loadmat(path, struct_as_record=False).items():
            if not name.startswith("__"):
                flatten(name, item, columns)
    return columns


def hdf_item(name: str, item: Any, columns: Columns) -> None:
    """Put an HDF5 dataset into `columns`, if its declared size allows."""
    if name.startswith("#refs#") or not hasattr(item, "dtype") or item.dtype.kind not in "fiu":
        return
    if item.external or item.is_virtual:
        raise UnreadableError(f"{name!r} has its values in another file")
    if item.size and (item.ndim == 1 or (item.ndim == 2 and min(item.shape) <= MOST_WIDE)):
        if item.size > MOST_VALUES:
            raise UnreadableError(f"{name!r} declares {item.size} values, at most {MOST_VALUES} are read")
        flatten(name, item[()], columns)


def flatten(name: str, item: Any, columns: Columns, depth: int = 0) -> None:
    """Put a MATLAB variable into `columns`: a matrix column by column, a struct field by field."""
    if not hasattr(item, "dtype"):
        return
    if item.dtype == object and item.size == 1 and hasattr(np.asarray(item).flat[0], "_fieldnames"):
        struct = np.asarray(item).flat[0]
        if depth > 8:
            raise UnreadableError(f"{name[:60]!r}: structs within structs, more than 8")
        for key in struct._fieldnames:
            flatten(f"{name}.{key}", getattr(struct, key), columns, depth + 1)
        return
    values = np.asarray(item)
    if values.dtype.kind not in "fiu" or values.ndim not in {1, 2} or min(values.shape) == 0:
        return
    if values.ndim == 1 or min(values.shape) == 1:
        columns.expect(name, values.size)
        columns.values[name] = values.ravel()
    elif min(values.shape) <= MOST_WIDE:
        table = values if values.shape[0] >= values.shape[1] else values.T
        for i in range(table.shape[1]):
            columns.expect(f"{name}[{i}]", len(table))
            columns.values[f"{name}[{i}]"] = table[:, i]


def mdf(path: str, request: Request) -> Columns:
    """ASAM MDF: the channels named in `columns`, else those named as quantities; time is their master channel."""
    from asammdf import MDF

    columns = Columns()
    with MDF(path) as file:
        masters = {file.groups[group].channels[i].name for group, i in file.masters_db.items()}
        names = request["wanted"] or [name for name in file.channels_db if name.split(" [")[0] in QUANTITIES]
        signals = {}
        for name in dict.fromkeys(names):
            if name in file.channels_db and name not in masters:
                group = file.groups[file.channels_db[name][0][0]]
                columns.expect(name, group.channel_group.cycles_nr)
                signals[name] = file.get(name)
    signals = {name: signal for name, signal in signals.items() if signal.samples.dtype.kind in "fiu"}
    if not signals:
        return columns
    first = next(iter(signals))
    time = signals[first].timestamps
    for name, signal in signals.items():
        if not np.array_equal(signal.timestamps, time):
            raise UnreadableError(
                f"channel {name!r} is not sampled at the times of channel {first!r}; nothing is resampled here"
            )
        if signal.samples.ndim != 1:
            columns.refused[name] = f"an array of {signal.samples.ndim} dimensions"
            continue
        columns.values[name] = signal.samples
        if signal.unit:
            columns.units[name] = str(signal.unit)[:60]
    for name in masters | {"time"}:
        columns.values[name] = time
        columns.units[name] = "s"
    return columns


def workbook(path: str, request: Request) -> Columns:
    """A sheet of a workbook: header, a row of units where there is one, samples."""
    from python_calamine import CalamineWorkbook

    with CalamineWorkbook.from_path(path) as book:
        sheet = request["sheet"] or book.sheet_names[0]
        if sheet not in book.sheet_names:
            raise UnreadableError(f"no sheet {sheet!r} among {', '.join(book.sheet_names)[:300]}")
        rows = [[plain_cell(cell) for cell in row] for row in book.get_sheet_by_name(sheet).to_python(skip_empty_area=False)]
    skipped = next((i for i in range(request["skip_rows"], len(rows)) if any(c is not None for c in rows[i])), len(rows))
    while rows and all(cell is None for cell in rows[-1]):
        rows.pop()
    if len(rows) <= skipped:
        raise UnreadableError(f"sheet {sheet!r} is empty" + (f" after {skipped} rows" if skipped else ""))
    headers = ["" if cell is None else str(cell).strip() for cell in rows[skipped]]
    if not any(isinstance(cell, str) for cell in rows[skipped]):
        raise UnreadableError(f"row {skipped + 1}: numbers where the header must be; set skip_rows")
    for header in headers:
        if header and headers.count(header) > 1:
            raise UnreadableError(f"row {skipped + 1}: two columns are named {header[:60]!r}")
    columns = Columns()
    body = rows[skipped + 1 :]
    if len(body) > 1 and all(cell is None or (isinstance(cell, str) and not NUMERIC.match(cell)) for cell in body[0]):
        columns.units = {h: c.strip("[]() ") for h, c in zip(headers, body[0], strict=True) if h and c is not None}
        body = body[1:]
    columns.first_row = len(rows) - len(body) + 1
    for i, header in enumerate(headers):
        if header:
            columns.put(header, [row[i] for row in body])
    return columns


def plain_cell(cell: Any) -> Any:
    """A number, a text or None; dates and times as ISO texts, durations in seconds."""
    if isinstance(cell, str):
        return cell if cell.strip() else None
    if isinstance(cell, bool):
        return str(cell)
    if hasattr(cell, "isoformat"):
        text = str(cell.isoformat())
        return text if ":" in text else f"{text}T00:00:00"  # midnight comes without its time
    return cell.total_seconds() if hasattr(cell, "total_seconds") else cell


def json_table(path: str, _: Request) -> Columns:
    """JSON: lists by name, a list of samples, or `columns` and `data`; a table within a table is looked for."""
    columns = Columns()
    collect(json.loads(Path(path).read_text(encoding="utf-8-sig")), columns, 0)
    if not columns.values and not columns.refused:
        raise UnreadableError("no table: must be lists by name, or a list of samples with names")
    return columns


def collect(content: Any, columns: Columns, depth: int) -> None:
    """Put the first table in `content` into `columns`."""
    if isinstance(content, list) and content and all(isinstance(sample, dict) for sample in content):
        for name in dict.fromkeys(name for sample in content for name in sample):
            columns.put(name, [sample.get(name) for sample in content])
        return
    if not isinstance(content, dict):
        return
    names, rows = content.get("columns"), content.get("data")
    if isinstance(names, list) and isinstance(rows, list) and all(isinstance(row, list) for row in rows):
        if any(len(row) != len(names) for row in rows):
            raise UnreadableError(f"`data` has rows of other lengths than `columns`, {len(names)}")
        for i, name in enumerate(names):
            columns.put(str(name), [row[i] for row in rows])
        return
    for name, item in content.items():
        values = item.get("values", item.get("data")) if isinstance(item, dict) else item
        if isinstance(values, list) and values and not any(isinstance(cell, (list, dict)) for cell in values):
            columns.put(name, values)
            if isinstance(item, dict) and isinstance(item.get("unit"), str):
                columns.units[name] = item["unit"][:60]
    if columns.values or columns.refused:
        units = content.get("units")
        if isinstance(units, dict):
            columns.units |= {name: str(unit)[:60] for name, unit in units.items() if name in columns.values}
        return
    for item in content.values():
        if depth < DEEPEST and not columns.values:
            collect(item, columns, depth + 1)


READERS: dict[str, Callable[[str, Request], Columns]] = {
    ".parquet": parquet,
    ".pq": parquet,
    ".mat": matlab,
    ".mf4": mdf,
    ".mdf": mdf,
    ".xlsx": workbook,
    ".xlsm": workbook,
    ".xls": workbook,
    ".json": json_table,
}


def read(path: str, request: Request, target: Path) -> dict[str, Any]:
    """Read one file into `target`; what its JSON file says."""
    ending = Path(path).suffix.lower()
    try:
        columns = READERS[ending](path, request)
        arrays: dict[str, Any] = {f"c{i}": np.asarray(values) for i, values in enumerate(columns.values.values())}
        arrays |= {f"e{i}": columns.empty[name] for i, name in enumerate(columns.values) if name in columns.empty}
        np.savez(target, **arrays)
    except UnreadableError as error:
        return {"error": str(error)}
    except MemoryError:
        return {"error": f"reading takes more than {MEMORY >> 30} GiB: the file is damaged or too large"}
    except Exception as error:  # the libraries raise nearly everything on a damaged file
        return {"error": f"not a readable {ending} file ({type(error).__name__}: {str(error)[:500]})"}
    return {
        "names": list(columns.values), "units": columns.units, "refused": columns.refused, "first_row": columns.first_row,
    }  # fmt: skip


def limit_memory() -> None:
    """Limit the address space, where the system can."""
    try:
        import resource
    except ImportError:  # Windows
        return
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    most = MEMORY if hard == resource.RLIM_INFINITY else min(MEMORY, hard)
    resource.setrlimit(resource.RLIMIT_AS, (most, hard))
    resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))


def end_with_parent() -> None:
    """End this process when the other end of standard input closes."""
    sys.stdin.read()  # nothing is ever written to it
    os._exit(1)


def main() -> None:
    """Answer the requests in their order."""
    limit_memory()
    threading.Thread(target=end_with_parent, daemon=True).start()
    folder = Path(sys.argv[1])
    for number, path, request in json.loads((folder / "requests.json").read_text(encoding="utf-8")):
        answer = read(path, request, folder / f"{number}.npz")
        part = folder / f"{number}.part"
        part.write_text(json.dumps(answer), encoding="utf-8")
        part.replace(folder / f"{number}.json")
    os._exit(0)  # the libraries' threads and caches need no tidying


if __name__ == "__main__":
    main()
