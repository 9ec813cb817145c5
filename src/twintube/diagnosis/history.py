"""What happened before a record: strokes that are not in its file leave foam and gas where the model has none."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from twintube.diagnosis.fit import Problem
from twintube.diagnosis.prepare import PreparedRecord
from twintube.diagnosis.rules import RULES
from twintube.rig.signals import PRECONDITIONING, V_PRECONDITIONING, approach, joined, oscillations


def with_history(problem: Problem) -> tuple[Problem, list[str]]:
    """The problem with the plan's preconditioning before the records that do not hold it, where that explains them better.

    Beyond that the names of these records.
    """
    bare = [record.name for record in problem.records if unprepared(record)]
    if not bare:
        return problem, []
    other, short = (
        problem.with_records([conditioned(r, count) if r.name in bare else r for r in problem.records])
        for count in (PRECONDITIONING, RULES.history_least)
    )
    before, after = (logs(p) for p in (problem, other))
    gained = [b - a for record, b, a in zip(problem.records, before, after, strict=True) if record.name in bare]
    clear = sum(gained) > RULES.history_gain * sum(problem.counts) and sum(x > 0 for x in gained) > len(gained) / 2
    return (uncertain(other, short), bare) if clear else (problem, [])


def uncertain(problem: Problem, short: Problem) -> Problem:
    """The problem with what a shorter history changes in its forces as a further error: how long it was is not known."""
    forces = [p.simulated(())[1] for p in (problem, short)]
    records = []
    for record, end, other in zip(problem.records, problem.starts[1:], short.starts[1:], strict=True):
        count = int(np.sum(record.time >= record.begin))
        change = np.zeros(len(record.time))
        change[-count:] = forces[0][end - count : end] - forces[1][other - count : other]
        records.append(replace(record, edges=np.hypot(record.edges, change)))
    return problem.with_records(records)


def logs(problem: Problem) -> Sequence[float]:
    """Twice the negative log-likelihood of each record (r,) for the model as given."""
    misfit = problem.misfits(problem.residual({}))
    return [float(x) for x in problem.counts * np.log(np.maximum(RULES.least_misfit, misfit))]


def unprepared(record: PreparedRecord) -> bool:
    """Whether a record of the degraded damper comes to a fast motion without slow strokes over its range before it."""
    if record.intact or record.measurement == "quasi-static":
        return False
    slow = np.abs(record.velocity) < RULES.slow_share * record.top_speed + V_PRECONDITIONING
    first = int(np.argmin(slow)) if not slow.all() else len(slow)
    way = float(np.abs(np.diff(record.stroke[: first + 1])).sum())
    return way < RULES.slow_way * float(np.ptp(record.stroke)) and not slow.all()


def conditioned(record: PreparedRecord, count: int) -> PreparedRecord:
    """The record with `count` of the plan's slow oscillations, over its own range, before it; they are not compared."""
    middle, reach = float(record.stroke.max() + record.stroke.min()) / 2, float(np.ptp(record.stroke)) / 2
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
