"""A rubber mount in series: the piston sees less stroke than the rig measures (Kelvin-Voigt element before the rod's mass).

The rubber carries damper and rod: (x + tau_mount dx/dt) / C_mount = F_Fl + F_Fr + F_S - F_S(0) + m_rod a, x being the
deflection. The piston's speed solves this at the end of the step (implicit Euler); the left side falls and the right side
rises with it, so there is one root. k_degr is that of the step before, which is why steps are divided into short parts.
"""

from dataclasses import dataclass

from twintube.core import variables
from twintube.core.effects import effects_elastic, effects_felt, effects_rub, effects_scale_friction, effects_series
from twintube.core.frame import Frame, parts_of, stroke_limit, valve_force
from twintube.core.kernel.forces import dahl, stribeck
from twintube.core.variables import Derived, var

TITLE = "Rubber mount in series"
CAUSE = "A rubber mount between rig or body and piston rod deflects under the force, so that the piston moves less."
ABSENCE = "The measured force lags behind the model's after every reversal, and small strokes do much less work."
DECIDES = "small amplitudes at the same velocity: a mount takes its deflection from every stroke"
NEEDS_TIME = True
FASTEST = 50.0  # [m/s] beyond every damper


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Compliance and damping of the rubber."""

    C_mount: float = var("mount_compliance", "", "m/N", "compliance of the mount, 1 / stiffness", lower=0, upper=2e-5,
                         source="Kelvin-Voigt element; Dixon, The Shock Absorber Handbook", default=0.0,
                         role="strength")  # fmt: skip
    tau_mount: float = var("mount_compliance", "", "s", "damping of the mount over its stiffness", lower=0, upper=0.02,
                           source="loss factor of rubber about 0.1 to 0.2 at 10 Hz", default=1e-3, role="scale")  # fmt: skip
    m_rod: float = var("mount_compliance", "", "kg", "mass of rod and piston behind the mount", lower=0, upper=5,
                       source="weighed; 1 to 3 kg in a passenger car", default=0.0, role="scale")  # fmt: skip


@dataclass(slots=True)
class State(Frame):
    """Deflection and the piston's velocity."""

    x_mount: float = var("mount_compliance", "x", "m", "deflection of the mount, positive under tension", default=0.0)
    v_piston: float = var("mount_compliance", "", "m/s", "velocity of the piston", default=0.0)
    u_valve: float = var("mount_compliance", "", "m/s", "piston speed that the valves see", default=0.0)
    F_open: float = var("mount_compliance", "", "N", "fluid force at the valves", default=0.0)
    F_mount: float = var("mount_compliance", "", "N", "fluid force in balance with the mount", default=0.0)
    F_rod: float = var("mount_compliance", "", "N", "force that accelerates the rod", default=0.0)


def mount_compliance_parts(p: Parameters, dt: float) -> int:
    """The deflection settles within milliseconds, and k_degr is that of the part before."""
    return parts_of(dt)


def mount_compliance_excess(p: Parameters, d: Derived, s: State, z: float, v: float, dt: float, u: float) -> float:
    """Force of the rubber beyond that of the damper [N] if the step ends with the speed `u` [m/s] at the valves."""
    F = valve_force(p, u, s.k_re, s.k_co)
    speed = u + effects_series(p, s, F, dt)
    rate = v - speed
    x = s.x_mount + rate * dt
    goal = z - x
    friction = effects_scale_friction(p, goal, v) * stribeck(p, v) * dahl(p, d, s.F_D, goal - s.z) + effects_rub(p, goal, v)
    gas = d.c_gas * goal + effects_elastic(p, goal) - effects_elastic(p, 0.0)
    return (
        (x + p.tau_mount * rate) / p.C_mount
        - effects_felt(p, s, F, dt)
        - friction
        - gas
        - p.m_rod * (speed - s.v_piston) / dt
    )


def mount_compliance_speed(p: Parameters, d: Derived, s: State, z: float, v: float, dt: float) -> float:
    """The speed [m/s] at the valves for which rubber and damper agree: bracketed about the last one, then regula falsi."""
    low = s.u_valve
    r_low = mount_compliance_excess(p, d, s, z, v, dt, low)
    if r_low == 0.0:
        return low
    # The excess falls with the speed.
    way = (1.0 if r_low > 0.0 else -1.0) * max(0.05 * abs(v - low), 1e-3)
    high = low + way
    r_high = mount_compliance_excess(p, d, s, z, v, dt, high)
    n = 0
    while r_high * r_low > 0.0 and n < 60:
        low = high
        r_low = r_high
        way *= 3.0
        high += way
        r_high = mount_compliance_excess(p, d, s, z, v, dt, high)
        n += 1
    n = 0
    while n < 60 and abs(r_high) > 1e-6 and r_low != r_high:
        u = high - r_high * (high - low) / (r_high - r_low)
        r = mount_compliance_excess(p, d, s, z, v, dt, u)
        if r * r_high < 0.0:
            low = high
            r_low = r_high
        else:
            r_low *= 0.5
        high = u
        r_high = r
        n += 1
    # An undamped mount on late valves, whose force cannot follow, would have to move in no time.
    return max(-FASTEST, min(FASTEST, high))


def mount_compliance_motion(p: Parameters, d: Derived, s: State, z: float, v0: float, v1: float, dt: float) -> None:
    """Stroke and velocity of the piston; in a step without time the deflection stays."""
    if s.elapsed > 0.0:
        s.goal_v0 = s.v_piston
        s.goal_v1 = s.v_piston
    else:
        s.v_piston = v0
    if dt > 0.0:
        s.u_valve = mount_compliance_speed(p, d, s, z, v1, dt)
        s.F_open = valve_force(p, s.u_valve, s.k_re, s.k_co)
        s.F_mount = effects_felt(p, s, s.F_open, dt)
        s.goal_v1 = s.u_valve + effects_series(p, s, s.F_open, dt)
        s.x_mount += (v1 - s.goal_v1) * dt
        s.F_rod = p.m_rod * (s.goal_v1 - s.v_piston) / dt
    # An elastic mount cannot push the piston out of the tube.
    s.goal_z = max(-stroke_limit(d), min(stroke_limit(d), z - s.x_mount))


def mount_compliance_force(p: Parameters, s: State, v: float, dz: float, dt: float) -> None:
    """The force that the rubber lets through, and the rubber's own loss."""
    if dt <= 0.0 and s.elapsed == 0.0:
        return
    s.F_valve = s.F_open
    s.F_fluid = s.F_mount + s.F_rod
    s.F_mean += s.F_rod
    if dt <= 0.0:
        return
    rate = v - s.goal_v1
    s.v_piston = s.goal_v1
    s.W_step = s.F_mount * (dz - (s.goal_v1 - s.u_valve) * dt) + p.tau_mount / p.C_mount * rate * rate * dt
