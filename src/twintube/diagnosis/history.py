"""What happened before a record: strokes that are not in its file leave foam and gas where the model has none."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from twintube.diagnosis.fit import Problem
from twintube.diagnosis.prepare import PreparedRecord
from twintube.diagnosis.rules import RULES
from twintube.rig.signals import PRECONDITIONING, V_PRECONDITIONING, approach, joined, oscillations


def with_history(problem: Problem) -> tuple[Problem, list[str]]:
    """The problem with the plan's preconditioning before the records that do not hold it, where that explains them better.

    What another history would change is open in either case. Beyond that the names of the records that got strokes.
    """
    bare = [record.name for record in problem.records if bare_of_strokes(record)]
    if not bare:
        return problem, []
    widest = max((record for record in problem.records), key=lambda record: float(np.ptp(record.stroke)))

    def prepared(count: int, over: PreparedRecord | None) -> Problem:
        return problem.with_records([conditioned(r, count, over or r) if r.name in bare else r for r in problem.records])

    # Over the range of each record or over that of the whole campaign.
    over = min((None, widest), key=lambda over: sum(logs(prepared(PRECONDITIONING, over))))
    other, short = (prepared(count, over) for count in (PRECONDITIONING, RULES.history_least))
    before, after = (logs(p) for p in (problem, other))
    gained = [b - a for record, b, a in zip(problem.records, before, after, strict=True) if record.name in bare]
    clear = sum(gained) > RULES.history_gain * sum(problem.counts) and sum(x > 0 for x in gained) > len(gained) / 2
    return (uncertain(other, short), bare) if clear else (uncertain(problem, other), [])


def settled(problem: Problem) -> Problem:
    """The problem without the first oscillation of the records that are sudden."""
    if not any(sudden(record) for record in problem.records):
        return problem
    return problem.with_records([begun(record) if sudden(record) else record for record in problem.records])


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
    """The record without its first oscillation, which depends on what was before it; as it is where it has few.

    Of a random motion that is the way of an oscillation over its range.
    """
    if (record.cycle >= 0).any():
        whole = record.cycle >= 1
        few = len(np.unique(record.cycle[record.cycle >= 0])) <= RULES.repeats
    else:
        way = np.cumsum(np.abs(np.diff(record.stroke, prepend=record.stroke[0]))) / float(np.ptp(record.stroke))
        whole, few = way >= RULES.slow_way, bool(way[-1] < RULES.repeats * RULES.slow_way)
    if few or not whole.any():
        return record
    after = np.arange(len(record.cycle)) >= int(np.argmax(whole))
    return replace(record, judged=record.judged & after)


def bare_of_strokes(record: PreparedRecord) -> bool:
    """Whether a record of the degraded damper has no slow strokes over its range before its fast or random motion."""
    oscillates = bool((record.cycle >= 0).any())
    return not record.intact and sudden(record) and not (oscillates and slow(record).all())


def sudden(record: PreparedRecord) -> bool:
    """Whether a record is slow all along or has no slow strokes over its range before its fast motion."""
    if record.measurement == "quasi-static":
        return False
    calm = slow(record)
    # A random motion hardly faster than preconditioning is slow for a while by chance.
    slow_motion = not (record.cycle >= 0).any() and record.top_speed < RULES.slow_random * V_PRECONDITIONING
    first = int(np.argmin(calm)) if not calm.all() and not slow_motion else 0
    way = float(np.abs(np.diff(record.stroke[: first + 1])).sum())
    return way < RULES.slow_way * float(np.ptp(record.stroke))


def slow(record: PreparedRecord) -> NDArray[np.bool_]:
    """Where (n,) a record is as slow as preconditioning."""
    return np.asarray(np.abs(record.velocity) < RULES.slow_share * record.top_speed + V_PRECONDITIONING)


def conditioned(record: PreparedRecord, count: int, over: PreparedRecord) -> PreparedRecord:
    """The record with `count` slow oscillations of the plan, over the range of `over`, before it; they are not compared."""
    middle, reach = float(over.stroke.max() + over.stroke.min()) / 2, float(np.ptp(over.stroke)) / 2
    dt = 2 * np.pi * reach / V_PRECONDITIONING / RULES.intervals_slow
    slow = oscillations(V_PRECONDITIONING, reach, count, dt)
    back = approach(0.0, float(record.stroke[0]) - middle, dt)
    time, stroke, velocity = joined(
        [slow, back] if abs(back[1][-1]) > 1e-6 else [slow], [dt] if abs(back[1][-1]) > 1e-6 else []
    )
    n = len(time)
    time = time - time[-1] + record.time[0] - RULES.history_rest
    empty = {
        "noise": record.peak,
        "edges": 0.0,
        "warm": 0.0,
        "force": 0.0,
        "samples": 0,
        "judged": False,
        "cycle": -1,
        "stretch": -1,
    }
    arrays: dict[str, Any] = {name: np.concatenate([np.full(n, value, getattr(record, name).dtype), getattr(record, name)])
              for name, value in empty.items()}  # fmt: skip
    moved: dict[str, Any] = {
        "time": np.concatenate([time, record.time]),
        "stroke": np.concatenate([stroke + middle, record.stroke]),
        "velocity": np.concatenate([velocity, record.velocity]),
    }
    return replace(record, **arrays, **moved)
