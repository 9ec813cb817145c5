"""The loop over the quarter car and its damper, in the kernel's subset of Python; compiled with the kernel."""

from twintube.common.arrays import Table, Vector
from twintube.core.effects import Parameters, State
from twintube.core.model import advance
from twintube.core.outputs import total_force
from twintube.core.variables import Derived, Flow
from twintube.vehicle.quarter_car import Car, Motion, damper_stroke, damper_velocity, leapfrog_step


def run_drive(
    p: Parameters, d: Derived, s: State, f: Flow, car: Car, m: Motion,
    road: Vector, rates: Vector, push: Vector, dt: float, limit: float, out: Table,
) -> int:  # fmt: skip
    """Quarter car over the road heights `road` [m] (n,) with the time step `dt` [s], the `rates` [m/s] and `push` [N].

    `out` (n, 6) receives the damper's stroke [m], velocity [m/s] and force [N], the wheel load [N], the damper's work [J]
    since the start and its oil [m3].

    Returns the number of finished samples, less than n if the piston would leave the tube (`limit` [m]) or a step failed.
    """
    force = total_force(s)
    earlier = force
    initial_work = s.work
    for i in range(len(road)):
        stroke = damper_stroke(car, m)
        load = leapfrog_step(car, m, road[i], rates[i], 1.5 * force - 0.5 * earlier, push[i], dt)
        velocity = damper_velocity(car, m)
        row = out[i]
        row[0] = stroke
        row[1] = velocity
        row[2] = force
        row[3] = load
        row[4] = s.work - initial_work
        row[5] = s.V1_oil + s.V1_foam_oil + s.V2_oil + s.V2_foam_oil + s.V3_oil + s.V3_foam_oil
        # As the FMU does: stroke at the start of the step plus mean velocity times dt, so that both give the same bits.
        end = stroke + velocity * dt
        if not (-limit <= end <= limit) or not advance(p, d, s, f, end, velocity, velocity, dt):
            return i
        earlier = force
        force = total_force(s)
    return len(road)
