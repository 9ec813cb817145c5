"""Times of day, date-time stamps, minutes and seconds as a recorder writes them, in seconds since the first."""

import re
from collections.abc import Sequence
from datetime import date

import numpy as np

from twintube.common.arrays import Array
from twintube.common.words import shown

DAY, HOUR = 86400.0, 3600.0  # [s]
STAMP = re.compile(
    r"""\s*(?:(?P<date>\d{4}[-/.]\d{1,2}[-/.]\d{1,2}|\d{1,2}\.\d{1,2}\.(?:\d{4}|\d{2})
    |\d{1,2}-[a-z]{3}-\d{4}|\d{1,2}/\d{1,2}/(?:\d{4}|\d{2}))[T\s]\s*)?
    (?P<hour>\d{1,2}):(?P<minute>\d{2}):(?P<second>\d{2})(?:[.,:](?P<fraction>\d+))?
    \s*(?P<half>[ap]m)?\s*(?P<zone>Z|UTC|[+-]\d{2}:?\d{2})?\s*""",
    re.VERBOSE | re.ASCII | re.IGNORECASE,
)
MINUTES = re.compile(r"\s*(?P<minute>\d{1,3}):(?P<second>\d{2})(?:[.,](?P<fraction>\d+))?\s*", re.ASCII)
PARTS = re.compile(r"[-/.]")
# Of 13-May-2026, as MATLAB writes a date
MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")


def is_stamp(cell: object) -> bool:
    """Whether a cell holds a time of day, with a date or without, or minutes and seconds."""
    return isinstance(cell, str) and (STAMP.fullmatch(cell) or MINUTES.fullmatch(cell)) is not None


def seconds(cells: Sequence[str]) -> Array:
    """Seconds (n,) since the first stamp, NaN where a cell is not one.

    Without dates a step back by more than half a day is midnight; where all cells are minutes and seconds, one by more than
    half an hour is the full hour. Raises ValueError where dates with a slash differ and day and month cannot be told
    apart, and where `12:30` may be hours and minutes.
    """
    parts = [STAMP.fullmatch(cell) or MINUTES.fullmatch(cell) for cell in cells]
    short = [part for part in parts if part and part.re is MINUTES]
    if short and len(short) == sum(map(bool, parts)) and not any(part["fraction"] for part in short):
        raise ValueError(f"{shown(short[0].group())} may be hours and minutes, or minutes and seconds: set sample_rate_Hz")
    numbers = days({part["date"] for part in parts if part and part.re is STAMP and part["date"]})
    times = np.array([np.nan if part is None else of_day(part, numbers) for part in parts])
    if not numbers:
        known = np.flatnonzero(np.isfinite(times))
        turn = HOUR if short and len(short) == len(known) else DAY
        times[known[1:]] += turn * np.cumsum(np.diff(times[known]) < -turn / 2)
    first = times[np.isfinite(times)]
    return np.round(times - first[0], 9) if len(first) else times


def of_day(part: re.Match[str], numbers: dict[str, int]) -> float:
    """A stamp [s] on the scale of all stamps with its kind of date; NaN where there is no such time."""
    if part.re is MINUTES:
        minute, second = int(part["minute"]), int(part["second"])
        return np.nan if numbers or second > 59 else minute * 60 + second + float(f"0.{part['fraction'] or 0}")
    hour, minute, second = (int(part[name]) for name in ("hour", "minute", "second"))
    if part["half"]:
        hour = hour % 12 + 12 * (part["half"].lower() == "pm")
    if hour > 23 or minute > 59 or second > 60 or (part["date"] is None) != (not numbers):
        return np.nan
    day = numbers.get(part["date"] or "", 0)
    zone = (part["zone"] or "").replace(":", "")
    ahead = (int(zone[1:3]) * 60 + int(zone[3:5])) * (1 if zone[0] == "+" else -1) if zone[:1] in {"+", "-"} else 0
    return day * DAY + hour * 3600 + (minute - ahead) * 60 + second + float(f"0.{part['fraction'] or 0}")


def days(dates: set[str]) -> dict[str, int]:
    """The number of each day since the first; raises ValueError."""
    readings = [reading for order in ("dmy", "mdy") if (reading := numbered(dates, order)) is not None]
    if not readings:
        raise ValueError(f"{shown(min(dates))} is not a date")
    spans = [max(reading.values(), default=0) for reading in readings]
    if len(set(spans)) > 1:
        raise ValueError(f"{shown(min(dates))} and {shown(max(dates))}: day or month first? set sample_rate_Hz")
    return readings[0]


def numbered(dates: set[str], order: str) -> dict[str, int] | None:
    """The number of each day since the first, with the slashed ones in this order; None where one does not exist."""
    ordinals = {}
    for text in dates:
        try:
            a, b, c = (int(x) if x.isdigit() else MONTHS.index(x.lower()) + 1 for x in PARTS.split(text))
            year, month, day = (a, b, c) if a > 99 else (c if c > 99 else 2000 + c, b, a)
            if order == "mdy" and "/" in text and a <= 99:
                month, day = day, month
            ordinals[text] = date(year, month, day).toordinal()
        except ValueError:  # no such month, or no such day in it
            return None
    first = min(ordinals.values(), default=0)
    return {text: number - first for text, number in ordinals.items()}
