"""The model against all records at once: residuals for any parameters of damper and measurement, and their least squares."""

from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.optimize import lsq_linear

from twintube.arrays import Array
from twintube.dampers import Damper
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.records.seen import ADDED, DELAY, MEASUREMENT, REMEMBERED, SeenRecords
from twintube.diagnosis.rules import RULES
from twintube.fitting.least_squares import bounded, derivatives, pulls, sandwich

TINY = 1e-300  # so that nothing can be divided by


@dataclass(frozen=True)
class Free:
    """A parameter that a fit may move."""

    name: str
    start: float
    low: float
    high: float
    neutral: float | None = None  # of a strength: where it does nothing

    @property
    def width(self) -> float:
        """Its range."""
        return self.high - self.low

    def size(self, value: float) -> float:
        """The scale on which a change of it matters: a strength's distance from doing nothing, else a part of its range."""
        if self.neutral is None:
            return self.width / 3.0
        apart = value - self.neutral
        return float(np.copysign(max(abs(apart), RULES.acts * self.width), apart))


@dataclass(frozen=True)
class Fit:
    """The optimum of a model."""

    free: tuple[Free, ...]
    values: dict[str, float]  # of all free parameters
    misfit: Array  # (r,) mean squared weighted error per record
    covariance: Array  # (k, k), robust against errors that the samples of a record share


class Beginnings(NamedTuple):
    """What the usual scatter of the records' beginnings changes."""

    change: Array  # (n,) [N]
    column: Array  # (n,) white and weighted
    size: Array  # (r,) its sum of squares


class Problem(SeenRecords):
    """All records laid end to end; `drift` [N] is how far the zero of the load cell differs from record to record.

    Unlike the objective of an identification it weights each interval by its noise and knows the measuring channels. Its
    error is finite where a simulation fails, as least squares needs.
    """

    def __init__(
        self,
        damper: Damper,
        records: Sequence[PreparedRecord],
        drift: float = 0.0,
        tolerance: float = 0.0,
        usual: Mapping[str, float] | None = None,
    ) -> None:
        super().__init__(damper, records, usual)
        self.drift, self.tolerance = drift, tolerance
        self.measured = np.concatenate([r.force for r in records])
        model = max(RULES.model_error, tolerance)
        self.sigma = np.concatenate([np.sqrt(r.noise**2 + r.edges**2 + (model * r.peak) ** 2) for r in records])
        self.weight = np.where(self.used, 1 / self.sigma, 0.0)
        self.power = np.add.reduceat(self.weight**2, self.starts[:-1])  # (r,) [1/N2], of a record's zero
        self.share: Array = np.ones(len(self.z))
        self.counts = np.add.reduceat(self.used.astype(np.int64), self.starts[:-1])
        # Records, or their parts where every second is held out: what is resampled and must improve.
        numbers = np.concatenate([i * RULES.parts + r.part for i, r in enumerate(records)])[self.used]
        self.unit = np.unique(numbers, return_inverse=True)[1]
        self.unit_counts = np.bincount(self.unit)

    def with_records(self, records: Sequence[PreparedRecord]) -> "Problem":
        """The damper with other records."""
        return Problem(self.given, records, self.drift, self.tolerance, self.usual)

    def with_drift(self, drift: float) -> "Problem":
        """The problem with a zero of the load cell that differs from record to record by `drift` [N]."""
        return Problem(self.given, self.records, drift, self.tolerance, self.usual)

    def with_usual(self, usual: Mapping[str, float]) -> "Problem":
        """The problem with values of the measurement where no others are given."""
        return Problem(self.given, self.records, self.drift, self.tolerance, usual)

    def sparse(self, most: int, misfit: Array) -> "Problem":
        """The problem with so many of its records, as balanced as this: the worst, others of all states and velocities.

        `misfit` (r,) is their mean squared weighted error. What acts in few records would not show in others.
        """
        order = sorted(range(len(self.records)), key=lambda i: (*self.states[i].tolist(), self.records[i].top_speed))
        if len(order) <= most:
            return self
        worst = [i for i in np.argsort(-misfit).tolist() if misfit[i] > RULES.odd_right][: most // 2]
        rest = [i for i in order if i not in worst]
        spread = np.unique(np.linspace(0, len(rest) - 1, most - len(worst)).round().astype(int))
        kept = [i for i in order if i in worst or i in [rest[k] for k in spread]]
        other = self.with_records([self.records[i] for i in kept])
        other.share = np.concatenate([self.share[self.starts[i] : self.starts[i + 1]] for i in kept])
        other.parts = RULES.steps_sketched
        return other

    def balanced(self, misfit: Array) -> "Problem":
        """A problem in which all records have equal weight; `misfit` (r,) is their mean squared weighted error.

        A record that no model explains, say at the edge between two states of filling, would otherwise outweigh all others.
        """
        other = copy(self)
        other.share = self.spread(1 / np.sqrt(np.maximum(1.0, misfit)))
        return other

    def errors(self, values: Mapping[str, float]) -> Array:
        """Simulated less measured force (n,) [N]."""
        return np.asarray(self.forces(values) - self.measured)

    def residual(self, values: Mapping[str, float], near: Mapping[str, float] | None = None) -> Array:
        """Weighted errors (n,), white where every record has a zero and a beginning of its own.

        What another beginning changes is taken from the values `near` these, where given.
        """
        weighted = self.white(self.errors(values) * self.weight)
        begun = self.open_beginnings(near or values)
        if begun is None:
            return weighted
        along = np.add.reduceat(begun.column * weighted, self.starts[:-1]) / np.maximum(begun.size, TINY)
        return np.asarray(weighted - self.spread((1.0 - 1.0 / np.sqrt(1.0 + begun.size)) * along) * begun.column)

    def open_beginnings(self, values: Mapping[str, float]) -> Beginnings | None:
        """What other beginnings of the records change; None where none is open."""
        change = self.beginnings(values)
        if change is None:
            return None
        column = self.white(change * self.weight)
        return Beginnings(change, column, np.add.reduceat(column**2, self.starts[:-1]))

    def begun_forces(self, values: Mapping[str, float]) -> Array:
        """Predicted forces (n,) [N] with the beginning that is to be expected of each record by its own errors."""
        forces, begun = self.forces(values), self.open_beginnings(values)
        if begun is None:
            return forces
        pull = np.add.reduceat(begun.column * self.white((forces - self.measured) * self.weight), self.starts[:-1])
        return np.asarray(forces - self.spread(pull / (1.0 + begun.size)) * begun.change)

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

        What is larger, and more than a good load cell has, is the model's error, say a preload that is not known.
        """
        pull = self.drift**2 * self.power
        expected = pull / (1.0 + pull) * self.means(errors * self.weight)
        good = RULES.small_zero * max(record.peak for record in self.records)
        most = max(RULES.usual_zeros * self.drift, good)
        return self.spread(np.clip(expected, -most, most))

    def adjusted(self, values: Mapping[str, float], free: Sequence[Free]) -> dict[str, float]:
        """The values with those of `free`, in which forces are linear, as they suit most of these records best.

        They are of the measurement, not of the damper: what a cause explains shows beside them.
        """
        if not free:
            return dict(values)
        values = {f.name: f.start for f in free} | dict(values)
        errors = self.residual(values)
        share = self.spread(1.0 / np.sqrt(np.maximum(1.0, self.misfits(errors))))
        rows = self.columns(values, free) * share[:, None]
        now = np.array([values[f.name] for f in free])
        low, high = (np.array([getattr(f, name) for f in free]) for name in ("low", "high"))
        more = lsq_linear(rows, -errors * share, (np.minimum(low - now, -1e-12), np.maximum(high - now, 1e-12))).x
        return values | {f.name: float(x) for f, x in zip(free, now + more, strict=True)}

    def columns(self, values: Mapping[str, float], free: Sequence[Free]) -> Array:
        """Slopes (n, k) of the weighted errors in parameters of the measurement, in which forces are linear, or late."""
        force, point = self.simulated(self.damping(values))
        gain = values.get("force_gain", 1.0)
        parts: dict[str, Array] = {"force_offset": np.ones(len(point))}
        parts |= {name: gain * part for name, part in self.parts_of_samples(force, point).items()}
        for f in free:
            if f.name == DELAY:
                now, step = values.get(DELAY, self.usual.get(DELAY, 0.0)), RULES.delay_step * f.width
                early, late = (self.forces({**values, DELAY: now + by}) for by in (-step, step))
                parts[DELAY] = (late - early) / (2.0 * step)
        return np.column_stack([self.white(parts[f.name] * self.weight) for f in free])

    def spread(self, values: Array) -> Array:
        """A value (r,) of each record for all of its samples (n,)."""
        return np.repeat(values, np.diff(self.starts))

    def shared(self, values: Mapping[str, float], near: Mapping[str, float] | None = None) -> Array:
        """Weighted errors (n,) with the records balanced; `near` as in `residual`."""
        return self.residual(values, near) * self.share

    def residuals(self, many: Sequence[Mapping[str, float]], near: Mapping[str, float] | None = None) -> list[Array]:
        """Balanced errors of several parameter sets, their simulations shared out to threads; `near` as in `residual`."""
        errors: list[Array] = []
        for first in range(0, len(many), REMEMBERED // 2):
            some = many[first : first + REMEMBERED // 2]
            others = [self.begun(values) for values in some] if near is None else []
            wanted = [*some, *(values for values in others if values is not None)]
            list(self.threads.map(self.simulated, {self.damping(values) for values in wanted}))
            errors += [self.shared(values, near) for values in some]
        return errors

    def costs(self, many: Sequence[Mapping[str, float]], now: Mapping[str, float], free: Sequence[Free]) -> list[float]:
        """Balanced sums of squares of several parameter sets, each with the values of `free` that suit it best.

        These are of the measurement. They move from `now` by their slopes, with half their ranges as standard deviations.
        """
        A = self.columns(now, free) * self.share[:, None]
        half = np.array([f.width / 2.0 for f in free])
        inverse = np.linalg.inv(A.T @ A + np.diag(half**-2.0))
        pulls = [(r, A.T @ r) for r in self.residuals(many)]
        return [float(r @ r - pull @ inverse @ pull) for r, pull in pulls]

    def misfits(self, residual: Array) -> Array:
        """Mean squared weighted error (r,) per record."""
        return np.asarray(np.add.reduceat(residual**2, self.starts[:-1]) / self.counts)

    def unit_misfits(self, values: Mapping[str, float]) -> Array:
        """The like (u,) per unit; that each record may have a beginning of its own has its price in the likelihood."""
        begun = self.open_beginnings(values)
        price = np.zeros(len(self.records)) if begun is None else np.log1p(begun.size)
        squares = self.residual(values) ** 2 + self.spread(price / np.maximum(self.counts, 1))
        return np.asarray(np.bincount(self.unit, squares[self.used]) / self.unit_counts)

    def fit(self, free: Sequence[Free], *, thorough: bool = True) -> Fit:
        """Least squares for the free parameters, from their starts; `thorough` seeks a better optimum where forces step."""
        free = tuple(free)
        start, width, low = (np.array([getattr(f, name) for f in free]) for name in ("start", "width", "low"))

        def values(u: Array) -> dict[str, float]:
            return {f.name: float(x) for f, x in zip(free, low + u * width, strict=True)}

        u0 = np.clip((start - low) / width, RULES.inside, 1 - RULES.inside)
        held = np.array([RULES.free_pull if f.name in MEASUREMENT else 1.0 for f in free])

        def errors(u: Array) -> Array:
            return np.concatenate([self.shared(values(u)), held * (u - u0) / RULES.pull])

        def slopes(u: Array) -> Array:
            here = values(u)
            J = derivatives(lambda U: self.residuals([values(row) for row in U], here), u, np.zeros(len(u)), np.ones(len(u)))
            return np.vstack([J, np.diag(held / RULES.pull)])

        if free:
            u, cost = bounded(errors, slopes, u0, RULES.evaluations, RULES.fit_ends)
            better, less = self.polished(free, values, u, cost) if thorough else (u, cost)
            if less < cost * (1.0 - RULES.fit_ends):
                u, _ = bounded(errors, slopes, better, RULES.evaluations, RULES.fit_ends)
            covariance = self.robust(slopes(u), errors(u)) * np.outer(width, width)
        else:
            u, covariance = u0, np.zeros((0, 0))
        best = values(u)
        return Fit(free, best, self.misfits(self.residual(best)), covariance)

    def polished(
        self, free: Sequence[Free], values: Callable[[Array], dict[str, float]], u: Array, cost: float
    ) -> tuple[Array, float]:
        """A better point (k,) near `u`, and its cost: where forces step, derivatives do not show the way.

        Parameter after parameter is moved to both sides, near and far (compass search: Kolda et al. 2003).
        """
        moved = [i for i, f in enumerate(free) if f.name not in ADDED and (f.name != DELAY or f.neutral is not None)]
        for _ in range(RULES.moves if moved else 0):
            here = values(u)
            points = []
            for i in moved:
                step = free[i].size(here[free[i].name]) / free[i].width * np.eye(len(free))[i]
                points += [u + (factor - 1.0) * step for factor in RULES.factors_tried]
            several = np.clip(points, RULES.inside, 1 - RULES.inside)
            costs = [float(np.sum(r**2)) for r in self.residuals([values(row) for row in several], here)]
            if min(costs) >= cost * (1.0 - RULES.fit_ends):
                break
            u, cost = several[int(np.argmin(costs))], min(costs)
        return u, cost

    def robust(self, J: Array, errors: Array) -> Array:
        """Covariance (k, k) of the parameters from the scatter of the records' pulls, and of the pull to the starts."""
        # At the optimum of a least squares the pulls sum to zero, so that their mean needs no removing.
        middle = sum((np.outer(g, g) for g in pulls(J, errors, self.starts)), np.zeros((J.shape[1], J.shape[1])))
        to_starts = J[self.starts[-1] :]
        records = max(2, len(self.records))
        inverse = np.linalg.pinv(J.T @ J)
        scattered = sandwich(inverse, middle * records / (records - 1) + to_starts.T @ to_starts)
        # Few records scatter little by chance: an interval is never narrower than noise alone makes it.
        least, own = np.diag(inverse), np.diag(scattered)
        wider = np.sqrt(np.maximum(1.0, least / np.maximum(own, 1e-300)))
        return np.asarray(scattered * np.outer(wider, wider))
