"""What a cause is worth: the error of records that the strengths, and the model's own error, do not know."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import lsq_linear

from twintube.common.arrays import Array
from twintube.evidence.changes import Changes
from twintube.evidence.frame import Frame
from twintube.evidence.search import Found
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
    changed = None if found is None else search.derivatives(found.mechanism, found.at)
    out = []
    for record, at in zip(bench.records, bench.slices, strict=True):
        if not search.acting[at].any():
            continue
        frame = search.frame.hiding(at, UNSEEN)
        rows = at.start + np.flatnonzero(bench.used[at])
        extended = gain = None
        if found is not None and changed is not None:
            u = known_by_others(frame, found, search.bench.measured - found.force, changed)
            errors = bench.measured - search.force(found.mechanism, u)
            extended = rms(frame.left(errors, found.evidence.sizes)[rows], bench.sigma[rows])
            gain = density(search.frame, frame, errors, found.evidence.sizes)
            gain -= density(search.frame, frame, bench.measured - search.base, search.none.sizes)
        without = rms(frame.left(bench.measured - search.base, search.none.sizes)[rows], bench.sigma[rows])
        out.append(HeldOut(record.name, without, extended, rms(bench.sigma[rows], bench.sigma[rows]), gain))
    return out


def known_by_others(frame: Frame, found: Found, errors: Array, changed: Array) -> Array:
    """Coordinates (k,) of a cause that `frame` gives, by a step of Gauss and Newton from those of all records.

    `errors` (n,) [N] and the derivatives `changed` (n, k) [N] of the forces are those of all records.
    """
    columns = frame.residuals(np.column_stack([errors, changed]), found.evidence.sizes)
    low, high = found.mechanism.ends
    step = lsq_linear(
        np.vstack([columns[:, 1:], np.eye(len(found.at))]), np.concatenate([columns[:, 0], -found.at]),
        (low - found.at, high - found.at),
    )  # fmt: skip
    return np.asarray(found.at + step.x)


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
