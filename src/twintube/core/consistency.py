"""What must hold between parameters, of times and of a restored state: rules of both kinds of FMU and the engine.

In the kernel's subset of Python, so that the native FMU runs the translation. Rules have numbers; their texts are in
`messages.py`. The bounds of single parameters are in the table, `variables.py`.
"""

from dataclasses import dataclass

from twintube.core.effects import Parameters, State
from twintube.core.frame import stroke_limit
from twintube.core.kernel.forces import P_AMBIENT
from twintube.core.kernel.prepare import prepare
from twintube.core.variables import FV_POINTS, Derived, var

# Times [s] that a simulation may have: their differences still resolve a step.
LONGEST = 1e12
# The longest communication step [s] that is safe with a wheel in the loop. The force is that of the step before and holds
# within this one: it comes one and a half steps late. A wheel hops at some 12 Hz, of which 2 ms are then 13 degrees: 3 % of
# the damping are lost; at 5 ms it is a sixth, at 10 ms more than half. `python -m benchmarks steps` measures it.
SAFE_STEP = 0.002
# Rounding may leave a phase [m3] this far below zero.
TRACE = 1e-12


@dataclass(slots=True)
class Violation:
    """What breaks a rule."""

    point: int = var("", "", "1", "point of the F-v curve, 0 for other rules", integer=True, default=0)
    value: float = var("", "", "1", "value that breaks the rule, in SI units", default=0.0)
    limit: float = var("", "", "1", "limit that it breaks, in SI units", default=0.0)


def note(violation: Violation, point: int, value: float, limit: float) -> None:
    """Keep what a message needs."""
    violation.point = point
    violation.value = value
    violation.limit = limit


def branch_rule(velocities: tuple[float, ...], forces: tuple[float, ...], after: int, violation: Violation) -> int:
    """Number 1 to 3 of the first rule beyond `after` that a branch of the F-v curve breaks, else 0."""
    if after < 1 and velocities[0] <= 0.0:
        note(violation, 1, velocities[0], 0.0)
        return 1
    if after < 2:
        for i in range(1, FV_POINTS):
            if velocities[i] <= velocities[i - 1]:
                note(violation, i + 1, velocities[i], velocities[i - 1])
                return 2
            if forces[i] < forces[i - 1]:
                note(violation, i + 1, forces[i], forces[i - 1])
                return 3
    return 0


def curve_rule(p: Parameters, after: int, violation: Violation) -> int:
    """Number of the first rule beyond `after`, 1 to 6, 16 or 17, that the F-v curve or its temperatures break, else 0."""
    if after < 3:
        rule = branch_rule(p.v_re, p.F_re, after, violation)
        if rule > 0:
            return rule
    rule = branch_rule(p.v_co, p.F_co, after - 3, violation)
    if rule > 0:
        return rule + 3
    if after < 16 and p.T_cold >= p.T_curve:
        note(violation, 0, p.T_cold, p.T_curve)
        return 16
    if after < 17 and p.T_hot <= p.T_curve:
        note(violation, 0, p.T_hot, p.T_curve)
        return 17
    return 0


def fit_rule(  # noqa: PLR0911 - a return for each rule
    p: Parameters, d: Derived, after: int, violation: Violation
) -> int:
    """Number of the first rule beyond `after`, 7 to 15, that the dimensions, the oil or the gas break, else 0.

    All parameters must be within their bounds. `d` is overwritten. Where the dimensions do not fit into each other, the
    volumes mean nothing and their rules are not asked.
    """
    if after < 7 and p.D_li <= p.D_PR:
        note(violation, 0, p.D_PR, p.D_li)
        return 7
    if after < 8 and p.D_li >= p.D_la:
        note(violation, 0, p.D_li, p.D_la)
        return 8
    if after < 9 and p.D_la >= p.D_a:
        note(violation, 0, p.D_la, p.D_a)
        return 9
    if after < 10 and p.dead_length >= p.h_l:
        note(violation, 0, p.dead_length, p.h_l)
        return 10
    if after >= 7 and after <= 11:
        return 0
    prepare(p, d)
    if p.stroke_max >= d.half_length:
        note(violation, 0, p.stroke_max, d.half_length)
        return 11
    stretched = d.A_1 * (d.half_length - p.stroke_max) + d.A_2 * (d.half_length + p.stroke_max)
    if after < 12 and p.V_oil < stretched:
        note(violation, 0, p.V_oil, stretched)
        return 12
    pushed = d.A_1 * (d.half_length + p.stroke_max) + d.A_2 * (d.half_length - p.stroke_max) + d.V_reserve
    if after < 13 and p.V_oil > pushed:
        note(violation, 0, p.V_oil, pushed)
        return 13
    if p.polytropic > 0:
        # Of both states: the preload may be lost later. The exponent has no say in whether there is room.
        ambient = P_AMBIENT * d.A_rod / p.stroke_max
        present = ambient + p.F_0 / p.stroke_max
        if after < 14 and p.c_gas >= present:
            note(violation, 0, p.c_gas, present)
            return 14
        if after < 15 and p.c_gas_lost >= ambient:
            note(violation, 0, p.c_gas_lost, ambient)
            return 15
    return 0


def time_slack(time: float, step: float) -> float:
    """Difference [s] of two communication points that is rounding: importers add up their steps, and end on a rest."""
    return 1e-9 * (1.0 + abs(time)) + 1e-3 * step


def possible(d: Derived, s: State) -> int:
    """1 where a restored state can be that of a damper: the piston in the tube, no phase below zero; else 0."""
    if abs(s.z) > stroke_limit(d) or s.k_degr < 0.0:
        return 0
    if s.V1_oil < -TRACE or s.V1_gas < -TRACE or s.V1_foam < -TRACE or s.V1_foam_oil < -TRACE or s.V1_void < -TRACE:
        return 0
    if s.V2_oil < -TRACE or s.V2_gas < -TRACE or s.V2_foam < -TRACE or s.V2_foam_oil < -TRACE:
        return 0
    return 0 if s.V3_oil < -TRACE or s.V3_foam < -TRACE or s.V3_foam_oil < -TRACE else 1
