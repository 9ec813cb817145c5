r"""Whether an answer explains the records one by one (posterior predictive check; Gelman and others 2013, chapter 6).

What a right hypothesis leaves of a record is Student's noise. In n samples that are r deviations off

    \sum \log(1 + r^2 / \nu)   has the mean  n (\psi((\nu + 1) / 2) - \psi(\nu / 2))

and the variance n (\psi'(\nu / 2) - \psi'((\nu + 1) / 2)). A record that has far more is not explained. A single interval
that no such noise has is a drop-out or a spike of the channel: a damper's force does not come and go in one.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.special import digamma, polygamma
from scipy.stats import norm, t

from twintube.common.arrays import Array
from twintube.diagnosis.heavy import standardised
from twintube.diagnosis.numbers import NUMBERS
from twintube.diagnosis.search import Found, Search


@dataclass(frozen=True)
class Unlike:
    """A record that is not as a hypothesis has it."""

    record: str
    whole: bool  # or in a few intervals alone
    times: tuple[float, ...]  # [s] of these


def unlike(search: Search, found: Found) -> Iterator[Unlike]:
    """The records that a hypothesis does not explain: of right ones `implausible` of all answers have any."""
    bench, frame = search.bench, search.frame.weighted(found.weights)
    off = standardised(frame, search.trial(found.mechanism, found.at, found.exact).values, found.sizes)
    for record, span in zip(bench.records, bench.slices, strict=True):
        inside = span.start + np.flatnonzero(frame.used[span])
        far = inside[2.0 * t.sf(np.abs(off[inside]), NUMBERS.freedom) * frame.used.sum() < NUMBERS.implausible]
        if len(inside) and chance(off[inside]) * len(bench.records) < NUMBERS.implausible:
            yield Unlike(record.name, whole=True, times=())
        elif len(far):
            yield Unlike(record.name, whole=False, times=tuple(bench.t[far].tolist()))


def chance(off: Array) -> float:
    """The chance that samples (n,) of the noise are as many standard deviations off, or more."""
    nu = NUMBERS.freedom
    mean = digamma((nu + 1.0) / 2.0) - digamma(nu / 2.0)
    variance = polygamma(1, nu / 2.0) - polygamma(1, (nu + 1.0) / 2.0)
    return float(norm.sf((np.log1p(off**2 / nu) - mean).sum() / np.sqrt(len(off) * variance)))
