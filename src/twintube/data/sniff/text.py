"""A first guess of how a text file or a sheet is to be read: delimiter, decimal sign, header, names and units of columns.

A guess is judged by what it explains, not by how often a character occurs. Whatever is not certain is said in words, for
the comments of a new dataset.toml.
"""

import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from twintube.data.check.column_claims import claims
from twintube.data.convert.column_names import CURVE, assigned, is_curve
from twintube.data.convert.units import name_and_unit
from twintube.data.formats import usual_delimiter
from twintube.data.read.text import UTF_16, utf_16
from twintube.data.sniff.grids import DELIMITERS, LONGEST, Body, Grid, body, is_number
from twintube.data.sniff.names import Names, names_over, side_by_side
from twintube.data.sniff.values import NUMBER, Sniffed, judge, velocity_apart
from twintube.engine.simulate import InputError

LOOK = 400  # rows in which the table must begin
MOST_BYTES = 8_000_000  # read for the guess; the rest of a longer file looks alike
MOST_ROWS = 100_000
LINE_END = re.compile(r"\r\n|\r|\n")
CYRILLIC = re.compile(rb"(?<![\x80-\xff])[\xc0-\xff]{3,}(?![\x80-\xff])")  # a word; single letters of it are of the West
PADDED = re.compile(r"0\d+")  # digits behind a decimal comma, and no number of their own
BY_ORDER = "columns: the file has no header; the quantities and units are a guess by their order"
EXPECTED = ("time [s]", "stroke [mm]", "force [N]", "velocity [mm/s]", "temperature [degC]")


def sniff(path: Path) -> list[Sniffed]:
    """What the first rows of a text file tell, of each run that stands beside another in it.

    Raises InputError where they hold no table of numbers, and OSError.
    """
    text, encoding = decoded(path)
    lines = LINE_END.split(text)
    if len(text) > MOST_BYTES // 4 and path.stat().st_size > MOST_BYTES:
        lines.pop()  # cut within a row
    return with_encoding(sniffed(str(path), Grid(lines, usual_delimiter(path), DELIMITERS)), encoding)


def with_encoding(found: list[Sniffed], encoding: str) -> list[Sniffed]:
    """With the encoding of the text, where it is not the usual one."""
    for guess in found if encoding != "utf-8-sig" else []:
        guess.reading["encoding"] = encoding
        guess.doubts.insert(0, f"encoding: the file is not UTF-8, {encoding} is assumed")
    return found


def sniffed(place: str, grid: Grid, decimals: Iterable[str] = NUMBER) -> list[Sniffed]:
    """What the first rows tell, cut in one of these ways; raises InputError that begins with the `place`."""
    count = len(grid.rows)
    looked = [i for i in range(min(count, 2 * LOOK)) if not grid.blank(i)][:LOOK]
    if any(grid.too_long(i) for i in range(min(count, LOOK))):
        raise InputError(f"{place}: a row of more than {LONGEST} characters, so not a table of channels")
    ways = [(sign, decimal) for sign in grid.delimiters for decimal in decimals if sign != decimal or grid.quoted]
    best = max((body(grid.cells(looked, *way), *way) for way in ways), key=lambda found: found.score)
    if best.score <= 0.0:
        raise InputError(f"{place}: no table of at least two columns of numbers in its first {LOOK} rows")
    start = looked[best.first]
    rows = grid.cells(range(start, min(count, start + MOST_ROWS)), best.delimiter, best.decimal)
    rows = [row for row in rows if best.takes(row)]
    refuse_equal_signs(place, best, rows[:LOOK])
    reading = {"delimiter": best.delimiter} if best.delimiter != grid.usual else {}
    if best.decimal != ".":
        reading["decimal"] = best.decimal
    width = max(map(len, rows))
    held = [j for j in range(width) if any(j < len(row) and row[j] and is_number(row[j], best.decimal) for row in rows)]
    names = names_over(best, held)
    if names is None:
        skipped = {"skip_rows": start} if best.first else {}
        return [by_order(held, rows, best.decimal, Sniffed(reading | skipped))]
    parts = side_by_side(names, held)
    keys = by_name(best, names, looked, width) if len(parts) == 1 else by_place(names, start, width)
    doubts = [f"columns: {len(parts)} runs side by side are taken for records of their own"] * (len(parts) > 1)
    results = [Sniffed(reading | keys, doubts=list(doubts)) for _ in parts]
    return [by_names(place, names, *both, rows, best.decimal) for both in zip(parts, results, strict=True)]


def by_order(held: Sequence[int], rows: list[list[str]], decimal: str, result: Sniffed) -> Sniffed:
    """What a table without names is: its columns that hold numbers, in the order that is usual."""
    result.doubts.append(BY_ORDER)
    listed = [""] * (max(held) + 1)
    for text, i in zip(EXPECTED, held, strict=False):
        listed[i] = text
    result.reading["columns"] = listed
    columns = {name_and_unit(text)[0]: (i, name_and_unit(text)[1]) for i, text in enumerate(listed) if text}
    if "velocity" in columns:
        columns = velocity_apart(columns, rows, decimal)
    judge(columns, rows, decimal, result)
    return result


def by_name(best: Body, names: Names, looked: Sequence[int], width: int) -> dict[str, Any]:
    """How the columns are found by their names; by their places where the reader would not find the names as they stand."""
    over = best.first - 1 - (names.units is not None)
    written = [text for text in names.texts if text]
    plain = names.rows == [over] and names.texts == best.rows[over] and len(names.texts) >= width
    if not plain or len(set(written)) < len(written):
        return by_place(names, looked[best.first], width)
    return {"columns": dict(enumerate(names.texts))} | ({"skip_rows": looked[over]} if over else {})


def by_place(names: Names, start: int, width: int) -> dict[str, Any]:
    """A list of columns, over rows that begin behind `start` others."""
    return {"columns": [""] * max(width, len(names.texts)), "skip_rows": start}


def by_names(  # noqa: PLR0917 - the table and what is read from it
    place: str, names: Names, part: Sequence[int], result: Sniffed, rows: list[list[str]], decimal: str
) -> Sniffed:
    """What the names tell of the columns in `part`."""
    pairs = [names.pair(i) if i in part else ("", "") for i in range(max(part) + 1)]
    columns = {
        name: (i, unit or next((claim.unit for claim in claims(names.texts[i], name) if claim.kind == "unit"), ""))
        for name, (i, unit) in assigned(pairs, result.doubts).items()
    }
    if is_curve(columns):
        raise InputError(f"{place}: {CURVE}")
    result.facts.append("columns in the file: " + ", ".join(names.texts))
    judge(columns, rows, decimal, result)
    return result


def decoded(path: Path) -> tuple[str, str]:
    """The beginning of a file as text, and its encoding."""
    with path.open("rb") as file:
        data = file.read(MOST_BYTES)
    if other := "utf-16" if data.startswith(UTF_16) else utf_16(data):
        return data.decode(other, errors="replace"), other
    try:
        return data.decode("utf-8-sig"), "utf-8-sig"
    except UnicodeDecodeError as error:
        if len(data) == MOST_BYTES and error.start > MOST_BYTES - 4:  # cut within a character
            return data[: error.start].decode("utf-8-sig"), "utf-8-sig"
        encoding = "cp1251" if CYRILLIC.search(data) else "cp1252"
        return data.decode(encoding, errors="replace"), encoding


def refuse_equal_signs(place: str, best: Body, rows: Sequence[Sequence[str]]) -> None:
    """Raise InputError where delimiter and decimal sign are a comma both: `0,01,12,5` under two names."""
    cells = [cell for row in rows for cell in row]
    names = len(best.over)
    fewer = 1 < names <= max(map(len, rows)) // 2 and not any(is_number(cell, best.decimal) for cell in best.over)
    if best.delimiter == "," and not any("." in cell for cell in cells) and (fewer or any(map(PADDED.fullmatch, cells))):
        raise InputError(
            f"{place}: delimiter and decimal sign seem to be the comma both; export the file with two different ones"
        )
