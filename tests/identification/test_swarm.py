"""The particle swarm beside its description (Clerc and Kennedy 2002), and on functions whose minimum is known."""

import math

import numpy as np
import pytest

from twintube.common.arrays import Array
from twintube.identification.optimise import ATTRACTION, CONSTRICTION, minimise


def test_the_constriction_is_that_of_the_paper() -> None:
    """Equation 4.7 with kappa = 1: 2 kappa / |2 - phi - sqrt(phi^2 - 4 phi)|."""
    phi = 2 * ATTRACTION
    assert phi == 4.1
    assert pytest.approx(2 / abs(2 - phi - math.sqrt(phi**2 - 4 * phi)), rel=1e-15) == CONSTRICTION


def test_each_move_is_that_of_the_description() -> None:
    """Velocities of three generations, from the places alone: what random numbers between 0 and 1 can explain."""
    seen: list[Array] = []

    def bowl(X: Array) -> Array:
        seen.append(X.copy())
        return np.sum((X - 0.31) ** 2, axis=1)  # type: ignore[no-any-return]

    minimise(bowl, np.array([[0.0, 1.0]] * 2), method="pso", population=12, generations=12, seed=2)
    own, least = seen[0].copy(), np.sum((seen[0] - 0.31) ** 2, axis=1)
    for i in range(1, len(seen) - 1):
        errors = np.sum((seen[i] - 0.31) ** 2, axis=1)
        better = errors < least
        own[better], least[better] = seen[i][better], errors[better]
        best = own[np.argmin(least)]
        moved = seen[i] - seen[i - 1]
        pull = seen[i + 1] - seen[i] - CONSTRICTION * moved
        ends = CONSTRICTION * ATTRACTION * np.array([np.zeros_like(own), own - seen[i]])
        other = CONSTRICTION * ATTRACTION * np.array([np.zeros_like(own), best - seen[i]])
        low, high = ends.min(axis=0) + other.min(axis=0), ends.max(axis=0) + other.max(axis=0)
        at_bounds = (seen[i] <= 0) | (seen[i] >= 1) | (seen[i + 1] <= 0) | (seen[i + 1] >= 1)
        assert (at_bounds | ((pull >= low - 1e-12) & (pull <= high + 1e-12))).all()


def test_places_stay_within_the_bounds_and_reach_a_minimum_on_one() -> None:
    def slope(X: Array) -> Array:
        assert ((X >= -1.0) & (X <= 2.0)).all()
        return X.sum(axis=1)  # type: ignore[no-any-return]

    best = minimise(slope, np.array([[-1.0, 2.0]] * 4), method="pso", population=20, generations=60, seed=1)
    assert best.x.tolist() == [-1.0] * 4


def test_the_sphere_of_thirty_dimensions_is_found() -> None:
    """As swarms of this kind do (Bratton and Kennedy 2007, Table III): no error is left that a computer tells from 0."""
    best = minimise(
        lambda X: np.sum(X**2, axis=1),
        np.array([[-100.0, 100.0]] * 30),
        method="pso",
        population=50,
        generations=2000,
        seed=1,
    )
    assert best.error < 1e-20
