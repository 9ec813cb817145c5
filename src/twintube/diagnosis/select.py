"""Which causes the records ask for: forward selection on whole held-out records, with a known rate of false alarms.

An improvement on held-out noise of a model that is not better exceeds c with a probability of at most Q(sqrt(c)), Q being
the normal tail: 2 r d - d^2 with r normal is largest where d^2 = c. With k candidates and a rate of alarm in all,
c = Q^-1(alarm / k)^2. Each record has a variance of its own, so the misfit is the log-likelihood sum n log(mean square).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.stats import norm

from twintube.arrays import Array
from twintube.diagnosis.candidates import Candidate, base, best_start, nuisances
from twintube.diagnosis.fit import Fit, Free, Problem
from twintube.diagnosis.gains import removed
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.zeros import differ, step

RECALIBRATE = "recalibrate"


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


def fitted(folds: Sequence[Fold], names: Sequence[str], frees: Sequence[Sequence[Free]]) -> Option:
    """The model with some causes, fitted in every fold from the starts given for it."""
    fits = tuple(fold.fitted.fit(free) for fold, free in zip(folds, frees, strict=True))
    held = [(fold.held, fit.values) for fold, fit in zip(folds, fits, strict=True)]
    misfit = np.concatenate([judge.misfits(judge.residual(values)) for judge, values in held])
    means = np.concatenate([judge.means(judge.errors(values) * judge.weight) for judge, values in held])
    squares = sum(judge.squares(values) for judge, values in held)
    return Option(tuple(names), fits, misfit, means, squares, float(logs(counts_of(folds), misfit).sum()))


def counts_of(folds: Sequence[Fold]) -> Array:
    """Numbers of samples (h,) of the held-out records."""
    return np.concatenate([fold.held.counts for fold in folds])


def logs(counts: Array, misfit: Array) -> Array:
    """Twice the negative log-likelihood (h,) of each held-out record, with a variance not below its noise's."""
    return np.asarray(counts * np.log(np.maximum(RULES.least_misfit, misfit)))


class Selector:
    """Fits and compares models; `whole` holds the records that the final model is fitted to.

    `start` is the model without a cause. The records to fit are balanced by its misfit, once, before anything is compared.
    """

    def __init__(self, whole: Problem, candidates: Sequence[Candidate], folds: Sequence[Fold]) -> None:
        self.start = fitted(folds, (), [nuisances(whole)] * len(folds))
        first = self.start.fits[0].values
        self.whole = whole.balanced(whole.misfits(whole.residual(first)))
        pairs = zip(folds, self.start.fits, strict=True)
        self.folds = [replace(fold, fitted=fold.fitted.balanced(fit.misfit)) for fold, fit in pairs]
        self.candidates = {c.name: c for c in candidates}
        self.limit = float(norm.isf(RULES.alarm / (len(candidates) + 1))) ** 2
        self.records = [record for fold in folds for record in fold.held.records]  # held out
        self.counts = counts_of(folds)
        self.count = int(self.counts.sum())

    def logs(self, misfit: Array) -> Array:
        """Twice the negative log-likelihood (h,) of each held-out record."""
        return logs(self.counts, misfit)

    def option(self, names: Sequence[str], frees: Sequence[Sequence[Free]]) -> Option:
        """The model with some causes, fitted in every fold of balanced records."""
        return fitted(self.folds, names, frees)

    def free(self, names: Sequence[str], values: Mapping[str, float]) -> list[Free]:
        """The free parameters of a model, from the values where they are known."""
        wanted = {f.name: f for f in nuisances(self.whole)}
        for name in names:
            added = base(self.whole) if name == RECALIBRATE else self.candidates[name].free
            wanted |= {f.name: f for f in added}
        return [Free(name, min(max(values.get(name, f.start), f.low), f.high), f.low, f.high) for name, f in wanted.items()]

    def beginning(self, current: Option, name: str) -> tuple[float, dict[str, float]]:
        """Where a further cause begins in all folds, and the sum of squares there.

        From starts of their own the folds may end in different laws, of which a single law holds for the others' records.
        """
        if name == RECALIBRATE:
            return 0.0, {}
        return best_start([fold.fitted for fold in self.folds], self.candidates[name], [fit.values for fit in current.fits])

    def extended(self, current: Option, name: str, begin: Mapping[str, float] | None = None) -> Option:
        """The current model with a further cause, from its best start where no other is given."""
        point = self.beginning(current, name)[1] if begin is None else begin
        names = [*current.names, name]
        frees = [self.free(names, {**fit.values, **point}) for fit in current.fits]
        return self.option(names, frees)

    def refitted(self, option: Option) -> Fit:
        """The model of an option fitted to the whole, from the better of the folds' optima."""
        starts = [self.free(option.names, fit.values) for fit in option.fits]
        costs = [float(np.sum(self.whole.shared(fit.values) ** 2)) for fit in option.fits]
        return self.whole.fit(starts[int(np.argmin(costs))])

    def worth(self, before: Option, after: Option) -> bool:
        """Whether an improvement of the held-out misfit is more than noise, numerics and formulation give."""
        by_record = self.logs(before.misfit) - self.logs(after.misfit)
        gained = float(by_record.sum())
        if gained <= self.limit or (len(by_record) > RULES.few_records and gained - float(by_record.max()) <= self.limit):
            return False  # noise, or a single record decides
        if self.levelled(before, after):
            return True
        if gained <= RULES.worth * self.count:
            return False
        if not before.names:
            return True
        # Many records a little better and some far worse is a formulation, not a second cause.
        left = removed(before.score, after.score, self.count)
        much = left >= RULES.half and gained >= RULES.whole_share * self.start.score
        return (much and after.squares <= before.squares) or after.squares <= (1 - RULES.next_share) * before.squares

    def uneven(self, option: Option) -> bool:
        """Whether the zeros of the records differ between the states of filling."""
        return differ(self.records, option.means, RULES.alarm)

    def levelled(self, before: Option, after: Option) -> bool:
        """Whether a further cause takes that difference away: next to another cause, a preload's force passes for zeros."""
        gone = step(self.records, after.means) <= (1 - RULES.next_share) * step(self.records, before.means)
        return bool(before.names) and gone and self.uneven(before)

    def acts(self, option: Option) -> bool:
        """Whether the new cause of an option is off its neutral value in every fold."""
        name = option.names[-1]
        if name == RECALIBRATE:
            return True
        candidate = self.candidates[name]
        strengths = [f for f in candidate.free if f.name in candidate.strength]
        usual = {f.name: f.high for f in nuisances(self.whole)}
        # What every measurement has is not a cause, nor is a lag as short as its delay.
        least = {
            f.name: usual.get(f.name, RULES.small_delay if candidate.units[f.name] == "s" else RULES.acts * f.width)
            for f in strengths
        }
        return all(any(abs(fit.values[f.name] - f.start) > least[f.name] for f in strengths) for fit in option.fits)

    def run(self, progress: Callable[[str], None]) -> Selection:
        """Add the cause that improves the held-out records most, until none is worth it; then drop the superfluous."""
        recalibrated = self.extended(self.start, RECALIBRATE)
        current, rounds = self.start, []
        for n in range(RULES.rounds):
            most, known = (RULES.further_fits, ()) if n else (RULES.first_fits, (recalibrated,))
            options = self.tried(current, f"round {n + 1}", most, progress, known)
            taken = self.taken(current, options)
            rounds.append(options if taken is None else [taken, *(o for o in options if o is not taken)])
            if taken is None:
                break
            current = taken
            if current.score <= RULES.right * self.count and not self.uneven(current):
                break
        current = self.exchanged(self.pruned(current, progress), progress)
        return Selection(self.start, rounds, list(current.names), current, recalibrated, self.count, self.limit)

    def taken(self, current: Option, options: Sequence[Option]) -> Option | None:
        """The option that becomes the next model: the best, or a nearly equal option that predicts forces far better."""
        worthy = [o for o in options if self.acts(o) and self.worth(current, o)]
        if not worthy:
            return None
        best = worthy[0]
        near = [o for o in worthy if current.score - o.score >= RULES.near_best * (current.score - best.score)]
        calm = [o for o in near if o.squares <= (1 - RULES.next_share) * best.squares]
        return min(calm, key=lambda o: o.squares, default=best)

    def tried(
        self, current: Option, label: str, most: int, progress: Callable[[str], None], known: Sequence[Option] = ()
    ) -> list[Option]:
        """The current model with a further cause, best first: the calibration and the `most` with the best starts."""
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
        """With each of several causes exchanged for another where that is better: the first was chosen alone."""
        for name in current.names if len(current.names) > 1 else ():
            others = [other for other in current.names if other != name]
            rest = self.option(others, [self.free(others, fit.values) for fit in current.fits])
            best = self.tried(rest, f"instead of {name}", RULES.further_fits, progress)[0]
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
