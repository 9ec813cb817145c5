"""What is usual for a feature of a car: at first what it is for all cars, then what the car's own references say.

A feature of a good damper is a mean of all cars, plus what the car differs by, plus slopes of the car's own over speed and
road, plus what every drive differs by; each normally distributed. So references on a like road count most, one drive says
less than four, and without any the mean of all cars is left, as uncertain as cars differ.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from scipy import linalg, optimize

from twintube.common.arrays import Array

LEAST: Final = np.log(1e-3)  # of a standard deviation: features are logarithms, and a thousandth is nothing


@dataclass(frozen=True)
class Usual:
    """Of an axle: the mean at the middle of the conditions, its slopes over CONDITIONS, and standard deviations.

    `cars` is that between cars, `moves` those of a car's own slopes over DRIVEN, `drives` that between drives.
    """

    value: float
    slopes: tuple[float, ...]
    cars: float
    moves: tuple[float, ...]
    drives: float

    def alike(self, here: Array, there: Array) -> Array:
        """Covariance (m, n) of what a car differs by under conditions (m, d) and (n, d) from the middle."""
        return np.asarray(self.cars**2 + (here * np.square(self.moves)) @ there.T)

    def expected(self, here: Array, there: Array, values: Array) -> tuple[float, float]:
        """Mean and variance of a drive under conditions `here` (d,), by references `there` (n, d) with `values` (n,)."""
        at = here[None]
        variance = float(self.alike(at, at)[0, 0]) + self.drives**2
        if not len(values):
            return self.value, variance
        between = self.alike(at, there)[0]
        known = linalg.cho_factor(self.alike(there, there) + self.drives**2 * np.eye(len(values)))
        weights = linalg.cho_solve(known, between)
        return float(self.value + weights @ (values - self.value)), variance - float(weights @ between)


def means(values: Array, group: Any) -> Array:
    """Of each row (n, k) the mean of its group (n,)."""
    count = np.bincount(group)
    sums = np.column_stack([np.bincount(group, column) for column in values.T])
    return np.asarray((sums / count[:, None])[group])


def fitted(value: float, slopes: Sequence[float], cars: Sequence[tuple[Array, Array]]) -> Usual:
    """The likeliest standard deviations of cars (conditions (n, d), values (n,)) about the mean of all."""

    def usual(x: Array) -> Usual:
        spreads = np.exp(x)
        return Usual(value, tuple(slopes), float(spreads[0]), tuple(map(float, spreads[1:-1])), float(spreads[-1]))

    def unlikely(x: Array) -> float:
        some, total = usual(x), 0.0
        for there, values in cars:
            root = linalg.cholesky(some.alike(there, there) + some.drives**2 * np.eye(len(values)), lower=True)
            white = linalg.solve_triangular(root, values - value, lower=True)
            total += 0.5 * float(white @ white) + float(np.sum(np.log(np.diag(root))))
        return total

    begin = np.full(2 + cars[0][0].shape[1], np.log(0.2))
    bounds = [(LEAST, None)] * len(begin)
    return usual(optimize.minimize(unlikely, begin, method="L-BFGS-B", bounds=bounds).x)
