"""The file formats: each reader gives its columns by name, unconverted and unjudged.

A table of two dimensions gives one column for each index of its shorter side, `x_F[0]`, `x_F[1]`, ...; a field of a struct
or a group is `struct.field`.
"""

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import numpy as np

from twintube.data.findings import UnreadableError

TEXT = {".csv": ",", ".txt": "whitespace", ".dat": "whitespace", ".tsv": "\t"}  # the delimiter where none is given
MOST_COLUMNS = 64  # a wider table is no recording of channels
QUANTITIES = ("time", "stroke", "force", "velocity", "temperature")
HDF5 = b"\x89HDF"


@dataclass(frozen=True)
class Format:
    """How to read a file: the keys `columns`, `delimiter`, `decimal`, `encoding` and `skip_rows` of dataset.toml."""

    columns: list[str] | dict[str, str] | None = None  # headers of a file without; or header -> name in the file
    delimiter: str | None = None
    decimal: str = "."
    encoding: str = "utf-8-sig"
    skip_rows: int = 0


@dataclass
class Raw:
    """Columns as they stand in the file."""

    columns: dict[str, Any]  # sequences of one length
    rows: Sequence[int]  # number of each sample in the file
    counted: Literal["row", "sample"] = "sample"
    units: dict[str, str] = field(default_factory=dict)  # where the format carries them besides the names


def read_raw(path: Path, form: Format) -> Raw:
    """The columns of a file; raises UnreadableError and OSError."""
    ending = path.suffix.lower()
    if ending in TEXT:
        return read_text(path, form, form.delimiter or TEXT[ending])
    readers = {".parquet": read_parquet, ".pq": read_parquet, ".mat": read_mat, ".mf4": read_mdf, ".mdf": read_mdf}
    if ending not in readers:
        raise UnreadableError(f"unknown format {ending!r}, must be one of {', '.join([*TEXT, *readers])}")
    if isinstance(form.columns, list):
        raise UnreadableError(
            "columns: a list is for text files without header, here it must be a table: header = name in the file"
        )
    with path.open("rb"):
        pass  # a missing or forbidden file says so itself, the libraries' messages vary
    try:
        return readers[ending](path, form)
    except (UnreadableError, MemoryError):
        raise
    except ModuleNotFoundError as error:
        what = "'twintube[mdf]'" if error.name == "asammdf" else error.name
        raise UnreadableError(f"{path.suffix} files need the package {error.name}: pip install {what}") from error
    except Exception as error:  # the libraries raise nearly everything on a damaged file
        raise UnreadableError(f"no readable {path.suffix} file ({type(error).__name__}: {error})") from error


def read_text(path: Path, form: Format, delimiter: str) -> Raw:
    """CSV and other text; the header is the first row after `skip_rows` unless `columns` is a list."""
    try:
        text = path.read_bytes().decode(form.encoding)
    except UnicodeDecodeError as error:
        row = error.object[: error.start].count(b"\n") + 1
        raise UnreadableError(f"no {form.encoding} text ({error.reason}); set `encoding`", row) from error
    try:
        lines, skipped = io.StringIO(text, newline=""), form.skip_rows
        for _ in range(skipped):
            lines.readline()
        if delimiter == "whitespace":
            table = [(number, line.split()) for number, line in enumerate(lines, start=skipped + 1)]
        else:
            reader = csv.reader(lines, delimiter=delimiter, skipinitialspace=True)
            table = [(reader.line_num + skipped, cells) for cells in reader]
    except csv.Error as error:
        raise UnreadableError(f"no readable text table ({error})") from error
    while table and not any(cell.strip() for cell in table[-1][1]):
        table.pop()  # empty lines at the end
    if not table:
        raise UnreadableError("the file is empty")
    if isinstance(form.columns, list):
        headers, first = form.columns, 0
    else:
        headers, first = [cell.strip() for cell in table[0][1]], 1
    twice = [header for header in headers if header and headers.count(header) > 1]
    if twice:
        raise UnreadableError(f"two columns are named {twice[0]!r}", table[0][0])
    width = len(headers)
    rows, body = [number for number, _ in table[first:]], [cells for _, cells in table[first:]]
    for number, cells in table[first:]:
        if len(cells) > width and any(cell.strip() for cell in cells[width:]):
            raise UnreadableError(f"{len(cells)} cells where {width} columns are named", number)
    if any(len(cells) != width for cells in body):
        body = [(cells + [""] * width)[:width] for cells in body]  # the missing cells are found as empty ones
    columns = {header: [cells[i] for cells in body] for i, header in enumerate(headers) if header}
    if form.decimal == ",":
        columns = {header: [cell.replace(",", ".") for cell in cells] for header, cells in columns.items()}
    return Raw(columns, rows, "row")


def listed(columns: dict[str, Any]) -> Raw:
    """Columns of a format without rows of its own."""
    longest = max((len(values) for values in columns.values()), default=0)
    return Raw(columns, range(longest))


def read_parquet(path: Path, _: Format) -> Raw:
    """Parquet, by its column names."""
    import pyarrow.parquet

    table = pyarrow.parquet.read_table(path)
    return listed({name: table.column(name).to_pylist() for name in table.column_names})


def read_mat(path: Path, _: Format) -> Raw:
    """MATLAB v5 to v7.3."""
    found: dict[str, Any] = {}
    with path.open("rb") as file:
        start = file.read(516)
    if start.startswith(HDF5) or start[512:] == HDF5:
        import h5py

        with h5py.File(path) as hdf:
            hdf.visititems(lambda name, item: flatten(name.replace("/", "."), item, found))
    else:
        from scipy.io import loadmat

        for name, item in loadmat(path, struct_as_record=False).items():
            if not name.startswith("__"):
                flatten(name, item, found)
    return listed(found)


def flatten(name: str, item: Any, found: dict[str, Any]) -> None:
    """Put the columns of a MATLAB variable or HDF5 dataset into `found`."""
    if name.startswith("#refs#") or not hasattr(item, "dtype"):
        return
    if item.dtype == object and item.size == 1 and hasattr(np.asarray(item).flat[0], "_fieldnames"):
        struct = np.asarray(item).flat[0]
        for key in struct._fieldnames:
            flatten(f"{name}.{key}", getattr(struct, key), found)
        return
    values = np.asarray(item)
    if values.dtype.kind not in "fiu" or values.ndim not in {1, 2} or min(values.shape) == 0:
        return
    if values.ndim == 1 or min(values.shape) == 1:
        found[name] = values.ravel()
    elif min(values.shape) <= MOST_COLUMNS:
        table = values if values.shape[0] >= values.shape[1] else values.T
        for i in range(table.shape[1]):
            found[f"{name}[{i}]"] = table[:, i]


def read_mdf(path: Path, form: Format) -> Raw:
    """ASAM MDF: the channels named in `columns`, else those named as quantities; time is their master channel."""
    from asammdf import MDF

    with MDF(path) as mdf:
        masters = {mdf.groups[group].channels[i].name for group, i in mdf.masters_db.items()}
        wanted = (
            list(form.columns.values())
            if isinstance(form.columns, dict)
            else [name for name in mdf.channels_db if name.split(" [")[0] in QUANTITIES]
        )
        signals = {name: mdf.get(name) for name in dict.fromkeys(wanted) if name in mdf.channels_db and name not in masters}
    signals = {name: signal for name, signal in signals.items() if signal.samples.dtype.kind in "fiu"}
    if not signals:
        return listed({})
    first = next(iter(signals))
    time = signals[first].timestamps
    for name, signal in signals.items():
        if not np.array_equal(signal.timestamps, time):
            raise UnreadableError(
                f"channel {name!r} is not sampled at the times of channel {first!r}; nothing is resampled here"
            )
    raw = listed({name: signal.samples for name, signal in signals.items()})
    raw.units = {name: signal.unit for name, signal in signals.items() if signal.unit}
    for name in masters | {"time"}:
        raw.columns[name] = time
        raw.units[name] = "s"
    return raw
