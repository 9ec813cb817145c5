"""The model against all records at once: its errors for any parameters of damper and measurement, by their uncertainty."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import lsq_linear

from twintube.common.arrays import Array
from twintube.dampers import Damper
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.records.seen import SeenRecords
from twintube.diagnosis.rules import RULES


@dataclass(frozen=True)
class Free:
    """A parameter that a fit may move."""

    name: str
    start: float
    low: float
    high: float


class Problem(SeenRecords):
    """All records laid end to end; `drift` [N] is how far the zero of the load cell differs from record to record.

    Unlike the objective of an identification it weights each interval by its noise and knows the measuring channels. Its
    error is finite where a simulation fails, as least squares needs.
    """

    def __init__(
        self, damper: Damper, records: Sequence[PreparedRecord], drift: float = 0.0, usual: Mapping[str, float] | None = None
    ) -> None:
        super().__init__(damper, records, usual)
        self.drift = drift
        self.measured = np.concatenate([r.force for r in records])
        self.sigma = np.concatenate([np.sqrt(r.noise**2 + r.edges**2 + (RULES.model_error * r.peak) ** 2) for r in records])
        self.weight = np.where(self.used, 1 / self.sigma, 0.0)
        self.power = np.add.reduceat(self.weight**2, self.starts[:-1])  # (r,) [1/N2], of a record's zero
        self.counts = np.add.reduceat(self.used.astype(np.int64), self.starts[:-1])

    def with_records(self, records: Sequence[PreparedRecord]) -> "Problem":
        """The damper with other records."""
        return Problem(self.given, records, self.drift, self.usual)

    def with_drift(self, drift: float) -> "Problem":
        """The problem with a zero of the load cell that differs from record to record by `drift` [N]."""
        return Problem(self.given, self.records, drift, self.usual)

    def with_usual(self, usual: Mapping[str, float]) -> "Problem":
        """The problem with values of the measurement where no others are given."""
        return Problem(self.given, self.records, self.drift, usual)

    def errors(self, values: Mapping[str, float]) -> Array:
        """Simulated less measured force (n,) [N]."""
        return np.asarray(self.forces(values) - self.measured)

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
        values = {f.name: f.start for f in free} | dict(values)
        errors = self.residual(values)
        share = self.spread(1.0 / np.sqrt(np.maximum(1.0, self.misfits(errors))))  # a record that no model explains
        rows = self.columns(values, free) * share[:, None]
        now = np.array([values[f.name] for f in free])
        low, high = (np.array([getattr(f, name) for f in free]) for name in ("low", "high"))
        more = lsq_linear(rows, -errors * share, (np.minimum(low - now, -1e-12), np.maximum(high - now, 1e-12))).x
        return values | {f.name: float(x) for f, x in zip(free, now + more, strict=True)}

    def columns(self, values: Mapping[str, float], free: Sequence[Free]) -> Array:
        """Slopes (n, k) of the weighted errors in parameters of the measurement, in which forces are linear."""
        force, point = self.simulated(self.damping(values))
        gain = values.get("force_gain", 1.0)
        parts: dict[str, Array] = {"force_offset": np.ones(len(point))}
        parts |= {name: gain * part for name, part in self.parts_of_samples(force, point).items()}
        return np.column_stack([self.white(parts[f.name] * self.weight) for f in free])

    def spread(self, values: Array) -> Array:
        """A value (r,) of each record for all of its samples (n,)."""
        return np.repeat(values, np.diff(self.starts))

    def misfits(self, residual: Array) -> Array:
        """Mean squared weighted error (r,) per record."""
        return np.asarray(np.add.reduceat(residual**2, self.starts[:-1]) / self.counts)
