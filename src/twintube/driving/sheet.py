"""The data sheet of a car: its lengths, from a signals file or a car's file."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from twintube.dampers.damper import refuse
from twintube.dampers.toml import as_table, read_named, read_text, unknown_keys, wrong_tables
from twintube.driving.channels import SHEET
from twintube.errors import InputError
from twintube.vehicle.cars import FOLDER, KEYS, METAS, TABLES, read_value

# Where a car's file says a length: table and key.
IN_A_FILE: Final = {
    "wheelbase_m": ("body", "wheelbase"),
    "track_front_m": ("front_axle", "track"),
    "track_rear_m": ("rear_axle", "track"),
    "wheel_radius_m": ("front_tyre", "radius"),
}
EXAMPLES: Final = {"wheelbase_m": 2.79, "wheel_radius_m": 0.31}
NEEDED: Final = tuple(EXAMPLES)
SAME: Final = 0.02  # of a length: printed with two or three digits


def length(car: Mapping[str, Any], name: str) -> float:
    """A length of a data sheet [m]; raises InputError that says what to give where it is not known."""
    if name not in car:
        table, key = IN_A_FILE[name]
        raise InputError(
            f'car.{name} is not known: give --car FILE, in which [{table}] has {key} = "{EXAMPLES[name]} m"; '
            f"in Python car = {EXAMPLES}"
        )
    return float(car[name])


def data_sheet(car: str | Path) -> dict[str, Any]:
    """The lengths [m] that a named car or a car's file says; the rest of the file may be left out. Raises ParameterError."""
    content, text, file = read_named(car, FOLDER, "car")
    messages = wrong_tables(content, text, TABLES)
    messages += unknown_keys(content, text, {"": {*KEYS}, **{name: set(metas) for name, metas in METAS.items()}})
    sheet: dict[str, Any] = {"name": read_text(content, "name", text, messages) or Path(file).stem}
    for name, (table, key) in IN_A_FILE.items():
        values = as_table(content.get(table, {}))
        if key in values:
            sheet[name] = read_value(values[key], key, table, text, messages)
        elif name in NEEDED:
            low, high = SHEET[name]
            messages.append(f"[{table}] {key} is missing: must be from {low:g} to {high:g} m")
    refuse(file, messages)
    return sheet


def joined(said: Mapping[str, Any], given: Mapping[str, Any]) -> dict[str, Any]:
    """What a signals file says of its car, and what was given beside; raises InputError where they are two cars."""
    for name in SHEET:
        if name in said and name in given and abs(float(given[name]) / float(said[name]) - 1.0) > SAME:
            raise InputError(f"car.{name} = {said[name]:g} m in the file, {given[name]:g} m is given: must be the same car")
    return {**given, **said}
