"""The command that writes the whole car, or its four dampers, for other simulators."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from twintube.cli.base import VEHICLE, app
from twintube.cli.options import AS_PUBLISHED, CAR, FRONT, PLATFORM, REAR, SSP, WORN_AT
from twintube.cli.outputs import named, refuse_other, typed
from twintube.cli.states import GAS_SHARE, WORN_GAS_LOST, WORN_OIL_LEVEL, worn_preload
from twintube.errors import InputError

if TYPE_CHECKING:
    from twintube.dampers import Damper


OF_THE_CAR = {"speed": "--speed", "car_file": "--car", "version": "--ssp"}  # parameters, and how they are typed
OF_THE_CONTAINER = {"step_ms": "--step-ms"}


def four(front: str, rear: str, worn: str, oil_level: float, preload: float, *, published: bool) -> list["Damper"]:
    """The dampers in the order of the wheels; raises ParameterError and InputError."""
    from twintube.dampers import load
    from twintube.vehicle.full.catalogue import Case
    from twintube.vehicle.full.maneuvers import SMOOTH
    from twintube.vehicle.full.study import dampers_of

    both = load(front, as_published=published), load(rear, as_published=published)
    return list(dampers_of(*both, worn, Case("ride", 50.0, SMOOTH, 1, oil_level, gas_preload=preload)))


@app.command(rich_help_panel=VEHICLE, epilog="Example: twintube ssp --worn rear_left --oil-level 0.5 --output car.ssp")
def ssp(
    ctx: typer.Context,
    output: Annotated[
        Path, typer.Option(metavar="FILE", help="SSP file; with --container an .fmu file, or a folder for it.")
    ] = Path("car.ssp"),
    front: FRONT = "SA7",
    rear: REAR = "SA8",
    worn: WORN_AT = "all",
    oil_level: WORN_OIL_LEVEL = 1.0,
    gas_lost: WORN_GAS_LOST = None,
    gas: GAS_SHARE = None,
    speed: Annotated[float, typer.Option(metavar="KM/H", help="Speed at the start.")] = 50.0,
    car_file: CAR = "passat_b8",
    version: SSP = 1,
    platform: PLATFORM = None,
    published: AS_PUBLISHED = False,
    container: Annotated[
        bool, typer.Option("--container", help="The four dampers alone, as one FMU (extra container).")
    ] = False,
    step_ms: Annotated[
        float, typer.Option(metavar="MS", help="Of the container: communication step; the importer's must be a multiple.")
    ] = 1.0,
) -> None:
    """Write the car as an SSP file, or its dampers as one FMU.

    The file holds the car's FMU, four damper FMUs, connections and parameters. A simulator that knows SSP runs it; road and
    driver are inputs of the car. The dampers are not preconditioned.
    """
    from twintube.dampers.damper import in_words
    from twintube.fmu.ssp import build_ssp, described, members
    from twintube.vehicle.cars import load_car
    from twintube.vehicle.full.maneuvers import checked_speed
    from twintube.vehicle.full.run import full_car

    misplaced = OF_THE_CAR if container else OF_THE_CONTAINER
    if others := [misplaced[name] for name in typed(ctx) if name in misplaced]:
        raise InputError(f"{', '.join(others)}: {'not' if container else 'only'} with --container")
    preload = worn_preload(gas_lost, gas)
    dampers = four(front, rear, worn, oil_level, preload, published=published)
    state = in_words(oil_level, preload)
    if container:
        write_container(dampers, output if named() else Path(), step_ms, platform, f"{front} and {rear}, {worn}: {state}")
        return
    whole = full_car(load_car(car_file), dampers)
    if not named():
        refuse_other(output, same=members(output) == described(whole, checked_speed(speed), version))
    built = build_ssp(whole, checked_speed(speed), output, platform, ssp=version)
    typer.echo(f"{built}: {whole.name} with {front} and {rear}, {worn}: {state}; {built.stat().st_size // 1024} kB")


def write_container(
    dampers: Sequence["Damper"], output: Path, step_ms: float, platforms: Sequence[str] | None, of: str
) -> None:
    """Build the container of four dampers, `of` which it is said."""
    from twintube.fmu.archive import start_values
    from twintube.fmu.assemble import XML, target_file
    from twintube.fmu.container import NAME, build_container
    from twintube.fmu.table import variables

    target = target_file(output, NAME)
    if target != output:
        inside = [start_values(target, f"resources/{i:02}/{XML}") for i in range(len(dampers))]
        refuse_other(target, same=inside == [{v.name: v.start for v in variables(damper)} for damper in dampers])
    built = build_container(dampers, target, step_ms / 1e3, platforms)
    typer.echo(f"{built}: {of}; {built.stat().st_size // 1024} kB")
