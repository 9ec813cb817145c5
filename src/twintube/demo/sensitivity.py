"""Table of the dependence of the wheel load on every assumption: `python -m benchmarks sensitivity`."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from twintube.dampers import Damper, load
from twintube.dampers.dead_length import bounds, collapse_level
from twintube.dampers.freed_gas import DEFAULT, P_GAS, P_GASES, WAYS
from twintube.dampers.variants import rear_curve
from twintube.demo.bands import (
    FORCES,
    LOSSES,
    NAMES,
    POLYTROPIC,
    SEEDS,
    SPEEDS,
    Rides,
    Setting,
    assumptions,
    dead_length,
    everything,
    fits,
    limited,
    loss,
    rises,
)
from twintube.demo.words import percent
from twintube.vehicle.cars import CarSet, axle, load_car
from twintube.vehicle.ride import DT

LEVELS = (0.9, 0.6, 0.5, 0.4)
RISES = (0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3)  # levels of the table of rises
GENTLEST = "pushes_oil"  # the way of the freed gas with the least effect
MILD_AT = 0.4  # level by which the mild ends are chosen
SECONDS = 120.0
LINKS = (0.0, 150.0, 450.0)  # [N.s/m]
PRELOADS = (0.8, 0.4)  # shares of the gas preload
TEMPERATURES = {"-20 °C": 253.15, "60 °C": 333.15}  # [K] of the dampers


def settings(damper: Damper, car: CarSet) -> dict[str, Setting]:
    """The settings, by the name of the row; what is the default already has no row of its own."""
    p, links = damper.parameters, car.axles[axle(damper)]["d_links"]
    rows = {"default": Setting()}
    rows |= {f"links {value:g} N s/m": Setting(car=(("d_links", value),)) for value in LINKS if value != links}
    rows |= {f"freed gas `{name}`": Setting(freed_gas=name) for name in WAYS if name != DEFAULT}
    rows |= {f"freed gas `limited` at {value:g} bar": limited(value) for value in P_GASES if value != P_GAS}
    rows[f"gas spring polytropic, exponent {p.n_gas:g}"] = POLYTROPIC
    rows |= {f"dead length {1e3 * value:.0f} mm": dead_length(value) for value in bounds(damper)}
    rows |= {f"full cavitation from {100 * value:g} % loss": loss(value)
             for value in LOSSES if value != p.cavitation_loss}  # fmt: skip
    rows |= {f"F-v curve x {value:g}": Setting(forces=value) for value in FORCES}
    if curve := rear_curve(damper):
        rows["rear curve of the F-v source"] = Setting(damper=tuple(curve.items()))
    for name, ends in car.band.items():
        if name != "d_links":
            text, unit = NAMES.get(name, (name, ""))
            rows |= {f"{text} {value:g} {unit}".rstrip(): Setting(car=((name, value),)) for value in ends}
    rows |= {f"gas preload at {share:.0%}".replace("%", " %"): Setting(gas=share) for share in PRELOADS}
    return rows | {f"dampers at {text}": Setting(temperature=kelvins) for text, kelvins in TEMPERATURES.items()}


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
    return replace(setting, seed=seed)


def mild(rides: Rides) -> Setting:
    """Of every assumption the end with the smaller rise at MILD_AT, all at once, and freed gas that only pushes oil."""

    def rise(setting: Setting) -> float:
        return sum(rises(rides, speed, MILD_AT, [setting])[0] for speed in SPEEDS)

    ends = [min(pair, key=rise) for pair in assumptions(rides.damper, rides.car).values()]
    return Setting(
        GENTLEST,
        car=tuple(value for end in ends for value in end.car),
        forces=float(np.prod([end.forces for end in ends])),
        damper=tuple(value for end in ends for value in end.damper),
    )


def table_of_rises(rides: Rides, rows: dict[str, list[Setting]]) -> str:
    """Markdown table: smallest and largest rise over all roads of each row's settings, by speed and level."""
    states = [(v, level) for v in SPEEDS for level in RISES]
    lines = ["| assumption | " + " | ".join(f"{v:.0f} km/h, {100 * level:.0f} %" for v, level in states) + " |"]
    lines.append("|---" * (len(states) + 1) + "|")
    for name, several in rows.items():
        cells = []
        for state in states:
            values = rises(rides, *state, (seeded(setting, seed) for setting in several for seed in SEEDS))
            cells.append(f"{percent(min(values))} to {percent(max(values))}".replace(" %", ""))
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def combinations(rides: Rides) -> dict[str, list[Setting]]:
    """The rows of the table of rises: what is published, the mildest of the most important ones, and everything."""
    longest = bounds(rides.damper)[1]
    length = dead_length(longest).damper
    rows = {"default": [Setting()], f"freed gas `{GENTLEST}`": [Setting(GENTLEST)]}
    rows |= {f"freed gas `limited` at {value:g} bar": [limited(value)] for value in P_GASES}
    rows[f"dead length {1e3 * longest:.0f} mm"] = [Setting(damper=length)]
    rows[f"both: `{GENTLEST}` and {1e3 * longest:.0f} mm"] = [Setting(GENTLEST, damper=length)]
    for links in rides.car.band.get("d_links", ())[1:]:
        rows[f"these and links {links:g} N s/m"] = [Setting(GENTLEST, car=(("d_links", links),), damper=length)]
    return rows | {"**all settings of the bands**": everything(rides)}


def page(damper: str, car: str) -> str:
    """The Markdown page; raises ParameterError."""
    loaded, vehicle = load(damper), load_car(car)
    rows = {name: setting for name, setting in settings(loaded, vehicle).items() if fits(loaded, setting)}
    rides = Rides(loaded, vehicle, SECONDS, DT)
    combined = combinations(rides)
    several = dict.fromkeys([setting for group in combined.values() for setting in group])
    rides.drive_all(SPEEDS, LEVELS, [seeded(s, seed) for s in rows.values() for seed in SEEDS], "sensitivity")
    rides.drive_all(SPEEDS, RISES, [seeded(s, seed) for s in several for seed in SEEDS], "together")
    mildest = mild(rides)
    rides.drive_all(SPEEDS, RISES, [seeded(mildest, seed) for seed in SEEDS], "mild ends")
    corner, p = vehicle.axles[axle(loaded)], loaded.parameters
    return "\n".join([
        "# Sensitivity of the wheel load", "",
        "How far each assumption moves the dynamic load coefficient (DLC) of a quarter car: the standard deviation of",
        f"the wheel load over the static one. `python -m benchmarks sensitivity {damper}` makes this page.", "",
        f"- Vehicle: {vehicle.title}. Class D road, {SECONDS:.0f} s, DLC from 5 s on, mean of {len(SEEDS)} roads.",
        f"- Gas preload lost. Default, all assumed: freed gas `{DEFAULT}`, links {corner['d_links']:g} N s/m and",
        f"  {corner['friction']:g} N of friction, dead length",
        f"  {1e3 * p.dead_length:g} mm, full cavitation from {100 * p.cavitation_loss:g} % of oil loss.",
        f"- `limited` is at {P_GAS:g} bar.",
        f"- The chambers are full down to {100 * collapse_level(loaded):.1f} % of the oil.",
        "- [What each way of the freed gas means](effects.md#what-becomes-of-the-gas-that-cavitation-frees).",
        "", table(rides, rows), "",
        "## Rise over the intact damper", "",
        "Rise of the DLC over the intact damper in the same car on the same road, in %: smallest and largest of",
        f"{len(SEEDS)} roads.", "",
        "- All settings of the bands: every assumption at its ends, one at a time. Freed gas, links and dead length",
        "  also together.",
        f"- Mild ends: of every assumption the end with the smaller rise at {100 * MILD_AT:.0f} % oil, and freed gas",
        f"  `{GENTLEST}`.",
        "", table_of_rises(rides, combined | {"all mild ends at once": [mildest]}), "",
    ])  # fmt: skip
