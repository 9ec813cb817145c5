"""Loops over the kernel, in the kernel's own subset so that numba compiles them together with it.

`p`, `d`, `s`, `f` are records of `variables.py`: dataclasses in the interpreter, rows of structured arrays in numba.
"""

import math
from typing import Any

from twintube.core.agreement import parted
from twintube.core.effects import effects_parts, effects_remember, effects_scale_valve
from twintube.core.frame import stroke_limit
from twintube.core.kernel.forces import gas_rise
from twintube.core.model import advance, advance_whole, set_up, start
from twintube.core.outputs import reserve_gas, total_force

# A longer step [s] that goes less than this share of the way its velocities say is a rest, where a cubic would swing.
REST = 0.3
UNMOVED = 0.05
NOTHING = 1e-30  # k_degr of no force, by which none is divided

# Columns that `run_record` writes, in this order; all but the shares and `z` are in SI units of the state's fields.
COLUMNS = (
    "force",
    "k_degr",
    "F_fluid",
    "F_friction",
    "F_gas",
    "work",
    "V1_oil",
    "V1_gas",
    "V1_foam",
    "V2_oil",
    "V2_gas",
    "V2_foam",
    "V3_oil",
    "V3_foam",
    "V_cav",
    "V3_gas",
)


def run_record(p: Any, d: Any, s: Any, f: Any, t: Any, z: Any, v: Any, out: Any) -> int:
    """Drive the damper over times `t` [s], strokes `z` [m] and velocities `v` [m/s], all (n,), and write `out` (n, 16).

    Row 0 is the state at the first sample. Returns the number of samples done, less than n if a step failed.
    """
    before = v[0]
    time = t[0]
    for i in range(len(z)):
        if not advance(p, d, s, f, z[i], before, v[i], t[i] - time):
            return i
        before = v[i]
        time = t[i]
        row = out[i]
        row[0] = total_force(s)
        row[1] = s.k_degr
        row[2] = s.F_fluid
        row[3] = s.F_friction
        row[4] = s.F_gas
        row[5] = s.work
        row[6] = s.V1_oil
        row[7] = s.V1_gas
        row[8] = s.V1_foam
        row[9] = s.V2_oil
        row[10] = s.V2_gas
        row[11] = s.V2_foam
        row[12] = s.V3_oil
        row[13] = s.V3_foam
        row[14] = s.V_cav
        row[15] = reserve_gas(d, s)
    return len(z)


def first_parted(a: Any, t: Any, z: Any, v: Any) -> int:
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


def run_work(p: Any, d: Any, s: Any, f: Any, t: Any, z: Any, v: Any, marks: Any, out: Any) -> int:
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


def run_held(p: Any, d: Any, s: Any, f: Any, z: Any, dt: float) -> int:
    """Move through the strokes `z` [m] (n,) one every `dt` [s], the velocity held within a step, as an FMU is stepped.

    Returns the number of steps done, less than n - 1 if a step failed.
    """
    for i in range(len(z) - 1):
        v = (z[i + 1] - z[i]) / dt if dt > 0.0 else 0.0
        if not advance(p, d, s, f, z[i] + v * dt, v, v, dt):
            return i
    return len(z) - 1


def run_means(
    p: Any,
    d: Any,
    s: Any,
    f: Any,
    states: Any,
    t: Any,
    z: Any,
    v: Any,
    warm: Any,
    starts: Any,
    parts: int,
    samples: Any,
    force: Any,
    point: Any,
    work: Any,
) -> int:
    """Records laid end to end: the mean force [N] over the time since the sample before and the work [J] since the start.

    `states` (r, 4) are the records' oil level, preload and factors of the gas force and of its stiffness, `starts` (r + 1,)
    where they begin, `warm` (n,) [K] how much
    warmer the damper is than at the temperature of its parameters, 0 where unknown, and `samples` (n,) how many measured
    samples an interval has, 0 where unknown; `force`, `point` and `work` (n,) are written. `point` is the mean of the forces
    at the measured samples by trapezoids, which misses where between two of them the force jumps. Between two samples the
    stroke follows the cubic of their strokes and velocities in `parts` steps, but across a rest. Returns the number of
    records done.
    """
    for r in range(len(states)):
        p.oil_level = states[r, 0]
        p.gas_preload = int(states[r, 1])
        set_up(p, d)
        d.F_0 *= states[r, 2]
        d.c_gas *= states[r, 3]
        first = starts[r]
        start(p, d, s, z[first])
        # A step without a way and velocity keeps them: those of the record before must not reach this one.
        f.k_degr = 1.0
        f.k_mean = 1.0
        before = v[first]
        time = t[first]
        at = z[first]
        memory = effects_remember(p)
        last = total_force(s)
        for i in range(first, starts[r + 1]):
            dt = t[i] - time
            s.warm = warm[i]
            n = max(parts, effects_parts(p, dt)) if d.extended > 0 else parts
            if dt <= 0.0 or (dt > REST and abs(z[i] - at) < UNMOVED * dt * max(abs(before), abs(v[i]))):
                n = 1
            # By the samples alone, so that all models see the same of them.
            gaps = samples[i] if samples[i] <= 2 * parts else 0
            if gaps > 0:
                n = gaps * math.ceil(n / gaps)
            v0 = before
            z0 = at
            total = 0.0
            sampled = 0.5 * last
            for j in range(1, n + 1):
                x = j / n
                goal = z[i]
                speed = v[i]
                if j < n:
                    # Between samples the cubic may leave the tube by a hair.
                    goal = max(-stroke_limit(d), min(stroke_limit(d), cubic(x, z0, before, z[i], v[i], dt)))
                    speed = cubic_slope(x, z0, before, z[i], v[i], dt)
                from_work = s.work
                from_impulse = s.impulse
                if not advance_whole(p, d, s, f, goal, v0, speed, dt / n):
                    return r
                way = goal - at
                if d.extended > 0 and dt > 0.0:
                    total += (s.impulse - from_impulse) / dt
                elif d.extended == 0 and abs(way) > 1e-9:
                    # The work over the stroke is the mean force, wherever in the step it jumped.
                    total += ((s.work - from_work) / way + gas_rise(p, d.F_0, d.c_gas, 0.5 * (at + goal)) - d.F_0) / n
                else:
                    total += total_force(s) / n
                at = goal
                v0 = speed
                if gaps > 0 and (j * gaps) % n == 0:
                    now = total_force(s)
                    ended = f.k_degr
                    if d.extended > 0:
                        rebound = speed > 0.0 or (speed == 0.0 and way > 0.0)
                        ended = (s.k_re if rebound else s.k_co) * effects_scale_valve(p, speed)
                    if memory == 0 and s.k_degr > NOTHING:
                        # k_degr is the mean over the step, a sample sees the end.
                        now += (ended / s.k_degr - 1.0) * s.F_fluid
                    last = now
                    sampled += now if j < n else 0.5 * now
            if gaps == 0:
                last = total_force(s)
            force[i] = total
            point[i] = sampled / gaps if gaps > 0 else total
            work[i] = s.work
            before = v[i]
            time = t[i]
    return len(states)


def cubic(x: float, z0: float, v0: float, z1: float, v1: float, dt: float) -> float:
    """Stroke [m] at the share x of a step whose strokes [m] and velocities [m/s] at both ends are given."""
    y = 1.0 - x
    return y * y * ((1.0 + 2.0 * x) * z0 + x * v0 * dt) + x * x * ((1.0 + 2.0 * y) * z1 - y * v1 * dt)


def cubic_slope(x: float, z0: float, v0: float, z1: float, v1: float, dt: float) -> float:
    """Velocity [m/s] of the same."""
    y = 1.0 - x
    return 6.0 * x * y * (z1 - z0) / dt + y * (1.0 - 3.0 * x) * v0 + x * (3.0 * x - 2.0) * v1
