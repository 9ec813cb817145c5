"""What `dataset.toml` says, checked key by key."""

import codecs
import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from twintube.dampers.damper import suggestion
from twintube.dampers.quantity import quantity
from twintube.dampers.toml import line_of
from twintube.data.findings import Notes
from twintube.data.formats import Format
from twintube.data.table import UNITS, split_header

MEASUREMENTS = ("quasi-static", "harmonic", "stochastic")
SPLITS = ("fit", "heldout")
COLDEST, HOTTEST = -60.0, 200.0  # start temperature [degC]
# How to read the files: at the top for all records, or in a record.
READING = ("columns", "delimiter", "decimal", "encoding", "skip_rows", "force_sign", "stroke_sign", "stroke_offset")
TOP = ("title", "damper", "record", *READING)
OIL = ("oil_level", "oil_volume_mL")
RECORD = ("file", "measurement", *OIL, "gas_preload", "start_temperature_degC", "split", *READING)


@dataclass(frozen=True)
class Entry:
    """One `[[record]]`."""

    where: str
    line: int | None
    complete: bool  # no error in its keys
    file: str
    measurement: str
    oil_level: float | None
    oil_volume: float | None  # [m3]
    gas_preload: bool
    start_temperature: float | None  # [degC]
    split: str | None
    form: Format
    force_sign: int
    stroke_sign: int
    stroke_offset: float  # [m], added after the sign


@dataclass(frozen=True)
class Manifest:
    """dataset.toml."""

    title: str
    damper: str
    damper_line: int | None
    entries: list[Entry]


def number(value: Any) -> bool:
    """Whether a TOML value is a finite number."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def good_columns(value: Any) -> bool:
    """A list of headers, or a table header = name in the file."""
    texts = list(value.values()) if isinstance(value, dict) else value
    return isinstance(texts, list) and len(texts) > 0 and all(isinstance(text, str) for text in texts)


def good_encoding(value: Any) -> bool:
    """A text encoding Python knows."""
    try:
        return isinstance(value, str) and codecs.lookup(value)._is_text_encoding
    except LookupError:
        return False


def good_offset(value: Any) -> bool:
    """A length with its unit."""
    try:
        return isinstance(value, str) and math.isfinite(quantity(value, "m"))
    except ValueError:
        return False


def text(value: Any) -> bool:
    """A text that is not empty."""
    return isinstance(value, str) and bool(value)


RULES: dict[str, tuple[Callable[[Any], bool], str]] = {
    "title": (text, "a text"),
    "damper": (text, "the name of a damper or of a parameter file"),
    "file": (text, "the name of a file"),
    "measurement": (lambda x: x in MEASUREMENTS, f"one of {', '.join(MEASUREMENTS)}"),
    "oil_level": (lambda x: number(x) and 0 <= x <= 1, "a number from 0 to 1, the share of the intact oil volume"),
    "oil_volume_mL": (lambda x: number(x) and x >= 0, "a number of at least 0"),
    "gas_preload": (lambda x: isinstance(x, bool), "true (present) or false (lost)"),
    "start_temperature_degC": (lambda x: number(x) and COLDEST <= x <= HOTTEST, f"from {COLDEST:g} to {HOTTEST:g} degC"),
    "split": (lambda x: x in SPLITS, f"one of {', '.join(SPLITS)}"),
    "columns": (good_columns, "a list of headers, or a table like {'stroke [mm]' = 'name in the file'}"),
    "delimiter": (lambda x: x == "whitespace" or (text(x) and len(x) == 1), "one character or 'whitespace'"),
    "decimal": (lambda x: x in (".", ","), "'.' or ','"),
    "encoding": (good_encoding, "a text encoding like 'utf-8' or 'latin-1'"),
    "skip_rows": (lambda x: isinstance(x, int) and not isinstance(x, bool) and x >= 0, "an integer of at least 0"),
    "force_sign": (lambda x: x in (1, -1) and not isinstance(x, bool), "1 or -1"),
    "stroke_sign": (lambda x: x in (1, -1) and not isinstance(x, bool), "1 or -1"),
    "stroke_offset": (good_offset, "a length with unit like '-12.5 mm'"),
}


def read_manifest(content: dict[str, Any], toml: str, title: str, notes: Notes) -> Manifest:
    """What dataset.toml says; what is wrong with it goes to `notes` with its line."""

    def line(key: str) -> int | None:
        found = re.search(r"\d+", line_of(toml, "", key))
        return int(found.group()) if found else None

    top = valid(content, TOP, "", line, notes)
    if "damper" not in content:
        notes.error("damper is missing", "damper")
    records = content.get("record", [])
    if not isinstance(records, list) or not all(isinstance(one, dict) for one in records) or not records:
        notes.error("no [[record]]: the dataset is empty", "record")
        records = []
    shared = {key: top[key] for key in READING if key in top}
    entries = [entry(one, number, toml, shared, notes) for number, one in enumerate(records, start=1)]
    for i, one in enumerate(entries):
        if one.file and one.file in [other.file for other in entries[:i]]:
            notes.error(f"{one.where}file = {one.file!r} is named by a record before", "file", one.line)
    return Manifest(top.get("title", title), top.get("damper", ""), line("damper"), entries)


def valid(
    table: dict[str, Any], known: tuple[str, ...], where: str, line: Callable[[str], int | None], notes: Notes
) -> dict[str, Any]:
    """The entries of a table that are known and good; findings on the others."""
    good = {}
    for key, value in table.items():
        if key not in known:
            notes.error(f"{where}unknown {key}{suggestion(key, known)}", key, line(key))
        elif key in RULES and not RULES[key][0](value):
            notes.error(f"{where}{key} = {value!r}: must be {RULES[key][1]}", key, line(key))
        else:
            good[key] = value
    if isinstance(good.get("columns"), dict):
        for header in good["columns"]:
            if split_header(header)[0] not in UNITS:
                message = f"{where}columns: unknown {header!r}{suggestion(split_header(header)[0], UNITS)}"
                notes.error(
                    f"{message}; known are {', '.join(UNITS)}, each with a unit in brackets", "columns", line("columns")
                )
    return good


def entry(table: dict[str, Any], number: int, toml: str, shared: dict[str, Any], notes: Notes) -> Entry:
    """One `[[record]]`, with the keys at the top where it has none of its own."""
    where = f"record {number}: "
    before = len(notes.findings)

    def line(key: str) -> int | None:
        return line_in_record(toml, number, key)

    good = valid(table, RECORD, where, line, notes)
    for key in ("file", "measurement", "gas_preload"):
        if key not in table:
            notes.error(f"{where}{key} is missing", key, line(""))
    if sum(key in table for key in OIL) != 1:
        what = "both are given" if all(key in table for key in OIL) else "is missing"
        notes.error(f"{where}{' or '.join(OIL)} {what}, must be one of the two", "oil_level", line(""))
    both = shared | good
    volume = good.get("oil_volume_mL")
    return Entry(
        where=where,
        line=line(""),
        complete=len(notes.findings) == before,
        file=good.get("file", ""),
        measurement=good.get("measurement", ""),
        oil_level=None if "oil_level" not in good else float(good["oil_level"]),
        oil_volume=None if volume is None else volume * 1e-6,
        gas_preload=good.get("gas_preload", True),
        start_temperature=good.get("start_temperature_degC"),
        split=good.get("split"),
        form=Format(**{key: both[key] for key in Format.__dataclass_fields__ if key in both}),
        force_sign=both.get("force_sign", 1),
        stroke_sign=both.get("stroke_sign", 1),
        stroke_offset=quantity(both.get("stroke_offset", 0.0), "m"),
    )


def line_in_record(toml: str, number: int, key: str) -> int | None:
    """The line of a key in the numbered `[[record]]`, or of its header where the key is not found."""
    count, header = 0, None
    for i, line in enumerate(toml.splitlines(), start=1):
        if re.match(r"\s*\[\[\s*record\s*\]\]", line):
            count += 1
            header = i if count == number else header
        elif count == number and key and re.match(rf"\s*(\[record\.)?[\"']?{re.escape(key)}[\"'\]]?\s*(=|$)", line):
            return i
    return header
