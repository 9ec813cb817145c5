"""Hidden causes in the oil itself: foam, dissolving gas, leak, wrong level, other degradation parameters.

Sources: Bikerman, Foams (half-life, drainage); Henry's law; Landau and Levich (film on a rod); an orifice (Merritt).
"""

import math
from typing import Any

import numpy as np

from twintube.dampers import load
from twintube.fitting.parameters import DEGRADATION, ranges
from worlds.challenge.fluid import ATMOSPHERE
from worlds.model.march import Moment, collapsed
from worlds.model.run import Constants, Run

FULLEST, EMPTIEST = 0.97, 0.25  # true oil levels of degraded states


def foam_half_life(run: Run, x: float, c: Constants) -> None:
    """Foam volume falls at the rate `x` [1/s], a power of its volume: dV/dt = -x V (V / V_0)^(power - 1)."""
    reference = 0.1 * run.damper.parameters.V_oil

    def act(m: Moment) -> None:
        def gone(foam: float, oil: float) -> tuple[float, float]:
            share = 1.0 - math.exp(-x * (foam / reference) ** (c["power"] - 1.0) * m.dt) if foam > 0.0 else 0.0
            return share * foam, share * oil

        collapsed(m, gone)

    run.acts.append(act)


def foam_drainage(run: Run, x: float, c: Constants) -> None:
    """Liquid drains between the bubbles at the rate `x` [1/s] (Bikerman); the dry rest collapses five times slower."""

    def act(m: Moment) -> None:
        def gone(foam: float, oil: float) -> tuple[float, float]:
            drained = oil * (1.0 - math.exp(-x * m.dt))
            return drained + (foam - oil) * (1.0 - math.exp(-0.2 * x * m.dt)), drained

        collapsed(m, gone)

    run.acts.append(act)


def dissolving(run: Run, x: float, c: Constants, *, henry: bool = False) -> None:
    """Freed gas dissolves at the rate `x` [1/s]; after Henry that at ambient pressure, growing with the pressure."""

    def act(m: Moment) -> None:
        reserve = max(0.0, float(m.d["V_reserve"] - m.s["V3_oil"] - m.s["V3_foam"]))
        # Henry: what dissolves in a time goes with the absolute pressure of the gas; only the loaded chamber has more.
        rate = x * (1.0 + 0.5 * m.size / float(m.d["A_2"]) / ATMOSPHERE) if henry else x
        left = float(m.s["V_cav"]) * (1.0 - math.exp(-rate * m.dt))
        gases = [float(m.s["V1_gas"]), float(m.s["V2_gas"]), reserve if henry else 0.0]
        parts = [min(gas, left * gas / sum(gases)) if sum(gases) > 0.0 else 0.0 for gas in gases[:2]]
        parts.append(min(left - sum(parts), reserve))
        for chamber, part in zip(("V1", "V2", "V3"), parts, strict=True):
            m.s[f"{chamber}_oil"] += part
            if chamber != "V3":
                m.s[f"{chamber}_gas"] -= part
        m.s["V_cav"] -= sum(parts)

    run.acts.append(act)


def lose_before(run: Run, per_second: float) -> None:
    """Take the oil [m3/s] that was lost in the records before this, where the leak goes on between them."""
    p = run.damper.parameters
    run.damper = run.damper.with_(oil_level=max(EMPTIEST, p.oil_level - per_second * run.record.began / p.V_oil))


def film_leak(run: Run, x: float, c: Constants) -> None:
    """The rod carries `x` [m3] of oil per metre out of the reserve at 1 m/s, more the faster (Landau, Levich: a root)."""

    def act(m: Moment) -> None:
        m.s["V3_oil"] -= min(float(m.s["V3_oil"]), x * m.out * math.sqrt(m.speed))

    run.acts.append(act)
    if c["carried"]:
        lose_before(run, 0.02 * x)


def orifice_leak(run: Run, x: float, c: Constants) -> None:
    """Pressure above the guide drives `x` [m3/s] of oil at a force of 1 kN out of a cut seal, as through an orifice."""

    def act(m: Moment) -> None:
        gone = min(float(m.s["V1_oil"]), x * math.sqrt(max(m.fluid, 0.0) / 1000.0) * m.dt)
        m.s["V1_oil"] -= gone
        m.s["V1_gas"] += gone

    run.acts.append(act)
    if c["carried"]:
        lose_before(run, 0.05 * x)


def level_wrong(run: Run, x: float, c: Constants) -> None:
    """The degraded states, or one of them, hold more or less oil than recorded, by `x` [1], inside the bounds."""
    if not run.record.preload and c.get("state", run.record.level) == run.record.level:
        run.damper = run.damper.with_(oil_level=min(max(run.record.level + c["sign"] * x, EMPTIEST), FULLEST))


def drawn_parameters(rng: np.random.Generator) -> dict[str, Any]:
    """Three to seven of the fourteen degradation parameters, drawn in their ranges."""
    names = rng.choice(DEGRADATION, int(rng.integers(3, 8)), replace=False)
    bounds = dict(zip(DEGRADATION, ranges(DEGRADATION, 1.572), strict=True))
    return {"changed": {str(n): float(rng.uniform(*bounds[n])) for n in names}}


def borrowed_parameters(rng: np.random.Generator) -> dict[str, Any]:
    """All degradation parameters of another damper."""
    other = load(f"SA{int(rng.integers(1, 9))}").parameters
    return {"changed": {n: getattr(other, n) for n in DEGRADATION}}


def recalibrated(run: Run, x: float, c: Constants) -> None:
    """The parameters on the way from the set's to the drawn ones, 1 is there."""
    p = run.damper.parameters
    run.damper = run.damper.with_(**{n: (1.0 - x) * getattr(p, n) + x * v for n, v in c["changed"].items()})
