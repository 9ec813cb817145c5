"""Causes in gas, stops, friction, joints and records, and those inside the balance of oil, gas and foam."""

from collections.abc import Callable

import numpy as np

from twintube.common.arrays import Array
from twintube.core.kernel.forces import stribeck
from worlds.model.march import Moment, collapsed
from worlds.model.run import Run

AIR = 1.013e5  # [Pa]
FULL = 0.995  # oil level [1] that is written as 100 %


def wrong_preload(run: Run, ratio: float) -> None:
    """The intact damper has another gas pressure: force and stiffness times a ratio (p A_rod; c = A_rod^2 p / V)."""
    p = run.damper.parameters
    if run.record.preload:
        run.damper = run.damper.with_(F_0=p.F_0 * ratio, c_gas=p.c_gas * ratio)


def residual_pressure(run: Run, pressure: float, exponent: float) -> None:
    """Preload not all gone: polytropic air in the reserve, F = -A_rod (p - p_a), p V^n constant.

    `pressure` [Pa] is that at stroke 0. What this law adds to the isothermal one at ambient pressure.
    """
    if run.record.preload:
        return
    p = run.damper.parameters
    rod, inner, half = 0.25 * np.pi * p.D_PR**2, 0.25 * np.pi * p.D_li**2, 0.5 * (p.h_l - p.dead_length)
    reserve = 0.25 * np.pi * (p.D_a**2 - p.D_la**2) * p.h_l
    gas = reserve + (2 * inner - rod) * half - p.oil_level * p.V_oil  # all that is not oil at stroke 0
    ratio = gas / (gas + rod * run.parts["stroke"])
    run.plus("gas", -rod * ((AIR + pressure) * ratio**exponent - AIR * ratio))


def rubber_stop(run: Run, onset: float, at_10mm: float, power: float) -> None:
    """Rubber in rebound: F = F10 (u / 10 mm)^n, 15 % lost in hysteresis (Battermann and Koehler, Elastomere)."""
    depth = np.maximum(run.parts["stroke"] - onset, 0.0)
    run.plus("gas", at_10mm * (depth / 0.01) ** power * (1.0 + 0.15 * np.tanh(run.parts["velocity"] / 0.02)))


def foam_bump(run: Run, onset: float, stiffness: float) -> None:
    """Cellular polyurethane stop that locks in compression: F = k u / (1 - u / 30 mm) (Blundell and Harty)."""
    depth = np.maximum(-run.parts["stroke"] - onset, 0.0)
    run.plus("gas", -stiffness * depth / (1.0 - np.minimum(depth / 0.03, 0.9)))


def rubbing(run: Run) -> Array:
    """Dahl state (n,) from -1 to 1: the model's friction over its saturated value."""
    p, v = run.damper.parameters, run.parts["velocity"]
    grid = np.linspace(0.0, max(float(np.abs(v).max()), 1e-3), 2000)
    scale = np.interp(np.abs(v), grid, [stribeck(p, float(u)) for u in grid])
    return np.asarray(run.parts["friction"] / (scale * p.F_FrS * (1.0 + p.oil_loss_gain * (1.0 - p.oil_level))))


def side_load(run: Run, extra: float) -> None:
    """Strut under side force: Coulomb friction `extra` [N] more, whatever the stroke (Reimpell, "McPherson")."""
    run.plus("friction", extra * rubbing(run))


def bent_rod(run: Run, extra: float, overhang: float) -> None:
    """Bent rod: the normal force in guide and piston grows as their distance shrinks: N = Q (1 + e / (0.13 m - z))."""
    size = (1.0 + overhang / (0.13 - run.parts["stroke"])) / (1.0 + overhang / 0.13)
    run.plus("friction", extra * size * rubbing(run))


def refilled(run: Run, shift: float, level: float | None = None) -> None:
    """Other oil in the damper than recorded: `shift` [share of the intact volume] in all degraded states, or at a level."""
    own = run.record.level
    if not run.record.preload and own < FULL and level in (None, own):
        run.damper = run.damper.with_(oil_level=min(1.0, max(0.0, own + shift)))


def other_laws(run: Run, **changes: float) -> None:
    """Other values of the degradation parameters than those of the set."""
    run.damper = run.damper.with_(**changes)


def foam_collapse(run: Run, rate: float = 0.0, front: float = 0.0) -> None:
    """Foam to oil and gas: first order [1/s] (drainage of all) or a rate [m3/s] (front at the surface); Bikerman, Foams."""

    def act(m: Moment) -> None:
        total = sum(float(m.s[f"{c}_foam"]) for c in ("V1", "V2", "V3"))
        share = 1.0 - np.exp(-rate * m.dt) if rate > 0 else min(1.0, front * m.dt / max(total, 1e-15))
        collapsed(m, lambda foam, oil: (share * foam, share * oil))

    run.acts.append(act)


def dissolving(run: Run, rate: float, twice_at: float = 0.0) -> None:
    """Freed gas goes back into the oil, dV/dt = -r V (mass transfer); r is twice as large at a force [N] (Henry).

    Gas of the chambers first, else that of the reserve, becomes oil again.
    """

    def act(m: Moment) -> None:
        own = rate * (1.0 + m.size / twice_at) if twice_at > 0 else rate
        left = float(m.s["V_cav"]) * (1.0 - np.exp(-own * m.dt))
        m.s["V_cav"] -= left
        for c in ("V2", "V1"):
            part = min(left, float(m.s[f"{c}_gas"]))
            m.s[f"{c}_gas"] -= part
            m.s[f"{c}_oil"] += part
            left -= part
        m.s["V3_oil"] += left

    run.acts.append(act)


def leak(film: float = 0.0, orifice: float = 0.0) -> Callable[[Run], None]:
    """Oil past the rod seal: a film [m3/m] (Mueller and Nau) or an orifice, q = C sqrt(p) (Merritt).

    With a film each state is filled afresh. `orifice` [m3/s] is that at 1 bar; its loss goes on through all states.
    Out of the reserve, into which the guide drains.
    """
    lost, state = 0.0, (-1.0, True)

    def start(run: Run) -> None:
        nonlocal lost, state
        here = (run.record.level, run.record.preload)
        if film and state != here:
            lost = 0.0
        state = here

        def act(m: Moment) -> None:
            nonlocal lost
            pressure = m.size / float(m.d["A_1"]) / 1e5 + (5.0 if run.record.preload else 0.0)
            gone = min(film * m.way + orifice * float(np.sqrt(pressure)) * m.dt, float(m.s["V3_oil"]))
            m.s["V3_oil"] -= gone
            lost += gone

        run.damper = run.damper.with_(oil_level=max(0.0, run.record.level - lost / run.damper.parameters.V_oil))
        run.acts.append(act)

    return start


def play(run: Run, play: float) -> None:
    """Play [m] in a joint: the damper follows by the play operator; the joint takes up speed within 2 ms."""
    if play > 0:
        z, out = float(run.motion.stroke[0]), np.empty(len(run.time))
        for i, at in enumerate(run.motion.stroke.tolist()):
            z = min(max(z, at - 0.5 * play), at + 0.5 * play)
            out[i] = z
        run.path = smoothed(out, run.time, 0.002)


def floating(run: Run, play: float) -> None:
    """While the joint floats no force is transmitted."""
    if play > 0:
        free = np.abs(run.motion.stroke - run.parts["stroke"]) < 0.5 * play - 2e-5
        for part in ("fluid", "friction", "gas"):
            run.times(part, np.where(free, 0.0, 1.0))


def inertia(run: Run, mass: float) -> None:
    """Clamp and rod between load cell and damper: F + m z'' (d'Alembert)."""
    run.plus("gas", mass * smoothed(np.gradient(run.parts["velocity"], run.time), run.time, 0.004))


def smoothed(values: Array, time: Array, seconds: float) -> Array:
    """Moving Hann mean over even steps, ends held."""
    half = round(0.5 * seconds / float(time[1] - time[0]))
    window = np.hanning(2 * half + 3)[1:-1]
    return np.convolve(np.pad(values, half, mode="edge"), window / window.sum(), mode="valid")
