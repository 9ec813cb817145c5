"""How far a parameter set is from the records: equations 42 and 43, for a whole swarm at once."""

import hashlib
import itertools
import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from copy import copy
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid

from twintube.arrays import Array
from twintube.core import effects
from twintube.core.checks import tube_limit
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import Damper
from twintube.engine import compiled
from twintube.engine.simulate import InputError, checked

# Samples per oscillation that the records are thinned to in a search; tests/identify shows that more do not change it.
SAMPLES = 64
FINE = 256  # for the last least squares, whose result 64 would move by more than the noise does
FASTER = 1.2
MARGIN = 1.02  # of the threshold of foam
TABLE_6 = ("X_Re", "L_PV", "G_PV", "X_Co1", "X_Co2")
TABLES_7_8 = ("S_BV", "S_BVoil", "S_PV", "S_PVoil", "B", "E", "v_cav", "Y_Co_cav", "Y_Re_cav")


@dataclass(frozen=True)
class Harmonic:
    """A harmonic record: arrays (n,) in SI units, `marks` (c + 1,) where its oscillations begin and end."""

    oil_level: float
    gas_preload: int
    time: Array
    stroke: Array
    velocity: Array
    force: Array
    marks: NDArray[np.int64]
    name: str = ""
    averaged: float = 0.0  # [s] of the moving mean that the force channel went through, see averaging.py

    @property
    def top_speed(self) -> float:
        """Largest speed of a sine with the measured amplitude and frequency [m/s]: free of the noise of a velocity."""
        first, last = int(self.marks[0]), int(self.marks[-1])
        turns = 2 * np.pi * (len(self.marks) - 1) / (self.time[last] - self.time[first])
        return float(turns * np.ptp(self.stroke[first:last]) / 2)

    def thinned(self, samples: int) -> "Harmonic":
        """The record with about `samples` per oscillation, before the first mark as densely as in an oscillation.

        Its force is the mean since the sample before: where the force jumps, a sample alone would say on which side of the
        jump it happens to lie, and no objective made from such samples is smooth.
        """
        pieces, marks = [], [0]
        edges = [0, *self.marks.tolist()] if self.marks[0] > 0 else self.marks.tolist()
        for a, b in itertools.pairwise(edges):
            lead = a == 0 and self.marks[0] > 0
            count = min(b - a, 6 * samples if lead else samples)
            pieces.append(np.unique(np.linspace(a, b, count + 1).round().astype(np.int64))[:-1])
            marks.append(marks[-1] + len(pieces[-1]))
        pieces.append(np.array([edges[-1]]))
        kept = np.concatenate(pieces)
        new_marks = marks[1:] if self.marks[0] > 0 else marks
        time, stroke, velocity = (x[kept] for x in (self.time, self.stroke, self.velocity))
        impulse = np.concatenate([[0.0], cumulative_trapezoid(self.force, self.time)])[kept]
        force = np.concatenate([self.force[kept[:1]], np.diff(impulse) / np.diff(time)])
        return replace(self, time=time, stroke=stroke, velocity=velocity, force=force, marks=np.array(new_marks))

    def works(self) -> Array:
        """Measured work [J] of each oscillation: the area of the loop."""
        slices = [slice(a, b + 1) for a, b in zip(self.marks[:-1], self.marks[1:], strict=True)]
        return np.array([np.trapezoid(self.force[s], self.stroke[s]) for s in slices])


def tolerant(damper: Damper) -> Damper:
    """The damper for measured velocities: the rig's slow block moves at the threshold of foam, and they scatter about it."""
    return damper.with_(v_foam=MARGIN * damper.parameters.v_foam)


class Objective:
    """Equations 42 and 43 over records, for parameters called by their names in the table.

    A call with X (m, k) returns (m,): RMSE of the force [N], plus RMSE of the works per oscillation [J] `with_work`.
    Swarms are shared out to threads; numba releases the interpreter's lock.
    """

    def __init__(
        self, base: Damper, names: Sequence[str], records: Sequence[Harmonic], *, with_work: bool, samples: int = SAMPLES
    ) -> None:
        if not records:
            raise InputError("no records to identify from")
        self.base, self.names, self.with_work = base, tuple(names), with_work
        self.measured_at = tolerant(base)
        table = {item.name: item.metadata for item in fields(effects.Parameters)}
        thin = self.records = [record.thinned(samples) for record in records]
        # A cavitation threshold above every measured velocity is the same as none.
        upper = {"v_cav": FASTER * max(record.top_speed for record in records)}
        limits = [(table[n]["lower"], min(table[n]["upper"], upper.get(n, np.inf))) for n in names]
        self.bounds = np.array(limits, dtype=float)
        limit = tube_limit(base.parameters)
        for record in thin:
            checked(record.stroke, record.velocity, limit)
        self.starts = np.concatenate([[0], np.cumsum([len(r.time) for r in thin])]).astype(np.int64)
        self.marks = [r.marks + a for r, a in zip(thin, self.starts[:-1], strict=True)]
        self.states = np.array([[r.oil_level, r.gas_preload] for r in thin], dtype=float)
        columns = ("time", "stroke", "velocity", "force")
        self.t, self.z, self.v, self.force = (np.concatenate([getattr(r, n) for r in thin]) for n in columns)
        self.work = [r.works() for r in records]
        self.counted = sum(len(r.time) - 1 - r.marks[0] for r in thin)
        self.threads = ThreadPoolExecutor(os.cpu_count())

    def __call__(self, X: Array) -> Array:
        """Errors (m,) of the parameter sets X (m, k)."""
        total = self.sums(X).sum(axis=1)
        error: Array = np.sqrt(total[:, 0] / self.counted)
        if self.with_work:
            error += np.sqrt(total[:, 1] / sum(len(work) for work in self.work))
        return error

    def sums(self, X: Array) -> Array:
        """Sums of squared errors (m, r, 2) of the parameter sets X (m, k) per record: force [N2], works [J2]."""
        return np.array([[(e @ e, w @ w) for e, w in found] for found in self._all(X)])

    def residuals(self, X: Array) -> Array:
        """Errors of the force (m, n) [N] of the parameter sets X (m, k): all intervals of all measured oscillations."""
        return np.array([np.concatenate([e for e, _ in found]) for found in self._all(X)])

    def damper(self, x: Array) -> Damper:
        """The base damper with the parameters x (k,)."""
        return self.base.with_(**{name: float(value) for name, value in zip(self.names, x, strict=True)})

    def corrected(self, finer: "Objective", x: Array) -> "Objective":
        """The same with its sampling error at x (k,), told by an objective of denser samples, taken out."""
        other = copy(self)
        other.force = self.force + self.forces(x) - self.averaged(finer, finer.forces(x))
        return other

    def averaged(self, finer: "Objective", force: Array) -> Array:
        """Mean forces (n,) over this objective's intervals from those over the finer one's."""
        found = np.empty(len(self.force))
        for a, b, c, d in zip(self.starts[:-1], self.starts[1:], finer.starts[:-1], finer.starts[1:], strict=True):
            time = finer.t[c:d]
            impulse = np.concatenate([[0.0], np.cumsum(force[c + 1 : d] * np.diff(time))])
            found[a] = force[c]
            found[a + 1 : b] = np.diff(np.interp(self.t[a:b], time, impulse)) / np.diff(self.t[a:b])
        return found

    def forces(self, x: Array) -> Array:
        """Simulated mean forces (n,) [N] over all intervals."""
        return self._run(self._rows(), x)[0]

    @property
    def digest(self) -> str:
        """What the values depend on, so that a journal of other records or bounds is not taken for this one's."""
        text = repr((self.base.parameters, self.names, self.with_work, self.bounds.tolist()))
        data = (self.states, self.t, self.z, self.v, self.force, self.starts, *self.marks, *self.work)
        return hashlib.sha256(text.encode() + b"".join(np.ascontiguousarray(x).tobytes() for x in data)).hexdigest()[:16]

    def _all(self, X: Array) -> list[list[tuple[Array, Array]]]:
        parts = np.array_split(np.asarray(X, dtype=float), self.threads._max_workers)
        return [found for part in self.threads.map(self._part, parts) for found in part]

    def _rows(self) -> list[Any]:
        records = (self.measured_at.parameters, blank(Derived), blank(effects.State), blank(Flow))
        return [compiled.as_row(record)[0] for record in records]

    def _run(self, rows: list[Any], x: Array) -> tuple[Array, Array]:
        """Simulated mean forces and works since the start, both (n,); beyond a step that fails they are infinite."""
        for name, value in zip(self.names, x, strict=True):
            rows[0][name] = value
        force, work = np.empty(len(self.z)), np.empty(len(self.z))
        done = compiled.module().run_means(*rows, self.states, self.t, self.z, self.v, self.starts, 1, force, work)
        force[self.starts[done] :] = np.inf
        return force, work

    def _part(self, X: Array) -> list[list[tuple[Array, Array]]]:
        """Per parameter set and record the errors of the force over the measured oscillations and of their works."""
        rows = self._rows()
        found = []
        for x in X:
            force, work = self._run(rows, x)
            error = force - self.force
            found.append(
                [
                    (error[marks[0] + 1 : end], np.diff(work[marks]) - measured)
                    for marks, measured, end in zip(self.marks, self.work, self.starts[1:], strict=True)
                ]
            )
        return found
