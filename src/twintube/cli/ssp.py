"""Commands that write the whole car, or its four dampers, for other simulators."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from twintube.cli.base import AS_PUBLISHED, app
from twintube.cli.outputs import named, refuse_other
from twintube.dampers import Damper, load
from twintube.fmu.platforms import PLATFORMS

FRONT = Annotated[str, typer.Option(help="Damper of the front axle: a name or a parameter file.")]
REAR = Annotated[str, typer.Option(help="Damper of the rear axle.")]
WORN = Annotated[str, typer.Option(help="Worn dampers: all, front, rear, or a wheel such as rear_left.")]
OIL_LEVEL = Annotated[float, typer.Option(help="Oil of the worn dampers; below 1 their gas preload is lost.")]
PLATFORM = Annotated[
    list[str] | None, typer.Option(help=f"Only for this platform; may be repeated: {', '.join(PLATFORMS)}.")
]


def four(front: str, rear: str, worn: str, oil_level: float, published: bool) -> list[Damper]:
    """The dampers in the order of the wheels; raises ParameterError and InputError."""
    from twintube.vehicle.full.catalogue import Case
    from twintube.vehicle.full.maneuvers import SMOOTH
    from twintube.vehicle.full.study import dampers_of

    both = load(front, as_published=published), load(rear, as_published=published)
    return list(dampers_of(*both, worn, Case("ride", 50.0, SMOOTH, 1, oil_level)))


def progress() -> Callable[[str], None]:
    """Says what is being done, with the seconds since the call."""
    began = time.monotonic()
    return lambda text: typer.echo(f"{time.monotonic() - began:4.0f} s  {text}", err=True)


@app.command(epilog="Example: twintube ssp --worn rear_left --oil-level 0.5 --output car.ssp")
def ssp(
    output: Annotated[Path, typer.Option(help="SSP file.")] = Path("car.ssp"),
    front: FRONT = "SA7",
    rear: REAR = "SA8",
    worn: WORN = "all",
    oil_level: OIL_LEVEL = 1.0,
    speed: Annotated[float, typer.Option(help="Speed at the start [km/h].")] = 50.0,
    car_file: Annotated[str, typer.Option("--car", help="A named car or a car's file.")] = "passat_b8",
    platform: PLATFORM = None,
    published: AS_PUBLISHED = False,
) -> None:
    """Write the whole car as an SSP 1.0 file: the car's FMU, four damper FMUs, connections and parameters.

    A simulator that knows SSP runs it; road and driver are inputs of the car. The dampers are not preconditioned.
    """
    from twintube.fmu.ssp import build_ssp, described, members
    from twintube.vehicle.cars import load_car
    from twintube.vehicle.full.maneuvers import checked_speed
    from twintube.vehicle.full.run import full_car

    whole = full_car(load_car(car_file), four(front, rear, worn, oil_level, published))
    if not named():
        refuse_other(output, same=members(output) == described(whole, checked_speed(speed)))
    built = build_ssp(whole, checked_speed(speed), output, platform or tuple(PLATFORMS), progress())
    typer.echo(
        f"{built}: {whole.name} with {front} and {rear}, {worn} at {oil_level:.0%} oil; {built.stat().st_size // 1024} kB"
    )


@app.command(epilog="Example: twintube container --front SA7 --rear SA8 --output dampers.fmu")
def container(
    output: Annotated[Path, typer.Option(help="File (.fmu) or folder; default: the current folder.")] = Path(),
    front: FRONT = "SA7",
    rear: REAR = "SA8",
    worn: WORN = "all",
    oil_level: OIL_LEVEL = 1.0,
    step_ms: Annotated[float, typer.Option(help="Communication step [ms]; the importer's must be a multiple.")] = 1.0,
    platform: PLATFORM = None,
    published: AS_PUBLISHED = False,
) -> None:
    """Write the four dampers of a car as one container FMU, for tools in which a single unit is easier than four.

    It needs the FMU Manipulation Toolbox, which also brings the container's libraries.
    """
    from twintube.fmu.archive import start_values
    from twintube.fmu.assemble import XML, target_file
    from twintube.fmu.container import NAME, PLATFORMS, build_container
    from twintube.fmu.table import variables

    dampers = four(front, rear, worn, oil_level, published)
    target = target_file(output, NAME)
    if target != output:
        inside = [start_values(target, f"resources/{i:02}/{XML}") for i in range(len(dampers))]
        refuse_other(target, same=inside == [{v.name: v.start for v in variables(damper)} for damper in dampers])
    built = build_container(dampers, target, step_ms / 1e3, platform or PLATFORMS, progress())
    typer.echo(f"{built}: {front} and {rear}, {worn} at {oil_level:.0%} oil; {built.stat().st_size // 1024} kB")
