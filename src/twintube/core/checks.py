"""Checks of a parameter set and of inputs, as messages: bounds from the table, rules from `consistency.py`.

Standard library only: the Python FMU carries it. Every message names the quantity, its value and the allowed range.
"""

import math
import sys
from collections.abc import Callable, Iterator
from dataclasses import Field, fields
from functools import cache
from typing import Any

from twintube.core import messages
from twintube.core.consistency import Violation, curve_rule, fit_rule
from twintube.core.effects import Parameters
from twintube.core.frame import stroke_limit
from twintube.core.kernel import prepare
from twintube.core.variables import Derived, Inputs, blank, fmi_name

LARGEST = sys.float_info.max  # within it a number is finite
INPUTS = {item.name: item.metadata for item in fields(Inputs)}
VELOCITY, TEMPERATURE = INPUTS["velocity"], INPUTS["temperature"]
KELVIN = 273.15  # [K] at 0 degC


def outside(name: str, value: float, lower: float | None, upper: float | None, unit: str) -> str:
    """A message if `value` is not finite or not within [lower, upper], else an empty string."""
    low = -math.inf if lower is None else lower
    high = math.inf if upper is None else upper
    if math.isfinite(value) and low <= value <= high:
        return ""
    return messages.outside(name, value, low, high, unit)


def out_of_range(item: Field[Any], value: float) -> str:
    """A message if `value` is beyond the bounds of a variable of the table, else an empty string."""
    return outside(fmi_name(item), value, item.metadata["lower"], item.metadata["upper"], item.metadata["unit"])


@cache
def bounds(record: type) -> tuple[tuple[Field[Any], float, float], ...]:
    """The fields of a record of the table, each with the least and the largest number that it may hold."""
    return tuple(
        (item, -LARGEST if item.metadata["lower"] is None else item.metadata["lower"],
         LARGEST if item.metadata["upper"] is None else item.metadata["upper"])
        for item in fields(record)
    )  # fmt: skip


def out_of_bounds(p: Parameters) -> list[str]:
    """Messages for every parameter beyond its bounds in the table, of an array for the first value that is."""
    texts = []
    kind: type = type(p)
    for item, low, high in bounds(kind):
        value = getattr(p, item.name)
        for number in value if item.metadata["size"] > 1 else (value,):
            if not low <= number <= high:
                texts.append(out_of_range(item, number))
                break
    return texts


def broken(rule_after: Callable[[int, Violation], int]) -> Iterator[str]:
    """Messages for all rules that are broken; `rule_after` gives the number of the next after a number."""
    violation: Violation = blank(Violation)
    rule = rule_after(0, violation)
    while rule > 0:
        yield messages.broken_rule(rule, violation.point, violation.value, violation.limit)
        rule = rule_after(rule, violation)


def problems(p: Parameters) -> list[str]:
    """All messages about a parameter set; an empty list if it is admissible."""
    texts = [*broken(lambda after, violation: curve_rule(p, after, violation)), *out_of_bounds(p)]
    if texts:
        return texts
    d: Derived = blank(Derived)
    return list(broken(lambda after, violation: fit_rule(p, d, after, violation)))


def tube_limit(p: Parameters) -> float:
    """The stroke limit [m] of a parameter set."""
    d: Derived = blank(Derived)
    prepare(p, d)
    return stroke_limit(d)


def bad_input(stroke: float, velocity: float, limit: float) -> str:
    """A message if the piston would leave the tube or an input is not a number in its range, else an empty string."""
    return outside("stroke", stroke, -limit, limit, "m") or outside(
        "velocity", velocity, VELOCITY["lower"], VELOCITY["upper"], "m/s"
    )
