"""Records that show the damper as it was: whole ones, and the parts of long ones."""

from collections.abc import Sequence

from twintube.common.arrays import Array
from twintube.common.words import listed
from twintube.data.check.quality import Mask, within
from twintube.data.check.values import FEWEST_SAMPLES
from twintube.data.convert.quantities import WHOLE
from twintube.data.dataset_toml.manifest import Entry
from twintube.data.findings import Notes

NAMED = 5  # files of a list


def check_references(entries: Sequence[Entry], notes: Notes) -> None:
    """A remark that names the records of the reference, and a warning where there are no others."""
    whole = [entry for entry in entries if entry.reference]
    parts = [entry for entry in entries if entry.reference_window]
    if entries and len(whole) == len(entries):
        message = "reference = true in every record: no change can be named, the damper is compared with the model alone"
        notes.warning(message, "reference", whole[0].section.line_of("reference"))
    elif whole or parts:
        first = min(whole + parts, key=entries.index)
        key = "reference" if first.reference else "reference_s"
        names = listed([*(entry.label for entry in whole), *map(part_of, parts)], NAMED)
        notes.remark(f"reference: {names}", key, first.section.line_of(key))


def part_of(entry: Entry) -> str:
    """A record and the part of it that is a reference, in words."""
    low, high = entry.reference_window or WHOLE
    return f"{entry.label} from {low:g} to {high:g} s"


def check_part(entry: Entry, time: Array, usable: Mask, notes: Notes) -> bool:
    """Whether the part of a record that is its reference, and the rest of it, hold enough to compare; else an error."""
    if entry.reference_window is None:
        return True
    low, high = entry.reference_window
    part = within(time, [entry.reference_window])
    for mask, what in ((part, "in it"), (~part, "beside it; a whole record has reference = true")):
        count = int((mask & usable).sum())
        if count < FEWEST_SAMPLES:
            message = f"{entry.where}reference_s = [{low:g}, {high:g}]: {count} usable samples are {what}, the record goes "
            message += f"from {time[0]:g} to {time[-1]:g} s"
            notes.error(message, "reference_s", entry.section.line_of("reference_s"))
            return False
    return True
