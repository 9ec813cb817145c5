"""Faults of the measurement that are looked for before any physics: a turned sign, a wrong unit, a smoothed force."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from twintube.core.checks import tube_limit
from twintube.data import LoadedDataset, Record, check_dataset, flipped_dataset, load_dataset
from twintube.diagnosis.fit import Problem
from twintube.diagnosis.prepare import Case
from twintube.diagnosis.signature import oscillating
from twintube.identification.averaging import averaging, through

# Factors by which a channel is wrong if its unit is another one than stated.
FORCE_UNITS = {"kN for N": 1e3, "N for kN": 1e-3, "lbf for N": 4.4482216, "N for lbf": 1 / 4.4482216,
               "kgf for N": 9.80665, "N for kgf": 1 / 9.80665}  # fmt: skip
STROKE_UNITS = {
    "m for mm": 1e3,
    "mm for m": 1e-3,
    "cm for mm": 10.0,
    "mm for cm": 0.1,
    "in for mm": 25.4,
    "mm for in": 1 / 25.4,
}
BETTER = 1.5  # log-misfit per sample that another unit must gain: a factor of two in the error is no calibration


@dataclass(frozen=True)
class Fault:
    """A fault that was put right before the diagnosis went on."""

    effect: str  # sign_flip, unit_error or force_averaging
    title: str
    explanation: str
    factor: float
    name: str = "factor"


def read(path: str | Path) -> tuple[LoadedDataset, Fault | None]:
    """The dataset, its forces turned where only that makes it readable; raises DataError with what else is wrong."""
    found = check_dataset(path)
    if found.errors and all("work of" in finding.message for finding in found.errors):
        turned = flipped_dataset(path)
        if not turned.errors and turned.damper is not None:
            data = LoadedDataset(turned.title, turned.damper, turned.records, turned.findings)
            return data, Fault("sign_flip", "Sign of the force channel", "The force channel has the other sign.", -1.0)
    return load_dataset(path), None


def scaled(case: Case, force: float, stroke: float) -> Case:
    """A case with its channels in other units."""
    return replace(
        case, impulse=case.impulse * force, noise=case.noise * force, peak=case.peak * force,
        stroke=case.stroke * stroke, velocity=case.velocity * stroke, top_speed=case.top_speed * stroke,
    )  # fmt: skip


def unit_error(problem: Problem) -> tuple[Fault | None, Problem]:
    """Whether another unit of one channel explains the records far better, and the problem in it."""
    everything = range(len(problem.cases))
    limit = tube_limit(problem.damper.parameters)
    # Relative misfits, as another unit changes the noise as well.
    best, chosen, name = relative(problem), problem, ""
    first = best
    for channel, units in (("force", FORCE_UNITS), ("stroke", STROKE_UNITS)):
        for unit, factor in units.items():
            cases = [
                scaled(c, factor if channel == "force" else 1.0, factor if channel == "stroke" else 1.0)
                for c in problem.cases
            ]
            if max(float(np.abs(cases[i].stroke).max()) for i in everything) > limit:
                continue
            other = problem.with_cases(cases)
            found = relative(other)
            if found < best:
                best, chosen, name = found, other, f"{channel}: {unit}"
    if not name or first - best < BETTER:
        return None, problem
    factor = (FORCE_UNITS | STROKE_UNITS)[name.partition(": ")[2]]
    return Fault("unit_error", f"Unit of the {name}", f"The {name.replace(': ', ' channel holds ')}.", factor), chosen


def force_averaging(records: Sequence[Record], problem: Problem) -> tuple[Fault | None, Problem, list[str]]:
    """Whether the force was smoothed after the measurement, the problem seen through the same mean, and remarks.

    A parameter set identified from forces that it took for unsmoothed has the smoothing in its F-v curve.
    """
    blocks = oscillating(records)
    found = averaging([block for _, block in blocks])
    if found is None:
        return None, problem, []
    windows = {block.name: block.averaged for block in through([block for _, block in blocks], found)}
    other = problem.with_cases([replace(case, averaged=windows.get(case.name, 0.0)) for case in problem.cases])
    text = found.text[0].upper() + found.text[1:] + "."
    if relative(other) >= relative(problem):
        return None, problem, [f"{text} The parameter set is better without it: identify the damper from these records"]
    return Fault("force_averaging", "Averaged force channel", text, found.share, "share_of_oscillation"), other, []


def relative(problem: Problem) -> float:
    """Mean over the cases of the log of the squared error relative to the squared measured force."""
    errors = problem.errors({}) ** 2
    found = []
    for a, b in zip(problem.starts[:-1] + 1, problem.starts[1:], strict=True):
        found.append(np.log(errors[a:b].mean() / max((problem.measured[a:b] ** 2).mean(), 1e-12)))
    return float(np.mean(found))
