"""Hidden causes in the oil itself: foam, dissolving gas, leak, wrong level, other degradation parameters.

Sources: Bikerman, Foams (half-life, drainage); Henry's law; Landau and Levich (film on a rod); an orifice (Merritt).
"""

from typing import Any

import numpy as np

from twintube.core.variables import Parameters
from twintube.dampers import load
from twintube.fitting.parameters import DEGRADATION, ranges
from twintube.lab.challenge.march import DRAINAGE, FILM, FIRST_ORDER, HALF_LIFE, HENRY, ORIFICE
from twintube.lab.challenge.run import Constants, Run

FULLEST, EMPTIEST = 0.97, 0.25  # true oil levels of degraded states


def foam_half_life(run: Run, x: float, c: Constants) -> None:
    """Foam volume falls at the rate `x` [1/s], a power of its volume."""
    run.between.foam, run.between.foam_rate, run.between.foam_power = HALF_LIFE, x, c["power"]


def foam_drainage(run: Run, x: float, c: Constants) -> None:
    """Liquid drains out of the foam at the rate `x` [1/s]; dry foam collapses slower."""
    run.between.foam, run.between.foam_rate = DRAINAGE, x


def dissolving(run: Run, x: float, c: Constants) -> None:
    """Freed gas dissolves at the rate `x` [1/s]."""
    run.between.gas, run.between.gas_rate = FIRST_ORDER, x


def dissolving_under_pressure(run: Run, x: float, c: Constants) -> None:
    """As `dissolving`, the rate `x` [1/s] at ambient pressure growing with the pressure (Henry)."""
    run.between.gas, run.between.gas_rate = HENRY, x


def lose_before(run: Run, per_second: float) -> None:
    """Take the oil [m3/s] that was lost in the records before this, where the leak goes on between them."""
    p = run.damper.parameters
    left = p.oil_level - per_second * run.record.began / p.V_oil
    run.damper = run.damper.with_(oil_level=max(EMPTIEST, left))


def film_leak(run: Run, x: float, c: Constants) -> None:
    """The rod carries `x` [m3] of oil out per metre at 1 m/s, out of the reserve."""
    run.between.leak, run.between.leak_size = FILM, x
    if c["carried"]:
        lose_before(run, 0.02 * x)


def orifice_leak(run: Run, x: float, c: Constants) -> None:
    """A cut seal lets `x` [m3/s] out of the rebound chamber at a force of 1 kN."""
    run.between.leak, run.between.leak_size = ORIFICE, x
    if c["carried"]:
        lose_before(run, 0.05 * x)


def set_level(run: Run, change: float) -> None:
    """Change the true oil level, inside its bounds."""
    run.damper = run.damper.with_(oil_level=min(max(run.record.level + change, EMPTIEST), FULLEST))


def level_everywhere(run: Run, x: float, c: Constants) -> None:
    """Every degraded state holds more or less oil than recorded, by `x` [1]."""
    if not run.record.preload:
        set_level(run, c["sign"] * x)


def level_once(run: Run, x: float, c: Constants) -> None:
    """A single degraded state holds more or less than recorded."""
    if run.record.level == c["state"]:
        set_level(run, c["sign"] * x)


def drawn_parameters(rng: np.random.Generator, old: Parameters) -> dict[str, Any]:
    """Three to seven of the fourteen degradation parameters, drawn in their ranges."""
    names = rng.choice(DEGRADATION, int(rng.integers(3, 8)), replace=False)
    bounds = dict(zip(DEGRADATION, ranges(DEGRADATION, 1.572), strict=True))
    return {"changed": {str(n): float(rng.uniform(*bounds[n])) for n in names}}


def borrowed_parameters(rng: np.random.Generator, old: Parameters) -> dict[str, Any]:
    """All degradation parameters of another damper."""
    other = load(f"SA{int(rng.integers(1, 9))}").parameters
    return {"changed": {n: getattr(other, n) for n in DEGRADATION}}


def recalibrated(run: Run, x: float, c: Constants) -> None:
    """The parameters on the way from the set's to the drawn ones, 1 is there."""
    p = run.damper.parameters
    run.damper = run.damper.with_(**{n: (1.0 - x) * getattr(p, n) + x * v for n, v in c["changed"].items()})
