"""An oil column in series with the valves of one direction: what it gives, and a step of it.

The mean rate of a step is weighted so that the linear decay is exact (`frame.end_weight`), its end solved exactly, segment
by segment of the F-v curve. What a column stores less because its oil becomes less leaves with that oil and counts as
dissipated. With an element in series that share is neglected: of the work, F C / 2 over the length of the column, 0.5 % at
most with the compliance of oil. Forces of a column are magnitudes, `side` is 1 for rebound, -1 for compression.
"""

import math
from typing import TYPE_CHECKING

from twintube.core.effects import effects_bypass, effects_scale_valve
from twintube.core.frame import end_weight
from twintube.core.kernel.forces import P_AMBIENT, fluid_force
from twintube.core.variables import FV_POINTS

if TYPE_CHECKING:
    from twintube.core.effects.fluid_lag import Parameters, State

FAINT = 1e-12  # [1, s] k_degr that makes no force, time in which nothing moves


def column_length(p: "Parameters", side: float, z: float) -> float:
    """Oil [1] of the column at the stroke `z` [m], in terms of that at stroke 0."""
    out = p.column_share * z / (0.5 * (p.h_l - p.dead_length))
    if side >= 0.0:
        return 1.0 - out
    rod = p.D_PR * p.D_PR
    return 1.0 + out * rod / (2.0 * p.D_li * p.D_li - rod)


def column_of(p: "Parameters", side: float, z: float) -> tuple[float, float, float]:
    """Of the column at the stroke `z` [m]: compliance [m/N], stroke of its air [m], force that halves it [N]."""
    rod = 0.25 * math.pi * p.D_PR * p.D_PR
    bore = 0.25 * math.pi * p.D_li * p.D_li
    pressure = P_AMBIENT + p.gas_preload * p.F_0 / rod
    length = column_length(p, side, z)
    air = p.V_air * length * (p.air_at_rest + (1.0 - p.air_at_rest) * P_AMBIENT / pressure)
    if side >= 0.0:
        # The share of the air that is above the piston, on the annulus.
        return p.C_fluid * length, air / (2.0 * bore - rod), pressure * (bore - rod)
    return p.C_fluid_co * length, air / rod, pressure * rod


def column_stroke(C: float, way: float, F_half: float, F: float) -> float:
    """Stroke [m] by which a column gives under the force `F` [N], with its sign."""
    return C * F + way * F / (abs(F) + F_half)


def column_energy(C: float, way: float, F_half: float, F: float) -> float:
    """Elastic energy [J] of a column under the force `F` >= 0 [N]."""
    return 0.5 * C * F * F + way * F_half * (math.log(1.0 + F / F_half) - F / (F + F_half))


def column_given(p: "Parameters", F: float, z: float) -> float:
    """Stroke [m] by which the column on the side of the force `F` [N] gives at the stroke `z` [m], with its sign."""
    C, way, F_half = column_of(p, F, z)
    return column_stroke(C, way, F_half, F)


def valve_speed(F: float, k: float, velocities: tuple[float, ...], forces: tuple[float, ...]) -> tuple[float, float]:
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


def column_speed(
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

    `C`, `way` and `F_half` are those of `column_of`, `k` the degradation of the branch.
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


def side_force(p: "Parameters", side: float, u: float) -> float:
    """Force [N] of the intact valves at the speed `u` >= 0 [m/s]."""
    return side * fluid_force(p, side * u)


def side_valves(p: "Parameters", side: float, k: float, F: float) -> tuple[float, float]:
    """As `valve_speed`, with what passes beside the valves."""
    if side > 0.0:
        u, slope = valve_speed(F, k, p.v_re, p.F_re)
    else:
        u, slope = valve_speed(F, k, p.v_co, p.F_co)
    if k >= FAINT:
        u += side * effects_bypass(p, side * F / k)
    return u, slope


def side_speed(p: "Parameters", side: float, C: float, way: float, F_half: float, w: float, k: float, dt: float) -> float:
    """As `column_speed` with the F-v curve of the side."""
    if side > 0.0:
        return column_speed(C, way, F_half, w, k, p.v_re, p.F_re, dt)
    return column_speed(C, way, F_half, w, k, p.v_co, p.F_co, dt)


def leaking_speed(p: "Parameters", side: float, C: float, way: float, F_half: float, w: float, k: float, dt: float) -> float:
    """As `side_speed`, with what passes beside the valves: secants for its speed between bounds that close in."""
    u = side_speed(p, side, C, way, F_half, w, k, dt)
    low = 0.0
    high = side * effects_bypass(p, side * side_force(p, side, u))
    if high <= 0.0:
        return u
    # The faster the leak, the less force is left that drives it: `past` less what that force makes of it rises.
    r_low = -high
    past = min(high, w)
    u = side_speed(p, side, C, way, F_half, w - past, k, dt)
    r_high = past - side * effects_bypass(p, side * side_force(p, side, u))
    high = past
    n = 0
    while n < 40 and high - low > 1e-9:
        past = min(max(low - r_low * (high - low) / (r_high - r_low), low + 0.05 * (high - low)), high - 0.05 * (high - low))
        u = side_speed(p, side, C, way, F_half, w - past, k, dt)
        r = past - side * effects_bypass(p, side * side_force(p, side, u))
        if r < 0.0:
            low = past
            r_low = r
        else:
            high = past
            r_high = r
        n += 1
    return u


def column_press(  # noqa: PLR0915 - one implicit step
    p: "Parameters", s: "State", side: float, k: float, free: float, v0: float, v1: float, z: float, dz: float, dt: float
) -> float:
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
    C, way, F_half = column_of(p, side, z)
    u, slope = side_valves(p, side, k, held)
    given = C + way * F_half / ((held + F_half) * (held + F_half))
    before = column_stroke(C, way, F_half, held)
    share = 1.0
    F = 0.0
    n = 0
    # Trapped air gets stiff while it is pressed: again with its mean compliance.
    while n < (2 if way > 0.0 else 1):
        settling = given * slope
        share = end_weight(pressed / settling) if settling > 0.0 else 1.0
        w = v1 + (before / pressed + (1.0 - share) * (begun - u)) / share
        end = leaking_speed(p, side, C, way, F_half, w, k, share * pressed) if w > 0.0 else 0.0
        F = k * side_force(p, side, end)
        given = C + way * F_half / ((held + F_half) * (F + F_half))
        n += 1
    after = column_stroke(C, way, F_half, F)
    travelled = 0.5 * (begun + v1) * pressed
    through = max(0.0, travelled + before - after) / dt
    # A stiff column lets the steps of k_degr through, a soft one does not.
    even = 0.5 * (held + F) * pressed / dt
    stiff = k * side_force(p, side, through) * effects_scale_valve(p, side * through)
    mean = even + (2.0 * share - 1.0) * (stiff - even)
    s.F_mean += side * mean
    s.W_step += mean * through * dt
    if held > 0.0 and p.column_share > 0.0:
        shorter = column_length(p, side, z - dz) / column_length(p, side, z) - 1.0
        s.W_step += shorter * column_energy(C, way, F_half, held)
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
    bound = column_stroke(C, way, F_half, bound)
    if F <= 0.0:
        after = min(0.0, before + travelled)
    return min(1.0, max(0.0, (bound - after) / (before - after))) if before > after else 0.0
