"""Rebound (Eq. 20): V1 empties through the piston valve, V2 is refilled from V1 and, through the bottom valve, from V3."""

from twintube.core.kernel.forces import foam_factor
from twintube.core.variables import Derived, Flow, Parameters, State


def rebound(p: Parameters, d: Derived, s: State, f: Flow, foaming: float, cavitating: float) -> None:
    """Flows of all phases and k_degr while the phases present in `s` stay the same.

    `foaming` and `cavitating` are the shares [1] of the step above the two threshold velocities.
    """
    f.V1_void = 0.0
    if s.V1_void > 0.0:
        close(p, d, s, f, foaming)
        return
    # Piston valve: what leaves V1 over the area A_1 (Eq. 6, 8, 11)
    oil = 0.0
    gas = 0.0
    foam = 0.0
    foam_oil = 0.0
    if s.V1_gas > 0.0:
        if s.V1_foam > 0.0 and (p.foam_leaves_with_gas > 0 or s.V1_oil <= 0.0):
            foam = d.W_kPV * d.A_1
            gas = d.A_1 - foam
            # Eq. 39: B p1^E W_kPV/(1 - L_PV), and W_kPV/(1 - L_PV) is X_Re
            f.k_degr = foam_factor(p, s.V1_foam_oil, s.V1_foam) * p.X_Re
        elif s.V1_oil > 0.0:
            # Eq. 14: W_kPV is the oil flow relative to the intact one, which is A_1
            oil = d.W_kPV * d.A_1
            gas = d.A_1 - oil
            # Eq. 25; to the letter it holds beside foam too, which is foam_leaves_with_gas = 0
            f.k_degr = p.X_Re
        else:
            gas = d.A_1
            # Eq. 16, 24: only gas, no work at the valve
            f.k_degr = 0.0
    elif s.V1_foam > 0.0:
        foam = d.A_1
        # Eq. 37, 38: with oil in V1 or without, the foam leaves first; foam that exists acts below 0.05 m/s as well
        f.k_degr = foam_factor(p, s.V1_foam_oil, s.V1_foam)
    else:
        oil = d.A_1
        # Eq. 17, 23: only oil
        f.k_degr = 1.0
    if foam > 0.0:
        foam_oil = foam * s.V1_foam_oil / s.V1_foam
    f.V1_oil = -oil
    f.V1_gas = -gas
    f.V1_foam = -foam
    f.V1_foam_oil = -foam_oil

    # What arrives in V2: cavitation frees gas from the oil, and foam beside oil separates.
    f.cavitated = cavitating * d.Y_Re * oil
    # Eq. 40
    gas += f.cavitated
    # Eq. 41; with 14 to the letter k would be 1 - Y while cavitating, here the force falls by what follows from the gas
    oil -= f.cavitated
    if foam > 0.0 and p.foam_decays > 0 and s.V1_oil > 0.0:
        oil += foam_oil
        gas += foam - foam_oil
        foam = 0.0
        foam_oil = 0.0
    # Eq. 10, 12: V3 gives the rod's volume
    refill(p, s, f, foaming, d.A_rod, oil, gas, foam, foam_oil)


def close(p: Parameters, d: Derived, s: State, f: Flow, foaming: float) -> None:
    """Beyond the paper: a void in V1 closes before anything passes the piston valve, and V3 alone refills V2."""
    f.V1_oil = 0.0
    f.V1_gas = 0.0
    f.V1_foam = 0.0
    f.V1_foam_oil = 0.0
    f.V1_void = -d.A_1
    f.cavitated = 0.0
    f.k_degr = 0.0
    refill(p, s, f, foaming, d.A_2, 0.0, 0.0, 0.0, 0.0)


def refill(
    p: Parameters, s: State, f: Flow, foaming: float, supply: float, oil: float, gas: float, foam: float, foam_oil: float
) -> None:
    """Bottom valve: V3 gives the flow `supply` [m2], oil, then foam, then gas, to V2 beside the flows that arrive there."""
    f.V3_oil = 0.0
    f.V3_foam = 0.0
    f.V3_foam_oil = 0.0
    if s.V3_oil > 0.0:
        f.V3_oil = -supply
        oil += supply
    elif s.V3_foam > 0.0:
        f.V3_foam = -supply
        f.V3_foam_oil = -supply * s.V3_foam_oil / s.V3_foam
        foam += supply
        foam_oil -= f.V3_foam_oil
    elif foaming > 0.0 and p.S_BV > 0.0 and (s.V2_oil > 0.0 or oil > 0.0):
        frothed = foaming * p.S_BV * supply
        # Eq. 30, 32, 33: the foam takes S of the gas flow and S_oil per volume of that gas from V2's oil
        drawn = p.S_BVoil * frothed
        if s.V2_oil <= 0.0 and drawn > oil:
            frothed *= oil / drawn
            drawn = oil
        gas += supply - frothed
        oil -= drawn
        # Eq. 31, 34
        foam += frothed + drawn
        foam_oil += drawn
    else:
        gas += supply

    # Eq. 7, 9; mixing of foams (Eq. 35) is the sum of the oil they hold
    f.V2_oil = oil
    f.V2_gas = gas
    f.V2_foam = foam
    f.V2_foam_oil = foam_oil
