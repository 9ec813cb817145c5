"""Which option becomes the next model, and which candidates are not asked beside others."""

from collections.abc import Mapping, Sequence

from twintube.diagnosis.fits.candidates import ALIKE, FACTORS, FADING, LATE, RECALIBRATE, Candidate, nuisances, period
from twintube.diagnosis.fits.fit import Problem
from twintube.diagnosis.fits.options import Fold, Option
from twintube.diagnosis.records.seen import DELAY, INERTIA
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.selection.judge import Judge
from twintube.diagnosis.selection.rivals import general
from twintube.fitting.splits import distinct


class Chooser(Judge):
    """Chooses between options; `whole` holds all records, `calibration` is that of the degradation parameters."""

    whole: Problem
    calibration: Candidate

    def __init__(self, candidates: Sequence[Candidate], folds: Sequence[Fold]) -> None:
        super().__init__(len(candidates), folds)
        self.candidates: Mapping[str, Candidate] = {c.name: c for c in candidates}

    def known(self, name: str) -> Candidate:
        """A candidate, or the calibration."""
        return self.calibration if name == RECALIBRATE else self.candidates[name]

    def acts(self, option: Option) -> bool:
        """Whether the new cause of an option is off its neutral value in every fold."""
        name = option.names[-1]
        candidate = self.known(name)
        least = dict(candidate.least)
        if name == DELAY and any(other not in self.sampling for other in option.names[:-1]):
            # Whether the force was filtered is not known from a model that lacks the other causes.
            least[DELAY] = max(least[DELAY], RULES.open_filtered * period(self.whole))
        start = {f.name: f.start for f in candidate.free}
        return all(
            any(abs(fit.values.get(n, start[n]) - start[n]) > least[n] for n in candidate.strength) for fit in option.fits
        )

    def short(self, option: Option) -> bool:
        """Whether the new cause of an option is not more than sampling leaves open, nor the delay beside it at its limit."""
        late = next(f for f in nuisances(self.whole) if f.name == DELAY)
        known = (1.0 - RULES.at_bound) * late.high
        return not self.acts(option) and all(abs(fit.values.get(DELAY, 0.0)) < known for fit in option.fits)

    def usual(self, current: Option, option: Option, options: Sequence[Option]) -> bool:
        """Whether what every measurement has explains as much: what is too short for sampling, a gain, other parameters."""
        gained = RULES.near_sampling * (current.score - option.score)
        late = [o for o in options if o.names[-1] in LATE and self.short(o)]
        if option.names[-1] == INERTIA:  # which is exact, so that only noise makes these as good
            return any(o.score <= option.score + self.limit for o in late)
        others = late if option.names[-1] in LATE else []
        others += [o for o in options if general(option, o) and self.known(o.names[-1]).fault and not self.acts(o)]
        # At the edge of a state nobody knows the degradation parameters so well.
        others += [o for o in options if o.names[-1] == RECALIBRATE and not self.acts(o)]
        return any(current.score - o.score >= gained for o in others)

    def taken(self, current: Option, options: Sequence[Option]) -> Option | None:
        """The option that becomes the next model: the best, or a nearly equal option that predicts forces far better."""
        worthy = [o for o in options if self.acts(o) and self.worth(current, o) and not self.usual(current, o, options)]
        if not worthy:
            return None
        best = worthy[0]
        # Of two that explain nearly as much the simpler, of which the other is a generalisation.
        enough = current.score - (1.0 - RULES.close) * (current.score - best.score)
        best = next((o for o in worthy if o.score <= enough and general(best, o) and self.formulated(best, o)), best)
        if best.names[-1] == RECALIBRATE:  # so many parameters must be better than any cause by either measure
            best = next((o for o in worthy if o.total < best.total), best)
        if best.names[-1] == RECALIBRATE:  # and in most of the records
            least, enough = self.improved(current, best) / RULES.half, current.score - best.score
            wider = (o for o in worthy if self.improved(current, o) >= least)
            best = next((o for o in wider if current.score - o.score >= RULES.near_best * enough), best)
            worthy = [best] if best.names[-1] != RECALIBRATE else worthy
        near = [o for o in worthy if current.score - o.score >= RULES.near_best * (current.score - best.score)]
        calm = [o for o in near if o.total <= (1 - RULES.next_share) * best.total]
        return min(calm, key=lambda o: o.total, default=best)

    def formulated(self, option: Option, simpler: Option) -> bool:
        """Whether what an option explains beyond a simpler law may be the law's formulation: a gain is exact."""
        return not self.known(simpler.names[-1]).fault or simpler.score - option.score <= self.limit

    def alike(self, name: str, names: Sequence[str]) -> bool:
        """Whether a candidate would only mend the formulation of a chosen cause."""
        causes = [other for other in names if other not in self.sampling]
        speeds = distinct([r.top_speed for r in self.records], RULES.equal_speeds)
        if len(speeds) < 2 and name in FACTORS and any(other in FADING for other in causes):
            return True
        return any(name in group and any(other in group for other in causes) for group in ALIKE)
