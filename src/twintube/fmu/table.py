"""All variables of a damper's FMU in the order of their value references, the same in both kinds of FMU."""

from collections.abc import Iterator, Sequence
from dataclasses import Field, dataclass, fields
from typing import Any

from twintube.core.checks import tube_limit
from twintube.core.variables import Inputs, Outputs, fmi_name, var
from twintube.dampers import Damper, elements


@dataclass(frozen=True)
class Variable:
    """One scalar variable; `index` is its place in an array, -1 where it is none."""

    name: str
    causality: str
    item: Field[Any]
    index: int
    start: float | None  # None for outputs
    place: str  # in `struct memory` of the native FMU
    bounds: tuple[float | None, float | None]

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


@dataclass
class Independent:
    """What FMI 3.0 wants as a variable too."""

    time: float = var("", "t", "s", "time: where the last step ended")


TIME = Variable("time", "independent", fields(Independent)[0], -1, None, "time", (None, None))


def bounds(item: Field[Any]) -> tuple[float | None, float | None]:
    """The bounds that the table of variables gives."""
    return item.metadata["lower"], item.metadata["upper"]


def variables(damper: Damper) -> Iterator[Variable]:
    """Inputs, outputs and parameters, arrays element by element.

    The bounds of the stroke are where the piston reaches the ends of this damper's tube, the temperature starts where its
    parameters hold.
    """
    limit = tube_limit(damper.parameters)
    for item in fields(Inputs):
        ends = (-limit, limit) if item.name == "stroke" else bounds(item)
        start = damper.parameters.T_curve if item.name == "temperature" else item.metadata["default"]
        yield Variable(fmi_name(item), "input", item, -1, start, f"now.{item.name}", ends)
    for item in fields(Outputs):
        yield Variable(fmi_name(item), "output", item, -1, None, f"now.out.{item.name}", bounds(item))
    for name, item, i, value in elements(damper):
        place = f"wanted.p.{item.name}" if i < 0 else f"wanted.p.{item.name}[{i}]"
        yield Variable(name, "parameter", item, i, value, place, bounds(item))


def lengths(variables: Sequence[Variable], arrays: bool) -> list[int]:
    """The number of values that belong to each value reference; 0 for those of an array that is one variable."""
    counts = [1] * len(variables)
    for place, variable in enumerate(variables):
        if arrays and variable.index > 0:
            counts[place] = 0
            counts[place - variable.index] += 1
    return counts


def array_name(parts: Sequence[Variable]) -> str:
    """The name of an array of these elements, or of the single variable."""
    return parts[0].name if len(parts) == 1 else parts[0].name.removesuffix("[1]")
