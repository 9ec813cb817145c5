"""From the columns of a file to quantities in SI units."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pint
from numpy.typing import NDArray

from twintube.common.arrays import Array
from twintube.common.words import listed, printable, shown
from twintube.dampers.damper import suggestion
from twintube.dampers.quantity import parsed, quantity, registry
from twintube.data.convert.cells import cells, floats, slow_cells
from twintube.data.convert.inferred import say_inferred
from twintube.data.convert.stamps import is_stamp, seconds
from twintube.data.convert.units import is_mass, is_weight_of, split_header, unit_of
from twintube.data.findings import Notes
from twintube.data.formats import Channel, Format, Raw

UNITS = {"time": "s", "stroke": "m", "force": "N", "velocity": "m/s", "temperature": "degC"}
EXAMPLES = {"time": "time [s]", "stroke": "stroke [mm]", "force": "force [N]"}
WHOLE = (-math.inf, math.inf)  # the window of a record that is not cut
AS_STATED = Channel()
Source = tuple[str, str]  # where a quantity stands: the header with its unit, as in the file or in `columns`; its column
LOOK = 1000  # cells that tell whether a column rises


@dataclass(frozen=True)
class Table:
    """A record as read: NaN where a cell was no number."""

    columns: dict[str, Array]  # by quantity, (n,), SI units, temperature in degC
    headers: dict[str, str]  # by quantity
    rows: NDArray[np.int64]  # number in the file, (n,)


def quantity_of(header: str) -> str:
    """The quantity that a header names, whatever its capitals; the name itself where it is none."""
    name = split_header(header)[0]
    return name.lower() if name.lower() in UNITS else name


def in_si(values: Array, name: str, unit: str) -> Array:
    """The values of a quantity in its unit of UNITS; raises ValueError."""
    if not unit:
        raise ValueError(f"no unit, must be like '{name} [{UNITS[name]}]'")
    unit = unit_of(unit) or unit
    try:
        if name == "temperature":
            return np.asarray(registry().Quantity(values, parsed(unit)).to("degC").magnitude, dtype=float)
        return values * quantity(f"1 {unit}", UNITS[name])
    except (ValueError, pint.PintError) as error:
        why = ", but of mass; as a weight it is stated in kgf" if name == "force" and is_mass(unit) else ""
        raise ValueError(f"unit {shown(unit)} is not a unit of {name}{why}, must be one like {UNITS[name]}") from error


def scaled(values: Array, name: str, unit: str, channel: Channel) -> Array:
    """The values (n,) of a column in SI units: as its `unit` says, or by the gain of its channel; raises ValueError."""
    if channel.gain is None:
        return in_si(values, name, unit) + channel.zero
    return values * (per_unit(unit, channel.unit) * channel.gain) + channel.zero


def per_unit(unit: str, wanted: str) -> float:
    """A column's unit in that of its scale; 1 where the file names none, or counts in words; raises ValueError."""
    unit = unit_of(unit) or unit
    if unit in ("", "-") or (not wanted and not physical(unit)):
        return 1.0
    try:
        return quantity(f"1 {unit}", wanted)
    except ValueError as error:
        raise ValueError(f"the file gives it in {printable(unit)}, its scale is per {wanted or 'count'}") from error


def physical(unit: str) -> bool:
    """Whether it is a unit at all."""
    try:
        parsed(unit)
    except ValueError:
        return False
    return True


def convert(
    raw: Raw, form: Format, notes: Notes, needed: Sequence[str] = tuple(EXAMPLES), window: tuple[float, float] = WHOLE
) -> Table | None:
    """The quantities of a record within a window of time [s], with findings on columns, units and cells.

    None if a needed column is missing. Cells outside the window are not looked at, but for the times.
    """
    notes.counted = raw.counted
    before = len(notes.findings)
    sources = chosen(raw, form, notes, needed)
    say_inferred(raw, form, dict(sources.values()), notes)
    rows = np.asarray(raw.rows, dtype=np.int64)
    columns: dict[str, Array] = {}
    headers = {name: header for name, (header, _) in sources.items()}
    if form.sample_rate is not None:
        if "time" in sources:
            notes.warning("not used, because sample_rate_Hz is given", headers["time"])
            del sources["time"]
        columns["time"], headers["time"] = np.arange(len(rows)) / form.sample_rate, "sample_rate_Hz"
    kept = np.arange(len(rows))
    for name in sorted([*columns, *sources], key=lambda name: name != "time"):
        if name in sources and (values := column(raw, name, sources[name], form, kept=kept, notes=notes)) is not None:
            columns[name] = values
        if name == "time" and name in columns and window != WHOLE:
            kept = inside(columns["time"], window, headers["time"], notes)
            columns["time"] = columns["time"][kept]
    missing(raw, form, sources, columns, needed=needed, failed=len(notes.findings) > before, notes=notes)
    if len(rows) < 2:
        notes.error(f"{len(rows)} samples, at least 2 are needed")
    if len(kept) < 2:
        return None
    ordered = {name: columns[name] for name in UNITS if name in columns}
    return Table(ordered, headers, rows[kept]) if set(needed) <= set(columns) else None


def inside(time: Array, window: tuple[float, float], header: str, notes: Notes) -> NDArray[np.int64]:
    """The samples within a window of time [s]."""
    kept = np.flatnonzero((time >= window[0]) & (time <= window[1]))
    if len(kept) < 2:
        span = f"{np.nanmin(time):g} to {np.nanmax(time):g} s" if np.isfinite(time).any() else "no time at all"
        notes.error(f"{len(kept)} samples for start_s = {window[0]:g} to end_s = {window[1]:g}; the file has {span}", header)
    return kept


def column(raw: Raw, name: str, source: Source, form: Format, *, kept: NDArray[np.int64], notes: Notes) -> Array | None:
    """The samples `kept` (n,) of a column in SI units; None with a finding where there are none."""
    header, name_in_file = source
    values, rows = raw.columns[name_in_file], np.asarray(raw.rows, dtype=np.int64)
    if len(values) != len(rows):
        notes.error(f"{len(values)} samples where another column of the file has {len(rows)}", header)
        return None
    if len(kept) < len(rows):
        values, rows = values[kept] if isinstance(values, np.ndarray) else [values[i] for i in kept], rows[kept]
    try:
        if name == "time" and any(is_stamp(cell) for cell in values[:1]):
            return stamped(values, header, rows, notes)
        channel = form.channels.get(name, AS_STATED)
        carried, stated = raw.units.get(name_in_file, ""), split_header(header)[1]
        decimal = raw.decimal or form.decimal
        if name == "temperature":
            read = slow_cells(values, header, rows, decimal, notes)
        else:
            read = cells(values, header, rows, decimal, notes, empty=raw.nothing)
        numbers = scaled(read, name, stated or carried, channel)
        if channel.gain is None and carried and stated and not equal_units(name, carried, stated):
            notes.error(f"the file gives {shown(name_in_file)} in {printable(carried)}, not in {stated}", header)
    except ValueError as error:
        notes.error(str(error), header)
        return None
    return numbers


def stamped(values: Sequence[str], header: str, rows: NDArray[np.int64], notes: Notes) -> Array:
    """Seconds (n,) of times of day or date-time stamps; raises ValueError."""
    numbers = seconds(values)
    bad = ~np.isfinite(numbers)
    if where := notes.places(bad, rows):
        wrong = values[int(np.argmax(bad))]
        notes.error(f"{shown(wrong)} is no time like {shown(values[0])}{where.tail}", header, where.first)
    return numbers


def missing(
    raw: Raw,
    form: Format,
    sources: dict[str, Source],
    columns: dict[str, Array],
    *,
    needed: Sequence[str],
    failed: bool,
    notes: Notes,
) -> None:
    """Findings on needed quantities without a column; on those with one there is a finding already."""
    for name in needed:
        if name in columns or (name in sources and failed):
            continue
        refused = next((header for header in raw.refused if quantity_of(header) == name), None)
        if refused is not None:
            notes.error(f"no column {EXAMPLES[name]!r}, it holds {raw.refused[refused]}, must hold numbers", refused)
            continue
        there = listed(map(printable, raw.columns)) or "nothing"
        known = rising(raw, form.decimal) if name == "time" else list(raw.columns)
        hint = suggestion(name, [split_header(text)[0] for text in known])
        hint = hint or (f", did you mean {printable(known[0])}?" if name == "time" and known else "")
        rate = "; name it by `columns`" if raw.meant else ""
        rate = "; without times set sample_rate_Hz" if name == "time" and not hint else rate
        notes.error(f"no column {EXAMPLES[name]!r} among {there}{hint}{rate}", name)


def rising(raw: Raw, decimal: str) -> list[str]:
    """The columns whose first cells rise from each to the next, as times do."""
    whole = {name: values for name, values in raw.columns.items() if len(values) == len(raw.rows) > 2}
    return [name for name, values in whole.items() if np.all(np.diff(floats(values[:LOOK], decimal)) > 0.0)]


def chosen(raw: Raw, form: Format, notes: Notes, needed: Sequence[str]) -> dict[str, Source]:
    """The source of each quantity; one that is not needed has none where no row has a cell for it."""
    without = (*raw.empty, *raw.without)
    if isinstance(form.columns, dict):
        pairs = list(form.columns.items())
    else:
        carried = {name: f"{name} [{unit}]" for name, unit in raw.units.items() if not split_header(name)[1]}
        carried |= raw.meant
        pairs = [(carried.get(name, name), name) for name in raw.columns]
    named = {name: channel.column for name, channel in form.channels.items() if channel.column is not None}
    pairs = [pair for pair in pairs if quantity_of(pair[0]) not in named and pair[1] not in named.values()]
    sources: dict[str, Source] = {}
    unused = []
    for header, column in [*pairs, *((column, column) for column in named.values())]:
        name = quantity_of(header)
        if column in named.values():
            name = next(quantity for quantity, wanted in named.items() if wanted == column)
        if column in raw.refused:
            notes.error(f"{shown(column)} holds {raw.refused[column]}, must hold numbers", header)
        elif column not in raw.columns:
            there = listed(map(printable, raw.columns))
            notes.error(f"the file has no {shown(column)} but {there}{suggestion(column, raw.columns)}", header)
        elif name not in UNITS:
            unused += [shown(header)] if column not in without else []
        elif column in without and name not in needed:
            continue
        elif name in sources:
            notes.error(f"{name} is there already as {shown(sources[name][0])}", header)
        else:
            sources[name] = header, column
    if unused and sources and raw.counted == "row":
        notes.warning(f"not used: {listed(unused)}; used are {', '.join(UNITS)}")
    return sources


def equal_units(name: str, unit: str, other: str) -> bool:
    """Whether two units of a quantity are equal, also the mass and its weight where the weight is stated."""
    if name == "force" and is_mass(unit):
        return is_weight_of(other, unit)
    probe = np.array([1.0, 2.0])
    try:
        return bool(np.allclose(in_si(probe, name, unit), in_si(probe, name, other), rtol=1e-9, atol=0.0))
    except ValueError:
        return False
