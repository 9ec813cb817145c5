"""From a dataset to its diagnosis."""

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from twintube.arrays import Array
from twintube.diagnosis.answer import answer, gains, predictions, worst
from twintube.diagnosis.candidates import candidates
from twintube.diagnosis.faults import Fault, force_averaging, read, scaled, unit_error
from twintube.diagnosis.fit import Problem
from twintube.diagnosis.prepare import Case, prepare
from twintube.diagnosis.result import Cause, Diagnosis, Found, Gain
from twintube.diagnosis.select import Fold, Selector, bootstrap
from twintube.diagnosis.signature import signatures
from twintube.diagnosis.zeros import zero_drift
from twintube.engine.simulate import InputError

SAME_SPEED = 1.05  # velocities within 5 % are one


def diagnose(path: str | Path, progress: Callable[[str], None] = lambda text: None) -> Diagnosis:
    """Diagnose a dataset folder.

    Raises DataError with all defects of the records, and InputError where they do not allow to judge on held-out ones.
    """
    began = time.monotonic()
    dataset, fault = read(path)
    cases = prepare(dataset)
    folds, remarks = split(dataset.title, cases)
    if not any(case.intact for case in cases):
        remarks.append("no record of the intact damper: what is wrong in every state looks like an effect of the oil loss")
    problem = recorded = Problem(dataset.damper, cases)
    wrong, problem = unit_error(problem)
    smoothed, problem, told = force_averaging(dataset.records, problem)
    problem, drifted = zero_drift(problem)
    remarks += [*told, *drifted]
    if fault is not None:
        recorded = recorded.with_cases([scaled(case, fault.factor, 1.0) for case in cases])
    selector = made(problem, folds)
    selection = selector.run(progress)
    progress("all records")
    found = answer(dataset, problem, selector, selection, signatures(dataset.records))
    for one in (smoothed, wrong, fault):
        if one is not None:
            found = faulty(found, one, repaired(recorded, problem))
    return replace(found, remarks=[*remarks, *found.remarks], seconds=time.monotonic() - began)


def made(problem: Problem, folds: Sequence[tuple[list[int], list[int]]]) -> Selector:
    """The selector for the numbers of the records to fit and to judge on."""
    several = []
    for fitted, held in folds:
        fit, judge = (problem.with_cases([problem.cases[i] for i in some]) for some in (fitted, held))
        several.append(Fold(fit, judge))
    # With one fold the held-out records are never fitted, with several every record is held out of one.
    whole = several[0].fitted if len(several) == 1 else problem
    return Selector(whole, candidates(problem), several)


def known_gain(path: str | Path, causes: Sequence[str]) -> float:
    """Share of the explainable held-out error that goes away with the given causes, whatever a diagnosis would choose."""
    dataset, _ = read(path)
    cases = prepare(dataset)
    problem, _ = zero_drift(Problem(dataset.damper, cases))
    selector = made(problem, split(dataset.title, cases)[0])
    start = option = selector.bare()
    for name in causes:
        option = selector.extended(option, name)
    gone = gains(predictions(selector, (start, start, option)))
    return float(gone[:, 0].sum() / gone[:, 1].sum())


def repaired(recorded: Problem, problem: Problem) -> Gain:
    """What putting a fault right gains for the base model: errors relative to the force, as units and signs differ.

    Nothing is fitted, so that every record is a held-out one.
    """

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
    whole = float(rows[:, 0].sum() / rows[:, 1].sum())
    return Gain(whole, whole, bootstrap(rows), worst(rows))


def faulty(found: Diagnosis, fault: Fault, gain: Gain) -> Diagnosis:
    """The diagnosis of a measurement with a fault that was put right before anything was fitted."""
    factor = Found(fault.factor, fault.factor, fault.factor, "1")
    first = Cause(fault.effect, fault.title, fault.explanation, {fault.name: factor}, gain)
    text = f"The measurement is faulty: {fault.explanation[0].lower()}{fault.explanation[1:]}"
    return replace(
        found,
        verdict="measurement_fault",
        causes=[first, *found.causes],
        sentence=f"{text} With it put right: {found.sentence}",
        signature="",
        remarks=[*found.remarks, "the fault was put right for everything shown here; its gain is relative to the force"],
    )


def split(title: str, cases: Sequence[Case]) -> tuple[list[tuple[list[int], list[int]]], list[str]]:
    """The numbers of the cases to fit and to judge on, fold by fold, and what was decided here.

    Where the dataset says nothing every other velocity is held out, then the others. A quasi-static record is always fitted.
    """
    if len(cases) < 2:
        raise InputError(f"{title}: {len(cases)} record, at least two are needed: one to fit, one to judge on")
    if any(case.split for case in cases):
        held = [i for i, case in enumerate(cases) if case.split == "heldout"]
        fitted = [i for i in range(len(cases)) if i not in held]
        if not fitted or not held:
            raise InputError(f"{title}: {len(held)} of {len(cases)} records are held out, some must be and some must not")
        return [(fitted, held)], []
    speeds: list[float] = []
    for v in sorted(case.top_speed for case in cases if case.measurement != "quasi-static"):
        if not speeds or v > SAME_SPEED * speeds[-1]:
            speeds.append(v)
    if len(speeds) < 2:
        raise InputError(f"{title}: all records have one velocity; split them in dataset.toml (split = 'heldout')")
    place = {i: int(np.searchsorted(speeds, case.top_speed, side="right")) for i, case in enumerate(cases)
             if case.measurement != "quasi-static"}  # fmt: skip
    halves = [[i for i, number in place.items() if number % 2 == half] for half in (0, 1)]
    folds = [([i for i in range(len(cases)) if i not in held], held) for held in halves]
    return folds, ["every record is predicted from those of other velocities: every second velocity is held out in turn"]
