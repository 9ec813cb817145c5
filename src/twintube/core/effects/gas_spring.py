"""Gas pressure that is not the one of the parameter set.

With preload the gas is charged too much or too little: F_surplus at stroke 0, and stiffness with it, as that of enclosed
gas goes with its absolute pressure. Where the preload is taken as lost some is left: a gas force c_residual z - F_residual.
There a constant force alone (c_residual = 0) cannot be told from an offset of the force sensor. In between each acts by
its share of the preload.
"""

import math
from dataclasses import dataclass

from twintube.core import variables
from twintube.core.frame import Frame
from twintube.core.kernel.forces import P_AMBIENT, gas_rise
from twintube.core.variables import var

TITLE = "Residual or wrong gas preload"
CAUSE = "The gas pressure differs from that of the parameter set, or some is left where it is taken as lost."
ABSENCE = "The residual is a straight line over the stroke, the same in both directions and at every velocity."
DECIDES = "a quasi-static record over the whole stroke, and the gas pressure read at the valve"
NEEDS_TIME = False
ORDER = 110


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Force with preload; stiffness and force without."""

    F_surplus: float = var("gas_spring", "", "N", "gas force beyond F_0, with preload",
                           lower=-1000, upper=1000, source="pressure times the rod's cross-section",
                           default=0.0, role="strength")  # fmt: skip
    c_residual: float = var("gas_spring", "", "N/m", "gas spring stiffness beyond c_gas_lost, preload lost",
                            lower=-2e4, upper=2e4, source="linearised polytropic compression", default=0.0,
                            role="strength")  # fmt: skip
    F_residual: float = var("gas_spring", "", "N", "gas force at stroke 0, preload lost",
                            lower=-2000, upper=2000, source="pressure times the rod's cross-section", default=0.0,
                            role="strength")  # fmt: skip


def gas_spring_elastic(p: Parameters, s: Frame, z: float) -> float:
    """Force [N] at the stroke `z` [m]."""
    whole = p.F_0 + P_AMBIENT * 0.25 * math.pi * p.D_PR * p.D_PR
    surplus = p.F_surplus * (gas_rise(p, p.F_0, p.c_gas, z) / whole - 1.0)
    return p.gas_preload * surplus + (1.0 - p.gas_preload) * (p.c_residual * z - p.F_residual)
