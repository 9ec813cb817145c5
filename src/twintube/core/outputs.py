"""What the state is to the surroundings: every output as it follows from `State` and `Derived`, in the kernel's subset."""

from twintube.core.variables import Derived, Outputs, State


def total_force(s: State) -> float:
    """Force of the damper [N] (Eq. 1)."""
    return s.F_fluid + s.F_friction + s.F_gas


def reserve_gas(d: Derived, s: State) -> float:
    """Gas in the reserve chamber [m3], the rest of its volume; where rounding would leave less than nothing, nothing."""
    return max(0.0, d.V_reserve - s.V3_oil - s.V3_foam)


def publish(d: Derived, s: State, o: Outputs) -> None:
    """Fill `o` after a step."""
    o.force = total_force(s)
    o.k_degr = s.k_degr
    o.V1_oil = s.V1_oil
    o.V1_gas = s.V1_gas
    o.V1_foam = s.V1_foam
    o.V2_oil = s.V2_oil
    o.V2_gas = s.V2_gas
    o.V2_foam = s.V2_foam
    o.V3_oil = s.V3_oil
    o.V3_gas = reserve_gas(d, s)
    o.V3_foam = s.V3_foam
    o.force_fluid = s.F_fluid
    o.force_friction = s.F_friction
    o.force_gas = s.F_gas
    o.work = s.work
