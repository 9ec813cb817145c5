"""What the state is to the surroundings, in the kernel's subset; the values of the other outputs stand in their table."""

from twintube.core.variables import Derived, State


def total_force(s: State) -> float:
    """Force of the damper [N] (Eq. 1)."""
    return s.F_fluid + s.F_friction + s.F_gas


def reserve_gas(d: Derived, s: State) -> float:
    """Gas in the reserve chamber [m3], the rest of its volume; where rounding would leave less than nothing, nothing."""
    return max(0.0, d.V_reserve - s.V3_oil - s.V3_foam)
