"""From a dataset to its answer: the states of filling, and what has happened since the reference."""

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from twintube.arrays import Array
from twintube.dampers import Damper
from twintube.data import LoadedDataset, Record, has_reference
from twintube.diagnosis.records.prepare import prepare
from twintube.evidence.bench import Bench
from twintube.evidence.changes import NONE, STATE, UNKNOWN, Changes, Hypothesis, changes
from twintube.evidence.heldout import HeldOut, held_out
from twintube.evidence.search import Found
from twintube.evidence.state import Stated, StatePosterior, state

Progress = Callable[[str], None]
VERDICTS = {NONE: "none", STATE: "state", UNKNOWN: "unexplained", "effect": "cause", "fault": "measurement_fault"}


@dataclass(frozen=True)
class StateAnswer:
    """A state of filling, what dataset.toml says of it, and its probability."""

    state: str
    records: tuple[str, ...]
    stated: Stated
    posterior: StatePosterior

    def as_json(self) -> dict[str, Any]:
        """The entry in diagnosis.json."""
        p = self.posterior
        return {
            "records": list(self.records),
            "stated": {"oil_level": self.stated.oil_level, "gas_preload": self.stated.gas_preload},
            "as_stated": round(p.as_stated, 6) if self.stated.anything else None,
            "oil_level": {"value": round(p.level, 4), "interval": [round(x, 4) for x in p.interval()]},
            "gas_lost": round(p.gas_lost, 6),
        }


@dataclass(frozen=True)
class Answer:
    """What the records say of a damper."""

    damper: Damper
    records: tuple[Record, ...]
    states: tuple[StateAnswer, ...]
    changes: Changes | None  # None without a reference
    held_out: tuple[HeldOut, ...]
    seconds: float

    @property
    def verdict(self) -> str:
        """One word, as the contract of diagnosis.json has it."""
        if self.changes is None:
            return "state"
        several = self.changes.credible
        return VERDICTS[self.changes.hypotheses[0].kind] if len(several) == 1 else "ambiguous"

    @property
    def named(self) -> tuple[Hypothesis, ...]:
        """The hypotheses that hold 90 % together."""
        return () if self.changes is None else self.changes.hypotheses[: len(self.changes.credible)]

    @property
    def cause(self) -> Found | None:
        """The most probable mechanism, where it is the answer or one of several."""
        return next((h.found for h in self.named if h.found is not None), None)

    @property
    def extended(self) -> Damper | None:
        """The parameter set with the named effect; None where nothing is named that changes it."""
        cause = self.cause
        if cause is None or self.changes is None or self.verdict != "cause":
            return None
        values = {**self.changes.search.bench.usual, **cause.values}
        values = {n: x for n, x in values.items() if hasattr(self.damper.parameters, n)}
        changed = replace(self.damper.with_(**values), name=f"{self.damper.name}-extended")
        return replace(changed, sources=dict(self.damper.sources) | {cause.mechanism.effect: "added by diagnosis"})


def fillings(records: list[Record]) -> Iterator[list[Record]]:
    """The records of each state of filling."""
    for label in dict.fromkeys(record.state for record in records):
        yield [record for record in records if record.state == label]


def states(dataset: LoadedDataset, progress: Progress = lambda text: None) -> list[StateAnswer]:
    """Every state of filling of a dataset that is not stated; `progress` is told what is being done.

    Records of stated fills stand beside it: the damper's own law is the same in them. Raises InputError where a stroke
    leaves the tube.
    """
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


def answer(dataset: LoadedDataset, progress: Progress = lambda text: None) -> Answer:
    """The states of filling, and what has happened since the reference.

    Without a reference, or where every record is one, it is what the model lacks; where a fill is unknown, too, its state is
    all that is sought. Raises InputError where a stroke leaves the tube.
    """
    began = time.monotonic()
    records = list(dataset.records)
    compared = has_reference(records)
    if not compared and any(record.unknown for record in records):
        found = states(dataset, progress)
        return Answer(dataset.damper, tuple(records), tuple(found), None, (), time.monotonic() - began)
    with threadpool_limits(1):
        bench = Bench(dataset.damper, prepare(dataset))
        several = []
        # A reference is as its file says; what is unknown of it is found first.
        for own in sorted(fillings(records), key=lambda own: not own[0].reference):
            if compared and own[0].reference and not own[0].unknown:
                continue
            one = state_of(bench, records, own, progress)
            several.append(one)
            which = np.array([record.state == own[0].state for record in records])
            bench.in_state(which, *one.posterior.best)
        later = {record.name for record in records if not (compared and record.reference)}
        told = [one.posterior for one in several if one.stated.anything and one.records[0] in later]
        times = zip(records, bench.records, strict=True)
        acting = np.concatenate([~in_reference(record, r.time) | (not compared) for record, r in times])
        result = changes(bench, acting, told, progress)
        progress("predicting records that were left out")
        alone = result.hypotheses[0].found if len(result.credible) == 1 else None
        left_out = held_out(result, alone)
        bench.threads.shutdown()
    return Answer(dataset.damper, tuple(records), tuple(several), result, tuple(left_out), time.monotonic() - began)


def in_reference(record: Record, time: Array) -> NDArray[np.bool_]:
    """Which of some times [s] show the damper as it was."""
    if record.reference_window is None:
        return np.full(len(time), record.reference)
    low, high = record.reference_window
    return np.asarray((time >= low) & (time <= high))
