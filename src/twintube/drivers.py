"""Loops over the kernel, in the kernel's own subset so that numba compiles them together with it.

`p`, `d`, `s`, `f` are records of `variables.py`: dataclasses in the interpreter, rows of structured arrays in numba.
"""

from typing import Any

from twintube.model import advance, fluid_now, set_up, start
from twintube.quarter_car import kick

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
)


def run_record(p: Any, d: Any, s: Any, f: Any, t: Any, z: Any, v: Any, out: Any) -> int:
    """Drive the damper over times `t` [s], strokes `z` [m] and velocities `v` [m/s], all (n,), and write `out` (n, 15).

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
        row[0] = s.F_fluid + s.F_friction + s.F_gas
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
    return len(z)


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


def run_drive(
    p: Any, d: Any, s: Any, f: Any, car: Any, m: Any, road: Any, push: Any, dt: float, limit: float, out: Any
) -> int:
    """Quarter car over the road heights `road` [m] (n,), one every `dt` [s], pressed down by `push` [N] (n,).

    `out` (n, 4) takes the stroke [m], the damper velocity [m/s], the damper force [N] and the wheel load [N].

    Returns the number of samples done, less than n if the piston would leave the tube (`limit` [m]) or a step failed.
    """
    before = 0.0
    force = s.F_fluid + s.F_friction + s.F_gas
    earlier = force
    for i in range(len(road)):
        stroke = m.z_body - m.z_wheel
        rate = 0.5 * (road[i + 1] - road[i - 1]) / dt if 0 < i < len(road) - 1 else 0.0
        load = kick(car, m, road[i], rate, 1.5 * force - 0.5 * earlier, push[i], dt)
        velocity = m.v_body - m.v_wheel
        row = out[i]
        row[0] = stroke
        row[1] = velocity
        row[2] = force
        row[3] = load
        end = m.z_body - m.z_wheel
        if not (-limit <= end <= limit) or not advance(p, d, s, f, end, before, velocity, dt):
            return i
        before = velocity
        earlier = force
        force = s.F_fluid + s.F_friction + s.F_gas
    return len(road)


def run_errors(
    p: Any,
    d: Any,
    s: Any,
    f: Any,
    states: Any,
    t: Any,
    z: Any,
    v: Any,
    force: Any,
    starts: Any,
    marks: Any,
    work: Any,
    out: Any,
) -> int:
    """Squared errors of a parameter set `p` against all records, laid end to end.

    `states` (r, 2) are the records' oil level and preload, `starts` (r + 1,) where they begin, `marks` (r, c + 1) where
    their oscillations begin and end; samples before the first mark count nothing. `out` (r, 2) takes the sums of the
    squared errors of the force [N2] and of the works of the oscillations [J2], `work` (r, c) being the measured ones.
    Returns the number of records done.
    """
    cycles = marks.shape[1] - 1
    for r in range(len(states)):
        p.oil_level = states[r, 0]
        p.gas_preload = int(states[r, 1])
        set_up(p, d)
        first = starts[r]
        start(p, d, s, z[first])
        before = v[first]
        time = t[first]
        done = 0.0
        cycle = 0
        out[r, 0] = 0.0
        out[r, 1] = 0.0
        for i in range(first, starts[r + 1]):
            if not advance(p, d, s, f, z[i], before, v[i], t[i] - time):
                return r
            before = v[i]
            time = t[i]
            if i == marks[r, 0]:
                done = s.work
            if i >= marks[r, 0]:
                # k_degr of this moment, not the mean over the step: samples are far apart here.
                error = fluid_now(p, d, s, f, v[i]) + s.F_friction + s.F_gas - force[i]
                out[r, 0] += error * error
            if cycle < cycles and i == marks[r, cycle + 1]:
                error = s.work - done - work[r, cycle]
                out[r, 1] += error * error
                done = s.work
                cycle += 1
    return len(states)
