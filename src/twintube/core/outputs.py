"""What the state is to the surroundings, in the kernel's subset; the values of the other outputs stand in their table."""

from twintube.core.variables import Derived, State


def total_force(s: State) -> float:
    """Force of the damper [N] (Eq. 1)."""
    return s.F_fluid + s.F_friction + s.F_gas


def degradation(d: Derived, s: State) -> float:
    """Fluid force over that of the intact damper at T_curve [1]; with effects `k_degr` holds all that changes it."""
    return s.k_degr if d.extended > 0 else s.k_T * s.k_degr


def heat_flow(s: State) -> float:
    """Work dissipated in the last step over its length [W]: over a run its integral is the work. 0 before the first step."""
    return (s.work - s.work_begun) / s.span if s.span > 0.0 else 0.0


def reserve_gas(d: Derived, s: State) -> float:
    """Gas in the reserve chamber [m3], the rest of its volume; where rounding would leave less than nothing, nothing."""
    return max(0.0, d.V_reserve - s.V3_oil - s.V3_foam)
