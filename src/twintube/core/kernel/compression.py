"""Compression (Eq. 21): V2 empties through the bottom valve into V3 and through the piston valve into V1."""

import math

from twintube.core.kernel.forces import fluid_force, foam_factor
from twintube.core.variables import Derived, Flow, Parameters, State

# Steps of venting for one without beyond which they are all the time; an integer of C holds it.
ALWAYS = 1e9


def compression(  # noqa: PLR0915 - the equations of the paper in their order
    p: Parameters, d: Derived, s: State, f: Flow, foaming: float, cavitating: float, filling: float
) -> None:
    """Flows of all phases and k_degr while the phases present in `s` stay the same.

    `foaming` and `cavitating` are the shares [1] of the step above the two threshold velocities. `filling` is what can
    follow into V1 through the piston valve over what V1 takes.
    """
    # The liquid that leaves V2 is foam where there is foam, but beside oil and gas the reading says which.
    as_foam = s.V2_foam > 0.0 and (s.V2_gas <= 0.0 or s.V2_oil <= 0.0 or p.foam_leaves_with_gas > 0)
    gas = 0.0
    piston = 0.0
    f.V1_void = 0.0
    # Eq. 15: W_kBV gives the bottom valve's flow; as in Eq. 27-29 it is counted relative to the flow out of V2.
    if s.V2_gas > 0.0:
        bottom = 0.0
        f.k_degr = 0.0  # Eq. 18: only gas
        if as_foam or s.V2_oil > 0.0:
            bottom = d.W_kBV_1 * d.A_2
            f.k_degr = p.X_Co1
        gas = d.A_2 - bottom
    else:
        # Eq. 19: V1 and V2 without gas, the flows and the force of the intact damper. Eq. 26, a fixed share G_PV of the
        # outflow through the piston valve, conflicts with 28 and is not used; in 29 the condition of foam in V2 is dropped.
        venting = 1.0 if s.V1_gas > 0.0 else vented_share(p, d, as_foam, foaming, cavitating)
        # While V1 holds gas the flows are those of Eq. 28, 29, and the surplus drives the gas out.
        bottom = d.A_rod + venting * (d.W_kBV_2 * d.A_2 - d.A_rod)
        piston = d.A_2 - bottom
        f.k_degr = 1.0 + venting * (d.k_Co2 - 1.0)
        # Beyond the paper: above `v_fill` the pressure in V1 is zero, and what follows is what follows at that speed. The
        # void that opens closes again as soon as more can follow.
        if s.V1_gas <= 0.0 and (filling < 1.0 or s.V1_void > 0.0):
            piston = min(filling * d.A_1, d.A_2)
            bottom = d.A_2 - piston
            f.V1_void = d.A_1 - piston
            f.k_degr = 1.0
            if filling < 1.0:
                f.k_degr = fluid_force(p, -d.v_fill) / fluid_force(p, -d.v_fill / filling)

    f.V2_gas = -gas
    f.V2_oil = 0.0
    f.V2_foam = 0.0
    f.V2_foam_oil = 0.0
    f.V3_oil = 0.0
    f.V3_foam = 0.0
    f.V3_foam_oil = 0.0
    f.V1_foam = 0.0
    f.V1_foam_oil = 0.0
    f.cavitated = 0.0
    freed = 0.0
    oil = 0.0
    if as_foam:
        share = s.V2_foam_oil / s.V2_foam
        f.k_degr *= foam_factor(p, s.V2_foam_oil, s.V2_foam)
        f.V2_foam = -(bottom + piston)
        f.V2_foam_oil = -share * (bottom + piston)
        f.V3_foam = bottom
        f.V3_foam_oil = share * bottom
        f.V1_foam = piston
        f.V1_foam_oil = share * piston
    else:
        f.V2_oil = -(bottom + piston)
        f.V3_oil = bottom
        # Eq. 40, 41
        freed = cavitating * d.Y_Co * piston
        oil = piston - freed
        f.cavitated = freed

    # V1 takes A_1; what is more leaves it as gas through the rod guide (Eq. 8, 13).
    kept = d.A_1 + freed - piston - f.V1_void
    if s.V1_gas <= 0.0 and kept < 0.0:
        if p.venting > 0:  # step by step: once the gas is out, oil follows it
            oil += kept
            f.V3_oil -= kept
        kept = 0.0  # of a sliding flow it is rounding
    foamable = gas + p.cavitation_foams * freed
    if foaming > 0.0 and p.S_PV > 0.0 and foamable > 0.0 and (s.V1_oil > 0.0 or oil > 0.0):
        frothed = foaming * p.S_PV * foamable
        if s.V1_gas <= 0.0 and frothed > kept:
            frothed = kept
        drawn = p.S_PVoil * frothed
        if s.V1_oil <= 0.0 and drawn > oil:
            frothed *= oil / drawn
            drawn = oil
        oil -= drawn
        kept -= frothed
        f.V1_foam += frothed + drawn
        f.V1_foam_oil += drawn
    f.V1_oil = oil
    f.V1_gas = kept


def vented_share(p: Parameters, d: Derived, as_foam: bool, foaming: float, cavitating: float) -> float:
    """Share [1] of the time that V1, without gas at the moment, vents gas while V2 is full.

    Cavitation brings gas into V1. Where venting is faster, V1 stays at zero gas and the flow slides between the two
    cases; the share is the one that keeps it there (Filippov's convex combination). With the reading `venting` the cases
    follow each other step by step, as V1 has gas at the start of a step or not, and what a step vents too much is oil. One
    step without venting is followed by as many with it as drive its gas out, whatever their length.
    """
    if as_foam or cavitating <= 0.0:
        return 0.0
    stays = cavitating * d.Y_Co * (1.0 - p.cavitation_foams * foaming * p.S_PV)
    gained = stays * d.A_1
    if gained <= 0.0:
        return 0.0
    surplus = d.A_rod - d.W_kBV_2 * d.A_2
    change = stays * (d.A_2 - d.W_kBV_2 * d.A_2) - surplus
    if change >= 0.0:
        return 1.0
    if p.venting > 0:
        steps = math.ceil(min(ALWAYS, gained / -change))
        return steps / (steps + 1.0)
    return gained / (gained - change)
