"""Compressible oil: an oil column in series with the valves, a Maxwell element on the fluid force.

The force obeys dF/dt = (v - u(F)) / C_fluid, u being the speed at which the valves make the force F. One implicit Euler
step is solved exactly, segment by segment of the F-v curve. The flows of the phases still follow the stroke.
"""

from dataclasses import dataclass

from twintube import variables
from twintube.effects import effects_series
from twintube.frame import Frame, parts_of, valve_force
from twintube.variables import FV_POINTS, var

TITLE = "Compressible oil and late check valves"
CAUSE = "Oil, dissolved gas and walls give under pressure and check valves close late, so the fluid force lags the velocity."
ABSENCE = "The measured F-v curve opens to a loop that the model does not have, widest where the acceleration is largest."
DECIDES = "small amplitudes at the same velocity: a lag grows with the frequency, a mount with the force"
STRENGTH = ("C_fluid",)
NEEDS_TIME = True


@dataclass(slots=True)
class Parameters(variables.Parameters):
    """Compliance of the oil column."""

    C_fluid: float = var("fluid_lag", "", "m/N", "compliance of the oil in series with the valves", lower=0, upper=2e-5,
                         source="Maxwell element; Duym 2000, Vehicle System Dynamics 33", default=0.0)  # fmt: skip


@dataclass(slots=True)
class State(Frame):
    """The force in the oil column."""

    F_held: float = var("fluid_lag", "F_Fl", "N", "fluid force at the end of the last step", default=0.0)


def fluid_lag_parts(p: Parameters, dt: float) -> int:
    """The force settles within milliseconds."""
    return parts_of(dt)


def fluid_lag_series(p: Parameters, s: State, F: float, dt: float) -> float:
    """Speed [m/s] at which the oil gives while its force goes to `F` [N] within `dt` > 0 [s]."""
    return p.C_fluid * (F - s.F_held) / dt


def fluid_lag_inverse(w: float, ratio: float, velocities: list[float], forces: list[float]) -> float:
    """The speed u >= 0 [m/s] with u + ratio * force(u) = w on one branch of the F-v curve; `ratio` in m/s/N."""
    i = 0
    while i < FV_POINTS - 1 and velocities[i] + ratio * forces[i] < w:
        i += 1
    high = velocities[i] + ratio * forces[i]
    if i == 0:
        return velocities[0] * w / high
    low = velocities[i - 1] + ratio * forces[i - 1]
    return velocities[i - 1] + (velocities[i] - velocities[i - 1]) * (w - low) / (high - low)


def fluid_lag_speed(p: Parameters, s: State, v: float, k_re: float, k_co: float, dt: float) -> float:
    """Speed at the valves [m/s] after a step of `dt` > 0 [s] that ends at the piston velocity `v` [m/s]."""
    w = v - effects_series(p, s, 0.0, dt)
    if w >= 0.0:
        return fluid_lag_inverse(w, p.C_fluid * k_re / dt, p.v_re, p.F_re)
    return -fluid_lag_inverse(-w, p.C_fluid * k_co / dt, p.v_co, p.F_co)


def fluid_lag_force(p: Parameters, s: State, v: float, dz: float, dt: float) -> None:
    """The fluid force with the memory of the oil column; a step without time leaves it, but for the first."""
    if dt <= 0.0:
        if s.elapsed > 0.0:
            s.F_fluid = s.F_held
        return
    u = fluid_lag_speed(p, s, s.goal_v1, s.k_re, s.k_co, dt)
    s.F_fluid = valve_force(p, u, s.k_re, s.k_co)
    s.W_step = s.F_fluid * (dz - (s.goal_v1 - u) * dt)


def fluid_lag_finish(p: Parameters, s: State, dt: float) -> None:
    """Remember the force."""
    s.F_held = s.F_fluid
