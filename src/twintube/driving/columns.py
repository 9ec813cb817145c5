"""Which channel a column of a file is, and its values in the channel's unit."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from twintube.common.arrays import Array
from twintube.common.words import listed, shown
from twintube.data.convert.units import split_header
from twintube.driving.channels import CHANNELS, TIME
from twintube.driving.sheet import length
from twintube.errors import InputError

G: Final = 9.80665  # [m/s2]
# By the unit of a channel: what one of another unit is. 1/s and Hz are left out: turns or radians?
UNITS: Final = {
    "s": {"s": 1.0, "ms": 1e-3, "us": 1e-6},
    "rad/s": {"rad/s": 1.0, "deg/s": np.pi / 180.0, "rpm": np.pi / 30.0, "1/min": np.pi / 30.0},
    "m/s2": {"m/s2": 1.0, "g": G, "mg": 1e-3 * G},
    "rad": {"rad": 1.0, "deg": np.pi / 180.0},
    "degC": {"degC": 1.0},
    "Pa": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "bar": 1e5, "psi": 6894.757},
}
SPEEDS: Final = {"m/s": 1.0, "km/h": 1.0 / 3.6, "mph": 0.44704}  # of a wheel, over its radius
UNIT_OF: Final = {TIME: "s"} | {name: channel.unit for name, channel in CHANNELS.items()}
# Without the unit in the name: `wheel_speed_fl`, which then stands in brackets.
BARE: Final = {name[: -len("_" + unit.replace("/", "_per_"))]: name for name, unit in UNIT_OF.items()}
SIGNS: Final = str.maketrans({"²": "2", "^": None, "°": "deg", "\N{MICRO SIGN}": "u", "\N{GREEK SMALL LETTER MU}": "u"})


def channel_of(header: str) -> tuple[str, str] | None:
    """Channel and unit of `yaw_rate_rad_per_s`, `yaw_rate [deg/s]` and the like; None for a column of something else."""
    name, unit = split_header(header)
    known = name if name in UNIT_OF else BARE.get(name)
    return None if known is None else (known, written(unit))


def written(unit: str) -> str:
    """A unit as it stands in UNITS, where it is one of them."""
    return unit.translate(SIGNS).replace(" ", "")


def factor(header: str, carried: str, car: Mapping[str, Any]) -> float:
    """What one of a column's unit is in the unit of its channel; `carried` is what the file says beside the name."""
    name, unit = channel_of(header) or (header, "")
    own = UNIT_OF[name]
    said = {each for each in (unit, written(carried), own if split_header(header)[0] == name else "") if each}
    speeds = SPEEDS if name.startswith("wheel_speed") else {}
    if not said:
        raise InputError(f"{header}: no unit: must be like {shown(f'{header} [{[*UNITS[own], *speeds][-1]}]')}, or {name}")
    if len(said) > 1:
        raise InputError(f"{header}: in {listed(sorted(said))}: must be in one unit")
    one = said.pop()
    if one in speeds:
        return speeds[one] / length(car, "wheel_radius_m")
    if one not in UNITS[own]:
        raise InputError(f"{header}: unit {shown(one)}: must be one of {', '.join([*UNITS[own], *speeds])}")
    return UNITS[own][one]


def in_channels(columns: Mapping[str, Array], units: Mapping[str, str], car: Mapping[str, Any]) -> dict[str, Array]:
    """Columns by channel, in its unit; `units` are those that a file says beside the names. Raises InputError."""
    found: dict[str, str] = {}
    for header in columns:
        name = (channel_of(header) or ("", ""))[0]
        if name in found:
            raise InputError(f"{shown(found[name])} and {shown(header)}: are the same channel, must be one column")
        if name:
            found[name] = header
    return {
        name: np.asarray(columns[header], dtype=float) * factor(header, units.get(header, ""), car)
        for name, header in found.items()
    }
