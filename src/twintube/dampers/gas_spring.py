"""The gas spring at another pressure than that of the parameter set."""

import math

from twintube.dampers.damper import Damper

P_ATM = 1e5  # [Pa]


def pressure_of(damper: Damper) -> float:
    """Gauge pressure [Pa] at which F_0 and c_gas hold: as stated, else that which pushes the rod out with F_0."""
    p = damper.parameters
    return damper.gas_pressure if damper.gas_pressure is not None else p.F_0 / (0.25 * math.pi * p.D_PR**2)


def gas_factors(damper: Damper, pressure: float | None) -> tuple[float, float]:
    """Factors [1] of the gas force and of its stiffness at a gauge pressure [Pa]; 1 where it is not known."""
    if pressure is None or damper.parameters.F_0 <= 0.0:
        return 1.0, 1.0
    given = pressure_of(damper)
    return pressure / given, (pressure + P_ATM) / (given + P_ATM)


def gas_force(damper: Damper, pressure: float | None) -> float:
    """Gas force [N] at stroke 0 at a gauge pressure [Pa], by the rod's area where the parameter set has no gas force."""
    p = damper.parameters
    if pressure is not None and p.F_0 <= 0.0:
        return pressure * 0.25 * math.pi * p.D_PR**2
    return gas_factors(damper, pressure)[0] * p.F_0


def at_pressure(damper: Damper, pressure: float | None) -> Damper:
    """The damper with its gas at a gauge pressure [Pa]; as it is where that is not known. Raises ParameterError."""
    force, stiffness = gas_factors(damper, pressure)
    p = damper.parameters
    return damper if force == stiffness == 1.0 else damper.with_(F_0=force * p.F_0, c_gas=stiffness * p.c_gas)
