"""Drawing a specimen: which traits it has, scaled to a deviation of 2 to 6 % from the parameter set."""

from dataclasses import replace
from typing import Final

import numpy as np
from scipy.optimize import brentq

from twintube import load
from worlds.imperfect.law import POSITIVE, T_PARAMETERS, TRAITS, Array, Law, RATE, State, force

OFF: Final = (0.02, 0.06)  # RMS over peak, root of the mean square over the speeds below
SPEEDS: Final = (0.052, 0.131, 0.262, 0.524, 1.048)  # [m/s], the usual test speeds, with 25 mm


def deviation(law: Law, z: Array) -> float:
    """RMS of the deviation from the parameter set's law over the largest force, as delivered and at T_PARAMETERS."""
    v, warm = np.gradient(z) * RATE, np.full(len(z), T_PARAMETERS)
    nominal = force(replace(law, nominal=True), State(), z, v, warm)
    return float(np.sqrt(np.mean((force(law, State(), z, v, warm) - nominal) ** 2)) / np.abs(nominal).max())


def off(law: Law) -> float:
    """The deviation over SPEEDS."""
    parts = []
    for speed in SPEEDS:
        omega = speed / 0.025
        parts.append(deviation(law, -0.025 * np.cos(omega * np.arange(0.0, 4 * np.pi / omega, 1.0 / RATE))))
    return float(np.sqrt(np.mean(np.square(parts))))


def specimen(rng: np.random.Generator, name: str, *, as_published: bool) -> tuple[Law, float]:
    """A specimen of the damper `name` and its deviation."""
    damper = load(name, as_published=as_published)
    # Fill by dosing 1.5 % of volume, lengths of piston, foot valve and stops a millimetre or two.
    p = damper.parameters
    damper = damper.with_(dead_length=p.dead_length + rng.uniform(-1.5e-3, 1.5e-3), V_oil=p.V_oil * rng.uniform(0.985, 1.015))
    traits = {}
    for trait in sorted(rng.choice(list(TRAITS), int(rng.integers(3, 6)), replace=False)):
        size = TRAITS[trait] * rng.uniform(0.4, 1.0)
        traits[str(trait)] = float(size if trait in POSITIVE else size * rng.choice([-1.0, 1.0]))
    law = Law(
        damper, traits, lag=float(rng.uniform(0.2e-3, 1.0e-3)), order=int(rng.integers(1, 3)),
        smoothing=float(rng.uniform(0.5e-3, 3e-3)), viscosity=float(-rng.uniform(0.001, 0.003)),
    )  # fmt: skip
    aim = rng.uniform(*OFF)
    top = 1.0
    while off(replace(law, scale=top)) < aim and top < 16.0:
        top *= 2.0
    found = brentq(lambda scale: off(replace(law, scale=scale)) - aim, 0.0, top, xtol=1e-3)
    law = replace(law, scale=float(found))
    return law, 100.0 * off(law)
