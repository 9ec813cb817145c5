"""What the pictures of a diagnosis are made of: telling records, oscillations, work, and which simulations differ."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from twintube.arrays import Array
from twintube.diagnosis.prepare import Case
from twintube.diagnosis.result import Diagnosis, RecordResult
from twintube.report import style

SHOWN = 6  # records of which curves are drawn
FAST = 1.5  # of the shortest oscillation: longer ones belong to another block


@dataclass(frozen=True)
class Model:
    """A simulation that is worth a curve of its own."""

    name: str  # attribute of RecordResult, key of Diagnosis.errors
    label: str
    colour: str
    dash: str

    def force(self, record: RecordResult) -> Array:
        """Its force (n,) [N] in a record."""
        force: Array = getattr(record, self.name)
        return force


BASE = Model("base", "base model", style.BLUE, "--")
RECALIBRATED = Model("recalibrated", "recalibrated model", style.GREEN, "-")


def alike(record: RecordResult, a: Array, b: Array) -> bool:
    """Whether two simulations of a record are one and the same curve."""
    return bool(np.allclose(a, b, rtol=0.0, atol=1e-6 * record.case.peak))


def models(d: Diagnosis) -> list[Model]:
    """The simulations that differ from one another in any record: base, recalibrated, extended."""
    told = "fault accounted for" if d.verdict == "measurement_fault" else "extended model"
    extended = Model("extended", told, style.RED, "-")
    found = [BASE]
    for model in (RECALIBRATED, extended):
        if all(any(not alike(r, model.force(r), other.force(r)) for r in d.records) for other in found):
            found.append(model)
    return found


def compared(d: Diagnosis) -> list[Model]:
    """The base model and, where there is one, the best of the others."""
    found = models(d)
    return [found[0], *found[1:][-1:]]


def drawn(record: RecordResult, chosen: list[Model]) -> list[Model]:
    """Those of `chosen` that differ in this record."""
    return [m for i, m in enumerate(chosen) if not any(alike(record, m.force(record), n.force(record)) for n in chosen[:i])]


def ranked(d: Diagnosis) -> list[RecordResult]:
    """The records by their base error, held-out ones first."""
    return sorted(d.records, key=lambda r: (r.split != "heldout", -r.rms(r.base)))


def telling(d: Diagnosis) -> list[RecordResult]:
    """Those of the largest base error, preferably held out and with oscillations."""
    return sorted(ranked(d), key=lambda r: not oscillations(r.case))[:SHOWN]


def oscillations(case: Case) -> list[NDArray[np.int64]]:
    """The main block: for each oscillation the samples at which its intervals end."""
    within = case.stretch[1:] == case.stretch[:-1]
    found = []
    for number in np.unique(case.cycle[case.cycle >= 0]):
        ends = np.flatnonzero((case.cycle[:-1] == number) & within) + 1
        if len(ends) >= 4:
            found.append(ends)
    spans = [float(case.time[ends[-1]] - case.time[ends[0] - 1]) for ends in found]
    return [ends for ends, span in zip(found, spans, strict=True) if span < FAST * min(spans)]


def parts(case: Case) -> list[tuple[str, NDArray[np.int64]]]:
    """What is drawn of a record: the first and the last oscillation of the main block, or all of it."""
    block = oscillations(case)
    if not block:
        return [("whole record", np.flatnonzero(case.stretch[1:] == case.stretch[:-1]) + 1)]
    # In the first interval the rig comes from another velocity.
    first = [("first oscillation", closed(case, block[0][1:]))]
    return first if len(block) == 1 else [*first, (f"oscillation {len(block)}", closed(case, block[-1]))]


def closed(case: Case, ends: NDArray[np.int64]) -> NDArray[np.int64]:
    """An oscillation with the interval that follows, or else the one before, so that its loop closes."""
    after = int(ends[-1]) + 1
    if after < len(case.time) and case.stretch[after] == case.stretch[after - 1]:
        return np.append(ends, after)
    return np.insert(ends, 0, max(1, int(ends[0]) - 1))


def middle(values: Array, ends: NDArray[np.int64]) -> Array:
    """Value in the middle of the intervals that end at `ends`."""
    return (values[ends] + values[ends - 1]) / 2


def work(case: Case, force: Array) -> Array:
    """Work [J] of every oscillation of the main block."""
    return np.array([float(force[ends] @ (case.stroke[ends] - case.stroke[ends - 1])) for ends in oscillations(case)])


def rests(case: Case) -> list[int]:
    """Numbers of the main block's oscillations before which the damper rested."""
    stretches = [int(case.stretch[ends[0]]) for ends in oscillations(case)]
    return [i for i in range(1, len(stretches)) if stretches[i] != stretches[i - 1]]


def noise(record: RecordResult) -> float:
    """Root mean square [N] of the noise of a record's intervals, as an error of a simulation counts them."""
    return float(np.sqrt(np.mean(np.square(record.case.noise[1:]))))


def name_of(record: RecordResult) -> str:
    """A record with its state."""
    case = record.case
    usual = bool(case.preload) == (case.oil_level >= 0.995)
    preload = "" if usual else ", with preload" if case.preload else ", no preload"
    return f"{case.oil_level * 100:.0f} % oil{preload}, {case.top_speed:.3g} m/s"
