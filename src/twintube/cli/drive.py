"""The command about the driving car's signals."""

from pathlib import Path
from typing import Annotated

import typer

from twintube.cli.base import VEHICLE, app
from twintube.cli.options import CAR, CARS, FRONT, REAR, ROADS, SEED, WORN_AT, one_of
from twintube.cli.states import GAS_SHARE, WORN_GAS_LOST, WORN_OIL_LEVEL, worn_preload
from twintube.errors import InputError


@app.command(
    rich_help_panel=VEHICLE,
    epilog="Example: twintube drive --speed 80 --road-class B --minutes 5 --worn rear_left --oil-level 0.4 --gas-lost "
    "--output signals.parquet",
    former={"--write": "--output"},
)
def drive(
    output: Annotated[Path, typer.Option(metavar="FILE", help="Signals: .parquet, or .mf4 (extra mdf).")],
    speed: Annotated[float, typer.Option(metavar="KM/H", help="Mean speed.", min=20.0, max=200.0)] = 80.0,
    road_class: Annotated[str, one_of(ROADS, help="Class of the road, ISO 8608.")] = "B",
    minutes: Annotated[float, typer.Option(metavar="MIN", help="Length.", min=0.1, max=60.0)] = 5.0,
    worn: WORN_AT = "all",
    oil_level: WORN_OIL_LEVEL = 1.0,
    gas_lost: WORN_GAS_LOST = None,
    gas: GAS_SHARE = None,
    temperature: Annotated[
        float, typer.Option(metavar="DEGC", help="Temperature of the dampers' oil and gas.", min=-40.0, max=120.0)
    ] = 23.0,
    front: FRONT = "SA7",
    rear: REAR = "SA8",
    car_file: CAR = "passat_b8",
    seed: SEED = 1,
) -> None:
    """Drive the whole car and write the signals of its bus.

    The file's labels hold the truth about its dampers. `twintube monitor` reads such files.
    """
    from twintube import dampers
    from twintube.dampers.damper import in_words
    from twintube.driving.drives import driven
    from twintube.driving.scenes import Conditions, Vehicle, Wear, scene
    from twintube.driving.signals import check_suffix
    from twintube.driving.writing import write
    from twintube.vehicle.cars import load_car
    from twintube.vehicle.full.study import WORN
    from twintube.vehicle.road import GD_N0

    check_suffix(output)
    if road_class not in GD_N0:
        raise InputError(f"--road-class {road_class}: must be one of {', '.join(GD_N0)}")
    if worn not in WORN:
        raise InputError(f"--worn {worn}: must be one of {', '.join(WORN)}")
    levels = [oil_level if i in WORN[worn] else 1.0 for i in range(4)]
    preload = worn_preload(gas_lost, gas)
    shares = [preload if i in WORN[worn] else 1.0 for i in range(4)]
    vehicle = Vehicle(load_car(car_file), dampers.load(front), dampers.load(rear))
    conditions = Conditions(
        road_class, speed, 60.0 * minutes, seed, temperature=temperature, random=seed
    )  # fmt: skip
    signals = driven(scene(vehicle, conditions, Wear(levels, shares)))
    write(signals, output)
    typer.echo(
        f"{output}: {minutes:g} min of {vehicle.car.name} at {speed:g} km/h on a road of class {road_class}, "
        f"{len(signals.values)} channels every {signals.interval * 1e3:g} ms; {worn}: "
        f"{in_words(oil_level, preload)}"
    )


@app.command(
    rich_help_panel=VEHICLE,
    epilog="Example: twintube join can.csv imu.csv --car my_car.toml --output drive.parquet",
)
def join(
    signals: Annotated[list[Path], typer.Argument(metavar="SIGNALS...", help="Files with channels of one drive.")],
    output: Annotated[Path, typer.Option(metavar="FILE", help="Signals: .parquet, or .mf4 (extra mdf).")],
    car: Annotated[
        str | None,
        one_of(CARS, "--car", metavar="CAR", help="Where the files do not say it: a car's file with wheelbase and radius."),
    ] = None,
) -> None:
    """Join the files of one drive, each with a rate of its own.

    Bus and inertial unit get one even raster. So does one file whose times jitter.
    """
    from twintube.driving import joining
    from twintube.driving.sheet import data_sheet
    from twintube.driving.signals import check_suffix
    from twintube.driving.writing import write

    check_suffix(output)
    drive = joining.join(signals, None if car is None else data_sheet(car))
    write(drive, output)
    typer.echo(f"{output}: {drive.time[-1]:.1f} s, {len(drive.values)} channels every {drive.interval * 1e3:.3g} ms")
