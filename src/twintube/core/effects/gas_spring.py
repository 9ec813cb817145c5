"""Residual preload: a gas force c_residual z - F_residual in the states whose preload is taken as lost.

A constant force alone (c_residual = 0) cannot be told from an offset of the force sensor.
"""

from dataclasses import dataclass

from twintube.core import variables
from twintube.core.variables import var

TITLE = "Residual or wrong gas preload"
CAUSE = "Gas pressure is left where it is taken as lost, or the preload differs from the one of the parameter set."
ABSENCE = "The residual is a straight line over the stroke, the same in both directions and at every velocity."
DECIDES = "a quasi-static record of the degraded damper over the whole stroke"
NEEDS_TIME = False


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Stiffness and force."""

    c_residual: float = var("gas_spring", "", "N/m", "gas spring stiffness beyond c_gas", lower=-2e4, upper=2e4,
                            source="linearised polytropic compression", default=0.0, role="strength")  # fmt: skip
    F_residual: float = var("gas_spring", "", "N", "gas force at stroke 0 beyond F_0 (pushes the rod out)", lower=-2000,
                            upper=2000, source="pressure times the rod's cross-section", default=0.0,
                            role="strength")  # fmt: skip


def gas_spring_elastic(p: Parameters, z: float) -> float:
    """Force [N] at the stroke `z` [m]; with preload the gas spring of the parameter set is measured, not assumed."""
    if p.gas_preload > 0:
        return 0.0
    return p.c_residual * z - p.F_residual
