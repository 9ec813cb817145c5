"""Other numbers than those in `numbers.py`, for as long as something is asked with them."""

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import fields, replace
from itertools import pairwise
from pathlib import Path
from typing import Any

from twintube.common.reading import ReadError, read_toml
from twintube.common.words import shown
from twintube.dampers.damper import suggestion
from twintube.dampers.toml import line_of
from twintube.diagnosis.numbers import Numbers, in_force, numbers
from twintube.errors import InputError

KNOWN = {item.name: item for item in fields(Numbers)}


@contextmanager
def priors(values: Mapping[str, Any] | str | Path) -> Iterator[None]:
    """Within it the diagnosis has other numbers: a TOML file, or values by the names in `numbers.py`.

    It holds for the whole process; an answer's budget is of it only where it is asked for within. Raises InputError, which
    names the line of the file, where a name is unknown or a value out of its range.
    """
    other = checked(values, "") if isinstance(values, Mapping) else of_file(Path(values))
    with in_force(replace(numbers(), **other)):
        yield


def of_file(path: Path) -> dict[str, Any]:
    """The numbers in a TOML file."""
    try:
        content, text = read_toml(path)
    except (OSError, ReadError) as error:
        raise InputError(f"{path}: {error}") from error
    return checked(content, f"{path}: ", text)


def checked(values: Mapping[str, Any], where: str, text: str = "") -> dict[str, Any]:
    """The numbers as they are kept, each in its range."""
    out: dict[str, Any] = {}
    for name, value in values.items():
        place = f"{where}{line_of(text, '', name)}"
        if name not in KNOWN:
            raise InputError(f"{place}unknown {name}{suggestion(name, KNOWN)}")
        usual, most = getattr(numbers(), name), KNOWN[name].metadata["most"]
        several = value if isinstance(value, (list, tuple)) else [value]
        right = all(isinstance(x, (int, float)) and not isinstance(x, bool) and math.isfinite(x) for x in several)
        if not isinstance(usual, tuple):
            if not (right and several is not value and 0.0 < value <= most):
                raise InputError(f"{place}{name} = {shown(value)}: must be a number above 0{upto(most)}")
            out[name] = float(value)
            continue
        rises = right and several is value and all(a < b for a, b in pairwise(several)) and min(several, default=-1.0) >= 0.0
        if not rises or len(several) != len(usual):
            raise InputError(f"{place}{name} = {shown(value)}: must be {len(usual)} numbers of 0 or more that rise")
        out[name] = tuple(float(x) for x in several)
    some = {name: out.get(name, getattr(numbers(), name)) for name in ("unchanged", "other")}
    if sum(some.values()) >= 1.0:
        raise InputError(f"{where}unchanged + other = {sum(some.values()):g}: must be below 1, the causes have the rest")
    return out


def upto(most: float) -> str:
    """The end of a range in words."""
    return "" if math.isinf(most) else f" up to {most:g}"
