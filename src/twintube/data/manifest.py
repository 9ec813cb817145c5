"""What `dataset.toml` says, checked key by key."""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from twintube.dampers.damper import suggestion
from twintube.dampers.quantity import quantity
from twintube.dampers.toml import line_of
from twintube.data.findings import Notes
from twintube.data.formats import MOST_COLUMNS, MOST_SKIPPED, Format, known_encoding
from twintube.data.table import UNITS, split_header
from twintube.words import shown

MEASUREMENTS = ("quasi-static", "harmonic", "stochastic")
SPLITS = ("fit", "heldout")
COLDEST, HOTTEST = -60.0, 200.0  # start temperature [degC]
MOST_RECORDS = 1000
MOST_UNKNOWN = 5  # unknown keys that are named
LONGEST_TEXT = 200  # characters
LONGEST_PATH = 1000
LARGEST_OFFSET = 1.0  # [m]
LARGEST_VOLUME = 100_000.0  # oil [mL]
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
    return isinstance(texts, list) and 0 < len(texts) <= MOST_COLUMNS and all(isinstance(text, str) for text in texts)


def good_offset(value: Any) -> bool:
    """A length with its unit."""
    try:
        return isinstance(value, str) and abs(quantity(value, "m")) <= LARGEST_OFFSET
    except ValueError:
        return False


def text(value: Any, most: int = LONGEST_TEXT) -> bool:
    """A text of one line that is not empty."""
    return isinstance(value, str) and 0 < len(value) <= most and "\n" not in value


def good_path(value: Any) -> bool:
    """A path that systems take."""
    return text(value, LONGEST_PATH)


def good_delimiter(value: Any) -> bool:
    """What the csv module takes as a delimiter, or the word `whitespace`."""
    return value == "whitespace" or (isinstance(value, str) and len(value) == 1 and value not in "\r\n\"'")


RULES: dict[str, tuple[Callable[[Any], bool], str]] = {
    "title": (text, f"a text of one line and at most {LONGEST_TEXT} characters"),
    "damper": (good_path, "the name of a damper or of a parameter file"),
    "file": (good_path, f"the name of a file, at most {LONGEST_PATH} characters"),
    "measurement": (lambda x: isinstance(x, str) and x in MEASUREMENTS, f"one of {', '.join(MEASUREMENTS)}"),
    "oil_level": (lambda x: number(x) and 0 <= x <= 1, "a number from 0 to 1, the share of the intact oil volume"),
    "oil_volume_mL": (lambda x: number(x) and 0 <= x <= LARGEST_VOLUME, f"a number from 0 to {LARGEST_VOLUME:g}"),
    "gas_preload": (lambda x: isinstance(x, bool), "true (present) or false (lost)"),
    "start_temperature_degC": (lambda x: number(x) and COLDEST <= x <= HOTTEST, f"from {COLDEST:g} to {HOTTEST:g} degC"),
    "split": (lambda x: isinstance(x, str) and x in SPLITS, f"one of {', '.join(SPLITS)}"),
    "columns": (
        good_columns,
        "a list of headers, or a table like {'stroke [mm]' = 'name in the file'}, at most " + str(MOST_COLUMNS),
    ),
    "delimiter": (good_delimiter, "one character or 'whitespace'"),
    "decimal": (lambda x: isinstance(x, str) and x in (".", ","), "'.' or ','"),
    "encoding": (lambda x: isinstance(x, str) and known_encoding(x), "a text encoding like 'utf-8' or 'latin-1'"),
    "skip_rows": (lambda x: type(x) is int and 0 <= x <= MOST_SKIPPED, f"an integer from 0 to {MOST_SKIPPED}"),
    "force_sign": (lambda x: type(x) in (int, float) and x in (1, -1), "1 or -1"),
    "stroke_sign": (lambda x: type(x) in (int, float) and x in (1, -1), "1 or -1"),
    "stroke_offset": (good_offset, "a length with unit like '-12.5 mm'"),
}


def read_manifest(content: dict[str, Any], toml: str, title: str, notes: Notes) -> Manifest:
    """What dataset.toml says; what is wrong with it goes to `notes` with its line."""

    def line(key: str) -> int | None:
        place = re.search(r"\d+", line_of(toml, "", key))
        return int(place.group()) if place else None

    top = valid(content, TOP, "", line, notes)
    if "damper" not in content:
        notes.error("damper is missing", "damper")
    records = content.get("record", [])
    if not isinstance(records, list) or not all(isinstance(table, dict) for table in records) or not records:
        notes.error("no [[record]]: the dataset is empty", "record")
        records = []
    if len(records) > MOST_RECORDS:
        notes.error(f"{len(records)} records, at most {MOST_RECORDS} are read", "record")
        records = []
    shared = {key: top[key] for key in READING if key in top}
    sections = record_sections(toml)
    entries: list[Entry] = []
    files: set[str] = set()
    for number, table in enumerate(records, start=1):
        section = sections[number - 1] if number <= len(sections) else Section(None, [])
        entries.append(entry(table, number, section, shared, notes))
        file = entries[-1].file
        if file and file in files:
            notes.error(f"{entries[-1].where}file = {shown(file)} is named by a record before", "file", entries[-1].line)
            entries[-1] = replace(entries[-1], file="", complete=False)
        files.add(file)
    return Manifest(top.get("title", title), top.get("damper", ""), line("damper"), entries)


def valid(
    table: dict[str, Any], known: tuple[str, ...], where: str, line: Callable[[str], int | None], notes: Notes
) -> dict[str, Any]:
    """The entries of a table that are known and good; findings on the others."""
    good = {}
    unknown = [key for key in table if key not in known]
    for key in unknown[:MOST_UNKNOWN]:
        notes.error(f"{where}unknown {key}{suggestion(key, known)}", key, line(key))
    if len(unknown) > MOST_UNKNOWN:
        notes.error(f"{where}{len(unknown) - MOST_UNKNOWN} more unknown keys", "")
    for key, value in table.items():
        if key not in known:
            continue
        if key in RULES and not RULES[key][0](value):
            share = (
                f" ({value:g} % is {value / 100:g})" if key == "oil_level" and number(value) and 2 <= value <= 100 else ""
            )
            notes.error(f"{where}{key} = {shown(value)}: must be {RULES[key][1]}{share}", key, line(key))
        else:
            good[key] = value
    if isinstance(good.get("columns"), dict):
        for header in good["columns"]:
            if split_header(header)[0] not in UNITS:
                message = f"{where}columns: unknown {shown(header)}{suggestion(split_header(header)[0], UNITS)}"
                notes.error(
                    f"{message}; known are {', '.join(UNITS)}, each with a unit in brackets", "columns", line("columns")
                )
    return good


def entry(table: dict[str, Any], number: int, section: "Section", shared: dict[str, Any], notes: Notes) -> Entry:
    """One `[[record]]`, with the keys at the top where it has none of its own."""
    where = f"record {number}: "
    before = len(notes.findings)

    def line(key: str) -> int | None:
        return section.line_of(key)

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


@dataclass(frozen=True)
class Section:
    """The lines of one `[[record]]` in dataset.toml."""

    header: int | None  # its line
    lines: list[tuple[int, str]]

    def line_of(self, key: str) -> int | None:
        """The line of a key, or of the header where the key is not there."""
        if key:
            pattern = re.compile(rf"\s*(\[record\.)?[\"']?{re.escape(key)}[\"'\]]?\s*(=|$)")
            for number, line in self.lines:
                if pattern.match(line):
                    return number
        return self.header


def record_sections(toml: str) -> list[Section]:
    """The sections of all records, in their order."""
    sections: list[Section] = []
    for number, line in enumerate(toml.splitlines(), start=1):
        if re.match(r"\s*\[\[\s*record\s*\]\]", line):
            sections.append(Section(number, []))
        elif sections:
            sections[-1].lines.append((number, line))
    return sections
