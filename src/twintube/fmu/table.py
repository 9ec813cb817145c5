"""All variables of the FMU in the order of their value references, the same in both kinds of FMU."""

from collections.abc import Iterator
from dataclasses import Field, dataclass, fields
from typing import Any

from twintube.core.variables import Inputs, Outputs, fmi_name
from twintube.dampers import Damper, elements


@dataclass(frozen=True)
class Variable:
    """One scalar variable; `index` is its place in an array, -1 where it is none."""

    name: str
    causality: str
    item: Field[Any]
    index: int
    start: float | None  # None for outputs

    @property
    def variability(self) -> str:
        """As FMI calls it."""
        if self.causality != "parameter":
            return "continuous"
        return "tunable" if self.item.metadata["tunable"] else "fixed"

    @property
    def integer(self) -> bool:
        """Whether it is an Integer variable."""
        return bool(self.item.metadata["integer"])


def variables(damper: Damper) -> Iterator[Variable]:
    """Inputs, outputs and parameters, arrays element by element."""
    for item in fields(Inputs):
        yield Variable(fmi_name(item), "input", item, -1, item.metadata["default"])
    for item in fields(Outputs):
        yield Variable(fmi_name(item), "output", item, -1, None)
    for name, item, i, value in elements(damper):
        yield Variable(name, "parameter", item, i, value)
