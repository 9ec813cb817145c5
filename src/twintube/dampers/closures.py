"""What becomes of the gas that cavitation frees, and of the oil in whose place it is: the closures of equations 40 and 41.

The paper's own model (`letter`) turns oil into gas for good. That is meant for blocks of seconds, on which Y was fitted: its
own measurements rest for 180 s and find the damper as before. Section 3.2 names the time scales. Each closure is a set of
effects; records of a few seconds (identification, claims) use the letter, rides and FMUs the closure DEFAULT.
"""

import math
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

from twintube.core.effects import EFFECTS
from twintube.dampers import Damper, ParameterError
from twintube.dampers.variants import scalar_factor

HALF_LIFE_RETURN: Final = (6.1, 10.2)  # [s] until half of the gas is dissolved again, Section 3.2
HALF_LIFE_RELEASE: Final = (3.6, 7.6)  # [s] until half of the dissolved gas is released, Section 3.2
SOLUBILITY: Final = (0.093, 0.113)  # gas per oil volume at ambient pressure, Section 3.2
P_GAS: Final = 0.3  # [bar] absolute, at which the gas sits that `exhausted` counts (assumed)


def rate(half_life: float) -> float:
    """First-order rate [1/s] of a half-life [s]."""
    return math.log(2.0) / half_life


MEAN_RETURN: Final = sum(HALF_LIFE_RETURN) / 2
RETURNING = {"redissolution_rate": rate(MEAN_RETURN)}


@dataclass(frozen=True)
class Closure:
    """One reading: the parameters that it sets, and what it says."""

    name: str
    says: str
    parameters: MappingProxyType[str, float]


def closure(name: str, says: str, **parameters: float) -> Closure:
    """A closure with its parameters."""
    return Closure(name, says, MappingProxyType(parameters))


CLOSURES: Final = {item.name: item for item in (
    closure("letter", "equations 40 and 41 alone: oil becomes gas for good"),
    closure("return", f"half of the gas dissolves again in {MEAN_RETURN:.3g} s, the middle of Section 3.2", **RETURNING),
    closure("return_fast", f"half of the gas dissolves again in {HALF_LIFE_RETURN[0]} s",
            redissolution_rate=rate(HALF_LIFE_RETURN[0])),
    closure("return_slow", f"half of the gas dissolves again in {HALF_LIFE_RETURN[1]} s",
            redissolution_rate=rate(HALF_LIFE_RETURN[1])),
    closure("exhausted", f"return, and the oil frees no more gas than it holds, at {P_GAS} bar", **RETURNING,
            exhaustion=P_GAS * 2 / sum(SOLUBILITY)),
    closure("half_displaced", "return, and half of the oil stays in the reserve instead of being lost", **RETURNING,
            displaced_share=0.5),
    closure("displaced", "freed gas displaces oil into the reserve: oil is conserved", displaced_share=1.0),
)}  # fmt: skip
LETTER: Final = "letter"
DEFAULT: Final = "return"
# The default and the furthest to either side: what is said of vehicles and inspections is varied over these.
READINGS: Final = (DEFAULT, LETTER, "exhausted", "displaced")
SCALAR: Final = "scalar factor"  # variant 1 of Section 3.4: no closure, the usual shortcut
GAS = ("gas_redissolution", "gas_exhaustion", "oil_displacement")  # the effects that a closure is made of
OWN = tuple(name for effect in GAS for name in EFFECTS[effect].strength)


def has_own(damper: Damper) -> bool:
    """Whether the parameter set says itself what becomes of the gas."""
    return any(getattr(damper.parameters, name) != 0.0 for name in OWN)


def closed(damper: Damper, name: str = DEFAULT) -> Damper:
    """The damper with a closure, or as it is where its parameter set has one of its own; raises ParameterError."""
    if name not in CLOSURES:
        raise ParameterError(f"unknown closure {name}: must be one of {', '.join(CLOSURES)}")
    return damper if has_own(damper) else damper.with_(**CLOSURES[name].parameters)


def acting(damper: Damper) -> str:
    """Which closure a parameter set holds, in words."""
    values = {name: getattr(damper.parameters, name) for name in OWN}
    for item in CLOSURES.values():
        if all(math.isclose(values[name], item.parameters.get(name, 0.0)) for name in OWN):
            return f"{item.name}: {item.says}"
    return "its own: " + ", ".join(f"{name} = {value:g}" for name, value in values.items() if value != 0.0)


def condition(damper: Damper, oil_level: float, gas_preload: int, name: str = DEFAULT) -> Damper:
    """The damper at an oil level with a closure, or with the oil level as a factor of the fluid force (SCALAR)."""
    if name == SCALAR:
        return damper.with_(gas_preload=0, **scalar_factor(oil_level))
    return closed(damper.with_(oil_level=oil_level, gas_preload=gas_preload), name)
