"""The fill of the damper in each record: what dataset.toml states, and which records are of the same filling.

Records with the same `state` are of one filling: what one of them states holds for those that say "unknown". Without
that key records that state the same are, and unknown ones that follow each other in dataset.toml. A filling that served
as a reference is kept apart from the one after it: it may have changed.
"""

import itertools
import math
from collections.abc import Sequence
from dataclasses import replace

from twintube.common.words import listed, shown
from twintube.dampers import Damper
from twintube.data.dataset_toml.manifest import Entry
from twintube.data.findings import Notes

PARTS = ("oil_level", "gas_preload", "gas_pressure")  # what a filling is made of
ROUNDING = 1e-9  # of a level that is a quotient of two volumes
NAMED = 5  # files of a list


def fills(entries: Sequence[Entry], damper: Damper | None, notes: Notes) -> list[Entry]:
    """The entries with their oil level where it is stated, and each with its `state`; findings on what contradicts."""
    return stated([levelled(entry, damper, notes) for entry in entries], notes)


def levelled(entry: Entry, damper: Damper | None, notes: Notes) -> Entry:
    """With the oil level where a volume is stated."""
    if entry.oil_volume is None:
        return entry
    if damper is None:
        return replace(entry, complete=False)
    level = entry.oil_volume / damper.parameters.V_oil
    if level <= 1.0:
        return replace(entry, oil_level=level)
    most = damper.parameters.V_oil * 1e6
    message = f"{entry.where}oil_volume_mL = {entry.oil_volume * 1e6:g}: must be from 0 to {most:g} mL"
    message += f", the intact volume of {damper.name}"
    notes.error(message, "oil_volume_mL", entry.section.line_of("oil_volume_mL"))
    return replace(entry, complete=False)


def stated(entries: Sequence[Entry], notes: Notes) -> list[Entry]:
    """With what others of the same `state` say of its filling, and a name for each state."""
    filled = list(entries)
    for label in dict.fromkeys(entry.state for entry in entries if entry.state is not None):
        members = [i for i, entry in enumerate(entries) if entry.state == label and entry.complete]
        for part in PARTS:
            telling = [i for i in members if getattr(entries[i], part) is not None]
            for i in telling[1:]:
                if not agree(entries[telling[0]], entries[i], part, notes):
                    filled[i] = replace(filled[i], complete=False)
            for i in members if telling else ():
                filled[i] = replace(filled[i], **{part: getattr(entries[telling[0]], part)})
    return named(filled)


def agree(first: Entry, entry: Entry, part: str, notes: Notes) -> bool:
    """Whether two records of a state say the same of its filling; an error where they do not."""
    a, b = getattr(first, part), getattr(entry, part)
    if math.isclose(a, b, rel_tol=0.0, abs_tol=ROUNDING * max(1.0, a)):
        return True
    key = "oil_volume_mL" if part == "oil_level" and entry.oil_volume is not None else part
    message = f"{entry.where}{in_words(entry, part)} contradicts {in_words(first, part)} of {first.label}"
    message += f", both are of state = {shown(entry.state)}"
    notes.error(message, key, entry.section.line_of(key))
    return False


def in_words(entry: Entry, part: str) -> str:
    """What a record states of a part of its filling, with its key."""
    value = getattr(entry, part)
    if part == "gas_preload":
        return f"gas_preload = {str(value).lower()}"
    if part == "gas_pressure":
        return f"gas_pressure = {value / 1e5:g} bar"
    volume = entry.oil_volume
    return f"oil_level = {value:g}" if volume is None else f"oil_volume_mL = {volume * 1e6:g} (oil_level {value:.4g})"


def named(entries: Sequence[Entry]) -> list[Entry]:
    """With a `state` of their own where dataset.toml names none."""
    taken = {entry.state for entry in entries}
    free = (str(number) for number in itertools.count(1) if str(number) not in taken)
    made: dict[tuple[float | None, ...], str] = {}
    before: tuple[float | None, ...] | None = None  # the fill of the record before it, if that names no state
    whole = []
    for entry in entries:
        if entry.state is not None:
            whole.append(entry)
            before = None
            continue
        fill = entry.oil_level, entry.gas_preload, entry.gas_pressure, entry.reference
        if fill not in made or (is_unknown(entry) and fill != before):
            made[fill] = next(free)
        whole.append(replace(entry, state=made[fill]))
        before = fill
    return whole


def is_unknown(entry: Entry) -> bool:
    """Whether something of its filling is unknown."""
    return entry.oil_level is None or entry.gas_preload is None


def say_unknown(entries: Sequence[Entry], notes: Notes) -> None:
    """A remark that names what is unknown, of which records and in how many states."""
    some = [entry for entry in entries if entry.complete and is_unknown(entry)]
    if not some:
        return
    parts = []
    for state in dict.fromkeys(entry.state for entry in some):
        members = [entry for entry in some if entry.state == state]
        said = {"oil level": members[0].oil_level, "gas preload": members[0].gas_preload}
        what = " and ".join(word for word, value in said.items() if value is None)
        parts.append(f"{what} of {listed((entry.label for entry in members), NAMED)} (state {state})")
    message = f"unknown: {listed(parts, NAMED)}; records of one state are taken to be of one filling, see the key state"
    key = "oil_level" if some[0].oil_level is None else "gas_preload"
    notes.remark(message, key, some[0].section.line_of(key))
