"""Cars as TOML files, with sources, assumed values and bands of uncertain values; the named cars are in this folder."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from twintube.core.checks import outside
from twintube.dampers import Damper
from twintube.dampers.damper import refuse, suggestion
from twintube.dampers.quantity import quantity
from twintube.dampers.toml import (
    as_table,
    line_of,
    line_of_table,
    read_named,
    read_text,
    read_texts,
    unknown_keys,
    wrong_tables,
)
from twintube.vehicle.full.brakes import Brakes
from twintube.vehicle.full.car import Layout, Suspension, Tyre
from twintube.vehicle.quarter_car import Car

FOLDER = Path(__file__).parent
DEFAULT = "passat_b8"
AXLES = ("front", "rear")
TABLE = {item.name: item.metadata for item in fields(Car) if item.name != "F_rest"}
# What only the whole car needs, table by table.
WHOLE: dict[str, type] = {
    "body": Layout,
    "front_axle": Suspension,
    "rear_axle": Suspension,
    "front_tyre": Tyre,
    "rear_tyre": Tyre,
    "brakes": Brakes,
}
METAS = {name: TABLE for name in AXLES} | {
    name: {item.name: item.metadata for item in fields(record)} for name, record in WHOLE.items()
}
TABLES = {*METAS, "band", "sources", "assumed"}
KEYS = ("name", "title", *sorted(TABLES))
RUBBER = 0.025  # [m] compression of a rubber stop at the damper's maximum stroke
ROUNDING = 1e-6  # of shares that add up


@dataclass(frozen=True)
class CarSet:
    """A car: values [SI] of `quarter_car.Car` by axle, and the range of uncertain values."""

    name: str
    title: str
    axles: Mapping[str, dict[str, float]]
    whole: Mapping[str, dict[str, float]]  # tables of WHOLE, empty where the file has only the corners
    band: Mapping[str, tuple[float, float]]
    sources: Mapping[str, str]
    assumed: Mapping[str, str]

    def corner(self, damper: Damper, **changes: float) -> Car:
        """The corner of the damper, with `changes` of its values; the spring preload is that of the intact damper.

        The rubber stops begin early enough to be compressed by RUBBER at the damper's maximum stroke.
        """
        return self.corner_of(axle(damper), damper, **changes)

    def corner_of(self, place: str, damper: Damper, **changes: float) -> Car:
        """The corner of an axle with a damper."""
        values = self.axles[place] | changes
        room = damper.parameters.stroke_max / values["ratio"] - RUBBER
        values["travel"] = min(values["travel"], max(room, RUBBER))
        return Car(**values, F_rest=-damper.parameters.F_0)


def axle(damper: Damper) -> str:
    """`front` if the damper's title contains it, else `rear`."""
    return "front" if "front" in damper.title.lower() else "rear"


def load_car(car: str | Path = DEFAULT) -> CarSet:
    """A named car or a car's file; raises ParameterError with every defect, its line and the allowed range."""
    content, text, file = read_named(car, FOLDER, "car")
    messages = wrong_tables(content, text, TABLES)
    messages += unknown_keys(content, text, {"": {*KEYS}, **{name: set(metas) for name, metas in METAS.items()}})
    axles = {name: read_table(content.get(name), name, text, messages) for name in AXLES}
    some = any(name in content for name in WHOLE)
    whole = {name: read_table(content.get(name), name, text, messages) for name in WHOLE} if some else {}
    if whole and not messages:
        messages += [f"{line_of(text, table, name)}{message}" for table, name, message in contradictions(whole)]
    band = read_band(as_table(content.get("band", {})), text, messages)
    name, title = (read_text(content, key, text, messages) for key in ("name", "title"))
    sources, assumed = (read_texts(content, key, text, messages) for key in ("sources", "assumed"))
    refuse(file, messages)
    return CarSet(name or Path(file).stem, title or Path(file).stem, axles, whole, band, sources, assumed)


def contradictions(whole: Mapping[str, dict[str, float]]) -> list[tuple[str, str, str]]:
    """Values, each within its range, that contradict one another: table, name and message."""
    found = []
    brakes, axles = whole["brakes"], [whole["front_axle"], whole["rear_axle"]]
    if brakes["slip_build"] >= brakes["slip_release"]:
        message = f"{brakes['slip_build']:g}: must be below slip_release = {brakes['slip_release']:g}"
        found.append(("brakes", "slip_build", f"brakes.slip_build = {message}"))
    for place in ("front_tyre", "rear_tyre"):
        tyre = whole[place]
        for end in ("x", "x2", "y", "y2"):
            for name, below, other in ((f"s_slide_{end}", False, f"s_most_{end}"), (f"slide_{end}", True, f"most_{end}")):
                if (tyre[name] > tyre[other]) if below else (tyre[name] < tyre[other]):
                    rule = f"must not be {'above' if below else 'below'} {other} = {tyre[other]:g}"
                    found.append((place, name, f"{place}.{name} = {tyre[name]:g}: {rule}"))
    if abs(sum(axle["drive"] for axle in axles) - 1.0) > ROUNDING:
        shares = " + ".join(f"{axle['drive']:g}" for axle in axles)
        found.append(("rear_axle", "drive", f"rear_axle.drive: the shares of both axles, {shares}, must add up to 1"))
    for name in ("steers", "brake"):
        if not any(axle[name] for axle in axles):
            found.append(("front_axle", name, f"front_axle.{name} = 0: must be above 0 at one axle at least"))
    return found


def read_value(value: Any, name: str, group: str, text: str, messages: list[str]) -> float:
    """One value [SI]; defects are added to `messages`."""
    meta = METAS.get(group, TABLE)[name]
    try:
        number = quantity(value, meta["unit"])
    except ValueError as error:
        messages.append(f"{line_of(text, group, name)}{group}.{name}: {error}")
        return 0.0
    message = outside(f"{group}.{name}", number, meta["lower"], meta["upper"], meta["unit"])
    if message:
        messages.append(line_of(text, group, name) + message)
    return number


def read_table(table: Any, name: str, text: str, messages: list[str]) -> dict[str, float]:
    """The values of a table of METAS."""
    metas = METAS[name]
    if table is None:
        messages.append(f"the table {name} is missing")
    if not isinstance(table, dict):
        return {}
    messages += [
        f"{line_of_table(text, name)}{name}.{key} is missing: must be from {meta['lower']:g} to {meta['upper']:g}"
        f"{' ' + meta['unit'] if meta['unit'] != '1' else ''}"
        for key, meta in metas.items()
        if key not in table
    ]
    return {key: read_value(value, key, name, text, messages) for key, value in table.items() if key in metas}


def read_band(table: dict[str, Any], text: str, messages: list[str]) -> dict[str, tuple[float, float]]:
    """The ranges of the uncertain values."""
    bands = {}
    for key, value in table.items():
        if key not in TABLE or not isinstance(value, list) or len(value) != 2:
            hint = f"band.{key}: must be [smallest, largest] of a value of the axles"
            messages.append(f"{line_of(text, 'band', key)}{hint}{suggestion(key, TABLE) if key not in TABLE else ''}")
            continue
        low, high = (read_value(end, key, "band", text, messages) for end in value)
        if low > high:
            messages.append(
                f"{line_of(text, 'band', key)}band.{key}: {low:g} must not be above {high:g} {TABLE[key]['unit']}"
            )
        bands[key] = (low, high)
    return bands
