"""The main job, and the sensitivity of its result to the assumptions."""

from pathlib import Path
from typing import Annotated

import typer

from twintube.cli.base import app
from twintube.cli.outputs import check_folder, keep_other, mark_folder, of_options
from twintube.dampers import load
from twintube.files import write_text
from twintube.vehicle.cars import axle, load_car
from twintube.vehicle.ride import DT

DAMPER = Annotated[str, typer.Option(help="A named damper or a parameter file.")]
CAR = Annotated[str, typer.Option(help="A named car or a car's file.")]


@app.command(epilog="Example: twintube demo --damper SA7 --output results/front")
def demo(
    output: Annotated[Path, typer.Option(help="Folder for summary.json and the pictures.")] = Path("results/vehicle_demo"),
    damper: DAMPER = "SA8",
    car: CAR = "passat_b8",
    seconds: Annotated[float, typer.Option(help="Length of each ride [s].", min=20.0, max=3600.0)] = 120.0,
    step_ms: Annotated[float, typer.Option(help="Communication step [ms].", min=0.05, max=1.0)] = DT * 1e3,
    seed: Annotated[int, typer.Option(help="Seed of the road.", min=0)] = 1,
) -> None:
    """Drive a quarter car over a class D road with the damper FMU, from intact to 30 % oil.

    The bands show the dependence on every assumption. A damper with effects, such as the extended.toml of a diagnosis, is
    also driven without them to show their influence.
    """
    from twintube.demo.job import main_job, table

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


@app.command(epilog="Example: twintube sensitivity --output docs/sensitivity.md")
def sensitivity(
    output: Annotated[Path, typer.Option(help="Markdown file for the table.")] = Path("results/sensitivity.md"),
    damper: DAMPER = "SA8",
    car: CAR = "passat_b8",
) -> None:
    """Drive the quarter car with every assumption varied, and write the table of the DLC."""
    from twintube.demo.sensitivity import page

    text = page(damper, car)
    keep_other(output, text.encode())
    write_text(output, text)
    typer.echo(text)
