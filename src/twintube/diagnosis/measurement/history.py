"""What happened before a record: strokes that are not in its file leave foam and gas where the model has none."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array
from twintube.diagnosis.problem import Problem
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.rules import RULES
from twintube.rig.signals import PRECONDITIONING, STARTS, V_PRECONDITIONING, approach, joined, oscillations


def with_history(problem: Problem) -> tuple[Problem, list[str]]:
    """The problem with the plan's preconditioning before the records that do not hold it, where that explains them better.

    What another history would change is open in either case. Beyond that the names of the records that got strokes.
    """
    bare = bare_of_strokes(problem)
    if not bare:
        return problem, []
    widest = widest_stroke(problem)
    ranges = [None, (float(widest.min()), float(widest.max()))]

    def prepared(count: int, over: tuple[float, float] | None, phase: float) -> Problem:
        return problem.with_records([conditioned(r, count, over, phase) if r.name in bare else r for r in problem.records])

    # Over the range of each record or of the whole campaign; half a stroke leaves the gas in another chamber.
    ways = [(over, phase) for over in ranges for phase in STARTS.values()]
    several = [prepared(PRECONDITIONING, *way) for way in ways]
    best = min(range(len(ways)), key=lambda i: sum(logs(several[i])))
    other, short = several[best], prepared(RULES.history_least, *ways[best])
    before, after = (logs(p) for p in (problem, other))
    gained, least = np.subtract(before, after), RULES.history_gain * problem.counts
    # What has no gas or foam is the same with any history.
    clear = gained.sum() > least.sum() and (gained > least).sum() > (gained < -least).sum()
    return (uncertain(other, short), bare) if clear else (uncertain(problem, other), [])


def settled(problem: Problem) -> Problem:
    """The problem without what depends on what was before: the first oscillation of a record that is sudden or degraded."""
    return problem.with_records([begun(r) if sudden(r) else r if r.intact else under_way(r) for r in problem.records])


def uncertain(problem: Problem, other: Problem) -> Problem:
    """The problem with what the history of the `other` one changes in its forces as a further error: it is not known."""
    forces = [p.simulated(p.damping({}))[1] for p in (problem, other)]
    records = []
    for record, end, last in zip(problem.records, problem.starts[1:], other.starts[1:], strict=True):
        count = int(np.sum(record.time >= record.begin))
        change = np.zeros(len(record.time))
        change[-count:] = forces[0][end - count : end] - forces[1][last - count : last]
        records.append(replace(record, edges=np.hypot(record.edges, change)))
    return problem.with_records(records)


def logs(problem: Problem) -> Sequence[float]:
    """Twice the negative log-likelihood of each record (r,) for the model as given."""
    misfit = problem.misfits(problem.residual({}))
    return [float(x) for x in problem.counts * np.log(np.maximum(RULES.least_misfit, misfit))]


def begun(record: PreparedRecord) -> PreparedRecord:
    """The record without the first oscillation of its main block; as it is where it has few."""
    if not (record.cycle >= 0).any():
        return under_way(record)
    few = len(np.unique(record.cycle[record.cycle >= 0])) <= RULES.repeats
    return record if few else from_first(record, record.cycle >= 1)


def under_way(record: PreparedRecord) -> PreparedRecord:
    """The record from where the piston has gone the way of an oscillation over its range; as it is where it goes few."""
    way = np.cumsum(np.abs(np.diff(record.stroke, prepend=record.stroke[0]))) / float(np.ptp(record.stroke))
    return record if way[-1] < RULES.repeats * RULES.slow_way else from_first(record, way >= RULES.slow_way)


def from_first(record: PreparedRecord, late: NDArray[np.bool_]) -> PreparedRecord:
    """The record, compared from the first of its intervals that are `late` (n,); as it is where none is."""
    if not late.any():
        return record
    return replace(record, judged=record.judged & (np.arange(len(late)) >= int(np.argmax(late))))


def widest_stroke(problem: Problem) -> Array:
    """The stroke (n,) [m] of the record that goes over the widest range."""
    return max((record.stroke for record in problem.records), key=lambda stroke: float(np.ptp(stroke)))


def bare_of_strokes(problem: Problem) -> list[str]:
    """The records of the degraded damper that have no slow strokes over their range before their fast or random motion.

    Slow oscillations are strokes of their own, but where others go further.
    """
    wide = RULES.slow_reach * float(np.ptp(widest_stroke(problem)))

    def own(record: PreparedRecord) -> bool:
        return bool((record.cycle >= 0).any() and slow(record).all() and np.ptp(record.stroke) >= wide)

    return [record.name for record in problem.records if not record.intact and sudden(record) and not own(record)]


def sudden(record: PreparedRecord) -> bool:
    """Whether a record is slow all along or has no slow strokes over its range before its fast motion."""
    if record.measurement == "quasi-static":
        return False
    calm = slow(record)
    # A random motion hardly faster than preconditioning is slow for a while by chance.
    slow_motion = not (record.cycle >= 0).any() and record.top_speed < RULES.slow_random * V_PRECONDITIONING
    first = int(np.argmin(calm)) if not calm.all() and not slow_motion else 0
    before, over = record.stroke[: first + 1], float(np.ptp(record.stroke))
    return float(np.abs(np.diff(before)).sum()) < RULES.slow_way * over or float(np.ptp(before)) < RULES.slow_reach * over


def slow(record: PreparedRecord) -> NDArray[np.bool_]:
    """Where (n,) a record is as slow as preconditioning."""
    return np.asarray(np.abs(record.velocity) < RULES.slow_share * record.top_speed + V_PRECONDITIONING)


def conditioned(record: PreparedRecord, count: int, over: tuple[float, float] | None, phase: float) -> PreparedRecord:
    """The record with `count` slow oscillations of the plan before it, from `phase` [cycles] on, which are not compared.

    They go `over` a range of strokes [m], by default the record's own, and slowly on to where the record begins.
    """
    low, high = over or (float(record.stroke.min()), float(record.stroke.max()))
    middle, reach = (low + high) / 2, (high - low) / 2
    dt = 2 * np.pi * reach / V_PRECONDITIONING / RULES.intervals_slow
    slow = oscillations(V_PRECONDITIONING, reach, count, dt, phase)
    back = approach(float(slow[1][-1]), float(record.stroke[0]) - middle, dt)
    moves = abs(back[1][-1] - back[1][0]) > RULES.still * reach
    time, stroke, velocity = joined([slow, back], [dt]) if moves else slow
    n = len(time)
    time = time - time[-1] + record.time[0] - RULES.history_rest
    empty = {"noise": record.peak, "edges": 0.0, "kelvins": record.kelvins[0], "force": 0.0, "samples": 0, "judged": False,
             "cycle": -1}  # fmt: skip
    arrays: dict[str, Any] = {name: np.concatenate([np.full(n, value, getattr(record, name).dtype), getattr(record, name)])
              for name, value in empty.items()}  # fmt: skip
    moved: dict[str, Any] = {
        "time": np.concatenate([time, record.time]),
        "stroke": np.concatenate([stroke + middle, record.stroke]),
        "velocity": np.concatenate([velocity, record.velocity]),
    }
    return replace(record, **arrays, **moved)
