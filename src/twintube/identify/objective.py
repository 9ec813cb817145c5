"""How far a parameter set is from the records: equations 42 and 43, for a whole swarm at once."""

import hashlib
import itertools
import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid

from twintube import compiled
from twintube.arrays import Array
from twintube.checks import tube_limit
from twintube.parameters import Damper
from twintube.simulate import InputError, checked
from twintube.variables import Derived, Flow, Parameters, State, blank

# Samples per oscillation that the records are thinned to; tests/identify shows that more do not change the result.
SAMPLES = 64
FASTER = 1.2
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


class Objective:
    """Equations 42 and 43 over records, for parameters called by their names in `Parameters`.

    A call with X (m, k) returns (m,): RMSE of the force [N], plus RMSE of the works per oscillation [J] `with_work`.
    Swarms are shared out to threads; numba releases the interpreter's lock.
    """

    def __init__(
        self, base: Damper, names: Sequence[str], records: Sequence[Harmonic], *, with_work: bool, samples: int = SAMPLES
    ) -> None:
        if not records:
            raise InputError("no records to identify from")
        self.base, self.names, self.with_work = base, tuple(names), with_work
        table = {item.name: item.metadata for item in fields(Parameters)}
        thin = self.records = [record.thinned(samples) for record in records]
        fastest = max(record.top_speed for record in records)
        # A cavitation threshold above every measured velocity is the same as none.
        upper = {"v_cav": FASTER * fastest}
        self.bounds = np.array(
            [[table[n]["lower"], min(table[n]["upper"], upper.get(n, np.inf))] for n in names], dtype=float
        )
        limit = tube_limit(base.parameters)
        for record in thin:
            checked(record.stroke, record.velocity, limit)
        self.starts = np.concatenate([[0], np.cumsum([len(r.time) for r in thin])]).astype(np.int64)
        cycles = min(len(r.marks) for r in thin)
        self.marks = np.array([r.marks[:cycles] + a for r, a in zip(thin, self.starts[:-1], strict=True)])
        self.states = np.array([[r.oil_level, r.gas_preload] for r in thin], dtype=float)
        self.z, self.v, self.force = (np.concatenate([getattr(r, n) for r in thin]) for n in ("stroke", "velocity", "force"))
        self.work = np.array([r.works()[: cycles - 1] for r in records])
        self.counted = sum(len(r.time) - 1 - r.marks[0] for r in thin)
        self.threads = ThreadPoolExecutor(os.cpu_count())

    def __call__(self, X: Array) -> Array:
        """Errors (m,) of the parameter sets X (m, k)."""
        total = self.sums(X).sum(axis=1)
        error: Array = np.sqrt(total[:, 0] / self.counted)
        if self.with_work:
            error += np.sqrt(total[:, 1] / self.work.size)
        return error

    def sums(self, X: Array) -> Array:
        """Sums of squared errors (m, r, 2) of the parameter sets X (m, k) per record: force [N2], works [J2]."""
        parts = np.array_split(np.asarray(X, dtype=float), self.threads._max_workers)
        return np.concatenate(list(self.threads.map(self._part, parts)))

    def damper(self, x: Array) -> Damper:
        """The base damper with the parameters x (k,)."""
        return self.base.with_(**{name: float(value) for name, value in zip(self.names, x, strict=True)})

    @property
    def digest(self) -> str:
        """What the values depend on, so that a journal of other records or bounds is not taken for this one's."""
        text = repr((self.base.parameters, self.names, self.with_work, self.bounds.tolist()))
        data = (self.states, self.z, self.v, self.force, self.starts, self.marks, self.work)
        return hashlib.sha256(text.encode() + b"".join(np.ascontiguousarray(x).tobytes() for x in data)).hexdigest()[:16]

    def _part(self, X: Array) -> Array:
        rows: list[Any] = [compiled.as_row(r)[0] for r in (self.base.parameters, blank(Derived), blank(State), blank(Flow))]
        out = np.empty((len(X), len(self.states), 2))
        data = (self.states, self.z, self.v, self.force, self.starts, self.marks, self.work)
        for j, x in enumerate(X):
            for name, value in zip(self.names, x, strict=True):
                rows[0][name] = value
            if compiled.module().run_errors(*rows, *data, out[j]) < len(self.states):
                out[j] = np.inf
        return out
