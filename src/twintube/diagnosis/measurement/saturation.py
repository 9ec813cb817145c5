"""Forces that stay at a limit while the model's rise: a load cell or amplifier at its limit, with noise on what it gives.

A limit without noise is seen in the samples (data/check/defects.py) before any model is asked.
"""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from twintube.common.arrays import Array
from twintube.diagnosis.measurement.outside import Signature
from twintube.diagnosis.problem import Problem
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.rules import RULES


@dataclass(frozen=True)
class Limit:
    """A limit [N] of a record's force, and the intervals (n,) in which the model is beyond it."""

    record: str
    force: float
    beyond: NDArray[np.bool_]


def saturated(problem: Problem) -> tuple[Signature | None, Problem]:
    """The limit that the forces of some records do not pass, and the problem without the intervals beyond it."""
    forces = problem.forces({})
    limits: list[Limit] = []
    # Beside what is beyond the limit of one side, that of the other explains hardly any of the error.
    for _ in range(2):
        records = without(problem.records, limits)
        known = {item.force > 0.0 for item in limits}
        more = [item for item in shown(records, problem, forces) if (item.force > 0.0) not in known]
        limits += [*more, *alike(records, problem, forces, more)]
    limits = limits or cut(problem, forces)
    sides = [[item for item in limits if item.force * sign > 0.0] for sign in (1.0, -1.0)]
    if not limits or any(
        np.ptp([item.force for item in side]) > RULES.limit_alike * abs(side[0].force) for side in sides if side
    ):
        return None, problem
    values = " and ".join(f"{np.mean([item.force for item in side]):.0f} N" for side in sides if side)
    names = list(dict.fromkeys(item.record for item in limits))
    text = (
        f"the force stays at about {values} in {', '.join(names)} while the model's rises on (left out here): the load "
        "cell or its amplifier is at its limit"
    )
    return Signature("saturation", text, np.inf), problem.with_records(without(problem.records, limits))


def without(records: Sequence[PreparedRecord], limits: Sequence[Limit]) -> list[PreparedRecord]:
    """The records without the intervals beyond the limits."""
    left = []
    for record in records:
        beyond = [item.beyond for item in limits if item.record == record.name]
        left.append(replace(record, judged=record.judged & ~np.logical_or.reduce(beyond)) if beyond else record)
    return left


def shown(records: Sequence[PreparedRecord], problem: Problem, forces: Array) -> list[Limit]:
    """The limits that the records show by themselves; `forces` (n,) [N] are the model's."""
    limits = []
    for record, (a, b) in zip(records, itertools.pairwise(problem.starts), strict=True):
        for sign in (1.0, -1.0):
            found = limit(record, sign * forces[a:b], sign * record.force)
            if found is not None:
                limits.append(replace(found, force=sign * found.force))
    return limits


def alike(records: Sequence[PreparedRecord], problem: Problem, forces: Array, limits: Sequence[Limit]) -> list[Limit]:
    """The same limits in the other records, where no force passes them: it is a channel's, whatever shows it.

    Of a motion with constant velocity the model does not rise on beyond the limit.
    """
    others = []
    for sign in (1.0, -1.0):
        known = {item.record: sign * item.force for item in limits if sign * item.force > 0.0}
        level = float(np.mean(list(known.values()))) if known else np.inf
        for record, (a, b) in zip(records, itertools.pairwise(problem.starts), strict=True):
            beyond = sign * forces[a:b] > level
            scatter = RULES.limit_flat * record.noise + record.edges
            passed = record.judged & (sign * record.force - scatter > (1.0 + RULES.limit_alike) * level)
            if record.name not in known and (record.judged & beyond).any() and not passed.any():
                others.append(Limit(record.name, sign * level, beyond | np.roll(beyond, 1) | np.roll(beyond, -1)))
    return others


def cut(problem: Problem, forces: Array) -> list[Limit]:
    """Limits (both sides) that explain records which the model contradicts, where no record's force passes them.

    Of a motion with constant velocity the whole stroke is beyond a limit, of one side or of both; another damper or setting
    changes the other side, too.
    """
    # Beside steps of the force a filter overshoots.
    highest = max(float((np.abs(r.force) - r.edges)[r.judged].max(initial=0.0)) for r in problem.records)
    misfits = problem.misfits(problem.residual({}))
    usual = max(1.0, float(np.median(misfits)))
    limits = []
    for record, (a, b), misfit in zip(problem.records, itertools.pairwise(problem.starts), misfits.tolist(), strict=True):
        if misfit < RULES.odd * usual:
            continue
        model = forces[a:b]
        top = float(np.abs(model).max())
        data = (model[record.judged], record.force[record.judged], problem.weight[a:b][record.judged])
        best = minimize_scalar(cut_misfit, args=data, bounds=(0.5 * top, top), method="bounded")
        level = float(best.x)
        beyond = np.abs(model) > level
        least = max(RULES.odd_right * usual, RULES.odd_left * misfit)
        at_top = highest <= (1.0 + RULES.limit_alike) * level and top - level > RULES.limit_far * record.peak
        if at_top and best.fun <= least and (record.judged & beyond).sum() >= RULES.limit_least:
            around = beyond | np.roll(beyond, 1) | np.roll(beyond, -1)
            limits += [Limit(record.name, sign * level, around) for sign in (1.0, -1.0) if (sign * model > level).any()]
    return limits


def cut_misfit(level: float, model: Array, force: Array, weight: Array) -> float:
    """Mean squared weighted error [1] of a `model` (n,) [N] that is cut at a level [N] on both sides."""
    return float(np.mean((weight * (np.clip(model, -level, level) - force)) ** 2))


def limit(record: PreparedRecord, model: np.ndarray, force: np.ndarray) -> Limit | None:
    """The upper limit of a record's `force` (n,) [N] where that of the `model` (n,) passes it by far; None without any."""
    judged = record.judged
    if not judged.any():
        return None
    top = float(force[judged].max())
    beyond = judged & (model > top)
    if beyond.sum() < RULES.limit_least or top <= 0.0:
        return None
    # On the plateau the force does not follow the model's.
    away = model[beyond] - model[beyond].mean()
    follows = float(away @ force[beyond]) / max(float(away @ away), 1e-12)
    usual = float(np.sqrt(np.mean(np.broadcast_to(record.noise, force.shape)[beyond] ** 2)))
    level = float(force[beyond].mean())
    flat = abs(follows) < RULES.limit_follows and float(force[beyond].std()) < RULES.limit_flat * usual
    far = (
        float(np.mean(model[beyond] - level)) > RULES.limit_far * record.peak
        and float(model[beyond].std()) > RULES.limit_flat * usual
    )
    squares = (model - force) ** 2
    whole = float(squares[judged].sum())
    around = beyond | np.roll(beyond, 1) | np.roll(beyond, -1)
    explained = float(squares[judged & around].sum()) > RULES.limit_share * whole
    return Limit(record.name, level, around) if flat and far and explained else None
