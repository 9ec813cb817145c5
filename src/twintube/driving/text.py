"""Signals in CSV and other text: which row names the channels, and how numbers are written."""

from collections.abc import Sequence
from itertools import islice
from pathlib import Path
from typing import Final

import numpy as np

from twintube.common.arrays import Array
from twintube.data.convert.cells import cells
from twintube.data.convert.stamps import is_stamp, seconds
from twintube.data.findings import Notes
from twintube.data.formats import Format
from twintube.data.read.text import TextReader
from twintube.data.sniff.grids import DELIMITERS, cut
from twintube.data.sniff.text import LINE_END, LOOK, decoded
from twintube.data.sniff.values import NUMBER
from twintube.driving.channels import TIME
from twintube.driving.columns import channel_of
from twintube.errors import InputError

FEWEST: Final = 2  # names of channels that make a row their header


def header_of(lines: Sequence[str]) -> tuple[int, str]:
    """Row and delimiter of the names of the channels; raises InputError where no row names any."""
    named = {
        (i, delimiter): sum(channel_of(cell) is not None for cell in row)
        for delimiter in DELIMITERS
        for i, row in enumerate(cut(lines, delimiter))
    }
    best = max(named, key=lambda each: named[each], default=(0, ","))
    if named.get(best, 0) < FEWEST:
        raise InputError(
            f"none of its first {len(lines)} rows names the channels: one must, like "
            "'time_s,wheel_speed_fl_rad_per_s,...' or 'time [s];wheel_speed_fl [km/h];...'"
        )
    return best


def decimal_of(rows: Sequence[Sequence[str]]) -> str:
    """The decimal sign that makes more of the cells numbers; the point where both do."""
    return max(NUMBER, key=lambda sign: sum(bool(NUMBER[sign].match(cell)) for row in rows for cell in row))


def read_text(path: Path) -> tuple[dict[str, Array], dict[str, str], list[str]]:
    """Columns of the channels, their units where a row of its own says them, and all names; raises InputError."""
    text, encoding = decoded(path)
    lines = LINE_END.split(text)[:LOOK]
    row, delimiter = header_of(lines)
    decimal = decimal_of(cut(lines[row + 1 :], delimiter))
    form = Format(delimiter=delimiter, decimal=decimal, encoding=encoding, skip_rows=row)
    raw = TextReader().read(path, form)
    notes, columns, rows = Notes(path.name), {}, np.asarray(raw.rows, dtype=np.int64)
    for header, values in raw.columns.items():
        if (known := channel_of(header)) is None:
            continue
        if known[0] == TIME and any(map(is_stamp, islice(values, 1))):
            columns[f"{TIME}"] = seconds(values)
        else:
            columns[header] = cells(values, header, rows, decimal, notes)
    if wrong := [finding.text for finding in notes.findings if finding.severity == "error"]:
        raise InputError(wrong[0])
    return columns, raw.units, list(raw.columns)
