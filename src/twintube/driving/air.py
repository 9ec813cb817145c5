"""How much the cold thickens the oil of the dampers, by the temperature of the air: how a reference in winter differs."""

from functools import lru_cache
from typing import Final

from twintube.core.checks import KELVIN
from twintube.core.kernel.temperature import thickness
from twintube.core.variables import Parameters
from twintube.dampers import load

WARMER: Final = 12.0  # [K] of the oil over the air, assumed: between a cold start and an hour on a rough road


@lru_cache
def usual() -> Parameters:
    """The parameters whose law is taken for the dampers of any car."""
    return load("SA8").parameters


def cold(air: float) -> float:
    """Logarithm of the fluid force in air of so many degC over that at the temperature of the F-v curve."""
    return thickness(usual(), air + WARMER + KELVIN)
