"""Table of the dependence of the wheel load on every assumption: `twintube sensitivity`."""

from collections.abc import Callable
from typing import Any

import numpy as np

from twintube.dampers import load
from twintube.dampers.freed_gas import DEFAULT, WAYS
from twintube.demo.bands import FORCES, SEEDS, SPEEDS, Rides, Setting, fits, loss
from twintube.vehicle.cars import CarSet, axle, load_car
from twintube.vehicle.ride import DT

LEVELS = (1.0, 0.9, 0.6, 0.4)
SECONDS = 120.0
LINKS = (0.0, 70.0, 150.0, 300.0, 450.0)  # [N.s/m]
LENGTHS = (-0.010, 0.0, 0.010)  # [m]
LOSSES = (0.001, 0.05, 0.1, 0.2, 0.4)  # oil losses [1] from which cavitation has its full effect


def settings(car: CarSet) -> dict[str, Setting]:
    """The settings, by the name of the row."""
    rows = {"default": Setting()}
    rows |= {f"links {value:g} N s/m": Setting(car=(("d_links", value),)) for value in LINKS}
    rows |= {f"freed gas `{name}`: {item.says}": Setting(freed_gas=name) for name, item in WAYS.items()}
    rows |= {f"dead length {1e3 * value:+.0f} mm": Setting(dead_length=value) for value in LENGTHS if value}
    rows |= {f"full cavitation from {100 * value:g} % of oil loss": loss(value)
             for value in LOSSES}  # fmt: skip
    rows |= {f"F-v curve x {value:g}": Setting(forces=value) for value in FORCES}
    for name, ends in car.band.items():
        if name != "d_links":
            rows |= {f"{name} {value:g}": Setting(car=((name, value),)) for value in ends}
    return rows


def table(rides: Rides, rows: dict[str, Setting]) -> str:
    """Markdown table: DLC by speed and level, means over the roads, the intact damper first."""
    states = [(v, level) for v in SPEEDS for level in (None, *LEVELS)]
    heads = [f"{v:.0f} km/h, {'intact' if level is None else f'{100 * level:.0f} %'}" for v, level in states]

    def line(name: str, setting: Setting, figure: Callable[[list[float]], Any]) -> str:
        values = [figure([rides.get(*state, seeded(setting, seed), "dlc") for seed in SEEDS]) for state in states]
        return f"| {name} | " + " | ".join(f"{value:.3f}" for value in values) + " |"

    lines = ["| assumption | " + " | ".join(heads) + " |", "|---" * (len(heads) + 1) + "|"]
    lines += [line(name, setting, np.mean) for name, setting in rows.items()]
    lines.append(line("default, range over the roads", Setting(), np.ptp))
    return "\n".join(lines)


def seeded(setting: Setting, seed: int) -> Setting:
    """The setting on another road."""
    return Setting(setting.freed_gas, seed, setting.car, setting.forces, setting.dead_length, setting.damper)


def page(damper: str, car: str) -> str:
    """The Markdown page; raises ParameterError."""
    loaded, vehicle = load(damper), load_car(car)
    rows = {name: setting for name, setting in settings(vehicle).items() if fits(loaded, setting)}
    rides = Rides(loaded, vehicle, SECONDS, DT)
    rides.drive_all(SPEEDS, LEVELS, [seeded(s, seed) for s in rows.values() for seed in SEEDS], "sensitivity")
    links, p = vehicle.axles[axle(loaded)]["d_links"], loaded.parameters
    return "\n".join([
        "# Sensitivity of the wheel load", "",
        f"Made by `twintube sensitivity --damper {damper}`: dynamic load coefficient (DLC, standard deviation",
        f"of the wheel load over the static one, from 5 s on) of a quarter car, {vehicle.title}, class D road,",
        f"{SECONDS:.0f} s, gas preload lost, means over {len(SEEDS)} roads. Default: freed gas `{DEFAULT}`, links {links:g}",
        f"N s/m, dead length {1e3 * p.dead_length:g} mm, full cavitation from {100 * p.cavitation_loss:g} % of oil loss.",
        "All these values are assumed.",
        "", table(rides, rows), "",
    ])  # fmt: skip
