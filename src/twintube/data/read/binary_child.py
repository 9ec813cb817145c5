"""Reads .mat, .parquet, .mf4, .xlsx and .json files in a process of its own: a damaged file can crash these libraries.

Run as a script by `binary.py` with a folder as its argument. `requests.json` there lists number, path and request of each
file: the wanted columns, and for workbooks the sheet. File i becomes `i.npz` with the columns `c0`, `c1`, ... and `i.json`
with their names, or with the rows of a sheet, or with the message why it cannot be read. Imports nothing of this package,
which would take a second.
"""

import json
import math
import os
import re
import sys
import threading
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

MEMORY = 4 << 30  # [bytes] address space where the system can limit it
MOST_VALUES = 64_000_000  # numbers in all columns of a file
MOST_CELLS = 20_000_000  # of a sheet
MOST_COLUMNS = 1000
MOST_WIDE = 64  # columns of a matrix; a wider one is not a recording of channels
LONGEST_NAME = 500
LONGEST_CELL = 100  # characters of a text in a column
DEEPEST = 3  # tables within tables of a JSON file
MOST_NESTED = 8  # structs and cells within each other
MOST_LISTED = 20  # channel groups in a message
HDF5 = b"\x89HDF"
QUANTITIES = ("time", "stroke", "force", "velocity", "temperature")
ELEMENT = re.compile(r"(.+)\[([0-9]{1,4})\]")  # of several channels of one name
Request = dict[str, Any]  # wanted: names in the file, or None; sheet, group: a name or None; first_rows: of all sheets


class UnreadableError(ValueError):
    """A file that cannot be read, with the whole message."""


class Columns:
    """The columns of a file, within bounds on their number and size."""

    def __init__(self) -> None:
        self.values: dict[str, np.ndarray[Any, Any]] = {}
        self.empty: dict[str, np.ndarray[Any, Any]] = {}  # where a cell holds nothing
        self.units: dict[str, str] = {}
        self.refused: dict[str, str] = {}  # columns that hold no numbers, and what they hold
        self.nothing = ""  # what a cell without a value means, where it is not just empty
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

    def refuse(self, name: str, what: str) -> None:
        """Note what a variable is that is no column of numbers."""
        self.expect(name, 0)
        self.refused[name] = what

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


def mdf(path: str, request: Request) -> Columns:
    """ASAM MDF: the channels named in `columns`, else those named as quantities; time is their master channel."""
    from asammdf import MDF

    columns = Columns()
    with MDF(path) as file:
        masters = {file.groups[group].channels[i].name for group, i in file.masters_db.items()}
        titles = [str(getattr(g.channel_group, "acq_name", "") or g.channel_group.comment or "")[:60] for g in file.groups]
        only = chosen_group(request["group"], titles)
        names = request["wanted"] or [name for name in file.channels_db if name.split(" [")[0] in QUANTITIES]
        signals, groups = {}, {}
        for name in dict.fromkeys(names):
            parts = ELEMENT.fullmatch(name)
            base, which = (parts[1], int(parts[2])) if parts and name not in file.channels_db else (name, None)
            if base in masters or base not in file.channels_db:
                continue
            group, index = place_of(base, which, file.channels_db[base], only, titles)
            columns.expect(name, file.groups[group].channel_group.cycles_nr)
            signals[name] = file.get(base, group=group, index=index, ignore_invalidation_bits=True)
            groups[name] = f"group {group} {titles[group]!r}" if titles[group] else f"group {group}"
    signals = {name: signal for name, signal in signals.items() if signal.samples.dtype.kind in "fiu"}
    if not signals:
        return columns
    first = next(iter(signals))
    time = signals[first].timestamps
    for name, signal in signals.items():
        if not np.array_equal(signal.timestamps, time):
            raise UnreadableError(
                f"channel {name!r} is not sampled at the times of channel {first!r}; nothing is resampled here "
                f"(they are in {groups[name]} and {groups[first]}; where one group holds all, set group)"
            )
        if signal.samples.ndim != 1:
            columns.refused[name] = f"an array of {signal.samples.ndim} dimensions"
            continue
        columns.values[name] = signal.samples
        if signal.invalidation_bits is not None and np.any(signal.invalidation_bits):
            columns.empty[name] = np.asarray(signal.invalidation_bits, dtype=bool)
            columns.nothing = "the sample is marked as invalid in the file; start_s and end_s cut a record"
        if signal.unit:
            columns.units[name] = str(signal.unit)[:60]
    for name in masters | {"time"}:
        columns.values[name] = time
        columns.units[name] = "s"
    return columns


def chosen_group(wanted: Any, titles: list[str]) -> int | None:
    """The number of the channel group that dataset.toml names; None where it names none. Raises UnreadableError."""
    if wanted is None:
        return None
    found = [i for i, title in enumerate(titles) if wanted in (i, title)]
    if len(found) != 1:
        why = "several channel groups of this name" if found else "no such channel group"
        raise UnreadableError(f"group = {wanted!r}: {why} among {listed_groups(range(len(titles)), titles)}")
    return found[0]


def place_of(
    name: str, which: int | None, places: Sequence[tuple[int, int]], only: int | None, titles: list[str]
) -> tuple[int, int]:
    """Group and index of a channel, or of the one numbered `which` in its group; raises UnreadableError."""
    own = [place for place in places if only in (None, place[0])]
    groups = sorted({group for group, _ in own or places})
    if not own:
        raise UnreadableError(f"channel {name!r} is not in group {only} but in {listed_groups(groups, titles)}")
    if len(groups) > 1:
        raise UnreadableError(
            f"channel {name!r} is in the groups {listed_groups(groups, titles)}: set group, name or number"
        )
    if (which is None and len(own) > 1) or (which is not None and which >= len(own)):
        raise UnreadableError(
            f"channel {name!r} is there {len(own)} times in group {listed_groups(groups, titles)}: "
            f"name one of them in `columns`, {name}[0] to {name}[{len(own) - 1}]"
        )
    return own[which or 0]


def listed_groups(groups: Sequence[int], titles: list[str]) -> str:
    """Channel groups by number and name."""
    named = [f"{i} {titles[i]!r}" if titles[i] else str(i) for i in groups[:MOST_LISTED]]
    return ", ".join(named) + (f" and {len(groups) - MOST_LISTED} more" if len(groups) > MOST_LISTED else "")


def workbook(path: str, request: Request) -> dict[str, Any]:
    """The rows of a sheet of a workbook, numbers, texts and None; where first rows are asked for, these of all sheets."""
    from python_calamine import CalamineWorkbook

    with CalamineWorkbook.from_path(path) as book:
        names = book.sheet_names
        sheet = request["sheet"] or names[0]
        if sheet not in names:
            raise UnreadableError(f"no sheet {sheet!r} among {', '.join(names)[:300]}")
        most, rows = request["first_rows"], {}
        for name in names if most else [sheet]:
            found = book.get_sheet_by_name(name)
            if found.total_height * found.total_width > MOST_CELLS:
                raise UnreadableError(f"sheet {name!r} has more than {MOST_CELLS} cells")
            cells = found.to_python(skip_empty_area=False, nrows=most)
            rows[name] = [[plain_cell(cell) for cell in row] for row in cells]
    return {"sheets": names, "sheet": sheet, "rows": rows}


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
    if collect_split(content, columns):
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


def collect_split(content: dict[str, Any], columns: Columns) -> bool:
    """Put a table of `columns` and `data` by rows, orient "split" of pandas, into `columns`; whether it is one."""
    names, rows = content.get("columns"), content.get("data")
    if not (isinstance(names, list) and isinstance(rows, list) and all(isinstance(row, list) for row in rows)):
        return False
    if any(len(row) != len(names) for row in rows):
        raise UnreadableError(f"`data` has rows of other lengths than `columns`, {len(names)}")
    for i, name in enumerate(names):
        columns.put(str(name), [row[i] for row in rows])
    return True


READERS: dict[str, Callable[[str, Request], Columns | dict[str, Any]]] = {
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
        if isinstance(columns, dict):
            return columns
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
        "names": list(columns.values), "units": columns.units, "refused": columns.refused,
        "nothing": columns.nothing,
    }  # fmt: skip


def limit(seconds: int) -> None:
    """Limit the address space and the processor time, where the system can."""
    try:
        import resource
    except ImportError:  # Windows
        return
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    most = MEMORY if hard == resource.RLIM_INFINITY else min(MEMORY, hard)
    resource.setrlimit(resource.RLIMIT_AS, (most, hard))
    _, hard = resource.getrlimit(resource.RLIMIT_CPU)
    resource.setrlimit(resource.RLIMIT_CPU, (seconds if hard == resource.RLIM_INFINITY else min(seconds, hard), hard))
    resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))


def end_with_parent() -> None:
    """End this process when the other end of standard input closes."""
    sys.stdin.read()  # nothing is ever written to it
    os._exit(1)


def main() -> None:
    """Answer the requests in their order."""
    limit(int(sys.argv[2]))
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
