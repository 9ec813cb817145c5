"""What the page knows beside the module: dampers, corners of the car, ways of the freed gas, effects, a road; as JSON."""

import base64
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import astuple, fields
from functools import lru_cache
from importlib.resources import files
from typing import Any

import numpy as np

from twintube.core.checks import KELVIN, tube_limit
from twintube.core.effects import EFFECTS, Parameters
from twintube.core.variables import fmi_name
from twintube.dampers import Damper, load, names
from twintube.dampers.freed_gas import DEFAULT, WAYS, has_own, values_of
from twintube.dampers.variants import NO_CAVITATION, NO_FOAM, scalar_factor
from twintube.fmu.table import variables
from twintube.rig.plan import BLOCKS_17, amplitude
from twintube.rig.signals import AMPLITUDE, OSCILLATIONS, PRECONDITIONING, V_PRECONDITIONING
from twintube.vehicle import ride, road
from twintube.vehicle.cars import load_car
from twintube.vehicle.drive import CONDITIONING_STEP

ROAD_LENGTH = 300.0  # [m]; the drive ends where it ends
ROAD_SEED = 1
RAMPS = (0.001, 0.01, 0.05, 0.1, 0.25, 0.5, 1.0)  # [m/s]
# Of effects beyond the paper for a first look: a parameter file of one's own says better.
STRENGTHS: Mapping[str, Mapping[str, float]] = tomllib.loads(
    files("twintube.explorer").joinpath("strengths.toml").read_text(encoding="utf-8")
)
NAMES = {item.name: fmi_name(item) for item in fields(Parameters)}
UNITS = {item.name: item.metadata["unit"] for item in fields(Parameters)}


def named(values: Mapping[str, float]) -> dict[str, float]:
    """Parameters by their names in the unit."""
    return {NAMES[name]: value for name, value in values.items()}


def damper_data(damper: Damper) -> dict[str, Any]:
    """A damper: its values in the order of the unit's parameters, its tests, its corner of the car."""
    return {
        "name": damper.name,
        "title": damper.title,
        "values": [float(v.start or 0.0) for v in variables(damper) if v.causality == "parameter"],
        "amplitude": amplitude(damper),
        "limit": tube_limit(damper.parameters),
        "temperatures": [x - KELVIN for x in (damper.parameters.T_cold, damper.parameters.T_curve, damper.parameters.T_hot)],
        "levels": damper.measured_levels,
        "corner": astuple(load_car().corner(damper)),
        "ownGas": has_own(damper),
        "assumed": dict(damper.assumed),
    }


def effect_data(name: str) -> dict[str, Any]:
    """An effect beyond the paper, at the strength that the page offers."""
    values = STRENGTHS[name]
    strength = ", ".join(f"{item} = {value:g} {UNITS[item] if UNITS[item] != '1' else ''}".strip()
                         for item, value in values.items())  # fmt: skip
    return {"title": EFFECTS[name].title, "strength": strength, "parameters": named(values)}


def profile() -> str:
    """Heights of a class D road as a tyre feels them, 32-bit floats every `road.SPACING`; others are in proportion."""
    heights = road.generate(ROAD_LENGTH, seed=ROAD_SEED).enveloped
    return base64.b64encode(heights.astype("<f4").tobytes()).decode("ascii")


@lru_cache
def common() -> dict[str, Any]:
    """What does not depend on the user's dampers."""
    table = list(variables(load("SA8")))
    return {
        "names": [v.name for v in table],
        "integers": [v.name for v in table if v.integer],
        "parameters": [v.name for v in table if v.causality == "parameter"],
        "ways": {name: {"says": item.says, "parameters": named(values_of(name))} for name, item in WAYS.items()},
        "freedGas": DEFAULT,
        "kelvin": KELVIN,
        "noFoam": named(NO_FOAM),
        "noCavitation": named(NO_CAVITATION),
        "wear": [NAMES[name] for name in scalar_factor(1.0) if name != "oil_level"],
        "effects": {name: effect_data(name) for name in STRENGTHS},
        "rig": {
            "velocities": BLOCKS_17,
            "ramps": RAMPS,
            "oscillations": OSCILLATIONS,
            "preconditioning": PRECONDITIONING,
            "slow": V_PRECONDITIONING,
            "amplitude": AMPLITUDE,
        },
        "road": {
            "heights": profile(),
            "spacing": road.SPACING,
            "classes": {name: float(np.sqrt(gd / road.GD_N0["D"])) for name, gd in road.GD_N0.items()},
            "step": ride.DT,
            "fade": ride.FADE,
            "settled": ride.SETTLED,
            "conditioningStep": CONDITIONING_STEP,
        },
        "car": load_car().title,
    }


def content(own: Sequence[Damper]) -> dict[str, Any]:
    """All that the page is given; the user's dampers come first."""
    taken = {*names()}
    listed = []
    for damper in own:
        data = damper_data(damper)
        while data["name"] in taken:
            data["name"] += " (own)"
        taken.add(data["name"])
        listed.append(data)
    return common() | {"dampers": [*listed, *(damper_data(load(name)) for name in names())]}
