"""A table of force over velocity in the place of a record."""

from collections.abc import Iterable

CURVE = (
    "an F-v table, not a record of time, stroke and force: its points go into [fv] of a parameter file, "
    "which `twintube dampers SA8 > mine.toml` writes"
)


def is_curve(quantities: Iterable[str]) -> bool:
    """Whether columns of these quantities are points of an F-v curve."""
    there = set(quantities)
    return {"velocity", "force"} <= there and not {"time", "stroke"} & there
