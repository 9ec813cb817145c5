"""The verdict and everything that it rests on."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from twintube.arrays import Array
from twintube.core import effects
from twintube.dampers import Damper
from twintube.data import LoadedDataset
from twintube.diagnosis.candidates import BASE, Candidate
from twintube.diagnosis.fit import Fit, Free, Problem
from twintube.diagnosis.result import Alternative, Cause, Diagnosis, Errors, Found, Gain, RecordResult, Signature, Tried
from twintube.diagnosis.select import CLOSE, RECALIBRATE, RIGHT, WORTH, Option, Selection, Selector, bootstrap, removed
from twintube.diagnosis.where import describe, maps, structured

EXPLAINED = 0.5  # least share of the explainable squared error that causes must explain to be named
SHOWS = 0.3  # of the base model's error: a signature that stands for less is only mentioned
AT_BOUND = 1e-3  # of a parameter's range: nearer to its end the range decides, not the records
WIDE = 0.5  # of its range: a wider interval says nothing
LEVEL = 1.96  # standard deviations of a 95 % interval


def answer(
    dataset: LoadedDataset, problem: Problem, selector: Selector, selection: Selection, seen: Sequence[Signature]
) -> Diagnosis:
    """The diagnosis from what was selected and from the signatures `seen` in the records."""
    close = rivals(selection)
    options = (selection.start, selection.recalibrated, selection.final)
    refitted = [selector.refitted(option) for option in options]
    extended = refitted[-1]
    fitted = simulated(selector.whole, "fit", [fit.values for fit in refitted])
    held = predictions(selector, options)
    predicted = {r.case.name for r in held}
    order = [case.name for case in problem.cases]
    records = sorted([*held, *(r for r in fitted if r.case.name not in predicted)], key=lambda r: order.index(r.case.name))
    outside = [one for one in seen if one.size > SHOWS * rms(held)]
    verdict = "unexplained" if outside else judged(selection, selector, close)
    n = selection.count
    effective = [name for name in selection.chosen if name != RECALIBRATE]
    named = effective if verdict in ("cause", "ambiguous", "measurement_fault") else []
    close = close if verdict == "ambiguous" else []
    causes = [cause(selector.candidates[name], extended, gains(fitted), gains(held)) for name in named]
    kept = selection.chosen if named or verdict == "recalibrate" else []
    nearest = [selector.candidates[name].title for name in effective] if verdict == "unexplained" else []
    residuals = maps(records)
    where = [describe(residuals, left=True)] if verdict == "unexplained" else []
    return Diagnosis(
        title=dataset.title,
        verdict=verdict,
        sentence=sentence(
            verdict, causes, close, outside, nearest, removed(selection.start.score, selection.final.score, n)
        ),
        causes=causes,
        alternatives=[
            Alternative(o.names[-1], removed(selection.start.score, o.score, n), apart(selector.candidates[o.names[-1]]))
            for o in close
        ],
        errors={"fit": errors(fitted), "heldout": errors(held)},
        where=describe(residuals),
        signature="; ".join([one.text for one in seen] + where),
        maps=residuals,
        tried=tried(selector, selection),
        records=records,
        base=dataset.damper,
        recalibrated=damper_of(dataset.damper, refitted[1], [RECALIBRATE], {}),
        extended=damper_of(dataset.damper, extended, kept, selector.candidates),
        next_measurements=[apart(selector.candidates[o.names[-1]]) for o in close],
        structure={model: structured(records, model) for model in ("base", "recalibrated", "extended")},
    )


def judged(selection: Selection, selector: Selector, close: Sequence[Option]) -> str:
    """The verdict as far as the candidates tell it."""
    explained = removed(selection.start.score, selection.final.score, selection.count)
    right = selection.final.score <= RIGHT * selection.count
    chosen = [name for name in selection.chosen if name != RECALIBRATE]
    if not selection.chosen:
        return "none" if right else "unexplained"
    if explained < EXPLAINED and not right:
        return "unexplained"
    if not chosen:
        return "recalibrate"
    if close:
        return "ambiguous"
    return "measurement_fault" if selector.candidates[chosen[0]].fault else "cause"


def rms(records: Sequence[RecordResult]) -> float:
    """Force error of the base model [N]."""
    return float(np.sqrt(np.mean(np.concatenate([(r.base - r.measured)[1:] ** 2 for r in records]))))


def rivals(selection: Selection) -> list[Option]:
    """Options of the first round that are as good as the chosen one."""
    best, *others = selection.rounds[0]
    if best.names[-1] == RECALIBRATE or not selection.chosen:
        return []
    margin = max(selection.limit, CLOSE * max(selection.start.score - best.score, 0.0))
    return [o for o in others if 0.0 <= o.score - best.score <= margin and o.names[-1] != RECALIBRATE][:3]


def apart(candidate: Candidate) -> str:
    """What would tell a candidate from its look-alikes."""
    return f"{candidate.title}: {candidate.decides}"


def simulated(problem: Problem, split: str, models: Sequence[Mapping[str, float]]) -> list[RecordResult]:
    """The records with their base, recalibrated and extended simulation, read with the last one's delay.

    A model with another delay is shifted by what that changes in the measured force, so that its error is its own. All have
    the zeros of the load cell that the last one asks for: with zeros of its own a model without a preload would hide that.
    """
    measured = problem.target(models[-1])
    forces = [problem.forces(values) + measured - problem.target(values) for values in models]
    zeros = problem.zeros(measured - forces[-1])
    forces = [force + zeros for force in forces]
    found = []
    for case, a, b in zip(problem.cases, problem.starts[:-1], problem.starts[1:], strict=True):
        found.append(RecordResult(case, split, measured[a:b], *(force[a:b] for force in forces)))
    return found


def predictions(selector: Selector, options: Sequence[Option]) -> list[RecordResult]:
    """The records that a fold holds out, simulated by base, recalibrated and extended model that do not know them."""
    several = enumerate(selector.folds)
    return [r for k, fold in several for r in simulated(fold.held, "heldout", [o.fits[k].values for o in options])]


def errors(some: Sequence[RecordResult]) -> dict[str, Errors]:
    """Force and work errors over some records."""
    found = {}
    for name in ("base", "recalibrated", "extended"):
        squares = np.concatenate([((getattr(r, name) - r.measured)[1:]) ** 2 for r in some])
        works = np.array([float(np.sum((getattr(r, name) - r.measured)[1:] * np.diff(r.case.stroke))) for r in some])
        turns = np.array([max(1, len(np.unique(r.case.cycle[r.case.cycle >= 0]))) for r in some])
        found[name] = Errors(float(np.sqrt(squares.mean())), float(np.sqrt(np.mean((works / turns) ** 2))))
    noise = np.concatenate([r.case.noise[1:] ** 2 for r in some])
    found["noise_floor"] = Errors(float(np.sqrt(noise.mean())), 0.0)
    return found


def gains(records: Sequence[RecordResult]) -> Array:
    """Squared error that goes away and that is explainable (r, 2) [N2] per record."""
    rows = []
    for r in records:
        base, extended = (float(np.sum((force - r.measured)[1:] ** 2)) for force in (r.base, r.extended))
        noise = float(np.sum(r.case.noise[1:] ** 2))
        rows.append((base - max(extended, noise), max(base - noise, 1e-9)))
    return np.array(rows)


def cause(candidate: Candidate, fit: Fit, fitted: Array, held: Array) -> Cause:
    """One chosen cause with its parameters and the gain (r, 2) of the whole model on fitted and held-out records."""
    parameters = {}
    for f in candidate.free:
        at = [g.name for g in fit.free].index(f.name)
        spread = LEVEL * float(np.sqrt(max(0.0, fit.covariance[at, at])))
        value = fit.values[f.name]
        low, high = max(f.low, value - spread), min(f.high, value + spread)
        parameters[f.name] = Found(value, low, high, candidate.units[f.name], doubt(f, value, high - low))
    return Cause(
        candidate.name, candidate.title, candidate.cause, parameters,
        Gain(
            fit=float(fitted[:, 0].sum() / fitted[:, 1].sum()),
            heldout=float(held[:, 0].sum() / held[:, 1].sum()),
            heldout_interval=bootstrap(held),
            worst_record=worst(held),
        ),
    )  # fmt: skip


def doubt(free: Free, value: float, interval: float) -> str:
    """Why the value of a parameter is not to be relied on, if there is a reason."""
    neutral = free.start in (free.low, free.high) and abs(value - free.start) < AT_BOUND * free.width
    if min(value - free.low, free.high - value) < AT_BOUND * free.width and not neutral:
        return f"at the end of its range, {free.low:g} to {free.high:g}"
    return "not determined by these records" if interval > WIDE * free.width else ""


def worst(held: Array) -> float:
    """Gain of the record that gains least, of those that hold at least 1 % of the explainable error."""
    some = held[held[:, 1] >= 0.01 * held[:, 1].sum()]
    return float((some[:, 0] / some[:, 1]).min())


def damper_of(damper: Damper, fit: Fit, names: Sequence[str], known: dict[str, Candidate]) -> Damper:
    """The parameter set with what was found: recalibrated parameters and effects, not the faults of the measurement."""
    changes = {name: fit.values[name] for name in BASE if RECALIBRATE in names and name in fit.values}
    for name in names:
        if name in known and not known[name].fault:
            changes |= {f.name: fit.values[f.name] for f in known[name].free}
    origin = {name: "found by diagnosis" for name in names if name != RECALIBRATE and name in effects.EFFECTS}
    origin |= {group: "recalibrated by diagnosis" for group in ("degradation", "foam", "cavitation") if RECALIBRATE in names}
    found = damper.with_(**changes) if changes else damper
    return replace(found, sources=dict(damper.sources) | origin)


def tried(selector: Selector, selection: Selection) -> list[Tried]:
    """All candidates of all rounds; intervals by resampling the held-out records."""
    found = []
    current = selection.start
    first = selector.logs(current.misfit)
    # The same whole for every resample; where hardly anything is to be explained, what would be worth a cause.
    whole = max(float(np.maximum(first, 0.0).sum()), WORTH * selection.count)
    explainable = np.full(len(first), whole / len(first))
    for n, options in enumerate(selection.rounds, start=1):
        for k, option in enumerate(options):
            rows = np.column_stack([selector.logs(current.misfit) - selector.logs(option.misfit), explainable])
            gain = float(rows[:, 0].sum() / whole)
            won = k == 0 and option.names[-1] in selection.chosen
            if won:
                reason = "improves the held-out records most"
            elif not selector.acts(option):
                reason = "is neutral, or no more than every measurement has"
            elif options[0].names[-1] in selection.chosen:
                reason = "improves them less than the chosen one"
            else:
                reason = "improves the held-out records by no more than noise and numerics would"
            found.append(Tried(n, option.names[-1], gain, bootstrap(rows), "chosen" if won else "rejected", reason))
        current = options[0]
    return found


def sentence(
    verdict: str,
    causes: Sequence[Cause],
    close: Sequence[Option],
    outside: Sequence[Signature],
    nearest: Sequence[str],
    explained: float,
) -> str:
    """The verdict in one sentence; `explained` is the share of the squared error, in the geometric mean over the records.

    `nearest` are the titles of what is chosen and explains too little to be named.
    """
    gain = f"{100 * explained:.0f} % of the explainable squared error of a typical held-out record goes away"
    if outside:
        return f"No known cause explains the records: {outside[0].text}."
    if verdict == "none":
        return "Nothing is missing: the simulation agrees with the held-out records within their noise."
    if verdict == "recalibrate":
        return "No effect is missing: other values of the degradation parameters explain the records."
    if verdict == "unexplained":
        near = f"; with what comes nearest, {joined(nearest)}, {gain}" if nearest else ""
        return f"The simulation is wrong in a way that no known cause explains{near}."
    what = joined([cause.title for cause in causes])
    if verdict == "ambiguous":
        others = " or ".join(o.names[-1].replace("_", " ") for o in close)
        return f"Two causes explain the records alike, {what}, and {others}: they cannot be told apart here ({gain})."
    if verdict == "measurement_fault":
        return f"The measurement is faulty: {what} ({gain})."
    return f"The cause: {what}. {gain}."


def joined(titles: Sequence[str]) -> str:
    """Titles in the middle of a sentence."""
    return " and ".join(title[0].lower() + title[1:] for title in titles)
