"""Checks of a record: time, units, stroke, velocity, work. They judge and change nothing."""

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import median_filter

from twintube.common.arrays import Array
from twintube.core.checks import VELOCITY
from twintube.data.check.defects import cycle_starts
from twintube.data.convert.quantities import Table
from twintube.data.findings import Notes

# Time. Rigs sample at 100 Hz to some kHz; beyond these limits s and ms are mixed up.
SHORTEST_STEP, LONGEST_STEP = 1e-5, 0.5  # [s]
DAY = 86400.0  # [s]
NEIGHBOURS = 21  # steps whose median is usual: a rig may sample its blocks differently
GAP = 1.5  # of the usual step: a sample is missing; jitter is allowed for on top
BIG_GAP = 10.0  # of the usual step: what the damper did meanwhile is unknown
JITTER = 0.02  # standard deviation of the step over its median; a clocked rig has below 0.001
# Units. A degraded damper still has friction of some 10 N, and no rig moves less than 1 mm; a factor of 1000 shows.
LEAST_STROKE, MOST_STROKE = 0.5e-3, 1.0  # span [m]
LEAST_FORCE, MOST_FORCE = 10.0, 100e3  # span [N]
COLDEST, HOTTEST = -60.0, 250.0  # [degC], outside K and degC are mixed up
# Velocity against stroke, compared as strokes: integration does not raise the noise as differentiation does.
SCALE = 0.05  # deviation of the ratio from 1; calibrations are within 1 %
UNMOVED = 1e-6  # ratio of a velocity that does not move
GAIN = 5  # ratio that no wrong gain has: the units are wrong
STRANGE = 0.2  # share of the stroke not explained by the velocity; 2 % come from noise
ODD = 0.05  # the share that is worth a warning: a channel delay of 5 ms at 1.6 Hz
TURN = 0.25  # of the range of the velocity within a sample: a rig turned there
DRIFT = 0.02  # mean of velocity beyond that of the stroke, over rms
SAME = 0.05  # of the roughness of a difference quotient: whoever has its noise too is computed from it
# Others
BACKWARD_WORK = 0.05  # of the median work per cycle: what noise may make negative
FEWEST_SAMPLES = 3
OFF_CENTRE = 0.1  # middle of the stroke's range over half of the range


def check(table: Table, limit: float | None, notes: Notes) -> None:
    """Run all checks; `limit` is the largest stroke [m] in the damper's tube, None if the damper is not known."""
    check_time(table, notes)
    check_units(table, notes)
    check_stroke(table, limit, notes)
    kept = sound(table)
    if len(kept.rows) >= FEWEST_SAMPLES:
        check_velocity(kept, notes)
    ordered = selected(table, finite(table))  # work needs the order of the samples, not their times
    if len(ordered.rows) >= FEWEST_SAMPLES:
        check_work(ordered, notes)


def finite(table: Table) -> NDArray[np.bool_]:
    """The samples (n,) whose cells are all numbers."""
    good: NDArray[np.bool_] = np.all(np.isfinite(np.vstack(list(table.columns.values()))), axis=0)
    return good


def selected(table: Table, good: NDArray[np.bool_]) -> Table:
    """The table with these samples alone."""
    if good.all():
        return table
    return Table({name: values[good] for name, values in table.columns.items()}, table.headers, table.rows[good])


def sound(table: Table) -> Table:
    """The samples whose cells are numbers and whose times rise; the others are reported by `check`."""
    time = table.columns["time"]
    good = finite(table)
    latest = np.maximum.accumulate(np.where(np.isfinite(time), time, -np.inf))
    good[1:] &= time[1:] > latest[:-1]
    return selected(table, good)


def check_time(table: Table, notes: Notes) -> None:
    """Order, step, gaps and jitter."""
    header, rows = table.headers["time"], table.rows
    known = np.isfinite(table.columns["time"])
    time, rows = table.columns["time"][known], rows[known]
    step = np.diff(time)
    for wrong, what in ((step < 0, "goes back"), (step == 0, "is repeated")):
        if where := notes.places(np.append(False, wrong), rows):
            i = int(np.flatnonzero(wrong)[0])
            notes.error(f"time {what}: {time[i + 1]:g} s after {time[i]:g} s{where.tail}", header, where.first)
    step, rows = step[step > 0], rows[1:][step > 0]
    if not len(step):
        return
    median = float(np.median(step))
    if not SHORTEST_STEP <= median <= LONGEST_STEP:
        days = SHORTEST_STEP <= DAY * median <= LONGEST_STEP
        why = "days, as Excel counts them? then write [day]" if days else "s and ms mixed up?"
        notes.error(f"time step = {median:g} s: must be from {SHORTEST_STEP:g} to {LONGEST_STEP:g} s; {why}", header)
    local: Array = median_filter(step, NEIGHBOURS, mode="nearest")
    ratio = step / local
    usual = 1.4826 * float(np.median(np.abs(ratio - 1.0)))
    gap = ratio > GAP + 3.0 * usual
    for wrong, severe in ((gap & (ratio > BIG_GAP), True), (gap & (ratio <= BIG_GAP), False)):
        if where := notes.places(wrong, rows):
            worst = int(np.argmax(np.where(wrong, ratio, 0.0)))
            what = f"step of up to {step[worst]:g} s where {local[worst]:g} s is usual"
            if severe:
                notes.error(f"gap: {what}, must be at most {BIG_GAP:g} times that{where.tail}", header, where.first)
            else:
                notes.warning(f"small gap: {what}, a sample is missing{where.tail}", header, where.first)
    if local.max() > GAP * local.min():
        notes.warning(f"the sampling changes: steps from {local.min():g} to {local.max():g} s", header)
    jitter = float(np.std(ratio[~gap]))
    if jitter > JITTER:
        worst_row = int(rows[np.argmax(np.where(gap, 0.0, np.abs(ratio - 1.0)))])
        message = f"jitter: the step varies by {jitter:.1%}, up to {JITTER:.0%} is usual; worst here"
        notes.warning(message, header, worst_row)


def check_units(table: Table, notes: Notes) -> None:
    """Sizes that give a wrong unit away."""
    spans = (("stroke", LEAST_STROKE, MOST_STROKE, "m and mm"), ("force", LEAST_FORCE, MOST_FORCE, "N and kN"))
    for name, least, most, mixed in spans:
        values = table.columns[name][np.isfinite(table.columns[name])]
        span = float(np.ptp(values)) if len(values) else 0.0
        unit = "m" if name == "stroke" else "N"
        if len(values) and not least <= span <= most:
            why = f"it does not move, or {mixed} mixed up?" if span < least else f"{mixed} mixed up?"
            message = f"{name} spans {span:g} {unit}: must be from {least:g} to {most:g} {unit}; {why}"
            notes.error(message, table.headers[name])
    if "velocity" in table.columns:
        velocity, top = table.columns["velocity"], VELOCITY["upper"]
        if where := notes.places(np.abs(velocity) > top, table.rows):
            worst = velocity[np.nanargmax(np.abs(velocity))]
            message = f"velocity up to {worst:g} m/s: must be within {top:g} m/s{where.tail}"
            notes.error(message, table.headers["velocity"], where.first)
    if "temperature" in table.columns:
        values = table.columns["temperature"]
        if where := notes.places((values < COLDEST) | (values > HOTTEST), table.rows):
            message = f"temperature from {np.nanmin(values):g} to {np.nanmax(values):g} degC: must be from {COLDEST:g} to "
            message += f"{HOTTEST:g} degC; degC and K mixed up?{where.tail}"
            notes.error(message, table.headers["temperature"], where.first)


def check_stroke(table: Table, limit: float | None, notes: Notes) -> None:
    """Inside the tube, around the middle."""
    stroke, header = table.columns["stroke"], table.headers["stroke"]
    if not np.isfinite(stroke).any():
        return
    low, high = float(np.nanmin(stroke)), float(np.nanmax(stroke))
    middle, half = (low + high) / 2, (high - low) / 2
    off = abs(middle) > OFF_CENTRE * half
    if off:
        message = f"offset: the stroke runs from {low:g} to {high:g} m, its middle {middle:g} m is not 0"
        notes.warning(f"{message}, the middle position", header)
    if limit is not None and (where := notes.places(np.abs(stroke) > limit, table.rows)):
        worst = low if -low > high else high
        hint = "" if half > limit or not off else "; it would fit with another zero, see the offset"
        message = f"stroke up to {worst:g} m: the tube allows {-limit:g} to {limit:g} m{hint}{where.tail}"
        notes.error(message, header, where.first)


def ways(velocity: Array, time: Array, stroke: Array) -> Array:
    """What the velocity makes of each interval's stroke (n - 1,).

    Where it turns between two samples, nobody knows when: any mean between both is as good, and that of the stroke is taken.
    """
    steps = np.diff(time)
    first, last = velocity[:-1] * steps, velocity[1:] * steps
    made = (first + last) / 2
    scale, _ = against(made, time, stroke)
    turns = np.abs(np.diff(velocity)) > TURN * np.ptp(velocity)
    return np.where(turns, np.clip(scale * np.diff(stroke), np.minimum(first, last), np.maximum(first, last)), made)


def against(made: Array, time: Array, stroke: Array) -> tuple[float, Array]:
    """What the intervals' strokes (n - 1,) add up to, over the stroke (n,), and what that leaves; without their trends."""
    moved, said = straightened(stroke, time), straightened(np.append(0.0, np.cumsum(made)), time)
    scale = float(said @ moved) / float(moved @ moved)
    return scale, said - scale * moved


def straightened(values: Array, time: Array) -> Array:
    """The values less their straight trend."""
    centred = time - time.mean()
    flat: Array = values - values.mean()
    flat -= centred * float(centred @ flat) / float(centred @ centred)
    return flat


def check_velocity(table: Table, notes: Notes) -> None:
    """A measured velocity is the derivative of the stroke, and not just computed from it."""
    if "velocity" not in table.columns:
        return
    time, stroke, velocity = (table.columns[name] for name in ("time", "stroke", "velocity"))
    header = table.headers["velocity"]
    size = float(np.sqrt(np.mean(straightened(stroke, time) ** 2)))
    if size == 0.0:
        return
    made = ways(velocity, time, stroke)
    scale, rest = against(made, time, stroke)
    odd = float(np.std(rest)) / size
    at = int(table.rows[np.argmax(np.abs(velocity - np.gradient(stroke, time)))])
    if abs(scale) < UNMOVED or odd > STRANGE * max(1.0, abs(scale)):
        message = f"velocity is not the derivative of the stroke: {odd / max(1.0, abs(scale)):.0%} of the stroke unexplained"
        notes.error(f"{message}, limit {STRANGE:.0%}; worst here", header, at)
        return
    if abs(scale - 1) > SCALE:
        why = "wrong sign" if scale < 0 else "wrong unit" if not 1 / GAIN < scale < GAIN else "wrong gain"
        message = f"velocity is {scale:.3g} times the derivative of the stroke, must be {1 - SCALE:g} to {1 + SCALE:g}"
        notes.error(f"{message}: {why}?; worst here", header, at)
        return
    if odd > ODD:
        notes.warning(f"velocity explains the stroke but for {odd:.1%}, usual are {ODD:.0%}; delayed or noisy?", header, at)
    drift = float(made.sum() - stroke[-1] + stroke[0]) / float(time[-1] - time[0])
    if abs(drift) > DRIFT * float(np.sqrt(np.mean(velocity**2))):
        notes.warning(f"offset: mean velocity {drift:.3g} m/s beyond that of the stroke", header)
    if kind := computed(time, stroke, velocity):
        notes.warning(f"velocity is just the {kind} of the stroke, no measurement of its own", header)


def computed(time: Array, stroke: Array, velocity: Array) -> str:
    """The difference quotient that `velocity` is, or an empty string."""
    quotient = np.diff(stroke) / np.diff(time)
    roughness = float(np.sqrt(np.mean(np.diff(quotient, 2) ** 2))) if len(quotient) > 2 else 0.0
    kinds = {
        "backward difference (half a sample late)": velocity[1:] - quotient,
        "forward difference (half a sample early)": velocity[:-1] - quotient,
        "central difference": (velocity - np.gradient(stroke, time))[1:-1],
    }
    return next((kind for kind, rest in kinds.items() if float(np.sqrt(np.mean(rest**2))) <= SAME * roughness), "")


def check_work(table: Table, notes: Notes) -> None:
    """A damper takes work: force times stroke is positive over each cycle."""
    stroke, force, header = table.columns["stroke"], table.columns["force"], table.headers["force"]
    work = np.append(0.0, np.cumsum((force[1:] + force[:-1]) / 2 * np.diff(stroke)))
    starts = cycle_starts(stroke)
    if len(starts) < 2:
        notes.warning("no full cycle of stroke: the sign of the work cannot be checked", header)
        return
    cycles = np.diff(work[starts])
    total, usual = float(cycles.sum()), float(np.median(np.abs(cycles)))
    wrong = cycles < -BACKWARD_WORK * usual
    if total <= 0.0:
        message = (
            f"work of {len(cycles)} cycles = {total:.4g} J: must be above 0, force is positive when the damper is pulled "
        )
        message += "(stroke rising); if the rig's sign differs, set force_sign = -1 or stroke_sign = -1"
        notes.error(message, header, int(table.rows[starts[np.argmin(cycles)]]))
    elif where := notes.places(np.isin(np.arange(len(table.rows)), starts[:-1][wrong]), table.rows):
        message = f"work of a cycle = {cycles[wrong][0]:.3g} J: must be above 0, {usual:.3g} J is usual{where.tail}"
        notes.warning(message, header, where.first)
