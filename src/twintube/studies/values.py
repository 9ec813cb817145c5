"""Lists of numbers and names in a study file, with bounds on how many there are."""

import math
from collections import Counter
from typing import Any

import numpy as np

from twintube.common.words import listed, shown
from twintube.core.checks import outside
from twintube.dampers.quantity import quantity
from twintube.studies.definition import FIELDS

MAX_VALUES = 10_000  # of one list
MAX_FILES = 1_000  # dampers or records


def numbers(raw: Any, unit: str) -> list[float]:
    """The SI values of a list, a single value or `{from, to, count}`; raises ValueError."""
    if isinstance(raw, dict):
        if set(raw) != {"from", "to", "count"}:
            raise ValueError(f"a range has the keys from, to and count, not {listed(raw, 5) or 'none'}")
        count = raw["count"]
        if type(count) is not int or not 1 <= count <= MAX_VALUES:
            raise ValueError(f"count = {shown(count)}: must be an integer from 1 to {MAX_VALUES}")
        low, high = quantity(raw["from"], unit), quantity(raw["to"], unit)
        if not (math.isfinite(low) and math.isfinite(high)):
            raise ValueError(f"from = {low:g}, to = {high:g}: must be finite")
        values = [float(f"{x:.15g}") for x in np.linspace(low, high, count)]  # 0.3, not 0.30000000000000004
    else:
        listing = raw if isinstance(raw, list) else [raw]
        if len(listing) > MAX_VALUES:
            raise ValueError(f"{len(listing)} values, at most {MAX_VALUES} are possible")
        values = [quantity(value, unit) for value in listing]
    if not values:
        raise ValueError("the list is empty, so there would be no case")
    repeated = [x for x, count in Counter(values).items() if count > 1]
    if repeated:
        raise ValueError(f"a value stands in the list twice: {repeated[0]:g}")
    return values


def strings(raw: Any) -> list[str]:
    """A list of names without repetition; raises ValueError."""
    names = [raw] if isinstance(raw, str) else raw
    if not isinstance(names, list) or not names or not all(isinstance(name, str) and name for name in names):
        raise ValueError("must be a list of at least one string")
    if len(names) > MAX_FILES:
        raise ValueError(f"{len(names)} names, at most {MAX_FILES} are possible")
    for name, count in Counter(names).items():
        if count > 1:
            raise ValueError(f"{name} stands in the list twice")
    return names


def bounded(name: str, raw: Any, unit: str, *, lower: float | None, upper: float | None, integer: bool) -> list[float]:
    """The values of an axis within their bounds; raises ValueError."""
    try:
        values = numbers(raw, unit)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from error
    for value in values:
        message = outside(name, value, lower, upper, unit)
        if message:
            raise ValueError(message)
        if integer and value != int(value):
            raise ValueError(f"{name} = {value:g}: must be an integer")
    return [int(value) for value in values] if integer else values


def flattened(table: dict[str, Any], prefix: str = "") -> dict[str, Any]:
    """`{"foam": {"B": x}}`, which TOML makes of an unquoted `foam.B`, as `{"foam.B": x}`."""
    flat: dict[str, Any] = {}
    for key, value in table.items():
        if isinstance(value, dict) and set(value) != {"from", "to", "count"} and prefix + key not in FIELDS:
            flat |= flattened(value, f"{prefix}{key}.")
        else:
            flat[prefix + key] = value
    return flat
