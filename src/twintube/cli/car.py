"""The command about the whole car."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from twintube.cli.base import VEHICLE, app
from twintube.cli.options import CAR, FRONT, JSON_FILE, MANEUVERS, REAR, ROADS, WORN_AT, one_of
from twintube.cli.outputs import check_folder, mark_folder, of_options
from twintube.cli.states import GAS_SHARE, LOST_BELOW_FULL, TEMPERATURE, tempered, worn_preload
from twintube.common.files import write_text
from twintube.common.words import counted
from twintube.errors import InputError

MANEUVER = Annotated[
    list[str] | None,
    one_of(
        (*MANEUVERS, "table3"),
        metavar="NAME",
        help=f"{', '.join(MANEUVERS)}, or table3 for the ten drives of the paper; repeatable.",
    ),
]
OIL_LEVELS = Annotated[
    list[float] | None,
    typer.Option(metavar="0..1", help="Oil of the worn dampers; repeatable. Their gas preload stays unless --gas-lost."),
]
SPEEDS = Annotated[list[float] | None, typer.Option(metavar="KM/H", help="Speed, else the manoeuvre's own; repeatable.")]
ROAD_CLASSES = Annotated[
    list[str] | None,
    one_of(("smooth", *ROADS), help="Road: smooth, or a class of ISO 8608; repeatable."),
]
GRIP = Annotated[
    str, typer.Option(metavar="0..1", help="Grip over that of a dry road: 0.7 for a wet one; 1,0.3 left, right.")
]
INSPECTION = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="A file of `twintube inspect --json`: what it sees stands beside on the page."),
]


@app.command(
    rich_help_panel=VEHICLE,
    epilog="Example: twintube car --maneuver braking --speed 80 --worn all --oil-level 0.5 --output car",
)
def car(
    maneuver: MANEUVER = None,
    front: FRONT = "SA7",
    rear: REAR = "SA8",
    worn: WORN_AT = "all",
    oil_level: OIL_LEVELS = None,
    gas_lost: LOST_BELOW_FULL = None,
    gas: GAS_SHARE = None,
    temperature: TEMPERATURE = None,
    speed: SPEEDS = None,
    road_class: ROAD_CLASSES = None,
    grip: GRIP = "1",
    seeds: Annotated[int, typer.Option(metavar="N", help="Roads of each class.", min=1, max=1000)] = 5,
    car_file: CAR = "passat_b8",
    inspection: INSPECTION = None,
    json_file: JSON_FILE = None,
    output: Annotated[Path | None, typer.Option(metavar="FOLDER", help="Write a page and pictures to this folder.")] = None,
) -> None:
    """Drive the whole car with worn dampers and with intact ones.

    A car with a scalar factor in place of the worn dampers drives, too.
    """
    from twintube import dampers
    from twintube.dampers.damper import gas_in_words
    from twintube.report.car.conclusion import read_inspection
    from twintube.report.car.courses import pictures
    from twintube.report.car.page import page
    from twintube.vehicle.cars import load_car
    from twintube.vehicle.full.study import USUAL, cases, compared, dampers_of, drive_all

    if output is not None:
        check_folder(output, ("car.html",), of_options())
    seen = read_inspection(inspection) if inspection is not None else None
    loaded = load_car(car_file)
    both = tempered(dampers.load(front), temperature), tempered(dampers.load(rear), temperature)
    names, levels = maneuver or list(USUAL), oil_level or [0.7, 0.5, 0.3]
    roads, speeds = road_class or ["smooth", "C", "D"], speed or None
    check_drives(names, roads, speeds or ())
    preload = worn_preload(gas_lost, gas)
    wanted = cases(names, speeds, roads, levels, seeds=seeds, grips=grips_of(grip), gas_preload=preload)
    for case in wanted[:2]:
        dampers_of(*both, worn, case)
    entries = drive_all(loaded, *both, worn, wanted)
    if all("failed" in entry for entry in entries):
        raise InputError(entries[0]["failed"])
    rows = compared(entries)
    conditions = {
        "car": loaded.name, "front": both[0].name, "rear": both[1].name, "worn": worn, "seeds": seeds, "grip": grip,
        "gas_preload": f"{gas_in_words(preload)} in the worn dampers", "temperature_degC": temperature,
    }  # fmt: skip
    if json_file is not None:
        write_text(json_file, json.dumps({**conditions, "compared": rows, "drives": entries}, indent=1) + "\n")
    if output is not None:
        output.mkdir(exist_ok=True)
        mark_folder(output, of_options())
        courses = {name: pictures(loaded, both, worn, wanted, name) for name in names}
        page(loaded, conditions, rows, entries, seen=seen, courses=courses).write(output, "car.html")
        typer.echo(f"{output / 'car.html'}")
    warm = "" if temperature is None else f", all dampers at {temperature:g} degC"
    typer.echo(f"worn: {worn}, gas preload {conditions['gas_preload']}{warm}")
    for line in lines(rows):
        typer.echo(line)
    for reason in dict.fromkeys(entry["failed"] for entry in entries if "failed" in entry):
        typer.echo(f"not driven: {reason}", err=True)


def check_drives(names: Sequence[str], roads: Sequence[str], speeds: Sequence[float]) -> None:
    """Raise InputError for a manoeuvre, a class of the road or a speed [km/h] that there is not."""
    from twintube.vehicle.full.catalogue import MANEUVERS
    from twintube.vehicle.full.maneuvers import CLASSES, checked_speed

    for name in names:
        known("maneuver", name, MANEUVERS)
    for road in roads:
        known("road class", road, CLASSES)
    for value in speeds:
        checked_speed(value)


def lines(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """The change of each drive for the terminal, and what changes beside it."""
    from twintube.vehicle.full.catalogue import MANEUVERS
    from twintube.vehicle.full.study import FULL

    width, found = max(10, *(len(row["maneuver"]) for row in rows)), []
    for row in rows:
        drive = f"{row['maneuver']:{width}} {row['road']:7}{row['speed_kmh']:4.0f} km/h"
        if row["change"] is None:
            found.append(f"{drive} {row['oil_level']:5.0%} oil, {row['model']:14}{MANEUVERS[row['maneuver']].without}")
            continue
        low, high = row["change_band"]
        unit = "" if row["unit"] == "1" else f" {row['unit']}"
        others = " and all ways of the freed gas" if row["model"] == FULL else ""
        found.append(
            f"{drive} {row['oil_level']:5.0%} oil, {row['model']:14}"
            f"{row['figure']}: {row['intact']:.3g} -> {row['worn']:.3g}{unit} ({row['change']:+.0%}, "
            f"{low:+.0%} to {high:+.0%} over {counted(row['seeds'], 'seed')}{others})"
        )
        known_beside = [beside(item) for item in row["beside"] if item["worn"] is not None]
        if known_beside:
            found.append("    " + "; ".join(known_beside))
    return found


def beside(item: Mapping[str, Any]) -> str:
    """A figure beside the headline, intact and worn: means over the seeds."""
    intact, worn = ("none" if item[state] is None else f"{item[state]:.3g}" for state in ("intact", "worn"))
    return f"{item['figure']} {intact} -> {worn}{'' if item['unit'] == '1' else ' ' + item['unit']}"


def grips_of(text: str) -> tuple[float, float]:
    """Grip of the left and the right track from one number or two; raises InputError."""
    from twintube.vehicle.full.maneuvers import SMOOTH, Road

    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if len(values) not in (1, 2):
        raise InputError(f"grip {text}: must be one number, or two for left and right, as 1,0.3")
    return Road(SMOOTH, grips=(values[0], values[-1])).grips


def known(what: str, value: str, allowed: object) -> None:
    """Raise InputError for a value that is not among the allowed ones."""
    from collections.abc import Iterable

    assert isinstance(allowed, Iterable)
    if value not in allowed:
        raise InputError(f"{what} {value}: must be one of {', '.join(allowed)}")
