"""How well the records determine the parameters: a sample of all parameter sets that explain them about as well.

The sample is drawn by an affine-invariant ensemble from the likelihood of the force errors, flat within the bounds.
A residual that repeats in every oscillation is an error of the model or of the sampling. It tells nothing new the second
time, so it counts once per record; noise counts once per sample.
"""

import itertools
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.stats import norm

from twintube.common.arrays import Array
from twintube.fitting.journal import Journal
from twintube.fitting.least_squares import bounded, derivatives, pulls, sandwich
from twintube.identification.ensemble import sampled
from twintube.identification.objective import Objective

LEVEL = 0.95  # for all parameters together (Bonferroni)
BURN_IN = 0.4  # share of the chain that is dropped
UNDETERMINED = 0.5  # an interval wider than this share of the allowed range says nothing
AT_BOUND = 1e-3  # share of the allowed range
INSIDE = 1e-6  # share of the allowed range by which a least squares begins inside it
WEAK = 12.0  # one over the variance of a parameter that is evenly spread over its range: what no residual tells
POLISHING = 40  # most evaluations of the last least squares
SHARP = 0.1  # share of the allowed range: an interval narrower than that needs no profile
BEYOND = (1.0, 0.75, 0.5, 0.25)  # of the way from an interval's end to the bound, at which it is profiled
PROFILING = 6  # most evaluations of a least squares along a profile
LEAST = 0.01  # half an interval's least width as a share of the allowed range: to which the optimum can be located
PHASES = 32  # phases of an oscillation at which its residuals are compared


@dataclass(frozen=True)
class Estimate:
    """One identified parameter: value, interval and doubts."""

    name: str
    value: float
    low: float
    high: float
    bounds: tuple[float, float]

    @property
    def determined(self) -> bool:
        """Whether the interval is narrower than half of the allowed range."""
        return self.high - self.low <= UNDETERMINED * (self.bounds[1] - self.bounds[0])

    @property
    def at_bound(self) -> bool:
        """Whether the value is at an end of the allowed range."""
        width = self.bounds[1] - self.bounds[0]
        return min(self.value - self.bounds[0], self.bounds[1] - self.value) <= AT_BOUND * width


def variance(residual: Array, marks: Array) -> float:
    """Variance [N2] with which a sample counts in the likelihood; `residual` (n,) of the oscillations between `marks`."""
    cycles = [residual[a:b] for a, b in itertools.pairwise(marks)]
    folded = np.array([[part.mean() for part in np.array_split(c, PHASES)] for c in cycles if len(c) >= PHASES])
    if len(folded) < 2:
        return float(np.mean(residual**2)) * len(residual) / PHASES
    repeated = folded.mean(axis=0)
    spread = float(np.mean((folded - repeated) ** 2)) * len(folded) / (len(folded) - 1)
    bias = max(0.0, float(np.mean(repeated**2)) - spread / len(folded))
    noise = max(float(np.mean(residual**2)) - bias, 1e-12)
    # Neighbouring phases share a model error, so its correlation length counts as well.
    centred = repeated - repeated.mean()
    power = float(centred @ centred)
    lags = [float(centred[:-k] @ centred[k:]) / power for k in range(1, PHASES // 2)] if power > 0 else []
    first = next((i for i, c in enumerate(lags) if c <= 0), len(lags))
    correlation = 1.0 + 2.0 * sum(lags[:first])
    per_phase = len(residual) / (len(folded) * PHASES)
    return noise + bias * len(folded) * per_phase * correlation


def weights(objective: Objective, x: Array) -> Array:
    """One over twice the variance (r,) of each record's samples at the parameters x (k,)."""
    errors, edges = objective.residuals(x[None])[0], objective.edges
    return np.array([
        0.5 / variance(errors[a:b], r.marks - r.marks[0])
        for r, a, b in zip(objective.records, edges[:-1], edges[1:], strict=True)
    ])  # fmt: skip


def slopes(objective: Objective, x: Array) -> Array:
    """Derivatives (n, k) of all residuals by the parameters in units of their ranges."""
    return derivatives(objective.residuals, x, *objective.bounds.T)


def polished(objective: Objective, x: Array) -> Array:
    """The least-squares optimum of the force errors next to x (k,): the end of a search that a swarm leaves undone."""
    low, high = objective.bounds.T
    width = high - low
    u, _ = bounded(
        lambda u: objective.residuals((low + u * width)[None])[0],
        lambda u: slopes(objective, low + u * width),
        np.clip((x - low) / width, INSIDE, 1 - INSIDE),
        POLISHING,
    )
    return np.asarray(low + u * width)


def estimates(
    objective: Objective,
    x: Array,
    moved: Array,
    *,
    walkers: int,
    steps: int,
    seed: int,
    journal: Path | None,
    progress: Callable[[float], None] | None,
) -> tuple[list[Estimate], Array]:
    """Intervals of all parameters of the objective around its optimum x (k,), and the correlation matrix (k, k).

    The intervals are wider by `moved` (k,) on each side.
    """
    low, high = objective.bounds.T
    weight = weights(objective, x)

    def misfit(X: Array) -> Array:
        return np.nan_to_num(objective.sums(X)[:, :, 0] @ weight, nan=np.inf)

    memory = Journal(misfit, journal, progress)

    def log_probability(X: Array) -> Array:
        inside = ((low <= X) & (high >= X)).all(axis=1)
        values = np.full(len(X), -np.inf)
        if inside.any():
            values[inside] = -memory(X[inside])
        return values

    rng = np.random.default_rng(seed)
    rows = np.repeat(np.sqrt(2 * weight), np.diff(objective.edges))
    J = slopes(objective, x) * rows[:, None]
    spread = np.linalg.cholesky(np.linalg.inv(J.T @ J + WEAK * np.eye(len(x))))
    start = reflected(x + rng.standard_normal((walkers, len(x))) @ spread.T * (high - low), low, high)
    chain = sampled(log_probability, start, steps, rng)[int(BURN_IN * steps) :].reshape(-1, len(x))
    z = float(norm.ppf(1 - (1 - LEVEL) / 2 / len(x)))
    reach: Array = z * scatter(objective, x, J, rows) * (high - low)
    q16, q50, q84 = np.quantile(chain, norm.cdf([-1, 0, 1]), axis=0)
    reach = np.maximum(reach, LEAST * (high - low))
    results = []
    for i, name in enumerate(objective.names):
        a = max(low[i], min(x[i] - reach[i], q50[i] - z * (q50[i] - q16[i])) - moved[i])
        b = min(high[i], max(x[i] + reach[i], q50[i] + z * (q84[i] - q50[i])) + moved[i])
        # The walkers may not have come so far: how far beyond the interval the records are explained as well.
        if b - a > SHARP * (high[i] - low[i]):
            a, b = (
                next((y for y in beyond(end, bound) if profiled(objective, x, i, y, rows) <= z * z), end)
                for end, bound in ((a, low[i]), (b, high[i]))
            )
        results.append(Estimate(name, float(x[i]), float(a), float(b), (float(low[i]), float(high[i]))))
    with np.errstate(invalid="ignore"):
        related: Array = np.asarray(np.nan_to_num(np.corrcoef(chain.T)))
    return results, related


def beyond(end: float, bound: float) -> list[float]:
    """Values from a bound back towards an interval's end; none where the interval has come to the bound."""
    return [end + share * (bound - end) for share in BEYOND] if end != bound else []


def profiled(objective: Objective, x: Array, i: int, value: float, rows: Array) -> float:
    """Rise of the weighted squared error with parameter i at `value`, the others at their best: profile likelihood."""
    low, high = objective.bounds.T
    width = high - low
    others = np.flatnonzero(np.arange(len(x)) != i)

    def full(u: Array) -> Array:
        point = x.copy()
        point[others] = low[others] + u * width[others]
        point[i] = value
        return point

    def errors(u: Array) -> Array:
        return np.asarray(objective.residuals(full(u)[None])[0] * rows)

    start = np.clip((x[others] - low[others]) / width[others], INSIDE, 1 - INSIDE)
    _, least = bounded(errors, lambda u: slopes(objective, full(u))[:, others] * rows[:, None], start, PROFILING)
    base = objective.residuals(x[None])[0] * rows
    return float(least - base @ base)


def scatter(objective: Objective, x: Array, J: Array, rows: Array) -> Array:
    """Standard deviations (k,), as shares of the ranges, from how differently the records pull (sandwich estimate).

    What the samples of a record share is an error of model or sampling, not noise; the scatter of the records shows it.
    """
    own = pulls(J, objective.residuals(x[None])[0] * rows, objective.edges)
    # The optimum of forces and works together is not that of the forces alone, so that the mean pull is not zero.
    own -= own.mean(axis=0)
    count = len(own)
    inverse = np.linalg.inv(J.T @ J + WEAK * np.eye(len(x)))
    spread: Array = np.sqrt(np.diag(sandwich(inverse, own.T @ own * count / max(1, count - 1))))
    return spread


def reflected(X: Array, low: Array, high: Array) -> Array:
    """Points beyond a bound thrown back inside it."""
    inside = np.maximum(X, 2 * low - X)
    return np.clip(np.minimum(inside, 2 * high - inside), low, high)
