"""What a hypothesis is worth: records that neither its strengths nor the model's own error know.

The second judge beside the evidence: weights of the hypotheses by how they predict records that were left out, with a
Bayesian bootstrap over the records (pseudo-BMA+; Yao, Vehtari, Simpson and Gelman 2018). Few records give broad weights.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import softmax

from twintube.common.arrays import Array
from twintube.diagnosis.changes import Hypothesis
from twintube.diagnosis.found import Found
from twintube.diagnosis.frame import Frame
from twintube.diagnosis.heavy import tails, without
from twintube.diagnosis.search import Search
from twintube.diagnosis.sizes import Sizes

UNSEEN = 1e6  # [N] noise of a record that is not to tell anything
DRAWS = 4000  # of the bootstrap


@dataclass(frozen=True)
class HeldOut:
    """Force errors (RMS) [N] of a record that was left out, the model's own error as the others know it taken off."""

    record: str
    without: float
    with_cause: float | None
    noise: float
    gain: float | None = None  # of the logarithm of its predictive density with the cause


@dataclass(frozen=True)
class Predicted:
    """What a hypothesis says of each record (r,) that was left out."""

    error: Array  # RMS [N]
    density: Array  # logarithm, up to a constant


def predicted(search: Search, found: Found, records: Sequence[int]) -> Predicted:
    """Each of some records predicted from all others: forces are linear in strengths and fill about those of all records."""
    bench, m = search.bench, found.mechanism
    whole = search.frame.weighted(found.weights)
    at = search.trial(m, found.at, found.exact)
    values = at.values
    if len(at.u):
        # What the strengths may be is a contribution like others, of size one about the middle of their priors.
        slopes = search.slopes(m, at)
        values = np.column_stack([values[:, 0] + slopes @ at.u, values[:, 1:], slopes])
    standardised = whole.standardised(without(whole, values, found.sizes), found.sizes)
    every = density(whole, values, found.sizes)
    errors, densities = [], []
    for i in records:
        span = bench.slices[i]
        hidden = whole.hiding(span, UNSEEN)
        rows = span.start + np.flatnonzero(bench.used[span])
        left = hidden.left(without(hidden, values, found.sizes), found.sizes)[rows]
        errors.append(weighted_rms(left, bench.sigma[rows]))
        others = density(hidden, values, found.sizes)
        densities.append(every - others + tails(standardised[rows], found.weights[rows]))
    return Predicted(np.array(errors), np.array(densities))


def density(frame: Frame, values: Array, sizes: Sizes) -> float:
    """Logarithm of the density of errors, up to a constant."""
    return frame.log_z(frame.reduced(frame.whitened(values, sizes.lasting_at), sizes), sizes)


def held_out(none: Predicted, cause: Predicted | None, search: Search, records: Sequence[int]) -> list[HeldOut]:
    """Each record without a cause and with it."""
    out = []
    for at, i in enumerate(records):
        span = search.bench.slices[i]
        noise = search.bench.sigma[span.start + np.flatnonzero(search.bench.used[span])]
        error, gain = (
            (None, None) if cause is None else (float(cause.error[at]), float(cause.density[at] - none.density[at]))
        )
        name = search.bench.records[i].name
        out.append(HeldOut(name, float(none.error[at]), error, weighted_rms(noise, noise), gain))
    return out


def weights(predictions: Mapping[str, Predicted]) -> dict[str, float]:
    """The weight of each hypothesis by records left out (pseudo-BMA+)."""
    several = np.array([one.density for one in predictions.values()])
    records = several.shape[1]
    shares = np.random.default_rng(0).dirichlet(np.ones(records), DRAWS)
    several = several - several.max(axis=0)
    mean = softmax(records * shares @ several.T, axis=1).mean(axis=0)
    return dict(zip(predictions, mean.tolist(), strict=True))


def changed(search: Search) -> list[int]:
    """The records in which something may have happened."""
    return [i for i, span in enumerate(search.bench.slices) if search.acting[span].any()]


def asked(hypotheses: Sequence[Hypothesis], most: int) -> list[Hypothesis]:
    """The likeliest hypotheses that predict something, and `none`."""
    likely = [h for h in hypotheses if h.found is not None]
    return [h for i, h in enumerate(likely) if i < most or h.kind == "none"]


def weighted_rms(values: Array, sigma: Array) -> float:
    """Root of the mean square of values (n,) [N], each counted by its uncertainty `sigma` (n,) [N]."""
    return float(np.sqrt(np.sum((values / sigma) ** 2) / np.sum(sigma**-2.0)))
