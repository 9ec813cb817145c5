"""Files of all formats: one table says what reads a file with some ending, and what dataset.toml may ask of it.

The readers of binary files run in a process of their own (`python -m twintube.readers`): a damaged file can crash their
libraries. Texts are read by `data.read`.
"""

import codecs
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

HDF5 = b"\x89HDF"
LOOK = 1000  # bytes that tell a text from a workbook


@dataclass(frozen=True)
class Kind:
    """What reads a file."""

    reader: str  # text, or one of `__main__`
    package: str = ""  # that it needs
    delimiter: str = ""  # of a text, where dataset.toml says none
    cells: bool = False  # a table of cells: `block`, `columns` as a list and new-dataset's guesses are for these
    most: int = 4_000_000_000  # bytes


def text(delimiter: str) -> Kind:
    """A text."""
    return Kind("text", "", delimiter, cells=True, most=256_000_000)


BOOK, PARQUET, MDF = Kind("workbook", "python_calamine", cells=True), Kind("parquet", "pyarrow"), Kind("mdf", "asammdf")
KINDS: Final[Mapping[str, Kind]] = {
    ".csv": text(","), ".txt": text("whitespace"), ".dat": text("whitespace"), ".asc": text("whitespace"),
    ".prn": text("whitespace"), ".out": text("whitespace"), ".tsv": text("\t"), ".tab": text("\t"), ".lvm": text("\t"),
    ".parquet": PARQUET, ".pq": PARQUET, ".mat": Kind("matlab", "scipy"), ".mf4": MDF, ".mdf": MDF,
    ".xlsx": BOOK, ".xlsm": BOOK, ".xls": BOOK, ".json": Kind("json"),
}  # fmt: skip
TEXT_XLS = text("\t")  # many machines name a text .xls, for Excel to open it


def kind_of(path: Path) -> Kind | None:
    """What reads the file, by its ending and, where that is not enough, its first bytes; None for another ending."""
    kind = KINDS.get(path.suffix.lower())
    if kind is BOOK and is_text_xls(path):
        return TEXT_XLS
    return kind


def is_text_xls(path: Path) -> bool:
    """Whether a file named .xls is a table of text, and neither a workbook nor a web page."""
    if path.suffix.lower() != ".xls" or not path.is_file():
        return False
    with path.open("rb") as file:
        start = file.read(LOOK).removeprefix(codecs.BOM_UTF8)
    return start.isascii() and start[:1].isalnum() and b"\0" not in start and not start.startswith(b"PK\x03")


def is_hdf5(path: Path) -> bool:
    """Whether a file is HDF5, at its start or behind MATLAB's header of 512 bytes."""
    with path.open("rb") as file:
        start = file.read(516)
    return start.startswith(HDF5) or start[512:] == HDF5
