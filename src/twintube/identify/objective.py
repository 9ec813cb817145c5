"""How far a parameter set is from the records: equations 42 and 43, for a whole swarm at once."""

import itertools
import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from twintube import compiled, effects
from twintube.arrays import Array
from twintube.checks import tube_limit
from twintube.parameters import Damper
from twintube.simulate import InputError, checked
from twintube.variables import Derived, Flow, blank

# Samples per oscillation that the records are thinned to; tests/identify shows that more do not change the result.
SAMPLES = 64
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

    @property
    def top_speed(self) -> float:
        """Largest speed of the measured oscillations [m/s]."""
        return float(np.abs(self.velocity[self.marks[0] :]).max())

    def thinned(self, samples: int) -> "Harmonic":
        """The record with about `samples` per oscillation, before the first mark as densely as in an oscillation."""
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
        time, stroke, velocity, force = (x[kept] for x in (self.time, self.stroke, self.velocity, self.force))
        return Harmonic(self.oil_level, self.gas_preload, time, stroke, velocity, force, np.array(new_marks))

    def works(self) -> Array:
        """Measured work [J] of each oscillation: the area of the loop."""
        slices = [slice(a, b + 1) for a, b in zip(self.marks[:-1], self.marks[1:], strict=True)]
        return np.array([np.trapezoid(self.force[s], self.stroke[s]) for s in slices])


class Objective:
    """Equations 42 and 43 over records, for parameters called by their names in `effects.Parameters`.

    A call with X (m, k) returns (m,): RMSE of the force [N], plus RMSE of the works per oscillation [J] `with_work`.
    Swarms are shared out to threads; numba releases the interpreter's lock.
    """

    def __init__(
        self, base: Damper, names: Sequence[str], records: Sequence[Harmonic], *, with_work: bool, samples: int = SAMPLES
    ) -> None:
        if not records:
            raise InputError("no records to identify from")
        self.base, self.names, self.with_work = base, tuple(names), with_work
        table = {item.name: item.metadata for item in fields(effects.Parameters)}
        self.bounds = np.array([[table[n]["lower"], table[n]["upper"]] for n in names], dtype=float)
        thin = [record.thinned(samples) for record in records]
        limit = tube_limit(base.parameters)
        for record in thin:
            checked(record.stroke, record.velocity, limit)
        self.starts = np.concatenate([[0], np.cumsum([len(r.time) for r in thin])]).astype(np.int64)
        cycles = min(len(r.marks) for r in thin)
        self.marks = np.array([r.marks[:cycles] + a for r, a in zip(thin, self.starts[:-1], strict=True)])
        self.states = np.array([[r.oil_level, r.gas_preload] for r in thin], dtype=float)
        columns = ("time", "stroke", "velocity", "force")
        self.t, self.z, self.v, self.force = (np.concatenate([getattr(r, n) for r in thin]) for n in columns)
        self.work = np.array([r.works()[: cycles - 1] for r in records])
        self.counted = sum(len(r.time) - r.marks[0] for r in thin)
        self.threads = ThreadPoolExecutor(os.cpu_count())

    def __call__(self, X: Array) -> Array:
        """Errors (m,) of the parameter sets X (m, k)."""
        parts = np.array_split(np.asarray(X, dtype=float), self.threads._max_workers)
        return np.concatenate(list(self.threads.map(self._part, parts)))

    def squares(self, x: Array) -> Array:
        """Sums of squared errors per record (r, 2) of one parameter set: force [N2], works [J2]."""
        return self._squares(self._rows(), x)

    def _rows(self) -> list[Any]:
        records = (self.base.parameters, blank(Derived), blank(effects.State), blank(Flow))
        arrays = [compiled.as_row(record) for record in records]
        return [array[0] for array in arrays]

    def _squares(self, rows: list[Any], x: Array) -> Array:
        for name, value in zip(self.names, x, strict=True):
            rows[0][name] = value
        out = np.empty((len(self.states), 2))
        data = (self.states, self.t, self.z, self.v, self.force, self.starts, self.marks, self.work)
        if compiled.module().run_errors(*rows, *data, out) < len(self.states):
            out[:] = np.inf
        return out

    def _part(self, X: Array) -> Array:
        rows = self._rows()
        found = np.empty(len(X))
        for j, x in enumerate(X):
            total = self._squares(rows, x).sum(axis=0)
            found[j] = np.sqrt(total[0] / self.counted)
            if self.with_work:
                found[j] += np.sqrt(total[1] / self.work.size)
        return found
