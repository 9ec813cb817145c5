"""What a claim's evaluation says, and the works it is made from."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from twintube.arrays import Array
from twintube.parameters import Damper
from twintube.rig import harmonic_block
from twintube.simulate import work_between

Dampers = dict[str, Damper]
FRONT = ("SA1", "SA3", "SA5", "SA7")
REAR = ("SA2", "SA4", "SA6", "SA8")


@dataclass(frozen=True)
class Claim:
    """One statement of the paper and what the model says to it."""

    id: str
    statement: str
    source: str
    holds: bool
    figures: dict[str, object]
    needs: str  # unpublished data that the statement or its check rests on, with the stand-in used
    reason: str = ""  # why it does not hold
    calibrated: bool = False
    assumed: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "holds", bool(self.holds))  # numpy's own bool is no JSON

    @property
    def evidence(self) -> bool:
        """True where the claim was neither used for the calibration nor put in by assumption."""
        return not (self.calibrated or self.assumed)


@lru_cache(maxsize=4096)
def cached_works(key: tuple[object, ...], velocity: float) -> Array:
    """Works [J] of the 19 oscillations; the key carries the damper."""
    damper = key[0]
    assert isinstance(damper, Keyed)
    block = harmonic_block(velocity)
    return work_between(damper.damper, block.stroke, block.velocity, block.marks)


class Keyed:
    """A damper that hashes by its parameters, so that runs shared by claims are made once."""

    def __init__(self, damper: Damper) -> None:
        self.damper = damper
        self.key = repr(damper.parameters)

    def __hash__(self) -> int:
        return hash(self.key)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Keyed) and self.key == other.key


def works(damper: Damper, oil_level: float, velocity: float) -> Array:
    """Works [J] of the 19 oscillations at the maximum `velocity` [m/s], the gas preload lost unless full of oil."""
    state = damper.with_(oil_level=oil_level, gas_preload=1 if oil_level == 1.0 else 0)
    return cached_works((Keyed(state),), velocity)


def relative(damper: Damper, oil_level: float, velocity: float) -> Array:
    """Works of the 19 oscillations relative to the first one of the intact damper [1]."""
    share: Array = works(damper, oil_level, velocity) / works(damper, 1.0, velocity)[0]
    return share


def rounded(value: float, digits: int = 3) -> float:
    """A figure for a report."""
    return float(np.round(value, digits))
