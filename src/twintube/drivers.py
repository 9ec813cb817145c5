"""Loops over the kernel, in the kernel's own subset so that numba compiles them together with it.

`p`, `d`, `s`, `f` are records of `variables.py`: dataclasses in the interpreter, rows of structured arrays in numba.
"""

from typing import Any

from twintube.model import advance, set_up, start
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


def run_means(
    p: Any, d: Any, s: Any, f: Any, states: Any, t: Any, z: Any, v: Any, starts: Any, force: Any, work: Any
) -> int:
    """Records laid end to end: the mean force [N] over the time since the sample before and the work [J] since the start.

    `states` (r, 2) are the records' oil level and preload, `starts` (r + 1,) where they begin; `force` and `work` (n,) are
    written. Returns the number of records done.
    """
    for r in range(len(states)):
        p.oil_level = states[r, 0]
        p.gas_preload = int(states[r, 1])
        set_up(p, d)
        first = starts[r]
        start(p, d, s, z[first])
        before = v[first]
        time = t[first]
        for i in range(first, starts[r + 1]):
            from_z = s.z
            from_work = s.work
            from_impulse = s.impulse
            dt = t[i] - time
            if not advance(p, d, s, f, z[i], before, v[i], dt):
                return r
            before = v[i]
            time = t[i]
            work[i] = s.work
            way = z[i] - from_z
            if d.extended > 0:
                force[i] = (s.impulse - from_impulse) / dt if dt > 0.0 else s.F_fluid + s.F_friction + s.F_gas
            elif abs(way) > 1e-9:
                # The work over the stroke is the mean force, wherever in the step it jumped.
                force[i] = (s.work - from_work) / way + d.c_gas * 0.5 * (from_z + z[i]) - d.F_0
            else:
                force[i] = s.F_fluid + s.F_friction + s.F_gas
    return len(states)
