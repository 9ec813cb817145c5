"""Least squares in parameters scaled to their ranges, derivatives by differences, and the sandwich estimate."""

import itertools
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import optimize

from twintube.common.arrays import Array

STEP = 1e-3  # of a parameter's range: smaller steps meet the kinks of the model
EXACT = 1e-8  # scipy's relative change of cost or parameters at which a fit ends


def derivatives(residuals: Callable[[Array], Sequence[Array] | Array], x: Array, low: Array, high: Array) -> Array:
    """Derivatives (n, k) of residuals by the parameters x (k,) in units of their ranges: one-sided, away from the upper end.

    `residuals` takes parameter sets (k + 1, k) to (k + 1, n).
    """
    width = high - low
    step = STEP * width * np.where(x + STEP * width <= high, 1.0, -1.0)
    values = np.asarray(residuals(np.vstack([x, x + np.diag(step)])))
    rates: Array = ((values[1:] - values[0]) / (step / width)[:, None]).T
    return rates


def bounded(
    errors: Callable[[Array], Array], slopes: Callable[[Array], Array], start: Array, evaluations: int, ends: float = EXACT
) -> tuple[Array, float]:
    """The optimum (k,) of the squared errors (n,) within the unit cube from a start (k,) inside it, and their sum there."""
    fit = optimize.least_squares(
        errors, start, jac=slopes, bounds=(0.0, 1.0), max_nfev=evaluations, ftol=ends, xtol=ends
    )  # fmt: skip
    return np.asarray(fit.x), float(2 * fit.cost)


def pulls(J: Array, errors: Array, edges: NDArray[np.int64]) -> Array:
    """How each record pulls at the parameters (r, k): its share of the gradient; `edges` (r + 1,) where records begin.

    Errors that the samples of a record share do not average out within it, so the scatter of the records counts.
    """
    return np.array([J[a:b].T @ errors[a:b] for a, b in itertools.pairwise(edges)])


def sandwich(inverse: Array, middle: Array) -> Array:
    """Covariance (k, k) from the inverse Hessian and the scatter (k, k) of the pulls (Huber 1967, White 1982)."""
    return np.asarray(inverse @ middle @ inverse)
