"""The command that writes the whole car for other simulators."""

import time
from pathlib import Path
from typing import Annotated

import typer

from twintube import dampers
from twintube.cli.base import app
from twintube.fmu.platforms import PLATFORMS


@app.command(epilog="Example: twintube ssp --worn rear_left --oil-level 0.5 --output car.ssp")
def ssp(
    output: Annotated[Path, typer.Option(help="SSP file.")] = Path("car.ssp"),
    front: Annotated[str, typer.Option(help="Damper of the front axle: a name or a parameter file.")] = "SA7",
    rear: Annotated[str, typer.Option(help="Damper of the rear axle.")] = "SA8",
    worn: Annotated[str, typer.Option(help="Worn dampers: all, front, rear, or a wheel such as rear_left.")] = "all",
    oil_level: Annotated[float, typer.Option(help="Oil of the worn dampers; below 1 their gas preload is lost.")] = 1.0,
    speed: Annotated[float, typer.Option(help="Speed at the start [km/h].")] = 50.0,
    car_file: Annotated[str, typer.Option("--car", help="A named car or a car's file.")] = "passat_b8",
    platform: Annotated[
        list[str] | None, typer.Option(help=f"Only for this platform; may be repeated: {', '.join(PLATFORMS)}.")
    ] = None,
) -> None:
    """Write the whole car as an SSP 1.0 file: the car's FMU, four damper FMUs, connections and parameters.

    Any simulator that knows SSP runs it; road and driver are inputs of the car. The dampers are not preconditioned.
    """
    from twintube.fmu.ssp import build_ssp
    from twintube.vehicle.cars import load_car
    from twintube.vehicle.full.maneuvers import SMOOTH, checked_speed
    from twintube.vehicle.full.run import full_car
    from twintube.vehicle.full.study import Case, dampers_of

    began = time.monotonic()

    def progress(text: str) -> None:
        typer.echo(f"{time.monotonic() - began:4.0f} s  {text}", err=True)

    case = Case("ride", speed, SMOOTH, 1, oil_level)
    four = dampers_of(dampers.load(front), dampers.load(rear), worn, case)
    whole = full_car(load_car(car_file), four)
    built = build_ssp(whole, checked_speed(speed), output, platform or tuple(PLATFORMS), progress)
    typer.echo(
        f"{built}: {whole.name} with {front} and {rear}, {worn} at {oil_level:.0%} oil; {built.stat().st_size // 1024} kB"
    )
