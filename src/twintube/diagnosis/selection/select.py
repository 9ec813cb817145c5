"""Which causes the records ask for: forward selection on whole held-out records."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from twintube.arrays import Array
from twintube.diagnosis.fits.calibration import best_calibration, calibration
from twintube.diagnosis.fits.candidates import DELAYED, LATE, MOVING, RECALIBRATE, Candidate, linear, nuisances
from twintube.diagnosis.fits.fit import Fit, Free, Problem
from twintube.diagnosis.fits.options import Fold, Option, Selection, fitted
from twintube.diagnosis.fits.starts import measured, start_cost, starts
from twintube.diagnosis.measurement.edges import less_noise
from twintube.diagnosis.records.seen import DELAY, MEASUREMENT
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.selection.choice import Chooser
from twintube.diagnosis.selection.rivals import general, leading, near


class Selector(Chooser):
    """Fits and compares models; `whole` holds the records that the final model is fitted to.

    The records to fit are balanced by its misfit, once, before anything is compared.
    Where the `history` of records is not known, other degradation parameters must leave noise alone: foam of before looks
    like them.
    """

    def __init__(
        self, whole: Problem, candidates: Sequence[Candidate], folds: Sequence[Fold], *, history: bool = True
    ) -> None:
        super().__init__(candidates, folds)
        self.history = history
        self.calibration = calibration(whole)
        self.point: dict[str, float] | None = None
        self.begun: dict[tuple[tuple[str, ...], str, tuple[str, ...]], list[dict[str, float]]] = {}  # where candidates begin
        self.begin(whole, folds)

    def begin(self, whole: Problem, folds: Sequence[Fold]) -> None:
        """Fit the model without a cause."""
        self.start = fitted(folds, (), [self.of_measurement(whole, ())] * len(folds))
        first = self.start.fits[0].values
        self.whole = whole.balanced(whole.misfits(whole.residual(first)))
        pairs = zip(folds, self.start.fits, strict=True)
        self.folds = [replace(fold, fitted=fold.fitted.balanced(fit.misfit)) for fold, fit in pairs]
        self.sketches, self.wider = (
            [fold.fitted.sparse(most, fit.misfit) for fold, fit in zip(self.folds, self.start.fits, strict=True)]
            for most in (RULES.start_records, RULES.start_moving)
        )

    def option(self, names: Sequence[str], frees: Sequence[Sequence[Free]]) -> Option:
        """The model with some causes, fitted in every fold of balanced records."""
        return fitted(self.folds, names, frees)

    def free(self, names: Sequence[str], values: Mapping[str, float]) -> list[Free]:
        """The free parameters of a model, from the values where they are known."""
        wanted = {f.name: f for f in self.of_measurement(self.whole, names)}
        for name in names:
            added = self.known(name).joined(values)
            if name in self.sampling:
                least = self.candidates[name].least
                added = tuple(replace(f, low=max(f.low, f.start - least[f.name]), high=min(f.high, f.start + least[f.name]))
                              if f.name in least else f for f in added)  # fmt: skip
            wanted |= {f.name: f for f in added}
        return [replace(f, start=min(max(values.get(name, f.start), f.low), f.high)) for name, f in wanted.items()]

    @staticmethod
    def of_measurement(problem: Problem, names: Sequence[str]) -> list[Free]:
        """What of the measurement is free in a model: the delay, known from all records, beside what is late itself."""
        return [f for f in nuisances(problem) if f.name != DELAY or any(name in (*LATE, *DELAYED) for name in names)]

    def beginning(self, current: Option, name: str) -> tuple[float, list[dict[str, float]]]:
        """Where a further cause begins in all folds, a simple point and the best, and the sum of squares at the latter.

        From starts of their own the folds may end in different laws, of which a single law holds for the others' records.
        A search is not repeated where only the noise of the same records is known better. What moves steps of the force is
        sought in more records: a few are explained by many strengths.
        """
        fixed = [fit.values for fit in current.fits]
        key = (current.names, name, tuple(record.name for sketch in self.sketches for record in sketch.records))
        if key not in self.begun:
            looked_at = self.wider if name in MOVING else self.sketches
            self.begun[key] = starts(looked_at, self.known(name), fixed, self.whole)[1]
        points = self.begun[key]
        return start_cost(self.sketches, points[-1], fixed, measured(name, self.whole)), points

    def extended(self, current: Option, name: str, begin: Mapping[str, float] | None = None) -> Option:
        """The current model with a further cause, from its best start where no other is given.

        With many strengths a fit may end beside that of the simple point, so that this is fitted, too, and preferred.
        """
        points = [begin] if begin is not None else self.beginning(current, name)[1]
        names = [*current.names, name]
        several = [
            self.option(names, [self.free(names, {**fit.values, **point}) for fit in current.fits]) for point in points
        ]
        costs = [self.fitted_cost(option) for option in several]
        return several[-1] if costs[-1] < costs[0] - self.limit else several[0]  # noise asks for further strengths, too

    def fitted_cost(self, option: Option) -> float:
        """Sum of squares in the records that a model was fitted to."""
        pairs = zip(self.folds, option.fits, strict=True)
        return sum(float(np.sum(fold.fitted.shared(fit.values) ** 2)) for fold, fit in pairs)

    def refitted(self, option: Option, *, thorough: bool) -> Fit:
        """The model of an option fitted to the whole, from the better of the folds' optima."""
        starts = [self.free(option.names, fit.values) for fit in option.fits]
        costs = [float(np.sum(self.whole.shared(fit.values) ** 2)) for fit in option.fits]
        return self.whole.fit(starts[int(np.argmin(costs))], thorough=thorough)

    def run(self, progress: Callable[[str], None]) -> Selection:
        """Add the cause that improves the held-out records most, until none is worth it; then drop the superfluous."""
        recalibrated, options = self.single(progress)
        for _ in range(RULES.noise_rounds):
            if not self.quieter(options):
                break
            recalibrated, options = self.single(progress)
        if self.seen_through_sampling(self.start, options):
            recalibrated, options = self.single(progress, "a single cause, sampling known")
        current, rounds = self.added(options, progress)
        # A cause that is far larger hides at first what the sampling does.
        if not self.sampling and self.seen_through_sampling(current, rounds[-1]):
            recalibrated, options = self.single(progress, "a single cause, sampling known")
            current, rounds = self.added(options, progress)
        current, rounds = self.simpler(current, rounds, progress)
        current = self.exchanged(self.pruned(current, progress), progress)
        if RECALIBRATE in current.names and rounds[0][0].names[-1] == RECALIBRATE:
            current = rounds[0][0]  # what a calibration leaves is its own formulation; else it had been superfluous
        neutral = tuple(option.names[-1] for option in rounds[0] if not self.acts(option))
        selection = Selection(self.start, rounds, [], current, recalibrated, self.count, self.limit, neutral, [])
        selection = self.chosen(selection, current)
        if len(selection.chosen) < 2:
            return selection
        several = self.beside(selection, progress)
        better = min(several, key=lambda o: o.score, default=current)
        if better is not current and self.acts(better) and self.worth(current, better):
            selection = self.chosen(selection, better)
            several = self.beside(selection, progress)
        return replace(selection, beside=several)

    def added(self, options: Sequence[Option], progress: Callable[[str], None]) -> tuple[Option, list[list[Option]]]:
        """The model with cause after cause, and what was tried in each round; `options` are the first."""
        current, rounds = self.start, []
        while True:
            taken = self.taken(current, options)
            if taken is not None and self.preferred(current, self.shortest(current, options)) and taken.names[-1] in LATE:
                taken = None
            rounds.append(list(options) if taken is None else [taken, *(o for o in options if o is not taken)])
            if taken is None:
                break
            current = taken
            if len(rounds) == RULES.rounds or self.enough(current):
                break
            options = self.tried(current, f"a further cause, {len(rounds) + 1} in all", RULES.further_fits, progress)
        return current, rounds

    def simpler(
        self, current: Option, rounds: list[list[Option]], progress: Callable[[str], None]
    ) -> tuple[Option, list[list[Option]]]:
        """A simpler law of the kind of a single cause, with a further cause, where both are better than that cause alone.

        A law of many parameters follows a simpler law and some of another cause, too.
        """
        first = rounds[0]
        gained = RULES.near_best * (self.start.score - first[0].score)
        laws = [o for o in first[1:] if general(first[0], o) and self.acts(o) and self.start.score - o.score >= gained]
        if current is not first[0] or not laws:
            return current, rounds
        law = laws[0]
        options = self.tried(law, f"a cause beside {law.names[-1]}", RULES.further_fits, progress)
        taken = self.taken(law, options)
        if taken is None or current.score - taken.score <= self.limit:
            return current, rounds
        rest = [[o for o in options if o is not best] for options, best in ((first, law), (options, taken))]
        return taken, [[law, *rest[0]], [taken, *rest[1]]]

    def chosen(self, selection: Selection, final: Option) -> Selection:
        """The selection with a final model."""
        return replace(selection, final=final, chosen=[name for name in final.names if name not in self.sampling])

    def beside(self, selection: Selection, progress: Callable[[str], None]) -> list[Option]:
        """The final model of several causes with each rival of the leading cause in its place, the rival last."""
        best, options = leading(selection), []
        for rival in near(selection, left=True):
            name, first = rival.names[-1], best.names[-1] if best else ""
            progress(f"{name} instead of {first}")
            names = [*(other for other in selection.final.names if other != first), name]
            pairs = zip(selection.final.fits, rival.fits, strict=True)
            options.append(self.option(names, [self.free(names, {**own.values, **fit.values}) for own, fit in pairs]))
        return options

    def single(self, progress: Callable[[str], None], label: str = "a single cause") -> tuple[Option, list[Option]]:
        """The calibration, and all models of a single cause that were fitted, best first."""
        options = self.tried(self.start, label, RULES.first_fits, progress)
        # Where a model is right there is nothing to calibrate.
        if self.right(self.start):
            recalibrated = self.extended(self.start, RECALIBRATE, {})
        elif any(self.acts(o) and self.right(o) for o in options):
            recalibrated = self.extended(self.start, RECALIBRATE)
        else:
            progress(f"{label}: degradation parameters")
            recalibrated = self.extended(self.start, RECALIBRATE, self.calibrated())
        # Foam and gas of an unknown history are followed in part, too.
        left = self.excess(recalibrated) / max(self.excess(self.start), 1.0)
        shown = [recalibrated] if self.history or self.enough(recalibrated) or left <= RULES.unknown_history else []
        return recalibrated, sorted([*options, *shown], key=lambda o: (not self.acts(o), o.score))

    def calibrated(self) -> dict[str, float]:
        """Where a thorough search for the degradation parameters ends; noise read anew does not move it."""
        if self.point is None:
            fixed = [fit.values for fit in self.start.fits]
            self.point = best_calibration(self.sketches, self.calibration, fixed)
        return self.point

    def quieter(self, options: Sequence[Option]) -> bool:
        """Begin again with less noise where better models show that it is less."""
        better = [option for option in options if self.start.score - option.score > self.limit]
        noise: dict[str, Array] = {}
        for k, fold in enumerate(self.folds):
            for problem in (fold.fitted, fold.held):
                noise |= less_noise(problem, [option.seen[k] for option in better], noise)
        known = {record.name: record.noise for record in self.records}
        if all(np.median(row / known[name]) > RULES.quieter for name, row in noise.items() if name in known):
            return False

        def heard(problem: Problem) -> Problem:
            return problem.with_records([replace(r, noise=noise.get(r.name, r.noise)) for r in problem.records])

        self.begin(heard(self.whole), [Fold(heard(fold.fitted), heard(fold.held)) for fold in self.folds])
        self.records = [record for fold in self.folds for record in fold.held.records]
        return True

    def seen_through_sampling(self, current: Option, options: Sequence[Option]) -> bool:
        """Whether something too short for the sampling explains most of what a model leaves; it joins every model then."""
        taken, best = self.taken(current, options), self.shortest(current, options)
        if best is None:
            return False
        if taken is not None and taken.score <= best.score and not self.preferred(current, best):
            return False
        self.sampling = best.names[-1:]
        self.start = self.option(self.sampling, [self.free(self.sampling, fit.values) for fit in best.fits])
        return True

    def shortest(self, current: Option, options: Sequence[Option]) -> Option | None:
        """The best of what is too short for the sampling and explains more than noise; None where nothing does."""
        short = [o for o in options if o.names[-1] != RECALIBRATE and self.short(o) and self.worth(current, o)]
        return min(short, key=lambda o: o.score, default=None)

    def preferred(self, current: Option, short: Option | None) -> bool:
        """Whether beside a cause what every measurement has leaves noise alone: nothing else is asked for then."""
        return short is not None and bool(current.names) and short.score <= RULES.right * self.count

    def tried(self, current: Option, label: str, most: int, progress: Callable[[str], None]) -> list[Option]:
        """The current model with a further cause, best first, of those with the best starts the `most`."""
        begins = {}
        for name in self.candidates:
            if name not in current.names and not self.alike(name, current.names):
                progress(f"{label}: start of {name}")
                begins[name] = self.beginning(current, name)
        # What needs no simulation is always fitted, others where their start promises anything.
        enough = (1.0 - RULES.promise) * self.sketched(current)
        quick = [name for name in begins if name in MEASUREMENT]
        slow = sorted((name for name in begins if name not in quick), key=lambda name: begins[name][0])
        options = []
        for name in (*(name for name in slow[:most] if begins[name][0] < enough), *quick):
            progress(f"{label}: {name}")
            options.append(self.extended(current, name))
        return sorted(options, key=lambda o: (not self.acts(o), o.score))

    def sketched(self, current: Option) -> float:
        """The sum of squares of a model in these records."""
        return start_cost(self.sketches, {}, [fit.values for fit in current.fits], linear(self.whole))

    def exchanged(self, current: Option, progress: Callable[[str], None]) -> Option:
        """With each of several causes exchanged for another where that is better: the first was chosen alone.

        Where noise alone is left no other can be.
        """
        causes = [name for name in current.names if name not in self.sampling]
        for name in causes if len(causes) > 1 and current.score > RULES.right * self.count else ():
            others = [other for other in current.names if other != name]
            rest = self.option(others, [self.free(others, fit.values) for fit in current.fits])
            best = self.tried(rest, f"instead of {name}", RULES.further_fits, progress)[0]
            if self.acts(best) and self.worth(current, best):
                current = best
        return current

    def pruned(self, current: Option, progress: Callable[[str], None]) -> Option:
        """Without the causes that the others make superfluous, such as a calibration that stood in for an effect."""
        while len(causes := [name for name in current.names if name not in self.sampling]) > 1:
            without = []
            for name in causes:
                progress(f"without {name}")
                rest = [other for other in current.names if other != name]
                without.append(self.option(rest, [self.free(rest, fit.values) for fit in current.fits]))
            # Not only the cause that matters least: a calibration may lower the misfit more and still raise the error.
            superfluous = [option for option in without if not self.worth(option, current)]
            if not superfluous:
                return current
            current = min(superfluous, key=lambda o: o.score)
        return current
