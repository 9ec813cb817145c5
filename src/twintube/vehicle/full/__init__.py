"""The whole car: body, four wheels with tyres, four dampers, brakes."""

from pathlib import Path

PACKAGE = Path(__file__).parents[2]
# The equations of the car without dampers, for the translation to C.
EQUATIONS = (
    "vehicle/quarter_car.py",
    "vehicle/full/tyre.py",
    "vehicle/full/brakes.py",
    "vehicle/full/layout.py",
    "vehicle/full/body.py",
    "vehicle/full/driver.py",
    "vehicle/full/exchange.py",
)


def equation_texts() -> list[str]:
    """Their sources."""
    return [(PACKAGE / name).read_text(encoding="utf-8") for name in EQUATIONS]
