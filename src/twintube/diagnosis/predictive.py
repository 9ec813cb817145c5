r"""Whether an answer explains the records one by one (posterior predictive check; Gelman and others 2013, chapter 6).

What a right hypothesis leaves of a record is Student's noise. In n samples that are r deviations off

    \sum \log(1 + r^2 / \nu)   has the mean  n (\psi((\nu + 1) / 2) - \psi(\nu / 2))

and the variance n (\psi'(\nu / 2) - \psi'((\nu + 1) / 2)). A record that has far more is not explained. Single intervals of
which the like holds are a drop-out or a spike of the channel where the measured force leaves the range of what is before and
after; else the force steps at another moment.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.special import digamma, polygamma
from scipy.stats import norm, t

from twintube.common.arrays import Array
from twintube.diagnosis.found import Found
from twintube.diagnosis.frame import Frame
from twintube.diagnosis.heavy import standardised
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.search import Search


@dataclass(frozen=True)
class Unlike:
    """A record that is not as a hypothesis has it."""

    record: str
    kind: Literal["whole", "spike", "step"]
    times: tuple[float, ...]  # [s] of single intervals


def unlike(search: Search, found: Found) -> Iterator[Unlike]:
    """The records that a hypothesis does not explain; a right one fails each check with the chance `implausible` at most."""
    bench, frame = search.bench, search.frame.weighted(found.weights)
    off = standardised(frame, search.trial(found.mechanism, found.at, found.exact).values, found.sizes)
    for record, span in zip(bench.records, bench.slices, strict=True):
        inside = span.start + np.flatnonzero(frame.used[span])
        if not len(inside):
            continue
        if chance(off[inside]) * len(bench.records) < numbers().implausible:
            yield Unlike(record.name, "whole", ())
            continue
        times: dict[Literal["spike", "step"], list[float]] = {"spike": [], "step": []}
        far = inside[seldom(off[inside], frame)]
        for run in np.split(far, np.flatnonzero(np.diff(far) > 1) + 1):
            left = outside(bench.measured[span], run - span.start) / frame.noise[run]
            times["spike" if seldom(left, frame).any() else "step"] += bench.t[run].tolist()
        for kind, some in times.items():
            if some:
                yield Unlike(record.name, kind, tuple(some))


def seldom(off: Array, frame: Frame) -> NDArray[np.bool_]:
    """Whether samples (n,) so many standard deviations off are in no right answer."""
    return np.asarray(2.0 * t.sf(np.abs(off), numbers().freedom) * frame.used.sum() < numbers().implausible)


def outside(force: Array, run: NDArray[np.int64]) -> Array:
    """By how much [N] a `run` of forces leaves the range of those before and after it."""
    if not len(run):
        return np.zeros(0)
    ends = force[[max(0, run[0] - 1), min(len(force) - 1, run[-1] + 1)]]
    return np.asarray(np.maximum(0.0, np.maximum(force[run] - ends.max(), ends.min() - force[run])))


def chance(off: Array) -> float:
    """The chance that samples (n,) of the noise are as many standard deviations off, or more."""
    nu = numbers().freedom
    mean = digamma((nu + 1.0) / 2.0) - digamma(nu / 2.0)
    variance = polygamma(1, nu / 2.0) - polygamma(1, (nu + 1.0) / 2.0)
    return float(norm.sf((np.log1p(off**2 / nu) - mean).sum() / np.sqrt(len(off) * variance)))
