"""ASAM MDF 4."""

import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from twintube.readers.columns import Columns, Request, UnreadableError

MOST_LISTED = 20  # channel groups in a message
QUANTITIES = ("time", "stroke", "force", "velocity", "temperature")
ELEMENT = re.compile(r"(.+)\[([0-9]{1,4})\]")  # of several channels of one name


def mdf(path: str, request: Request) -> Columns:
    """ASAM MDF: the channels named in `columns`, else those named as quantities; time is their master channel."""
    from asammdf import MDF

    columns = Columns()
    with MDF(path) as file:
        masters = {file.groups[group].channels[i].name for group, i in file.masters_db.items()}
        titles = [str(getattr(g.channel_group, "acq_name", "") or g.channel_group.comment or "")[:60] for g in file.groups]
        only = chosen_group(request["group"], titles)
        names = request["wanted"] or [name for name in file.channels_db if name.split(" [")[0] in QUANTITIES]
        signals, groups = {}, {}
        for name in dict.fromkeys(names):
            parts = ELEMENT.fullmatch(name)
            base, which = (parts[1], int(parts[2])) if parts and name not in file.channels_db else (name, None)
            if base in masters or base not in file.channels_db:
                continue
            group, index = place_of(base, which, file.channels_db[base], only, titles)
            columns.expect(name, file.groups[group].channel_group.cycles_nr)
            signals[name] = file.get(base, group=group, index=index, ignore_invalidation_bits=True)
            groups[name] = f"group {group} {titles[group]!r}" if titles[group] else f"group {group}"
    signals = {name: signal for name, signal in signals.items() if signal.samples.dtype.kind in "fiu"}
    if not signals:
        return columns
    first = next(iter(signals))
    time = signals[first].timestamps
    for name, signal in signals.items():
        if not np.array_equal(signal.timestamps, time):
            raise UnreadableError(
                f"channel {name!r} is not sampled at the times of channel {first!r}; nothing is resampled here "
                f"(they are in {groups[name]} and {groups[first]}; where one group holds all, set group)"
            )
        if signal.samples.ndim != 1:
            columns.refused[name] = f"an array of {signal.samples.ndim} dimensions"
            continue
        columns.values[name] = signal.samples
        if signal.invalidation_bits is not None and np.any(signal.invalidation_bits):
            columns.empty[name] = np.asarray(signal.invalidation_bits, dtype=bool)
            columns.nothing = "the sample is marked as invalid in the file; start_s and end_s cut a record"
        if signal.unit:
            columns.units[name] = str(signal.unit)[:60]
    for name in masters | {"time"}:
        columns.values[name] = time
        columns.units[name] = "s"
    return columns


def chosen_group(wanted: Any, titles: list[str]) -> int | None:
    """The number of the channel group that dataset.toml names; None where it names none. Raises UnreadableError."""
    if wanted is None:
        return None
    found = [i for i, title in enumerate(titles) if wanted in (i, title)]
    if len(found) != 1:
        why = "several channel groups of this name" if found else "no such channel group"
        raise UnreadableError(f"group = {wanted!r}: {why} among {listed_groups(range(len(titles)), titles)}")
    return found[0]


def place_of(
    name: str, which: int | None, places: Sequence[tuple[int, int]], only: int | None, titles: list[str]
) -> tuple[int, int]:
    """Group and index of a channel, or of the one numbered `which` in its group; raises UnreadableError."""
    own = [place for place in places if only in (None, place[0])]
    groups = sorted({group for group, _ in own or places})
    if not own:
        raise UnreadableError(f"channel {name!r} is not in group {only} but in {listed_groups(groups, titles)}")
    if len(groups) > 1:
        raise UnreadableError(
            f"channel {name!r} is in the groups {listed_groups(groups, titles)}: set group, name or number"
        )
    if (which is None and len(own) > 1) or (which is not None and which >= len(own)):
        raise UnreadableError(
            f"channel {name!r} is there {len(own)} times in group {listed_groups(groups, titles)}: "
            f"name one of them in `columns`, {name}[0] to {name}[{len(own) - 1}]"
        )
    return own[which or 0]


def listed_groups(groups: Sequence[int], titles: list[str]) -> str:
    """Channel groups by number and name."""
    named = [f"{i} {titles[i]!r}" if titles[i] else str(i) for i in groups[:MOST_LISTED]]
    return ", ".join(named) + (f" and {len(groups) - MOST_LISTED} more" if len(groups) > MOST_LISTED else "")
