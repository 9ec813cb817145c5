"""From a dataset to its diagnosis."""

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from twintube.arrays import Array
from twintube.diagnose.answer import answer, gain_of
from twintube.diagnose.candidates import candidates, nuisances
from twintube.diagnose.faults import Fault, read, scaled, unit_error
from twintube.diagnose.fit import Problem
from twintube.diagnose.prepare import Case, prepare
from twintube.diagnose.result import Cause, Diagnosis, Gain
from twintube.diagnose.select import Selector, bootstrap
from twintube.diagnose.signature import signatures
from twintube.simulate import InputError

SAME_SPEED = 1.05  # velocities within 5 % are one
HELD_OUT = (3, 2)  # every third velocity from the third on, never the highest


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
    seen = signatures(dataset.records)
    found = answer(dataset, problem, selector, selection, held, seen)
    for one in (wrong, fault):
        if one is not None:
            found = faulty(found, one, repaired(recorded, problem, fitted, held))
    return replace(found, remarks=[*remarks, *found.remarks], seconds=time.monotonic() - began)


def known_gain(path: str | Path, causes: Sequence[str]) -> float:
    """Share of the explainable held-out error that goes away with the given causes, whatever a diagnosis would choose."""
    dataset, _ = read(path)
    cases = prepare(dataset)
    fitted, held, _ = split(dataset.title, cases)
    problem = Problem(dataset.damper, cases)
    selector = Selector(problem, candidates(problem), fitted, held)
    start = option = selector.option((), nuisances(problem))
    problem.balance(start.fit.misfit)
    for name in causes:
        option = selector.extended(option, name)
    return gain_of(problem, start.fit, option.fit, held)


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
