"""Cars in TOML, with sources, assumed values and the bands that a result must hold for; a named one is a file here."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from twintube.core.checks import outside
from twintube.dampers import Damper
from twintube.dampers.damper import refuse, suggestion
from twintube.dampers.quantity import quantity
from twintube.dampers.toml import line_of, read_named
from twintube.vehicle.quarter_car import Car

FOLDER = Path(__file__).parent
DEFAULT = "passat_b8"
AXLES = ("front", "rear")
TABLE = {item.name: item.metadata for item in fields(Car) if item.name != "F_rest"}
KEYS = ("name", "title", *AXLES, "band", "sources", "assumed")
RUBBER = 0.025  # [m] that a rubber stop gives before the damper's own end


@dataclass(frozen=True)
class CarSet:
    """A car: values [SI] of `quarter_car.Car` by axle, and the range of those that are not known well."""

    name: str
    title: str
    axles: Mapping[str, dict[str, float]]
    band: Mapping[str, tuple[float, float]]
    sources: Mapping[str, str]
    assumed: Mapping[str, str]

    def corner(self, damper: Damper, **changes: float) -> Car:
        """The corner that the damper sits in, with `changes` of its values; the spring is set for the intact damper.

        The rubber stops touch so early that they are pressed by RUBBER at the damper's maximum stroke.
        """
        values = self.axles[axle(damper)] | changes
        room = damper.parameters.stroke_max / values["ratio"] - RUBBER
        values["travel"] = min(values["travel"], max(room, RUBBER))
        return Car(**values, F_rest=-damper.parameters.F_0)


def axle(damper: Damper) -> str:
    """`front` where the damper's title says so, else `rear`."""
    return "front" if "front" in damper.title.lower() else "rear"


def load_car(car: str | Path = DEFAULT) -> CarSet:
    """A named car or a car's file; raises ParameterError with every defect, its line and the allowed range."""
    content, text, file = read_named(car, FOLDER, "car")
    found = [f"unknown {key}{suggestion(key, KEYS)}" for key in content if key not in KEYS]
    axles = {name: read_axle(content.get(name), name, text, found) for name in AXLES}
    band = read_band(content.get("band", {}), text, found)
    refuse(file, found)
    return CarSet(
        str(content.get("name", Path(file).stem)),
        str(content.get("title", Path(file).stem)),
        axles,
        band,
        content.get("sources", {}),
        content.get("assumed", {}),
    )


def read_value(value: Any, name: str, group: str, text: str, found: list[str]) -> float:
    """One value [SI]; what is wrong with it goes to `found`."""
    meta = TABLE[name]
    try:
        number = quantity(value, meta["unit"].replace("N/m3", "N/m**3"))
    except ValueError as error:
        found.append(f"{line_of(text, group, name)}{group}.{name}: {error}")
        return 0.0
    message = outside(f"{group}.{name}", number, meta["lower"], meta["upper"], meta["unit"])
    if message:
        found.append(line_of(text, group, name) + message)
    return number


def read_axle(table: Any, name: str, text: str, found: list[str]) -> dict[str, float]:
    """The values of an axle's corner."""
    if not isinstance(table, dict):
        found.append(f"the table {name} is missing")
        return {}
    found += [f"{line_of(text, name, key)}unknown {name}.{key}{suggestion(key, TABLE)}" for key in table if key not in TABLE]
    found += [f"{name}.{key} is missing" for key in TABLE if key not in table]
    return {key: read_value(value, key, name, text, found) for key, value in table.items() if key in TABLE}


def read_band(table: Any, text: str, found: list[str]) -> dict[str, tuple[float, float]]:
    """The ranges of what is not known well."""
    bands = {}
    for key, value in table.items() if isinstance(table, dict) else ():
        if key not in TABLE or not isinstance(value, list) or len(value) != 2:
            found.append(f"{line_of(text, 'band', key)}band.{key}: must be a value's name with [smallest, largest]")
            continue
        low, high = (read_value(end, key, "band", text, found) for end in value)
        bands[key] = (low, high)
    return bands
