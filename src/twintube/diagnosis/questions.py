"""From a dataset to its answer: the state of the damper, what has changed since a reference, what the model lacks."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from twintube.common.arrays import Array
from twintube.data import LoadedDataset, Record, has_reference, load_dataset
from twintube.diagnosis.answer import Answer, StateAnswer
from twintube.diagnosis.bench import Bench
from twintube.diagnosis.changes import NONE, Changes, changes
from twintube.diagnosis.fills import likely_fills
from twintube.diagnosis.heldout import asked, changed, held_out, predicted, weights
from twintube.diagnosis.measurement.edges import with_edges
from twintube.diagnosis.measurement.faults import Fault, read
from twintube.diagnosis.mechanisms import check
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.posterior import Stated
from twintube.diagnosis.predictive import unlike
from twintube.diagnosis.problem import Problem
from twintube.diagnosis.put_right import Measured, put_right
from twintube.diagnosis.records.prepare import prepare
from twintube.diagnosis.state import rather_tared, state

Progress = Callable[[str], None]

SAMPLED = {"sample_mean": 0.5}  # a sample is a point of the force, a mean over its interval, or between them
JUDGED = 4  # the likeliest hypotheses, whose predictions of left-out records are compared


def silent(step: str) -> None:
    """Tell nobody what is being done."""


def fillings(records: list[Record]) -> Iterator[list[Record]]:
    """The records of each state of filling."""
    for label in dict.fromkeys(record.state for record in records):
        yield [record for record in records if record.state == label]


def states(dataset: LoadedDataset, progress: Progress | None = None) -> list[StateAnswer]:
    """Every state of filling of a dataset that is not stated; `progress` is told what is being done.

    Records of stated fills stand beside it: the damper's own law is the same in them. Raises InputError where a stroke
    leaves the tube.
    """
    progress = progress or silent
    with threadpool_limits(1):  # several states are compared at once; more threads would wait for each other
        answers = []
        for own in fillings(dataset.records):
            if any(record.unknown for record in own):
                some = [record for record in dataset.records if not record.unknown or record.state == own[0].state]
                bench = Bench(dataset.damper, prepare(replace(dataset, records=some)))
                answers.append(state_of(bench, some, own, progress))
                bench.threads.shutdown()
        return answers


def state_of(bench: Bench, records: list[Record], own: list[Record], progress: Progress) -> StateAnswer:
    """The state of the records `own` of one filling."""
    names = tuple(record.name for record in own)
    progress(f"oil level and preload of {names[0]}" + (f" and {len(own) - 1} more" if len(own) > 1 else ""))
    stated = Stated(own[0].oil_level, own[0].gas_preload)
    which = [i for i, record in enumerate(records) if record.state == own[0].state]
    return StateAnswer(own[0].state, names, stated, state(bench, which, stated, progress))


def diagnose(path: str | Path, progress: Progress | None = None, catalogue: Collection[str] | None = None) -> Answer:
    """Read a dataset folder and answer, see `answer`.

    Raises DataError with all defects of the records, and InputError where a stroke leaves the tube.
    """
    progress = progress or silent
    progress("reading the records")
    dataset, turned = read(path)
    if turned is not None and (has_reference(dataset.records) or any(record.unknown for record in dataset.records)):
        # There the bench is not looked at, and nothing is put right in silence: this raises.
        dataset, turned = load_dataset(path), None
    return answer(dataset, progress, turned, catalogue)


def answer(
    dataset: LoadedDataset,
    progress: Progress | None = None,
    turned: Fault | None = None,
    catalogue: Collection[str] | None = None,
) -> Answer:
    """The states of filling, and what has happened since the reference, or what the model lacks where there is none.

    Where a fill is unknown and no record is a reference, its state is all that is sought. `turned` is what was put right
    when the records were read. Effects and faults that a `catalogue` does not name cannot be the cause; None: each can.
    Raises InputError where a stroke leaves the tube, or the catalogue has a name of nothing.
    """
    began, progress = time.monotonic(), progress or silent
    if catalogue is not None:
        check(catalogue)
    if not has_reference(dataset.records) and any(record.unknown for record in dataset.records):
        found = tuple(states(dataset, progress))
        return Answer(
            dataset.title, dataset.damper, tuple(dataset.records), found, None, (), False, None, time.monotonic() - began
        )
    with threadpool_limits(1):
        if has_reference(dataset.records):
            known = compared_with_reference(dataset, progress, catalogue)
        else:
            measured = put_right(dataset, turned, progress)
            # What looks odd may be a cause that acts in few records: it is odd where no cause explains all of them.
            every = lacking(dataset, measured.whole, progress, catalogue) if measured.whole is not None else None
            known = lacking(dataset, measured, progress, catalogue) if every is None or not explains(every) else every
    return replace(known, seconds=time.monotonic() - began)


def explains(answer: Answer) -> bool:
    """Whether an answer names causes of the damper that explain the records."""
    return not answer.unexplained and all(h.kind == "effect" for h in answer.named)


def compared_with_reference(dataset: LoadedDataset, progress: Progress, catalogue: Collection[str] | None) -> Answer:
    """What has happened since the reference."""
    bench = Bench(dataset.damper, prepare(dataset), fills=labels(dataset.records))
    several: list[StateAnswer] = []
    tared: list[str] = []
    # A reference is as its file says; what is unknown of it is found first.
    for own in sorted(fillings(dataset.records), key=lambda own: not own[0].reference):
        which = np.array([record.state == own[0].state for record in dataset.records])
        if own[0].reference and not own[0].unknown:
            level, preload, *_ = bench.states[which][0]
            best = float(preload), float(level), rather_tared(bench, which)
        else:
            several.append(state_of(bench, dataset.records, own, progress))
            found = several[-1].posterior
            # Where the records leave the level open, the middle of what is left of it says least.
            best = found.best[0], found.level if own[0].unknown else found.best[1], found.best[2]
        # What is stated is open to its tolerance in each hypothesis, and a tared cell since the reference is one.
        if own[0].unknown or own[0].reference:
            bench.in_state(which, *best[:2], best[2] and own[0].reference)
        if own[0].reference and best[0] and best[2]:
            tared += [record.name for record in own]
    bench.with_edges(edges(bench, bench.states))
    times = zip(dataset.records, bench.records, strict=True)
    acting = np.concatenate([~in_reference(record, r.time) for record, r in times])
    result = changes(bench, acting, likely_fills(bench, several), progress, catalogue=catalogue)
    known = concluded(dataset, dataset.records, several, result, measured=None, progress=progress)
    return replace(known, tared=tuple(tared))


def labels(records: Sequence[Record]) -> list[str]:
    """The state of each record."""
    return [record.state for record in records]


def edges(bench: Bench, states: Array) -> list[Array]:
    """What the steps of the force leave open in each record (n,) [N]: where in its interval a step falls nobody knows."""
    filled = [
        replace(record, oil_level=float(level), gas_preload=float(gas))
        for record, (level, gas, *_) in zip(bench.records, states, strict=True)
    ]
    return [record.edges for record in with_edges(Problem(bench.given, filled)).records]


def bench_of(measured: Measured, records: Sequence[Record]) -> Bench:
    """The bench of records that were put right.

    Delay, zero and filter that suit the damper without any cause are no facts: each hypothesis has them open.
    """
    known = measured.problem
    return Bench(known.given, known.records, SAMPLED, fills=labels(records))


def alone(measured: Measured, records: Sequence[Record], own: list[Record], progress: Progress) -> StateAnswer:
    """The state of the records `own` of one filling by themselves: what is stated of the others may be wrong, too."""
    known = measured.problem
    some = [r for r, record in zip(known.records, records, strict=True) if record.state == own[0].state]
    bench = Bench(known.given, some, SAMPLED, fills=labels(own))
    found = state_of(bench, own, own, progress)
    bench.threads.shutdown()
    return found


def lacking(dataset: LoadedDataset, measured: Measured, progress: Progress, catalogue: Collection[str] | None) -> Answer:
    """What the model lacks, in records without the faults of their bench."""
    records = [record for record in dataset.records if record.name not in measured.odd]
    bench = bench_of(measured, records)
    several = [alone(measured, records, own, progress) for own in fillings(records)]
    doubted = bench.states.copy()
    for one in several:
        if one.posterior.as_stated < numbers().credible:
            doubted[bench.labels[one.state], :2] = one.posterior.free[::-1]
    # Where the steps of the force lie in another fill is open, too.
    bench.with_edges([np.maximum(r.edges, other) for r, other in zip(bench.records, edges(bench, doubted), strict=True)])
    acting = np.ones(len(bench.z), dtype=bool)
    result = changes(bench, acting, likely_fills(bench, several), progress, catalogue=catalogue)
    return concluded(dataset, records, several, result, measured=measured, progress=progress)


def concluded(
    dataset: LoadedDataset,
    records: Sequence[Record],
    several: Sequence[StateAnswer],
    result: Changes,
    *,
    measured: Measured | None,
    progress: Progress,
) -> Answer:
    """The answer that follows from probabilities, with what hypotheses are worth on records that were left out."""
    progress("predicting records that were left out")
    places = changed(result.search)
    judged = [h for h in asked(result.hypotheses, JUDGED) if h.found is not None and h.search is not None]
    threads = result.search.bench.threads
    several_predicted = dict(
        zip(
            (h.name for h in judged),
            threads.map(lambda h: predicted(h.search, h.found, places), judged),
            strict=True,
        )
    )
    first = result.hypotheses[0]
    cause = several_predicted.get(first.name) if first.name != NONE else None
    left_out = held_out(several_predicted[NONE], cause, result.search, places)
    off = tuple(unlike(first.search, first.found)) if first.search is not None and first.found is not None else ()
    threads.shutdown()
    return Answer(
        dataset.title,
        dataset.damper,
        tuple(records),
        tuple(several),
        result,
        tuple(left_out),
        measured is None,
        measured,
        0.0,
        weights=weights(several_predicted),
        unlike=off,
    )


def in_reference(record: Record, time: Array) -> NDArray[np.bool_]:
    """Which of some times [s] show the damper as it was."""
    if record.reference_window is None:
        return np.full(len(time), record.reference)
    low, high = record.reference_window
    return np.asarray((time >= low) & (time <= high))
