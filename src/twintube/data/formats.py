"""How every format is to be read, and the columns that reading gives: by name, unconverted and unjudged."""

import codecs
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from twintube.readers import KINDS, TEXT_XLS

TEXT = {ending: kind.delimiter for ending, kind in KINDS.items() if kind.reader == "text"}
TEXT_BYTES, BINARY_BYTES = KINDS[".csv"].most, KINDS[".parquet"].most
MOST_COLUMNS = 256  # a wider table is not a recording of channels
MOST_SKIPPED = 100_000  # rows before the header
# Others take quadratic time, or are encodings of something else than a file.
ENCODINGS = re.compile(
    r"utf-(8|8-sig|16|32)(-le|-be)?|ascii|cp\d+|iso8859-\d+|mac-\w+|koi8-\w|big5|gbk?\d*|shift_jis|euc_\w+"
)
DEFAULT_ENCODING = "utf-8-sig"
EMPTY = "the cell is empty"


@dataclass(frozen=True)
class Channel:
    """How a column becomes a quantity: `gain` times what is in the file, plus `zero`; `channels` of dataset.toml."""

    column: str | None = None  # in the file; None: that of the quantity's own name, or the one in `columns`
    gain: float | None = None  # in the quantity's SI unit per `unit`; None: the column is in a unit of the quantity
    unit: str = ""  # V in `500 N/V`; "" for a plain number
    zero: float = 0.0  # [SI unit of the quantity, degC], added


@dataclass(frozen=True)
class Format:
    """How to read a file, as dataset.toml says it; the same names there but for `sample_rate_Hz`."""

    columns: list[str] | dict[str, str] | None = None  # headers of a file without; or header -> name in the file
    delimiter: str | None = None
    decimal: str = "."
    encoding: str = DEFAULT_ENCODING
    skip_rows: int = 0
    sheet: str | None = None  # of a workbook; None: the first
    block: int | None = None  # of a text or sheet with several tables, from 1; None: there is one
    group: str | int | None = None  # of an MDF file: its name, or its number from 0; None: the channels are in one
    sample_rate: float | None = None  # [Hz] instead of a column of times
    channels: Mapping[str, Channel] = field(default_factory=dict)  # by quantity


@dataclass
class Raw:
    """Columns as they stand in the file."""

    columns: dict[str, Any]  # sequences of one length
    rows: Sequence[int] | NDArray[np.int64]  # number of each sample in the file
    counted: Literal["row", "sample"] = "sample"
    units: dict[str, str] = field(default_factory=dict)  # where the format carries them besides the names
    refused: dict[str, str] = field(default_factory=dict)  # columns that do not hold numbers, and what they hold
    decimal: str = ""  # where the format states its decimal sign
    meant: dict[str, str] = field(default_factory=dict)  # column -> quantity [unit], where the format tells it
    without: Sequence[str] = ()  # the last names, where no row has cells under them
    empty: Sequence[str] = ()  # other names with nothing but empty cells under them
    sheets: Sequence[str] = ()  # of a workbook, where nobody chose the one that is read, the first
    blank: Sequence[int] = ()  # rows that were skipped because they hold nothing
    spaced: bool = False  # whether some of the blank rows hold separators, and so may be samples that were lost
    nothing: str = EMPTY  # what a cell without a value means
    over: dict[str, list[str]] = field(default_factory=dict)  # what skipped rows say over columns of a list


def usual_delimiter(path: Path) -> str:
    """The delimiter of a text file where none is given; a text named .xls is parted by tabs."""
    return TEXT.get(path.suffix.lower(), TEXT_XLS.delimiter)


def known_encoding(name: str) -> bool:
    """Whether it is an encoding of text files."""
    try:
        return re.fullmatch(r"[\w .-]{1,40}", name, re.ASCII) is not None and bool(
            ENCODINGS.fullmatch(codecs.lookup(name).name)
        )
    except LookupError:
        return False
