"""The affine-invariant ensemble sampler of Goodman and Weare (2010), doi 10.2140/camcos.2010.5.65, in two halves.

Each walker of a half steps along the line through a walker of the other half (the "stretch move"), so that a whole half is
evaluated at once (Foreman-Mackey et al. 2013, doi 10.1086/670067, Algorithm 3).
"""

from collections.abc import Callable

import numpy as np

from twintube.common.arrays import Array

STRETCH = 2.0  # a of the papers: a step goes to between 1/a and a times the distance


def moves(walkers: Array, others: Array, rng: np.random.Generator) -> tuple[Array, Array]:
    """Proposals (m, k) for walkers (m, k) by others (n, k), and the logarithm (m,) by which each counts more."""
    z = ((STRETCH - 1.0) * rng.random(len(walkers)) + 1.0) ** 2 / STRETCH  # density 1/sqrt(z)
    partners = others[rng.integers(len(others), size=len(walkers))]
    proposed: Array = partners + z[:, None] * (walkers - partners)
    return proposed, (walkers.shape[1] - 1) * np.log(z)


def sampled(log_density: Callable[[Array], Array], start: Array, steps: int, rng: np.random.Generator) -> Array:
    """The chain (steps, m, k) of m walkers from `start` (m, k); m must be even. `log_density` takes (n, k) to (n,)."""
    walkers, density = start.copy(), log_density(start)
    chain = np.empty((steps, *start.shape))
    for i in range(steps):
        for half in np.split(rng.permutation(len(walkers)), 2):
            others = np.delete(walkers, half, axis=0)
            proposed, factor = moves(walkers[half], others, rng)
            new = log_density(proposed)
            with np.errstate(invalid="ignore"):  # a walker that is nowhere takes any place
                taken = np.log(rng.random(len(half))) < factor + new - density[half]
            walkers[half[taken]], density[half[taken]] = proposed[taken], new[taken]
        chain[i] = walkers
    return chain
