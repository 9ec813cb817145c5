"""Which causes the records ask for: forward selection on whole held-out records, with a known rate of false alarms.

An improvement on held-out noise of a model that is no better exceeds c with a probability of at most Q(sqrt(c)), Q being
the normal tail: 2 r d - d^2 with r normal is largest where d^2 = c. With k candidates and a rate of ALARM in all,
c = Q^-1(ALARM / k)^2. Each record has a variance of its own, so the misfit is the log-likelihood sum n log(mean square).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import norm

from twintube.arrays import Array
from twintube.diagnosis.candidates import DELAY, Candidate, base, best_start, nuisances
from twintube.diagnosis.fit import Fit, Free, Problem
from twintube.diagnosis.zeros import differ, step

ALARM = 0.01  # of a cause where there is none, by noise
LEAST_MISFIT = 0.5  # below the noise: no record gains from being fitted better than that
WORTH = 0.03  # least improvement of the log-likelihood per held-out sample: below it the model's numerics decide
# Least share of the squared force error left, or of what the zeros differ by, that a further cause must explain.
NEXT = 1 / 3
HALF, BESIDE = 0.5, 0.1  # or of the misfit left and of the whole misfit, where the squared error does not rise
NEAR = 0.75  # share of the best improvement from which another cause may be preferred for its squared force error
RIGHT = 0.1  # log-misfit per sample up to which nothing is missing: 5 % above the noise
FIRST, FURTHER = 9, 4  # candidates for the first and a further cause that are fitted: those with the best starts
ROUNDS = 3
FEW = 2  # held-out records up to which one may decide alone
ACTS = 1e-3  # of its range: a strength below it is neutral
RECALIBRATE = "recalibrate"
CLOSE = 0.01  # of the explainable misfit: candidates that differ by less are not told apart


@dataclass(frozen=True)
class Fold:
    """Records to fit and records to judge on."""

    fitted: Problem
    held: Problem


@dataclass(frozen=True)
class Option:
    """A candidate tried in one round, with the model that it makes."""

    names: tuple[str, ...]  # of all causes in the model, the new one last
    fits: tuple[Fit, ...]  # one per fold
    misfit: Array  # (h,) mean squared weighted error of the held-out records, fold after fold
    means: Array  # (h,) their mean errors [N]
    squares: float  # sum of their squared force errors [N2]
    score: float  # twice the negative log-likelihood of the held-out records


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


class Selector:
    """Fits and compares models; `whole` holds the records that the final model is fitted to."""

    def __init__(self, whole: Problem, candidates: Sequence[Candidate], folds: Sequence[Fold]) -> None:
        self.whole, self.folds = whole, list(folds)
        self.candidates = {c.name: c for c in candidates}
        self.limit = float(norm.isf(ALARM / (len(candidates) + 1))) ** 2
        self.cases = [case for fold in folds for case in fold.held.cases]  # held out
        self.counts = np.concatenate([fold.held.counts for fold in folds])
        self.count = int(self.counts.sum())
        self.unexplained = np.inf  # score of the model without any cause

    def logs(self, misfit: Array) -> Array:
        """Twice the negative log-likelihood (h,) of each held-out record, with a variance not below its noise's."""
        return np.asarray(self.counts * np.log(np.maximum(LEAST_MISFIT, misfit)))

    def option(self, names: Sequence[str], frees: Sequence[Sequence[Free]]) -> Option:
        """The model with some causes, fitted in every fold from the starts given for it."""
        fits = tuple(fold.fitted.fit(free, {}) for fold, free in zip(self.folds, frees, strict=True))
        held = [(fold.held, fit.values) for fold, fit in zip(self.folds, fits, strict=True)]
        misfit = np.concatenate([judge.misfits(judge.residual(values)) for judge, values in held])
        means = np.concatenate([judge.means(judge.errors(values) * judge.weight) for judge, values in held])
        squares = sum(judge.squares(values) for judge, values in held)
        return Option(tuple(names), fits, misfit, means, squares, float(self.logs(misfit).sum()))

    def bare(self) -> Option:
        """The model with nothing but the nuisances; balances the records for what follows."""
        found = self.option((), [nuisances(self.whole)] * len(self.folds))
        self.unexplained = found.score
        for fold, fit in zip(self.folds, found.fits, strict=True):
            fold.fitted.balance(fit.misfit)
        self.whole.balance(self.whole.misfits(self.whole.residual(found.fits[0].values)))
        return found

    def free(self, names: Sequence[str], values: Mapping[str, float]) -> list[Free]:
        """The free parameters of a model, from the values where they are known."""
        found = {f.name: f for f in nuisances(self.whole)}
        for name in names:
            wanted = base(self.whole) if name == RECALIBRATE else self.candidates[name].free
            found |= {f.name: f for f in wanted}
        return [Free(name, min(max(values.get(name, f.start), f.low), f.high), f.low, f.high) for name, f in found.items()]

    def beginning(self, current: Option, name: str) -> tuple[float, dict[str, float]]:
        """Where a further cause begins in all folds, and the sum of squares there.

        From places of their own the folds may end in different laws, of which only one holds for the others' records.
        """
        if name == RECALIBRATE:
            return 0.0, {}
        return best_start([fold.fitted for fold in self.folds], self.candidates[name], [fit.values for fit in current.fits])

    def extended(self, current: Option, name: str, begin: Mapping[str, float] | None = None) -> Option:
        """The current model with one more cause, from its best start where no other is given."""
        point = self.beginning(current, name)[1] if begin is None else begin
        names = [*current.names, name]
        frees = [self.free(names, {**fit.values, **point}) for fit in current.fits]
        return self.option(names, frees)

    def refitted(self, option: Option) -> Fit:
        """The same model fitted to the whole, from the better of the folds' optima."""
        starts = [self.free(option.names, fit.values) for fit in option.fits]
        costs = [float(np.sum(self.whole.shared(fit.values) ** 2)) for fit in option.fits]
        return self.whole.fit(starts[int(np.argmin(costs))], {})

    def worth(self, before: Option, after: Option) -> bool:
        """Whether an improvement of the held-out misfit is more than noise, numerics and formulation make."""
        by_record = self.logs(before.misfit) - self.logs(after.misfit)
        gained = float(by_record.sum())
        if gained <= self.limit or (len(by_record) > FEW and gained - float(by_record.max()) <= self.limit):
            return False  # noise, or one record alone decides
        if self.levelled(before, after):
            return True
        if gained <= WORTH * self.count:
            return False
        if not before.names:
            return True
        # Many records a little better and some far worse is a formulation, not a second cause.
        left = removed(before.score, after.score, self.count)
        clear = left >= HALF and gained >= BESIDE * self.unexplained and after.squares <= before.squares
        return clear or after.squares <= (1 - NEXT) * before.squares

    def uneven(self, option: Option) -> bool:
        """Whether the zeros of the records differ between the states of filling."""
        return differ(self.cases, option.means, ALARM)

    def levelled(self, before: Option, after: Option) -> bool:
        """Whether a further cause takes that difference away: beside another one, a preload's force passes for zeros."""
        gone = step(self.cases, after.means) <= (1 - NEXT) * step(self.cases, before.means)
        return bool(before.names) and gone and self.uneven(before)

    def acts(self, option: Option) -> bool:
        """Whether the new cause of an option is off its neutral value in every fold."""
        name = option.names[-1]
        if name == RECALIBRATE:
            return True
        candidate = self.candidates[name]
        strengths = [f for f in candidate.free if f.name in candidate.strength]
        usual = {f.name: f.high for f in nuisances(self.whole)}
        # What every measurement has is no cause, a lag as short as its delay neither.
        least = {f.name: usual.get(f.name, DELAY if candidate.units[f.name] == "s" else ACTS * f.width) for f in strengths}
        return all(any(abs(fit.values[f.name] - f.start) > least[f.name] for f in strengths) for fit in option.fits)

    def run(self, progress: Callable[[str], None]) -> Selection:
        """Add the cause that improves the held-out records most, until none is worth it; then drop the superfluous."""
        start = self.bare()
        recalibrated = self.extended(start, RECALIBRATE)
        current, rounds = start, []
        for n in range(ROUNDS):
            options = self.tried(current, f"round {n + 1}", FURTHER if n else FIRST, progress, () if n else (recalibrated,))
            taken = self.taken(current, options)
            rounds.append(options if taken is None else [taken, *(o for o in options if o is not taken)])
            if taken is None:
                break
            current = taken
            if current.score <= RIGHT * self.count and not self.uneven(current):
                break
        current = self.exchanged(self.pruned(current, progress), progress)
        return Selection(start, rounds, list(current.names), current, recalibrated, self.count, self.limit)

    def taken(self, current: Option, options: Sequence[Option]) -> Option | None:
        """The option that becomes the next model: the best one, or one nearly as good that predicts forces far better."""
        worthy = [o for o in options if self.acts(o) and self.worth(current, o)]
        if not worthy:
            return None
        best = worthy[0]
        near = [o for o in worthy if current.score - o.score >= NEAR * (current.score - best.score)]
        calm = [o for o in near if o.squares <= (1 - NEXT) * best.squares]
        return min(calm, key=lambda o: o.squares, default=best)

    def tried(
        self, current: Option, label: str, most: int, progress: Callable[[str], None], known: Sequence[Option] = ()
    ) -> list[Option]:
        """The current model with one more cause, best first: the calibration and the `most` with the best starts."""
        begins = {}
        for name in (RECALIBRATE, *self.candidates):
            if name not in current.names:
                progress(f"{label}: start of {name}")
                begins[name] = self.beginning(current, name)
        options = list(known)
        for name in sorted(begins, key=lambda name: begins[name][0])[: 1 + most]:
            progress(f"{label}: {name}")
            if (*current.names, name) not in [option.names for option in options]:
                options.append(self.extended(current, name, begins[name][1]))
        return sorted(options, key=lambda o: (not self.acts(o), o.score))

    def exchanged(self, current: Option, progress: Callable[[str], None]) -> Option:
        """With each of several causes exchanged for another one where that is better: the first was chosen alone."""
        for name in current.names if len(current.names) > 1 else ():
            others = [other for other in current.names if other != name]
            rest = self.option(others, [self.free(others, fit.values) for fit in current.fits])
            best = self.tried(rest, f"instead of {name}", FURTHER, progress)[0]
            if self.acts(best) and self.worth(current, best):
                current = best
        return current

    def pruned(self, current: Option, progress: Callable[[str], None]) -> Option:
        """Without the causes that the others make superfluous, such as a calibration that stood in for an effect."""
        while len(current.names) > 1:
            without = []
            for name in current.names:
                progress(f"without {name}")
                rest = [other for other in current.names if other != name]
                without.append(self.option(rest, [self.free(rest, fit.values) for fit in current.fits]))
            # Not only the cause that matters least: a calibration may lower the misfit more and still raise the error.
            superfluous = [option for option in without if not self.worth(option, current)]
            if not superfluous:
                return current
            current = min(superfluous, key=lambda o: o.score)
        return current


def removed(before: float, after: float, count: int) -> float:
    """Share of the explainable squared error that goes away between two scores of `count` samples (geometric mean)."""
    if before <= 0.0:
        return 0.0
    return float((1.0 - np.exp((max(after, 0.0) - before) / count)) / (1.0 - np.exp(-before / count)))


def bootstrap(values: Array, seed: int = 1, level: float = 0.95) -> tuple[float, float]:
    """Interval of the ratio of sums of the columns (r, 2), by resampling its rows."""
    rng = np.random.default_rng(seed)
    picks = rng.integers(0, len(values), (2000, len(values)))
    sums = values[picks].sum(axis=1)
    ratios = sums[:, 0] / np.where(np.abs(sums[:, 1]) > 0, sums[:, 1], np.nan)
    low, high = np.nanquantile(ratios, [(1 - level) / 2, (1 + level) / 2])
    return float(low), float(high)
