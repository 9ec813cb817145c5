"""What a cause may touch on its way from the rig's motion to the file."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from twintube.dampers import Damper

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Trial:
    """One record as planned: the rig's stroke `x` (n,) [m] at `rate` [Hz], and what the user knows of the damper."""

    index: int
    name: str
    measurement: str
    x: Array
    rate: float
    level: float
    preload: bool
    begin: float  # [s] since the start of the whole run

    @property
    def time(self) -> Array:
        """Times (n,) [s]."""
        return np.arange(len(self.x)) / self.rate


@dataclass
class Run:
    """What happened in the damper, arrays (n,) on the fine grid: its own stroke `z`, and the parts of the force [N]."""

    trial: Trial
    damper: Damper  # true parameters, level and preload
    z: Array
    v: Array
    fv: Array  # fluid force of the intact damper at `v`
    k: Array  # degradation factor
    fluid: Array
    friction: Array
    gas: Array
    reserve_gas: Array  # [m3]
    extra: Array  # other forces

    @property
    def force(self) -> Array:
        """Force of the damper [N]."""
        return self.fluid + self.friction + self.gas + self.extra


@dataclass
class Channels:
    """What the sensors give, on the fine grid; `factor` scales the times in the file."""

    trial: Trial
    stroke: Array
    force: Array
    factor: float = 1.0


class Rubber:
    """A mount: stiffness [N/m], cubic stiffness [N/m3] and damping [N s/m]."""

    def __init__(self, stiffness: float, cubic: float, damping: float) -> None:
        self.stiffness, self.cubic, self.damping = stiffness, cubic, damping


@dataclass
class Cause:
    """Nothing is changed; each cause overrides what it acts on."""

    name: str = "none"
    formulation: str = ""
    values: dict[str, Any] = field(default_factory=dict)
    acts_inside: bool = False  # `act` is to be called during the march
    rubber: Rubber | None = None

    def begin(self) -> None:
        """Before the first record of the run."""

    def damper(self, damper: Damper, trial: Trial) -> Damper:
        """The true damper of a record."""
        return damper

    def path(self, x: Array, trial: Trial) -> Array:
        """Stroke of the damper [m] where the rig moves by `x`."""
        return x

    def act(self, state: Any, derived: Any, trial: Trial, dt: float, way: float, fluid: float) -> None:
        """Change the volumes after `dt` [s] and the stroke `way` [m]; `fluid` is the mean size of the fluid force [N]."""

    def force(self, run: Run) -> None:
        """Change the parts of the force."""

    def measure(self, channels: Channels) -> None:
        """Change what the sensors give."""

    def sampled(self, force: Array, trial: Trial, fs: float) -> Array:
        """Change the sampled force (m,)."""
        return force
