"""Worn or clogged valves: the F-v curve is scaled, its blow-off opens at less force, and a leak lets oil past the valves.

Each direction by itself. A blow-off spring that has lost preload takes a constant force away where the valve is open. It
opens gradually, between half of `opening_speed` and one and a half of it.

The leak is parallel to the valves: an orifice, or a narrow gap in which the flow is laminar, or both. At the force F it
passes bleed ((1 - laminar) sqrt(F / 1000 N) + laminar F / 1000 N), in terms of the speed of the piston, beside u_valve(F):
much force is lost at low speed, little at high speed. Within a segment of the F-v curve this is a quadratic equation for
sqrt(F). The scale acts on what remains.
"""

import math
from dataclasses import dataclass

from twintube.core import variables
from twintube.core.frame import Frame
from twintube.core.kernel.forces import branch
from twintube.core.variables import FV_POINTS, var

TITLE = "Change of the F-v curve"
CAUSE = "Worn, set, clogged or leaking valves make less or more force than the F-v curve of the parameter set."
ABSENCE = (
    "The residual goes with the fluid force, each direction by itself, from the first oscillation: in proportion to it, or "
    "most of it at low velocity."
)
DECIDES = "an intact reference measured on the same day, slow and fast"
NEEDS_TIME = False
ORDER = 200
F_BLEED = 1000.0  # [N]


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Relative change of each branch, and leak beside its valves."""

    wear_re: float = var("valve_wear", "", "1", "relative change of the fluid force in rebound", lower=-0.8, upper=1,
                         source="scaled F-v curve", default=0.0, role="strength")  # fmt: skip
    wear_co: float = var("valve_wear", "", "1", "relative change of the fluid force in compression", lower=-0.8, upper=1,
                         source="scaled F-v curve", default=0.0, role="strength")  # fmt: skip
    bleed_re: float = var("valve_wear", "", "m/s", "piston speed that a leak takes at 1000 N, rebound",
                          lower=0, upper=0.5, source="Dixon, Shock Absorber Handbook", default=0.0,
                          role="strength", nominal=0.05)  # fmt: skip
    bleed_co: float = var("valve_wear", "", "m/s", "the same in compression", lower=0, upper=0.5,
                          source="Dixon, Shock Absorber Handbook", default=0.0, role="strength",
                          nominal=0.05)  # fmt: skip
    opening_re: float = var("valve_wear", "", "N", "force lost by the open blow-off, rebound", lower=0, upper=1000,
                            source="Dixon, Shock Absorber Handbook", default=0.0,
                            role="strength")  # fmt: skip
    opening_co: float = var("valve_wear", "", "N", "the same in compression", lower=0, upper=1000,
                            source="Dixon, Shock Absorber Handbook", default=0.0,
                            role="strength")  # fmt: skip
    opening_speed: float = var("valve_wear", "", "m/s", "speed at which the blow-off is half open", lower=0.02, upper=2,
                               source="knee of the F-v curve", default=0.2, role="scale")  # fmt: skip
    bleed_laminar: float = var("valve_wear", "", "1", "share of the leak at 1000 N that is laminar", lower=0, upper=1,
                               source="gap of a worn piston ring", default=0.0, role="law")  # fmt: skip


def valve_wear_opening(p: Parameters, u: float, lost: float, F: float) -> float:
    """Factor [1] of the force `F` [N] at the speed `u` >= 0 [m/s] where the open blow-off has `lost` force [N]."""
    opened = min(1.0, max(0.0, u / p.opening_speed - 0.5))
    return max(0.0, 1.0 - opened * lost / F) if opened > 0.0 and F > 0.0 else 1.0


def valve_wear_scale_fluid(p: Parameters, s: Frame, v: float) -> float:
    """Factor of the fluid force [1] in the direction of `v`."""
    if v >= 0.0:
        opened = valve_wear_opening(p, v, p.opening_re, branch(v, p.v_re, p.F_re)) if p.opening_re > 0.0 else 1.0
        return (1.0 + p.wear_re) * opened
    opened = valve_wear_opening(p, -v, p.opening_co, branch(-v, p.v_co, p.F_co)) if p.opening_co > 0.0 else 1.0
    return (1.0 + p.wear_co) * opened


def valve_wear_leak(p: Parameters, bleed: float, F: float) -> float:
    """Speed [m/s] that a leak of `bleed` [m/s] takes at a force `F` >= 0 [N]."""
    return bleed * ((1.0 - p.bleed_laminar) * math.sqrt(F / F_BLEED) + p.bleed_laminar * F / F_BLEED)


def valve_wear_bypass(p: Parameters, F: float) -> float:
    """Speed [m/s] in the direction of the force `F` [N] that passes beside the valves."""
    if F >= 0.0:
        return valve_wear_leak(p, p.bleed_re, F)
    return -valve_wear_leak(p, p.bleed_co, -F)


def valve_wear_share(
    p: Parameters, u: float, bleed: float, velocities: tuple[float, ...], forces: tuple[float, ...]
) -> float:
    """Force of one branch at the speed `u` > 0 [m/s] over that without a leak of `bleed` [m/s] [1]."""
    i = 0
    while i < FV_POINTS - 1 and velocities[i] + valve_wear_leak(p, bleed, forces[i]) < u:
        i += 1
    v = 0.0
    F = 0.0
    if i > 0:
        v = velocities[i - 1]
        F = forces[i - 1]
    slope = (forces[i] - F) / (velocities[i] - v)
    # y = sqrt(force): y^2 = F + slope (u - v - orifice y - gap y^2) has the positive root
    rest = F + slope * (u - v)
    bend = slope * bleed * (1.0 - p.bleed_laminar) / math.sqrt(F_BLEED)
    more = 1.0 + slope * bleed * p.bleed_laminar / F_BLEED
    whole = branch(u, velocities, forces)
    if rest <= 0.0 or whole <= 0.0:
        return 1.0
    y = 2.0 * rest / (bend + math.sqrt(bend * bend + 4.0 * more * rest))
    return y * y / whole


def valve_wear_scale_valve(p: Parameters, u: float) -> float:
    """Factor of the intact fluid force [1] that the leak leaves at the speed `u` [m/s]."""
    if u > 0.0:
        return valve_wear_share(p, u, p.bleed_re, p.v_re, p.F_re) if p.bleed_re > 0.0 else 1.0
    if u < 0.0:
        return valve_wear_share(p, -u, p.bleed_co, p.v_co, p.F_co) if p.bleed_co > 0.0 else 1.0
    return 1.0
