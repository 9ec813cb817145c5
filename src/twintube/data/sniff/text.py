"""A first guess of how a text file is to be read: delimiter, decimal sign, header, names and units of its columns.

A guess is judged by the rows that it turns into numbers, not by how often a character occurs. Whatever is not certain
is said in words, for the comments of a new dataset.toml.
"""

import csv
import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

from twintube.data.check.column_claims import claims
from twintube.data.convert.column_names import assigned
from twintube.data.convert.units import name_and_unit
from twintube.data.formats import TEXT
from twintube.data.read.text import split_white
from twintube.data.sniff.values import GROUPED, NUMBER, Sniffed, judge, velocity_apart
from twintube.engine.simulate import InputError

LOOK = 400  # rows in which the table must begin
MOST_BYTES = 8_000_000  # read for the guess; the rest of a longer file looks alike
MOST_ROWS = 100_000
LONGEST = 20_000  # characters of a row
DELIMITERS = (";", "\t", ",", "|", "whitespace")  # in this order where two serve alike
EVEN = 0.8  # of the rows must have the usual number of cells
PLAIN_FIRST = 0.999  # of a score: of two ways that serve alike the one without thousands separators
LINE_END = re.compile(r"\r\n|\r|\n")
BLANK = re.compile(r"[\s,;|]*")


@dataclass(frozen=True)
class Shape:
    """One way to cut the lines into cells; `width` cells a row, of which `first` is the first of numbers."""

    delimiter: str
    decimal: str
    rows: list[list[str]]
    first: int
    width: int
    score: float


def sniff(path: Path) -> Sniffed:
    """What the first rows of a text file tell; raises InputError where they hold no table of numbers, and OSError."""
    text, encoding = decoded(path)
    lines = LINE_END.split(text)
    if len(text) > MOST_BYTES // 4 and path.stat().st_size > MOST_BYTES:
        lines.pop()  # cut within a row
    return sniffed(path, lines, encoding)


def sniffed(
    path: Path, lines: Sequence[str], encoding: str, delimiters: Sequence[str] = DELIMITERS, decimals: Iterable[str] = NUMBER
) -> Sniffed:
    """What the first lines tell, cut in one of these ways; raises InputError."""
    if max(map(len, lines[:LOOK]), default=0) > LONGEST:
        raise InputError(f"{path}: a row of more than {LONGEST} characters, so not a table of channels")
    numbers = [i for i, line in enumerate(lines[: 2 * LOOK]) if not BLANK.fullmatch(line)][:LOOK]
    looked = [lines[i] for i in numbers]
    shapes = [shape(looked, delimiter, decimal) for delimiter in delimiters for decimal in decimals]
    best = max(shapes, key=lambda s: s.score)
    if best.score <= 0.0:
        raise InputError(f"{path}: no table of at least two columns of numbers in its first {LOOK} rows")
    refuse_equal_signs(path, best)
    result = Sniffed({})
    if best.delimiter != TEXT[path.suffix.lower()]:
        result.reading["delimiter"] = best.delimiter
    if best.decimal != ".":
        result.reading["decimal"] = best.decimal
    if encoding != "utf-8-sig":
        result.reading["encoding"] = encoding
        result.doubts.append(f"encoding: the file is not UTF-8, {encoding} is assumed")
    columns = named(best, numbers, result)
    first = numbers[best.first]
    body = [row for row in cut(lines[first : first + MOST_ROWS], best.delimiter) if row]
    if "velocity" in columns and BY_ORDER in result.doubts:
        columns = velocity_apart(columns, body, best.decimal)
    judge(columns, body, best.decimal, result)
    return result


def decoded(path: Path) -> tuple[str, str]:
    """The beginning of a file as text, and its encoding."""
    with path.open("rb") as file:
        data = file.read(MOST_BYTES)
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return data.decode("utf-16", errors="replace"), "utf-16"
    try:
        return data.decode("utf-8-sig"), "utf-8-sig"
    except UnicodeDecodeError as error:
        if len(data) == MOST_BYTES and error.start > MOST_BYTES - 4:  # cut within a character
            return data[: error.start].decode("utf-8-sig"), "utf-8-sig"
        return data.decode("cp1252", errors="replace"), "cp1252"


def cut(lines: Sequence[str], delimiter: str) -> list[list[str]]:
    """The cells of each line, without empty ones at its end."""
    if delimiter == "whitespace":
        rows = [split_white(line) for line in lines]
    else:
        try:
            rows = [next(csv.reader([line], delimiter=delimiter, skipinitialspace=True), []) for line in lines]
        except csv.Error:
            return []
    rows = [[cell.strip() for cell in row] for row in rows]
    for row in rows:
        while row and not row[-1]:
            row.pop()
    return rows


def shape(lines: Sequence[str], delimiter: str, decimal: str) -> Shape:
    """How well a delimiter and a decimal sign turn the lines into numbers; a score of 0 where they do not."""
    rows = cut(lines, delimiter)
    if delimiter == decimal and not any('"' in line for line in lines):
        return Shape(delimiter, decimal, rows, 0, 0, 0.0)
    kinds = [(len(row), sum(bool(NUMBER[decimal].match(cell)) for cell in row)) for row in rows]
    score, first, width, at = 0.0, 0, 0, 0
    for (count, numbers), run in groupby(kinds):
        length = len(list(run))
        if numbers >= 2 and length * numbers / count > score:
            score, first, width = length * numbers / count, at, count
        at += length
    # Empty cells cut the run of like rows; they are the matter of the checks on reading.
    while first > 0 and kinds[first - 1][1] >= 2 and numeric(rows[first - 1], decimal):
        first -= 1
    if any(GROUPED.search(cell) for row in rows[first:] for cell in row):
        score *= PLAIN_FIRST
    return Shape(delimiter, decimal, rows, first, width, score)


def refuse_equal_signs(path: Path, best: Shape) -> None:
    """Raise InputError where delimiter and decimal sign are a comma both: `0,01,12,5` under two names."""
    lengths = Counter(len(row) for row in best.rows[best.first :] if "" not in row and numeric(row, best.decimal))
    uneven = lengths[best.width] < EVEN * lengths.total()
    over = best.rows[best.first - 1] if best.first else []
    if best.delimiter == "," and (uneven or (1 < len(over) <= best.width // 2 and not numeric(over, best.decimal))):
        raise InputError(
            f"{path}: delimiter and decimal sign seem to be the comma both; export the file with two different ones"
        )


def numeric(row: Sequence[str], decimal: str) -> bool:
    """Whether all cells that are not empty are numbers."""
    return all(NUMBER[decimal].match(cell) for cell in row if cell)


def named(best: Shape, numbers: Sequence[int], result: Sniffed) -> dict[str, tuple[int, str]]:
    """By quantity: the number of its column and its unit ("" if not known); fills `columns` and `skip_rows`.

    `numbers` are those of the rows in the file, from 0.
    """
    width = best.width
    above = [i for i in range(best.first) if best.rows[i]]
    headers, at, units = header_rows(best, above, width)
    if headers is None:
        result.doubts.append(BY_ORDER)
        order = [*EXPECTED, *[""] * width][:width]
        result.reading |= {"columns": order} | ({"skip_rows": numbers[best.first]} if best.first else {})
        return {name_and_unit(text)[0]: (i, name_and_unit(text)[1]) for i, text in enumerate(order) if text}
    pairs = [name_and_unit(cell) for cell in headers]
    if units is not None:
        pairs = [
            (name, name_and_unit(f"x [{unit.strip('[]()')}]")[1]) for (name, _), unit in zip(pairs, units, strict=False)
        ]
    columns = {
        name: (i, unit or next((claim.unit for claim in claims(headers[i], name) if claim.kind == "unit"), ""))
        for name, (i, unit) in assigned(pairs, result.doubts).items()
    }
    result.facts.append("columns in the file: " + ", ".join(headers))
    own_row = units is None and at == best.first - 1 and len(best.rows[at]) in (width, width + 1)
    simple = own_row and len(set(headers)) == len(headers) == width
    if simple and at:
        result.reading["skip_rows"] = numbers[at]
    elif not simple:
        result.reading["skip_rows"] = numbers[best.first]
    result.reading["columns"] = (
        {name: headers[i] for name, (i, _) in columns.items()} if simple else [headers[i] for i in range(len(headers))]
    )
    return columns


BY_ORDER = "columns: the file has no header; the quantities and units are a guess by their order"
EXPECTED = ("time [s]", "stroke [mm]", "force [N]", "velocity [mm/s]", "temperature [degC]")


def header_rows(best: Shape, above: list[int], width: int) -> tuple[list[str] | None, int, list[str] | None]:
    """The names over the numbers, their row, and the units where these have a row of their own."""
    rows: list[tuple[int, list[str]]] = []
    for i in reversed(above[-3:]):
        cells = best.rows[i]
        if best.delimiter == "whitespace" and len(cells) > width:
            cells = re.split(r"\s+(?![\[(])", " ".join(cells))  # `Time [s]` is a single name
        if len(cells) in (width, width - 1, width + 1) and len(cells) > 1 and not numeric(cells, best.decimal):
            rows.append((i, cells[:width]))  # one more is a name without cells, like a comment
    if not rows:
        return None, 0, None
    units = rows[0][1]
    if len(rows) > 1 and all(not cell or name_and_unit(f"x [{cell.strip('[]()')}]")[1] for cell in units):
        return rows[1][1], rows[1][0], units
    return rows[0][1], rows[0][0], None
