"""The model against all cases at once: residuals for any parameters of damper and measurement, and their least squares."""

import itertools
import os
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields
from functools import lru_cache
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from twintube.arrays import Array
from twintube.core import effects
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import Damper
from twintube.diagnosis.prepare import Case
from twintube.engine import compiled
from twintube.identification.averaging import averaged_means
from twintube.identification.objective import tolerant

# What the measurement adds to the damper.
MEASUREMENT = ("force_offset", "force_gain", "channel_delay")
NUMERICS = 3e-3  # of a record's peak force: what sampling and the time step of the model leave [tests/diagnose]
STEP = 1e-3  # of a parameter's range: step of a derivative
PRIOR = 0.5  # of a parameter's range: standard deviation of a weak pull to its start, which keeps idle ones in place
ITERATIONS = 12
ENOUGH = 1e-4  # relative change of the cost or the parameters at which a fit ends; a cause must change the cost by percents
USUAL = 3.0  # standard deviations of the records' zeros: larger ones are not taken for a zero
REMEMBERED = 32  # latest simulations
PARTS = 8  # steps of the model per interval, as effects with a short memory ask for at most: numerics alike in all models


@dataclass(frozen=True)
class Free:
    """A parameter that a fit may move."""

    name: str
    start: float
    low: float
    high: float

    @property
    def width(self) -> float:
        """Its range."""
        return self.high - self.low


@dataclass(frozen=True)
class Fit:
    """The optimum of one model."""

    free: tuple[Free, ...]
    values: dict[str, float]  # of all free parameters
    misfit: Array  # (r,) mean squared weighted error per case
    covariance: Array  # (k, k), robust against errors that a record's samples share


class Problem:
    """All cases laid end to end; `drift` [N] is how far the zero of the load cell differs from record to record."""

    def __init__(self, damper: Damper, cases: Sequence[Case], drift: float = 0.0) -> None:
        self.given = damper
        self.cases = list(cases)
        self.drift = drift
        self.damper = tolerant(damper)
        self.starts = np.concatenate([[0], np.cumsum([len(c.time) for c in cases])]).astype(np.int64)
        self.states = np.array([[c.oil_level, c.preload] for c in cases], dtype=float)
        self.t, self.z, self.v = (np.concatenate([getattr(c, n) for c in cases]) for n in ("time", "stroke", "velocity"))
        self.measured = np.concatenate([c.measured() for c in cases])
        self.sigma = np.concatenate([np.hypot(c.noise, NUMERICS * c.peak) for c in cases])
        # The first sample of a record has no interval before it, that of a stretch one that is mostly rest.
        stretch = np.concatenate([c.stretch for c in cases])
        used = np.diff(stretch, prepend=-1) == 0
        used[self.starts[:-1]] = False
        self.weight = np.where(used, 1 / self.sigma, 0.0)
        self.power = np.add.reduceat(self.weight**2, self.starts[:-1])  # (r,) [1/N2], of a record's zero
        self.share: Array = np.ones(len(self.z))
        self.counts = np.add.reduceat(used.astype(np.int64), self.starts[:-1])
        self.threads = ThreadPoolExecutor(os.cpu_count())
        self.known = {item.name for item in fields(effects.Parameters)}
        # The measurement's parameters need no simulation of their own.
        self.simulated = lru_cache(REMEMBERED)(self.simulate)

    def with_cases(self, cases: Sequence[Case]) -> "Problem":
        """The same damper with other cases."""
        return Problem(self.given, cases, self.drift)

    def with_drift(self, drift: float) -> "Problem":
        """The same with a zero of the load cell that differs from record to record."""
        return Problem(self.given, self.cases, drift)

    def damping(self, values: Mapping[str, float]) -> tuple[tuple[str, float], ...]:
        """The damper's among the values."""
        return tuple(sorted((name, value) for name, value in values.items() if name in self.known))

    def simulate(self, changes: Sequence[tuple[str, float]]) -> Array:
        """Mean forces (n,) [N] of the damper with parameters changed."""
        records = (self.damper.parameters, blank(Derived), blank(effects.State), blank(Flow))
        rows: list[Any] = [compiled.as_row(record)[0] for record in records]
        for name, value in changes:
            rows[0][name] = value
        force, work = np.empty(len(self.z)), np.empty(len(self.z))
        done = compiled.module().run_means(*rows, self.states, self.t, self.z, self.v, self.starts, PARTS, force, work)
        force[self.starts[done] :] = 1e9
        for case, a, b in zip(self.cases, self.starts[:-1], self.starts[1:], strict=True):
            force[a:b] = averaged_means(case.time, force[a:b], case.averaged)
        return force

    def forces(self, values: Mapping[str, float]) -> Array:
        """Predicted mean forces (n,) [N], measurement included."""
        force = self.simulated(self.damping(values))
        found: Array = values.get("force_gain", 1.0) * force + values.get("force_offset", 0.0)
        return found

    def target(self, values: Mapping[str, float]) -> Array:
        """Measured mean forces (n,), read later by the delay of the force channel."""
        delay = values.get("channel_delay", 0.0)
        return np.concatenate([c.measured(delay) for c in self.cases]) if delay else self.measured

    def errors(self, values: Mapping[str, float]) -> Array:
        """Simulated less measured force (n,) [N]."""
        return self.forces(values) - self.target(values)

    def squares(self, values: Mapping[str, float]) -> float:
        """Sum of the squared errors [N2], zeros of the records put aside."""
        errors = self.errors(values)
        return float(np.sum((errors - self.zeros(errors))[self.weight > 0] ** 2))

    def residual(self, values: Mapping[str, float]) -> Array:
        """Weighted errors (n,), white where every record has a zero of its own."""
        return self.white(self.errors(values) * self.weight)

    def white(self, weighted: Array) -> Array:
        """Weighted errors (n,) times the inverse root of their covariance, which a zero of its own adds to every record's.

        The means of records count less by that, without a parameter for each.
        """
        gone = 1.0 - 1.0 / np.sqrt(1.0 + self.drift**2 * self.power)
        found: Array = weighted - self.spread(gone * self.means(weighted)) * self.weight
        return found

    def means(self, weighted: Array) -> Array:
        """Mean error (r,) [N] of each record from weighted errors (n,)."""
        found: Array = np.add.reduceat(weighted * self.weight, self.starts[:-1]) / self.power
        return found

    def zeros(self, errors: Array) -> Array:
        """The expected zero [N] of each sample's record (n,) for errors (n,) [N] of a model.

        A larger one than such zeros are is the model's error, say a preload that is not known.
        """
        pull = self.drift**2 * self.power
        expected = pull / (1.0 + pull) * self.means(errors * self.weight)
        return self.spread(np.clip(expected, -USUAL * self.drift, USUAL * self.drift))

    def spread(self, one_each: Array) -> Array:
        """Values (r,) of the records for each of their samples (n,)."""
        return np.repeat(one_each, np.diff(self.starts))

    def shared(self, values: Mapping[str, float]) -> Array:
        """The same with the records balanced."""
        return self.residual(values) * self.share

    def residuals(self, many: Sequence[Mapping[str, float]]) -> list[Array]:
        """Balanced errors of several parameter sets, their simulations shared out to threads."""
        found: list[Array] = []
        for first in range(0, len(many), REMEMBERED):
            some = many[first : first + REMEMBERED]
            list(self.threads.map(self.simulated, {self.damping(values) for values in some}))
            found += [self.shared(values) for values in some]
        return found

    def costs(self, many: Sequence[Mapping[str, float]], zero: Free) -> list[float]:
        """Balanced sums of squares of several parameter sets, each with the zero of the load cell that suits it best."""
        w = self.white(self.weight) * self.share
        found = []
        for values, r in zip(many, self.residuals(many), strict=True):
            now = values.get(zero.name, zero.start)
            step = np.clip(-float(w @ r) / float(w @ w), min(0.0, zero.low - now), max(0.0, zero.high - now))
            found.append(float(np.sum((r + step * w) ** 2)))
        return found

    def balance(self, misfit: Array) -> None:
        """Let every record count alike in what follows: `misfit` (r,) is its mean squared weighted error.

        A record that no model explains, say at the edge between two states of filling, would else outweigh all others.
        """
        self.share = self.spread(1 / np.sqrt(np.maximum(1.0, misfit)))

    def misfits(self, residual: Array) -> Array:
        """Mean squared weighted error (r,) per case."""
        found: Array = np.add.reduceat(residual**2, self.starts[:-1]) / self.counts
        return found

    def fit(self, free: Sequence[Free], fixed: Mapping[str, float], iterations: int = ITERATIONS) -> Fit:
        """Least squares for the free parameters, from their starts."""
        free = tuple(free)
        start = np.array([f.start for f in free])
        width = np.array([f.width for f in free])
        low = np.array([f.low for f in free])

        def values(u: Array) -> dict[str, float]:
            return {**fixed, **{f.name: float(x) for f, x in zip(free, low + u * width, strict=True)}}

        u0 = np.clip((start - low) / width, 1e-9, 1 - 1e-9)
        scaled = np.array([1e-6 if f.name in MEASUREMENT else 1.0 for f in free])  # no pull on the measurement

        def errors(u: Array) -> Array:
            return np.concatenate([self.shared(values(u)), scaled * (u - u0) / PRIOR])

        def slopes(u: Array) -> Array:
            steps = np.where(u + STEP <= 1.0, STEP, -STEP)
            found = self.residuals([values(u), *(values(u + e) for e in np.diag(steps))])
            J = np.array([(other - found[0]) / step for other, step in zip(found[1:], steps, strict=True)]).T
            return np.vstack([J, np.diag(scaled / PRIOR)])

        if free:
            found = least_squares(
                errors, u0, jac=slopes, bounds=(0.0, 1.0), max_nfev=iterations, x_scale=1.0, ftol=ENOUGH, xtol=ENOUGH
            )
            u = found.x
            J = slopes(u)
            covariance = self.robust(J, errors(u)) * np.outer(width, width)
        else:
            u, covariance = u0, np.zeros((0, 0))
        best = values(u)
        return Fit(free, best, self.misfits(self.residual(best)), covariance)

    def robust(self, J: Array, errors: Array) -> Array:
        """Covariance (k, k) of the parameters from the scatter of the records' pulls (sandwich)."""
        k = J.shape[1]
        inverse = np.linalg.pinv(J.T @ J)
        middle = np.zeros((k, k))
        for a, b in itertools.pairwise(self.starts):
            g = J[a:b].T @ errors[a:b]
            middle += np.outer(g, g)
        at = self.starts[-1]
        records = max(2, len(self.cases))
        return np.asarray(inverse @ (middle * records / (records - 1) + J[at:].T @ J[at:]) @ inverse)
