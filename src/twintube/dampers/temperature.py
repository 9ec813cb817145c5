"""A damper at one temperature throughout a run: its parameters as the law of its temperature makes them.

For what has no temperature of its own, such as rides. `simulate` and the FMU take a temperature that changes.
"""

import math
import warnings

from twintube.core import messages
from twintube.core.checks import TEMPERATURE, outside
from twintube.core.kernel.forces import P_AMBIENT
from twintube.core.kernel.temperature import thickness, within_law
from twintube.dampers.damper import Damper, refuse
from twintube.errors import InputWarning


def at_temperature(damper: Damper, kelvins: float) -> Damper:
    """The damper as it is at a temperature [K]; raises ParameterError.

    Warns:
        InputWarning: the law of the damper does not hold there.

    """
    p = damper.parameters
    message = outside("temperature", kelvins, TEMPERATURE["lower"], TEMPERATURE["upper"], "K")
    refuse(damper.name, [message] if message else [])
    if not within_law(p, kelvins):
        text = messages.BEYOND_LAW % (kelvins, p.T_cold, p.T_hot)
        warnings.warn(f"{damper.name}: {text}", InputWarning, stacklevel=2)
    law = thickness(p, kelvins)
    fluid, friction, gas = math.exp(law), math.exp(p.friction_power * law), kelvins / p.T_curve
    ambient = P_AMBIENT * math.pi / 4 * p.D_PR**2
    return damper.with_(
        F_re=[fluid * F for F in p.F_re],
        F_co=[fluid * F for F in p.F_co],
        F_FrS=friction * p.F_FrS,
        sigma_0=friction * p.sigma_0,
        # Of the absolute pressure; a gas that has none above the ambient one does not pull.
        F_0=max(0.0, gas * p.F_0 + (gas - 1.0) * ambient) if p.F_0 > 0.0 else 0.0,
        c_gas=gas * p.c_gas,
        c_gas_lost=gas * p.c_gas_lost,
    )


def held_at(damper: Damper, kelvins: float) -> Damper:
    """The damper with the same law, its F-v curve, friction and gas being those measured at a temperature [K]."""
    p, share = damper.parameters, math.exp(thickness(damper.parameters, kelvins))
    return damper.with_(T_curve=kelvins, k_cold=p.k_cold / share, k_hot=p.k_hot / share)
