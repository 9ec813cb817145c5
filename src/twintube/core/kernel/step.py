"""One time step: split where a phase runs out, so that the result does not depend on the step size."""

from twintube.core.kernel.compression import compression
from twintube.core.kernel.forces import dahl, filling_share, fluid_force, set_forces, share_above
from twintube.core.kernel.rebound import rebound
from twintube.core.variables import Derived, Flow, Parameters, State

# More phases than this cannot run out in one step; reaching it would mean a flow that refills what it empties.
MAX_SPLITS = 64


def before_empty(volume: float, change: float, way: float) -> float:
    """The stroke [m], at most `way`, after which a phase of `volume` [m3] changing by `change` [m2] is used up."""
    if change < 0.0 and volume + change * way < 0.0:
        return volume / -change
    return way


def moved(volume: float, change: float, way: float) -> float:
    """A phase's volume [m3] after the stroke `way` [m]; what runs out is exactly zero."""
    after = volume + change * way
    # Rounding leaves a trace of 1e-16 of the volume where the split was made.
    if change < 0.0 and after < 1e-15 * volume:
        return 0.0
    return after


def split_length(s: State, f: Flow, way: float) -> float:
    """The part [m] of the stroke `way` over which every phase lasts."""
    way = before_empty(s.V1_oil, f.V1_oil, way)
    way = before_empty(s.V1_gas, f.V1_gas, way)
    way = before_empty(s.V1_foam, f.V1_foam, way)
    way = before_empty(s.V1_void, f.V1_void, way)
    way = before_empty(s.V2_oil, f.V2_oil, way)
    way = before_empty(s.V2_gas, f.V2_gas, way)
    way = before_empty(s.V2_foam, f.V2_foam, way)
    way = before_empty(s.V3_oil, f.V3_oil, way)
    return before_empty(s.V3_foam, f.V3_foam, way)


def move(s: State, f: Flow, way: float) -> None:
    """Carry all phases over the stroke `way` [m] (Eq. 4, 5: the sums of the phases stay the chamber volumes)."""
    s.V1_oil = moved(s.V1_oil, f.V1_oil, way)
    s.V1_gas = moved(s.V1_gas, f.V1_gas, way)
    s.V1_foam = moved(s.V1_foam, f.V1_foam, way)
    s.V1_void = moved(s.V1_void, f.V1_void, way)
    s.V2_oil = moved(s.V2_oil, f.V2_oil, way)
    s.V2_gas = moved(s.V2_gas, f.V2_gas, way)
    s.V2_foam = moved(s.V2_foam, f.V2_foam, way)
    s.V3_oil = moved(s.V3_oil, f.V3_oil, way)
    s.V3_foam = moved(s.V3_foam, f.V3_foam, way)
    # Eq. 35
    s.V1_foam_oil = moved(s.V1_foam_oil, f.V1_foam_oil, way) if s.V1_foam > 0.0 else 0.0
    s.V2_foam_oil = moved(s.V2_foam_oil, f.V2_foam_oil, way) if s.V2_foam > 0.0 else 0.0
    s.V3_foam_oil = moved(s.V3_foam_oil, f.V3_foam_oil, way) if s.V3_foam > 0.0 else 0.0
    s.V_cav += f.cavitated * way


def squeeze_reserve(d: Derived, s: State) -> None:
    """Foam that does not fit into the reserve loses its gas; the paper has no limit there."""
    room = d.V_reserve - s.V3_oil
    if s.V3_foam > room:
        s.V3_foam = max(room, s.V3_foam_oil)


def step(p: Parameters, d: Derived, s: State, f: Flow, z: float, v0: float, v1: float) -> bool:
    """Carry `s` to the stroke `z` [m] while the velocity goes evenly from `v0` to `v1` [m/s].

    Time enters through stroke and velocity only: every process of the paper is tied to the stroke. `k_degr` is the mean
    over the step, the forces are those at its end with that mean. False when the
    step could not be finished within `MAX_SPLITS`, which no admissible parameter set is known to cause.
    """
    dz = z - s.z
    left = abs(dz)
    foaming = share_above(v0, v1, p.v_foam)
    cavitating = share_above(v0, v1, p.v_cav)
    filling = filling_share(d, v0, v1)
    acting = 0.0
    splits = 0
    while left > 0.0 and splits < MAX_SPLITS:
        flows(p, d, s, f, dz, foaming, cavitating, filling)
        way = carry(s, f, left)
        acting += f.k_degr * way
        left -= way
        splits += 1
    arrive(p, d, s, f, z, v0, v1, acting)
    return left <= 0.0


def flows(
    p: Parameters, d: Derived, s: State, f: Flow, dz: float, foaming: float, cavitating: float, filling: float,
) -> None:  # fmt: skip
    """Flows and k_degr in the direction of `dz`; `foaming` and `cavitating` are the shares [1] of the step with either.

    `filling` is what can follow into V1 in compression over what it takes [1].
    """
    if dz > 0.0:
        rebound(p, d, s, f, foaming, cavitating)
    else:
        compression(p, d, s, f, foaming, cavitating, filling)


def carry(s: State, f: Flow, left: float) -> float:
    """Carry all phases as far as each of them lasts, at most over the stroke `left` [m]; returns the stroke [m]."""
    way = split_length(s, f, left)
    move(s, f, way)
    return way


def arrive(p: Parameters, d: Derived, s: State, f: Flow, z: float, v0: float, v1: float, acting: float) -> None:
    """End a step at the stroke `z` [m], in which k_degr has the integral `acting` [m] over the stroke."""
    dz = z - s.z
    F_1 = s.k_T * fluid_force(p, v1)
    if dz == 0.0:
        settle(p, d, s, f, v1)
        f.k_mean = s.k_degr
        set_forces(p, d, s, F_1, v1)
        return
    F_0 = F_1 if v0 == v1 else s.k_T * fluid_force(p, v0)
    rising = dz > 0.0
    if not rising:
        squeeze_reserve(d, s)
    s.z = z
    s.F_D = dahl(p, d, s.F_D, dz)
    # The mean over the step: force times stroke is then the work, wherever in the step a phase ran out.
    s.k_degr = acting / abs(dz)
    f.k_mean = s.k_degr
    if (v1 < 0.0) == rising:
        settle(p, d, s, f, v1)
    friction = s.F_friction
    set_forces(p, d, s, F_1, v1)
    s.work += 0.5 * (F_0 + F_1) * (acting if rising else -acting) + 0.5 * (friction + s.F_friction) * dz


def settle(p: Parameters, d: Derived, s: State, f: Flow, v: float) -> None:
    """k_degr for the direction of `v` [m/s] where the last stroke went the other way or nowhere."""
    if v != 0.0:
        foaming = share_above(v, v, p.v_foam)
        flows(p, d, s, f, v, foaming, share_above(v, v, p.v_cav), filling_share(d, v, v))
        s.k_degr = f.k_degr
