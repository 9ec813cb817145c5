"""Compressible oil with trapped air, and late valves: oil columns in series with the valves, Maxwell elements, and a delay.

There is one column for each direction; while the pressure of one is still being relieved, that of the other builds up. A
column gives by x(F) under its force F, which obeys dx(F)/dt = v - u(F), u being the speed at which the valves make F, as
long as that is positive. Oil and walls give linearly. Trapped air gives as an ideal gas at constant temperature:
V_air (1/p_0 - 1/p), which is soft at small forces only. Rebound presses on the annulus, compression on the rod's area. One
implicit Euler step is solved exactly, segment by segment of the F-v curve. The phases still follow the stroke.

Valves that open and close late let the fluid force F follow that of the columns with a time constant of their own,
tau_fluid dF/dt = F_columns - F, solved exactly for a step in which F_columns has its mean.
"""

import math
from dataclasses import dataclass

from twintube.core import variables
from twintube.core.frame import Frame, parts_of, valve_force
from twintube.core.kernel.forces import fluid_force
from twintube.core.variables import FV_POINTS, var

TITLE = "Compressible oil and late check valves"
CAUSE = "Oil, dissolved gas and walls give under pressure and check valves close late, so the fluid force lags the velocity."
ABSENCE = "The measured F-v curve opens to a loop that the model does not have, widest where the acceleration is largest."
DECIDES = "small amplitudes at the same velocity: a lag grows with the frequency, a mount with the force"
NEEDS_TIME = True
P_ATM = 1e5  # [Pa]


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Compliance of the oil column."""

    C_fluid: float = var("fluid_lag", "", "m/N", "compliance of the oil in series with the valves, rebound", lower=0,
                         upper=2e-5, source="Maxwell element; Duym 2000, Vehicle System Dynamics 33",
                         default=0.0, role="strength")  # fmt: skip
    C_fluid_co: float = var("fluid_lag", "", "m/N", "the same in compression, which presses on the rod's area", lower=0,
                            upper=5e-5, source="Maxwell element; Duym 2000, Vehicle System Dynamics 33",
                            default=0.0, role="strength")  # fmt: skip
    V_air: float = var("fluid_lag", "", "m3", "air trapped in the oil, at ambient pressure", lower=0, upper=5e-6,
                       source="ideal gas at constant temperature; Manring, Hydraulic Control Systems",
                       default=0.0, role="strength")  # fmt: skip
    tau_fluid: float = var("fluid_lag", "", "s", "time constant with which late valves change the fluid force", lower=0,
                           upper=0.02, source="first-order lag", default=0.0, role="strength")  # fmt: skip


@dataclass(slots=True)
class State(Frame):
    """The forces in the oil columns and behind the valves."""

    F_held_re: float = var("fluid_lag", "F_Fl", "N", "force of the rebound column at the end of the last step", default=0.0)
    F_held_co: float = var("fluid_lag", "F_Fl", "N", "force of the compression column, a magnitude", default=0.0)
    F_late: float = var("fluid_lag", "F_Fl", "N", "force of both behind late valves", default=0.0)


def fluid_lag_parts(p: Parameters, dt: float) -> int:
    """The force settles within milliseconds."""
    return parts_of(dt)


def fluid_lag_column(p: Parameters, F: float) -> tuple[float, float, float]:
    """Of the oil column on the side of the force `F`: compliance [m/N], stroke of its air [m], force that halves it [N]."""
    rod = 0.25 * math.pi * p.D_PR * p.D_PR
    pressure = P_ATM + (p.F_0 / rod if p.gas_preload > 0 else 0.0)
    area = 0.25 * math.pi * p.D_li * p.D_li - rod if F >= 0.0 else rod
    return p.C_fluid if F >= 0.0 else p.C_fluid_co, p.V_air * P_ATM / (pressure * area), pressure * area


def fluid_lag_given(p: Parameters, F: float) -> float:
    """Stroke [m] by which the column gives under the force `F` [N], with its sign."""
    C, way, F_half = fluid_lag_column(p, F)
    return C * F + way * F / (abs(F) + F_half)


def fluid_lag_series(p: Parameters, s: State, F: float, dt: float) -> float:
    """Speed [m/s] at which the oil gives while its force goes to `F` [N] within `dt` > 0 [s]; for an element in series."""
    return (fluid_lag_given(p, F) - fluid_lag_given(p, s.F_held_re - s.F_held_co)) / dt


def fluid_lag_felt(p: Parameters, s: State, F: float, dt: float) -> float:
    """Force [N] behind late valves after `dt` [s] in which that of the columns was `F` [N]."""
    if p.tau_fluid <= 0.0 or dt <= 0.0:
        return F
    return F + (s.F_late - F) * math.exp(-dt / p.tau_fluid)


def fluid_lag_inverse(
    p: Parameters, w: float, k: float, side: float, velocities: tuple[float, ...], forces: tuple[float, ...], dt: float
) -> float:
    """The speed u >= 0 [m/s] at the valves of one branch of the F-v curve with u + given(F(u)) / dt = w >= 0.

    `side` is 1 in rebound and -1 in compression, `k` the degradation of the branch.
    """
    C, way, F_half = fluid_lag_column(p, side)
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


def fluid_lag_force(p: Parameters, s: State, v: float, dz: float, dt: float) -> None:
    """The fluid force with the memory of the oil columns; a step without time leaves it, but for the first."""
    if dt <= 0.0:
        if s.elapsed > 0.0:
            s.F_valve = s.F_held_re - s.F_held_co
            s.F_fluid = s.F_late if p.tau_fluid > 0.0 else s.F_valve
            s.F_mean = s.F_fluid
        return
    half = 0.5 * (s.goal_v0 + s.goal_v1)
    before = fluid_lag_given(p, s.F_held_re) / dt
    w = s.goal_v1 + before
    u = fluid_lag_inverse(p, w, s.k_re, 1.0, p.v_re, p.F_re, dt) if w > 0.0 else 0.0
    F = valve_force(p, u, s.k_re, s.k_co)
    # The valves see what the column does not give; k_degr may have jumped in between.
    through = max(0.0, half + before - fluid_lag_given(p, F) / dt)
    s.F_mean = fluid_force(p, through) * (s.k_mean if dz > 0.0 else s.k_re)
    s.F_fluid = F
    s.W_step = F * u * dt
    before = fluid_lag_given(p, -s.F_held_co) / dt
    w = s.goal_v1 + before
    u = -fluid_lag_inverse(p, -w, s.k_co, -1.0, p.v_co, p.F_co, dt) if w < 0.0 else 0.0
    F = valve_force(p, u, s.k_re, s.k_co)
    through = min(0.0, half + before - fluid_lag_given(p, F) / dt)
    if through < 0.0:
        s.F_mean += fluid_force(p, through) * (s.k_mean if dz < 0.0 else s.k_co)
    s.F_held_re = s.F_fluid
    s.F_held_co = -F
    s.F_fluid += F
    s.F_valve = s.F_fluid
    s.W_step += F * u * dt
    if p.tau_fluid > 0.0:
        mean = s.F_mean
        s.F_fluid = fluid_lag_felt(p, s, mean, dt)
        s.F_mean += (s.F_late - s.F_fluid) * p.tau_fluid / dt
        s.W_step += (s.F_mean - mean) * dz
        s.F_late = s.F_fluid


def fluid_lag_finish(p: Parameters, s: State, dt: float) -> None:
    """Remember the force where it is not that of the columns: at the start, or with another element in series."""
    if s.elapsed <= 0.0:
        s.F_late = s.F_valve
    if s.F_valve != s.F_held_re - s.F_held_co:
        s.F_held_re = max(0.0, s.F_valve)
        s.F_held_co = max(0.0, -s.F_valve)
