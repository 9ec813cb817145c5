"""Quantities with units, `"29.8 mm"`, as SI numbers."""

from functools import cache
from typing import Any

import pint

PINT_UNITS = {"m2": "m**2", "m3": "m**3", "1": "dimensionless"}


def quantity(value: Any, unit: str) -> float:
    """SI value of `"29.8 mm"` or of a plain SI number; raises ValueError."""
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        raise ValueError(f"{value!r} is no number and no quantity like '29.8 mm'")
    if isinstance(value, (int, float)):
        return float(value)
    try:
        converted = float(registry().Quantity(value).to(PINT_UNITS.get(unit, unit)).magnitude)
        return float(f"{converted:.15g}")  # 13 mm are 0.013 m, not 0.013000000000000001 m
    except (pint.PintError, TypeError, AttributeError, AssertionError) as error:
        raise ValueError(f"{value!r} is no quantity in {unit} ({error})") from error


@cache
def registry() -> Any:
    """Pint's units, made once because it takes a while."""
    return pint.UnitRegistry()
