"""Commands about the car around the damper."""

import json
from pathlib import Path
from typing import Annotated

import typer

from twintube import dampers
from twintube.cli.base import AS_PUBLISHED, app
from twintube.dampers import ParameterError
from twintube.files import write_text


@app.command(epilog="Example: twintube ride SA8 --oil-level 0.6 --gas-lost --speed 50 --json ride.json")
def ride(
    damper: Annotated[str, typer.Argument(help="A name or a parameter file.")],
    oil_level: Annotated[float, typer.Option(help="Oil, share of the intact volume.")] = 1.0,
    gas_lost: Annotated[bool, typer.Option("--gas-lost", help="The gas preload is lost.")] = False,
    speed: Annotated[float, typer.Option(help="Speed [km/h].", min=1.0, max=200.0)] = 50.0,
    road_class: Annotated[str, typer.Option(help="Class of ISO 8608, A to E.")] = "D",
    seconds: Annotated[float, typer.Option(help="Length [s].", min=20.0, max=3600.0)] = 120.0,
    seed: Annotated[int, typer.Option(help="Seed of the road.", min=0)] = 1,
    car: Annotated[str, typer.Option(help="A named car or a car's file.")] = "passat_b8",
    published: AS_PUBLISHED = False,
    freed_gas: Annotated[
        str | None, typer.Option(help="What freed gas does, another way than the default: see docs/effects.md.")
    ] = None,
    json_file: Annotated[Path | None, typer.Option("--json", help="Write the figures to this file.")] = None,
) -> None:
    """Drive the quarter car over a random road and compare the damper with the intact one on the same road."""
    from twintube.dampers.freed_gas import acting, known, with_freed_gas
    from twintube.vehicle.cars import axle, load_car
    from twintube.vehicle.ride import WINDOW, measures, track
    from twintube.vehicle.ride import ride as run
    from twintube.vehicle.road import GD_N0

    if road_class not in GD_N0:
        raise ParameterError(f"--road-class {road_class}: must be one of {', '.join(GD_N0)}")
    if freed_gas is not None and published:
        raise ParameterError(f"--freed-gas {freed_gas} and --as-published: give one of them")
    loaded, vehicle = dampers.load(damper, as_published=published), load_car(car)
    if freed_gas is not None:
        loaded = with_freed_gas(loaded, known(freed_gas, "--freed-gas").name)
    state = loaded.with_(oil_level=oil_level, gas_preload=0 if gas_lost else 1)
    corner, route = vehicle.corner(loaded), track(speed, seconds, road_class=road_class, seed=seed)
    intact = run(loaded.with_(oil_level=1.0, gas_preload=1), corner, route)
    figures = measures(run(state, corner, route), corner, intact)
    conditions = {
        "damper": loaded.name,
        "oil_level": oil_level,
        "gas_preload": state.parameters.gas_preload,
        "freed_gas": acting(state),
        "car": vehicle.name,
        "axle": axle(loaded),
        "road": {"class": road_class, "seed": seed},
        "speed_kmh": speed,
        "seconds": seconds,
    }
    figures |= {"intact": measures(intact, corner)}
    if json_file is not None:
        write_text(json_file, json.dumps(conditions | figures, indent=1) + "\n")
    failed = figures["time_to_failure_s"]
    typer.echo(f"{loaded.name}, {oil_level:.0%} oil, {'no ' if gas_lost else ''}preload; freed gas: {acting(state)}")
    typer.echo(
        f"DLC {figures['dlc']:.3f} (intact {figures['intact']['dlc']:.3f}), wheel off the road "
        f"{figures['contact_loss_share']:.2%} of the time, {figures['damping_work_share']:.0%} of the intact work"
    )
    typer.echo(f"DLC in windows of {WINDOW:.0f} s: " + " ".join(f"{value:.3f}" for value in figures["dlc_window"]))
    verdict = "does at least half of the intact work in every window" if failed is None else (
        f"does less than half of the intact work from {failed:.0f} s on"
    )  # fmt: skip
    typer.echo(f"The damper {verdict}.")
