"""Signals of a drive, as the car's bus shows them: read from text, Parquet and ASAM MDF 4.

One row per sample of the finest raster; a slower channel repeats its last value, as a bus logger writes it. Beside the
channels stands what is known of car, drive and sensors, and the truth where a simulation wrote the file (`labels`).
"""

import difflib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from twintube.common.arrays import Array, read_only
from twintube.common.reading import ReadError, check_regular
from twintube.common.words import listed, shown
from twintube.core.checks import outside
from twintube.dampers.damper import suggestion
from twintube.data.findings import UnreadableError
from twintube.data.formats import BINARY_BYTES, TEXT, TEXT_BYTES, Format, Raw
from twintube.data.read.binary import check_package, read_binary
from twintube.driving.channels import CHANNELS, SHEET, TIME
from twintube.driving.columns import BARE, UNIT_OF, channel_of, in_channels
from twintube.driving.sheet import joined
from twintube.driving.text import read_text
from twintube.errors import InputError

KEY = "twintube"  # of the metadata in Parquet; the attachment of an MDF file is KEY.json
PARTS = ("car", "drive", "channels", "labels")
WRITTEN = (".parquet", ".pq", ".mf4")
READ = (*WRITTEN, *TEXT)
STAMPS = "mM"  # kinds of numpy's times
GAP = 1.5  # usual sample intervals: a lost sample makes 2, a bus's jitter less than half of one more


@dataclass(frozen=True)
class Signals:
    """A drive: `time` (n,) [s], and `values` by channel name, (n,) each in the channel's unit.

    `car` is its data sheet, `drive` what is said of the drive, `channels` each sensor's sample interval and resolution, and
    `labels` the truth. Raises InputError where a required channel is missing or a value cannot be.
    """

    time: Array
    values: Mapping[str, Array]
    car: Mapping[str, Any] = field(default_factory=dict)
    drive: Mapping[str, Any] = field(default_factory=dict)
    channels: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    labels: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Check, and make read-only what all readers share."""
        check_names(self.values)
        check_time(self.time)
        for name, values in self.values.items():
            check_values(name, values, self.time)
        check_sheet(self.car)
        object.__setattr__(self, "time", read_only(self.time))
        object.__setattr__(self, "values", {name: read_only(values) for name, values in self.values.items()})

    def __len__(self) -> int:
        return len(self.time)

    @property
    def interval(self) -> float:
        """The sample interval of the raster [s]."""
        return usual_interval(self.time)

    def known(self) -> dict[str, Any]:
        """What stands beside the channels, by PARTS."""
        return {name: dict(getattr(self, name)) for name in PARTS}


def check_names(values: Mapping[str, Any]) -> None:
    """Raise InputError for a required channel that is missing, with the nearest name that is there, and for unknown ones."""
    others = [name for name in values if name not in CHANNELS]
    missing = [name for name, channel in CHANNELS.items() if channel.required and name not in values]
    if missing:
        raise InputError(f"missing: {listed([with_nearest(name, others) for name in missing], 5)}")
    if others:
        raise InputError(f"unknown channel {shown(others[0])}{suggestion(others[0], CHANNELS)}")


def with_nearest(name: str, others: Sequence[str]) -> str:
    """A missing name, with the one of `others` that is most like it."""
    near = difflib.get_close_matches(name, others, n=1)
    return f"{name} (the file has {shown(near[0])})" if near else name


def usual_interval(time: Array) -> float:
    """The median of the sample intervals [s]."""
    return float(np.median(np.diff(time)))


def check_time(time: Array) -> None:
    """Raise InputError unless the times [s] are finite, increase, and leave no gap."""
    if len(time) < 2:
        raise InputError(f"{TIME}: {len(time)} samples, at least 2 are needed")
    if not np.all(np.isfinite(time)):
        raise InputError(f"{TIME}, sample {int(np.argmin(np.isfinite(time))) + 1}: must be a number")
    steps = np.diff(time)
    if steps.min() <= 0.0:
        i = int(np.argmin(steps > 0.0))
        raise InputError(
            f"{TIME}, sample {i + 2}: {time[i + 1]:.6g} s after {time[i]:.6g} s: the times must increase; where a clock "
            "jumps, cut the file there"
        )
    usual = usual_interval(time)
    if steps.max() > GAP * usual:
        i = int(np.argmax(steps > GAP * usual))
        raise InputError(
            f"{TIME}, sample {i + 2}: a gap of {steps[i]:.3g} s after {time[i]:.6g} s: must be at most {GAP:g} times the "
            f"usual {usual:.3g} s; cut the file there, or make the raster even with `twintube join`"
        )


def check_values(name: str, values: Array, time: Array) -> None:
    """Raise InputError unless the values of a channel are as many as the times and within its range."""
    if np.shape(values) != np.shape(time):
        raise InputError(f"{name}: {np.size(values)} values for {len(time)} samples")
    channel = CHANNELS[name]
    wrong = ~((values >= channel.lower) & (values <= channel.upper))
    if wrong.any():
        i = int(np.argmax(wrong))
        message = outside(name, float(values[i]), channel.lower, channel.upper, channel.unit)
        raise InputError(f"time {time[i]:.6g} s: {message}")


def check_sheet(car: Mapping[str, Any]) -> None:
    """Raise InputError where a length of the car's data sheet is none."""
    for name, (lower, upper) in SHEET.items():
        value = car.get(name, lower)
        if type(value) not in (int, float):
            raise InputError(f"car.{name} = {shown(value)}: must be a number")
        if message := outside(f"car.{name}", float(value), lower, upper, "m"):
            raise InputError(message)


def read(path: str | Path, car: Mapping[str, Any] | None = None) -> Signals:
    """The signals of a file in one of READ; `car` is the data sheet [m] where the file has none. Raises InputError, OSError.

    Columns beside CHANNELS are left out: a logger writes more than is asked for.
    """
    path = Path(path)
    try:
        return assembled(found_in(path), car or {})
    except (ReadError, UnreadableError, ValueError) as error:
        raise InputError(f"{path.name}: {error}") from error


def from_frame(frame: Mapping[str, Any], car: Mapping[str, float]) -> Signals:
    """The signals of a table of pandas, or of any mapping of columns by name; `car` is its data sheet [m].

    Names and units are those of a file; times may be stamps, and stand in the index. Raises InputError.
    """
    columns = {str(name): np.asarray(frame[name]) for name in frame}
    if (index := getattr(frame, "index", None)) is not None and TIME not in map(named, columns):
        columns[TIME if np.asarray(index).dtype.kind in STAMPS else str(index.name)] = np.asarray(index)
    found = {}
    for name, values in columns.items():
        if named(name) == TIME and values.dtype.kind in STAMPS:
            found[TIME] = (values - values[0]) / np.timedelta64(1, "s")
        elif named(name) and values.dtype.kind not in "fiu":
            raise InputError(f"{name}: {values.dtype.name}: must be numbers")
        elif named(name):
            found[name] = values
    return assembled(Found(found, {}, list(columns)), car)


@dataclass(frozen=True)
class Found:
    """Columns of channels by their names in a file, units beside these names, all names, and the text beside the columns."""

    columns: Mapping[str, Array]
    units: Mapping[str, str]
    names: Sequence[str]
    text: str = "{}"


def named(header: str) -> str:
    """The channel of a column; empty for a column of something else."""
    return (channel_of(header) or ("",))[0]


def assembled(found: Found, car: Mapping[str, Any]) -> Signals:
    """Signals of what a file holds; raises InputError."""
    known = known_of(found.text)
    sheet = joined(known["car"], car)
    values = in_channels(found.columns, found.units, sheet)
    if TIME not in values:
        raise InputError(f"missing: {with_nearest(TIME, found.names)}")
    time = values.pop(TIME)
    if any(channel.required and name not in values for name, channel in CHANNELS.items()):
        check_names(dict.fromkeys([*values, *(name for name in found.names if not named(name))]))
    return Signals(time, values, **{**known, "car": sheet})


def found_in(path: Path) -> Found:
    """What a file in one of READ holds; raises InputError, OSError."""
    check_suffix(path, READ)
    is_text = path.suffix.lower() in TEXT
    check_regular(path, TEXT_BYTES if is_text else BINARY_BYTES)
    return (of_text if is_text else of_binary)(path)


def of_text(path: Path) -> Found:
    """The columns of a text file."""
    return Found(*read_text(path))


def of_binary(path: Path) -> Found:
    """The columns of a Parquet or MDF 4 file; raises UnreadableError."""
    check_package(path)
    mdf = path.suffix.lower() == ".mf4"
    raw = next(read_binary([(path, Format(columns={name: name for name in (*UNIT_OF, *BARE)} if mdf else None))]))
    if isinstance(raw, UnreadableError):
        raise raw
    # After the reader's process took the file without harm, this one may open it.
    names, text = about_mdf(path) if mdf else (list(raw.columns), about_parquet(path))
    if wrong := next(filter(named, raw.refused), ""):
        raise InputError(f"{wrong}: {raw.refused[wrong]}: must be numbers")
    return Found({name: numbers(raw, name) for name in filter(named, raw.columns)}, raw.units, names, text)


def check_suffix(path: Path, suffixes: Sequence[str] = WRITTEN) -> None:
    """Raise InputError for a file of another format."""
    if path.suffix.lower() not in suffixes:
        raise InputError(f"the ending {path.suffix or 'of its name'}: must be one of {', '.join(suffixes)}")


def numbers(raw: Raw, name: str) -> Array:
    """A column as numbers; raises InputError where a cell holds none."""
    column = raw.columns[name]
    for i, value in enumerate(column) if isinstance(column, list) else ():
        if not isinstance(value, int | float):
            raise InputError(f"{name}, sample {i + 1}: {'no value' if value is None else shown(value)}: must be a number")
    return np.asarray(column, dtype=float)


def about_parquet(path: Path) -> str:
    """The text beside the columns."""
    import pyarrow.parquet as pq

    return str((pq.read_schema(path).metadata or {}).get(KEY.encode(), b"{}").decode("utf-8", "replace"))


def about_mdf(path: Path) -> tuple[list[str], str]:
    """The names of all channels, and the text beside them."""
    from asammdf import MDF

    with MDF(path) as file:
        texts = [item for item in file.attachments if str(item.file_name) == f"{KEY}.json"]
        return list(file.channels_db), texts[0].extract().decode("utf-8", "replace") if texts else "{}"


def known_of(text: str) -> dict[str, dict[str, Any]]:
    """What a file says of PARTS; raises InputError unless each is a table."""
    try:
        content = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise InputError(f"metadata {KEY}: not JSON ({error})") from error
    if not isinstance(content, dict):
        raise InputError(f"metadata {KEY}: must be a table, not {shown(content)}")
    parts = {name: content.get(name, {}) for name in PARTS}
    for name, part in parts.items():
        if not isinstance(part, dict):
            raise InputError(f"metadata {KEY}, {name}: must be a table, not {shown(part)}")
    return parts
