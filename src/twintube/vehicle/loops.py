"""The loop over a quarter car with its damper, in the kernel's own subset; numba compiles it together with the kernel."""

from typing import Any

from twintube.core.model import advance
from twintube.vehicle.quarter_car import damper_stroke, damper_velocity, kick


def run_drive(
    p: Any, d: Any, s: Any, f: Any, car: Any, m: Any, road: Any, rates: Any, push: Any, dt: float, limit: float, out: Any
) -> int:
    """Quarter car over the road heights `road` [m] (n,), one every `dt` [s], rising at `rates` [m/s], under `push` [N].

    `out` (n, 6) takes the damper's stroke [m], velocity [m/s] and force [N], the wheel load [N], the damper's work [J]
    since the start and its oil [m3].

    Returns the number of samples done, less than n if the piston would leave the tube (`limit` [m]) or a step failed.
    """
    force = s.F_fluid + s.F_friction + s.F_gas
    earlier = force
    work = s.work
    for i in range(len(road)):
        stroke = damper_stroke(car, m)
        load = kick(car, m, road[i], rates[i], 1.5 * force - 0.5 * earlier, push[i], dt)
        velocity = damper_velocity(car, m)
        row = out[i]
        row[0] = stroke
        row[1] = velocity
        row[2] = force
        row[3] = load
        row[4] = s.work - work
        row[5] = s.V1_oil + s.V1_foam_oil + s.V2_oil + s.V2_foam_oil + s.V3_oil + s.V3_foam_oil
        # As the FMU: from the stroke at the start of the step with its mean velocity, so that both give the same bits.
        end = stroke + velocity * dt
        if not (-limit <= end <= limit) or not advance(p, d, s, f, end, velocity, velocity, dt):
            return i
        earlier = force
        force = s.F_fluid + s.F_friction + s.F_gas
    return len(road)
