"""Hidden causes in gas spring, stops, friction and mount.

Sources: Reimpell (stops, side load), Dixon (gas force on the rod), Canudas de Wit et al. 1995 (LuGre), Berg 1998 (rubber).
"""

from typing import Any

import numpy as np

from twintube.common.arrays import Array
from worlds.bench.plan import with_numba
from worlds.model.march import Mount
from worlds.model.run import Constants, Run, derived_of


def chosen(run: Run, c: Constants) -> bool:
    """Whether the cause acts in the state of this record."""
    return c.get("where", "all") in ("all", "intact" if run.record.preload else "degraded")


def gas_constants(rng: np.random.Generator, states: tuple[str, ...]) -> dict[str, Any]:
    """In which states, with which sign, and the share of the reserve that is gas."""
    where = str(rng.choice(["all", *states])) if len(states) > 1 else "all"
    wrong = where != "degraded" and "intact" in states
    return {"where": where, "sign": float(rng.choice([-1.0, 1.0])) if wrong else 1.0, "n": rng.uniform(1.0, 1.3)}


def linear_gas(run: Run, x: float, c: Constants) -> None:
    """Gas force `x` [N] at stroke 0 beyond the parameter set's, with the slope of an isothermal volume."""
    if chosen(run, c):
        run.plus("gas", -c["sign"] * x * (1.0 - run.parts["stroke"] / reserve_length(run)))


def reserve_length(run: Run) -> float:
    """Stroke [m] over which the rod would take all gas of the reserve."""
    d, p = derived_of(run.damper), run.damper.parameters
    gas = d.V_reserve - p.oil_level * p.V_oil + (d.A_1 + d.A_2) * d.half_length
    return float(max(gas, 0.1 * d.V_reserve) / d.A_rod)


def polytropic_gas(run: Run, x: float, c: Constants) -> None:
    """As `linear_gas`, with p V^n constant; only the excess over the wanted filling acts."""
    if chosen(run, c):
        shape = (1.0 + run.parts["stroke"] / reserve_length(run)) ** -c["n"]
        run.plus("gas", -c["sign"] * x * shape)


def stop_constants(rng: np.random.Generator) -> dict[str, Any]:
    """Where the stops begin, as a share of the largest stroke, and which of them are met."""
    return {"at": rng.uniform(0.6, 0.9), "side": float(rng.choice([-1.0, 1.0])), "power": rng.uniform(1.7, 3.0)}


def beyond(run: Run, c: Constants) -> Array:
    """Way [m] into the stop, with its sign, (n,)."""
    z, gap = run.parts["stroke"], c["at"] * c["reach"]
    way: Array = np.sign(z) * np.maximum(np.abs(z) - gap, 0.0)
    return way


def linear_stop(run: Run, x: float, c: Constants) -> None:
    """Both stops, stiffness `x` [N/m]."""
    run.plus("gas", x * beyond(run, c))


def progressive_stop(run: Run, x: float, c: Constants) -> None:
    """Both stops, force growing with a power of the way; `x` [N/m] at 10 mm."""
    way = beyond(run, c)
    run.plus("gas", x * 0.01 * np.sign(way) * (np.abs(way) / 0.01) ** c["power"])


def single_stop(run: Run, x: float, c: Constants) -> None:
    """One stop only, stiffness `x` [N/m]."""
    way = beyond(run, c)
    run.plus("gas", np.where(np.sign(way) == c["side"], x * way, 0.0))


def friction_constants(rng: np.random.Generator) -> dict[str, Any]:
    """Presliding stroke [m], static over sliding friction, Stribeck speed [m/s], viscous share, growth over the stroke."""
    return {
        "presliding": float(np.exp(rng.uniform(np.log(2e-5), np.log(3e-4)))), "static": rng.uniform(1.0, 1.5),
        "stribeck": rng.uniform(0.005, 0.05), "growth": rng.uniform(0.3, 0.9), "soft": rng.uniform(0.001, 0.005),
    }  # fmt: skip


def coulomb(run: Run, x: float, c: Constants) -> None:
    """Sliding friction `x` [N] against the velocity, with a steep slope at rest."""
    run.plus("friction", x * np.tanh(run.parts["velocity"] / c["soft"]))


def lugre_force(  # noqa: PLR0917 - compiled by numba
    z: Array, v: Array, F_c: float, F_s: float, stribeck: float, sigma: float, out: Array
) -> None:
    """LuGre's bristles without viscous part, exact over a step of constant sign of the velocity."""
    q = 0.0
    for i in range(len(z)):
        dz = z[i] - z[i - 1] if i > 0 else 0.0
        if dz != 0.0:
            g = F_c + (F_s - F_c) * np.exp(-((v[i] / stribeck) ** 2))
            end = g / sigma if dz > 0.0 else -g / sigma
            q = end + (q - end) * np.exp(-sigma / g * abs(dz))
        out[i] = sigma * q


def lugre(run: Run, x: float, c: Constants) -> None:
    """Friction `x` [N] with presliding and more of it near rest."""
    out = np.empty_like(run.time)
    arguments = (x, x * c["static"], c["stribeck"], x / c["presliding"], out)
    with_numba(lugre_force)(run.parts["stroke"], run.parts["velocity"], *arguments)
    run.plus("friction", out)


def growing_friction(run: Run, x: float, c: Constants) -> None:
    """A bent rod: Coulomb friction `x` [N] in the middle, growing towards full rebound."""
    share = np.maximum(1.0 + c["growth"] * run.parts["stroke"] / c["reach"], 0.0)
    run.plus("friction", x * share * np.tanh(run.parts["velocity"] / c["soft"]))


def mount_constants(rng: np.random.Generator) -> dict[str, Any]:
    """Loss time [s], deflection [m] at which the cubic part equals the linear, friction share and its half-way [m]."""
    return {"loss": rng.uniform(2e-4, 1.5e-3), "cubic_at": rng.uniform(3e-4, 2e-3), "friction": rng.uniform(0.02, 0.1),
            "half_way": rng.uniform(5e-5, 3e-4)}  # fmt: skip


def kelvin_voigt(run: Run, x: float, c: Constants) -> None:
    """Spring and dashpot side by side; `x` [m/N] is the compliance."""
    run.mount = Mount(1.0 / x, damping=c["loss"] / x)


def cubic_mount(run: Run, x: float, c: Constants) -> None:
    """A bush that stiffens: the cubic part equals the linear at a deflection."""
    run.mount = Mount(1.0 / x, cubic=1.0 / x / c["cubic_at"] ** 2, damping=c["loss"] / x)


def filled_rubber(run: Run, x: float, c: Constants) -> None:
    """Rubber with filler: stiffer at small amplitude by its internal friction (Payne, as Berg models it)."""
    run.mount = Mount(1.0 / x, damping=0.3 * c["loss"] / x, friction=c["friction"] * 500.0, half_way=c["half_way"])


def inertia(run: Run, x: float, c: Constants) -> None:
    """A clamp of `x` [kg] moves between load cell and damper."""
    run.plus("gas", x * np.gradient(run.parts["velocity"], run.time))
