"""What a record says about its recorder: repeated samples, clipping, dropouts, coarse levels, missing preconditioning.

Findings name them; the samples whose force says nothing are not usable. Their stroke stays, the damper went through it.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array
from twintube.data.check.defects import clipped, dropped, frozen, resolution, unprepared
from twintube.data.check.values import FEWEST_SAMPLES, sound
from twintube.data.convert.quantities import Table
from twintube.data.findings import Notes
from twintube.rig.signals import V_PRECONDITIONING

Mask = NDArray[np.bool_]

FEWEST_REPEATS = 3  # identical samples in motion that no replicated single sample explains
SHORTEST_REST = 0.05  # [s]; a rig does not stop and go within less
RESOLUTIONS = 3.0  # steps of the stroke's resolution that a repeated sample must have missed
LEAP = 0.02  # of the stroke's range: what a model may jump over where the recorder stood still
FEWEST_LEVELS = 200  # of a channel: below, half a step is 0.25 % of its range
DITHER = 0.5  # of a step: noise from there on fills in between the levels
HINTS = 3  # windows that a message suggests
SLOW_BLOCK = 1.5  # times the speed of the preconditioning: a slower block is not told from it


def within(time: Array, windows: Sequence[tuple[float, float]]) -> Mask:
    """The samples (n,) in any of the windows [s]."""
    inside = np.zeros(len(time), dtype=bool)
    for low, high in windows:
        inside |= (time >= low) & (time <= high)
    return inside


def no_preconditioning(time: Array, stroke: Array) -> bool:
    """Whether a harmonic record begins at the speed of its block, which is above that of the preconditioning."""
    fastest = float(np.quantile(np.abs(np.gradient(stroke, time)), 0.9))
    return fastest > SLOW_BLOCK * V_PRECONDITIONING and unprepared(time, stroke)


def check_quality(table: Table, excluded: Mask, notes: Notes) -> Mask:
    """The usable samples (n,), with findings on the others outside of `excluded`; all where the record is not sound."""
    kept = sound(table)
    if len(kept.rows) < FEWEST_SAMPLES:
        return ~excluded
    if len(kept.rows) < len(table.rows):
        check_repeats(kept, np.zeros(len(kept.rows), dtype=bool), notes)
        return ~excluded
    time, stroke, force = (table.columns[name] for name in ("time", "stroke", "force"))
    repeated = check_repeats(table, excluded, notes)
    if notes.failed:
        return ~excluded
    header = table.headers["force"]
    cut = clipped(force, np.abs(np.gradient(stroke, time)))
    for limit, side in ((cut.high, "largest"), (cut.low, "smallest")):
        if limit is not None and (where := notes.places(force == limit, table.rows)):
            message = f"clipped: the force stays at its {side} value {limit:.6g} N, the limit of load cell or amplifier"
            notes.warning(message + where.tail, header, where.first)
    lost = dropped(force, stroke) & ~excluded
    still = frozen(force, stroke) & ~excluded & ~cut.samples & ~lost & ~repeated
    for wrong, does, then in (
        (lost, "dropout: the force jumps to", "and back"),
        (still, "frozen: the force stays at", "while the stroke moves, then jumps"),
    ):
        if where := notes.places(wrong, table.rows):
            notes.warning(f"{does} {force[wrong][0]:.6g} N {then}{where.tail}; left out", header, where.first)
    for name, unit in (("stroke", "m"), ("force", "N")):
        levels = resolution(table.columns[name])
        if levels is not None and levels[1] < FEWEST_LEVELS and levels[2] < DITHER * levels[0]:
            message = f"coarse: {name} takes {levels[1]} levels, {levels[0]:.3g} {unit} apart"
            notes.warning(f"{message}; {FEWEST_LEVELS} or more are usual", table.headers[name])
    return ~(excluded | repeated | cut.samples | lost | still)


def check_repeats(table: Table, excluded: Mask, notes: Notes) -> Mask:
    """Samples (n,) that repeat stroke and force while the damper moves: the recorder stood still.

    Findings on those outside of `excluded`: errors where the stroke then leaps.
    """
    time, stroke, force = (table.columns[name] for name in ("time", "stroke", "force"))
    steps = np.abs(np.diff(stroke))
    repeated, leaping = np.zeros(len(stroke), bool), np.zeros(len(stroke), bool)
    if not steps.any():
        return repeated
    resolution = float(steps[steps > 1e-9 * np.ptp(stroke)].min())
    equal = np.concatenate([[False], (steps == 0) & (np.diff(force) == 0), [False]]).astype(int)
    begin, end = np.flatnonzero(np.diff(equal) == 1), np.flatnonzero(np.diff(equal) == -1)
    windows = []
    for i, j in zip(begin.tolist(), end.tolist(), strict=True):  # samples i to j are identical
        if stood_still(table, i, j, resolution) and not excluded[i + 1 : j + 1].all():
            repeated[i + 1 : j + 1] = True
            leap = abs(float(stroke[min(j + 1, len(stroke) - 1)] - stroke[j]))
            if j - i + 1 >= FEWEST_REPEATS and leap > LEAP * np.ptp(stroke):
                leaping[i + 1 : j + 1] = True
                windows.append(f"[{time[i]:.6g}, {time[j]:.6g}]")
    header = table.headers["stroke"]
    if where := notes.places(leaping, table.rows):
        hint = ", ".join([*windows[:HINTS], *(["..."] if len(windows) > HINTS else [])])
        message = f"stroke and force stay identical while the damper moves: repeated samples{where.tail}"
        notes.error(f"{message}; where the model may leap over them, set exclude = [{hint}]", header, where.first)
    if where := notes.places(repeated & ~leaping, table.rows):
        notes.warning(f"stroke and force as in the sample before while the damper moves{where.tail}", header, where.first)
    return repeated


def stood_still(table: Table, i: int, j: int, resolution: float) -> bool:
    """Whether the recorder stood still from sample i to j, and not the damper: at rest, or turning within the resolution."""
    time, stroke = table.columns["time"], table.columns["stroke"]
    last = len(stroke) - 1

    def moved(width: int) -> tuple[float, float]:
        return float(stroke[i] - stroke[max(0, i - width)]), float(stroke[min(last, j + width)] - stroke[j])

    before, after = moved(5)
    missed, needed = min(abs(before), abs(after)) / 5 * (j - i), RESOLUTIONS * resolution
    if before * after < 0:  # a turn in between: a parabola sampled with this resolution dwells for 8 of its steps
        missed, needed = min(map(abs, moved(j - i))), 8 * RESOLUTIONS * resolution
    if missed <= needed:
        return False
    jumps = abs(float(stroke[min(last, j + 1)] - stroke[j])) > missed / 2
    velocity = np.abs(table.columns.get("velocity", np.zeros(1)))
    runs_on = "velocity" in table.columns and float(velocity[i + 1 : j + 1].min()) > 0.1 * float(velocity.max())
    return jumps or runs_on or float(time[j] - time[i]) < SHORTEST_REST
