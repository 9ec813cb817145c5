"""Quantities with units, `"29.8 mm"`, as SI numbers.

Pint evaluates what it parses, also `9**9**9`. It sees only names of units, multiplication, division and small exponents.
"""

import re
from functools import cache, lru_cache
from typing import Any

import pint

from twintube.common.words import shown

LONGEST = 60  # characters of a quantity
MOST_TOKENS = 20
NUMBER = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
QUANTITY = re.compile(rf"\s*({NUMBER})(?![.,\w]*[0-9])\s*(.*?)\s*", re.DOTALL)
TOKEN = re.compile(
    r"\s*(?:(?P<name>%|°?[^\W\d_][^\W\d]*)|(?P<power>(?:\*\*|\^)\s*[+-]?[0-9](?![0-9.])|(?<!\s)[0-9](?![0-9.])|[²³])"
    r"|(?P<operator>[*/.·])|(?P<open>\()|(?P<close>\)))\s*"
)
SUPERSCRIPTS = {"²": "2", "³": "3"}


def quantity(value: Any, unit: str) -> float:
    """SI value of `"29.8 mm"` or of a plain SI number; raises ValueError. A plain number may be infinite or NaN."""
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        raise ValueError(f"{shown(value)} is not a number and not a quantity like '29.8 mm'")
    if isinstance(value, (int, float)):
        try:
            return float(value)
        except OverflowError as error:
            raise ValueError(f"{shown(value)} is too large") from error
    parts = QUANTITY.fullmatch(value) if len(value) <= LONGEST else None
    if parts is None:
        raise ValueError(f"{shown(value)} is not a quantity in {unit}: must be one number and its unit, like '29.8 mm'")
    try:
        converted = float(registry().Quantity(float(parts[1]), parsed(parts[2])).to(parsed(unit)).magnitude)
    except (pint.PintError, ValueError, OverflowError) as error:
        raise ValueError(f"{shown(value)} is not a quantity in {unit} ({error})") from error
    return float(f"{converted:.15g}")  # 13 mm are 0.013 m, not 0.013000000000000001 m


@lru_cache(maxsize=256)
def parsed(text: str) -> Any:
    """Pint's unit of `N*s/m`, `N.s/m`, `mm/s`, `m^2`, `m3` or `1/s`; raises ValueError."""
    if text in ("", "1"):
        return registry().dimensionless
    try:
        return registry().parse_units(canonical(text))
    except ValueError:
        raise
    except Exception as error:  # pint raises kinds of many libraries
        raise ValueError(f"unknown unit {shown(text)}") from error


def canonical(text: str) -> str:
    """The unit written as pint reads it; raises ValueError for anything but names, `*`, `/`, brackets and exponents."""
    bad = f"{shown(text)} is not a unit: must be names of units with *, /, and exponents of one digit, like 'N*s/m'"
    if len(text) > LONGEST:
        raise ValueError(bad)
    # Only `1/s` may begin with a number.
    inverse = re.match(r"\s*1\s*/", text)
    place, written, before, depth = (inverse.end() if inverse else 0), ["1/" if inverse else ""], "operator", 0
    while place < len(text):
        match = TOKEN.match(text, place)
        if match is None or len(written) > MOST_TOKENS:
            raise ValueError(bad)
        kind, token = str(match.lastgroup), match[str(match.lastgroup)]
        place = match.end()
        starts, ends = kind in ("name", "open"), before in ("name", "power", "close")
        if starts == ends:
            if not starts:
                raise ValueError(bad)
            written.append("*")  # N s
        if kind == "power" and before == "power":
            raise ValueError(bad)
        depth += (kind == "open") - (kind == "close")
        if depth < 0:
            raise ValueError(bad)
        if kind == "power":
            digits = token.removeprefix("**").removeprefix("^").strip()
            token = f"**{SUPERSCRIPTS.get(digits, digits)}"
        elif kind == "operator":
            token = "/" if token == "/" else "*"
        written.append(token)
        before = kind
    if depth or before not in ("name", "power", "close"):
        raise ValueError(bad)
    return "".join(written)


@cache
def registry() -> Any:
    """Pint's units, built once because it takes a while."""
    return pint.UnitRegistry()
