"""Commands about the car around the damper."""

import json
from collections.abc import Mapping
from typing import Annotated, Any

import typer

from twintube.cli.base import VEHICLE, app
from twintube.cli.options import AS_PUBLISHED, CAR, DAMPER, FREED_GAS, JSON_FILE, ROADS, SEED, one_of
from twintube.cli.states import GAS_LOST, GAS_SHARE, OIL_LEVEL, TEMPERATURE, in_state, tempered
from twintube.common.files import write_text
from twintube.errors import ParameterError


@app.command(
    rich_help_panel=VEHICLE, epilog="Example: twintube ride SA8 --oil-level 0.6 --gas-lost --speed 50 --json ride.json"
)
def ride(
    damper: DAMPER,
    oil_level: OIL_LEVEL = None,
    gas_lost: GAS_LOST = None,
    gas: GAS_SHARE = None,
    temperature: TEMPERATURE = None,
    speed: Annotated[float, typer.Option(metavar="KM/H", help="Speed.", min=1.0, max=200.0)] = 50.0,
    road_class: Annotated[str, one_of(ROADS, help="Class of the road, ISO 8608.")] = "D",
    seconds: Annotated[float, typer.Option(metavar="S", help="Length.", min=20.0, max=3600.0)] = 120.0,
    seed: SEED = 1,
    car: CAR = "passat_b8",
    published: AS_PUBLISHED = False,
    freed_gas: Annotated[
        str | None,
        one_of(FREED_GAS, metavar="WAY", help=f"What gas does that cavitation frees: {', '.join(FREED_GAS)}."),
    ] = None,
    json_file: JSON_FILE = None,
) -> None:
    """Drive a quarter car, worn and intact, over a random road.

    Both dampers drive the same road.
    """
    from twintube import dampers
    from twintube.dampers.freed_gas import acting, known, with_freed_gas
    from twintube.vehicle.cars import axle, load_car
    from twintube.vehicle.ride import measures, track
    from twintube.vehicle.ride import ride as run
    from twintube.vehicle.road import GD_N0

    if road_class not in GD_N0:
        raise ParameterError(f"--road-class {road_class}: must be one of {', '.join(GD_N0)}")
    if freed_gas is not None and published:
        raise ParameterError(f"--freed-gas {freed_gas} and --as-published: give one of them")
    loaded, vehicle = dampers.load(damper, as_published=published), load_car(car)
    if freed_gas is not None:
        loaded = with_freed_gas(loaded, known(freed_gas, "--freed-gas").name)
    loaded = tempered(loaded, temperature)
    state = in_state(loaded, oil_level, gas_lost, gas)
    corner, route = vehicle.corner(loaded), track(speed, seconds, road_class=road_class, seed=seed)
    intact = run(loaded.with_(oil_level=1.0, gas_preload=1), corner, route)
    figures = measures(run(state, corner, route), corner, intact)
    conditions = {
        "damper": loaded.name,
        "oil_level": state.parameters.oil_level,
        "gas_preload": state.parameters.gas_preload,
        "temperature_degC": temperature,
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
    warm = "" if temperature is None else f", {temperature:g} degC"
    typer.echo(f"{loaded.name}, {state.state}{warm}; freed gas: {acting(state)}")
    for line in lines(figures):
        typer.echo(line)


def lines(figures: Mapping[str, Any]) -> list[str]:
    """The figures of a ride for the terminal."""
    from twintube.vehicle.ride import WINDOW

    failed = figures["time_to_failure_s"]
    verdict = "does at least half of the intact work in every window" if failed is None else (
        f"does less than half of the intact work from {failed:.0f} s on"
    )  # fmt: skip
    return [
        f"DLC {figures['dlc']:.3f} (intact {figures['intact']['dlc']:.3f}), wheel off the road "
        f"{figures['contact_loss_share']:.2%} of the time, {figures['damping_work_share']:.0%} of the intact work",
        f"DLC in windows of {WINDOW:.0f} s: " + " ".join(f"{value:.3f}" for value in figures["dlc_window"]),
        f"The damper {verdict}.",
    ]
