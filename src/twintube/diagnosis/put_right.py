"""Faults of the bench that are put right before anything is judged, and what the records show of causes in no catalogue."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from twintube.data import LoadedDataset
from twintube.diagnosis.measurement.edges import with_motion
from twintube.diagnosis.measurement.faults import Fault, force_averaging, right_signs, unit_error
from twintube.diagnosis.measurement.history import settled, with_history
from twintube.diagnosis.measurement.jitter import with_uncertainty
from twintube.diagnosis.measurement.odd import odd_records
from twintube.diagnosis.measurement.outside import Signature
from twintube.diagnosis.measurement.sampling import with_sampling
from twintube.diagnosis.measurement.saturation import saturated
from twintube.diagnosis.measurement.signature import signatures
from twintube.diagnosis.measurement.zeros import zero_change, zero_drift
from twintube.diagnosis.problem import Problem
from twintube.diagnosis.records.prepare import prepare


@dataclass(frozen=True)
class Measured:
    """Records without the faults of their bench."""

    problem: Problem
    faults: tuple[Fault, ...] = ()
    odd: tuple[str, ...] = ()  # names of records that do not belong to the others, left out
    seen: tuple[Signature, ...] = ()
    remarks: tuple[str, ...] = ()
    whole: "Measured | None" = None  # with the odd records, where there are any


def put_right(dataset: LoadedDataset, turned: Fault | None, progress: Callable[[str], None]) -> Measured:
    """The records of a dataset, whose signs may have been `turned` when it was read.

    Raises InputError where a stroke leaves the tube.
    """
    progress("looking at the bench: signs, units, zeros, sampling")
    problem = Problem(dataset.damper, prepare(dataset))
    remarks = []
    if not any(record.intact for record in problem.records):
        remarks.append("no record of the intact damper: what is wrong in every state looks like an effect of the oil loss")
    turned, problem = right_signs(turned, problem)
    unit, problem = unit_error(problem)
    smoothed, problem, notes = force_averaging(dataset.records, problem)
    problem = with_motion(with_sampling(settled(problem)))
    moved, problem = zero_change(with_uncertainty(problem))
    problem, drift = zero_drift(problem)
    problem, bare = with_history(problem)
    if bare:  # what was wrong before looked like another sampling
        problem = with_uncertainty(with_sampling(problem))
    cut, problem = saturated(problem)
    faults = [fault for fault in (turned, unit, smoothed, moved) if fault is not None]
    seen = signatures(dataset.records)
    seen += [cut] if cut is not None and all(signature.name != cut.name for signature in seen) else []
    odd, others = odd_records(problem)
    every = Measured(problem, tuple(faults), (), tuple(seen), (*remarks, *notes, *drift, *([history(bare)] if bare else [])))
    return every if odd is None else replace(every, problem=others, faults=(*faults, odd), odd=odd.records, whole=every)


def history(bare: Sequence[str]) -> str:
    """What is said where the files do not hold the preconditioning."""
    return (
        f"{', '.join(bare)}: the slow strokes before the fast ones are not in the file, though the damper shows their foam "
        "and gas; the plan's preconditioning was simulated before them. Record it, too"
    )
