"""What becomes of the gas that cavitation frees, and of the oil in whose place it is: beside equations 40 and 41.

The paper's own equations turn oil into gas for good (`stays`). That is meant for blocks of seconds, on which Y was fitted:
its own measurements rest for 180 s and find the damper as before. Section 3.2 names the time scales. Each way is a set of
effects. DEFAULT is what every door uses: `load` puts it into a damper whose parameter set does not say anything else.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Final

from twintube.core.effects import EFFECTS
from twintube.dampers.damper import Damper, ParameterError
from twintube.dampers.variants import scalar_factor

HALF_LIFE_RETURN: Final = (6.1, 10.2)  # [s] until half of the gas is dissolved again, Section 3.2
SOLUBILITY: Final = (0.093, 0.113)  # gas per oil volume at ambient pressure, Section 3.2
P_GAS: Final = 0.3  # [bar] absolute, at which the gas sits that `limited` counts (assumed)
P_GASES: Final = (P_GAS, 0.5, 1.0)  # [bar] over which it is varied; 1 is that of an open reserve


def rate(half_life: float) -> float:
    """First-order rate [1/s] of a half-life [s]."""
    return math.log(2.0) / half_life


MEAN_RETURN: Final = sum(HALF_LIFE_RETURN) / 2
RETURNING = {"redissolution_rate": rate(MEAN_RETURN)}


def limited(pressure: float) -> dict[str, float]:
    """The parameters of gas that dissolves again, of which the oil frees what it holds at an absolute pressure [bar]."""
    return RETURNING | {"exhaustion": pressure * 2 / sum(SOLUBILITY)}


@dataclass(frozen=True)
class FreedGas:
    """One way: the parameters that it sets, and what it says."""

    name: str
    says: str
    parameters: MappingProxyType[str, float]


def way(name: str, says: str, **parameters: float) -> FreedGas:
    """A way with its parameters."""
    return FreedGas(name, says, MappingProxyType(parameters))


WAYS: Final = {item.name: item for item in (
    way("stays", "it stays gas for good, equations 40 and 41 as published"),
    way("dissolves", f"half of it dissolves again in {MEAN_RETURN:.3g} s, the middle of Section 3.2", **RETURNING),
    way("dissolves_fast", f"half of it dissolves again in {HALF_LIFE_RETURN[0]} s",
        redissolution_rate=rate(HALF_LIFE_RETURN[0])),
    way("dissolves_slow", f"half of it dissolves again in {HALF_LIFE_RETURN[1]} s",
        redissolution_rate=rate(HALF_LIFE_RETURN[1])),
    way("limited", f"it dissolves again, and the oil frees no more gas than it holds, at {P_GAS} bar", **limited(P_GAS)),
    way("half_pushes_oil", "it dissolves again, and pushes half of the oil into the reserve instead of replacing it",
        **RETURNING, displaced_share=0.5),
    way("pushes_oil", "it pushes oil into the reserve: no oil is lost", displaced_share=1.0),
)}  # fmt: skip
AS_PUBLISHED: Final = "stays"
DEFAULT: Final = "dissolves"
# The default and the furthest to either side: what is said of vehicles and inspections is varied over these.
VARIED: Final = (DEFAULT, AS_PUBLISHED, "limited", "pushes_oil")
SCALAR: Final = "scalar factor"  # variant 1 of Section 3.4: no freed gas at all, the usual shortcut
GAS = ("gas_redissolution", "gas_exhaustion", "oil_displacement")  # the effects that a way is made of
OWN = tuple(name for effect in GAS for name in EFFECTS[effect].strength)


def values_of(name: str) -> dict[str, float]:
    """All parameters of a way, also those that are 0; raises ParameterError."""
    return {key: known(name).parameters.get(key, 0.0) for key in OWN}


def known(name: Any, where: str = "freed_gas =") -> FreedGas:
    """The way of this name; raises ParameterError that says `where` it stands."""
    if not isinstance(name, str) or name not in WAYS:
        raise ParameterError(f"{where} {name}: must be one of {', '.join(WAYS)}")
    return WAYS[name]


def way_of(values: Mapping[str, float]) -> str | None:
    """The name of the way that these parameters are; None where they are none of WAYS."""
    for name in WAYS:
        if all(math.isclose(values[key], value) for key, value in values_of(name).items()):
            return name
    return None


def own_values(damper: Damper) -> dict[str, float]:
    """The parameters of a damper that choose the way."""
    return {name: getattr(damper.parameters, name) for name in OWN}


def has_own(damper: Damper) -> bool:
    """Whether the parameter set states another way than DEFAULT."""
    return way_of(own_values(damper)) != DEFAULT


def with_freed_gas(damper: Damper, name: str) -> Damper:
    """The damper with a way, or as it is where its parameter set states one of its own; raises ParameterError."""
    values = values_of(name)
    return damper if has_own(damper) else damper.with_(**values)


def as_published(damper: Damper) -> Damper:
    """The damper with the paper's equations for the freed gas alone: it stays gas."""
    return with_freed_gas(damper, AS_PUBLISHED)


def acting(damper: Damper) -> str:
    """Which way a parameter set holds, in words."""
    values = own_values(damper)
    name = way_of(values)
    if name is not None:
        return f"{name}: {WAYS[name].says}"
    return "its own: " + ", ".join(f"{key} = {value:g}" for key, value in values.items() if value != 0.0)


def condition(damper: Damper, oil_level: float, gas_preload: float, name: str = DEFAULT) -> Damper:
    """The damper at an oil level with a way, or with the oil level as a factor of the fluid force (SCALAR)."""
    if name == SCALAR:
        return as_published(damper.with_(gas_preload=gas_preload, **scalar_factor(oil_level)))
    return with_freed_gas(damper.with_(oil_level=oil_level, gas_preload=gas_preload), name)
