"""A rubber mount in series: the piston sees less stroke than the rig measures (Kelvin-Voigt element before the rod's mass).

The rubber carries damper and rod: (x + hardening x^3 + tau_mount dx/dt) / C_mount = F_Fl + F_Fr + F_S - F_S(0) + m_rod a, x
being the deflection. A bushing becomes stiffer the further it deflects. The speed at the valves solves this at the end of
the step; the left side falls and the right side rises with it, so there is one root. The mean rate of a step is weighted so
that the linear decay is exact (`frame.end_weight`). What k_degr will be at the end is not known before the phases have
followed the piston: where it steps, the rest of the step is balanced again, and the phases catch up in the next.
"""

from dataclasses import dataclass

from twintube.core import variables
from twintube.core.effects import (
    effects_elastic,
    effects_felt,
    effects_rub,
    effects_scale_friction,
    effects_scale_valve,
    effects_series,
)
from twintube.core.frame import Frame, end_weight, parts_of, stroke_limit, valve_force
from twintube.core.kernel.forces import dahl, gas_rise, stribeck
from twintube.core.variables import Derived, var

TITLE = "Rubber mount in series"
CAUSE = "A rubber mount between rig or body and piston rod deflects under the force, so that the piston moves less."
ABSENCE = "The measured force lags behind the model's after every reversal, and small strokes do much less work."
DECIDES = "small amplitudes at the same velocity: a mount takes its deflection from every stroke"
NEEDS_TIME = True
ORDER = 230
FASTEST = 50.0  # [m/s] beyond every damper
EXACT = 1e-4  # [N] to which the forces balance
MOST_SECANTS = 60  # halving alone would get from FASTEST to its rounding with 54
LEAST = 1e-9  # [N s/m] so that a slope can be divided by


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Compliance and damping of the rubber."""

    C_mount: float = var("mount_compliance", "", "m/N", "compliance of the mount, 1 / stiffness", lower=0, upper=2e-5,
                         source="Kelvin-Voigt; Dixon, Shock Absorber Handbook", default=0.0,
                         role="strength")  # fmt: skip
    tau_mount: float = var("mount_compliance", "", "s", "damping of the mount over its stiffness", lower=0, upper=0.02,
                           source="rubber: loss factor 0.1 to 0.2", default=1e-3, role="scale")  # fmt: skip
    hardening: float = var("mount_compliance", "", "1/m2", "cubic part of the mount's stiffness over the linear", lower=0,
                           upper=1e6, source="Blundell and Harty, Multibody Systems Approach",
                           default=0.0, role="law")  # fmt: skip
    m_rod: float = var("mount_compliance", "", "kg", "mass of rod and piston behind the mount", lower=0, upper=5,
                       source="1 to 3 kg in cars", default=0.0, role="scale")  # fmt: skip


@dataclass(slots=True)
class State(Frame):
    """Deflection and the piston's velocity."""

    x_mount: float = var("mount_compliance", "x", "m", "deflection of the mount, positive under tension", default=0.0)
    v_piston: float = var("mount_compliance", "", "m/s", "velocity of the piston", default=0.0)
    u_valve: float = var("mount_compliance", "", "m/s", "piston speed that the valves see", default=0.0)
    F_open: float = var("mount_compliance", "", "N", "fluid force at the valves", default=0.0)
    F_mount: float = var("mount_compliance", "", "N", "fluid force in balance with the mount", default=0.0)
    F_rod: float = var("mount_compliance", "", "N", "force that accelerates the rod", default=0.0)
    # Of the present step, for its balance of forces.
    x_begun: float = var("mount_compliance", "", "m", "deflection that the rate at the start leads to", default=0.0)
    z_begun: float = var("mount_compliance", "", "m", "stroke of the piston at the start", default=0.0)
    z_end: float = var("mount_compliance", "", "m", "stroke at the end, mount included", default=0.0)
    F_D_begun: float = var("mount_compliance", "", "N", "Dahl friction state at the start", default=0.0)
    F_before: float = var("mount_compliance", "", "N", "F_mount at the start", default=0.0)
    k_used_re: float = var("mount_compliance", "", "1", "k_degr in rebound before the step", default=1.0)
    k_used_co: float = var("mount_compliance", "", "1", "k_degr in compression before the step", default=1.0)
    F_middle: float = var("mount_compliance", "", "N", "gas force of the effects at stroke 0", default=0.0)
    rubbing: float = var("mount_compliance", "", "1", "friction over the Dahl state", default=1.0)
    end_share: float = var("mount_compliance", "", "1", "weight of the rate at the end", default=1.0)
    F_even: float = var("mount_compliance", "", "N", "mean of F_mount", default=0.0)
    moved: float = var("mount_compliance", "", "1", "latest rise of the piston's speed with the valves' speed", default=1.0)
    felt_slope: float = var("mount_compliance", "", "N.s/m", "latest rise of F_mount with the valves' speed", default=0.0)


def mount_compliance_parts(p: Parameters, dt: float) -> int:
    """The deflection settles within milliseconds, and the phases lag by a part where k_degr steps."""
    return parts_of(dt)


def mount_compliance_valves(p: Parameters, u: float, k_re: float, k_co: float) -> float:
    """Fluid force [N] at the speed `u` [m/s] at the valves, with what passes beside them."""
    return valve_force(p, u, k_re, k_co) * effects_scale_valve(p, u)


def mount_compliance_excess(p: Parameters, d: Derived, s: State, v: float, dt: float, u: float) -> float:
    """Force of the rubber beyond that of the damper [N] if the step ends with the speed `u` [m/s] at the valves.

    Sets what belongs to that speed: the forces at the valves and behind them and the speed of the piston.
    """
    s.F_open = mount_compliance_valves(p, u, s.k_re, s.k_co)
    s.F_mount = effects_felt(p, s, s.F_open, dt)
    s.goal_v1 = u + effects_series(p, s, s.F_open, dt)
    rate = v - s.goal_v1
    x = s.x_begun + rate * s.end_share * dt
    goal = s.z_end - x
    friction = effects_scale_friction(p, s, goal, v) * s.rubbing * dahl(p, d, s.F_D_begun, goal - s.z_begun)
    gas = s.k_T_gas * gas_rise(p, d.F_0, d.c_gas, goal) + effects_elastic(p, s, goal) - s.F_middle
    return (
        (x * (1.0 + p.hardening * x * x) + p.tau_mount * rate) / p.C_mount
        - s.F_mount
        - friction
        - effects_rub(p, goal, v)
        - gas
        - p.m_rod * (s.goal_v1 - s.v_piston) / dt
    )


def mount_compliance_harder(p: Parameters, s: State) -> float:
    """Slope of the rubber's force over that of the undeflected rubber [1]."""
    return 1.0 + 3.0 * p.hardening * s.x_mount * s.x_mount


def mount_compliance_begin(p: Parameters, d: Derived, s: State, z: float, v: float, rate: float, dt: float) -> None:
    """Fix what the search of a step needs; `rate` [m/s] is that of the deflection at its start.

    The mean rate of the step is (1 - end_share) rate + end_share times that at its end.
    """
    s.z_end = z
    s.z_begun = s.z
    s.F_D_begun = s.F_D
    s.F_middle = effects_elastic(p, s, 0.0)
    s.rubbing = s.k_T_Fr * stribeck(p, v)
    settling = (p.tau_mount + p.C_mount * s.felt_slope / s.moved) / mount_compliance_harder(p, s)
    s.end_share = end_weight(dt / settling) if settling > 0.0 else 1.0
    s.x_begun = s.x_mount + (1.0 - s.end_share) * rate * dt


def mount_compliance_solve(p: Parameters, d: Derived, s: State, v: float, dt: float) -> None:
    """The speed at the valves for which rubber and damper agree: secants between bounds that close in on it."""
    stiffness = mount_compliance_harder(p, s) / p.C_mount + d.c_gas + s.rubbing * p.sigma_0
    slope = s.moved * (stiffness * s.end_share * dt + p.tau_mount / p.C_mount + p.m_rod / dt) + s.felt_slope
    low = -FASTEST
    high = FASTEST
    u = s.u_valve
    r = mount_compliance_excess(p, d, s, v, dt, u)
    n = 0
    while n < MOST_SECANTS and abs(r) > EXACT and low < high:
        # The excess falls with the speed.
        if r > 0.0:
            low = u
        else:
            high = u
        before = u
        r_before = r
        F = s.F_mount
        speed = s.goal_v1
        u += r / max(slope, LEAST)
        if not low < u < high:
            u = 0.5 * (low + high)
        r = mount_compliance_excess(p, d, s, v, dt, u)
        if r != r_before and u != before:
            slope = (r_before - r) / (u - before)
            s.moved = max(1.0, (s.goal_v1 - speed) / (u - before))
            s.felt_slope = max(0.0, (s.F_mount - F) / (u - before))
        n += 1
    # An undamped mount on late valves, whose force cannot follow, would have to move in no time: not beyond the bounds.
    s.u_valve = u
    s.x_mount = s.x_begun + (v - s.goal_v1) * s.end_share * dt


def mount_compliance_motion(p: Parameters, d: Derived, s: State, z: float, v0: float, v1: float, dt: float) -> None:
    """Stroke and velocity of the piston; in a step without time the deflection stays."""
    if s.elapsed > 0.0:
        s.goal_v0 = s.v_piston
        s.goal_v1 = s.v_piston
    else:
        s.v_piston = v0
        s.F_open = mount_compliance_valves(p, v0, s.k_re, s.k_co)
        s.F_mount = s.F_open
    s.F_before = s.F_mount
    s.k_used_re = s.k_re
    s.k_used_co = s.k_co
    if dt > 0.0:
        mount_compliance_begin(p, d, s, z, v1, v0 - s.v_piston, dt)
        s.u_valve = max(-FASTEST, min(FASTEST, s.u_valve + v1 - v0))
        mount_compliance_solve(p, d, s, v1, dt)
    # An elastic mount cannot push the piston out of the tube.
    s.goal_z = max(-stroke_limit(d), min(stroke_limit(d), z - s.x_mount))
    if (s.goal_z - s.z) * s.goal_v1 < 0.0 and s.goal_v0 * s.goal_v1 > 0.0:
        # What is left of the deflection before a step of k_degr does not turn the piston round.
        s.goal_z = s.z


def mount_compliance_rebalance(p: Parameters, d: Derived, s: State, v: float, dt: float) -> None:
    """Where k_degr has stepped, balance the part of the step after it again: deflection and piston's speed at its end."""
    s.F_even = 0.5 * (s.F_before + s.F_mount)
    k_used = s.k_used_re if s.u_valve >= 0.0 else s.k_used_co
    k = s.k_re if s.u_valve >= 0.0 else s.k_co
    if dt > 0.0 and k != k_used:
        # The kernel's mean over the step tells where.
        after = max(0.0, min(1.0, (s.k_degr - k_used) / (k - k_used)))
        s.x_begun = s.x_mount - after * dt * (v - s.goal_v1)
        s.end_share = after
        mount_compliance_solve(p, d, s, v, dt)
        s.F_even += after * (s.F_mount - s.F_even)


def mount_compliance_force(p: Parameters, s: State, v: float, dz: float, dt: float) -> None:
    """The force that the rubber lets through, and the rubber's own loss."""
    if dt <= 0.0 and s.elapsed == 0.0:
        return
    s.F_valve = s.F_open
    if dt <= 0.0:
        s.F_fluid = s.F_mount + s.F_rod
        s.F_mean += s.F_rod
        return
    s.F_rod = p.m_rod * (s.goal_v1 - s.v_piston) / dt
    s.F_fluid = s.F_mount + s.F_rod
    s.F_mean = s.F_even + s.F_rod
    rate = v - s.goal_v1
    s.v_piston = s.goal_v1
    s.W_step = s.F_mount * (dz - (s.goal_v1 - s.u_valve) * dt) + p.tau_mount / p.C_mount * rate * rate * dt
