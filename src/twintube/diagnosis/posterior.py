"""Probability over oil level and share of the gas preload, from the evidence of some states and what a file says of them."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray
from scipy.special import expit, logsumexp
from scipy.stats import norm

from twintube.common.arrays import Array
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.shares import SHARES, Zeroed, nearest
from twintube.diagnosis.shares import TARED as ON_TARED
from twintube.diagnosis.sizes import Sizes

SHOWN = 0.0025  # step of the oil level in the answer
WIDEST = 4.0  # standard deviations of the tolerance
COVERED, APART = 2.0, 3.0  # standard deviations of the gas force: within these shares are told as one; beyond, another fill
EVEN = 0.5  # probability of the one and the other
LOST, PARTLY, THERE, TARED = range(4)  # what became of the gas

Found = Mapping[tuple[float, float], Zeroed]  # by share and oil level that were simulated


@dataclass(frozen=True)
class Stated:
    """What a file says of a state; None where it says that nobody knows."""

    oil_level: float | None = None
    gas_preload: float | None = None

    @property
    def anything(self) -> bool:
        """Whether it says something."""
        return self.oil_level is not None or self.gas_preload is not None


NOTHING = Stated()


@dataclass(frozen=True)
class StatePosterior:
    """Probability over the zero of the load cell, the share of the gas and the oil level (l,): (2, s, l), summing to 1."""

    levels: Array
    probability: Array
    sizes: Sizes  # of the model's errors in the state below
    # Share, level, and whether the cell was set to zero with the damper in it, that fit best, within what a file says.
    best: tuple[float, float, bool]
    log_odds_stated: float  # evidence of what a file says, to the tolerance of a fill, over that of any state
    free: tuple[float, float]  # share and level that fit best, whatever a file says
    # Probability of shares that the tolerance of the gas force does not cover, and which of them fits best, with its level.
    otherwise: tuple[float, float, float]

    @property
    def as_stated(self) -> float:
        """Probability that what a file says is right."""
        return float(expit(self.log_odds_stated + np.log(1.0 / numbers().misstated - 1.0)))

    @property
    def rather_misstated(self) -> bool:
        """Whether what a file says is more likely wrong than right."""
        return self.as_stated < EVEN

    @property
    def by_gas(self) -> Array:
        """Probability (4, l) that the gas is lost, partly there, or there, and that it is missing on a tared cell.

        What its tolerance covers is not told from none, nor from all.
        """
        right, tared = self.probability
        lost, there = covered(0.0), covered(1.0)
        return np.array([
            (right + tared)[lost].sum(axis=0), right[~lost & ~there].sum(axis=0), right[there].sum(axis=0),
            tared[~lost].sum(axis=0),
        ])  # fmt: skip

    @property
    def gas_lost(self) -> float:
        """Probability that the preload is lost: to the tolerance of the gas force nothing is left."""
        return float(self.by_gas[LOST].sum())

    @property
    def gas_there(self) -> float:
        """Probability that all of the preload is there, to the tolerance of the gas force."""
        return float(self.probability[:, covered(1.0)].sum())

    @property
    def tared(self) -> float:
        """Probability that preload is there, and the load cell was set to zero with the damper in it."""
        return float(self.by_gas[TARED].sum())

    def interval(self, share: float = 0.9) -> tuple[float, float]:
        """The shortest interval of the oil level [1] that holds a `share` of the probability."""
        return shortest(self.levels, self.probability.sum(axis=(0, 1)), share)

    def gas_interval(self, share: float = 0.9) -> tuple[float, float]:
        """The shortest interval of the share of the gas preload [1] that holds a `share` of the probability."""
        return shortest(SHARES, self.probability.sum(axis=(0, 2)), share)

    @property
    def level(self) -> float:
        """The median oil level [1]."""
        return float(np.interp(0.5, np.cumsum(self.probability.sum(axis=(0, 1))), self.levels))

    @property
    def gas(self) -> float:
        """The median share of the gas preload [1]."""
        return float(np.interp(0.5, np.cumsum(self.probability.sum(axis=(0, 2))), SHARES))


def covered(share: float, deviations: float = COVERED) -> NDArray[np.bool_]:
    """The shares (s,) that lie within the tolerance of the gas force about one."""
    return np.asarray(np.abs(SHARES - share) <= deviations * numbers().preload)


def shortest(values: Array, mass: Array, share: float) -> tuple[float, float]:
    """The shortest interval of even `values` (n,) up to 1 that holds a `share` of their probability (n,)."""
    half = 0.5 * float(values[1] - values[0])
    total = np.concatenate([[0.0], np.cumsum(mass)])
    ends = np.minimum(np.searchsorted(total, total[:-1] + share - 1e-9), len(mass))
    wide = np.where(total[:-1] + share <= total[-1] + 1e-9, ends - np.arange(len(mass)), len(mass) + 1)
    first = int(np.argmin(wide))
    low, high = values[first] - half, values[min(first + int(wide[first]), len(mass)) - 1] + half
    return float(max(0.0, low)), float(min(1.0, high))


def at_level(found: Found, level: float) -> Array:
    """Logarithm (2, s) of the evidence of shares at an oil level that was simulated.

    The paper measured with the preload and without. How much of the gas must be left that the damper does not cavitate
    nobody has: with a part of the gas it may cavitate as with any other share.
    """
    shares = np.array(sorted(gas for gas, x in found if x == level))
    several = np.array([found[gas, level].log_z for gas in shares])  # (k, 2, s)
    ends = np.concatenate([[0.0], 0.5 * (shares[1:] + shares[:-1]), [1.0]])
    out = logsumexp(several, axis=0, b=np.diff(ends)[:, None, None])
    out[:, 0], out[:, -1] = several[0, :, 0], several[-1, :, -1]
    return np.asarray(out)


def posterior(found: Found, stated: Stated = NOTHING) -> StatePosterior:
    """Probabilities from the evidence of share and oil level, and from what a file says of them."""
    known = np.array(sorted({level for _, level in found}))
    evidence = np.array([at_level(found, level) for level in known])  # (k, 2, s)
    fine = np.arange(numbers().level_low, 1.0 + 1e-9, SHOWN)
    log_likelihood = to_tolerance(known, evidence, fine)
    free, as_stated = (log_likelihood + log_prior(fine, some) for some in (NOTHING, stated))
    said = 1.0 - numbers().misstated if stated.anything else 0.0
    both = logsumexp([free, as_stated], axis=0, b=[[[[1.0 - said]]], [[[said]]]])
    probability = np.exp(both - logsumexp(both))
    any_zero = np.logaddexp(evidence[:, 0], evidence[:, 1])
    freely = any_zero + log_prior_fill()
    share, level = likeliest(any_zero + log_prior_fill(stated) + fitting(known, stated)[:, None], known)
    zeros = evidence[int(np.flatnonzero(known == level)[0]), :, nearest(share)]
    best = share, level, bool(zeros[ON_TARED] > zeros[1 - ON_TARED])
    apart = ~covered(share, APART)
    other = float(probability[:, apart].sum()), *likeliest(np.where(apart, freely, -np.inf), known)
    return StatePosterior(
        fine, probability, simulated(found, share, level).sizes, best,
        float(logsumexp(as_stated) - logsumexp(free)), likeliest(freely, known), other,
    )  # fmt: skip


def likeliest(of: Array, levels: Array) -> tuple[float, float]:
    """Share and level where (l, s) is largest."""
    i, j = np.unravel_index(int(of.argmax()), of.shape)
    return float(SHARES[j]), float(levels[i])


def simulated(found: Found, share: float, level: float) -> Zeroed:
    """What was simulated at a level with the nearest share."""
    return found[min((key for key in found if key[1] == level), key=lambda key: abs(key[0] - share))]


def to_tolerance(known: Array, evidence: Array, fine: Array) -> Array:
    """Logarithm (2, s, l) of the probability of the records at levels `fine` (l,), of evidence (k, 2, s) at some (k,).

    What the force tells is the level to a tolerance: geometry and fill of a damper are no better known.
    """
    step = SHOWN / 2.0
    wide = int(np.ceil(WIDEST * numbers().level_tolerance / step))
    read = fine[0] + step * np.arange(-wide, 2 * (len(fine) - 1) + wide + 1)
    # A level that was not looked at has the evidence of the line between its neighbours.
    place = np.interp(read, known, np.arange(len(known), dtype=float))
    i = np.minimum(place.astype(int), max(0, len(known) - 2))
    after = np.minimum(i + 1, len(known) - 1)
    by = (place - i)[:, None, None]
    at = np.where((read < known[0])[:, None, None], evidence.min(), (1.0 - by) * evidence[i] + by * evidence[after])
    tolerance = norm.logpdf(step * np.arange(-wide, wide + 1), 0.0, numbers().level_tolerance) + np.log(step)
    return np.asarray(logsumexp(sliding_window_view(at, 2 * wide + 1, axis=0)[::2] + tolerance, axis=-1).transpose(1, 2, 0))


def fitting(levels: Array, stated: Stated) -> Array:
    """Logarithm (l,) of the odds of levels against that which a file states."""
    apart = np.zeros(len(levels)) if stated.oil_level is None else levels - stated.oil_level
    return np.asarray(-0.5 * (apart / numbers().level_tolerance) ** 2)


def log_prior(levels: Array, stated: Stated) -> Array:
    """Logarithm of the probability (s, l) of shares of the gas and oil levels (l,) where a file is right about them."""
    if stated.oil_level is None:
        level = np.full(len(levels), np.log((1.0 - numbers().full) / (len(levels) - 1)))
        level[-1] = np.log(numbers().full)
    else:
        level = norm.logpdf(levels, stated.oil_level, numbers().level_tolerance)
        level -= logsumexp(level)
    return np.asarray(log_prior_gas(stated)[:, None] + level)


def log_prior_gas(stated: Stated) -> Array:
    """Logarithm of the probability (s,) of shares of the gas: lost and nominal as likely, the rest even between."""
    if stated.gas_preload is not None:
        return np.where(np.arange(len(SHARES)) == nearest(stated.gas_preload), 0.0, -np.inf)
    out = np.full(len(SHARES), np.log(numbers().leaking / (len(SHARES) - 2)))
    out[[0, -1]] = np.log(0.5 * (1.0 - numbers().leaking))
    return out


def log_prior_fill(stated: Stated = NOTHING) -> Array:
    """Logarithm (s,) of the probability that a damper has a share of its gas, to the tolerance of the gas force."""
    if stated.gas_preload is not None:
        return log_prior_gas(stated)
    out = log_prior_gas(stated) + np.log(np.sqrt(2.0 * np.pi) * numbers().preload / (SHARES[1] - SHARES[0]))
    return np.where((SHARES > 0.0) & (SHARES < 1.0), out, log_prior_gas(stated))
