"""Oil is lost past the rod seal: a film on the rod, at 0.1 m/s `leak_film` of volume per stroke travelled.

The film grows with the speed to the power leak_power - 1: a film of constant thickness has 1, a leak under constant pressure
0, the film that viscosity draws out lies between. Records of a rig fix the loss at 0.1 m/s, whatever the power.

It comes from the reserve, where the seal is. Without oil there, the share `leak_beyond` of it goes on: the rod guide passes
on what V1 presses through it and what then misses in V2, whose oil gives way to gas; V1 itself draws no gas while it is
under pressure.

Past a cut through seal and guide the pressure of V1 drives oil out as through an orifice. Gas takes its place at once: the
force falls by the share of the oil that no longer passes the valves.
"""

import math
from dataclasses import dataclass

from twintube.core import variables
from twintube.core.frame import Frame
from twintube.core.variables import var

OIL = 870.0  # [kg/m3] density
F_USUAL = 1000.0  # [N] fluid force at which a cut loses oil in half of the time of records before

TITLE = "Oil leaks past the rod seal"
CAUSE = "A worn seal lets a film of oil out with every stroke, so that the oil level falls during the measurement."
ABSENCE = "The measured damper loses force over the whole measurement, also at low velocity, and does not recover at rest."
DECIDES = "a rest of ten minutes within a record, and the oil weighed afterwards"
NEEDS_TIME = True
ORDER = 40


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """The film's cross-section and what it depends on; the cut's area."""

    leak_film: float = var("seal_leak", "", "m2", "oil lost per stroke travelled, at 0.1 m/s", lower=0, upper=1e-5,
                           source="Mueller and Nau, Fluid Sealing Technology", default=0.0,
                           role="strength")  # fmt: skip
    leak_power: float = var("seal_leak", "", "1", "oil lost per time goes with the speed to this power", lower=0, upper=2,
                            source="1: constant film", default=1.0, role="law")  # fmt: skip
    leak_beyond: float = var("seal_leak", "", "1", "share of the film's loss with an empty reserve",
                             lower=0, upper=1, source="flow through the rod guide",
                             default=1.0, role="law")  # fmt: skip
    cut_area: float = var("seal_leak", "", "m2", "area of a cut, times its discharge coefficient", lower=0, upper=1e-7,
                          source="Merritt, Hydraulic Control Systems", default=0.0, role="strength")  # fmt: skip


@dataclass(slots=True)
class State(Frame):
    """What is outside."""

    V_lost: float = var("seal_leak", "", "m3", "oil lost since the start", default=0.0)


def cut_flow(p: Parameters, F: float) -> float:
    """Oil [m3/s] through the cut at a fluid force F [N] in rebound, which the ring of the piston carries."""
    ring = 0.25 * math.pi * (p.D_li * p.D_li - p.D_PR * p.D_PR)
    return p.cut_area * math.sqrt(2.0 * F / (OIL * ring))


def seal_leak_phases(p: Parameters, s: State, way: float, dt: float) -> None:
    """Take the oil for the stroke `way` >= 0 [m]."""
    left = p.leak_film * way
    if p.leak_power != 1.0 and dt > 0.0:
        left = p.leak_film * 0.1 * dt * math.pow(way / (0.1 * dt), p.leak_power)
    oil = min(left, s.V3_oil)
    s.V3_oil -= oil
    s.V_lost += oil
    left = (left - oil) * p.leak_beyond
    if left > 0.0:
        oil = min(left, s.V2_oil)
        s.V2_oil -= oil
        s.V2_gas += oil
        s.V_lost += oil
        left -= oil
    if left > 0.0:
        oil = min(left, s.V3_foam_oil)
        s.V3_foam_oil -= oil
        s.V3_foam = s.V3_foam - oil if s.V3_foam_oil > 0.0 else 0.0
        s.V_lost += oil
        left -= oil
    if left > 0.0:
        oil = min(left, s.V1_oil)
        s.V1_oil -= oil
        s.V1_gas += oil
        s.V_lost += oil
    if p.cut_area > 0.0 and s.F_fluid > 0.0 and way > 0.0:
        oil = min(cut_flow(p, s.F_fluid) * dt, s.V1_oil)
        s.V1_oil -= oil
        s.V1_gas += oil
        s.V_lost += oil


def seal_leak_lost(p: Parameters, level: float, z: float, duration: float, way: float, square: float) -> float:
    """Oil [m3] lost in a `duration` [s] of a `way` [m], where the squared speed has the integral `square` [m2/s].

    That of the speed to a power between those of the three is taken by the parabola of their logarithms, a cut's at a usual
    force. The film takes the reserve of a fill `level` [1] at the innermost stroke `z` [m] first.
    """
    if duration <= 0.0 or way <= 0.0 or square <= 0.0:
        return 0.0
    cut = 0.5 * duration * cut_flow(p, F_USUAL)
    n = p.leak_power
    low = 0.5 * (n - 1.0) * (n - 2.0) * math.log(duration)
    high = 0.5 * n * (n - 1.0) * math.log(square)
    film = p.leak_film * 0.1 * math.exp(low + n * (2.0 - n) * math.log(way) + high - n * math.log(0.1))
    tube = 0.25 * math.pi * p.D_li * p.D_li
    ring = tube - 0.25 * math.pi * p.D_PR * p.D_PR
    half = 0.5 * (p.h_l - p.dead_length)
    reserve = max(0.0, level * p.V_oil - tube * (half + z) - ring * (half - z))
    return cut + min(film, reserve) + p.leak_beyond * max(0.0, film - reserve)
