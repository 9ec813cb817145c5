"""Whether a further cause is worth it, with a known rate of false alarms.

An improvement on held-out noise of a model that is not better exceeds c with a probability of at most Q(sqrt(c)), Q being
the normal tail: 2 r d - d^2 with r normal is largest where d^2 = c. With k candidates and a rate of alarm in all,
c = Q^-1(alarm / k)^2. Each record has a variance of its own, so the misfit is the log-likelihood sum n log(mean square).
"""

from collections.abc import Sequence

import numpy as np
from scipy.stats import norm

from twintube.arrays import Array
from twintube.diagnosis.fits.candidates import LATE, RECALIBRATE, SCALING
from twintube.diagnosis.fits.gains import bootstrap, removed
from twintube.diagnosis.fits.options import Fold, Option, counts_of, logs
from twintube.diagnosis.measurement.zeros import differ, step
from twintube.diagnosis.rules import RULES


class Judge:
    """Compares models by the records that the folds hold out; `start` is the model without a cause."""

    start: Option

    def __init__(self, candidates: int, folds: Sequence[Fold]) -> None:
        self.sampling: tuple[str, ...] = ()  # candidates that belong to every model, too short for the sampling
        self.limit = float(norm.isf(RULES.alarm / (candidates + 1))) ** 2
        self.records = [record for fold in folds for record in fold.held.records]  # held out
        self.counts = counts_of(folds)
        self.count = int(self.counts.sum())

    def logs(self, misfit: Array) -> Array:
        """Twice the negative log-likelihood (u,) of each held-out unit."""
        return logs(self.counts, misfit)

    def improved(self, before: Option, after: Option) -> int:
        """How many held-out units are explained better, each by more than noise gives."""
        return int(np.sum(self.logs(before.misfit) - self.logs(after.misfit) > self.limit))

    def worth(self, before: Option, after: Option) -> bool:
        """Whether an improvement of the held-out misfit is more than noise, numerics and formulation give."""
        return not self.against(before, after)

    def against(self, before: Option, after: Option) -> str:
        """What speaks against a further cause, for the table of all candidates; empty where it is worth it."""
        by_record = self.logs(before.misfit) - self.logs(after.misfit)
        gained = float(by_record.sum())
        if gained <= self.limit:
            return "improves the held-out records not more than noise would"
        if len(by_record) > RULES.few_records and gained - float(by_record.max()) <= self.limit:
            return "improves a single held-out record, all others together not more than noise would"
        if after.names[-1] == RECALIBRATE and np.sum(before.misfit > RULES.odd_right) < RULES.calibrated_records:
            return "so many parameters are not known from a single record, and the others do not ask for them"
        if self.levelled(before, after):
            return ""
        right = before.score <= RULES.right * self.count
        share = RULES.clear_share if right else RULES.least_share
        if after.names[-1] in (RECALIBRATE, *LATE):
            share = RULES.loose_share
        if gained <= RULES.worth * self.count:
            return "improves the held-out records not more than numerics would"
        if after.total > (1 - share) * before.total:
            return f"takes less than {share:.0%} of the squared error of the held-out records away"
        if not self.surely(before, after):
            return "with other records of the kind, the squared error might not fall"
        return "" if before.names == self.sampling else self.against_next(before, after, gained)

    def against_next(self, before: Option, after: Option, gained: float) -> str:
        """The like for a cause beside others.

        Many records a little better and some far worse is a formulation, not a second cause. So is a small part of the
        error of which another cause explains some.
        """
        scaling = [name for name in after.names if name in SCALING]
        if len(scaling) > 1 and scaling[-1] == after.names[-1] and not self.near(after):
            return "makes the fluid force larger or smaller as another cause does, and does not leave noise alone"
        less, whole = before.total - after.total, self.excess(self.start)
        if less >= RULES.rest_share * self.excess(before) and less >= RULES.little_share * whole and self.near(after):
            return ""
        little = less < RULES.second_share * whole
        if after.names[-1] not in LATE:  # what is late follows steps that another law of the first cause would move
            little = little and gained < RULES.second_share * self.start.score
        if little and len(after.names) > len(before.names):  # a cause exchanged is none more
            much, rest = RULES.second_share, RULES.rest_share
            return (
                f"explains less than {much:.0%} of the error and {rest:.0%} of what is left, or does not leave noise alone"
            )
        left = removed(before.score, after.score, self.count)
        clear = left >= RULES.half and gained >= RULES.second_share * self.start.score
        if (clear and after.total <= before.total) or after.total <= (1 - RULES.next_share) * before.total:
            return ""
        return f"explains less than {RULES.next_share:.0%} of what the other causes leave, which may be their formulation"

    def excess(self, option: Option) -> float:
        """Sum of the squared weighted errors beyond noise."""
        return max(0.0, option.total - self.count)

    def near(self, option: Option) -> bool:
        """Whether what is left is near to noise alone."""
        return option.total <= RULES.odd_right * self.count

    def right(self, option: Option) -> bool:
        """Whether what is left is noise, in all held-out records together and in each."""
        return option.score <= RULES.right * self.count and bool(np.all(option.misfit <= RULES.odd_right))

    def enough(self, option: Option) -> bool:
        """Whether what is left is too little to hold a further cause."""
        little = self.excess(option) < RULES.little_share * self.excess(self.start)
        return (option.score <= RULES.right * self.count or little) and not self.uneven(option)

    def surely(self, before: Option, after: Option) -> bool:
        """Whether the sum of the squared errors of the held-out records falls, whichever records had been measured."""
        less = before.squares - after.squares
        if len(less) <= RULES.few_records:
            return bool(less.sum() > 0.0)
        return bootstrap(np.column_stack([less, before.squares]), level=RULES.sure, size=np.abs(less))[0] > 0.0

    def uneven(self, option: Option) -> bool:
        """Whether the zeros of the records differ between the states of filling."""
        return differ(self.records, option.means, RULES.alarm)

    def levelled(self, before: Option, after: Option) -> bool:
        """Whether a further cause takes that difference away: next to another cause, a preload's force passes for zeros."""
        gone = step(self.records, after.means) <= (1 - RULES.next_share) * step(self.records, before.means)
        return before.names != self.sampling and gone and self.uneven(before)
