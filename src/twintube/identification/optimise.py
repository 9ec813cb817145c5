"""Optimisers from libraries behind a common call, seeded and resumable (twintube.fitting.journal)."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from twintube.arrays import Array
from twintube.fitting.journal import Journal, Objective


@dataclass(frozen=True)
class Best:
    """The result of a search: the best parameters (k,), their error, the best error after each generation."""

    x: Array
    error: float
    trace: Array
    evaluations: int


def pso(journal: Journal, bounds: Array, population: int, generations: int, seed: int, start: Array | None) -> None:
    """Particle swarm of pymoo, a whole swarm per call."""
    from pymoo.algorithms.soo.nonconvex.pso import PSO
    from pymoo.core.problem import Problem
    from pymoo.optimize import minimize

    class Vectorised(Problem):  # type: ignore[misc]  # pymoo is untyped
        def _evaluate(self, X: Array, out: dict[str, Any], *_: Any, **__: Any) -> None:
            out["F"] = journal(X)[:, None]

    problem = Vectorised(n_var=len(bounds), n_obj=1, xl=bounds[:, 0], xu=bounds[:, 1])
    swarm = (
        PSO(pop_size=population)
        if start is None
        else PSO(pop_size=population, sampling=around(bounds, population, seed, start))
    )
    minimize(problem, swarm, ("n_gen", generations), seed=seed, verbose=False)


def around(bounds: Array, population: int, seed: int, start: Array | None) -> Array:
    """A first generation (population, k), evenly random, with the start in it."""
    points = np.random.default_rng(seed).uniform(bounds[:, 0], bounds[:, 1], (population, len(bounds)))
    if start is not None:
        points[0] = start
    return points


def cma_es(journal: Journal, bounds: Array, population: int, generations: int, seed: int, start: Array | None) -> None:
    """CMA-ES of the package cma, in the unit cube, from its middle or, in smaller steps, from the start."""
    import cma

    width = bounds[:, 1] - bounds[:, 0]
    options = {"bounds": [0, 1], "popsize": population, "seed": seed + 1, "verbose": -9, "maxiter": generations}
    first, size = (np.full(len(bounds), 0.5), 0.3) if start is None else ((start - bounds[:, 0]) / width, 0.1)
    strategy = cma.CMAEvolutionStrategy(first, size, options)
    while journal.generation < generations and not strategy.stop():
        asked = strategy.ask()
        strategy.tell(asked, journal(bounds[:, 0] + np.array(asked) * width).tolist())


def de(journal: Journal, bounds: Array, population: int, generations: int, seed: int, start: Array | None) -> None:
    """Differential evolution of scipy, without polishing."""
    from scipy.optimize import differential_evolution

    differential_evolution(
        lambda X: journal(X.T), bounds, init=around(bounds, population, seed, start), maxiter=generations - 1, rng=seed,
        polish=False, vectorized=True, updating="deferred", tol=0, atol=0,
    )  # fmt: skip


METHODS = {"pso": pso, "cma": cma_es, "de": de}


def minimise(
    objective: Objective,
    bounds: Array,
    *,
    method: str = "pso",
    population: int,
    generations: int,
    seed: int = 1,
    start: Array | None = None,
    journal: Path | None = None,
    progress: Callable[[float], None] | None = None,
) -> Best:
    """Minimise `objective`, which takes X (m, k) to (m,), within `bounds` (k, 2).

    `start` (k,) is a point to begin at; `journal` is a file that makes the run resumable; `progress` is called with the
    best error after each generation.
    """
    memory = Journal(objective, journal, progress)
    METHODS[method](memory, np.asarray(bounds, dtype=float), population, generations, seed, start)
    return Best(memory.x, memory.error, np.array(memory.trace), memory.evaluations)
