"""What of an effect lies outside the tolerances of a careful bench.

A fill, a stroke, a zero, a gain and a synchronisation are never exact. Where a hidden cause changes no more than they do,
nobody can tell it from them: a step of the force that comes some samples earlier may be a fill that is off by a thousandth.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import lsq_linear

from twintube.arrays import Array
from twintube.lab.challenge.changes import effects, rms
from twintube.lab.challenge.oil import level_everywhere
from twintube.lab.challenge.plan import Bench
from twintube.lab.challenge.run import Run, Step, begun, copied, finished
from twintube.lab.challenge.sampling import sampled
from twintube.lab.challenge.sensors import force_late, stroke_gain

FILL = 1e-3  # of the oil in degraded states: 0.3 mL, of drops on walls
STROKE = 1e-3  # of the stroke: a good inductive sensor
ZERO = 5e-3  # of the largest force, in each record: 0.05 % of the range (ISO 7500-1, class 0.5) of a cell ten times as large
GAIN = 5e-3  # of the force, in all records alike (ISO 7500-1, class 0.5)
FINE = 10.0  # times the rate of the bench, at which a delay is read
ACTS = 0.02  # of the largest change in a record: below it the cause does not act
SHIFTS = np.delete(np.linspace(-0.5, 0.5, 21), 10).tolist()  # samples: delays of the force, in all records alike


@dataclass(frozen=True)
class Tolerances:
    """What the bench leaves open, arrays (n,) [N] over the samples of each record."""

    steps: list[Array]  # what fill and stroke change in the force
    force: list[Array]  # nothing hidden
    shifts: list[list[Array]]  # what each delay of the force channel changes
    largest: float  # force


def tolerances(plain: Sequence[Run], bench: Bench) -> Tolerances:
    """Those of a campaign, from its runs with nothing hidden."""
    points = replace(bench.sampling, kind="point")
    forces = [sampled(run, bench.fs, points, None).force for run in plain]
    squares = [np.zeros(len(force)) for force in forces]
    for stage, apply, size in (("setup", level_everywhere, FILL), ("sensors", stroke_gain, STROKE)):
        both = []
        for sign in (-1.0, 1.0):
            step = Step(stage, apply, size, {"sign": sign})
            runs = [copied(run) if stage == "sensors" else begun(run.record, run.motion, bench.damper) for run in plain]
            both.append(effects([finished(run, [step]) for run in runs], plain, bench))
        squares = [s + np.maximum(np.abs(a), np.abs(b)) ** 2 for s, a, b in zip(squares, *both, strict=True)]
    late = [
        [
            effects([finished(copied(run), [Step("sensors", force_late, shift / bench.fs, {})])], [run], bench)[0]
            for run in plain
        ]
        for shift in SHIFTS
    ]
    return Tolerances([np.sqrt(s) for s in squares], forces, late, bench.largest)


def beyond(changes: Sequence[Array], bench: Tolerances) -> list[Array]:
    """What is left of changes of the force (n,) [N] by record where the tolerances hide as much as they can.

    A delay of a part of a sample moves some steps of the force into another sample and others not, so that each is tried.
    """
    nothing = [np.zeros_like(change) for change in changes]
    several = [left_of([c - s for c, s in zip(changes, shift, strict=True)], bench) for shift in (nothing, *bench.shifts)]
    return min(several, key=rms)


def left_of(changes: Sequence[Array], bench: Tolerances) -> list[Array]:
    """What is left of changes of the force (n,) [N] by record without what fill, stroke, zeros and gain may hide."""
    counts = [len(change) for change in changes]
    left = np.concatenate([np.sign(c) * np.maximum(np.abs(c) - s, 0.0) for c, s in zip(changes, bench.steps, strict=True)])
    columns = np.zeros((len(left), len(counts) + 1))
    for i, (end, n) in enumerate(zip(np.cumsum(counts), counts, strict=True)):
        columns[end - n : end, i] = ZERO * bench.largest
    columns[:, -1] = GAIN * np.concatenate(bench.force)
    # The normal equations: small, whatever the number of samples.
    norm = np.maximum(np.linalg.norm(columns, axis=0), 1e-12)
    root = np.linalg.cholesky((columns / norm).T @ (columns / norm) + 1e-9 * np.eye(len(norm)))
    target = np.linalg.solve(root, (columns / norm).T @ left)
    shares = lsq_linear(root.T, target, (-norm, norm)).x / norm
    return np.split(left - columns @ shares, np.cumsum(counts)[:-1])


def late_samples(runs: Sequence[Run], plain: Sequence[Run], bench: Bench) -> float:
    """The delay that a hidden cause amounts to, in samples of the bench, where it acts.

    A step of the force by F that comes late by t, at once or bit by bit, changes the force by F t over time.
    """
    fine = replace(bench, fs=FINE * bench.fs)
    points = replace(bench.sampling, kind="point")
    changed = varied = 0.0
    for base, change in zip(plain, effects(runs, plain, fine), strict=True):
        force = sampled(base, fine.fs, points, None).force
        acting = np.abs(change) > ACTS * np.abs(change).max()
        changed += float(np.sum(np.abs(change[acting])))
        varied += float(np.sum(np.abs(np.diff(force, prepend=force[0])[acting])))
    return changed / varied / FINE if varied > 0.0 else 0.0
