"""Faults of the measurement that are looked for before any physics: a turned sign, a wrong unit, a smoothed force."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PPoly

from twintube.common.arrays import Array
from twintube.core.checks import tube_limit
from twintube.data import LoadedDataset, Record, check_dataset, load_dataset
from twintube.data.records.signs import AS_STATED, TURNED, errors
from twintube.diagnosis.measurement.signature import oscillating
from twintube.diagnosis.problem import Problem
from twintube.diagnosis.records.prepare import prepare
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.rules import RULES
from twintube.fitting.averaging import averaging, through

# Factors by which a channel is wrong if its unit is not the stated one.
FORCE_UNITS = {"kN for N": 1e3, "N for kN": 1e-3, "lbf for N": 4.4482216, "N for lbf": 1 / 4.4482216,
               "kgf for N": 9.80665, "N for kgf": 1 / 9.80665,
               "daN for N": 10.0, "N for daN": 0.1}  # fmt: skip
STROKE_UNITS = {
    "m for mm": 1e3,
    "mm for m": 1e-3,
    "cm for mm": 10.0,
    "mm for cm": 0.1,
    "in for mm": 25.4,
    "mm for in": 1 / 25.4,
}


BOTH_SIGNS = "Signs of stroke and force"
STRANGER = "odd_record"  # a record of something else
DROPOUTS = "dropouts"  # single intervals


@dataclass(frozen=True)
class Fault:
    """A fault that was put right before the diagnosis went on."""

    effect: str  # sign_flip, unit_error, force_averaging, STRANGER or that of a channel
    title: str
    explanation: str
    factor: float
    name: str = "factor"
    unit: str = "1"
    records: tuple[str, ...] = ()  # names of those that have it; empty where all have
    channel: str = "force"
    spread: float = 0.0  # half the width of the 90 % interval of its factor; 0 where that is exact


def read(path: str | Path) -> tuple[LoadedDataset, Fault | None]:
    """The dataset, forces turned or kN taken for N where only that makes a record readable.

    Raises DataError with what else is wrong.
    """
    checked = check_dataset(path)
    for factor, message in ((-1, "work of"), (1000, "N and kN mixed up")):
        if not checked.errors or not all(message in finding.message for finding in checked.errors):
            continue
        other = check_dataset(path, force_factor=factor)
        straight = {record.file for record in checked.records}
        added = [record for record in other.records if record.file not in straight]
        wrong = {finding.file for finding in checked.errors}
        if other.damper is None or not added or wrong & {finding.file for finding in other.errors}:
            continue
        names = tuple(record.name for record in added)
        of = f" of {', '.join(names)}" if straight else ""
        data = LoadedDataset(checked.title, other.damper, [*checked.records, *added], checked.findings)
        if factor < 0:
            text = f"The force channel{of} has the other sign."
            return data, Fault("sign_flip", "Sign of the force channel", text, -1.0, records=names)
        # A channel that holds nothing but noise is no kN.
        part = Problem(other.damper, prepare(replace(data, records=added)))
        if relative(part).mean() < RULES.followed_force:
            text = f"The force channel{of} holds kN for N."
            return data, Fault("unit_error", "Unit of the force: kN for N", text, 1e3, records=names)
    return load_dataset(path), None


def scaled(record: PreparedRecord, force: float, stroke: float) -> PreparedRecord:
    """A record with its channels in other units."""
    return replace(
        record, force=record.force * force, noise=record.noise * abs(force), peak=record.peak * abs(force),
        path=PPoly(record.path.c * stroke, record.path.x), resolution=record.resolution * abs(force),
        stroke=record.stroke * stroke, velocity=record.velocity * stroke, top_speed=record.top_speed * abs(stroke),
        stroke_noise=record.stroke_noise * abs(stroke),
    )  # fmt: skip


def right_signs(turned: Fault | None, problem: Problem) -> tuple[Fault | None, Problem]:
    """The turned sign of a channel or of both that the model, too, tells, if there is any; the problem with right signs."""
    fault, right = really_turned(turned, problem)
    return both_turned(right) if fault is None else (fault, right)


def really_turned(turned: Fault | None, problem: Problem) -> tuple[Fault | None, Problem]:
    """The turned sign with which the model, too, explains the records far better, if there is any, and these records.

    The work of a record is negative with either channel turned, and that of a long record also if a clock is wrong.
    """
    if turned is None or turned.effect != "sign_flip":
        return turned, problem
    part = problem.with_records([r for r in problem.records if r.name in turned.records])
    as_recorded = part.with_records([scaled(r, -1.0, 1.0) for r in part.records])
    stroke = part.with_records([scaled(r, 1.0, -1.0) for r in as_recorded.records])
    better: tuple[Fault | None, Problem] = min(
        ((turned, part), (stroke_turned(turned), stroke)), key=lambda pair: float(relative(pair[1]).mean())
    )
    if relative(better[1]).mean() > relative(as_recorded).mean() - RULES.unit_gain:
        better = (None, as_recorded)
    fault, best = better
    changed = {record.name: record for record in best.records}
    whole = problem.with_records([changed.get(record.name, record) for record in problem.records])
    return (fault, whole) if fault is None or fault.channel != "force" else all_turned(fault, whole)


def all_turned(fault: Fault, problem: Problem) -> tuple[Fault, Problem]:
    """With the records, too, whose work does not tell the sign, as of a slow stroke, where the model tells it clearly."""
    others = [scaled(record, -1.0, 1.0) for record in problem.records]
    better = relative(problem) - relative(problem.with_records(others)) >= RULES.unit_clear
    if not better.any():
        return fault, problem
    pairs = list(zip(problem.records, others, better, strict=True))
    names = tuple(r.name for r, _, wrong in pairs if wrong or r.name in fault.records)
    of = f" of {', '.join(names)}" if len(names) < len(pairs) else ""
    named = replace(fault, explanation=f"The force channel{of} has the other sign.", records=names)
    return named, problem.with_records([other if wrong else record for record, other, wrong in pairs])


def both_turned(problem: Problem) -> tuple[Fault | None, Problem]:
    """Stroke and force both of the other sign, whose work is right, where the model explains only that; the problem turned.

    Where some records tell that their signs are right, only those that tell the contrary are turned. An error that is not
    much smaller then is that of another model.
    """
    others = problem.with_records([scaled(record, -1.0, -1.0) for record in problem.records])
    stated, mirrored = problem.forces({}), others.forces({})
    spans = [slice(a + 1, b) for a, b in zip(problem.starts[:-1], problem.starts[1:], strict=True)]
    told = [errors(problem.measured[span], stated[span], mirrored[span]).told for span in spans]
    if TURNED not in told:
        return None, problem
    wrong = np.array([sign == TURNED or AS_STATED not in told for sign in told])
    if (relative(problem) - relative(others))[wrong].mean() < RULES.unit_gain:
        return None, problem
    pairs = list(zip(problem.records, others.records, wrong, strict=True))
    names = tuple(record.name for record, _, turned in pairs if turned)
    of = f" of {', '.join(names)}" if len(names) < len(pairs) else ""
    text = f"Stroke and force{of} both have the other sign: the rig counts compression positive."
    fault = Fault("sign_flip", BOTH_SIGNS, text, -1.0, records=names, channel="both")
    return fault, problem.with_records([other if turned else record for record, other, turned in pairs])


def stroke_turned(turned: Fault) -> Fault:
    """The fault in the stroke channel, not in the force channel."""
    return replace(turned, title="Sign of the stroke channel", explanation=turned.explanation.replace("force", "stroke"),
                   channel="stroke")  # fmt: skip


def unit_error(problem: Problem) -> tuple[Fault | None, Problem]:
    """The wrong unit of a channel, in all files or in some, that explains the records far better; the problem put right."""
    now = relative(problem)  # another unit changes the noise as well
    units = sorted(rescaled(problem), key=lambda unit: float(unit.misfit.mean()))
    for unit in units:
        better, worse = now - unit.misfit >= RULES.unit_clear, unit.misfit - now >= RULES.unit_clear
        better &= unit.misfit <= -RULES.unit_gain  # what the model does not follow in either unit is no other unit
        if unit.channel == "stroke" and not other_strokes(problem, unit.factor, better):
            continue
        # These records are explained as well as the others then, which the unit would spoil.
        if better.any() and worse.any() and unit.misfit[better].max() <= now[~better].max() + RULES.unit_gain:
            pairs = zip(problem.records, unit.problem.records, better, strict=True)
            right = problem.with_records([other if wrong else record for record, other, wrong in pairs])
            return unit.fault(tuple(r.name for r, wrong in zip(problem.records, better, strict=True) if wrong)), right
    if units and now.mean() - units[0].misfit.mean() >= RULES.unit_gain:
        spoilt = units[0].channel == "stroke" and (units[0].misfit - now >= RULES.unit_clear).any()
        return (None, problem) if spoilt else (units[0].fault(()), units[0].problem)
    return None, problem


def other_strokes(problem: Problem, factor: float, some: NDArray[np.bool_]) -> bool:
    """Whether the ranges of the stroke of `some` records, times a factor, are nearer to those of the others.

    A rig that oscillates alike in all files has a single unit: what explains weak forces by tiny strokes is no unit.
    """
    if not some.any() or some.all():
        return True
    ranges = np.log([max(float(np.ptp(record.stroke)), 1e-9) for record in problem.records])
    apart = float(np.median(ranges[some]) - np.median(ranges[~some]))
    return abs(apart + float(np.log(factor))) < abs(apart)


@dataclass(frozen=True)
class Rescaled:
    """A problem with a channel of all records in another unit."""

    channel: str
    unit: str
    factor: float
    problem: Problem
    misfit: Array  # (r,) of `relative`; infinite where a record cannot be of that unit

    def fault(self, names: tuple[str, ...]) -> Fault:
        """The fault of the records with these names, of all where there are none."""
        of = f" of {', '.join(names)}" if names else ""
        text = f"The {self.channel} channel{of} holds {self.unit}."
        return Fault(
            "unit_error", f"Unit of the {self.channel}: {self.unit}", text, self.factor, records=names, channel=self.channel
        )


def rescaled(problem: Problem) -> list[Rescaled]:
    """The problem in all units in which the stroke of any record stays within the tube; others cannot be of that unit."""
    limit = tube_limit(problem.damper.parameters)
    reach = np.array([float(np.abs(record.stroke).max()) for record in problem.records])
    several = []
    for channel, units in (("force", FORCE_UNITS), ("stroke", STROKE_UNITS)):
        for unit, factor in units.items():
            force, stroke = (factor, 1.0) if channel == "force" else (1.0, factor)
            fits = reach * stroke <= limit
            if fits.any():
                pairs = zip(problem.records, fits, strict=True)
                other = problem.with_records([scaled(r, force, stroke) if of_it else r for r, of_it in pairs])
                several.append(Rescaled(channel, unit, factor, other, np.where(fits, relative(other), np.inf)))
    return several


def force_averaging(records: Sequence[Record], problem: Problem) -> tuple[Fault | None, Problem, list[str]]:
    """Whether the force was smoothed after the measurement, the problem seen through such a mean, and remarks.

    A parameter set identified from smoothed forces as if they were not has the smoothing in its F-v curve.
    """
    blocks = [block for _, block in oscillating(records)]
    seen = averaging(blocks)
    if seen is None:
        return None, problem, []
    windows = {block.name: block.averaged for block in through(blocks, seen)}
    other = problem.with_records([replace(r, averaged=windows.get(r.name, 0.0)) for r in problem.records])
    text = seen.text[0].upper() + seen.text[1:] + "."
    if relative(other).mean() >= relative(problem).mean():
        return None, problem, [f"{text} The parameter set is better without it: identify the damper from these records"]
    return Fault("force_averaging", "Averaged force channel", text, seen.share, "share_of_oscillation"), other, []


def relative(problem: Problem) -> Array:
    """The log (r,) of each record's squared error relative to its squared measured force."""
    errors = problem.errors({}) ** 2
    logs = []
    for a, b in zip(problem.starts[:-1] + 1, problem.starts[1:], strict=True):
        logs.append(np.log(errors[a:b].mean() / max((problem.measured[a:b] ** 2).mean(), 1e-12)))
    return np.array(logs)
