"""Parameter sets written as TOML."""

from dataclasses import fields
from typing import Any

import tomlkit

from twintube.core import effects
from twintube.core.effects import Parameters
from twintube.dampers import freed_gas
from twintube.dampers.curve import BRANCHES, given
from twintube.dampers.damper import Damper
from twintube.dampers.dead_length import collapse_level


def to_toml(damper: Damper) -> str:
    """The TOML text of a damper, in SI units, with the F-v curve as it was given and the effects that act."""
    document = tomlkit.document()
    document["name"] = damper.name
    document["title"] = damper.title
    if damper.measured_levels:
        document["measured_oil"] = [level * damper.parameters.V_oil for level in damper.measured_levels]
    if damper.measured_amplitude is not None:
        document["measured_amplitude"] = damper.measured_amplitude
        document["measured_amplitude"].comment("m")
    if damper.gas_pressure is not None:
        document["gas_pressure"] = damper.gas_pressure
        document["gas_pressure"].comment("Pa gauge, cold, at which gas_spring holds")
    p = damper.parameters
    way = freed_gas.way_of(freed_gas.own_values(damper))
    if way is not None:
        document["freed_gas"] = way
        document["freed_gas"].comment(freed_gas.WAYS[way].says)
    idle = {item.name for effect in effects.EFFECTS.values() if not effect.acts(p) for item in effect.parameters}
    for item in fields(Parameters):
        group = item.metadata["group"]
        if item.metadata["size"] > 1 or item.name in idle or (way is not None and item.name in freed_gas.OWN):
            continue
        if group and group not in document:
            document[group] = tomlkit.table()
        table: Any = document[group] if group else document
        table[item.name] = getattr(p, item.name)
        if item.metadata["unit"] != "1":
            table[item.name].comment(item.metadata["unit"])
    level = f"{collapse_level(damper):.1%} of the intact oil"
    document["geometry"]["dead_length"].comment(f"m: both working chambers are full down to {level}")
    curve = tomlkit.table()
    for branch, (v_name, F_name) in BRANCHES.items():
        rows = tomlkit.array()
        rows.extend([list(pair) for pair in given(list(zip(getattr(p, v_name), getattr(p, F_name), strict=True)))])
        curve[branch] = rows.multiline(True)
    document["fv"] = curve
    document["sources"] = dict(damper.sources)
    document["assumed"] = dict(damper.assumed)
    return tomlkit.dumps(document)
