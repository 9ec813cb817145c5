"""A damper: its parameter set, where the values come from, and what was measured."""

import difflib
from collections.abc import Iterator, Mapping
from dataclasses import Field, dataclass, fields, replace
from typing import Any

from twintube.core.checks import problems
from twintube.core.effects import Parameters
from twintube.core.variables import fmi_name


class ParameterError(ValueError):
    """A parameter set that cannot be used; the message names file, line, quantity, value and allowed range."""


@dataclass(frozen=True)
class Damper:
    """A named, sourced and checked parameter set. Do not change its parameters; `with_` makes another one."""

    name: str
    title: str
    parameters: Parameters
    sources: Mapping[str, str]  # where the values come from, by group or by group and name
    assumed: Mapping[str, str]  # the same for stand-ins of unpublished values: the reasoning
    measured_levels: tuple[float, ...] = ()  # oil levels of the degraded states that were measured, highest first
    measured_amplitude: float | None = None  # [m] of the harmonic measurements, where it is not 90 % of the maximum stroke

    def with_(self, **changes: Any) -> "Damper":
        """The same damper with other parameters, e.g. `oil_level=0.4, gas_preload=0`; raises ParameterError."""
        known = {item.name for item in fields(Parameters)}
        for name in changes:
            if name not in known:
                raise ParameterError(f"{self.name}: unknown parameter {name}{suggestion(name, known)}")
        changed = replace(self.parameters, **changes)
        refuse(self.name, problems(changed))
        return replace(self, parameters=changed)


def elements(damper: Damper) -> Iterator[tuple[str, Field[Any], int, float]]:
    """Name in the FMU, field of the table, index in an array (-1 where it is none) and value [SI] of every parameter."""
    for item in fields(Parameters):
        value, name = getattr(damper.parameters, item.name), fmi_name(item)
        if item.metadata["size"] == 1:
            yield name, item, -1, value
        else:
            for i, part in enumerate(value):
                yield f"{name}[{i + 1}]", item, i, part


def refuse(where: str, found: list[str]) -> None:
    """Raise ParameterError with all messages, if there are any."""
    if found:
        raise ParameterError(f"{where}: " + "; ".join(found))


def suggestion(name: str, known: Any) -> str:
    """`, did you mean ...?` where a known name is close."""
    close = difflib.get_close_matches(name, known, n=1)
    return f", did you mean {close[0]}?" if close else ""
