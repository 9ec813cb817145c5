"""Compressible oil with trapped air, and late valves: oil columns in series with the valves, Maxwell elements, and a delay.

There is a column for each direction. A column gives by x(F) under its force F, which obeys dx(F)/dt = v - u(F), u being the
speed at which the valves make F, as long as that is positive. Rebound presses the oil above the piston on the annulus,
compression that of both chambers, whose pressures are equal then, on the rod's area. Oil and walls give linearly,
C = V / (K A^2). Trapped air gives as an ideal gas at constant temperature: V_air (1/p_0 - 1/p), which is soft at small
forces only. V and V_air are those of the chambers at the piston's stroke.

How two columns meet at a reversal is a law of its own. Either the force of the new one builds up at once, beside what is
left of the old one, or the piston's stroke has to relieve the old one first, as in a single Maxwell element. An element in
series with the columns (`mount_compliance`) meets the latter.

The mean rate of a step is weighted so that the linear decay is exact (`frame.end_weight`), its end solved exactly, segment
by segment of the F-v curve. The phases still follow the stroke. What a column stores less because its oil becomes less
leaves with that oil and counts as dissipated. With an element in series that share is neglected: of the work, F C / 2 over
the length of the column, 0.5 % at most with the compliance of oil.

A step in which k_degr jumps is divided there, so that the columns know when.

Valves that open and close late let the fluid force F follow that of the columns with a time constant of their own,
tau_fluid dF/dt = F_columns - F, solved exactly for a step in which F_columns goes evenly, with its mean and its end.
Or they take a stroke: a plate that the flow carries back to its seat lets the oil past until the piston has gone
`closing_stroke` after a reversal, and the share 1 - (1 - y)^2 of the force is there at the share y of it.
"""

import math
from dataclasses import dataclass

from twintube.core import variables
from twintube.core.effects import effects_bypass, effects_scale_valve
from twintube.core.frame import Frame, end_weight, parts_of
from twintube.core.kernel.forces import branch
from twintube.core.variables import FV_POINTS, Derived, Flow, var

TITLE = "Compressible oil and late check valves"
CAUSE = "Oil, dissolved gas and walls give under pressure and check valves close late, so the fluid force lags the velocity."
ABSENCE = "The measured F-v curve opens to a loop that the model does not have, widest where the acceleration is largest."
DECIDES = "small amplitudes at the same velocity: a lag grows with the frequency, a mount with the force"
NEEDS_TIME = True
P_ATM = 1e5  # [Pa]
AIR_PARTS = 8  # of a step after a jump of k_degr
FAINT = 1e-12  # [1, s] k_degr that makes no force, time in which nothing moves


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Compliance of the oil column."""

    C_fluid: float = var("fluid_lag", "", "m/N", "compliance of the oil, rebound, stroke 0",
                         lower=0, upper=2e-5, source="Duym 2000, Vehicle System Dynamics 33",
                         default=0.0, role="strength")  # fmt: skip
    C_fluid_co: float = var("fluid_lag", "", "m/N", "the same in compression", lower=0,
                            upper=5e-5, source="Duym 2000, Vehicle System Dynamics 33",
                            default=0.0, role="strength")  # fmt: skip
    V_air: float = var("fluid_lag", "", "m3", "air in the oil at ambient pressure, stroke 0",
                       lower=0, upper=5e-6, source="ideal gas; Manring, Hydraulic Control Systems",
                       default=0.0, role="strength")  # fmt: skip
    tau_fluid: float = var("fluid_lag", "", "s", "time constant of late valves", lower=0,
                           upper=0.02, source="first-order lag", default=0.0, role="strength")  # fmt: skip
    closing_stroke: float = var("fluid_lag", "", "m", "stroke until the check valves have closed", lower=0,
                                upper=15e-3, source="Dixon, Shock Absorber Handbook",
                                default=0.0, role="strength")  # fmt: skip
    relief_first: float = var("fluid_lag", "", "1", "share of the force relieved before the other builds up",
                              lower=0, upper=1, source="1: Maxwell element; Duym 2000", default=0.0,
                              role="law")  # fmt: skip
    air_at_rest: float = var("fluid_lag", "", "1", "0: same mass of air with preload; 1: same volume",
                             lower=0, upper=1, source="1: bubbles of the reserve's gas",
                             default=0.0, role="law")  # fmt: skip
    column_share: float = var("fluid_lag", "", "1", "share of the compliance that follows the stroke", lower=0,
                              upper=1, source="Manring, Hydraulic Control Systems", default=1.0,
                              role="law")  # fmt: skip


@dataclass(slots=True)
class State(Frame):
    """The forces in the oil columns and behind the valves."""

    F_held_re: float = var("fluid_lag", "F_Fl", "N", "force of the rebound column at the end of the last step", default=0.0)
    F_held_co: float = var("fluid_lag", "F_Fl", "N", "force of the compression column, a magnitude", default=0.0)
    F_turn_re: float = var("fluid_lag", "F_Fl", "N", "force of the rebound column, last pressed by the piston", default=0.0)
    F_turn_co: float = var("fluid_lag", "F_Fl", "N", "the same of the compression column", default=0.0)
    F_late: float = var("fluid_lag", "F_Fl", "N", "force of both behind late valves", default=0.0)
    closed: float = var(
        "fluid_lag", "", "1", "stroke since the reversal over that until the valves have closed", default=1.0
    )
    closing_side: float = var("fluid_lag", "", "1", "direction in which they close: 1, -1, 0 before the start", default=0.0)
    closing_time: float = var("fluid_lag", "", "s", "duration of the present step", default=0.0)
    k_held_re: float = var("fluid_lag", "k_degr", "1", "k_degr in rebound at the end of the last step", default=1.0)
    k_held_co: float = var("fluid_lag", "k_degr", "1", "the same in compression", default=1.0)


def fluid_lag_parts(p: Parameters, dt: float) -> int:
    """The force settles within milliseconds."""
    return parts_of(dt)


def fluid_lag_motion(p: Parameters, d: Derived, s: State, z: float, v0: float, v1: float, dt: float) -> None:
    """Remember the time of a step, which says how far the piston goes after a reversal in it."""
    s.closing_time = dt


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
        ended = 0.5 * v * v * s.closing_time / (abs(v0) + abs(v)) / p.closing_stroke
    s.closing_side = side
    s.closed = min(1.0, ended)
    left = 1.0 - s.closed
    f.k_degr *= 1.0 - left * left
    s.k_degr *= 1.0 - left * left


def fluid_lag_length(p: Parameters, F: float, z: float) -> float:
    """Oil [1] of the column on the side of the force `F` at the stroke `z` [m], in terms of that at stroke 0."""
    out = p.column_share * z / (0.5 * (p.h_l - p.dead_length))
    if F >= 0.0:
        return 1.0 - out
    rod = p.D_PR * p.D_PR
    return 1.0 + out * rod / (2.0 * p.D_li * p.D_li - rod)


def fluid_lag_column(p: Parameters, F: float, z: float) -> tuple[float, float, float]:
    """Of the oil column on the side of the force `F`: compliance [m/N], stroke of its air [m], force that halves it [N].

    `z` [m] is the stroke of the piston.
    """
    rod = 0.25 * math.pi * p.D_PR * p.D_PR
    bore = 0.25 * math.pi * p.D_li * p.D_li
    pressure = P_ATM
    length = fluid_lag_length(p, F, z)
    air = p.V_air * length
    if p.gas_preload > 0:
        pressure += p.F_0 / rod
        air *= p.air_at_rest + (1.0 - p.air_at_rest) * P_ATM / pressure
    if F >= 0.0:
        # The share of the air that is above the piston, on the annulus.
        return p.C_fluid * length, air / (2.0 * bore - rod), pressure * (bore - rod)
    return p.C_fluid_co * length, air / rod, pressure * rod


def fluid_lag_stored(C: float, way: float, F_half: float, F: float) -> float:
    """Elastic energy [J] of a column under the force `F` >= 0 [N]."""
    return 0.5 * C * F * F + way * F_half * (math.log(1.0 + F / F_half) - F / (F + F_half))


def fluid_lag_given(p: Parameters, F: float, z: float) -> float:
    """Stroke [m] by which the column gives under the force `F` [N], with its sign."""
    C, way, F_half = fluid_lag_column(p, F, z)
    return C * F + way * F / (abs(F) + F_half)


def fluid_lag_series(p: Parameters, s: State, F: float, dt: float) -> float:
    """Speed [m/s] at which the oil gives while its force goes to `F` [N] within `dt` > 0 [s]; for an element in series."""
    return (fluid_lag_given(p, F, s.z) - fluid_lag_given(p, s.F_held_re - s.F_held_co, s.z)) / dt


def fluid_lag_felt(p: Parameters, s: State, F: float, dt: float) -> float:
    """Force [N] behind late valves after `dt` [s] in which that of the columns was `F` [N]."""
    if p.tau_fluid <= 0.0 or dt <= 0.0:
        return F
    return F + (s.F_late - F) * math.exp(-dt / p.tau_fluid)


def fluid_lag_valves(F: float, k: float, velocities: tuple[float, ...], forces: tuple[float, ...]) -> tuple[float, float]:
    """Speed [m/s] at which the valves of one branch make the force `F` >= 0 [N], and the slope there [N s/m]."""
    if k < FAINT:
        return 0.0, 0.0
    i = 0
    while i < FV_POINTS - 1 and k * forces[i] < F:
        i += 1
    if i == 0:
        slope = k * forces[0] / velocities[0]
        return (F / slope if slope > 0.0 else 0.0), slope
    slope = k * (forces[i] - forces[i - 1]) / (velocities[i] - velocities[i - 1])
    return velocities[i - 1] + ((F - k * forces[i - 1]) / slope if slope > 0.0 else 0.0), slope


def fluid_lag_inverse(
    C: float,
    way: float,
    F_half: float,
    w: float,
    k: float,
    velocities: tuple[float, ...],
    forces: tuple[float, ...],
    dt: float,
) -> float:
    """The speed u >= 0 [m/s] at the valves of one branch of the F-v curve with u + given(F(u)) / dt = w >= 0.

    `C`, `way` and `F_half` are those of `fluid_lag_column`, `k` the degradation of the branch.
    """
    i = 0
    while i < FV_POINTS - 1 and velocities[i] + (C + way / (k * forces[i] + F_half)) * k * forces[i] / dt < w:
        i += 1
    u = 0.0
    F = 0.0
    if i > 0:
        u = velocities[i - 1]
        F = k * forces[i - 1]
    slope = (k * forces[i] - F) / (velocities[i] - u)
    # F = F_i + slope (u' - u_i) put into the equation makes a F^2 + b F - c = 0, of which one root is not negative.
    rest = F + slope * (w - u)
    a = 1.0 + slope * C / dt
    b = a * F_half + slope * way / dt - rest
    c = max(0.0, rest * F_half)
    root = math.sqrt(b * b + 4.0 * a * c)
    found = 2.0 * c / (b + root) if b > 0.0 else (root - b) / (2.0 * a)
    return max(0.0, w - (C + way / (found + F_half)) * found / dt)


def fluid_lag_leaking(
    p: Parameters, C: float, way: float, F_half: float, w: float, k: float, side: float, velocities: tuple[float, ...],
    forces: tuple[float, ...], dt: float,
) -> float:  # fmt: skip
    """As `fluid_lag_inverse`, with what passes beside the valves: secants for its speed between bounds that close in."""
    u = fluid_lag_inverse(C, way, F_half, w, k, velocities, forces, dt)
    low = 0.0
    high = side * effects_bypass(p, side * branch(u, velocities, forces))
    if high <= 0.0:
        return u
    # The faster the leak, the less force is left that drives it: `past` less what that force makes of it rises.
    r_low = -high
    past = min(high, w)
    u = fluid_lag_inverse(C, way, F_half, w - past, k, velocities, forces, dt)
    r_high = past - side * effects_bypass(p, side * branch(u, velocities, forces))
    high = past
    n = 0
    while n < 40 and high - low > 1e-9:
        past = min(max(low - r_low * (high - low) / (r_high - r_low), low + 0.05 * (high - low)), high - 0.05 * (high - low))
        u = fluid_lag_inverse(C, way, F_half, w - past, k, velocities, forces, dt)
        r = past - side * effects_bypass(p, side * branch(u, velocities, forces))
        if r < 0.0:
            low = past
            r_low = r
        else:
            high = past
            r_high = r
        n += 1
    return u


def fluid_lag_follow(p: Parameters, s: State, mean: float, F: float, dt: float) -> float:
    """Force [N] behind late valves after `dt` > 0 [s] in which that of the columns went evenly to `F`, with a `mean` [N]."""
    late = 2.0 * (F - mean) * p.tau_fluid / dt
    return F - late + (s.F_late - 2.0 * mean + F + late) * math.exp(-dt / p.tau_fluid)


def fluid_lag_press(
    p: Parameters, s: State, side: float, k: float, free: float, v0: float, v1: float, z: float, dz: float,
    velocities: tuple[float, ...], forces: tuple[float, ...], dt: float,
) -> float:  # fmt: skip
    """Carry one column over a part of a step: its force at the end, and its part of `F_mean` and `W_step` of the state.

    The part takes `dt` [s] and ends at the stroke `z` [m] after a way of `dz` [m]; `v0` and `v1` [m/s] are the speeds in the
    column's direction, `k` [1] the degradation of its branch. A column without force is pressed in the share `free` [1] of
    the part. Returns that share for the other column.
    """
    held = s.F_held_re if side > 0.0 else s.F_held_co
    turn = s.F_turn_re if side > 0.0 else s.F_turn_co
    begun = v0
    pressed = dt
    if held <= 0.0:
        if v0 < 0.0:
            # The column is pressed from the reversal on.
            begun = 0.0
            pressed = dt * v1 / (v1 - v0) if v1 > 0.0 else 0.0
        begun = v1 - free * (v1 - begun)
        pressed *= free
    if pressed < FAINT:
        return 1.0
    C, way, F_half = fluid_lag_column(p, side, z)
    u, slope = fluid_lag_valves(held, k, velocities, forces)
    if k >= FAINT:
        u += side * effects_bypass(p, side * held / k)
    given = C + way * F_half / ((held + F_half) * (held + F_half))
    before = C * held + way * held / (held + F_half)
    share = 1.0
    F = 0.0
    n = 0
    # Trapped air gets stiff while it is pressed: again with its mean compliance.
    while n < (2 if way > 0.0 else 1):
        settling = given * slope
        share = end_weight(pressed / settling) if settling > 0.0 else 1.0
        w = v1 + (before / pressed + (1.0 - share) * (begun - u)) / share
        end = fluid_lag_leaking(p, C, way, F_half, w, k, side, velocities, forces, share * pressed) if w > 0.0 else 0.0
        F = k * branch(end, velocities, forces)
        given = C + way * F_half / ((held + F_half) * (F + F_half))
        n += 1
    after = C * F + way * F / (F + F_half)
    travelled = 0.5 * (begun + v1) * pressed
    through = max(0.0, travelled + before - after) / dt
    # A stiff column lets the steps of k_degr through, a soft one does not.
    even = 0.5 * (held + F) * pressed / dt
    stiff = k * branch(through, velocities, forces) * effects_scale_valve(p, side * through)
    mean = even + (2.0 * share - 1.0) * (stiff - even)
    s.F_mean += side * mean
    s.W_step += mean * through * dt
    if held > 0.0 and p.column_share > 0.0:
        shorter = fluid_lag_length(p, side, z - dz) / fluid_lag_length(p, side, z) - 1.0
        s.W_step += shorter * fluid_lag_stored(C, way, F_half, held)
    if side > 0.0:
        s.F_held_re = F
    else:
        s.F_held_co = F
    if v1 >= 0.0:
        if side > 0.0:
            s.F_turn_re = F
        else:
            s.F_turn_co = F
    bound = (1.0 - p.relief_first) * turn
    if held <= bound:
        return 1.0
    bound = C * bound + way * bound / (bound + F_half)
    if F <= 0.0:
        after = min(0.0, before + travelled)
    return min(1.0, max(0.0, (bound - after) / (before - after))) if before > after else 0.0


def fluid_lag_part(
    p: Parameters, s: State, k_re: float, k_co: float, v0: float, v1: float, z: float, dz: float, dt: float
) -> None:
    """Carry the columns and the late valves over a part of a step, as `fluid_lag_press`, speeds with their sign.

    `F_mean` and `W_step` of the state are those of the part then.
    """
    s.F_mean = 0.0
    s.W_step = 0.0
    # The column that the piston leaves comes first.
    if v1 >= 0.0:
        free = fluid_lag_press(p, s, -1.0, k_co, 1.0, -v0, -v1, z, dz, p.v_co, p.F_co, dt)
        fluid_lag_press(p, s, 1.0, k_re, free, v0, v1, z, dz, p.v_re, p.F_re, dt)
    else:
        free = fluid_lag_press(p, s, 1.0, k_re, 1.0, v0, v1, z, dz, p.v_re, p.F_re, dt)
        fluid_lag_press(p, s, -1.0, k_co, free, -v0, -v1, z, dz, p.v_co, p.F_co, dt)
    s.F_fluid = s.F_held_re - s.F_held_co
    s.F_valve = s.F_fluid
    if p.tau_fluid > 0.0:
        mean = s.F_mean
        s.F_fluid = fluid_lag_follow(p, s, mean, s.F_fluid, dt)
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
