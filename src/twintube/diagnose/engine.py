"""From a dataset to its diagnosis."""

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from twintube import effects
from twintube.arrays import Array
from twintube.data import LoadedDataset
from twintube.diagnose.candidates import BASE, Candidate, candidates
from twintube.diagnose.faults import Fault, read, scaled, unit_error
from twintube.diagnose.fit import LEAST_MISFIT, Fit, Problem
from twintube.diagnose.prepare import Case, prepare
from twintube.diagnose.result import Alternative, Cause, Diagnosis, Errors, Found, Gain, RecordResult, Tried
from twintube.diagnose.select import (
    CLOSE,
    RECALIBRATE,
    RIGHT,
    WORTH,
    Option,
    Selection,
    Selector,
    bootstrap,
    removed,
)
from twintube.diagnose.where import describe, maps
from twintube.parameters import Damper
from twintube.simulate import InputError

SAME_SPEED = 1.05  # velocities within 5 % are one
HELD_OUT = (3, 2)  # every third velocity from the third on, never the highest
EXPLAINED = 0.5  # least share of the explainable squared error that causes must explain to be named
LEVEL = 1.96  # standard deviations of a 95 % interval


def diagnose(path: str | Path, progress: Callable[[str], None] = lambda text: None) -> Diagnosis:
    """Diagnose a dataset folder.

    Raises DataError with all defects of the records, and InputError where they do not allow to judge on held-out ones.
    """
    began = time.monotonic()
    dataset, fault = read(path)
    cases = prepare(dataset)
    fitted, held, remarks = split(dataset.title, cases)
    problem = recorded = Problem(dataset.damper, cases)
    wrong, problem = unit_error(problem)
    if fault is not None:
        recorded = recorded.with_cases([scaled(case, fault.factor, 1.0) for case in cases])
    selector = Selector(problem, candidates(problem), fitted, held)
    selection = selector.run(progress)
    found = answer(dataset, problem, selector, selection, fitted, held)
    for one in (wrong, fault):
        if one is not None:
            found = faulty(found, one, repaired(recorded, problem, fitted, held))
    return replace(found, remarks=[*remarks, *found.remarks], seconds=time.monotonic() - began)


def repaired(recorded: Problem, problem: Problem, fitted: Sequence[int], held: Sequence[int]) -> Gain:
    """What putting a fault right gains for the base model: errors relative to the force, as units and signs differ."""

    def shares(p: Problem) -> Array:
        forces = p.forces({})
        rows = []
        for case, a, b in zip(p.cases, p.starts[:-1] + 1, p.starts[1:], strict=True):
            size = float(np.sum(p.measured[a:b] ** 2))
            rows.append(
                (float(np.sum((forces[a:b] - p.measured[a:b]) ** 2)) / size, float(np.sum(case.noise[1:] ** 2)) / size)
            )
        return np.array(rows)

    before, after = shares(recorded), shares(problem)
    gone = before[:, 0] - np.maximum(after[:, 0], after[:, 1])
    rows = np.column_stack([gone, np.maximum(before[:, 0] - after[:, 1], 1e-9)])
    some, other = rows[list(fitted)], rows[list(held)]
    return Gain(
        fit=float(some[:, 0].sum() / some[:, 1].sum()),
        heldout=float(other[:, 0].sum() / other[:, 1].sum()),
        heldout_interval=bootstrap(other),
        worst_record=worst(other),
    )


def faulty(found: Diagnosis, fault: Fault, gain: Gain) -> Diagnosis:
    """The diagnosis of a measurement with a fault that was put right before anything was fitted."""
    factor = Found(fault.factor, fault.factor, fault.factor, "1")
    first = Cause(fault.effect, fault.title, fault.explanation, {"factor": factor}, gain)
    text = f"The measurement is faulty: {fault.explanation[0].lower()}{fault.explanation[1:]}"
    return replace(
        found,
        verdict="measurement_fault",
        causes=[first, *found.causes],
        sentence=f"{text} With it put right: {found.sentence}",
        signature="",
        remarks=[*found.remarks, "the fault was put right for everything shown here; its gain is relative to the force"],
    )


def split(title: str, cases: Sequence[Case]) -> tuple[list[int], list[int], list[str]]:
    """The numbers of the fitted and of the held-out cases, whole velocities apart, and what was decided here."""
    if len(cases) < 2:
        raise InputError(f"{title}: {len(cases)} record, at least two are needed: one to fit, one to judge on")
    if any(case.split for case in cases):
        held = [i for i, case in enumerate(cases) if case.split == "heldout"]
        fitted = [i for i in range(len(cases)) if i not in held]
        if not fitted or not held:
            raise InputError(f"{title}: {len(held)} of {len(cases)} records are held out, some must be and some must not")
        return fitted, held, []
    speeds: list[float] = []
    for v in sorted(case.top_speed for case in cases if case.measurement != "quasi-static"):
        if not speeds or v > SAME_SPEED * speeds[-1]:
            speeds.append(v)
    if len(speeds) < 2:
        raise InputError(f"{title}: all records have one velocity; split them in dataset.toml (split = 'heldout')")
    every, first = HELD_OUT
    out = [v for i, v in enumerate(speeds[:-1]) if i % every == min(first, len(speeds) - 2)]
    held = [
        i for i, case in enumerate(cases)
        if case.measurement != "quasi-static" and any(v <= case.top_speed <= SAME_SPEED * v for v in out)
    ]  # fmt: skip
    told = ", ".join(f"{v:.3g}" for v in out)
    return [i for i in range(len(cases)) if i not in held], held, [f"held out: the records at {told} m/s"]


def answer(
    dataset: LoadedDataset, problem: Problem, selector: Selector, selection: Selection, fitted: list[int], held: list[int]
) -> Diagnosis:
    """The verdict and everything that it rests on."""
    chosen = [name for name in selection.chosen if name != RECALIBRATE]
    n = selection.count
    explained = removed(selection.start.score, selection.final.score, n)
    faults = [name for name in chosen if selector.candidates[name].fault]
    close = rivals(selection) if chosen else []
    right = selection.final.score / n <= RIGHT
    if not selection.chosen:
        verdict = "none" if right else "unexplained"
    elif not chosen:
        verdict = "recalibrate" if right or explained >= EXPLAINED else "unexplained"
    elif explained < EXPLAINED and not right:
        verdict = "unexplained"
    elif faults and chosen[0] == faults[0]:
        verdict = "measurement_fault"
    else:
        verdict = "ambiguous" if close else "cause"
    records = results(problem, selection, held)
    named = chosen if verdict in ("cause", "ambiguous", "measurement_fault") else []
    causes = [cause(problem, selector, selection, name, records) for name in named]
    extended = damper_of(dataset.damper, selection.final.fit, selection.chosen, selector.candidates)
    text = sentence(verdict, causes, close)
    residuals = maps(records)
    return Diagnosis(
        title=dataset.title,
        verdict=verdict,
        sentence=text,
        causes=causes,
        alternatives=[
            Alternative(o.names[-1], removed(selection.start.score, o.score, n), apart(selector.candidates[o.names[-1]]))
            for o in close
        ],
        errors={kind: errors(records, kind) for kind in ("fit", "heldout")},
        where=describe(residuals),
        signature=describe(residuals, left=True) if verdict == "unexplained" else "",
        maps=residuals,
        tried=tried(problem, selection, held),
        records=records,
        base=dataset.damper,
        recalibrated=damper_of(dataset.damper, selection.recalibrated.fit, [RECALIBRATE], {}),
        extended=extended,
        next_measurements=[apart(selector.candidates[o.names[-1]]) for o in close],
    )


def rivals(selection: Selection) -> list[Option]:
    """Options of the first round that are as good as the chosen one."""
    best, *others = selection.rounds[0]
    if best.names[-1] == RECALIBRATE:
        return []
    margin = max(selection.limit, CLOSE * max(selection.start.score - best.score, 0.0))
    return [o for o in others if o.score - best.score <= margin and o.names[-1] != RECALIBRATE][:3]


def apart(candidate: Candidate) -> str:
    """What would tell a candidate from its look-alikes."""
    return f"{candidate.title}: {candidate.decides}"


def results(problem: Problem, selection: Selection, held: Sequence[int]) -> list[RecordResult]:
    """Every record with its simulations, read with the zero and the delay that were found."""
    final = selection.final.fit.values
    measured = problem.target(final)
    base = selection.start.fit
    found = []
    for i, case in enumerate(problem.cases):
        part = slice(int(problem.starts[i]), int(problem.starts[i + 1]))
        forces = (base.forces[part], selection.recalibrated.fit.forces[part], selection.final.fit.forces[part])
        found.append(RecordResult(case, "heldout" if i in held else "fit", measured[part], *forces))
    return found


def errors(records: Sequence[RecordResult], kind: str) -> dict[str, Errors]:
    """Force and work errors over the records of a split."""
    some = [r for r in records if r.split == kind]
    found = {}
    for name in ("base", "recalibrated", "extended"):
        squares = np.concatenate([((getattr(r, name) - r.measured)[1:]) ** 2 for r in some])
        works = np.array([float(np.sum((getattr(r, name) - r.measured)[1:] * np.diff(r.case.stroke))) for r in some])
        turns = np.array([max(1, len(np.unique(r.case.cycle[r.case.cycle >= 0]))) for r in some])
        found[name] = Errors(float(np.sqrt(squares.mean())), float(np.sqrt(np.mean((works / turns) ** 2))))
    noise = np.concatenate([r.case.noise[1:] ** 2 for r in some])
    found["noise_floor"] = Errors(float(np.sqrt(noise.mean())), 0.0)
    return found


def gains(records: Sequence[RecordResult], kind: str) -> Array:
    """Squared error that goes away and that is explainable (r, 2) [N2] per record of a split."""
    rows = []
    for r in records:
        if r.split == kind:
            base, extended = (float(np.sum((getattr(r, name) - r.measured)[1:] ** 2)) for name in ("base", "extended"))
            noise = float(np.sum(r.case.noise[1:] ** 2))
            rows.append((base - max(extended, noise), max(base - noise, 1e-9)))
    return np.array(rows)


def cause(problem: Problem, selector: Selector, selection: Selection, name: str, records: Sequence[RecordResult]) -> Cause:
    """One chosen cause with its parameters and the gain of the whole model."""
    candidate = selector.candidates[name]
    fit = selection.final.fit
    parameters = {}
    for f in candidate.free:
        at = [g.name for g in fit.free].index(f.name)
        spread = LEVEL * float(np.sqrt(max(0.0, fit.covariance[at, at])))
        value = fit.values[f.name]
        parameters[f.name] = Found(value, max(f.low, value - spread), min(f.high, value + spread), candidate.units[f.name])
    fitted, held = gains(records, "fit"), gains(records, "heldout")
    return Cause(
        name, candidate.title, candidate.cause, parameters,
        Gain(
            fit=float(fitted[:, 0].sum() / fitted[:, 1].sum()),
            heldout=float(held[:, 0].sum() / held[:, 1].sum()),
            heldout_interval=bootstrap(held),
            worst_record=worst(held),
        ),
    )  # fmt: skip


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


def tried(problem: Problem, selection: Selection, held: Sequence[int]) -> list[Tried]:
    """All candidates of all rounds; intervals by resampling the held-out records."""
    picks = np.asarray(held)

    def logs(option: Option) -> Array:
        return np.asarray(problem.counts[picks] * np.log(np.maximum(LEAST_MISFIT, option.fit.misfit[picks])))

    found = []
    current = selection.start
    # The same whole for every resample; where hardly anything is to be explained, what would be worth a cause.
    whole = max(float(np.maximum(logs(selection.start), 0.0).sum()), WORTH * selection.count)
    explainable = np.full(len(picks), whole / len(picks))
    for n, options in enumerate(selection.rounds, start=1):
        for k, option in enumerate(options):
            rows = np.column_stack([logs(current) - logs(option), explainable])
            gain = float(rows[:, 0].sum() / whole)
            won = k == 0 and option.names[-1] in selection.chosen
            if won:
                reason = "improves the held-out records most"
            elif k > 0:
                reason = "improves them less than the chosen one"
            else:
                reason = "improves the held-out records by no more than noise and numerics would"
            found.append(Tried(n, option.names[-1], gain, bootstrap(rows), "chosen" if won else "rejected", reason))
        current = options[0]
    return found


def sentence(verdict: str, causes: Sequence[Cause], close: Sequence[Option]) -> str:
    """The verdict in one sentence."""
    if verdict == "none":
        return "Nothing is missing: the simulation agrees with the held-out records within their noise."
    if verdict == "recalibrate":
        return "No effect is missing: other values of the degradation parameters explain the records."
    if verdict == "unexplained":
        return "The simulation is wrong in a way that no known cause explains."
    what = " and ".join(c.title[0].lower() + c.title[1:] for c in causes)
    gain = f"{100 * causes[0].gain.heldout:.0f} % of the explainable error on held-out records goes away"
    if verdict == "ambiguous":
        others = " or ".join(o.names[-1].replace("_", " ") for o in close)
        return f"The cause is {what}, or {others}: these records cannot tell them apart ({gain})."
    if verdict == "measurement_fault":
        return f"The measurement is faulty: {what} ({gain})."
    return f"The cause is {what}: {gain}."
