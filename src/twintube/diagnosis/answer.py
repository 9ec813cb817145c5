"""The answer to a dataset: the states of filling, and what has happened since the reference."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from twintube.common.arrays import Array
from twintube.common.showing import data_frame, picture
from twintube.common.words import listed
from twintube.dampers import Damper
from twintube.data import Record
from twintube.diagnosis.bench import Bench
from twintube.diagnosis.budget import LASTING, LAW, Budget, budget
from twintube.diagnosis.changes import NONE, STATE, UNKNOWN, Changes, Hypothesis
from twintube.diagnosis.channels import TARED
from twintube.diagnosis.found import Found
from twintube.diagnosis.heldout import HeldOut
from twintube.diagnosis.measurement.faults import DROPOUTS, Fault
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.posterior import Stated, StatePosterior
from twintube.diagnosis.predictive import Unlike
from twintube.diagnosis.put_right import Measured
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.sizes import Sizes

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


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
        moved = [one for one in self.unlike if one.kind == "step"]
        if moved:
            known = (*known, f"{places(moved)}: the force steps at another moment than under any hypothesis")
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
        few = [one for one in self.unlike if one.kind == "spike"]
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
        if any(name not in self.weights for name in credible):  # a free change predicts nothing
            return ()
        agreeing = sum(share for name, share in self.weights.items() if agrees(name, credible))
        if agreeing >= 1.0 - numbers().credible:
            return ()
        ordered = sorted(self.weights, key=lambda name: -self.weights[name])
        total = np.cumsum([self.weights[name] for name in ordered])
        return tuple(n for n in ordered[: int(np.searchsorted(total, numbers().credible)) + 1] if n not in credible)

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
        if names := [one.record for one in self.unlike if one.kind == "whole"]:
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


def agrees(name: str, credible: Collection[str]) -> bool:
    """Whether a hypothesis is one of some, or has another cause beside theirs: that does not contradict them."""
    causes = set(name.split("+"))
    return name in credible or any(causes >= set(other.split("+")) for other in credible)


def places(several: Sequence[Unlike]) -> str:
    """Where records are not as a hypothesis has them."""
    return "; ".join(f"{one.record} at {listed([f'{x:.3f}' for x in one.times], 5)} s" for one in several)


def dropouts(few: Sequence[Unlike]) -> Fault:
    """The fault of a channel that is off for single intervals."""
    text = f"The force drops out or spikes in single intervals, which count for next to nothing: {places(few)}."
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
