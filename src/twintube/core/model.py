"""The model that is simulated: the paper's kernel with the effects around it, in the kernel's own subset of Python.

Without an active effect every function here is the kernel's own, to the last bit.
"""

from twintube.core.agreement import PLAY
from twintube.core.effects import (
    Parameters,
    State,
    effects_active,
    effects_derive,
    effects_elastic,
    effects_finish,
    effects_flows,
    effects_force,
    effects_level,
    effects_motion,
    effects_parts,
    effects_phases,
    effects_rebalance,
    effects_reset,
    effects_rub,
    effects_scale_cavitation,
    effects_scale_fluid,
    effects_scale_friction,
    effects_scale_valve,
    effects_transition,
    effects_warming,
)
from twintube.core.kernel import fill, fluid_force, pour, prepare, step, temper
from twintube.core.kernel.forces import filling_share, share_above
from twintube.core.kernel.prepare import cavitate
from twintube.core.kernel.step import MAX_SPLITS, arrive, carry, flows
from twintube.core.variables import Derived, Flow

# A step that is not longer [s] is the rounding of communication points: no time passes for the effects, whose rates over it
# would be noise.
SHORTEST = 1e-9


def set_up(p: Parameters, d: Derived) -> None:
    """Fill `d` from `p`; to be called again after a parameter has changed."""
    prepare(p, d)
    d.extended = effects_active(p)
    if d.extended > 0:
        effects_derive(p, d)


def start(p: Parameters, d: Derived, s: State, z: float) -> None:
    """The state at rest at the stroke `z` [m]."""
    if d.extended == 0:
        fill(p, d, s, z)
        return
    pour(p, d, s, z, effects_level(p, p.oil_level) * p.V_oil)
    effects_reset(s)
    s.z_rod = z
    s.F_gas += effects_elastic(p, s, z)


def rod_goal(at: float, z: float, v0: float, v1: float) -> float:
    """Where a rod at the stroke `at` [m] goes that is sent to `z` [m] at velocities from `v0` to `v1` [m/s].

    A stroke behind the way that the velocity has led - rounding, noise of a sensor, a velocity that was held for a step - is
    no reversal: the rod waits until the motion has caught up with it, and it stands where the velocity is 0. As for
    `agreement`, a way begins beyond the play: such a jump is followed.
    """
    behind = (z < at and v0 >= 0.0 and v1 >= 0.0) or (z > at and v0 <= 0.0 and v1 <= 0.0)
    return at if behind and abs(z - at) <= PLAY else z


def rod_stroke(d: Derived, s: State) -> float:
    """Stroke [m] at which the rod stands."""
    return s.z if d.extended == 0 else s.z_rod


def warm_up(p: Parameters, d: Derived, s: State) -> None:
    """Put the temperature of the coming step in force: that from outside, and what effects add."""
    T = s.temperature if d.extended == 0 else s.temperature + effects_warming(p, s)
    if T != s.T:
        temper(p, s, T)


def advance(p: Parameters, d: Derived, s: State, f: Flow, z: float, v0: float, v1: float, dt: float) -> bool:
    """Carry `s` to the stroke `z` [m] in the time `dt` [s] >= 0, the velocity going evenly from `v0` to `v1` [m/s].

    As `kernel.step`, whose result it returns, but never against the velocity (`rod_goal`); `dt` acts through effects that
    need time and is else ignored.
    """
    goal = rod_goal(rod_stroke(d, s), z, v0, v1)
    warm_up(p, d, s)
    work = s.work
    done = step(p, d, s, f, goal, v0, v1) if d.extended == 0 else extended_step(p, d, s, f, goal, v0, v1, dt)
    if dt > SHORTEST:
        s.work_begun = work
        s.span = dt
    return done


def extended_step(p: Parameters, d: Derived, s: State, f: Flow, z: float, v0: float, v1: float, dt: float) -> bool:
    """`advance` with at least one effect, in as many equal parts as the effects ask for."""
    n = effects_parts(p, dt)
    # Stroke and velocity go evenly, each by itself: samples of the two need not agree, at a rest above all.
    z0 = s.z_rod
    before = v0
    for i in range(1, n):
        share = i / n
        after = v0 + share * (v1 - v0)
        if not extended_part(p, d, s, f, z0 + share * (z - z0), before, after, dt / n):
            return False
        before = after
    s.z_rod = z
    return extended_part(p, d, s, f, z, before, v1, dt / n)


def advance_whole(p: Parameters, d: Derived, s: State, f: Flow, z: float, v0: float, v1: float, dt: float) -> bool:
    """`advance` in one part, for a caller that has divided the step itself."""
    goal = rod_goal(rod_stroke(d, s), z, v0, v1)
    warm_up(p, d, s)
    if d.extended == 0:
        return step(p, d, s, f, goal, v0, v1)
    s.z_rod = goal
    return extended_part(p, d, s, f, goal, v0, v1, dt)


def extended_part(p: Parameters, d: Derived, s: State, f: Flow, z: float, v0: float, v1: float, dt: float) -> bool:
    """The kernel's step with the effects around it."""
    if dt <= SHORTEST:
        dt = 0.0
    s.duration = dt
    work = s.work
    friction = s.F_friction
    gas = s.F_gas
    s.goal_z = z
    s.goal_v0 = v0
    s.goal_v1 = v1
    effects_motion(p, d, s, z, v0, v1, dt)
    dz = s.goal_z - s.z
    cavitate(p, d, effects_scale_cavitation(p, s))
    effects_phases(p, s, abs(dz), dt)
    s.k_degr = s.k_flow
    done = changed_step(p, d, s, f, s.goal_z, s.goal_v0, s.goal_v1)
    s.k_flow = s.k_degr
    v = s.goal_v1
    effects_transition(p, s, f, v, dz)
    scale = s.k_T * effects_scale_fluid(p, s, v)
    bled = effects_scale_valve(p, v)
    s.k_degr *= scale * bled
    if v > 0.0 or (v == 0.0 and dz > 0.0):
        s.k_re = f.k_degr * scale
    elif v < 0.0 or dz < 0.0:
        s.k_co = f.k_degr * scale
    effects_rebalance(p, d, s, v1, dt)
    F_1 = fluid_force(p, v)
    s.F_fluid = F_1 * s.k_degr
    F_1 *= bled
    s.F_friction = s.F_friction * effects_scale_friction(p, s, s.z, v) + effects_rub(p, s.z, v)
    s.F_gas += effects_elastic(p, s, s.z)
    # As in kernel.step: the mean over the stroke, whose direction need not be that of the velocity at its end.
    speed = abs(s.goal_v0 + v) / 2.0
    s.k_mean = f.k_mean * s.k_T * effects_scale_fluid(p, s, speed if dz >= 0.0 else -speed)
    s.F_mean = 0.5 * (fluid_force(p, s.goal_v0) * effects_scale_valve(p, s.goal_v0) + F_1) * s.k_mean
    s.W_step = s.F_mean * dz
    s.F_valve = s.F_fluid
    effects_force(p, s, v1, dz, dt)
    s.W_step += 0.5 * (friction + s.F_friction) * dz
    s.impulse += (s.F_mean + 0.5 * (friction + s.F_friction + gas + s.F_gas)) * dt
    s.work = work + s.W_step
    s.elapsed += dt
    effects_finish(p, s, dt)
    return done


def changed_step(p: Parameters, d: Derived, s: State, f: Flow, z: float, v0: float, v1: float) -> bool:
    """`kernel.step` with flows that effects change."""
    dz = z - s.z
    left = abs(dz)
    foaming = share_above(v0, v1, p.v_foam)
    cavitating = share_above(v0, v1, p.v_cav)
    filling = filling_share(d, v0, v1)
    acting = 0.0
    splits = 0
    while left > 0.0 and splits < MAX_SPLITS:
        flows(p, d, s, f, dz, foaming, cavitating, filling)
        effects_flows(p, d, s, f, dz, foaming)
        way = carry(s, f, left)
        acting += f.k_degr * way
        left -= way
        splits += 1
    arrive(p, d, s, f, z, v0, v1, acting)
    return left <= 0.0
