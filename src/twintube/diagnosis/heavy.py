r"""Noise with heavy tails: Student's distribution of numbers().freedom degrees of freedom (Lange, Little and Taylor 1989).

Where a force steps by hundreds of newtons, a step that is misplaced by a tenth of a millimetre leaves tens of standard
deviations in one interval. Under a Gaussian such a sample decides everything. Under Student's noise a sample that is r
standard deviations off counts by the weight

    w = (\nu + 1) / (\nu + r^2)

Given the weights all is Gaussian. They are found anew for every hypothesis, at what it expects of all contributions; the
evidence is that of Laplace about this place.
"""

from dataclasses import dataclass

import numpy as np

from twintube.common.arrays import Array
from twintube.diagnosis.frame import Frame
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.sizes import USUAL, Sizes

SETTLED = 0.1  # of the logarithm of the evidence; numerics
ROUNDS = 8


@dataclass(frozen=True)
class Heavy:
    """Evidence of some errors under noise with heavy tails."""

    log_z: float
    sizes: Sizes  # the best
    frame: Frame  # with its weights


def weights_of(standardised: Array) -> Array:
    """How much samples (n,) count that are so many standard deviations off."""
    nu = numbers().freedom
    return np.asarray((nu + 1.0) / (nu + standardised**2))


def tails(standardised: Array, weights: Array) -> float:
    """What Student's distribution has beyond the Gaussian with these weights, at samples (n,) so many deviations off."""
    nu, r2 = numbers().freedom, standardised**2
    return float(np.sum(-0.5 * (nu + 1.0) * np.log1p(r2 / nu) + 0.5 * weights * r2 - 0.5 * np.log(weights)))


def without(frame: Frame, values: Array, sizes: Sizes) -> Array:
    """The errors (n,) [N] of the first column without what is expected of the others, contributions of size one."""
    if values.shape[1] == 1:
        return np.asarray(values[:, 0])
    inner = frame.inner(values, sizes)
    expected = np.linalg.solve(np.eye(len(inner) - 1) + inner[1:, 1:], inner[1:, 0])
    return np.asarray(values[:, 0] - values[:, 1:] @ expected)


def reweighted(frame: Frame, values: Array, sizes: Sizes) -> Frame:
    """The frame with the weights of what samples are off under its own."""
    weights = weights_of(standardised(frame, values, sizes))
    return frame.weighted(np.where(frame.used, weights, 1.0))


def standardised(frame: Frame, values: Array, sizes: Sizes) -> Array:
    """What samples (n,) are off, in standard deviations of the noise."""
    return frame.standardised(without(frame, values, sizes), sizes)


def beyond(frame: Frame, values: Array, sizes: Sizes) -> float:
    """What Student's distribution has beyond the Gaussian of a frame with its weights."""
    return tails(standardised(frame, values, sizes)[frame.used], frame.weights[frame.used])


def evidence(frame: Frame, values: Array, sizes: Sizes = USUAL, rounds: int = ROUNDS) -> Heavy:
    """Evidence of errors, the first column of values (n, 1 + c) [N]; the others are contributions of size one.

    Weights are sought from those of the frame.
    """
    best = Heavy(-np.inf, sizes, frame)
    for _ in range(rounds):
        frame = reweighted(frame, values, sizes)
        found = frame.evidence(values, sizes)
        log_z = found.log_z + beyond(frame, values, sizes)
        gained = log_z - best.log_z
        if gained > 0.0:
            best = Heavy(log_z, found.sizes, frame)
        if gained < SETTLED and found.sizes == sizes:
            break
        sizes = found.sizes
    return best
