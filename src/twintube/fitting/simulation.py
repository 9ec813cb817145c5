"""Simulated mean forces over the intervals of many records: what identification and diagnosis compare with measurements."""

import os
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Protocol, Self

import numpy as np

from twintube.common.arrays import Array
from twintube.core import effects
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import Damper
from twintube.dampers.gas_spring import gas_factors
from twintube.engine import compiled
from twintube.engine.loops import Means, Records

MARGIN = 1.02  # of the velocity threshold of foam


class Driven(Protocol):
    """A record that drives the model: arrays (n,) in SI units; an interval ends at each sample but the first."""

    @property
    def oil_level(self) -> float:
        """Share of the intact oil volume [1]."""

    @property
    def gas_preload(self) -> float:
        """Share of the gas preload [1]."""

    @property
    def time(self) -> Array:
        """Times [s]."""

    @property
    def stroke(self) -> Array:
        """Strokes [m]."""

    @property
    def velocity(self) -> Array:
        """Velocities [m/s]."""


def tolerant(damper: Damper) -> Damper:
    """The damper for measured velocities: the rig's slow block moves at the threshold of foam, and they scatter about it."""
    return damper.with_(v_foam=MARGIN * damper.parameters.v_foam)


class SimulatedRecords:
    """Records laid end to end, and the damper that they drive.

    `starts` (r + 1,) where each record begins; `states` (r, 4) oil level, preload and factors of the gas; `t`, `z`, `v` (n,)
    time, stroke and velocity. `parts` are the steps of the model per interval; the forces behind a step that fails are
    `failed` [N]. `threads` serve several parameter sets at once, as the library releases the interpreter's lock. Who makes
    such records closes them: `with Objective(...) as objective`.
    """

    def __init__(self, damper: Damper, records: Sequence[Driven], *, parts: int, failed: float) -> None:
        self.given = damper
        self.damper = tolerant(damper)
        self.parts, self.failed = parts, failed
        self.starts = np.concatenate([[0], np.cumsum([len(r.time) for r in records])]).astype(np.int64)
        self.states = np.array(
            [[r.oil_level, r.gas_preload, *gas_factors(damper, getattr(r, "gas_pressure", None))] for r in records],
            dtype=float,
        )
        self.t, self.z, self.v = (np.concatenate([getattr(r, n) for r in records]) for n in ("time", "stroke", "velocity"))
        self.samples = np.concatenate([getattr(r, "samples", np.zeros(len(r.time), dtype=np.int64)) for r in records])
        usual = damper.parameters.T_curve
        self.temperature = np.concatenate([getattr(r, "kelvins", np.full(len(r.time), usual)) for r in records])
        self.workers = os.cpu_count() or 1
        self.threads = ThreadPoolExecutor(self.workers)
        # Records that run side by side are shared out by their samples.
        shares = np.linspace(0, self.starts[-1], min(self.workers, len(records)) + 1)
        self.spans: list[int] = sorted({int(np.abs(self.starts - share).argmin()) for share in shares})

    def __enter__(self) -> Self:
        """For as long as its threads are needed."""
        return self

    def __exit__(self, *_: object) -> None:
        """End the threads."""
        self.threads.shutdown()

    def rows(self) -> list[Any]:
        """The compiled model's records with the given parameters; each thread needs its own."""
        records = (self.damper.parameters, blank(Derived), blank(effects.State), blank(Flow))
        return [compiled.as_row(record)[0] for record in records]

    def run(self, rows: list[Any], changes: Iterable[tuple[str, float]]) -> tuple[Array, Array]:
        """Mean forces [N] and works since the start of the record [J], both (n,), with parameters changed in `rows`."""
        force, _, work = self.sampled(rows, changes)
        return force, work

    def sampled(
        self,
        rows: list[Any],
        changes: Iterable[tuple[str, float]],
        motion: tuple[Array, Array, Array] | None = None,
        states: Array | None = None,
        side_by_side: bool = False,
    ) -> tuple[Array, Array, Array]:
        """As `run`, with the means of the forces at the measured samples alone [N] between force and work.

        `motion` are times [s], strokes [m] and velocities [m/s] (n,) and `states` (r, 4) in place of those of the records.
        Records run on all cores where they may run `side_by_side`.
        """
        for name, value in changes:
            rows[0][name] = value
        t, z, v = motion or (self.t, self.z, self.v)
        given = self.states if states is None else states
        means = Means(*np.empty((3, len(z))))

        def run(first: int, last: int) -> int:
            """Drive the records from `first` to before `last`; returns how many it could."""
            a, b = self.starts[first], self.starts[last]
            records = Records(
                given[first:last], self.starts[first : last + 1] - a, t[a:b], z[a:b], v[a:b], self.temperature[a:b],
                self.samples[a:b], self.parts,
            )  # fmt: skip
            own = [row.copy() for row in rows] if side_by_side else rows
            return int(compiled.module().run_means(*own, records, Means(*(x[a:b] for x in means))))

        ends = self.spans if side_by_side else [0, len(given)]
        if len(ends) > 2:
            with ThreadPoolExecutor(self.workers) as threads:  # not those of several sets, of which one may wait for these
                counts = list(threads.map(run, ends[:-1], ends[1:]))
        else:
            counts = [run(*ends)]
        for first, last, count in zip(ends[:-1], ends[1:], counts, strict=True):
            if count < last - first:
                for some in (means.force, means.point):
                    some[self.starts[first + count] :] = self.failed
        return means
