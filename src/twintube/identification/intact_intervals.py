"""How well the records of the intact damper determine friction and gas spring.

A residual that repeats in every oscillation is an error of the model and counts once per record, see uncertainty.variance.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
from scipy.stats import norm, t

from twintube.common.arrays import Array
from twintube.core import effects
from twintube.fitting.least_squares import sandwich
from twintube.identification.uncertainty import LEVEL, Estimate, variance

INTACT = ("F_FrS", "sigma_0", "F_0", "c_gas")
FREE = 1e-9  # relative to the largest column: what is less does not act


@dataclass(frozen=True)
class IntactEstimate(Estimate):
    """A parameter of friction or gas spring; its allowed range is so wide that the value itself is the measure."""

    @property
    def determined(self) -> bool:
        """Whether the interval is narrower than the value."""
        return self.high - self.low <= abs(self.value)


def interval(name: str, value: float, low: float, high: float) -> IntactEstimate:
    """The estimate with its interval, cut to the allowed range."""
    meta = {item.name: item.metadata for item in fields(effects.Parameters)}[name]
    lower, upper = float(meta["lower"]), float(meta["upper"])
    return IntactEstimate(name, value, float(max(lower, low)), float(min(upper, high)), (lower, upper))


def level(free: int | None = None) -> float:
    """Standard deviations on each side of an interval for all parameters together, of so many degrees of freedom."""
    share = 1 - (1 - LEVEL) / 2 / len(INTACT)
    return float(norm.ppf(share) if free is None else t.ppf(share, free))


def scattered(values: dict[str, float], errors: dict[str, tuple[float, int]]) -> list[Estimate]:
    """Intervals from standard errors and their degrees of freedom: those of the strokes of a quasi-static record."""
    estimates: list[Estimate] = []
    for name in INTACT:
        error, free = errors[name]
        reach = level(free) * error if free > 0 else np.inf
        estimates.append(interval(name, values[name], values[name] - reach, values[name] + reach))
    return estimates


def covariance(columns: Array, errors: Array, weight: Array, free: Array, marks: Sequence[Array]) -> Array:
    """Covariance (k, k) of the coefficients of a weighted least squares whose records lie end to end.

    Args:
        columns: derivatives (n, k) of the force by the coefficients.
        errors: residuals (n,) [N].
        weight: of each sample (n,), as a factor of its residual.
        free: which coefficients (k,) are not at a bound; the others have no variance.
        marks: per record where its oscillations begin and end among its own samples, the first 0.

    """
    size = np.linalg.norm(columns * weight[:, None], axis=0)
    acting = np.flatnonzero(free & (size > FREE * size.max()))
    J = columns[:, acting] / size[acting]
    middle = np.zeros((len(acting), len(acting)))
    start = 0
    for record in marks:
        part = slice(start, start + int(record[-1]) + 1)
        start = part.stop
        pulled = J[part] * (weight[part] ** 2)[:, None]
        middle += variance(errors[part], record) * (pulled.T @ pulled)
    inverse = np.linalg.pinv((J * weight[:, None]).T @ (J * weight[:, None]))
    result = np.zeros((columns.shape[1], columns.shape[1]))
    result[np.ix_(acting, acting)] = sandwich(inverse, middle) / np.outer(size[acting], size[acting])
    return result


def of_sines(values: dict[str, float], C: Array) -> list[Estimate]:
    """Intervals from the covariance (4, 4) of F_0, c_gas, F_FrS and the logarithm of the length of reversal."""
    z = level()
    F_0, c_gas, F_FrS, _ = np.sqrt(np.maximum(np.diag(C), 0.0))
    # sigma_0 = F_FrS / length
    share = 1 / max(values["F_FrS"], 1e-9)
    reach = z * float(np.sqrt(max(0.0, C[2, 2] * share**2 + C[3, 3] - 2 * share * C[2, 3])))
    spread = float(np.exp(min(reach, 50.0)))
    return [
        interval("F_FrS", values["F_FrS"], values["F_FrS"] - z * F_FrS, values["F_FrS"] + z * F_FrS),
        interval("sigma_0", values["sigma_0"], values["sigma_0"] / spread, values["sigma_0"] * spread),
        interval("F_0", values["F_0"], values["F_0"] - z * F_0, values["F_0"] + z * F_0),
        interval("c_gas", values["c_gas"], values["c_gas"] - z * c_gas, values["c_gas"] + z * c_gas),
    ]
