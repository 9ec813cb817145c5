"""`channels` of dataset.toml: which column a quantity is in, and its scale and offset where that is in volts or counts."""

import re
from typing import Any

import numpy as np

from twintube.common.words import listed, shown
from twintube.dampers.damper import suggestion
from twintube.dampers.quantity import NUMBER, parsed
from twintube.data.convert.quantities import UNITS, in_si
from twintube.data.formats import Channel

KEYS = ("column", "scale", "offset")
NUMBER_AND_UNIT = re.compile(rf"\s*({NUMBER})\s*(.*?)\s*")
LONGEST = 200  # characters of a column's name


def good_channels(value: Any) -> bool:
    """Tables by name."""
    return isinstance(value, dict) and len(value) > 0 and all(isinstance(table, dict) for table in value.values())


def wrong_channels(tables: dict[str, dict[str, Any]]) -> list[str]:
    """What is wrong with the tables, each in a sentence."""
    messages = []
    for name, table in tables.items():
        if name not in UNITS:
            messages.append(f"unknown {shown(name)}{suggestion(name, UNITS)}; known are {', '.join(UNITS)}")
            continue
        try:
            channel(name, table)
        except ValueError as error:
            messages.append(f"{name}: {error}")
    return messages


def read_channels(tables: dict[str, dict[str, Any]]) -> dict[str, Channel]:
    """The channels by quantity; raises ValueError."""
    return {name: channel(name, table) for name, table in tables.items()}


def channel(name: str, table: dict[str, Any]) -> Channel:
    """A channel of a quantity; raises ValueError."""
    for key in table:
        if key not in KEYS:
            raise ValueError(f"unknown {shown(key)}{suggestion(key, KEYS)}; known are {listed(KEYS)}")
    if not table:
        raise ValueError(f"it is empty: must have {listed(KEYS)}, or some of them")
    column = table.get("column")
    if column is not None and not (isinstance(column, str) and 0 < len(column) <= LONGEST):
        raise ValueError(f"column = {shown(column)}: must be the name of a column")
    gain, unit, zero = None, "", 0.0
    if "scale" in table:
        gain, unit, zero = gain_of(name, table["scale"])
    if "offset" in table:
        zero = offset_of(name, table["offset"])
    return Channel(column, gain, unit, zero)


def parts(value: Any) -> tuple[float, str] | None:
    """Number and unit of a text like `500 N/V`."""
    match = NUMBER_AND_UNIT.fullmatch(value) if isinstance(value, str) and len(value) <= LONGEST else None
    return (float(match[1]), match[2]) if match else None


def gain_of(name: str, scale: Any) -> tuple[float, str, float]:
    """Gain [SI unit per unit], the unit in the file and the value at 0 there; raises ValueError."""
    wrong = f"scale = {shown(scale)}: must be like '500 {UNITS[name]}/V', a {name} per unit in the file, and not 0"
    written = parts(scale)
    if written is None or written[0] == 0.0:
        raise ValueError(wrong)
    number, unit = written
    whole, slash, per = unit.rpartition("/")
    for numerator, denominator in ((unit, ""), (whole, per.strip()) if slash else (unit, "")):
        try:
            zero, step = (float(x) for x in in_si(np.array([0.0, 1.0]), name, numerator.strip()))
            parsed(denominator)
        except ValueError:
            continue
        return number * (step - zero), denominator, zero
    raise ValueError(wrong)


def offset_of(name: str, offset: Any) -> float:
    """What is added to a quantity [its unit of UNITS]; raises ValueError."""
    written = parts(offset)
    unit = written[1] if written else ""
    if written is None or (name == "temperature" and unit not in ("degC", "°C")):
        raise ValueError(f"offset = {shown(offset)}: must be a {name} with its unit like '-12 {UNITS[name]}'")
    try:
        return float(in_si(np.array([written[0]]), name, unit)[0])
    except ValueError as error:
        raise ValueError(f"offset = {shown(offset)}: {error}") from error
