"""Drawing a specimen: which traits it has, scaled to a deviation of 2 to 6 % from the parameter set."""

from dataclasses import replace
from typing import Final

import numpy as np
from scipy.optimize import brentq

from twintube import load
from twintube.common.arrays import Array
from worlds.imperfect.law import POSITIVE, RATE, T_PARAMETERS, TRAITS, Inside, Law, State, force, inside

OFF: Final = (0.02, 0.06)  # RMS over peak, root of the mean square over the speeds below
MOST_SCALE: Final = 1.8  # of the traits as drawn
SPEEDS: Final = (0.052, 0.131, 0.262, 0.524, 1.048)  # [m/s], the usual test speeds, with 25 mm


def off(law: Law, runs: list[tuple[Array, Inside]]) -> float:
    """RMS of the deviation over the largest force, as delivered and at T_PARAMETERS; over the speeds the RMS of these."""
    parts = []
    for z, found in runs:
        warm = np.full(len(z), T_PARAMETERS)
        nominal = force(replace(law, nominal=True), State(), z, warm, found)
        parts.append(np.mean((force(law, State(), z, warm, found) - nominal) ** 2) / np.abs(nominal).max() ** 2)
    return float(np.sqrt(np.mean(parts)))


def sweep(law: Law) -> list[tuple[Array, Inside]]:
    """Two cycles of each of SPEEDS."""
    strokes = [-0.025 * np.cos(np.arange(0.0, 4 * np.pi, v / 0.025 / RATE)) for v in SPEEDS]
    return [(z, inside(law, State(), z)) for z in strokes]


def specimen(rng: np.random.Generator, name: str, *, as_published: bool) -> tuple[Law, float]:
    """A specimen of the damper `name` and its deviation."""
    damper = load(name, as_published=as_published)
    # Fill by dosing 1.5 % of volume, lengths of piston, foot valve and stops a millimetre or two.
    p = damper.parameters
    damper = damper.with_(
        dead_length=p.dead_length + rng.uniform(-1.5e-3, 1.5e-3), V_oil=p.V_oil * rng.uniform(0.985, 1.015)
    )
    aim = rng.uniform(*OFF)
    while True:
        traits = {}
        for trait in sorted(rng.choice(list(TRAITS), int(rng.integers(3, 6)), replace=False)):
            size = TRAITS[trait] * rng.uniform(0.4, 1.0)
            traits[str(trait)] = float(size if trait in POSITIVE else size * rng.choice([-1.0, 1.0]))
        law = Law(
            damper, traits, lag=float(rng.uniform(0.2e-3, 1.0e-3)), order=int(rng.integers(1, 3)),
            smoothing=float(rng.uniform(1e-3, 6e-3)), viscosity=float(-rng.uniform(0.001, 0.003)),
        )  # fmt: skip
        runs = sweep(law)
        # Traits that cancel out, or all but make no force, would have to be larger than those of any production.
        if off(replace(law, scale=MOST_SCALE), runs) > aim:
            break
    found = brentq(lambda scale: off(replace(law, scale=scale), runs) - aim, 0.0, MOST_SCALE, xtol=1e-3)
    law = replace(law, scale=float(found))
    return law, 100.0 * off(law, runs)
