"""Text records, CSV and the like: columns by name, unconverted and unjudged; and how every format is to be read."""

import codecs
import csv
import io
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path
from typing import Any, Literal

from twintube.data.findings import UnreadableError
from twintube.data.skipped import texts_over
from twintube.data.units import NUMBER, units_row
from twintube.words import listed, shown

TEXT = {".csv": ",", ".txt": "whitespace", ".dat": "whitespace", ".tsv": "\t"}  # the delimiter where none is given
TEXT_BYTES = 256_000_000
BINARY_BYTES = 4_000_000_000
MOST_COLUMNS = 256  # a wider table is not a recording of channels
MOST_SKIPPED = 100_000  # rows before the header
MOST_BLANK = 20  # rows in which the first two that hold something are looked for
DELIMITERS = {";": "';'", "\t": "'\\t'", ",": "','"}
# Others take quadratic time, or are encodings of something else than a file.
ENCODINGS = re.compile(
    r"utf-(8|8-sig|16|32)(-le|-be)?|ascii|cp\d+|iso8859-\d+|mac-\w+|koi8-\w|big5|gbk?\d*|shift_jis|euc_\w+"
)
DEFAULT_ENCODING = "utf-8-sig"
UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)  # how a text in UTF-16 begins


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
    sample_rate: float | None = None  # [Hz] instead of a column of times
    channels: Mapping[str, Channel] = field(default_factory=dict)  # by quantity


@dataclass
class Raw:
    """Columns as they stand in the file."""

    columns: dict[str, Any]  # sequences of one length
    rows: Sequence[int]  # number of each sample in the file
    counted: Literal["row", "sample"] = "sample"
    units: dict[str, str] = field(default_factory=dict)  # where the format carries them besides the names
    refused: dict[str, str] = field(default_factory=dict)  # columns that do not hold numbers, and what they hold
    over: dict[str, list[str]] = field(default_factory=dict)  # what skipped rows say over columns of a list


def known_encoding(name: str) -> bool:
    """Whether it is an encoding of text files."""
    try:
        return re.fullmatch(r"[\w .-]{1,40}", name, re.ASCII) is not None and bool(
            ENCODINGS.fullmatch(codecs.lookup(name).name)
        )
    except LookupError:
        return False


def read_text(path: Path, form: Format) -> Raw:
    """CSV and other text; the header is the first row after `skip_rows` unless `columns` is a list.

    Raises UnreadableError with the row, and OSError.
    """
    text = decoded(path, form.encoding)
    delimiter = form.delimiter or TEXT[path.suffix.lower()]
    if form.delimiter is None and delimiter == "whitespace" and tabbed(text, form):
        delimiter = "\t"
    if delimiter == form.decimal:
        raise UnreadableError(
            f"delimiter and decimal are both {delimiter!r}: set `delimiter`, often ';' where decimal is ','"
        )
    table = split_text(text, delimiter, form.skip_rows)
    if isinstance(form.columns, list):
        headers, body = form.columns, table
    else:
        headers, body = [cell.strip() for cell in table[0][1]], table[1:]
        check_header(table[0], delimiter)
    if len(headers) > MOST_COLUMNS:
        raise UnreadableError(f"{len(headers)} columns, at most {MOST_COLUMNS} are read", table[0][0])
    for header, count in Counter(headers).items():
        if header and count > 1:
            raise UnreadableError(f"two columns are named {shown(header)}", table[0][0])
    units = units_row(body[0][1]) if body and headers is not form.columns else None
    if units is not None:
        body = body[1:]
    width = len(headers)
    for number, cells in body:
        if len(cells) > width and any(cell.strip() for cell in cells[width:]):
            raise UnreadableError(wrong_width(len(cells), width, table[0][1], delimiter), number)
    # Missing cells are reported as empty ones.
    rows = [cells if len(cells) == width else (cells + [""] * width)[:width] for _, cells in body]
    columns: dict[str, Any] = {header: [cells[i] for cells in rows] for i, header in enumerate(headers) if header}
    carried = {header: unit for header, unit in zip(headers, units or [], strict=False) if header and unit}
    over = texts_over(text, delimiter, form.skip_rows, headers) if isinstance(form.columns, list) else {}
    return Raw(columns, [number for number, _ in body], "row", carried, over=over)


def decoded(path: Path, encoding: str) -> str:
    """The file's text without a byte order mark, which is followed where it says UTF-16; raises UnreadableError."""
    data = path.read_bytes()
    if encoding == DEFAULT_ENCODING and data.startswith(UTF_16):
        encoding = "utf-16"
    try:
        return data.decode(encoding).removeprefix("\ufeff")
    except UnicodeDecodeError as error:
        row = error.object[: error.start].count(b"\n") + 1
        raise UnreadableError(f"not a text in {encoding} ({error.reason}); set `encoding`", row) from error
    except UnicodeError as error:
        raise UnreadableError(f"not a text in {encoding} ({error}); set `encoding`") from error


def tabbed(text: str, form: Format) -> bool:
    """Whether tabs part the cells, which may hold spaces: as many in the header, or in `columns`, as in the row after it."""
    lines = (line for line in islice(io.StringIO(text), form.skip_rows, form.skip_rows + MOST_BLANK) if line.strip())
    first, second = ([line.rstrip("\r\n").split("\t") for line in islice(lines, 2)] + [[], []])[:2]
    headers = form.columns if isinstance(form.columns, list) else first
    return len(first) > 1 and len(first) == len(headers) == len(second)


def split_text(text: str, delimiter: str, skipped: int) -> list[tuple[int, list[str]]]:
    """Rows with their number in the file, without `skipped` at the top and empty ones at the end; raises UnreadableError."""
    lines = io.StringIO(text, newline="")
    for _ in range(skipped):
        if not lines.readline():
            raise UnreadableError(f"skip_rows = {skipped}: the file has fewer rows")
    try:
        if delimiter == "whitespace":
            table = [(number, line.split()) for number, line in enumerate(lines, start=skipped + 1)]
        else:
            reader = csv.reader(lines, delimiter=delimiter, skipinitialspace=True)
            table = [(reader.line_num + skipped, cells) for cells in reader]
    except csv.Error as error:
        raise UnreadableError(f"not a readable text table ({error})") from error
    while table and not any(cell.strip() for cell in table[-1][1]):
        table.pop()
    if not table:
        raise UnreadableError("the file is empty")
    return table


def check_header(row: tuple[int, list[str]], delimiter: str) -> None:
    """Raise UnreadableError where the header holds numbers, or all names in a single cell."""
    number, cells = row
    if all(NUMBER.fullmatch(cell) for cell in cells):
        text = listed(cells, 4)
        raise UnreadableError(f"numbers ({text}) where the header must be: set `columns`, the headers as a list", number)
    if len(cells) == 1 and (other := other_delimiter(cells[0], delimiter)):
        raise UnreadableError(f"a header of one column {shown(cells[0])}: {other}", number)


def wrong_width(cells: int, width: int, header: list[str], delimiter: str) -> str:
    """The message about a row with more cells than there are columns."""
    named = "1 column is" if width == 1 else f"{width} columns are"
    other = other_delimiter(delimiter.join(header), delimiter)
    hint = other if other else "is ',' both the delimiter and the decimal sign?" if delimiter == "," else ""
    return f"{cells} cells where {named} named{'; ' + hint if hint else ''}"


def other_delimiter(line: str, delimiter: str) -> str:
    """What to set where the line is rather split by another delimiter; empty where nothing says so."""
    counts = {sign: line.count(sign) for sign in DELIMITERS if sign != delimiter}
    sign = max(counts, key=lambda sign: counts[sign])
    if not counts[sign]:
        return ""
    decimal = " and, where numbers are written 1,5, decimal = ','" if sign != "," else ""
    return f"set delimiter = {DELIMITERS[sign]}{decimal}"
