"""Models with some causes, fitted fold after fold and judged on the records that each fold holds out."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from twintube.arrays import Array
from twintube.diagnosis.fits.candidates import nuisances
from twintube.diagnosis.fits.fit import Fit, Free, Problem
from twintube.diagnosis.records.seen import LINEAR
from twintube.diagnosis.rules import RULES


@dataclass(frozen=True)
class Fold:
    """Records to fit and records to judge on."""

    fitted: Problem
    held: Problem


@dataclass(frozen=True)
class Option:
    """A candidate tried in a round, with the model that has it."""

    names: tuple[str, ...]  # of all causes in the model, the new cause last
    fits: tuple[Fit, ...]  # fold after fold
    seen: tuple[Mapping[str, float], ...]  # their values, with those of the measurement as the held-out records ask for
    misfit: Array  # (u,) mean squared weighted error of the held-out units, fold after fold
    means: Array  # (h,) mean errors [N] of the held-out records
    squares: Array  # (u,) sums of squared weighted errors
    score: float  # twice the negative log-likelihood of the held-out records

    @property
    def total(self) -> float:
        """Sum of the squared weighted errors of all held-out records."""
        return float(self.squares.sum())


@dataclass(frozen=True)
class Selection:
    """All rounds: options best first, and what was chosen."""

    start: Option  # nothing but the nuisances
    rounds: list[list[Option]]
    chosen: list[str]
    final: Option
    recalibrated: Option
    count: int  # held-out samples
    limit: float  # c
    neutral: tuple[str, ...]  # candidates of the first round that are neutral or not more than every measurement has
    beside: list[Option]  # of several causes: the final model with a rival in place of the first, the rival last


def fitted(folds: Sequence[Fold], names: Sequence[str], frees: Sequence[Sequence[Free]]) -> Option:
    """The model with some causes, fitted in every fold from the starts given for it."""
    fits = tuple(fold.fitted.fit(free) for fold, free in zip(folds, frees, strict=True))
    linear = [[f for f in nuisances(fold.held) if f.name in LINEAR and f.name not in names] for fold in folds]
    seen = tuple(fold.held.adjusted(fit.values, some) for fold, fit, some in zip(folds, fits, linear, strict=True))
    held = [(fold.held, values) for fold, values in zip(folds, seen, strict=True)]
    misfit = np.concatenate([judge.unit_misfits(values) for judge, values in held])
    means = np.concatenate([judge.means(judge.errors(values) * judge.weight) for judge, values in held])
    counts = counts_of(folds)
    return Option(tuple(names), fits, seen, misfit, means, counts * misfit, float(logs(counts, misfit).sum()))


def counts_of(folds: Sequence[Fold]) -> Array:
    """Numbers of samples (u,) of the held-out units."""
    return np.concatenate([fold.held.unit_counts for fold in folds])


def logs(counts: Array, misfit: Array) -> Array:
    """Twice the negative log-likelihood (u,) of each held-out unit, with a variance not below its noise's."""
    return np.asarray(counts * np.log(np.maximum(RULES.least_misfit, misfit)))
