"""Optimisers from libraries behind a common call, seeded and resumable (twintube.fitting.journal)."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from twintube.common.arrays import Array
from twintube.fitting.journal import Journal, Objective


@dataclass(frozen=True)
class Best:
    """The result of a search: the best parameters (k,), their error, the best error after each generation."""

    x: Array
    error: float
    trace: Array
    evaluations: int
    last: Array  # (m, k) the last generation where the method keeps one, else the best; best first


def pso(journal: Journal, bounds: Array, population: int, generations: int, seed: int) -> Array:
    """Particle swarm of pymoo, a whole swarm per call."""
    from pymoo.algorithms.soo.nonconvex.pso import PSO
    from pymoo.core.problem import Problem
    from pymoo.optimize import minimize

    class Vectorised(Problem):  # type: ignore[misc]  # pymoo is untyped
        def _evaluate(self, X: Array, out: dict[str, Any], *_: Any, **__: Any) -> None:
            out["F"] = journal(X)[:, None]

    problem = Vectorised(n_var=len(bounds), n_obj=1, xl=bounds[:, 0], xu=bounds[:, 1])
    minimize(problem, PSO(pop_size=population), ("n_gen", generations), seed=seed, verbose=False)
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
