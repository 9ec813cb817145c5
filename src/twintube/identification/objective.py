"""How far a parameter set is from the records: equations 42 and 43, for a whole swarm at once."""

import hashlib
from collections.abc import Sequence
from copy import copy
from typing import Any

import numpy as np

from twintube.common.arrays import Array
from twintube.core.checks import tube_limit
from twintube.dampers import Damper
from twintube.engine.simulate import InputError, checked
from twintube.fitting.harmonic import Harmonic
from twintube.fitting.intervals import means
from twintube.fitting.parameters import ranges
from twintube.fitting.simulation import SimulatedRecords

# Samples per oscillation that the records are thinned to in a search; tests/identification shows that more do not change it.
SAMPLES = 64
FINE = 256  # for the last least squares, whose result 64 would move by more than the noise does
PARTS = 1  # steps of the model per interval, as the paper's equations without effects need


class Objective(SimulatedRecords):
    """Equations 42 and 43 over records, for parameters called by their names in the table.

    A call with X (m, k) returns (m,): RMSE of the force [N], plus RMSE of the works per oscillation [J] `with_work`.
    Swarms are shared out to threads. A parameter set that cannot be simulated has an infinite error. Raises InputError
    without records, or where a stroke leaves the tube.
    """

    def __init__(
        self, base: Damper, names: Sequence[str], records: Sequence[Harmonic], *, with_work: bool, samples: int = SAMPLES
    ) -> None:
        if not records:
            raise InputError("no records to identify from")
        self.names, self.with_work = tuple(names), with_work
        thin = self.records = [record.thinned(samples) for record in records]
        self.bounds = ranges(names, max(record.top_speed for record in records))
        limit = tube_limit(base.parameters)
        for record in thin:
            checked(record.stroke, record.velocity, limit)
        super().__init__(base, thin, parts=PARTS, failed=np.inf)
        self.marks = [r.marks + a for r, a in zip(thin, self.starts[:-1], strict=True)]
        self.force = np.concatenate([r.force for r in thin])
        self.work = [r.works() for r in records]
        # Where the compared intervals of each record begin among all of them: what is before the first mark is not compared.
        self.edges = np.cumsum([0, *(len(r.time) - 1 - r.marks[0] for r in thin)])
        self.counted = int(self.edges[-1])

    def __call__(self, X: Array) -> Array:
        """Errors (m,) of the parameter sets X (m, k)."""
        total = self.sums(X).sum(axis=1)
        error: Array = np.sqrt(total[:, 0] / self.counted)
        if self.with_work:
            error += np.sqrt(total[:, 1] / sum(len(work) for work in self.work))
        return error

    def sums(self, X: Array) -> Array:
        """Sums of squared errors (m, r, 2) of the parameter sets X (m, k) per record: force [N2], works [J2]."""
        return np.array([[(e @ e, w @ w) for e, w in records] for records in self._all(X)])

    def residuals(self, X: Array) -> Array:
        """Errors of the force (m, n) [N] of the parameter sets X (m, k): all intervals of all measured oscillations."""
        return self.misfits(X)[0]

    def misfits(self, X: Array) -> list[Array]:
        """The errors whose root mean squares the objective adds: of the force (m, n) [N], and of the works (m, c) [J]."""
        every = self._all(X)
        return [
            np.array([np.concatenate([errors[part] for errors in records]) for records in every])
            for part in range(1 + self.with_work)
        ]

    def damper_at(self, x: Array) -> Damper:
        """The given damper with the parameters x (k,)."""
        return self.given.with_(**{name: float(value) for name, value in zip(self.names, x, strict=True)})

    def corrected(self, finer: "Objective", x: Array) -> "Objective":
        """A copy without its sampling error at x (k,), which an objective of denser samples shows."""
        other = copy(self)
        other.force = self.force + self.forces(x) - self.averaged(finer, finer.forces(x))
        return other

    def averaged(self, finer: "Objective", force: Array) -> Array:
        """Mean forces (n,) over this objective's intervals from those over the intervals of the finer objective."""
        coarse = np.empty(len(self.force))
        for a, b, c, d in zip(self.starts[:-1], self.starts[1:], finer.starts[:-1], finer.starts[1:], strict=True):
            time = finer.t[c:d]
            integral = np.concatenate([[0.0], np.cumsum(force[c + 1 : d] * np.diff(time))])
            coarse[a] = force[c]
            coarse[a + 1 : b] = means(self.t[a:b], np.interp(self.t[a:b], time, integral))
        return coarse

    def forces(self, x: Array) -> Array:
        """Simulated mean forces (n,) [N] over all intervals."""
        return self.run(self.rows(), self._named(x))[0]

    @property
    def digest(self) -> str:
        """What the values depend on, but for the program: damper, parameters, ranges and records."""
        text = repr((self.given.parameters, self.names, self.with_work, self.bounds.tolist()))
        data = (self.states, self.t, self.z, self.v, self.force, self.starts, *self.marks, *self.work)
        return hashlib.sha256(text.encode() + b"".join(np.ascontiguousarray(x).tobytes() for x in data)).hexdigest()[:16]

    def _named(self, x: Array) -> list[tuple[str, Any]]:
        return list(zip(self.names, x, strict=True))

    def _all(self, X: Array) -> list[list[tuple[Array, Array]]]:
        parts = np.array_split(np.asarray(X, dtype=float), self.workers)
        return [errors for part in self.threads.map(self._part, parts) for errors in part]

    def _part(self, X: Array) -> list[list[tuple[Array, Array]]]:
        """Per parameter set and record the errors of the force over the measured oscillations and of their works."""
        rows = self.rows()
        errors = []
        for x in X:
            force, work = self.run(rows, self._named(x))
            error = force - self.force
            errors.append(
                [
                    (error[marks[0] + 1 : end], np.diff(work[marks]) - measured)
                    for marks, measured, end in zip(self.marks, self.work, self.starts[1:], strict=True)
                ]
            )
        return errors
