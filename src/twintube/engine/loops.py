"""Loops over the kernel, in the kernel's own subset so that they are translated and compiled together with it.

`p`, `d`, `s`, `f` are records of `variables.py`: dataclasses in the interpreter, structs in C.
"""

import math
from typing import NamedTuple

from twintube.common.arrays import Counts, Table, Vector
from twintube.core.agreement import Agreement, parted
from twintube.core.effects import Parameters, State, effects_parts, effects_remember, effects_scale_valve
from twintube.core.frame import stroke_limit
from twintube.core.kernel.forces import gas_force
from twintube.core.model import advance, advance_whole, rod_stroke, set_up, start
from twintube.core.outputs import total_force
from twintube.core.publishing import publish_row
from twintube.core.variables import Derived, Flow

# A longer step [s] that goes less than this share of the way its velocities say is a rest, where a cubic would swing.
REST = 0.3
UNMOVED = 0.05
NO_WAY = 1e-9  # [m] by which no work is divided: the quotient would be rounding
NOTHING = 1e-30  # k_degr of no force, by which none is divided


class Records(NamedTuple):
    """Records laid end to end, as `run_means` takes them."""

    states: Table  # (r, 4) oil level [1], preload [1], factors of the gas force and of its stiffness [1]
    starts: Counts  # (r + 1,) where each begins
    t: Vector  # (n,) [s]
    z: Vector  # (n,) [m]
    v: Vector  # (n,) [m/s]
    temperature: Vector  # (n,) [K] of the damper, or around one that keeps its heat
    samples: Counts  # (n,) measured samples of the interval that ends here, 0 where unknown
    parts: int  # steps of an interval


class Means(NamedTuple):
    """What `run_means` writes, all (n,), of the interval that ends at a sample."""

    force: Vector  # [N] mean over the time
    point: Vector  # [N] mean of the forces at the measured samples, which misses where between two of them the force jumps
    work: Vector  # [J] since the start of the record


def run_record(
    p: Parameters, d: Derived, s: State, f: Flow, t: Vector, z: Vector, v: Vector, temperature: Vector, out: Table
) -> int:
    """Drive the damper over times `t` [s], strokes `z` [m], velocities `v` [m/s] and temperatures [K], all (n,).

    A temperature holds until the next sample, as the input of an FMU does.

    Writes the outputs to `out` (n, m) in the order of their table.

    Row 0 is the state at the first sample. Returns the number of samples done, less than n if a step failed.
    """
    before = v[0]
    time = t[0]
    for i in range(len(z)):
        s.temperature = temperature[max(0, i - 1)]
        if not advance(p, d, s, f, z[i], before, v[i], t[i] - time):
            return i
        before = v[i]
        time = t[i]
        publish_row(d, s, out[i])
    return len(z)


def first_parted(a: Agreement, t: Vector, z: Vector, v: Vector) -> int:
    """The first sample by which the velocities `v` [m/s] do not belong to the strokes `z` [m] at the times `t` [s], else -1.

    All are (n,); `a` is a blank Agreement.
    """
    a.stroke = z[0]
    a.velocity = v[0]
    last = len(z) - 1
    for i in range(len(z)):
        if parted(a, z[i], v[i], t[i + 1] - t[i] if i < last else 0.0) > 0:
            return i
    return -1


def run_work(
    p: Parameters, d: Derived, s: State, f: Flow, t: Vector, z: Vector, v: Vector, marks: Counts, out: Vector
) -> int:
    """As `run_record`, but only the dissipated work [J] at the samples `marks` (m,), written to `out` (m,)."""
    before = v[0]
    time = t[0]
    mark = 0
    for i in range(len(z)):
        if not advance(p, d, s, f, z[i], before, v[i], t[i] - time):
            return i
        before = v[i]
        time = t[i]
        if mark < len(marks) and i == marks[mark]:
            out[mark] = s.work
            mark += 1
    return len(z)


def run_held(p: Parameters, d: Derived, s: State, f: Flow, z: Vector, dt: float) -> int:
    """Move through the strokes `z` [m] (n,) one every `dt` [s], the velocity held within a step, as an FMU is stepped.

    Returns the number of steps done, less than n - 1 if a step failed.
    """
    for i in range(len(z) - 1):
        v = (z[i + 1] - z[i]) / dt if dt > 0.0 else 0.0
        if not advance(p, d, s, f, z[i] + v * dt, v, v, dt):
            return i
    return len(z) - 1


def run_means(p: Parameters, d: Derived, s: State, f: Flow, records: Records, means: Means) -> int:
    """Drive the damper over `records` (Records) and write `means` (Means). Returns the number of records done."""
    for r in range(len(records.states)):
        if not record_means(p, d, s, f, records, means, r):
            return r
    return len(records.states)


def record_means(p: Parameters, d: Derived, s: State, f: Flow, records: Records, means: Means, r: int) -> bool:
    """The means of the record `r`; False if a step failed."""
    # In C; the interpreter's own parameters cannot be changed.
    p.oil_level = records.states[r, 0]  # type: ignore[misc]
    p.gas_preload = records.states[r, 1]  # type: ignore[misc]
    set_up(p, d)
    d.F_0 *= records.states[r, 2]
    d.c_gas *= records.states[r, 3]
    t, z, v, samples = records.t, records.z, records.v, records.samples
    first = records.starts[r]
    start(p, d, s, z[first])
    # A step without a way and velocity keeps them: those of the record before must not reach this one.
    f.k_degr = 1.0
    f.k_mean = 1.0
    last = total_force(s)
    for i in range(first, records.starts[r + 1]):
        before = max(first, i - 1)
        s.temperature = records.temperature[before]
        # By the samples alone, so that all models see the same of them.
        gaps = samples[i] if samples[i] <= 2 * records.parts else 0
        done, force, point, last = interval_means(
            p, d, s, f, z[before], v[before], z[i], v[i], t[i] - t[before], records.parts, gaps, last
        )
        if not done:
            return False
        means.force[i] = force
        means.point[i] = point
        means.work[i] = s.work
    return True


def interval_means(
    p: Parameters, d: Derived, s: State, f: Flow, z0: float, v0: float, z1: float, v1: float, dt: float,
    parts: int, gaps: int, last: float,
) -> tuple[bool, float, float, float]:  # fmt: skip
    """An interval in `parts` steps or more: whether it was done, mean force, point, force at the end, from `last` on [N].

    The stroke follows the cubic of strokes [m] and velocities [m/s] over `dt` [s], but across a rest. The point is the mean
    of the forces at `gaps` measured samples by trapezoids; 0 where they are unknown.
    """
    n = max(parts, effects_parts(p, dt)) if d.extended > 0 else parts
    if dt <= 0.0 or (dt > REST and abs(z1 - z0) < UNMOVED * dt * max(abs(v0), abs(v1))):
        n = 1
    if gaps > 0:
        n = gaps * math.ceil(n / gaps)
    total = 0.0
    sampled = 0.5 * last
    before = v0
    for k in range(1, n + 1):
        x = k / n
        goal = z1
        speed = v1
        if k < n:
            # Between samples the cubic may leave the tube by a hair.
            goal = max(-stroke_limit(d), min(stroke_limit(d), cubic(x, z0, v0, z1, v1, dt)))
            speed = cubic_slope(x, z0, v0, z1, v1, dt)
        from_work = s.work
        from_impulse = s.impulse
        at = rod_stroke(d, s)
        if not advance_whole(p, d, s, f, goal, before, speed, dt / n):
            return False, 0.0, 0.0, 0.0
        way = rod_stroke(d, s) - at
        if d.extended > 0 and dt > 0.0:
            total += (s.impulse - from_impulse) / dt
        elif d.extended == 0 and abs(way) > NO_WAY:
            # The work over the stroke is the mean force, wherever in the step it jumped.
            total += ((s.work - from_work) / way + gas_force(p, d, s, at + 0.5 * way)) / n
        else:
            total += total_force(s) / n
        before = speed
        if gaps > 0 and (k * gaps) % n == 0:
            last = force_at_end(p, d, s, f, speed, way)
            sampled += last if k < n else 0.5 * last
    if gaps == 0:
        return True, total, total, total_force(s)
    return True, total, sampled / gaps, last


def force_at_end(p: Parameters, d: Derived, s: State, f: Flow, speed: float, way: float) -> float:
    """Force [N] at the end of a step over `way` [m]: k_degr of the state is a mean over the step, a sample sees the end."""
    now = total_force(s)
    if effects_remember(p) == 0 and s.k_degr > NOTHING:
        ended = f.k_degr
        if d.extended > 0:
            rebound = speed > 0.0 or (speed == 0.0 and way > 0.0)
            ended = (s.k_re if rebound else s.k_co) * effects_scale_valve(p, speed)
        now += (ended / s.k_degr - 1.0) * s.F_fluid
    return now


def cubic(x: float, z0: float, v0: float, z1: float, v1: float, dt: float) -> float:
    """Stroke [m] at the share x of a step whose strokes [m] and velocities [m/s] at both ends are given."""
    y = 1.0 - x
    return y * y * ((1.0 + 2.0 * x) * z0 + x * v0 * dt) + x * x * ((1.0 + 2.0 * y) * z1 - y * v1 * dt)


def cubic_slope(x: float, z0: float, v0: float, z1: float, v1: float, dt: float) -> float:
    """Velocity [m/s] of the same."""
    y = 1.0 - x
    return 6.0 * x * y * (z1 - z0) / dt + y * (1.0 - 3.0 * x) * v0 + x * (3.0 * x - 2.0) * v1
