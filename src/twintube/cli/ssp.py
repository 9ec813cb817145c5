"""Commands that write the whole car, or its four dampers, for other simulators."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from twintube.cli.base import VEHICLE, app
from twintube.cli.options import AS_PUBLISHED, CAR, FRONT, PLATFORM, REAR, SSP, WORN_AT
from twintube.cli.outputs import named, refuse_other
from twintube.cli.states import WORN_GAS_LOST, WORN_OIL_LEVEL, state_in_words

if TYPE_CHECKING:
    from twintube.dampers import Damper


def four(front: str, rear: str, worn: str, oil_level: float, *, gas_lost: bool, published: bool) -> list["Damper"]:
    """The dampers in the order of the wheels; raises ParameterError and InputError."""
    from twintube.dampers import load
    from twintube.vehicle.full.catalogue import Case
    from twintube.vehicle.full.maneuvers import SMOOTH
    from twintube.vehicle.full.study import dampers_of

    both = load(front, as_published=published), load(rear, as_published=published)
    return list(dampers_of(*both, worn, Case("ride", 50.0, SMOOTH, 1, oil_level, gas_preload=int(not gas_lost))))


def progress() -> Callable[[str], None]:
    """Says what is being done, with the seconds since the call."""
    began = time.monotonic()
    return lambda text: typer.echo(f"{time.monotonic() - began:4.0f} s  {text}", err=True)


@app.command(rich_help_panel=VEHICLE, epilog="Example: twintube ssp --worn rear_left --oil-level 0.5 --output car.ssp")
def ssp(
    output: Annotated[Path, typer.Option(metavar="FILE", help="SSP file.")] = Path("car.ssp"),
    front: FRONT = "SA7",
    rear: REAR = "SA8",
    worn: WORN_AT = "all",
    oil_level: WORN_OIL_LEVEL = 1.0,
    gas_lost: WORN_GAS_LOST = False,
    speed: Annotated[float, typer.Option(metavar="KM/H", help="Speed at the start.")] = 50.0,
    car_file: CAR = "passat_b8",
    version: SSP = 1,
    platform: PLATFORM = None,
    published: AS_PUBLISHED = False,
) -> None:
    """Write the whole car as an SSP file of five FMUs.

    It holds the car's FMU, four damper FMUs, connections and parameters. A simulator that knows SSP runs it; road and driver
    are inputs of the car. The dampers are not preconditioned.
    """
    from twintube.fmu.ssp import build_ssp, described, members
    from twintube.vehicle.cars import load_car
    from twintube.vehicle.full.maneuvers import checked_speed
    from twintube.vehicle.full.run import full_car

    dampers = four(front, rear, worn, oil_level, gas_lost=gas_lost, published=published)
    whole = full_car(load_car(car_file), dampers)
    if not named():
        refuse_other(output, same=members(output) == described(whole, checked_speed(speed), version))
    built = build_ssp(whole, checked_speed(speed), output, platform, progress=progress(), ssp=version)
    typer.echo(
        f"{built}: {whole.name} with {front} and {rear}, {worn}: {state_in_words(oil_level, gas_lost=gas_lost)}; "
        f"{built.stat().st_size // 1024} kB"
    )


@app.command(rich_help_panel=VEHICLE, epilog="Example: twintube container --front SA7 --rear SA8 --output dampers.fmu")
def container(
    output: Annotated[Path, typer.Option(metavar="FILE|FOLDER", help="An .fmu file, or a folder for it.")] = Path(),
    front: FRONT = "SA7",
    rear: REAR = "SA8",
    worn: WORN_AT = "all",
    oil_level: WORN_OIL_LEVEL = 1.0,
    gas_lost: WORN_GAS_LOST = False,
    step_ms: Annotated[
        float, typer.Option(metavar="MS", help="Communication step; the importer's must be a multiple.")
    ] = 1.0,
    platform: PLATFORM = None,
    published: AS_PUBLISHED = False,
) -> None:
    """Write the four dampers of a car as one container FMU.

    It is for tools in which a single unit is easier than four. It needs the FMU Manipulation Toolbox, which also brings the
    container's libraries.
    """
    from twintube.fmu.archive import start_values
    from twintube.fmu.assemble import XML, target_file
    from twintube.fmu.container import NAME, PLATFORMS, build_container
    from twintube.fmu.table import variables

    dampers = four(front, rear, worn, oil_level, gas_lost=gas_lost, published=published)
    target = target_file(output, NAME)
    if target != output:
        inside = [start_values(target, f"resources/{i:02}/{XML}") for i in range(len(dampers))]
        refuse_other(target, same=inside == [{v.name: v.start for v in variables(damper)} for damper in dampers])
    built = build_container(dampers, target, step_ms / 1e3, platform or PLATFORMS, progress())
    state = state_in_words(oil_level, gas_lost=gas_lost)
    typer.echo(f"{built}: {front} and {rear}, {worn}: {state}; {built.stat().st_size // 1024} kB")
