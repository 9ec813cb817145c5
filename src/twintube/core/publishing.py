"""From the table of outputs to the functions that fill them in, the same for every engine."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from typing import Any

from twintube.core import outputs
from twintube.core.variables import Derived, Outputs, State

NAMES = tuple(item.name for item in fields(Outputs))
VALUES = {item.name: str(item.metadata["value"]) for item in fields(Outputs)}


def publishing_source() -> str:
    """The text of `publish(d, s, o)`, which fills a record after a step, and of `publish_row(d, s, row)` for a row (m,)."""
    record = "".join(f"    o.{name} = {value}\n" for name, value in VALUES.items())
    row = "".join(f"    row[{i}] = {value}\n" for i, value in enumerate(VALUES.values()))
    return (
        f"def publish(d: Derived, s: State, o: Outputs) -> None:\n{record}\n\n"
        f"def publish_row(d: Derived, s: State, row: Vector) -> None:\n{row}"
    )


made = {name: getattr(outputs, name) for name in ("total_force", "degradation", "heat_flow", "reserve_gas")}
exec(compile(publishing_source(), "<outputs>", "exec", flags=annotations.compiler_flag), made)
publish: Callable[[Derived, State, Any], None] = made["publish"]
publish_row: Callable[[Derived, State, Any], None] = made["publish_row"]
