"""How well the records determine the parameters: a sample of all parameter sets that explain them about as well.

The sample is drawn by emcee (affine-invariant ensemble) from the likelihood of the force errors, flat within the bounds.
A residual that repeats in every oscillation is an error of the model or of the sampling and tells nothing new the
second time, so it counts once per record, noise once per sample.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.stats import norm

from twintube.arrays import Array
from twintube.identify.objective import Harmonic, Objective
from twintube.identify.optimise import Journal
from twintube.parameters import Damper
from twintube.simulate import simulate

LEVEL = 0.95  # for all parameters together (Bonferroni)
BURN_IN = 0.4  # share of the chain that is dropped
UNDETERMINED = 0.5  # an interval wider than this share of the allowed range says nothing
AT_BOUND = 1e-3  # share of the allowed range
PHASES = 32  # phases of an oscillation at which its residuals are compared


@dataclass(frozen=True)
class Estimate:
    """One identified parameter: value, interval and what is to be said about it."""

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


def variance(damper: Damper, record: Harmonic) -> float:
    """Variance [N2] with which a sample of the record counts in the likelihood."""
    state = damper.with_(oil_level=record.oil_level, gas_preload=record.gas_preload)
    residual = simulate(state, record.stroke, record.velocity).force - record.force
    folded = np.array([
        [part.mean() for part in np.array_split(residual[a:b], PHASES)]
        for a, b in zip(record.marks[:-1], record.marks[1:], strict=True)
        if b - a >= PHASES
    ])  # fmt: skip
    span = residual[record.marks[0] :]
    if len(folded) < 2:
        return float(np.mean(span**2)) * len(span) / PHASES
    repeated = folded.mean(axis=0)
    spread = float(np.mean((folded - repeated) ** 2)) * len(folded) / (len(folded) - 1)
    bias = max(0.0, float(np.mean(repeated**2)) - spread / len(folded))
    noise = max(float(np.mean(span**2)) - bias, 1e-12)
    # Neighbouring phases share a model error, so its correlation length counts as well.
    centred = repeated - repeated.mean()
    power = float(centred @ centred)
    lags = [float(centred[:-k] @ centred[k:]) / power for k in range(1, PHASES // 2)] if power > 0 else []
    first = next((i for i, c in enumerate(lags) if c <= 0), len(lags))
    correlation = 1.0 + 2.0 * sum(lags[:first])
    per_phase = len(span) / (len(folded) * PHASES)
    return noise + bias * len(folded) * per_phase * correlation


def estimates(
    objective: Objective,
    x: Array,
    records: Sequence[Harmonic],
    *,
    walkers: int,
    steps: int,
    seed: int,
    journal: Path | None,
    progress: Callable[[float], None] | None,
) -> tuple[list[Estimate], Array]:
    """Intervals of all parameters of the objective around its optimum x (k,), and the correlation matrix (k, k)."""
    import emcee

    best = objective.damper(x)
    weights = 0.5 / np.array([variance(best, record) for record in records])
    low, high = objective.bounds.T

    def misfit(X: Array) -> Array:
        return np.nan_to_num(objective.sums(X)[:, :, 0] @ weights, nan=np.inf)

    memory = Journal(misfit, journal, progress)

    def log_probability(X: Array) -> Array:
        inside = ((low <= X) & (high >= X)).all(axis=1)
        values = np.full(len(X), -np.inf)
        if inside.any():
            values[inside] = -memory(X[inside])
        return values

    rng = np.random.default_rng(seed)
    scale = slice_widths(misfit, x, objective.bounds)
    start = reflected(x + scale * rng.standard_normal((walkers, len(x))), low, high)
    sampler = emcee.EnsembleSampler(walkers, len(x), log_probability, vectorize=True)
    state = emcee.State(start, random_state=np.random.RandomState(seed).get_state())
    sampler.run_mcmc(state, steps)
    chain = sampler.get_chain(discard=int(BURN_IN * steps), flat=True)
    z = float(norm.ppf(1 - (1 - LEVEL) / 2 / len(x)))
    q16, q50, q84 = np.quantile(chain, norm.cdf([-1, 0, 1]), axis=0)
    found = []
    for i, name in enumerate(objective.names):
        a = max(low[i], min(x[i], q50[i] - z * (q50[i] - q16[i])))
        b = min(high[i], max(x[i], q50[i] + z * (q84[i] - q50[i])))
        found.append(Estimate(name, float(x[i]), float(a), float(b), (float(low[i]), float(high[i]))))
    with np.errstate(invalid="ignore"):
        related: Array = np.nan_to_num(np.corrcoef(chain.T))
    return found, related


def slice_widths(misfit: Callable[[Array], Array], x: Array, bounds: Array) -> Array:
    """How far (k,) each parameter alone can move until the misfit rises by about one half."""
    shares = np.geomspace(1e-5, 0.5, 18)
    base = float(misfit(x[None])[0])
    found = np.empty(len(x))
    for i, (low, high) in enumerate(bounds):
        X = np.repeat(x[None], len(shares), axis=0)
        to = x[i] + shares * (high - low)
        X[:, i] = np.where(to <= high, to, x[i] - shares * (high - low))
        within = np.flatnonzero(misfit(np.clip(X, bounds[:, 0], bounds[:, 1])) <= base + 0.5)
        found[i] = (shares[within[-1]] if len(within) else shares[0]) * (high - low)
    return found


def reflected(X: Array, low: Array, high: Array) -> Array:
    """Points beyond a bound thrown back inside it."""
    inside = np.maximum(X, 2 * low - X)
    return np.clip(np.minimum(inside, 2 * high - inside), low, high)
