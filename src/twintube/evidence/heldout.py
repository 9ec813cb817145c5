"""What a cause is worth: the error of records that the strengths, and the model's own error, do not know."""

from dataclasses import dataclass

import numpy as np

from twintube.arrays import Array
from twintube.evidence.changes import Changes
from twintube.evidence.frame import Frame
from twintube.evidence.search import Found, Search

UNSEEN = 1e6  # [N] noise of a record that is not to tell anything


@dataclass(frozen=True)
class HeldOut:
    """Force errors (RMS) [N] of a record that was left out, the model's own error as the others know it taken off."""

    record: str
    without: float
    with_cause: float | None
    noise: float


def held_out(changes: Changes, found: Found | None) -> list[HeldOut]:
    """Each record in which something may have happened, predicted from all others."""
    search = changes.search
    bench = search.bench
    out = []
    for record, at in zip(bench.records, bench.slices, strict=True):
        if not search.acting[at].any():
            continue
        hidden = np.zeros(len(bench.z))
        hidden[at] = UNSEEN
        frame = Frame(bench, bench.states, steps=hidden, more=search.more)
        rows = at.start + np.flatnonzero(bench.used[at])
        apart = Search(bench, frame, search.acting, search.more)
        extended = None
        if found is not None:
            u = apart.optimum(found.mechanism, found.evidence.sizes, found.at)
            extended = rms(frame.left(bench.measured - apart.force(found.mechanism, u), found.evidence.sizes)[rows])
        without = rms(frame.left(bench.measured - search.base, search.none.sizes)[rows])
        out.append(HeldOut(record.name, without, extended, rms(bench.sigma[rows])))
    return out


def rms(values: Array) -> float:
    """Root of the mean square."""
    return float(np.sqrt(np.mean(values**2)))
