"""The answer of a diagnosis: verdict, causes with their values and gains, errors, maps and the extended parameter set."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from twintube.core import effects
from twintube.dampers import Damper
from twintube.data import LoadedDataset
from twintube.diagnosis.fits.candidates import RECALIBRATE, Candidate
from twintube.diagnosis.fits.fit import Fit, Free, Problem
from twintube.diagnosis.fits.gains import bootstrap, errors, floor, gains, whole, worst
from twintube.diagnosis.fits.options import Option, Selection
from twintube.diagnosis.measurement.faults import Fault
from twintube.diagnosis.measurement.repeats import only_noise
from twintube.diagnosis.result import Alternative, Cause, Diagnosis, Estimate, Gain, RecordResult, Signature, Tried
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.selection.select import Selector
from twintube.diagnosis.verdict.confidence import evidence, probabilities
from twintube.diagnosis.verdict.moved_zero import MOVED, NOT_THAT_OF_ALL, ZERO, moved_zero
from twintube.diagnosis.verdict.verdict import judge, sentence
from twintube.diagnosis.verdict.where import describe, maps, structured
from twintube.fitting.parameters import DEGRADATION

PUT_RIGHT = "faults were put right for everything shown here; their gain is relative to the force"
PREFERRED = "improves the held-out records nearly as much as the best of its round, and is simpler or predicts forces better"
BEGUN = (
    "a record that begins at an unknown temperature is shown with the one that its own errors ask for, which the extended "
    "parameter set cannot hold; state start_temperature_degC of each record"
)


def answer(
    dataset: LoadedDataset,
    problem: Problem,
    selector: Selector,
    selection: Selection,
    seen: Sequence[Signature],
    faults: Mapping[Fault, Gain],
) -> Diagnosis:
    """The diagnosis from the selection, the signatures `seen` in the records and the faults that were put right."""
    options = (selection.start, selection.recalibrated, selection.final)
    # What is not chosen is only shown beside it.
    refitted = [selector.refitted(option, thorough=option is selection.final) for option in options]
    extended = refitted[-1]
    fitted = simulated(selector.whole, "fit", [fit.values for fit in refitted])
    held = predictions(selector, options)
    predicted = {r.record.name for r in held}
    order = [record.name for record in problem.records]
    records = [*held, *(r for r in fitted if r.record.name not in predicted)]
    records.sort(key=lambda r: order.index(r.record.name))
    known = selector.candidates
    shares = gains(fitted), gains(held)
    gain = Gain(whole(shares[0]), whole(shares[1]), bootstrap(gains(held, parts=True)), worst(shares[1]))
    halves = selection.final.fits
    causes = [name for name in selection.chosen if name != RECALIBRATE]
    estimates = {name: estimated(selector.whole, known[name], extended, halves) for name in causes}
    attempts = tried(selector, selection)
    moved = moved_zero(held, selection.limit)
    unclear = only_noise(problem), moved is not None
    judgement = judge(selection, known, estimates, seen, errors(held), gain, list(faults), attempts, *unclear)
    residuals = maps(records)
    named = [*judgement.causes, *(fault.effect for fault in faults)]
    probable = evidence(judgement.verdict, named, [o.names[-1] for o in judgement.rivals], attempts)
    unlike = moved is not None and any(o.names[-1] == ZERO for o in judgement.rivals)  # which no row of the table is about
    if unlike:
        alike = max(probable.shares[name] for name in judgement.causes)
        probable = replace(probable, shares={**probable.shares, ZERO: alike})
    left = [describe(residuals, left=True)] if judgement.remaining == "unexplained" else []
    rivals = [(o, known[o.names[-1]]) for o in judgement.rivals]
    told_by = {c.name: apart(c) for _, c in rivals} | ({ZERO: MOVED} if moved is not None else {})

    def explained(rival: Option) -> float:
        return whole(gains(predictions(selector, (*options[:2], rival)), least=floor(held)))

    return Diagnosis(
        title=dataset.title,
        verdict=judgement.verdict,
        sentence=sentence(judgement, known, list(faults)),
        causes=[
            *(faulty(fault, gain) for fault, gain in faults.items()),
            *(Cause(name, known[name].title, known[name].cause, estimates[name], gain) for name in judgement.causes),
        ],
        alternatives=[
            Alternative(c.name, moved if c.name == ZERO and moved is not None else explained(o), told_by[c.name])
            for o, c in rivals
        ],
        errors={"fit": errors(fitted), "heldout": errors(held)},
        where=describe(residuals),
        signature="" if faults else "; ".join([signature.text for signature in seen] + left),
        maps=residuals,
        tried=attempts,
        records=records,
        base=dataset.damper,
        recalibrated=damper_of(dataset.damper, refitted[1], [RECALIBRATE], {}),
        extended=damper_of(dataset.damper, extended, judgement.kept, known),
        next_measurements=[told_by[c.name] for _, c in rivals],
        probabilities=probabilities(probable, known),
        structure={model: structured(records, model) for model in ("base", "recalibrated", "extended")},
        remarks=[
            *[PUT_RIGHT] * bool(faults),
            *[BEGUN] * bool(judgement.causes and problem.begun(extended.values)),
            *[NOT_THAT_OF_ALL] * unlike,
        ],
    )


def apart(candidate: Candidate) -> str:
    """What would tell a candidate from its look-alikes."""
    return f"{candidate.title}: {candidate.decides}"


def simulated(problem: Problem, split: str, models: Sequence[Mapping[str, float]]) -> list[RecordResult]:
    """The records with their base, recalibrated and extended simulation.

    All have the zeros of the load cell that the last model asks for: with zeros of its own a model without a preload would
    hide that.
    """
    measured = problem.measured
    forces = [problem.begun_forces(values) for values in models]
    zeros = problem.zeros(measured - forces[-1])
    base, recalibrated, extended = (force + zeros for force in forces)
    return [
        RecordResult(record, split, measured[a:b], base[a:b], recalibrated[a:b], extended[a:b], problem.weight[a:b])
        for record, a, b in zip(problem.records, problem.starts[:-1], problem.starts[1:], strict=True)
    ]


def predictions(selector: Selector, options: Sequence[Option]) -> list[RecordResult]:
    """The records that a fold holds out, simulated by base, recalibrated and extended model that do not know them."""
    results: dict[str, RecordResult] = {}
    for k, fold in enumerate(selector.folds):
        for r in simulated(fold.held, "heldout", [o.seen[k] for o in options]):
            before = results.get(r.record.name)
            results[r.record.name] = r if before is None else joined(before, r)
    return list(results.values())


def joined(first: RecordResult, second: RecordResult) -> RecordResult:
    """A record of which either fold holds parts out."""
    own = second.weight > 0
    arrays = {name: np.where(own, getattr(second, name), getattr(first, name))
              for name in ("measured", "base", "recalibrated", "extended", "weight")}  # fmt: skip
    return replace(first, record=replace(first.record, judged=first.record.judged | own), **arrays)


def estimated(problem: Problem, candidate: Candidate, fit: Fit, halves: Sequence[Fit] = ()) -> dict[str, Estimate]:
    """The parameters of a chosen cause with their intervals.

    Where a law is not quite that of the damper, records of other velocities ask for another value: an interval is not
    narrower than the scatter of the fits of the `halves` of the records makes it, and that of a strength not narrower than
    what laws differ by.
    """
    values = {}
    for f in candidate.joined(fit.values):
        at = [g.name for g in fit.free].index(f.name)
        scattered = float(np.sqrt(max(0.0, fit.covariance[at, at])))
        several = [half.values[f.name] for half in halves if f.name in half.values]
        between = float(np.std(several, ddof=1) / np.sqrt(len(several))) if len(several) > 1 else 0.0
        width = RULES.channel_width if candidate.fault else RULES.law_width
        law = width * abs(fit.values[f.name] - f.neutral) if f.neutral is not None else 0.0
        spread = max(RULES.interval * max(scattered, between), law)
        value = fit.values[f.name]
        low, high = max(f.low, value - spread), min(f.high, value + spread)
        if f.neutral is not None and low <= f.neutral <= high:
            near = RULES.interval * abs(value - f.neutral) / max(needed(problem, fit, f), 1e-9)
            low, high = (max(low, value - near), high) if value > f.neutral else (low, min(high, value + near))
        values[f.name] = Estimate(value, low, high, candidate.units[f.name], (f.low, f.high), f.start)
    return values


def needed(problem: Problem, fit: Fit, strength: Free) -> float:
    """By how many standard deviations a strength is off its neutral value: the root of the likelihood ratio.

    Where a strength and an onset trade off, the curvature at the optimum does not know that without the strength the
    records are not explained.
    """
    without = [replace(g, start=fit.values[g.name]) for g in fit.free if g.name != strength.name]
    neutral = problem.fit(without).values if without else {}
    costs = [float(np.sum(problem.shared(values) ** 2)) for values in (neutral, fit.values)]
    scatter = max(1.0, costs[1] / max(1, int(problem.counts.sum())))
    return float(np.sqrt(max(0.0, costs[0] - costs[1]) / scatter))


def faulty(fault: Fault, gain: Gain) -> Cause:
    """A fault of the measurement that was put right before anything was fitted."""
    factor = Estimate(fault.factor, fault.factor - fault.spread, fault.factor + fault.spread, fault.unit)
    return Cause(fault.effect, fault.title, fault.explanation, {fault.name: factor}, gain)


def damper_of(damper: Damper, fit: Fit, names: Sequence[str], known: Mapping[str, Candidate]) -> Damper:
    """The parameter set with recalibrated parameters and the effects that are named, not the faults of the measurement."""
    changes = {name: fit.values[name] for name in DEGRADATION if RECALIBRATE in names and name in fit.values}
    acting = []
    for name in names:
        if name in known and not known[name].fault:
            # The true fill of a single state belongs to its records.
            own = {f.name: fit.values[f.name] for f in known[name].joined(fit.values) if hasattr(damper.parameters, f.name)}
            changes |= own
            acting += [name] if own else []
    origin = {name: "added by diagnosis" for name in acting if name in effects.EFFECTS}
    origin |= {group: "recalibrated by diagnosis" for group in ("degradation", "foam", "cavitation") if RECALIBRATE in names}
    changed = replace(damper.with_(**changes), name=f"{damper.name}-extended") if changes else damper
    return replace(changed, sources=dict(damper.sources) | origin)


def tried(selector: Selector, selection: Selection) -> list[Tried]:
    """All candidates of all rounds; intervals by resampling the held-out records."""
    rows_of_table = []
    current = selection.start
    first = selector.logs(current.misfit)
    # An equal whole for every resample. The best model may take more away, as noise is known to some per cent; where hardly
    # anything is to be explained, what would be worth a cause.
    most = max(float((first - selector.logs(option.misfit)).sum()) for options in selection.rounds for option in options)
    total = max(float(np.maximum(first, 0.0).sum()), most, RULES.worth * selection.count)
    explainable = np.full(len(first), total / len(first))
    for n, options in enumerate(selection.rounds, start=1):
        best = min(options, key=lambda o: o.score)
        for k, option in enumerate(options):
            rows = np.column_stack([selector.logs(current.misfit) - selector.logs(option.misfit), explainable])
            gain = float(rows[:, 0].sum() / total)
            won = k == 0 and option.names[-1] in selection.chosen
            if won:
                most_of_all = option is best or not selector.acts(best)
                reason = "improves the held-out records most" if most_of_all else PREFERRED
            elif not selector.acts(option):
                reason = "is neutral, or not more than every measurement has"
            elif selector.usual(current, option, options):
                reason = "is explained nearly as well by what every measurement has"
            elif options[0].names[-1] in selection.chosen and option.score >= options[0].score:
                reason = "improves them less than the chosen candidate"
            else:
                beaten = "improves them less than the best of its round" if k else "is superfluous beside the other causes"
                reason = selector.against(current, option) or beaten
            row = Tried(
                n, option.names[-1], gain, bootstrap(rows, size=np.abs(rows[:, 0])), "chosen" if won else "rejected", reason
            )
            rows_of_table.append(row)
        current = options[0]
    return rows_of_table
