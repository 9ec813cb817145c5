"""What a hidden cause changes in the force, before noise and sampling filters."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from twintube.arrays import Array
from twintube.lab.challenge.plan import Bench
from twintube.lab.challenge.run import Run, begun, finished, marched
from twintube.lab.challenge.sampling import sampled


def rms(values: Sequence[Array]) -> float:
    """Of all values together."""
    return math.sqrt(sum(float(np.sum(v**2)) for v in values) / sum(map(len, values)))


def effects(runs: Sequence[Run], plain: Sequence[Run], bench: Bench) -> list[Array]:
    """What the cause changes, sample by sample [N]; a wrong stroke counts as the force it would ask for."""
    return [difference(run, base, bench) for run, base in zip(runs, plain, strict=True)]


def difference(run: Run, base: Run, bench: Bench) -> Array:
    """As `effects`, of a record."""
    point = replace(bench.sampling, kind="point")
    with_, without = (sampled(r, bench.fs, point, None) for r in (run, base))
    change: Array = run.unit[0] * with_.force - without.force
    if run.unit[1] != 1.0 or run.stroke is not base.stroke:
        stroke = run.unit[1] * run.stroke
        speed = np.gradient(stroke, np.maximum.accumulate(run.time + 1e-12 * np.arange(len(run.time))))
        moved = replace(run.motion, stroke=stroke, velocity=np.clip(speed, -5.0, 5.0))
        asked = finished(marched(begun(run.record, moved, bench.damper)), [])
        change = change - (sampled(asked, bench.fs, point, None).force - without.force)
    return change
