r"""Noise with heavy tails: Student's distribution of NUMBERS.freedom degrees of freedom (Lange, Little and Taylor 1989).

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
from twintube.diagnosis.numbers import NUMBERS
from twintube.diagnosis.sizes import USUAL, Sizes

SETTLED = 0.1  # of the logarithm of the evidence; numerics
ROUNDS = 8


@dataclass(frozen=True)
class Heavy:
    """Evidence of some errors under noise with heavy tails."""

    log_z: float
    sizes: Sizes  # the best
    weights: Array  # (n,)
    frame: Frame  # with these weights


def weights_of(standardised: Array) -> Array:
    """How much samples (n,) count that are so many standard deviations off."""
    nu = NUMBERS.freedom
    return np.asarray((nu + 1.0) / (nu + standardised**2))


def tails(standardised: Array, weights: Array) -> float:
    """What Student's distribution has beyond the Gaussian with these weights, at samples (n,) so many deviations off."""
    nu, r2 = NUMBERS.freedom, standardised**2
    return float(np.sum(-0.5 * (nu + 1.0) * np.log1p(r2 / nu) + 0.5 * weights * r2 - 0.5 * np.log(weights)))


def without(frame: Frame, values: Array, sizes: Sizes) -> Array:
    """The errors (n,) [N] of the first column without what is expected of the others, contributions of size one."""
    if values.shape[1] == 1:
        return np.asarray(values[:, 0])
    inner = frame.inner(values, sizes)
    expected = np.linalg.solve(np.eye(len(inner) - 1) + inner[1:, 1:], inner[1:, 0])
    return np.asarray(values[:, 0] - values[:, 1:] @ expected)


def settled(frame: Frame, values: Array, sizes: Sizes, weights: Array, rounds: int) -> tuple[Frame, Array, Array]:
    """The frame with its weights after some rounds, the samples (n,) in standard deviations, and these weights."""
    heavy = frame.weighted(weights)
    for _ in range(rounds):
        standardised = heavy.standardised(without(heavy, values, sizes), sizes)
        weights = np.where(frame.used, weights_of(standardised), 1.0)
        heavy = frame.weighted(weights)
    standardised = heavy.standardised(without(heavy, values, sizes), sizes)
    return heavy, standardised, weights


def evidence(frame: Frame, values: Array, start: Sizes = USUAL, weights: Array | None = None, rounds: int = ROUNDS) -> Heavy:
    """Evidence of errors, the first column of values (n, 1 + c) [N]; the others are contributions of size one."""
    weights = np.ones(len(values)) if weights is None else weights
    best, sizes = Heavy(-np.inf, start, weights, frame), start
    for _ in range(rounds):
        heavy, standardised, weights = settled(frame, values, sizes, weights, 1)
        found = heavy.evidence(values, sizes)
        log_z = found.log_z + tails(standardised[frame.used], weights[frame.used])
        gained = log_z - best.log_z
        if gained > 0.0:
            best = Heavy(log_z, found.sizes, weights, heavy)
        if gained < SETTLED and found.sizes == sizes:
            break
        sizes = found.sizes
    return best
