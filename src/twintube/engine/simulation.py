"""The result of a simulation: forces and volumes over a record."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

from twintube.common.arrays import Array, freeze_arrays
from twintube.common.showing import data_frame, picture
from twintube.core.publishing import NAMES
from twintube.core.variables import Outputs

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


@dataclass(frozen=True, repr=False, kw_only=True)
class Simulation(Outputs[Array]):
    """What `simulate` returns; all arrays (n,), read-only, SI units, row i belongs to sample i of the record.

    `units` names the unit of each array. `to_dataframe()` and `plot()` show the whole.
    """

    stroke: Array  # [m]
    velocity: Array  # [m/s]
    time: Array | None = None  # [s], None where `simulate` was not given the times of the samples

    def __post_init__(self) -> None:
        """Nobody writes into a result."""
        freeze_arrays(self)

    @property
    def columns(self) -> dict[str, Array]:
        """The results by name, without the inputs."""
        return {name: getattr(self, name) for name in NAMES}

    @property
    def units(self) -> dict[str, str]:
        """The unit of each array by its name."""
        return INPUTS | {item.name: item.metadata["unit"] for item in fields(Outputs)}

    def to_dataframe(self) -> pd.DataFrame:
        """A row for each sample, over the time [s] where it is known; the units stand in `.attrs["units"]`.

        Raises UserError where pandas is not installed.
        """
        given = {name: getattr(self, name) for name in INPUTS if name != "time" or self.time is not None}
        return data_frame(given | self.columns, self.units, index=None if self.time is None else "time")

    def plot(self) -> Figure:
        """Draw force over stroke, velocity and time as a figure of pyplot."""
        return picture(self)

    def __repr__(self) -> str:
        long = "" if self.time is None else f", {self.time[-1] - self.time[0]:.4g} s"
        return (
            f"<Simulation: {len(self.force)} samples{long}, force {self.force.min():.0f} to {self.force.max():.0f} N, "
            f"{self.work[-1]:.4g} J dissipated>"
        )


INPUTS = {"time": "s", "stroke": "m", "velocity": "m/s"}
