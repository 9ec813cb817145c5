"""What a cause is worth: the error of records that the strengths, and the model's own error, do not know."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from twintube.arrays import Array
from twintube.evidence.changes import Changes
from twintube.evidence.frame import Frame
from twintube.evidence.search import Found, Search
from twintube.evidence.sizes import Sizes

UNSEEN = 1e6  # [N] noise of a record that is not to tell anything


@dataclass(frozen=True)
class HeldOut:
    """Force errors (RMS) [N] of a record that was left out, the model's own error as the others know it taken off."""

    record: str
    without: float
    with_cause: float | None
    noise: float
    gain: float | None = None  # of the logarithm of its predictive density with the cause


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
        extended = gain = None
        if found is not None:
            u = apart.optimum(found.mechanism, found.evidence.sizes, found.at)
            errors = bench.measured - apart.force(found.mechanism, u)
            extended = rms(frame.left(errors, found.evidence.sizes)[rows], bench.sigma[rows])
            gain = density(search.frame, frame, errors, found.evidence.sizes)
            gain -= density(search.frame, frame, bench.measured - search.base, search.none.sizes)
        without = rms(frame.left(bench.measured - search.base, search.none.sizes)[rows], bench.sigma[rows])
        out.append(HeldOut(record.name, without, extended, rms(bench.sigma[rows], bench.sigma[rows]), gain))
    return out


def density(whole: Frame, apart: Frame, errors: Array, sizes: Sizes) -> float:
    """Logarithm of the density of a record that the errors (n,) [N] of all others predict, up to a constant."""
    known, hidden = (f.log_z(f.reduced(f.whitened(errors[:, None], sizes.lasting_at), sizes), sizes) for f in (whole, apart))
    return known - hidden


def contradicted(several: Sequence[HeldOut]) -> bool:
    """Whether the records that were left out are predicted worse with the cause (Vehtari, Gelman and Gabry 2017)."""
    gains = [one.gain for one in several if one.gain is not None]
    return bool(gains) and sum(gains) < 0.0


def rms(values: Array, sigma: Array) -> float:
    """Root of the mean square of values (n,) [N], each counted by its uncertainty `sigma` (n,) [N]."""
    return float(np.sqrt(np.sum((values / sigma) ** 2) / np.sum(sigma**-2.0)))
