"""From a dataset to its diagnosis."""

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from twintube.arrays import Array
from twintube.dampers.freed_gas import as_before, as_published
from twintube.data import ReferenceGivenError, has_reference, require_fills
from twintube.data.findings import unconfirmed
from twintube.data.signs import SIGNS
from twintube.diagnosis.fits.candidates import LATE, RECALIBRATE, candidates
from twintube.diagnosis.fits.fit import Problem
from twintube.diagnosis.fits.gains import bootstrap, gains, whole, worst
from twintube.diagnosis.fits.options import Fold
from twintube.diagnosis.measurement.edges import with_memory, with_motion, with_noise, with_outliers, without_outliers
from twintube.diagnosis.measurement.faults import STRANGER, Fault, force_averaging, read, right_signs, scaled, unit_error
from twintube.diagnosis.measurement.history import bare_of_strokes, settled, with_history
from twintube.diagnosis.measurement.jitter import with_uncertainty
from twintube.diagnosis.measurement.odd import GAINS, odd_records
from twintube.diagnosis.measurement.sampling import with_sampling
from twintube.diagnosis.measurement.saturation import saturated
from twintube.diagnosis.measurement.signature import signatures
from twintube.diagnosis.measurement.zeros import zero_change, zero_drift
from twintube.diagnosis.records.prepare import prepare
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.result import Diagnosis, Gain
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.selection.select import Selector
from twintube.diagnosis.verdict.answer import answer, predictions, simulated
from twintube.engine.simulate import InputError
from twintube.fitting.splits import distinct

Halves = tuple[list[PreparedRecord], list[PreparedRecord]]  # to fit and to judge on
BY_VELOCITY = "every record is predicted from those of other velocities: every second velocity is held out in turn"
WITHIN = (
    "the cause acts in so few records that no others predict it: every second tenth of each record is held out in turn, "
    "predicted from the others, without most records that the model explains anyway. Repeat those in which it acts"
)


def diagnose(path: str | Path, progress: Callable[[str], None] = lambda text: None, *, tolerance: float = 0.0) -> Diagnosis:
    """Diagnose a dataset folder; `tolerance` is the error accepted of a good damper, a share of each record's largest force.

    Raises DataError with all defects of the records, and InputError where they do not allow to judge on held-out records.
    """
    if not 0.0 <= tolerance <= RULES.most_tolerance:
        raise InputError(f"tolerance = {tolerance:g}: must be from 0 to {RULES.most_tolerance:g} of the largest force")
    began = time.monotonic()
    progress("reading the records")
    given, turned = read(path)
    require_fills(given.records, "`twintube diagnose` and twintube.evidence.answer seek it")
    if has_reference(given.records):
        raise ReferenceGivenError(
            "some records are a reference: `twintube diagnose` and twintube.evidence.answer compare with it"
        )
    # Blocks of seconds, on which the paper's equations alone were fitted.
    dataset = replace(given, damper=as_published(given.damper))
    records = prepare(dataset)
    remarks = unconfirmed(dataset.findings)
    if not any(record.intact for record in records):
        remarks.append("no record of the intact damper: what is wrong in every state looks like an effect of the oil loss")
    turned, problem = right_signs(turned, Problem(dataset.damper, records, tolerance=tolerance))
    remarks += [finding.message for finding in dataset.findings if turned is None and finding.column == SIGNS]
    recorded = problem
    wrong, problem = unit_error(problem)
    smoothed, problem, notes = force_averaging(dataset.records, problem)
    problem = with_motion(with_sampling(settled(problem)))
    recorded = recorded.with_usual(problem.usual)
    stepped, problem = zero_put_right(with_uncertainty(problem))
    problem, drift = zero_drift(problem)
    known = not bare_of_strokes(problem)
    problem, bare = with_history(problem)
    if bare:  # what was wrong before looked like another sampling
        problem = with_noise(with_sampling(problem))
    calm, outliers = without_outliers(problem)
    cut, problem = saturated(calm)
    outliers = {} if cut is not None else outliers  # what lies beyond a limit stays left out
    remarks += [*notes, *drift, *([history_remark(bare)] if bare else [])]
    if turned is not None:
        force, stroke = (1.0 if turned.channel == other else 1.0 / turned.factor for other in ("stroke", "force"))
        recorded = recorded.with_records(
            [scaled(r, force, stroke) if r.name in turned.records else r for r in recorded.records]
        )

    seen = signatures(dataset.records)
    seen += [cut] if cut is not None and all(signature.name != cut.name for signature in seen) else []

    def concluded(judged: Problem, odd: Fault | None = None, *, inside: bool = True) -> Diagnosis:
        """The answer to some records without the `odd`; `inside` says that a cause may be known from within a record."""
        faults = put_right(before, recorded, judged)
        if odd is not None:
            faults[odd] = excluded_gain(recorded, judged)

        def by(judged: Problem, folds: Sequence[Halves], label: str) -> Diagnosis:
            selector = selector_of(judged, folds, history=known)
            selection = selector.run(lambda text: progress(label + text))
            progress(label + "fitting the model to all records")
            return answer(dataset, judged, selector, selection, seen, faults)

        folds, split_remarks = split(dataset.title, judged.records)
        answered = by(judged, folds, "")
        left = {r.record.name: r.extended - r.measured for r in answered.records}
        remembering = with_memory(judged, left) if answered.verdict == "unexplained" else None
        if remembering is not None:
            judged = remembering
            folds, split_remarks = split(dataset.title, judged.records)
            answered = by(judged, folds, "with the memory of noise: ")
        few = inside and split_remarks == [BY_VELOCITY] and len(answered.causes) < RULES.rounds
        wrong = contradicted(with_outliers(judged, outliers), answered) if few else None
        tenths = within(wrong.records) if wrong is not None else []
        if wrong is not None and tenths:
            closer = by(wrong, tenths, "within the records: ")
            if says_more(answered, closer):
                answered, split_remarks = closer, [WITHIN]
        return replace(answered, remarks=[*split_remarks, *remarks, *answered.remarks])

    before = [fault for fault in (turned, wrong, smoothed, stepped) if fault is not None]

    def answer_of(judged: Problem) -> Diagnosis:
        odd, others = odd_records(judged)
        if odd is None:
            return concluded(judged)
        if odd.effect == STRANGER:
            # Some records may differ because a cause acts in them alone, as foam does after a rest. Where a gain explains a
            # single record, a cause that no other shows does not stand against it.
            answered = concluded(judged, inside=odd.name not in GAINS)
            if len(answered.causes) > len(before):
                return answered
        part = judged.with_records([record for record in judged.records if record.name in odd.records])
        return replace(concluded(others, odd), left_out=simulated(part, "left_out", [{}, {}, {}]))

    # A step that a cause moves is wrong in few intervals, too, but in several records.
    answered = answer_of(with_outliers(problem, outliers)) if len(outliers) > RULES.outlier_records else None
    if answered is None or (len(answered.causes) == len(before) and answered.verdict != RECALIBRATE):
        answered = answer_of(problem)
    base, recalibrated, extended = (
        as_before(damper, given.damper) for damper in (answered.base, answered.recalibrated, answered.extended)
    )
    return replace(
        answered, seconds=time.monotonic() - began, tolerance=tolerance,
        base=base, recalibrated=recalibrated, extended=extended,
    )  # fmt: skip


def contradicted(problem: Problem, answered: Diagnosis) -> Problem | None:
    """The few records in which an answer leaves more than noise, with some others; None where there are none.

    Of other degradation parameters, the few that ask for them: a cause may be at work there.
    """
    model = "base" if answered.verdict == RECALIBRATE else "extended"
    results = {r.record.name: r for r in answered.records}
    wrong: list[PreparedRecord] = []
    right: list[PreparedRecord] = []
    for record, a, b in zip(problem.records, problem.starts[:-1], problem.starts[1:], strict=True):
        error = getattr(results[record.name], model) - results[record.name].measured
        squares = np.sort((problem.weight[a:b] * error)[record.judged] ** 2)[: -RULES.few_intervals]
        (wrong if float(squares.sum()) > RULES.odd_right * len(squares) else right).append(record)
    if not 0 < len(wrong) <= RULES.odd_share * len(problem.records):
        return None
    others = problem.with_records(right).sparse(RULES.start_records, np.ones(len(right)))
    return problem.with_records([*wrong, *others.records])


def says_more(answered: Diagnosis, closer: Diagnosis) -> bool:
    """Whether another answer names all causes of an answer and further ones, or others that leave far less of the error.

    Other degradation parameters are an answer like a cause; a cause that leaves as little is simpler. What makes the force
    late must leave far less of several records, where more than noise was left: between two samples a step of the force is
    late by chance, and nothing of a record is left out there. Nothing is taken that the zero of a single record would
    explain as well.
    """
    before, after = (
        {cause.effect for cause in some.causes} | ({RECALIBRATE} if some.verdict == RECALIBRATE else set())
        for some in (answered, closer)
    )
    if not after - before:
        return False
    first = {r.record.name: r for r in answered.records}
    left, beside_zeros, asked = np.zeros(2), np.zeros(2), 0
    for r in closer.records:
        power = max(float(r.weight @ r.weight), np.finfo(float).tiny)
        asked += int(np.sum(((r.base - r.measured) * r.weight) ** 2) > RULES.odd_right * np.sum(r.weight > 0.0))
        for i, some in enumerate((first[r.record.name], r)):
            error = (some.extended - r.measured) * r.weight
            left[i] += error @ error
            beside_zeros[i] += error @ error - (error @ r.weight) ** 2 / power
    if (after - before) & set(LATE):
        samples = sum(int(np.sum(r.weight > 0.0)) for r in closer.records)
        wrong = asked >= RULES.late_records and left[0] > RULES.odd_right * samples
        if not wrong or left[1] >= RULES.explains_more * left[0]:
            return False
    if RECALIBRATE in after and asked < RULES.calibrated_records:
        return False  # so many parameters are not known from a single record
    if RECALIBRATE in before:
        return bool(left[1] <= (1.0 + RULES.close) * left[0])
    if beside_zeros[0] - beside_zeros[1] < RULES.half * (left[0] - left[1]):
        return False
    return before < after or bool(left[1] < RULES.explains_more * left[0])


def history_remark(bare: Sequence[str]) -> str:
    """What is said where the files do not hold the preconditioning."""
    return (
        f"{', '.join(bare)}: the slow strokes before the fast ones are not in the file, though the damper shows their foam "
        "and gas; the plan's preconditioning was simulated before them. Record it, too"
    )


def selector_of(problem: Problem, folds: Sequence[Halves], *, history: bool = True) -> Selector:
    """The selector for the records to fit and to judge on, fold by fold; `history` says whether it is known of all."""
    several = [Fold(*(problem.with_records(some) for some in (fitted, held))) for fitted, held in folds]
    # With a single fold the held-out records are never fitted, with several every record is held out of some fold.
    return Selector(several[0].fitted if len(several) == 1 else problem, candidates(problem), several, history=history)


def known_gain(path: str | Path, causes: Sequence[str]) -> float:
    """Share of the explainable held-out error that goes away with the given causes, whatever a diagnosis would choose."""
    dataset, _ = read(path)
    sampled = with_sampling(settled(Problem(as_published(dataset.damper), prepare(dataset))))
    problem, _ = zero_drift(with_uncertainty(sampled))
    selector = selector_of(problem, split(dataset.title, problem.records)[0])
    option = selector.start
    for name in causes:
        option = selector.extended(option, name)
    return whole(gains(predictions(selector, (selector.start, selector.start, option))))


def excluded_gain(recorded: Problem, problem: Problem) -> Gain:
    """What leaving a record out takes away of the error of all, relative to the squared force as for other faults."""
    kept = {record.name for record in problem.records}
    rows = []
    for record, a, b in zip(recorded.records, recorded.starts[:-1] + 1, recorded.starts[1:], strict=True):
        squares = float(np.sum((recorded.forces({})[a:b] - recorded.measured[a:b]) ** 2))
        rows.append((0.0 if record.name in kept else squares, squares))
    table = np.array(rows)
    return Gain(whole(table), whole(table), (0.0, 1.0), worst(table))


def zero_put_right(problem: Problem) -> tuple[Fault | None, Problem]:
    """A zero that moves, and the problem without it; none that would be named against its own figure."""
    stepped, still = zero_change(problem)
    if stepped is not None and put_right([stepped], problem, still)[stepped].heldout <= 0.0:
        return None, problem
    return stepped, still


def put_right(faults: Sequence[Fault | None], recorded: Problem, problem: Problem) -> dict[Fault, Gain]:
    """The faults that were put right, with the gain of all of them for the base model.

    Errors are relative to the force, as units and signs differ; an interval counts by its uncertainty. Nothing is fitted, so
    that every record counts as held out.
    """
    present = [fault for fault in faults if fault is not None]
    if not present:
        return {}

    weights = {
        record.name: problem.weight[a:b]
        for record, a, b in zip(problem.records, problem.starts[:-1], problem.starts[1:], strict=True)
    }

    def shares(p: Problem) -> Array:
        forces = p.forces({})
        rows = []
        for record, a, b in zip(p.records, p.starts[:-1], p.starts[1:], strict=True):
            # Slow strokes that were not recorded stand before the record in one of the two problems.
            weight = weights[record.name]
            recorded = slice(max(a, b - len(weight)), b)
            weight = weight[-(recorded.stop - recorded.start) :]
            size = float(np.sum((weight * p.measured[recorded]) ** 2))
            error = float(np.sum((weight * (forces - p.measured)[recorded]) ** 2))
            rows.append((error / size, float(np.sum(weight > 0)) / size))
        return np.array(rows)

    kept = {record.name for record in problem.records}
    before, after = shares(recorded.with_records([r for r in recorded.records if r.name in kept])), shares(problem)
    less = before[:, 0] - np.maximum(after[:, 0], after[:, 1])
    rows = np.column_stack([less, np.maximum(before[:, 0] - after[:, 1], 1e-9)])
    return dict.fromkeys(present, Gain(whole(rows), whole(rows), bootstrap(rows), worst(rows)))


def split(title: str, records: Sequence[PreparedRecord]) -> tuple[list[Halves], list[str]]:
    """The records to fit and to judge on, fold by fold, and remarks on the choice.

    Where the dataset states nothing every other velocity is held out, then the others; where all have one velocity, every
    other tenth of each record. A quasi-static record is always fitted. Raises InputError where there is nothing to judge on.
    """
    if any(record.split for record in records):
        held = [record for record in records if record.split == "heldout"]
        fitted = [record for record in records if record.split != "heldout"]
        if not fitted or not held:
            raise InputError(f"{title}: {len(held)} of {len(records)} records are held out, some must be and some must not")
        return [(fitted, held)], []
    moving = {i: record.top_speed for i, record in enumerate(records) if record.measurement != "quasi-static"}
    speeds = distinct(moving.values(), RULES.equal_speeds)
    if not speeds:
        raise InputError(f"{title}: only quasi-static records, there is no velocity to judge on")
    if len(speeds) < 2:
        folds = within(records)
        if not folds:
            raise InputError(f"{title}: all records have one velocity and are too short to be split")
        text = "all records have one velocity: every second tenth of each is held out in turn, predicted from the others"
        return folds, [text]
    place = {i: int(np.searchsorted(speeds, speed, side="right")) for i, speed in moving.items()}
    halves = [[i for i, number in place.items() if number % 2 == half] for half in (0, 1)]
    folds = [([r for i, r in enumerate(records) if i not in held], [records[i] for i in held]) for held in halves]
    return folds, [BY_VELOCITY]


def within(records: Sequence[PreparedRecord]) -> list[Halves]:
    """Every second tenth of each record to fit and to judge on, then exchanged; none where all are too short.

    Records that are too short, and quasi-static ones, are always fitted.
    """
    long = RULES.parts * RULES.part_least
    judged = [r for r in records if r.measurement != "quasi-static" and r.judged.sum() >= long]
    fitted = [r for r in records if all(r is not other for other in judged)]
    halves = [[record.alternate(half) for record in judged] for half in (0, 1)]
    return [([*fitted, *halves[0]], halves[1]), ([*fitted, *halves[1]], halves[0])] if judged else []
