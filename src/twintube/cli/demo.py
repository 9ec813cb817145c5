"""The main job."""

from pathlib import Path
from typing import Annotated

import typer

from twintube.cli.base import VEHICLE, app
from twintube.cli.options import CAR, DAMPER_ARGUMENT, SEED, STEP_MS
from twintube.cli.outputs import check_folder, mark_folder, of_options

FORMER = {"--damper": ""}


@app.command(rich_help_panel=VEHICLE, epilog="Example: twintube demo SA7 --output results/front", former=FORMER)
def demo(
    damper: Annotated[str, DAMPER_ARGUMENT] = "SA8",
    output: Annotated[Path, typer.Option(metavar="FOLDER", help="For summary.json and the pictures.")] = Path(
        "results/vehicle_demo"
    ),
    car: CAR = "passat_b8",
    seconds: Annotated[float, typer.Option(metavar="S", help="Length of each ride.", min=20.0, max=3600.0)] = 120.0,
    step_ms: Annotated[float, typer.Option(metavar="MS", help="Communication step.", min=0.05, max=1.0)] = STEP_MS,
    seed: SEED = 1,
) -> None:
    """Drive a quarter car with the FMU, from intact to 30 % oil.

    The road is of class D. The bands show the dependence on every assumption. A damper with effects, such as the
    extended.toml of a diagnosis, is also driven without them to show their influence.
    """
    from twintube.dampers import load
    from twintube.demo.job import main_job, table
    from twintube.vehicle.cars import axle, load_car

    loaded, vehicle = load(damper), load_car(car)
    check_folder(output, ("summary.json",), of_options())
    result, pictures = main_job(loaded, vehicle, output, seconds=seconds, dt=step_ms * 1e-3, seed=seed)
    mark_folder(output, of_options())
    typer.echo(
        f"{loaded.name} in the {axle(loaded)} corner of a {vehicle.title} (assumed); freed gas: {result['freed_gas']}"
    )
    typer.echo(table(result))
    typer.echo("\n".join(result["sentences"]))
    typer.echo(f"{output / 'summary.json'} and {', '.join(p.name for p in pictures)}")
