"""Compressible oil with trapped air, and valves that close late.

Three things follow one another. While the check valves close, y = stroke since the reversal / closing_stroke < 1, a part
of the force is there: k_degr (1 - (1 - y)^2). Then an oil column for each direction, in series with the valves, gives by
x under its force F, v being the piston's speed and u(F) the speed at which the valves make F:

    dx/dt = v - u(F)          x(F) = (C F + V_air/A p_atm/p_0 F / (F + p_0 A)) V(z)/V(0)          F >= 0

C is `C_fluid` or `C_fluid_co`, A the annulus in rebound, the rod in compression, p_0 the pressure at rest, V(z) the oil of
the chambers that is pressed. At last the force behind valves that move late follows that of the columns:

    tau_fluid dF/dt = F_columns - F

At a reversal the force of the new column builds up at once, beside what is left of the old one, or the share `relief_first`
of it has to be relieved first, 1 being a single Maxwell element. The phases still follow the stroke. A step in which k_degr
jumps is divided there, so that the columns know when. How a column is pressed: `_oil_column.py`.
"""

import math
from dataclasses import dataclass

from twintube.core import variables
from twintube.core.effects._oil_column import column_given, column_press
from twintube.core.frame import Frame, parts_of
from twintube.core.variables import Flow, var

TITLE = "Compressible oil and late check valves"
CAUSE = "Oil, dissolved gas and walls give under pressure and check valves close late, so the fluid force lags the velocity."
ABSENCE = "The measured F-v curve opens to a loop that the model does not have, widest where the acceleration is largest."
DECIDES = "small amplitudes at the same velocity: a lag grows with the frequency, a mount with the force"
NEEDS_TIME = True
ORDER = 210
AIR_PARTS = 8  # of a step after a jump of k_degr


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Compliance of the oil column."""

    C_fluid: float = var("fluid_lag", "", "m/N", "compliance of the oil, rebound, stroke 0", lower=0, upper=2e-5,
                         source="Duym 2000, Vehicle System Dynamics 33", default=0.0, role="strength")  # fmt: skip
    C_fluid_co: float = var("fluid_lag", "", "m/N", "the same in compression", lower=0, upper=5e-5,
                            source="Duym 2000, Vehicle System Dynamics 33", default=0.0, role="strength")  # fmt: skip
    V_air: float = var("fluid_lag", "", "m3", "air in the oil at ambient pressure, stroke 0", lower=0, upper=5e-6,
                       source="ideal gas; Manring, Hydraulic Control Systems", default=0.0, role="strength")  # fmt: skip
    tau_fluid: float = var("fluid_lag", "", "s", "time constant of late valves", lower=0, upper=0.02,
                           source="first-order lag", default=0.0, role="strength")  # fmt: skip
    closing_stroke: float = var("fluid_lag", "", "m", "stroke until the check valves have closed", lower=0, upper=15e-3,
                                source="Dixon, Shock Absorber Handbook", default=0.0, role="strength")  # fmt: skip
    relief_first: float = var("fluid_lag", "", "1", "share of the force relieved before the other builds up", lower=0,
                              upper=1, source="1: Maxwell element; Duym 2000", default=0.0, role="law")  # fmt: skip
    air_at_rest: float = var("fluid_lag", "", "1", "0: same mass of air with preload; 1: same volume", lower=0,
                             upper=1, source="1: bubbles of the reserve's gas", default=0.0, role="law")  # fmt: skip
    column_share: float = var("fluid_lag", "", "1", "share of the compliance that follows the stroke", lower=0, upper=1,
                              source="Manring, Hydraulic Control Systems", default=1.0, role="law")  # fmt: skip


@dataclass(slots=True)
class State(Frame):
    """The forces in the oil columns and behind the valves."""

    F_held_re: float = var("fluid_lag", "F_Fl", "N", "force of the rebound column at the end of the last step", default=0.0)
    F_held_co: float = var("fluid_lag", "F_Fl", "N", "force of the compression column, a magnitude", default=0.0)
    F_turn_re: float = var("fluid_lag", "F_Fl", "N", "force of the rebound column, last pressed by the piston", default=0.0)
    F_turn_co: float = var("fluid_lag", "F_Fl", "N", "the same of the compression column", default=0.0)
    F_late: float = var("fluid_lag", "F_Fl", "N", "force of both behind late valves", default=0.0)
    closed: float = var("fluid_lag", "", "1", "stroke since the reversal over `closing_stroke`, at most 1", default=1.0)
    closing_side: float = var("fluid_lag", "", "1", "direction in which they close: 1, -1, 0 before the start", default=0.0)
    k_held_re: float = var("fluid_lag", "k_degr", "1", "k_degr in rebound at the end of the last step", default=1.0)
    k_held_co: float = var("fluid_lag", "k_degr", "1", "the same in compression", default=1.0)


def fluid_lag_parts(p: Parameters, dt: float) -> int:
    """The force settles within milliseconds."""
    return parts_of(dt)


def fluid_lag_shut(y: float) -> float:
    """Integral from 0 to `y` of the share of the force [1] that closing valves let build up."""
    left = max(0.0, 1.0 - y)
    return y - (1.0 - left * left * left) / 3.0


def fluid_lag_transition(p: Parameters, s: State, f: Flow, v: float, dz: float) -> None:
    """While the check valves close a share of the force is there, in the mean over the step and at its end."""
    if p.closing_stroke <= 0.0:
        return
    v0 = s.goal_v0
    way = abs(dz) / p.closing_stroke
    begun = s.closed
    side = 1.0 if v > 0.0 else -1.0 if v < 0.0 else s.closing_side
    turned = v0 * v < 0.0
    if side * s.closing_side < 0.0 and not (turned and dz * side < 0.0):
        begun = 0.0
    ended = begun + way
    if way > 0.0:
        f.k_mean *= (fluid_lag_shut(ended) - fluid_lag_shut(begun)) / way
    if turned:
        ended = 0.5 * v * v * s.duration / (abs(v0) + abs(v)) / p.closing_stroke
    s.closing_side = side
    s.closed = min(1.0, ended)
    left = 1.0 - s.closed
    f.k_degr *= 1.0 - left * left
    s.k_degr *= 1.0 - left * left


def fluid_lag_series(p: Parameters, s: State, F: float, dt: float) -> float:
    """Speed [m/s] at which the oil gives while its force goes to `F` [N] within `dt` > 0 [s]; for an element in series."""
    return (column_given(p, F, s.z) - column_given(p, s.F_held_re - s.F_held_co, s.z)) / dt


def fluid_lag_felt(p: Parameters, s: State, F: float, dt: float) -> float:
    """Force [N] behind late valves after `dt` [s] in which that of the columns was `F` [N]."""
    if p.tau_fluid <= 0.0 or dt <= 0.0:
        return F
    return F + (s.F_late - F) * math.exp(-dt / p.tau_fluid)


def fluid_lag_part(
    p: Parameters, s: State, k_re: float, k_co: float, v0: float, v1: float, z: float, dz: float, dt: float
) -> None:
    """Carry the columns and the late valves over a part of a step, as `column_press`, speeds with their sign.

    `F_mean` and `W_step` of the state are those of the part then.
    """
    s.F_mean = 0.0
    s.W_step = 0.0
    # The column that the piston leaves comes first.
    if v1 >= 0.0:
        free = column_press(p, s, -1.0, k_co, 1.0, -v0, -v1, z, dz, dt)
        column_press(p, s, 1.0, k_re, free, v0, v1, z, dz, dt)
    else:
        free = column_press(p, s, 1.0, k_re, 1.0, v0, v1, z, dz, dt)
        column_press(p, s, -1.0, k_co, free, -v0, -v1, z, dz, dt)
    s.F_fluid = s.F_held_re - s.F_held_co
    s.F_valve = s.F_fluid
    if p.tau_fluid > 0.0:
        # The columns' force goes evenly, with this mean, to its end.
        mean = s.F_mean
        late = 2.0 * (s.F_fluid - mean) * p.tau_fluid / dt
        s.F_fluid = s.F_fluid - late + (s.F_late - 2.0 * mean + s.F_fluid + late) * math.exp(-dt / p.tau_fluid)
        s.F_mean += (s.F_late - s.F_fluid) * p.tau_fluid / dt
        s.W_step += (s.F_mean - mean) * dz
        s.F_late = s.F_fluid


def fluid_lag_force(p: Parameters, s: State, v: float, dz: float, dt: float) -> None:
    """The fluid force with the memory of the oil columns; a step without time leaves it, but for the first."""
    if dt <= 0.0:
        if s.elapsed > 0.0:
            s.F_valve = s.F_held_re - s.F_held_co
            s.F_fluid = s.F_late if p.tau_fluid > 0.0 else s.F_valve
            s.F_mean = s.F_fluid
            # The columns' work goes by the time: that of a way without time is in the steps around it.
            s.W_step = 0.0
        return
    k_re = s.k_mean if dz > 0.0 else s.k_re
    k_co = s.k_mean if dz < 0.0 else s.k_co
    v0 = s.goal_v0
    v1 = s.goal_v1
    # In a step of a single direction the mean of k_degr tells when it jumped from its last value to that of the end.
    after = 0.0
    if dz > 0.0 and v0 > 0.0 and v1 > 0.0 and s.k_re != s.k_held_re:
        after = (k_re - s.k_held_re) / (s.k_re - s.k_held_re)
    elif dz < 0.0 and v0 < 0.0 and v1 < 0.0 and s.k_co != s.k_held_co:
        after = (k_co - s.k_held_co) / (s.k_co - s.k_held_co)
    if after <= 0.0 or after >= 1.0:
        fluid_lag_part(p, s, k_re, k_co, v0, v1, s.z, dz, dt)
        return
    v_jump = v1 + after * (v0 - v1)
    later = after * dz * (v_jump + v1) / (v0 + v1)
    k_begun_re = s.k_held_re if dz > 0.0 else k_re
    k_begun_co = s.k_held_co if dz < 0.0 else k_co
    fluid_lag_part(p, s, k_begun_re, k_begun_co, v0, v_jump, s.z - later, dz - later, (1.0 - after) * dt)
    mean = (1.0 - after) * s.F_mean
    work = s.W_step
    # Trapped air is dead stroke first and stiff then.
    parts = AIR_PARTS if p.V_air > 0.0 else 1
    begun = v_jump
    for i in range(1, parts + 1):
        ended = v_jump + i / parts * (v1 - v_jump)
        way = later / parts * (begun + ended) / (v_jump + v1)
        at = s.z - later * (1.0 - i / parts) * (ended + v1) / (v_jump + v1)
        fluid_lag_part(p, s, s.k_re, s.k_co, begun, ended, at, way, after * dt / parts)
        mean += after / parts * s.F_mean
        work += s.W_step
        begun = ended
    s.F_mean = mean
    s.W_step = work


def fluid_lag_finish(p: Parameters, s: State, dt: float) -> None:
    """Remember k_degr, and the force where it is not that of the columns: at the start, or with an element in series."""
    s.k_held_re = s.k_re
    s.k_held_co = s.k_co
    if s.elapsed <= 0.0:
        s.F_late = s.F_valve
    if s.F_valve != s.F_held_re - s.F_held_co:
        s.F_held_re = max(0.0, s.F_valve)
        s.F_held_co = max(0.0, -s.F_valve)
