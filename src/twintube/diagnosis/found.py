"""What a hypothesis takes for the fill, where it is tried, and what was found of it."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from twintube.common.arrays import Array
from twintube.diagnosis.mechanisms import Mechanism, Strength
from twintube.diagnosis.sizes import Sizes

NOTHING = Mechanism("none", "none", "none", ())


@dataclass(frozen=True)
class Fill:
    """What a hypothesis takes for the fill: levels that are open, values that are not, and how likely that is."""

    levels: tuple[Strength, ...] = ()
    values: Mapping[str, float] = field(default_factory=dict)
    log_prior: float = 0.0
    name: str = "as_stated"
    other: bool = False  # than stated

    @property
    def start(self) -> Array:
        """Coordinates (k,) from which the levels are sought."""
        return np.array([0.5 if s.kind == "half" else 0.0 for s in self.levels])


@dataclass(frozen=True)
class Trial:
    """A mechanism at some coordinates (k,), the last of which are those of the levels."""

    u: Array
    base: Array  # (n,) [N] forces without the mechanism
    force: Array  # (n,) [N]
    values: Array  # (n, 1 + x) [N] errors, and what the mechanism may be off its law
    slopes: list[Array] = field(default_factory=list, compare=False)  # once they are known


@dataclass(frozen=True)
class Found:
    """A mechanism with its best strengths."""

    mechanism: Mechanism
    log_z: float
    exact: bool  # whether its law is, or is off as laws are
    at: Array  # (k,) coordinates of the strengths and levels
    values: dict[str, float]
    spread: dict[str, float]  # standard deviations
    levels: dict[str, float]
    sizes: Sizes
    weights: Array  # (n,)
    base: Array  # (n,) [N] without the mechanism, in the same fill
    force: Array  # (n,) [N]
