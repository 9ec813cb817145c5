"""Commands of `python -m benchmarks` that vary every assumption; they stay here while their former names work."""

import json
from pathlib import Path
from typing import Annotated

import typer

from twintube.cli.options import CAR, DAMPER_ARGUMENT, FRONT, JSON_FILE, REAR, WORN_AT
from twintube.cli.outputs import check_folder, keep_other, mark_folder, of_options
from twintube.common.files import write_text
from twintube.errors import InputError


def sensitivity(
    damper: Annotated[str, DAMPER_ARGUMENT] = "SA8",
    output: Annotated[Path, typer.Option(metavar="FILE", help="Markdown file for the table.")] = Path(
        "results/sensitivity.md"
    ),
    car: CAR = "passat_b8",
) -> None:
    """Vary every assumption about the quarter car, one by one.

    It writes the table of the dynamic load coefficient (DLC).
    """
    from twintube.demo.sensitivity import page

    text = page(damper, car)
    keep_other(output, text.encode())
    write_text(output, text)
    typer.echo(text)


def car_sensitivity(
    front: FRONT = "SA7",
    rear: REAR = "SA8",
    worn: WORN_AT = "all",
    oil_level: Annotated[float, typer.Option(metavar="0..1", help="Oil of the worn dampers.")] = 0.5,
    seeds: Annotated[int, typer.Option(metavar="N", help="Roads and slip controls for each value.", min=1, max=1000)] = 4,
    draws: Annotated[
        int, typer.Option(metavar="N", help="Draws of all values at once; 0 for none.", min=0, max=10_000)
    ] = 48,
    seed: Annotated[int, typer.Option(metavar="N", help="Seed of the draws.", min=0)] = 1,
    car_file: CAR = "passat_b8",
    json_file: JSON_FILE = None,
    output: Annotated[Path | None, typer.Option(metavar="FOLDER", help="Write a page and a picture to this folder.")] = None,
) -> None:
    """Vary every assumed value of the whole car and its brakes.

    It says how the effect of the worn dampers moves.
    """
    from twintube import dampers
    from twintube.report.car.sensitivity import as_json, page, text
    from twintube.vehicle.cars import load_car
    from twintube.vehicle.full.catalogue import Case
    from twintube.vehicle.full.run import full_car
    from twintube.vehicle.full.sensitivity import Variant, sensitivity
    from twintube.vehicle.full.study import dampers_of

    if output is not None:
        check_folder(output, ("sensitivity.html",), of_options())
    if oil_level >= 1.0:
        raise InputError(f"oil_level = {oil_level:g}: must be below 1 for a worn damper")
    variant = Variant(load_car(car_file), dampers.load(front), dampers.load(rear))
    full_car(
        variant.car, dampers_of(variant.front, variant.rear, worn, Case("ride", 80.0, "D", 1, oil_level, gas_preload=0))
    )
    result = sensitivity(variant, worn, oil_level, seeds=seeds, draws=draws, seed=seed)
    conditions = {"car": variant.car.name, "front": variant.front.name, "rear": variant.rear.name, "worn": worn}
    if json_file is not None:
        write_text(json_file, json.dumps(conditions | as_json(result), indent=1) + "\n")
    typer.echo(text(result), nl=False)
    if output is not None:
        output.mkdir(exist_ok=True)
        mark_folder(output, of_options())
        page(result, conditions).write(output, "sensitivity.html")
        typer.echo(f"{output / 'sensitivity.html'}")
