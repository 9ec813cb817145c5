"""From a dataset to its answer: the states of filling, and what has happened since the reference."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm
from threadpoolctl import threadpool_limits

from twintube.common.arrays import Array
from twintube.common.showing import data_frame, picture
from twintube.common.words import listed
from twintube.dampers import Damper
from twintube.dampers.freed_gas import DEFAULT, VARIED, has_own, values_of
from twintube.data import LoadedDataset, Record, has_reference, load_dataset
from twintube.diagnosis.bench import GAS, LEVEL, Bench
from twintube.diagnosis.budget import LASTING, LAW, Budget, budget
from twintube.diagnosis.changes import NONE, STATE, UNKNOWN, Changes, Hypothesis, changes
from twintube.diagnosis.channels import TARED
from twintube.diagnosis.heldout import HeldOut, asked, changed, held_out, predicted, weights
from twintube.diagnosis.measurement.edges import with_edges
from twintube.diagnosis.measurement.faults import DROPOUTS, Fault, read
from twintube.diagnosis.mechanisms import OPEN, Strength, check
from twintube.diagnosis.numbers import NUMBERS
from twintube.diagnosis.posterior import Stated, StatePosterior, log_prior_fill
from twintube.diagnosis.predictive import Unlike, unlike
from twintube.diagnosis.problem import Problem
from twintube.diagnosis.put_right import Measured, put_right
from twintube.diagnosis.records.prepare import prepare
from twintube.diagnosis.records.seen import DELAY
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.search import Fill, Found
from twintube.diagnosis.shares import nearest
from twintube.diagnosis.sizes import Sizes
from twintube.diagnosis.state import rather_tared, state

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

Progress = Callable[[str], None]

SAMPLED = {"sample_mean": 0.5}  # a sample is a point of the force, a mean over its interval, or between them

JUDGED = 4  # the likeliest hypotheses, whose predictions of left-out records are compared
LEAST_LEVEL = 0.05  # [1] numerics
MOST_DELAY = 0.02  # [s] numerics

VERDICTS = {NONE: "none", STATE: "state", UNKNOWN: "unexplained", "effect": "cause", "fault": "measurement_fault"}


def silent(step: str) -> None:
    """Tell nobody what is being done."""


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
            "gas_preload": {"value": round(p.gas, 4), "interval": [round(x, 4) for x in p.gas_interval()]},
            "gas_lost": round(p.gas_lost, 6),
            TARED: round(p.tared, 6),
        }

    def row(self) -> dict[str, Any]:
        """The row in a table of all states."""
        p = self.posterior
        (low, high), (gas_low, gas_high) = p.interval(), p.gas_interval()
        return {"state": self.state, "records": len(self.records), "oil_level": p.level, "low": low, "high": high,
                "gas_preload": p.gas, "gas_low": gas_low, "gas_high": gas_high, "gas_lost": p.gas_lost,
                TARED: p.tared}  # fmt: skip


@dataclass(frozen=True, repr=False)
class Answer:
    """What the records say of a damper: its states of filling, and what has happened since a reference.

    `to_dataframe()` and `plot()` show the probabilities.
    """

    title: str
    damper: Damper
    records: tuple[Record, ...]
    states: tuple[StateAnswer, ...]
    changes: Changes | None  # None where nothing but the fill was sought
    held_out: tuple[HeldOut, ...]
    compared: bool  # with a reference
    measured: Measured | None  # None where the bench was not looked at
    seconds: float
    weights: Mapping[str, float] = field(default_factory=dict)  # of hypotheses, by records that were left out
    tared: tuple[str, ...] = ()  # records of the reference whose load cell was set to zero with the damper in it
    unlike: tuple[Unlike, ...] = ()  # records that the likeliest hypothesis does not explain

    @property
    def remarks(self) -> tuple[str, ...]:
        """What else was put right or is missing, each as a sentence without its full stop."""
        known = () if self.measured is None else self.measured.remarks
        if not self.tared:
            return known
        names = ", ".join(self.tared)
        return (*known, f"{names}: the load cell was set to zero with the damper in it; its gas force was put back")

    @property
    def verdict(self) -> str:
        """One word, as the contract of diagnosis.json has it."""
        if self.changes is None:
            return "state"
        if self.unexplained:
            return "unexplained"
        if len(self.named) > 1:
            return "ambiguous"
        first = self.changes.hypotheses[0]
        if first.kind == NONE and self.faults:
            return "measurement_fault"
        # Beside a reference the damper's own law is no change.
        known = self.budget() if first.kind == NONE and not self.compared else None
        if known is not None and known.largest.force > known.noise:
            return "tolerance"
        return VERDICTS[first.kind]

    @property
    def asked(self) -> tuple[StateAnswer, ...]:
        """The states of which the file says nothing."""
        return tuple(one for one in self.states if not one.stated.anything)

    @property
    def faults(self) -> tuple[Fault, ...]:
        """Faults of the bench that are no hypothesis: put right before anything was judged, and what counts for nothing."""
        known = () if self.measured is None else self.measured.faults
        few = [one for one in self.unlike if not one.whole]
        return (*known, dropouts(few)) if few else known

    @property
    def named(self) -> tuple[Hypothesis, ...]:
        """The hypotheses that hold 90 % together, and those that predict left-out records where these do not."""
        if self.changes is None:
            return ()
        several = self.changes.hypotheses
        some = several[: len(self.changes.credible)]
        return (*some, *(h for h in several if h.name in self.doubting))

    @property
    def doubting(self) -> tuple[str, ...]:
        """The fewest hypotheses that hold 90 % by records left out, where the likeliest by evidence have next to nothing."""
        if self.changes is None:
            return ()
        credible = self.changes.credible
        if not self.weights or sum(self.weights.get(name, 0.0) for name in credible) >= 1.0 - NUMBERS.credible:
            return ()
        ordered = sorted(self.weights, key=lambda name: -self.weights[name])
        total = np.cumsum([self.weights[name] for name in ordered])
        return tuple(n for n in ordered[: int(np.searchsorted(total, NUMBERS.credible)) + 1] if n not in credible)

    @property
    def doubted(self) -> bool:
        """Whether the only likely hypothesis predicts records that were left out worse than others."""
        return self.changes is not None and len(self.changes.credible) == 1 and bool(self.doubting)

    @property
    def cause(self) -> Found | None:
        """The most probable mechanism, where it is the answer or one of several."""
        return next((h.found for h in self.named if h.found is not None and h.found.mechanism.strengths), None)

    def budget(self) -> Budget | None:
        """What the error consists of under the likeliest hypothesis; None where nothing but the fill was sought."""
        if self.changes is None:
            return None
        h = next(h for h in self.changes.hypotheses if h.found is not None)
        assert h.found is not None and h.search is not None
        return budget(self.changes.search, h.search, h.found)

    @property
    def unexplained(self) -> str:
        """Why even the most probable hypothesis is no answer, in a sentence; empty where it is one."""
        if self.changes is None:
            return ""
        if names := [one.record for one in self.unlike if one.whole]:
            return f"{listed(names, len(names))}: the force goes otherwise than under any hypothesis"
        if self.compared:
            return ""
        first = self.changes.hypotheses[0]
        if first.found is None or first.search is None:
            return ""
        bench = first.search.bench
        outside = seen_outside(self.measured, bench, first.found.force) if self.measured is not None else ""
        return outside or beyond(self.budget(), first.found.sizes, self.damper.name)

    @property
    def extended(self) -> Damper | None:
        """The parameter set with the named effect; None where nothing is named that changes it."""
        cause = self.cause
        if cause is None or self.changes is None or self.verdict != "cause":
            return None
        values = {**self.changes.search.bench.usual, **cause.values}
        values = {n: x for n, x in values.items() if hasattr(self.damper.parameters, n)}
        changed = replace(self.damper.with_(**values), name=f"{self.damper.name}-extended")
        origin = dict.fromkeys(cause.mechanism.effect.split("+"), "added by diagnosis")
        return replace(changed, sources=dict(self.damper.sources) | origin)

    def to_dataframe(self) -> pd.DataFrame:
        """A row for each hypothesis with its probability; without a reference a row for each state of filling.

        A state has its median oil level, from `low` to `high` with 90 %, the share of its gas preload, from `gas_low` to
        `gas_high`, and the probability that it is lost.
        Raises UserError where pandas is not installed.
        """
        if self.changes is not None:
            several = self.changes.hypotheses
            rows = [{"name": h.name, "kind": h.kind, "probability": h.probability} for h in several]
            return data_frame(rows, index="name")
        return data_frame([one.row() for one in self.states], index="state")

    def plot(self) -> Figure:
        """Draw the probabilities as a figure of pyplot."""
        return picture(self)

    def __repr__(self) -> str:
        rest = "" if self.changes is None else ": " + ", ".join(f"{h.name} ({h.probability:.0%})" for h in self.named)
        return f"<Answer about {self.damper.name} from {len(self.records)} records: {self.verdict}{rest}>"


def beyond(known: Budget | None, sizes: Sizes, damper: str) -> str:
    """What is largest where that has no name and is larger than it may be, in a sentence; else empty."""
    largest = known.largest if known is not None else None
    if largest is None or not largest.finding:
        return ""
    if largest.name == LAW:
        off = f"the forces are some {100 * sizes.law:.0f} % off those of {damper}"
        return f"{off}: identify this damper first (twintube identify)"
    if largest.name == LASTING:
        return "what is left comes and goes in a way that no cause of the catalogue has"
    return ""


def dropouts(few: Sequence[Unlike]) -> Fault:
    """The fault of a channel that is off for single intervals."""
    where = "; ".join(f"{one.record} at {listed([f'{x:.3f}' for x in one.times], 5)} s" for one in few)
    text = f"The force drops out or spikes in single intervals, which count for next to nothing: {where}."
    count = sum(len(one.times) for one in few)
    names = tuple(one.record for one in few)
    return Fault(DROPOUTS, "Drop-outs or spikes of the force channel", text, count, "intervals", records=names)


def seen_outside(measured: Measured, bench: Bench, force: Array) -> str:
    """What the records show of a cause outside the catalogue beside forces (n,) [N] of a model; empty where too little.

    What repeats in every oscillation is no cause where the error is noise.
    """
    left = float(np.sqrt(np.mean((bench.measured - force)[bench.used] ** 2)))
    quiet = left <= RULES.quiet * float(np.sqrt(np.mean(bench.sigma[bench.used] ** 2)))
    several = [s for s in measured.seen if s.size > RULES.shows * left and not (s.repeats and quiet)]
    return several[0].text if several else ""


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


def as_filled(
    bench: Bench,
    name: str,
    other: Mapping[str, tuple[float, float]] | None = None,
    log_prior: float = 0.0,
    wide: Mapping[str, float] | None = None,
) -> Fill:
    """The fill of a bench, levels open to the tolerance of a fill; of some states another preload and level.

    When and how fast the force is seen to step is open beside it.

    `wide` are standard deviations of levels that nobody has stated.
    """
    other = other or {}
    levels, values = [], {}
    for label, which in bench.labels.items():
        gas, level = other.get(label, (float(bench.states[which][0, 1]), float(bench.states[which][0, 0])))
        if label in other:
            values[f"{GAS}:{label}"] = gas
        if level < 1.0 or label in other:
            scale = (wide or {}).get(label, NUMBERS.level_tolerance)
            levels.append(Strength(f"{LEVEL}:{label}", "normal", scale, level, LEAST_LEVEL, 1.0))
    delay = Strength(DELAY, "normal", bench.delayed, 0.0, -MOST_DELAY, MOST_DELAY)
    return Fill((*levels, delay, *OPEN), values, log_prior, name)


def spread(known: StatePosterior) -> float:
    """Standard deviation of a level that the records tell, no less than the tolerance of a fill."""
    low, high = known.interval()
    return max(NUMBERS.level_tolerance, (high - low) / (2.0 * float(norm.ppf(0.95))))


def likely_fills(bench: Bench, several: Sequence[StateAnswer] = ()) -> list[Fill]:
    """The fill as stated, and the likeliest other one of those states that may be another; what freed gas does is open.

    Nobody has measured that. Where the parameter set states it, it is as stated.
    """
    n = NUMBERS
    told = [one for one in several if one.stated.anything]
    doubtful = [one for one in told if one.posterior.as_stated < n.credible]
    wide = {one.state: spread(one.posterior) for one in several if not one.stated.anything}
    out = [as_filled(bench, "as_stated", None, float(np.log(1.0 - n.misstated)) if told else 0.0, wide)]
    # Of a fill that nobody knows the share of the gas may be another.
    for one in several:
        probability, *other = one.posterior.otherwise
        if not one.stated.anything and probability > n.implausible:
            out.append(as_filled(bench, one.state, {one.state: (other[0], other[1])}, out[0].log_prior))
    if doubtful:
        # Anywhere between the least level and all oil, with any share of the gas: the part of it that tolerances hold.
        share = np.sqrt(2.0 * np.pi) * n.level_tolerance / (1.0 - n.level_low)
        free = {one.state: one.posterior.free for one in doubtful}
        log_prior = float(np.log(n.misstated) + len(free) * np.log((1.0 - n.full) * share))
        log_prior += sum(float(log_prior_fill()[nearest(gas)]) for gas, _ in free.values())
        other_fill = as_filled(bench, "another", free, log_prior, wide)
        out.append(replace(other_fill, other=True))
    ways = [{}] if has_own(bench.given) else [{}, *(values_of(name) for name in VARIED if name != DEFAULT)]
    return [
        replace(
            fill, values={**fill.values, **way}, log_prior=fill.log_prior - float(np.log(len(ways))),
            name=f"{fill.name} {i}",
        )
        for i, way in enumerate(ways)
        for fill in out
    ]  # fmt: skip


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
        if one.posterior.as_stated < NUMBERS.credible:
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
