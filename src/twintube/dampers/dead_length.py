"""The dead length: tube that piston, stops and foot valve take from the working chambers. It is unpublished and decides.

Between its bounds lies the answer to the question at which oil level a damper collapses: `collapse_level`.
"""

import math

from twintube.core.kernel import prepare
from twintube.core.variables import Derived, Parameters, blank
from twintube.dampers.damper import Damper

# Piston with its valves 30-40 mm, foot valve 15-25 mm, rebound stop 15-35 mm and clearances; stops fill the annulus only.
SHORTEST, LONGEST = 0.060, 0.110  # [m]
# Absolute pressures [bar]: a twin-tube damper is filled to 6-8 bar (PMG Sinter, 18 Nov 2021) or 3.4-6.9 bar (KYB), a
# monotube to 20-30 bar (kfz-tech.de). No pressure is published for full compression; a low-pressure seal is assumed to stay
# below the monotube's filling pressure. The bound is of a slow compression: as driven, 20 bar are 30 (p V^1.35).
FILLED, HIGHEST = 6.0, 20.0
NAME = "geometry.dead_length"  # in the tables of sources
GRID = 1e-3  # [m] to which a bound is rounded, inwards


def beyond_parts(damper: Damper) -> str:
    """Why a dead length is refused that the parts of a car's damper do not take; empty where it is none or measured.

    A damper of another build may have another length. Whoever measured it says so among the sources of the parameter set;
    what is assumed stays within the sums of parts.
    """
    length = damper.parameters.dead_length
    if SHORTEST <= length <= LONGEST or (NAME in damper.sources and NAME not in damper.assumed):
        return ""
    instead = ", and delete it under [assumed]" if NAME in damper.assumed else ""
    return (
        f"{NAME} = {length:g} m: must be from {SHORTEST:g} to {LONGEST:g} m, which piston with valves (30-40 mm), foot "
        "valve (15-25 mm) and rebound stop (15-35 mm) take; it decides at which oil level the damper fails. If you measured "
        f'it, say so under [sources]: "{NAME}" = "measured ..."{instead}'
    )


def prepared(p: Parameters) -> Derived:
    """Areas and volumes of a parameter set."""
    d: Derived = blank(Derived)
    prepare(p, d)
    return d


def collapse_level(damper: Damper) -> float:
    """Oil level [1] below which the two working chambers are not full with the piston in the middle.

    The oil is then (A_1 + A_2) l / 2, where l = h_l - dead_length is the length left for both chambers. Above it a damper
    that moves little (on an inspection bench) works as an intact one, below it the piston draws gas. A stroke z to one side
    moves A_rod z of oil, which spreads the level. It is above 1 if the intact oil does not fill the chambers.
    """
    d = prepared(damper.parameters)
    return (d.A_1 + d.A_2) * d.half_length / damper.parameters.V_oil


def reserve_gas(p: Parameters, d: Derived) -> float:
    """Gas volume [m3] in the reserve of the intact damper, with the piston in the middle."""
    return (d.A_1 + d.A_2) * d.half_length + d.V_reserve - p.V_oil


def pressure(damper: Damper, n: float = 1.0) -> float:
    """Absolute gas pressure [bar] of the intact damper at full compression; infinite if the oil leaves no volume for it.

    `n` is the exponent of the compression: 1 slow, `damper.parameters.n_gas` as driven.
    """
    p, d = damper.parameters, prepared(damper.parameters)
    gas = reserve_gas(p, d)
    compressed = gas - d.A_rod * p.stroke_max
    return FILLED * (gas / compressed) ** n if compressed > 0.0 else math.inf


def bounds(damper: Damper) -> tuple[float, float]:
    """The shortest and the longest dead length [m] that parts, gas pressure and maximum stroke admit, to a millimetre.

    A damper of another build, whose own dead length is beyond them, has its own one as bound.
    """
    p, d = damper.parameters, prepared(damper.parameters)
    gas_needed = d.A_rod * p.stroke_max * HIGHEST / (HIGHEST - FILLED)
    by_pressure = p.dead_length + 2.0 * (reserve_gas(p, d) - gas_needed) / (d.A_1 + d.A_2)
    by_stroke = p.h_l - 2.0 * p.stroke_max
    longest = min(LONGEST, GRID * math.floor(min(by_pressure, by_stroke) / GRID - 1e-6))
    return min(SHORTEST, p.dead_length), max(longest, p.dead_length)
