"""What is possible but hardly meant: admissible values that belong to another unit.

Limits follow from other values of the same parameter set: forces from friction and tube, the way of the friction from
the stroke, the gas spring from the gas that compresses.
"""

import math

from twintube.core.effects import Parameters
from twintube.core.kernel import fluid_force
from twintube.core.variables import Derived
from twintube.dampers.dead_length import prepared, reserve_gas

V_TYPICAL = 1.0  # [m/s]: at this velocity dampers are compared, and none is weaker than its friction
STRENGTH = 1e9  # [Pa] tensile strength of the strongest steel of precision tubes
AMBIENT = 1.013e5  # [Pa]
SLIP = math.sqrt(1000.0)  # beyond this ratio a slip by 1000 (mm for m, N for kN) is nearer than the value itself


def doubts(p: Parameters) -> list[str]:
    """Messages about an admissible parameter set, each beginning with the name of the parameter."""
    d = prepared(p)
    curve = (("rebound", fluid_force(p, V_TYPICAL), d.A_1), ("compression", -fluid_force(p, -V_TYPICAL), d.A_2))
    texts = [text for branch, force, area in curve if (text := doubtful(branch, force, area, p))]
    reversal = 2.0 * p.F_FrS / p.sigma_0  # from one direction to the other, at the slope of the reversal
    if reversal > p.stroke_max:
        texts.append(
            f"friction.sigma_0 = {p.sigma_0:g} N/m: the friction of {p.F_FrS:g} N would need {reversal:.3g} m to turn "
            f"round, more than stroke_max = {p.stroke_max:g} m; check its unit"
        )
    return texts + gas(p, d)


def doubtful(branch: str, force: float, area: float, p: Parameters) -> str:
    """A message about a branch that is weaker than the friction or would burst the inner tube, else an empty string."""
    head, units = f"fv.{branch}: {force:.3g} N at {V_TYPICAL:g} m/s", "check velocity_unit and force_unit"
    if force < p.F_FrS:
        return f"{head} is less than the friction, {p.F_FrS:g} N; {units}"
    burst = (p.D_la - p.D_li) / p.D_li * STRENGTH  # Barlow's formula, 2 t/D times the strength
    if force / area > burst:
        return f"{head} would be {force / area / 1e5:.3g} bar, the inner tube bursts at {burst / 1e5:.3g} bar; {units}"
    return ""


def gas(p: Parameters, d: Derived) -> list[str]:
    """Messages about spring rates that the gas above the oil cannot have: p A_rod^2 / V if it is compressed slowly."""
    V_gas = reserve_gas(p, d)
    lost = AMBIENT * d.A_rod**2 / V_gas
    present = (AMBIENT + p.F_0 / d.A_rod) * d.A_rod**2 / V_gas
    texts = []
    # A rate of zero switches the spring off; without preload one near zero is usual.
    for name, rate, expected, least in (
        ("c_gas", p.c_gas, present, present / SLIP),
        ("c_gas_lost", p.c_gas_lost, lost, 0.0),
    ):
        if rate > 0.0 and not least <= rate <= expected * SLIP:
            texts.append(f"gas_spring.{name} = {rate:g} N/m: the gas would make about {expected:.3g} N/m; check its unit")
    return texts
