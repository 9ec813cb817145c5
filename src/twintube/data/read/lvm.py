"""LabVIEW measurement files (.lvm): a head of the file, then segments, each with a head, a row of names and its rows.

The heads say separators, units and, where no column holds it, the time. National Instruments describes the format in
"Specification for the LabVIEW Measurement File (.lvm)". The package lvm_read is not used: it unpickles a file that lies
beside, and gives NaN without its row where a cell is no number.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from twintube.common.words import shown
from twintube.data.convert.column_names import fits
from twintube.data.convert.quantities import UNITS, quantity_of
from twintube.data.convert.units import split_header, unit_of
from twintube.data.findings import UnreadableError
from twintube.data.formats import Raw
from twintube.data.read.blocks import NUMERIC, Row, which

MAGIC = "LabVIEW Measurement"
END = "***End_of_Header***"
SPECIAL, SPECIAL_END = "***Start_Special***", "***End_Special***"
X, COMMENT = "X_Value", "Comment"
SEPARATORS = {"tab": "\t", "comma": ",", "semicolon": ";", "space": "whitespace"}


@dataclass(frozen=True)
class Layout:
    """What the head of a file says."""

    delimiter: str
    decimal: str
    x_columns: str  # no, one or multi: a column of times for no channel, for all, or for each


@dataclass(frozen=True)
class Segment:
    """One measurement in the file."""

    row: int  # where it begins in the file
    head: dict[str, list[str]]
    table: list[Row]  # names, then samples


def layout_of(lines: Iterable[str]) -> Layout:
    """What the first lines say; raises UnreadableError where one sign parts cells and decimals."""
    said = {}
    for line in lines:
        if line.startswith(END):
            break
        if pair := re.match(r"(\w+)[\t,;]([^\t;]*)", line):
            said[pair[1]] = pair[2].strip()
    written = said.get("Separator", "Tab").strip(",").lower()
    delimiter, decimal = SEPARATORS.get(written, written or ","), said.get("Decimal_Separator") or "."
    if len(decimal) != 1 or delimiter == decimal:
        raise UnreadableError(f"its head gives {shown(delimiter)} as separator and {shown(decimal)} as decimal sign")
    return Layout(delimiter, decimal, said.get("X_Columns", "One").strip(",").lower())


def segments_of(table: Sequence[Row]) -> list[Segment]:
    """The segments; raises UnreadableError where there is none."""
    rows = plain_rows(table)
    ends = [i for i, (_, cells) in enumerate(rows) if cells[0] == END]
    ends = ends[1:] or ends  # the first ends the head of the file; some programs write no other
    if not ends:
        raise UnreadableError(f"a file of LabVIEW without {END}")
    if rows[ends[-1] + 1 : ends[-1] + 2] and rows[ends[-1] + 1][1][0].strip() == "Channels":
        raise UnreadableError(f"the head of a segment has no {END}", rows[ends[-1] + 1][0])
    starts = [head_of(rows, end) for end in ends]
    found = []
    for start, end, last in zip(starts, ends, [*starts[1:], len(rows)], strict=True):
        head = {cells[0].strip(): [cell.strip() for cell in cells[1:]] for _, cells in rows[start:end]}
        found.append(Segment(rows[start][0], head, rows[end + 1 : last]))
    return found


def segment(found: Sequence[Segment], block: int | None) -> Segment:
    """The segment of this number, from 1, or the only one; raises UnreadableError."""
    if len(found) < (block or 1) or (block is None and len(found) > 1):
        raise UnreadableError(which([part.row for part in found], block))
    part = found[(block or 1) - 1]
    if len(part.table) < 2:
        raise UnreadableError("no samples behind its head", part.row)
    return part


def plain_rows(table: Sequence[Row]) -> list[Row]:
    """Without special parts, which are of no known form."""
    rows, special = [], False
    for row in table:
        special = special or row[1][0] == SPECIAL
        if not special:
            rows.append(row)
        special = special and row[1][0] != SPECIAL_END
    return rows


def head_of(rows: Sequence[Row], end: int) -> int:
    """Where the head begins that ends at row `end`: its rows begin with the name of what they say."""
    while end > 0 and (first := rows[end - 1][1][0].strip()) and not NUMERIC.match(first) and first != END:
        end -= 1
    return end


def names_of(found: Segment, layout: Layout) -> list[str]:
    """The names over the samples, different from each other; a time that no row has a cell for is left out."""
    names, count = [], 0
    for cell in found.table[0][1]:
        name = cell.strip()
        count += name == X
        names.append(f"{X} {count}" if name == X and count > 1 else name)
    if layout.x_columns == "no" and names[0] == X and found.table[1][1][0].strip():
        return names[1:]
    return names


def completed(raw: Raw, found: Segment, layout: Layout) -> Raw:
    """With the units of the head, the time, and the quantities that the units tell; raises UnreadableError."""
    columns = {name: cells for name, cells in raw.columns.items() if name != COMMENT}
    times = [name for name in columns if re.fullmatch(rf"{X}( \d+)?", name)]
    channels = [name for name in columns if name not in times]
    if layout.x_columns == "no":
        columns = {name: columns[name] for name in channels}
        if made := clock(found.head, len(raw.rows), layout.decimal):
            columns = {X: made} | columns
    for name in times[1:]:
        cells = columns.pop(name)
        if cells != columns[X]:
            raise UnreadableError(f"{name!r} has other times than {X!r}; nothing is resampled here")
    labels = found.head.get("Y_Unit_Label", [])
    said = dict(zip(channels, labels, strict=False))
    units = {name: unit for name in channels if (unit := said.get(name) or split_header(name)[1])}
    if X in columns and found.head.get("X_Dimension", ["Time"])[0] in ("Time", ""):
        units[X] = (found.head.get("X_Unit_Label") or [""])[0] or "s"
    raw.columns, raw.units, raw.decimal, raw.without, raw.meant = columns, units, layout.decimal, (), meant(columns, units)
    return raw


def clock(head: dict[str, list[str]], count: int, decimal: str) -> list[str]:
    """The times by the head's first time and step; empty where it says none. Raises UnreadableError."""
    steps = {text.replace(decimal, ".") for text in head.get("Delta_X", []) if text}
    firsts = [text.replace(decimal, ".") for text in head.get("X0", []) if text] or ["0"]
    if not steps:
        return []
    try:
        (step,), first = {float(text) for text in steps}, float(firsts[0])
    except ValueError as error:
        raise UnreadableError(f"Delta_X = {', '.join(sorted(steps))}: must be one number for all channels") from error
    return [repr(round(first + i * step, 12)).replace(".", decimal) for i in range(count)]


def meant(columns: Iterable[str], units: dict[str, str]) -> dict[str, str]:
    """Name [unit] of each quantity by its column: the only one of that name or, where there is none, with such a unit."""
    headers = {}
    for quantity in UNITS:
        named = [name for name in columns if quantity_of(name) == quantity]
        alike = named or [name for name in columns if name in units and fits(quantity, units[name])]
        if len(alike) == 1 and alike[0] in units:
            headers[alike[0]] = f"{quantity} [{unit_of(units[alike[0]]) or units[alike[0]]}]"
    return headers
