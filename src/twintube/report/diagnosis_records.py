"""What the pictures of a diagnosis show: records of the largest errors, oscillations, work, simulations that differ."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from twintube.arrays import Array
from twintube.data.condition import is_intact
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.result import Diagnosis, RecordResult
from twintube.diagnosis.rules import RULES
from twintube.report import style
from twintube.report.answer import extends, put_right

SHOWN = 6  # records of which curves are drawn
KINDS = {"heldout": "held out", "fit": "fitted", "left_out": "left out"}  # RecordResult.split -> in words


@dataclass(frozen=True)
class Model:
    """A simulation that is worth a curve of its own."""

    name: str  # attribute of RecordResult, key of Diagnosis.errors
    label: str
    colour: str
    dash: str

    def force(self, result: RecordResult) -> Array:
        """Its force (n,) [N] in a record."""
        force: Array = getattr(result, self.name)
        return force


BASE = Model("base", "base model", style.BLUE, "--")
RECALIBRATED = Model("recalibrated", "recalibrated model", style.GREEN, "-")


def equal(result: RecordResult, a: Array, b: Array) -> bool:
    """Whether two simulations of a record are equal curves."""
    return bool(np.allclose(a, b, rtol=0.0, atol=1e-6 * result.record.peak))


def models(d: Diagnosis) -> list[Model]:
    """The simulations that differ from one another in any record: base, recalibrated, extended.

    Where nothing is named the last is that of the nearest candidates, and called so.
    """
    repaired = any(put_right(cause) for cause in d.causes)
    label = "extended model" if extends(d) else "nearest candidate, not named"
    if extends(d) and d.verdict == "measurement_fault" and not repaired:
        label = "fault accounted for"
    extended = Model("extended", label, style.RED if extends(d) else style.GREY, "-")
    different = [replace(BASE, label="base model, fault put right") if repaired else BASE]
    for model in (RECALIBRATED, extended):
        if all(any(not equal(r, model.force(r), other.force(r)) for r in d.records) for other in different):
            different.append(model)
    return different


def compared(d: Diagnosis) -> list[Model]:
    """The base model and, where the diagnosis names anything, the model that has it."""
    base, *others = models(d)
    return [base, *others[-1:]] if extends(d) else [base]


def drawn(result: RecordResult, chosen: list[Model]) -> list[Model]:
    """Those of `chosen` that differ in this record."""
    return [m for i, m in enumerate(chosen) if not any(equal(result, m.force(result), n.force(result)) for n in chosen[:i])]


def ranked(d: Diagnosis) -> list[RecordResult]:
    """The records by their base error, held-out ones first."""
    return sorted(d.records, key=lambda r: (r.split != "heldout", -r.rms(r.base)))


def shown(d: Diagnosis) -> list[RecordResult]:
    """The records of which curves are drawn: the largest base errors, preferably held out and with oscillations."""
    return sorted(ranked(d), key=lambda r: not oscillations(r.record))[:SHOWN]


def oscillations(record: PreparedRecord) -> list[NDArray[np.int64]]:
    """The main block: for each oscillation the samples at which its intervals end."""
    within = record.stretch[1:] == record.stretch[:-1]
    every = []
    for number in np.unique(record.cycle[record.cycle >= 0]):
        ends = np.flatnonzero((record.cycle[:-1] == number) & within) + 1
        if len(ends) >= 4:
            every.append(ends)
    spans = [float(record.time[ends[-1]] - record.time[ends[0] - 1]) for ends in every]
    return [ends for ends, span in zip(every, spans, strict=True) if span < RULES.block_factor * min(spans)]


def parts(record: PreparedRecord) -> list[tuple[str, NDArray[np.int64]]]:
    """What is drawn of a record: the first and the last oscillation of the main block, or all of it."""
    block = oscillations(record)
    if not block:
        return [("whole record", np.flatnonzero(record.stretch[1:] == record.stretch[:-1]) + 1)]
    # In the first interval the rig comes from another velocity.
    first = [("first oscillation", closed(record, block[0][1:]))]
    return first if len(block) == 1 else [*first, (f"oscillation {len(block)}", closed(record, block[-1]))]


def format_of(model: Model, record: PreparedRecord) -> str:
    """How a model's force over stroke or velocity is drawn: a line is a chord between the few intervals of whole records."""
    return model.dash if oscillations(record) else "."


def closed(record: PreparedRecord, ends: NDArray[np.int64]) -> NDArray[np.int64]:
    """An oscillation with the interval that follows or else the interval before, so that its loop closes."""
    after = int(ends[-1]) + 1
    if after < len(record.time) and record.stretch[after] == record.stretch[after - 1]:
        return np.append(ends, after)
    return np.insert(ends, 0, max(1, int(ends[0]) - 1))


def middle(values: Array, ends: NDArray[np.int64]) -> Array:
    """Value in the middle of the intervals that end at `ends`."""
    return (values[ends] + values[ends - 1]) / 2


def work(record: PreparedRecord, force: Array) -> Array:
    """Work [J] of every oscillation of the main block."""
    return np.array([float(force[e] @ (record.stroke[e] - record.stroke[e - 1])) for e in oscillations(record)])


def rests(record: PreparedRecord) -> list[int]:
    """Numbers of the main block's oscillations before which the damper rested."""
    stretches = [int(record.stretch[ends[0]]) for ends in oscillations(record)]
    return [i for i in range(1, len(stretches)) if stretches[i] != stretches[i - 1]]


def broken(result: RecordResult, force: Array, ends: NDArray[np.int64]) -> Array:
    """A force (n,) over the intervals that end at `ends` (k,), NaN where the record is not compared.

    There, at ramped ends above all, neighbouring points are far apart: a line between them would be a chord.
    """
    return np.where(result.weight[ends] > 0, force[ends], np.nan)


def name_of(result: RecordResult) -> str:
    """A record with its state."""
    record = result.record
    usual = bool(record.gas_preload) == is_intact(record.oil_level, gas_preload=True)
    preload = "" if usual else ", with preload" if record.gas_preload else ", no preload"
    return f"{record.oil_level * 100:.0f} % oil{preload}, {record.top_speed:.3g} m/s"
