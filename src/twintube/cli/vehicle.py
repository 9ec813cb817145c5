"""Commands about the car around the damper."""

import json
from pathlib import Path
from typing import Annotated

import typer

from twintube import dampers
from twintube.cli.base import answering, app
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
    closure: Annotated[str | None, typer.Option(help="What becomes of the gas that cavitation frees.")] = None,
    json_file: Annotated[Path | None, typer.Option("--json", help="Write the figures to this file.")] = None,
) -> None:
    """Drive the quarter car over a random road and compare the damper with the intact one over the same metres."""
    from twintube.dampers.closures import CLOSURES, DEFAULT, acting, closed
    from twintube.vehicle.cars import axle, load_car
    from twintube.vehicle.ride import WINDOW, measures, track
    from twintube.vehicle.ride import ride as run
    from twintube.vehicle.road import GD_N0

    with answering():
        if road_class not in GD_N0:
            raise ParameterError(f"--road-class {road_class}: must be one of {', '.join(GD_N0)}")
        if closure is not None and closure not in CLOSURES:
            raise ParameterError(f"--closure {closure}: must be one of {', '.join(CLOSURES)}")
        chosen, vehicle = dampers.load(damper), load_car(car)
        state = closed(chosen.with_(oil_level=oil_level, gas_preload=0 if gas_lost else 1), closure or DEFAULT)
        corner, on = vehicle.corner(chosen), track(speed, seconds, road_class=road_class, seed=seed)
        intact = run(chosen.with_(oil_level=1.0, gas_preload=1), corner, on)
        found = measures(run(state, corner, on), corner, intact)
        about = {
            "damper": chosen.name,
            "oil_level": oil_level,
            "gas_preload": state.parameters.gas_preload,
            "closure": acting(state),
            "car": vehicle.name,
            "axle": axle(chosen),
            "road": {"class": road_class, "seed": seed},
            "speed_kmh": speed,
            "seconds": seconds,
        }
        found |= {"intact": measures(intact, corner)}
        if json_file is not None:
            write_text(json_file, json.dumps(about | found, indent=1) + "\n")
        failed = found["time_to_failure_s"]
        typer.echo(f"{chosen.name}, {oil_level:.0%} oil, {'no ' if gas_lost else ''}preload; {acting(state)}")
        typer.echo(
            f"DLC {found['dlc']:.3f} (intact {found['intact']['dlc']:.3f}), wheel off the road "
            f"{found['contact_loss_share']:.2%} of the time, {found['damping_work_share']:.0%} of the intact damper's work"
        )
        typer.echo(f"DLC in windows of {WINDOW:.0f} s: " + " ".join(f"{value:.3f}" for value in found["dlc_window"]))
        half = "does more than half of the intact one's work in every window" if failed is None else (
            f"does less than half of the intact one's work from {failed:.0f} s on"
        )  # fmt: skip
        typer.echo(f"The damper {half}.")
