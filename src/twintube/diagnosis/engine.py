"""From a dataset to its diagnosis."""

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from twintube.arrays import Array
from twintube.diagnosis.answer import answer, predictions
from twintube.diagnosis.candidates import candidates
from twintube.diagnosis.faults import Fault, force_averaging, read, scaled, unit_error
from twintube.diagnosis.fit import Problem
from twintube.diagnosis.gains import bootstrap, gains, whole, worst
from twintube.diagnosis.prepare import PreparedRecord, prepare
from twintube.diagnosis.result import Diagnosis, Gain
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.select import Fold, Selector
from twintube.diagnosis.signature import signatures
from twintube.diagnosis.zeros import zero_drift
from twintube.engine.simulate import InputError
from twintube.fitting.splits import distinct


def diagnose(path: str | Path, progress: Callable[[str], None] = lambda text: None) -> Diagnosis:
    """Diagnose a dataset folder.

    Raises DataError with all defects of the records, and InputError where they do not allow to judge on held-out records.
    """
    began = time.monotonic()
    dataset, turned = read(path)
    records = prepare(dataset)
    folds, remarks = split(dataset.title, records)
    if not any(record.intact for record in records):
        remarks.append("no record of the intact damper: what is wrong in every state looks like an effect of the oil loss")
    recorded = problem = Problem(dataset.damper, records)
    wrong, problem = unit_error(problem)
    smoothed, problem, notes = force_averaging(dataset.records, problem)
    problem, drift = zero_drift(problem)
    remarks += [*notes, *drift]
    if turned is not None:
        recorded = recorded.with_records([scaled(record, turned.factor, 1.0) for record in records])
    selector = selector_of(problem, folds)
    selection = selector.run(progress)
    progress("all records")
    faults = put_right([turned, wrong, smoothed], recorded, problem)
    answered = answer(dataset, problem, selector, selection, signatures(dataset.records), faults)
    return replace(answered, remarks=[*remarks, *answered.remarks], seconds=time.monotonic() - began)


def selector_of(problem: Problem, folds: Sequence[tuple[list[int], list[int]]]) -> Selector:
    """The selector for the numbers of the records to fit and to judge on."""
    several = []
    for fitted, held in folds:
        fit, judge = (problem.with_records([problem.records[i] for i in some]) for some in (fitted, held))
        several.append(Fold(fit, judge))
    # With a single fold the held-out records are never fitted, with several every record is held out of some fold.
    return Selector(several[0].fitted if len(several) == 1 else problem, candidates(problem), several)


def known_gain(path: str | Path, causes: Sequence[str]) -> float:
    """Share of the explainable held-out error that goes away with the given causes, whatever a diagnosis would choose."""
    dataset, _ = read(path)
    records = prepare(dataset)
    problem, _ = zero_drift(Problem(dataset.damper, records))
    selector = selector_of(problem, split(dataset.title, records)[0])
    option = selector.start
    for name in causes:
        option = selector.extended(option, name)
    return whole(gains(predictions(selector, (selector.start, selector.start, option))))


def put_right(faults: Sequence[Fault | None], recorded: Problem, problem: Problem) -> dict[Fault, Gain]:
    """The faults that were put right, with the gain of all of them for the base model.

    Errors are relative to the force, as units and signs differ. Nothing is fitted, so that every record counts as held out.
    """
    present = [fault for fault in faults if fault is not None]
    if not present:
        return {}

    def shares(p: Problem) -> Array:
        forces = p.forces({})
        rows = []
        for record, a, b in zip(p.records, p.starts[:-1] + 1, p.starts[1:], strict=True):
            size = float(np.sum(p.measured[a:b] ** 2))
            error = float(np.sum((forces[a:b] - p.measured[a:b]) ** 2))
            rows.append((error / size, float(np.sum(record.noise[1:] ** 2)) / size))
        return np.array(rows)

    before, after = shares(recorded), shares(problem)
    less = before[:, 0] - np.maximum(after[:, 0], after[:, 1])
    rows = np.column_stack([less, np.maximum(before[:, 0] - after[:, 1], 1e-9)])
    return dict.fromkeys(present, Gain(whole(rows), whole(rows), bootstrap(rows), worst(rows)))


def split(title: str, records: Sequence[PreparedRecord]) -> tuple[list[tuple[list[int], list[int]]], list[str]]:
    """The numbers of the records to fit and to judge on, fold by fold, and remarks on the choice.

    Where the dataset states nothing every other velocity is held out, then the others. A quasi-static record is always
    fitted. Raises InputError where there is nothing to fit or nothing to judge on.
    """
    if len(records) < 2:
        raise InputError(f"{title}: {len(records)} record, at least two are needed: one to fit, one to judge on")
    if any(record.split for record in records):
        held = [i for i, record in enumerate(records) if record.split == "heldout"]
        fitted = [i for i in range(len(records)) if i not in held]
        if not fitted or not held:
            raise InputError(f"{title}: {len(held)} of {len(records)} records are held out, some must be and some must not")
        return [(fitted, held)], []
    moving = {i: record.top_speed for i, record in enumerate(records) if record.measurement != "quasi-static"}
    speeds = distinct(moving.values(), RULES.equal_speeds)
    if len(speeds) < 2:
        raise InputError(f"{title}: all records have one velocity; split them in dataset.toml (split = 'heldout')")
    place = {i: int(np.searchsorted(speeds, speed, side="right")) for i, speed in moving.items()}
    halves = [[i for i, number in place.items() if number % 2 == half] for half in (0, 1)]
    folds = [([i for i in range(len(records)) if i not in held], held) for held in halves]
    return folds, ["every record is predicted from those of other velocities: every second velocity is held out in turn"]
