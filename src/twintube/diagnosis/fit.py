"""The model against all records at once: residuals for any parameters of damper and measurement, and their least squares."""

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass, fields
from functools import lru_cache

import numpy as np

from twintube.arrays import Array
from twintube.core import effects
from twintube.dampers import Damper
from twintube.diagnosis.prepare import PreparedRecord
from twintube.diagnosis.rules import RULES
from twintube.fitting.averaging import averaged_means
from twintube.fitting.least_squares import bounded, derivatives, pulls, sandwich
from twintube.fitting.simulation import SimulatedRecords

# What the measurement adds to the damper.
MEASUREMENT = ("force_offset", "force_gain", "channel_delay")
REMEMBERED = 32  # latest simulations


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
    """The optimum of a model."""

    free: tuple[Free, ...]
    values: dict[str, float]  # of all free parameters
    misfit: Array  # (r,) mean squared weighted error per record
    covariance: Array  # (k, k), robust against errors that the samples of a record share


class Problem(SimulatedRecords):
    """All records laid end to end; `drift` [N] is how far the zero of the load cell differs from record to record.

    Unlike the objective of an identification it weights each interval by its noise and knows the measuring channels. Its
    error is finite where a simulation fails, as least squares needs.
    """

    def __init__(self, damper: Damper, records: Sequence[PreparedRecord], drift: float = 0.0) -> None:
        super().__init__(damper, records, parts=RULES.steps_per_interval, failed=RULES.failed_force)
        self.records = list(records)
        self.drift = drift
        self.measured = np.concatenate([r.measured() for r in records])
        self.sigma = np.concatenate([np.hypot(r.noise, RULES.model_error * r.peak) for r in records])
        # The first sample of a record has no interval before it, that of a stretch has mostly rest before it.
        stretch = np.concatenate([r.stretch for r in records])
        used = np.diff(stretch, prepend=-1) == 0
        used[self.starts[:-1]] = False
        self.weight = np.where(used, 1 / self.sigma, 0.0)
        self.power = np.add.reduceat(self.weight**2, self.starts[:-1])  # (r,) [1/N2], of a record's zero
        self.share: Array = np.ones(len(self.z))
        self.counts = np.add.reduceat(used.astype(np.int64), self.starts[:-1])
        self.known = {item.name for item in fields(effects.Parameters)}
        # The measurement's parameters need no simulation of their own.
        self.simulated = lru_cache(REMEMBERED)(self.simulate)

    def with_records(self, records: Sequence[PreparedRecord]) -> "Problem":
        """The damper with other records."""
        return Problem(self.given, records, self.drift)

    def with_drift(self, drift: float) -> "Problem":
        """The problem with a zero of the load cell that differs from record to record by `drift` [N]."""
        return Problem(self.given, self.records, drift)

    def balanced(self, misfit: Array) -> "Problem":
        """A problem in which all records have equal weight; `misfit` (r,) is their mean squared weighted error.

        A record that no model explains, say at the edge between two states of filling, would otherwise outweigh all others.
        """
        other = copy(self)
        other.share = self.spread(1 / np.sqrt(np.maximum(1.0, misfit)))
        return other

    def damping(self, values: Mapping[str, float]) -> tuple[tuple[str, float], ...]:
        """The damper's parameters among the values."""
        return tuple(sorted((name, value) for name, value in values.items() if name in self.known))

    def simulate(self, changes: Sequence[tuple[str, float]]) -> Array:
        """Mean forces (n,) [N] of the damper with parameters changed."""
        force, _ = self.run(self.rows(), changes)
        for record, a, b in zip(self.records, self.starts[:-1], self.starts[1:], strict=True):
            force[a:b] = averaged_means(record.time, force[a:b], record.averaged)
        return force

    def forces(self, values: Mapping[str, float]) -> Array:
        """Predicted mean forces (n,) [N], measurement included."""
        force: Array = self.simulated(self.damping(values))
        return np.asarray(values.get("force_gain", 1.0) * force + values.get("force_offset", 0.0))

    def target(self, values: Mapping[str, float]) -> Array:
        """Measured mean forces (n,) [N], read later by the delay of the force channel."""
        delay = values.get("channel_delay", 0.0)
        return np.concatenate([r.measured(delay) for r in self.records]) if delay else self.measured

    def errors(self, values: Mapping[str, float]) -> Array:
        """Simulated less measured force (n,) [N]."""
        return self.forces(values) - self.target(values)

    def squares(self, values: Mapping[str, float]) -> float:
        """Sum of the squared errors [N2], without the zeros of the records."""
        errors = self.errors(values)
        return float(np.sum((errors - self.zeros(errors))[self.weight > 0] ** 2))

    def residual(self, values: Mapping[str, float]) -> Array:
        """Weighted errors (n,), white where every record has a zero of its own."""
        return self.white(self.errors(values) * self.weight)

    def white(self, weighted: Array) -> Array:
        """Weighted errors (n,) times the inverse root of their covariance, to which each record's zero contributes.

        The means of records count less by that, without a parameter for each.
        """
        removed = 1.0 - 1.0 / np.sqrt(1.0 + self.drift**2 * self.power)
        return np.asarray(weighted - self.spread(removed * self.means(weighted)) * self.weight)

    def means(self, weighted: Array) -> Array:
        """Mean error (r,) [N] of each record from weighted errors (n,)."""
        return np.asarray(np.add.reduceat(weighted * self.weight, self.starts[:-1]) / self.power)

    def zeros(self, errors: Array) -> Array:
        """The expected zero [N] of each sample's record (n,) for errors (n,) [N] of a model.

        A value larger than such zeros is the model's error, say a preload that is not known.
        """
        pull = self.drift**2 * self.power
        expected = pull / (1.0 + pull) * self.means(errors * self.weight)
        most = RULES.usual_zeros * self.drift
        return self.spread(np.clip(expected, -most, most))

    def spread(self, values: Array) -> Array:
        """A value (r,) of each record for all of its samples (n,)."""
        return np.repeat(values, np.diff(self.starts))

    def shared(self, values: Mapping[str, float]) -> Array:
        """Weighted errors (n,) with the records balanced."""
        return self.residual(values) * self.share

    def residuals(self, many: Sequence[Mapping[str, float]]) -> list[Array]:
        """Balanced errors of several parameter sets, their simulations shared out to threads."""
        errors: list[Array] = []
        for first in range(0, len(many), REMEMBERED):
            some = many[first : first + REMEMBERED]
            list(self.threads.map(self.simulated, {self.damping(values) for values in some}))
            errors += [self.shared(values) for values in some]
        return errors

    def costs(self, many: Sequence[Mapping[str, float]], zero: Free) -> list[float]:
        """Balanced sums of squares of several parameter sets, each with the zero of the load cell that suits it best."""
        w = self.white(self.weight) * self.share
        sums = []
        for values, r in zip(many, self.residuals(many), strict=True):
            now = values.get(zero.name, zero.start)
            step = np.clip(-float(w @ r) / float(w @ w), min(0.0, zero.low - now), max(0.0, zero.high - now))
            sums.append(float(np.sum((r + step * w) ** 2)))
        return sums

    def misfits(self, residual: Array) -> Array:
        """Mean squared weighted error (r,) per record."""
        return np.asarray(np.add.reduceat(residual**2, self.starts[:-1]) / self.counts)

    def fit(self, free: Sequence[Free]) -> Fit:
        """Least squares for the free parameters, from their starts."""
        free = tuple(free)
        start, width, low = (np.array([getattr(f, name) for f in free]) for name in ("start", "width", "low"))

        def values(u: Array) -> dict[str, float]:
            return {f.name: float(x) for f, x in zip(free, low + u * width, strict=True)}

        u0 = np.clip((start - low) / width, RULES.inside, 1 - RULES.inside)
        held = np.array([RULES.free_pull if f.name in MEASUREMENT else 1.0 for f in free])

        def errors(u: Array) -> Array:
            return np.concatenate([self.shared(values(u)), held * (u - u0) / RULES.pull])

        def slopes(u: Array) -> Array:
            J = derivatives(lambda U: self.residuals([values(row) for row in U]), u, np.zeros(len(u)), np.ones(len(u)))
            return np.vstack([J, np.diag(held / RULES.pull)])

        if free:
            u, _ = bounded(errors, slopes, u0, RULES.evaluations, RULES.fit_ends)
            covariance = self.robust(slopes(u), errors(u)) * np.outer(width, width)
        else:
            u, covariance = u0, np.zeros((0, 0))
        best = values(u)
        return Fit(free, best, self.misfits(self.residual(best)), covariance)

    def robust(self, J: Array, errors: Array) -> Array:
        """Covariance (k, k) of the parameters from the scatter of the records' pulls, and of the pull to the starts."""
        # At the optimum of a least squares the pulls sum to zero, so that their mean needs no removing.
        middle = sum((np.outer(g, g) for g in pulls(J, errors, self.starts)), np.zeros((J.shape[1], J.shape[1])))
        to_starts = J[self.starts[-1] :]
        records = max(2, len(self.records))
        return sandwich(np.linalg.pinv(J.T @ J), middle * records / (records - 1) + to_starts.T @ to_starts)
