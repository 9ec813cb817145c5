"""What `dataset.toml` says, checked key by key."""

import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from twintube.common.words import shown
from twintube.dampers.damper import PERCENT, suggestion
from twintube.dampers.quantity import quantity
from twintube.dampers.toml import line_of
from twintube.data.convert.quantities import UNITS, WHOLE, quantity_of
from twintube.data.convert.units import split_header
from twintube.data.dataset_toml.channels import read_channels, wrong_channels
from twintube.data.dataset_toml.keys import MOST_RECORDS, MOST_UNKNOWN, NOT_SURE, OIL, READING, RECORD, RULES, TOP, UNKNOWN
from twintube.data.dataset_toml.keys import number as is_number
from twintube.data.findings import UNCONFIRMED, Notes
from twintube.data.formats import Format


@dataclass(frozen=True)
class Entry:
    """One `[[record]]`."""

    where: str
    section: "Section"  # its lines
    complete: bool  # no error in its keys
    file: str
    label: str  # the file and, where it holds several records, what tells this one from the others
    measurement: str
    oil_level: float | None  # None: unknown, or stated as a volume
    oil_volume: float | None  # [m3]
    gas_preload: float | None  # share [1], true and false where it is there or lost; None: unknown
    gas_pressure: float | None  # gauge [Pa]
    temperature: float | None  # [degC]
    start_temperature: float | None  # [degC]
    state: str | None  # label of the state of filling, None where it has none
    setting: str | None
    split: str | None
    reference: bool
    reference_window: tuple[float, float] | None  # [s] of the file's own time
    window: tuple[float, float]  # [s] of the file's own time
    excluded: tuple[tuple[float, float], ...]  # [s]
    form: Format
    force_sign: int
    stroke_sign: int
    stroke_offset: float  # [m], added after the sign

    @property
    def line(self) -> int | None:
        """The line of dataset.toml where it begins."""
        return self.section.header


@dataclass(frozen=True)
class Manifest:
    """dataset.toml."""

    title: str
    damper: str
    damper_line: int | None
    entries: list[Entry]


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
    seen: set[tuple[Any, ...]] = set()
    for number, table in enumerate(records, start=1):
        section = sections[number - 1] if number <= len(sections) else Section(None, [])
        entries.append(entry(table, number, section, shared, notes))
        file, form = entries[-1].file, entries[-1].form
        part = file, part_of(form)
        if file and part in seen:
            notes.error(f"{entries[-1].where}file = {shown(file)} is named by a record before", "file", entries[-1].line)
            entries[-1] = replace(entries[-1], file="", complete=False)
        seen.add(part)
    return Manifest(top.get("title", title), top.get("damper", ""), line("damper"), labelled(entries))


def labelled(entries: list[Entry]) -> list[Entry]:
    """With a label of its own for each record of a file that holds several."""
    records = Counter(entry.file for entry in entries)
    return [
        replace(e, label=f"{e.file}, {part_of(e.form) or 'the whole'}") if records[e.file] > 1 and e.file else e
        for e in entries
    ]


def part_of(form: Format) -> str:
    """What of a file a record is, in words; empty for the whole file."""
    headers = form.columns if isinstance(form.columns, list) else []
    places = [i for i, header in enumerate(headers, start=1) if header]
    beside = f"{places[0]} to {places[-1]}" if places and len(places) < len(headers) else None  # runs beside each other
    parts = {"sheet": form.sheet, "block": form.block, "group": form.group, "columns": beside}
    return ", ".join(f"{key} {value}" for key, value in parts.items() if value is not None)


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
            percent = key == "oil_level" and is_number(value) and PERCENT[0] <= value <= PERCENT[1]
            share = f" ({value:g} % is {value / 100:g})" if percent else ""
            notes.error(f"{where}{key} = {shown(value)}: must be {RULES[key][1]}{share}", key, line(key))
        else:
            good[key] = value
    if isinstance(good.get("columns"), dict):
        for header in good["columns"]:
            if quantity_of(header) not in UNITS:
                message = f"{where}columns: unknown {shown(header)}{suggestion(split_header(header)[0], UNITS)}"
                notes.error(
                    f"{message}; known are {', '.join(UNITS)}, each with a unit in brackets", "columns", line("columns")
                )
    for message in wrong_channels(good.get("channels", {})):
        notes.error(f"{where}channels: {message}", "channels", line("channels"))
        good.pop("channels", None)
    for doubt in good.get(NOT_SURE, []):
        notes.warning(f"{UNCONFIRMED}{doubt}; delete this entry of {NOT_SURE} once it is right", NOT_SURE, line(NOT_SURE))
    return good


def entry(table: dict[str, Any], number: int, section: "Section", shared: dict[str, Any], notes: Notes) -> Entry:
    """One `[[record]]`, with the keys at the top where it has none of its own."""
    where, line, own = f"record {number}: ", section.line_of, Notes(notes.file, notes.counted)
    good = valid(table, RECORD, where, line, own)
    for key in ("file", "measurement", "gas_preload"):
        if key not in table:
            hint = f"; '{UNKNOWN}' where nobody knows it" if key == "gas_preload" else ""
            own.error(f"{where}{key} is missing{hint}", key, line(""))
    if (count := sum(key in table for key in OIL)) != 1:
        what = "both are given" if count else "is missing"
        hint = "" if count else f"; oil_level = '{UNKNOWN}' where nobody knows it"
        own.error(f"{where}{' or '.join(OIL)} {what}, must be one of the two{hint}", "oil_level", line(""))
    window = float(good.get("start_s", WHOLE[0])), float(good.get("end_s", WHOLE[1]))
    if window[0] >= window[1]:
        own.error(f"{where}start_s = {window[0]:g} must be before end_s = {window[1]:g}", "start_s", line("start_s"))
    pressure = quantity(good["gas_pressure"], "Pa") if "gas_pressure" in good else None
    level, preload = (None if good.get(key) == UNKNOWN else good.get(key) for key in ("oil_level", "gas_preload"))
    if preload in (0, 1):
        preload = bool(preload)
    if pressure and preload is not True and "gas_preload" in good:
        stated = f"'{UNKNOWN}'" if preload is None else str(preload).lower()
        message = f"{where}gas_pressure = {good['gas_pressure']}: must be left out where gas_preload = {stated}"
        own.error(message, "gas_pressure", line("gas_pressure"))
    part = good.get("reference_s")
    if part and (wrong := wrong_part(part, window, bool(good.get("reference")))):
        own.error(f"{where}reference_s = {part}: {wrong}", "reference_s", line("reference_s"))
    notes.findings += own.findings
    both = shared | good
    volume = good.get("oil_volume_mL")
    return Entry(
        where=where,
        section=section,
        complete=not own.failed,
        file=good.get("file", ""),
        label=good.get("file", ""),
        measurement=good.get("measurement", ""),
        oil_level=None if level is None else float(level),
        oil_volume=None if volume is None else volume * 1e-6,
        gas_preload=preload,
        gas_pressure=pressure,
        temperature=good.get("temperature_degC"),
        start_temperature=good.get("start_temperature_degC"),
        **{key: good.get(key) for key in ("state", "setting", "split")},
        reference=good.get("reference", False),
        reference_window=None if part is None else (float(part[0]), float(part[1])),
        window=window,
        excluded=tuple((float(low), float(high)) for low, high in good.get("exclude", [])),
        form=form_of(both),
        force_sign=both.get("force_sign", 1),
        stroke_sign=both.get("stroke_sign", 1),
        stroke_offset=quantity(both.get("stroke_offset", 0.0), "m"),
    )


def wrong_part(part: Sequence[float], window: tuple[float, float], whole: bool) -> str:
    """Why a part of a record [s] cannot be a reference in its window, where the `whole` may be one already; else empty."""
    if whole:
        return "must be left out where reference = true, which is the whole record"
    if part[0] < window[0]:
        return f"must not begin before start_s = {window[0]:g}"
    return f"must not end after end_s = {window[1]:g}" if part[1] > window[1] else ""


def form_of(reading: dict[str, Any]) -> Format:
    """How a file is to be read, by the keys of READING."""
    alike = ("columns", "delimiter", "decimal", "encoding", "skip_rows", "sheet", "block", "group")
    given = {key: reading[key] for key in alike if key in reading}
    return Format(**given, sample_rate=reading.get("sample_rate_Hz"), channels=read_channels(reading.get("channels", {})))


@dataclass(frozen=True)
class Section:
    """The lines of one `[[record]]` in dataset.toml."""

    header: int | None  # its line
    lines: list[tuple[int, str]]

    def line_of(self, key: str) -> int | None:
        """The line of a key, or of the header where the key is not there."""
        if key:
            pattern = re.compile(rf"\s*(\[record\.)?[\"']?{re.escape(key)}[\"'\]]?\s*(=|$|\.)")
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
