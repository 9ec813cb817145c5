"""One drive of several files, or of an uneven raster: each channel has times of its own, the drive has one even raster.

Between its samples a channel is a straight line; a channel that is slower than the raster so is smooth where a bus logger
would repeat its last value.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np

from twintube.common.arrays import Array
from twintube.common.reading import ReadError
from twintube.data.findings import UnreadableError
from twintube.driving.channels import CHANNELS, PLACES, TIME, channel_name
from twintube.driving.columns import in_channels
from twintube.driving.sheet import joined as same_car
from twintube.driving.signals import Signals, check_names, found_in, known_of, with_nearest
from twintube.driving.spectra import HOP
from twintube.errors import InputError

# A wheel's channel must have two samples in a period of wheel hop; the others only say how the car is driven.
GAPS: Final = {True: 0.5 / HOP[1], False: 0.5}  # [s] at most, of wheels and body, and of all else
SHARED: Final = 0.9  # of the shorter file: else the files are of two drives, or of two clocks


def channel_of_hop(name: str) -> bool:
    """Whether a channel must show wheel hop."""
    return name.startswith(("wheel", "body"))


def checked_times(time: Array, names: Sequence[str]) -> None:
    """Raise InputError with the place where a clock steps back, stands or leaves a gap."""
    if len(time) < 2 or not np.all(np.isfinite(time)):
        raise InputError(f"{TIME}: {len(time)} samples: must be 2 or more numbers")
    steps = np.diff(time)
    most = GAPS[any(map(channel_of_hop, names))]
    wrong = (steps <= 0.0) | (steps > most)
    if wrong.any():
        i = int(np.argmax(wrong))
        what = "a gap, or a clock that jumps" if steps[i] > most else "a clock that steps back"
        raise InputError(
            f"{TIME}, sample {i + 2}: {time[i + 1]:.6g} s after {time[i]:.6g} s, {what}: the times must increase by at most "
            f"{1e3 * most:.3g} ms; cut the file there"
        )


def part(path: Path, car: Mapping[str, Any]) -> tuple[dict[str, Array], dict[str, Any]]:
    """The channels of a file with its times, and its data sheet; raises InputError, OSError."""
    try:
        found = found_in(path)
        sheet = same_car(known_of(found.text)["car"], car)
        values = in_channels(found.columns, found.units, sheet)
        if TIME not in values:
            raise InputError(f"missing: {with_nearest(TIME, found.names)}")
        if len(values) < 2:
            raise InputError(f"none of its columns is a channel: {', '.join(found.names)[:80]}")
        checked_times(values[TIME], list(values))
    except (ReadError, UnreadableError, ValueError) as error:
        raise InputError(f"{path.name}: {error}") from error
    return values, sheet


def check_one_clock(spans: Mapping[str, tuple[float, float]]) -> None:
    """Raise InputError where files hardly run at the same time."""
    begin, end = max(a for a, _ in spans.values()), min(b for _, b in spans.values())
    shortest = min(b - a for a, b in spans.values())
    if end - begin < SHARED * shortest:
        said = "; ".join(f"{name} from {a:.6g} to {b:.6g} s" for name, (a, b) in spans.items())
        raise InputError(f"{said}: must be of one drive and one clock, and share {SHARED:.0%} of the shorter one")


def join(paths: Sequence[Path], car: Mapping[str, Any] | None = None) -> Signals:
    """The drive whose channels stand in several files, each with times of its own; raises InputError, OSError."""
    where: dict[str, str] = {}
    parts: dict[str, dict[str, Array]] = {}
    sheet: dict[str, Any] = dict(car or {})
    for path in paths:
        values, sheet = part(path, sheet)
        for name in values:
            if name != TIME and name in where:
                raise InputError(f"{name}: is in {where[name]} and in {path.name}: must be in one file")
            where[name] = path.name
        parts[path.name] = values
    if len(parts) < len(paths):
        raise InputError(f"{', '.join(path.name for path in paths)}: must have different names")
    check_names({name: () for name in where if name in CHANNELS})
    check_one_clock({name: (float(each[TIME][0]), float(each[TIME][-1])) for name, each in parts.items()})
    # The raster is that of the wheel speeds, whose mean a bus keeps while its messages jitter.
    wheels = parts[where[channel_name("speed", PLACES[0])]][TIME]
    interval = float(wheels[-1] - wheels[0]) / (len(wheels) - 1)
    begin, end = (pick(each[TIME][i] for each in parts.values()) for pick, i in ((max, 0), (min, -1)))
    time = np.arange(int((end - begin) / interval) + 1) * interval
    values = {
        name: np.interp(begin + time, each[TIME], column)
        for each in parts.values()
        for name, column in each.items()
        if name != TIME
    }
    return Signals(time, values, sheet)
