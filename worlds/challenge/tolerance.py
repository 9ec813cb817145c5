"""What of an effect lies outside the tolerances of a careful bench.

A fill, a stroke, a zero, a gain and a synchronisation are never exact. Where a hidden cause changes no more than they do,
nobody can tell it from them: a step of the force that comes some samples earlier may be a fill that is off by a thousandth.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from scipy.optimize import lsq_linear

from twintube.common.arrays import Array
from worlds.bench import faults
from worlds.bench.plan import rms
from worlds.bench.sampler import Recorder
from worlds.challenge.oil import level_wrong
from worlds.challenge.plan import Bench
from worlds.model.run import Run, Step, begun, copied, finished, sampled

FILL = 1e-3  # of the oil in degraded states: 0.3 mL, of drops on walls
STROKE = 1e-3  # of the stroke: a good inductive sensor
ZERO = 5e-3  # of the largest force, in each record: 0.05 % of the range (ISO 7500-1, class 0.5) of a cell ten times as large
GAIN = 5e-3  # of the force, in all records alike (ISO 7500-1, class 0.5)
FINE = 10.0  # times the rate of the bench, at which a delay is read
ACTS = 0.02  # of the largest change in a record: below it the cause does not act
SHIFTS = np.delete(np.linspace(-0.5, 0.5, 21), 10).tolist()  # samples: delays of the force, in all records alike


def force_at(run: Run, fs: float) -> Array:
    """Force [N] at the samples of a recorder, without its filters."""
    return sampled(run, Recorder(fs, "point"))[2]


def effects(runs: Sequence[Run], plain: Sequence[Run], bench: Bench, finer: float = 1.0) -> list[Array]:
    """What a cause changes, sample by sample [N]; a wrong stroke counts as the force it would ask for."""
    return [difference(run, base, bench, finer * bench.recorder.fs) for run, base in zip(runs, plain, strict=True)]


def difference(run: Run, base: Run, bench: Bench, fs: float) -> Array:
    """As `effects`, of a record."""
    change = run.unit[0] * force_at(run, fs) - force_at(base, fs)
    if run.unit[1] != 1.0 or run.stroke is not base.stroke:
        stroke = run.unit[1] * run.stroke
        speed = np.gradient(stroke, np.maximum.accumulate(run.time + 1e-12 * np.arange(len(run.time))))
        moved = replace(run.motion, stroke=stroke, velocity=np.clip(speed, -5.0, 5.0))
        change = change - (force_at(finished(begun(run.record, moved, bench.damper)), fs) - force_at(base, fs))
    return change


@dataclass(frozen=True)
class Tolerances:
    """What the bench leaves open, arrays (n,) [N] over the samples of each record."""

    steps: list[Array]  # what fill and stroke change in the force
    force: list[Array]  # nothing hidden
    shifts: list[list[Array]]  # what each delay of the force channel changes
    largest: float  # force


def tolerances(plain: Sequence[Run], bench: Bench) -> Tolerances:
    """Those of a campaign, from its runs with nothing hidden."""
    fs = bench.recorder.fs
    forces = [force_at(run, fs) for run in plain]
    squares = [np.zeros(len(force)) for force in forces]
    for fill in (True, False):
        both = []
        for sign in (-1.0, 1.0):
            if fill:
                step = Step("setup", partial(level_wrong, x=FILL, c={"sign": sign}))
                runs = [begun(run.record, run.motion, bench.damper) for run in plain]
            else:
                step, runs = Step("sensors", partial(faults.scaled, stroke=1.0 + sign * STROKE)), list(map(copied, plain))
            both.append(effects([finished(run, [step]) for run in runs], plain, bench))
        squares = [s + np.maximum(np.abs(a), np.abs(b)) ** 2 for s, a, b in zip(squares, *both, strict=True)]
    steps = [Step("sensors", partial(faults.late, force=shift / fs)) for shift in SHIFTS]
    late = [effects([finished(copied(run), [step]) for run in plain], plain, bench) for step in steps]
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
    changed = varied = 0.0
    for base, change in zip(plain, effects(runs, plain, bench, FINE), strict=True):
        force = force_at(base, FINE * bench.recorder.fs)
        acting = np.abs(change) > ACTS * np.abs(change).max()
        changed += float(np.sum(np.abs(change[acting])))
        varied += float(np.sum(np.abs(np.diff(force, prepend=force[0])[acting])))
    return changed / varied / FINE if varied > 0.0 else 0.0
