"""Text records, CSV and the like: columns by name, unconverted and unjudged."""

import codecs
import csv
import io
from dataclasses import dataclass, field, replace
from itertools import islice, pairwise
from pathlib import Path
from typing import Any

from twintube.data.findings import UnreadableError
from twintube.data.formats import DEFAULT_ENCODING, Format, Raw, usual_delimiter
from twintube.data.read.blocks import Rows, chosen, is_numbers, ruled
from twintube.data.read.lvm import MAGIC, Layout, Segment, completed, layout_of, names_of, segment, segments_of
from twintube.data.read.tables import NEAREST, columns_of, single_names, split, texts_over, with_blank

LOOK = 400  # rows in which the table must begin
MOST_LOOKED = 1000  # bytes that tell an encoding
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
        key = path, replace(form, block=None)
        cut = self.last[1] if self.last is not None and self.last[0] == key else cut_text(path, form)
        self.last = None if form.block is None else (key, cut)
        if cut.layout is not None:
            raw = read_lvm(segment(cut.segments, form.block), cut.layout, form)
        else:
            raw = columns_of(chosen(cut.rows, form.block), form, cut.delimiter)
            raw = replace(raw, over=cut.over | raw.over)
        return with_blank(raw, cut.rows)


def is_lvm(path: Path) -> bool:
    """Whether LabVIEW wrote the file."""
    with path.open("rb") as file:
        return file.read(len(MAGIC) + 3).removeprefix(codecs.BOM_UTF8).startswith(MAGIC.encode("ascii"))


def cut_text(path: Path, form: Format) -> Cut:
    """The rows of a file; raises UnreadableError and OSError."""
    text = decoded(path, form.encoding)
    if text.startswith(MAGIC) and not form.skip_rows:
        layout = layout_of(islice(io.StringIO(text, newline=""), LOOK))
        rows = ruled(split_text(text, layout.delimiter, 0), form)
        return Cut(rows, layout.delimiter, layout, segments_of(rows.table))
    delimiter = form.delimiter or usual_delimiter(path)
    if form.delimiter is None and delimiter == "whitespace" and tabbed(text, form):
        delimiter = "\t"
    if delimiter == form.decimal and '"' not in text:
        raise UnreadableError(
            f"delimiter and decimal are both {delimiter!r}: set `delimiter`, often ';' where decimal is ','"
        )
    over = {}
    if isinstance(form.columns, list):
        width = len(form.columns)
        skipped = list(islice(io.StringIO(text), form.skip_rows))[-NEAREST:]
        cells = [split(line.rstrip("\r\n"), delimiter) for line in skipped]
        over = texts_over([single_names(row, width) for row in cells] if delimiter == "whitespace" else cells, form.columns)
    return Cut(ruled(split_text(text, delimiter, form.skip_rows), form), delimiter, over=over)


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
        text = data.decode(encoding).removeprefix("\ufeff")
    except UnicodeDecodeError as error:
        row = error.object[: error.start].count(b"\n") + 1
        raise UnreadableError(f"not a text in {encoding} ({error.reason}); set `encoding`", row) from error
    except UnicodeError as error:
        raise UnreadableError(f"not a text in {encoding} ({error}); set `encoding`") from error
    if (other := utf_16(data)) and encoding != other:
        raise UnreadableError(f"every second byte is 0, as in a text in UTF-16: set encoding = '{other}'")
    return text


def utf_16(data: bytes) -> str:
    """The encoding of a text in UTF-16 without byte order mark, told by the zeros beside its digits; else empty."""
    start = data[:MOST_LOOKED]
    halves = {"utf-16-be": start[::2], "utf-16-le": start[1::2]}
    other = {"utf-16-be": start[1::2], "utf-16-le": start[::2]}
    return next((name for name, half in halves.items() if half and not any(half) and 0 not in other[name]), "")


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


def split_text(text: str, delimiter: str, skipped: int) -> list[tuple[int, list[str]]]:
    """Rows with their number in the file, without `skipped` at the top and empty ones at the end; raises UnreadableError."""
    lines = io.StringIO(text, newline="")
    for _ in range(skipped):
        if not lines.readline():
            raise UnreadableError(f"skip_rows = {skipped}: the file has fewer rows")
    try:
        if delimiter == "whitespace":
            table = [(number, split(line, delimiter)) for number, line in enumerate(lines, start=skipped + 1)]
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
