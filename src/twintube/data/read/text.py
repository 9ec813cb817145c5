"""Text records, CSV and the like: columns by name, unconverted and unjudged."""

import codecs
import csv
import io
import re
from bisect import bisect_left
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import islice, pairwise
from operator import itemgetter
from pathlib import Path
from typing import Any

import numpy as np

from twintube.common.words import listed, shown
from twintube.data.convert.units import NUMBER, units_row
from twintube.data.findings import UnreadableError
from twintube.data.formats import DEFAULT_ENCODING, MOST_COLUMNS, TEXT, Format, Raw
from twintube.data.read.blocks import Row, Rows, chosen, is_numbers, ruled
from twintube.data.read.lvm import MAGIC, Layout, Segment, completed, layout_of, names_of, segment, segments_of
from twintube.data.read.own_header import texts_over

LOOK = 400  # rows in which the table must begin
DELIMITERS = {";": "';'", "\t": "'\\t'", ",": "','"}
BLANKS = re.compile(r"[ \t\r\n\f\v]+")
UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)  # how a text in UTF-16 begins


@dataclass(frozen=True)
class Cut:
    """A text cut into cells."""

    rows: Rows
    delimiter: str
    layout: Layout | None = None  # of a file that LabVIEW wrote
    segments: list[Segment] = field(default_factory=list)  # of such a file
    over: dict[str, list[str]] = field(default_factory=dict)  # what skipped rows say over the columns of a list


class TextReader:
    """Reads text files; one whose blocks are read one after the other is cut into cells once."""

    def __init__(self) -> None:
        self.last: tuple[tuple[Any, ...], Cut] | None = None

    def read(self, path: Path, form: Format) -> Raw:
        """CSV and other text; the header is the first row after `skip_rows` unless `columns` is a list or `block` is given.

        Raises UnreadableError with the row, and OSError.
        """
        width = len(form.columns) if isinstance(form.columns, list) else None
        key = path, form.delimiter, form.decimal, form.encoding, form.skip_rows, width
        cut = self.last[1] if self.last is not None and self.last[0] == key else cut_text(path, form)
        self.last = None if form.block is None else (key, cut)
        if cut.layout is not None:
            raw = read_lvm(segment(cut.segments, form.block), cut.layout, form)
        else:
            raw = columns_of(chosen(cut.rows, form.block), form, cut.delimiter)
            raw = replace(raw, over=cut.over | raw.over)
        blank = cut.rows.blank
        if not blank or not len(raw.rows):
            return raw
        first, last = (bisect_left(blank, raw.rows[i], key=itemgetter(0)) for i in (0, -1))
        between = blank[first:last]
        return replace(raw, blank=[number for number, _ in between], spaced=any(len(cells) > 1 for _, cells in between))


def is_lvm(path: Path) -> bool:
    """Whether LabVIEW wrote the file."""
    with path.open("rb") as file:
        return file.read(len(MAGIC) + 3).removeprefix(codecs.BOM_UTF8).startswith(MAGIC.encode("ascii"))


def cut_text(path: Path, form: Format) -> Cut:
    """The rows of a file; raises UnreadableError and OSError."""
    text = decoded(path, form.encoding)
    if text.startswith(MAGIC) and not form.skip_rows:
        layout = layout_of(islice(io.StringIO(text, newline=""), LOOK))
        rows = ruled(split_text(text, layout.delimiter, 0))
        return Cut(rows, layout.delimiter, layout, segments_of(rows.table))
    delimiter = form.delimiter or TEXT[path.suffix.lower()]
    if form.delimiter is None and delimiter == "whitespace" and tabbed(text, form):
        delimiter = "\t"
    if delimiter == form.decimal:
        raise UnreadableError(
            f"delimiter and decimal are both {delimiter!r}: set `delimiter`, often ';' where decimal is ','"
        )
    over = texts_over(text, delimiter, form.skip_rows, form.columns) if isinstance(form.columns, list) else {}
    return Cut(ruled(split_text(text, delimiter, form.skip_rows)), delimiter, over=over)


def columns_of(table: Sequence[Row], form: Format, delimiter: str) -> Raw:
    """The columns of one table; raises UnreadableError."""
    first, names = table[0]
    if isinstance(form.columns, list):
        headers = form.columns
        named = form.block is not None and not is_numbers(names)
    else:
        headers, named = [cell.strip() for cell in names], True
        check_header(table[0], delimiter)
    body = table[1:] if named else table
    if len(headers) > MOST_COLUMNS:
        raise UnreadableError(f"{len(headers)} columns, at most {MOST_COLUMNS} are read", first)
    for header, count in Counter(headers).items():
        if header and count > 1:
            raise UnreadableError(f"two columns are named {shown(header)}", first)
    units = units_row(body[0][1]) if body and named else None
    if units is not None:
        body = body[1:]
    width = len(headers)
    rows = [cells for _, cells in body]
    widths = set(map(len, rows)) or {width}
    if widths != {width}:
        for number, cells in body:
            if len(cells) > width and any(cell.strip() for cell in cells[width:]):
                raise UnreadableError(wrong_width(len(cells), width, names, delimiter), number)
        # Missing cells are reported as empty ones.
        rows = [cells if len(cells) == width else (cells + [""] * width)[:width] for cells in rows]
    columns: dict[str, Any] = {header: [cells[i] for cells in rows] for i, header in enumerate(headers) if header}
    numbers = np.array([number for number, _ in body], dtype=np.int64)
    if headers is form.columns:
        # The block's own names and units, which the list replaces.
        rows_over = [names, [f"[{unit}]" if unit else "" for unit in units or []]] if named else []
        over = {
            header: said
            for i, header in enumerate(headers)
            if header and (said := [row[i].strip() for row in rows_over if i < len(row) and row[i].strip()])
        }
        return Raw(columns, numbers, "row", over=over)
    carried = {header: unit for header, unit in zip(headers, units or [], strict=False) if header and unit}
    without = [header for header in headers[max(widths) :] if header]
    return Raw(columns, numbers, "row", carried, without=without)


def read_lvm(found: Segment, layout: Layout, form: Format) -> Raw:
    """A segment of a file that LabVIEW wrote; raises UnreadableError."""
    named = [(found.table[0][0], names_of(found, layout)), *found.table[1:]]
    return completed(columns_of(named, replace(form, block=form.block or 1), layout.delimiter), found, layout)


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
    """Whether tabs part the cells, which may hold spaces: as many in a row of numbers as in `columns`, or in the row above.

    One more there is a name without cells.
    """
    lines = islice(io.StringIO(text, newline=""), form.skip_rows, form.skip_rows + LOOK)
    rows = [line.rstrip().split("\t") for line in lines if line.strip()]
    if isinstance(form.columns, list):
        return any(len(row) == len(form.columns) > 1 and is_numbers(row) for row in rows)
    return any(
        1 < len(row) <= len(above) <= len(row) + 1 and is_numbers(row) and not is_numbers(above)
        for above, row in pairwise(rows)
    )


def split_white(line: str) -> list[str]:
    """The cells between spaces and tabs; no-break and thin spaces part thousands."""
    return line.split() if line.isascii() else [cell for cell in BLANKS.split(line) if cell]


def split_text(text: str, delimiter: str, skipped: int) -> list[tuple[int, list[str]]]:
    """Rows with their number in the file, without `skipped` at the top and empty ones at the end; raises UnreadableError."""
    lines = io.StringIO(text, newline="")
    for _ in range(skipped):
        if not lines.readline():
            raise UnreadableError(f"skip_rows = {skipped}: the file has fewer rows")
    try:
        if delimiter == "whitespace":
            table = [(number, split_white(line)) for number, line in enumerate(lines, start=skipped + 1)]
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
