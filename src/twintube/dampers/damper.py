"""A damper: its parameter set, where the values come from, and what was measured."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import Field, dataclass, fields, replace
from typing import Any

from twintube.common.words import shown
from twintube.core.checks import problems
from twintube.core.effects import Parameters
from twintube.core.variables import fmi_name
from twintube.dampers.quantity import quantity
from twintube.errors import ParameterError as ParameterError  # noqa: PLC0414  # others have it from here

MOST_MESSAGES = 20
LONGEST_NAME = 60  # characters, of names that are compared
PERCENT = (2.0, 100.0)  # of a share between 0 and 1: what was meant as a percentage


@dataclass(frozen=True, repr=False)
class Damper:
    """A named, sourced and checked parameter set. Do not change its parameters; `with_` makes another one."""

    name: str
    title: str
    parameters: Parameters
    sources: Mapping[str, str]  # where the values come from, by group or by group and name
    assumed: Mapping[str, str]  # the same for stand-ins of unpublished values: the reasoning
    measured_levels: tuple[float, ...] = ()  # oil levels of the degraded states that were measured, highest first
    measured_amplitude: float | None = None  # [m] of the harmonic measurements, where it is not 90 % of the maximum stroke
    gas_pressure: float | None = None  # [Pa] gauge, cold, at which the gas spring was measured; see gas_spring.py

    def with_(self, **changes: Any) -> Damper:
        """The same damper with other parameters, e.g. `oil_level=0.4, gas_preload=0`; raises ParameterError.

        Values are SI numbers or quantities such as `"60 %"` or `"29.8 mm"`.
        """
        known = {item.name: item for item in fields(Parameters)}
        for name, value in changes.items():
            if name not in known:
                raise ParameterError(f"{self.name}: unknown parameter {name}{suggestion(name, known)}")
            if known[name].metadata["size"] > 1:
                continue
            try:
                number = float(quantity(value, known[name].metadata["unit"]) if isinstance(value, str) else value)
            except (TypeError, ValueError) as error:
                reason = error if isinstance(value, str) else f"{shown(value)} is not a number"
                raise ParameterError(f"{self.name}: {fmi_name(known[name])}: {reason}") from error
            if known[name].metadata["integer"] and not number.is_integer():
                raise ParameterError(f"{self.name}: {fmi_name(known[name])} = {number:g}: must be an integer")
            changes[name] = int(number) if known[name].metadata["integer"] else number
        changed = replace(self.parameters, **changes)
        refuse(self.name, explained(problems(changed), changed))
        return replace(self, parameters=changed)

    def __repr__(self) -> str:
        return f"<Damper {self.name}: {self.title}, {self.state}>"

    @property
    def state(self) -> str:
        """Oil and gas in words: `60 % oil, gas lost`."""
        return in_words(self.parameters.oil_level, self.parameters.gas_preload)


def in_words(oil_level: float, gas_preload: float) -> str:
    """A state: `60 % oil, gas lost`."""
    return f"{100 * oil_level:.4g} % oil, gas {gas_in_words(gas_preload)}"


def gas_in_words(gas_preload: float) -> str:
    """A share of the gas preload: `kept`, `lost` or `at 40 %`."""
    return {0.0: "lost", 1.0: "kept"}.get(gas_preload, f"at {100 * gas_preload:.4g} %")


def elements(damper: Damper) -> Iterator[tuple[str, Field[Any], int, float]]:
    """Name in the FMU, field of the table, index in an array (-1 where it is none) and value [SI] of every parameter."""
    for item in fields(Parameters):
        value, name = getattr(damper.parameters, item.name), fmi_name(item)
        if item.metadata["size"] == 1:
            yield name, item, -1, value
        else:
            for i, part in enumerate(value):
                yield f"{name}[{i + 1}]", item, i, part


def refuse(where: str, messages: list[str]) -> None:
    """Raise ParameterError with the messages, if there are any; after the first MOST_MESSAGES it only counts them."""
    if messages:
        raise ParameterError(f"{where}: {joined(messages)}")


def joined(messages: list[str]) -> str:
    """Messages in one line, the first MOST_MESSAGES and how many more there are."""
    rest = len(messages) - MOST_MESSAGES
    return "; ".join(messages[:MOST_MESSAGES]) + (f"; and {rest} more" if rest > 0 else "")


def explained(messages: list[str], p: Parameters) -> list[str]:
    """The messages about a parameter set, with the share where somebody gave a percentage."""
    for item in fields(p) if messages else ():
        value, meta = getattr(p, item.name), item.metadata
        if (
            meta["size"] == 1
            and (meta["unit"], meta["lower"], meta["upper"]) == ("1", 0.0, 1.0)
            and PERCENT[0] <= value <= PERCENT[1]
        ):
            head = f"{fmi_name(item)} = "
            messages = [text + f" ({value:g} % is {value / 100:g})" * text.startswith(head) for text in messages]
    return messages


def suggestion(name: str, known: Iterable[str]) -> str:
    """`, did you mean ...?` where a known name is close, whatever its case."""
    lower = {text.lower(): text for text in known}
    close = difflib.get_close_matches(name.lower(), lower, n=1) if len(name) <= LONGEST_NAME else []
    return f", did you mean {lower[close[0]]}?" if close else ""
