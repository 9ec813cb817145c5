"""Optimisers behind a common call, seeded and resumable (twintube.fitting.journal)."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from twintube.common.arrays import Array
from twintube.fitting.journal import Journal, Objective

# Of the swarm: the pull to each of the two best places, and the factor by which it contracts for that pull.
ATTRACTION, CONSTRICTION = 2.05, 0.7298437881283576  # 2 / (phi - 2 + sqrt(phi**2 - 4 phi)) with phi = 2 * 2.05


@dataclass(frozen=True)
class Best:
    """The result of a search: the best parameters (k,), their error, the best error after each generation."""

    x: Array
    error: float
    trace: Array
    evaluations: int
    last: Array  # (m, k) the last generation where the method keeps one, else the best; best first


def pso(journal: Journal, bounds: Array, population: int, generations: int, seed: int) -> Array:
    """Particle swarm with constriction (Clerc and Kennedy 2002, doi 10.1109/4235.985692), a whole swarm per call.

    A particle that would leave the bounds stops at them.
    """
    (low, high), rng = bounds.T, np.random.default_rng(seed)
    X = rng.uniform(low, high, (population, len(bounds)))
    V = rng.uniform(low, high, X.shape) - X
    own, least = X.copy(), journal(X)  # the best place of each particle, and the error there
    for _ in range(generations - 1):
        best = own[np.argmin(least)]
        V = CONSTRICTION * (V + ATTRACTION * (rng.random(X.shape) * (own - X) + rng.random(X.shape) * (best - X)))
        outside = (low > X + V) | (high < X + V)
        X, V = np.clip(X + V, low, high), np.where(outside, 0.0, V)
        errors = journal(X)
        better = errors < least
        own[better], least[better] = X[better], errors[better]
    return journal.x[None]


def de(journal: Journal, bounds: Array, population: int, generations: int, seed: int) -> Array:
    """Differential evolution of scipy, without polishing."""
    from scipy.optimize import differential_evolution

    first = np.random.default_rng(seed).uniform(bounds[:, 0], bounds[:, 1], (population, len(bounds)))
    found = differential_evolution(
        lambda X: journal(X.T), bounds, init=first, maxiter=generations - 1, rng=seed, polish=False, vectorized=True,
        updating="deferred", tol=0, atol=0,
    )  # fmt: skip
    return np.asarray(found.population[np.argsort(found.population_energies, kind="stable")])


METHODS = {"de": de, "pso": pso}
DEFAULT = "de"  # of every door; docs/identification.md says what was measured


def minimise(
    objective: Objective,
    bounds: Array,
    *,
    method: str = DEFAULT,
    population: int,
    generations: int,
    seed: int = 1,
    journal: Path | None = None,
    progress: Callable[[float], None] | None = None,
) -> Best:
    """Minimise `objective`, which takes X (m, k) to (m,), within `bounds` (k, 2).

    `journal` is a file that makes the run resumable; `progress` is called with the best error after each generation.
    """
    memory = Journal(objective, journal, progress)
    last = METHODS[method](memory, np.asarray(bounds, dtype=float), population, generations, seed)
    return Best(memory.x, memory.error, np.array(memory.trace), memory.evaluations, last)
