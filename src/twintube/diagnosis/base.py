"""What a damper and its bench always have beyond the model: it acts in every record, and is no change."""

import numpy as np

from twintube.common.arrays import Array
from twintube.diagnosis.bench import Bench
from twintube.diagnosis.found import Fill, Found
from twintube.diagnosis.frame import Frame
from twintube.diagnosis.mechanisms import Mechanism
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.search import BETTER, SLOPE, Search


class Base:
    """Mechanisms that always act, found one after the other; their strengths stay open to what the records say."""

    def __init__(self, bench: Bench, acting: Array, fill: Fill) -> None:
        self.bench, self.acting, self.fill = bench, acting, fill
        self.mechanisms: list[Mechanism] = []
        self.at: Array = np.zeros(0)  # coordinates of all their strengths

    def add(self, found: Found) -> None:
        """Let a mechanism act in every record, and seek the strengths of all of them anew."""
        self.mechanisms.append(found.mechanism)
        self.bench.at_usual({})
        every = np.ones(len(self.acting), dtype=bool)
        alone = Search(
            self.bench,
            Frame(self.bench, self.bench.filled(begun(self.fill)), more=set_up(self.bench, self.acting), known=True),
            every,
            self.fill,
        )
        k = len(found.mechanism.strengths)
        start = np.concatenate([self.at, found.at[:k], alone.none.at])
        frame = alone.frame.weighted(found.weights)
        self.at = alone.climbed(self.joint, start, found.sizes, frame).at[: len(self.at) + k]
        self.bench.at_usual(self.joint.values(self.at))

    @property
    def joint(self) -> Mechanism:
        """All of them as one."""
        return Mechanism("base", "base", "base", tuple(s for m in self.mechanisms for s in m.strengths))

    def has(self, mechanism: Mechanism) -> bool:
        """Whether a strength of a mechanism is among theirs."""
        return bool({s.name for s in mechanism.strengths} & {s.name for s in self.joint.strengths})

    def search(self, fill: Fill, near: Found | None = None) -> Search:
        """The search for changes beside it, in a fill; `near` is what was found in it before."""
        more = slopes_of(self.bench, self.joint, self.at)
        if not self.acting.all():
            more = np.hstack([more, set_up(self.bench, self.acting)])
        levels = begun(fill) if near is None else near.levels
        frame = Frame(self.bench, self.bench.filled(levels), more=more, known=True)
        return Search(self.bench, frame, self.acting, fill, near)

    def further(self, search: Search) -> Search:
        """A search with the fill sought farther off, and with what the steps of the force leave open there."""
        found = search.with_optimum()
        while (better := self.search(search.fill, found.none).with_optimum()).none.log_z > found.none.log_z + BETTER:
            found = better
        return found


def begun(fill: Fill) -> dict[str, float]:
    """The fill from which a search begins."""
    return {**{s.name: s.value(u) for s, u in zip(fill.levels, fill.start.tolist(), strict=True)}, **fill.values}


def slopes_of(bench: Bench, joint: Mechanism, at: Array) -> Array:
    """What forces (n, k) [N] change by with the strengths of a base, each by a standard deviation of its prior."""
    columns = []
    for s, u in zip(joint.strengths, at, strict=True):
        (low, a), (high, b) = ((x, {s.name: s.value(x)}) for x in np.clip((u - SLOPE, u + SLOPE), *s.span))
        columns.append((bench.forces(b) - bench.forces(a)) / (high - low))
    return np.column_stack(columns) if columns else np.zeros((len(bench.z), 0))


def set_up(bench: Bench, acting: Array) -> Array:
    """What the samples `acting` (n,) have of their own day: zero, gain, temperature; (n, 3) [N] of size one."""
    force, n = bench.forces({}), numbers()
    fluid = bench.fluid(force, bench.full(bench.states)[1], bench.states)
    day = np.column_stack([np.full(len(force), n.zero * bench.peak), n.gain * force, n.begun * fluid])
    return np.asarray(acting[:, None] * day)
