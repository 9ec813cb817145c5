"""The loop over the whole car with FMUs of FMI 2.0 as dampers, called by address; numba compiles it with the kernel."""

from typing import Any

from twintube.vehicle.full.loop import BODY_COLUMNS, WHEEL_COLUMNS, road_step, write_body, write_step


def step_units(
    set_real: Any, do_step: Any, get_real: Any, calls: Any, moved: Any, found: Any, now: Any, strokes: Any, velocities: Any,
    parts: int, dt: float,
) -> int:  # fmt: skip
    """A step of the FMUs in `parts` of `dt` [s] each; 0, or 1 + the number of the FMU that refused it.

    The k FMUs have 4 / k dampers each, and a function each in the three tuples. `calls` (k, 7) are their instances, then for
    inputs and for outputs the addresses of the references, their number, and the address of the values: rows of `moved`
    (k, 2, 4 / k), stroke and velocity, and of `found`, force and work. `strokes` (4,) [m] at the start and `velocities` (4,)
    [m/s] are given, `now` (1,) [s] goes on.
    """
    each = moved.shape[2]
    for n in range(parts):
        for i in range(4):
            unit, place = i // each, i % each
            moved[unit, 0, place] = strokes[i] + n * dt * velocities[i]
            moved[unit, 1, place] = velocities[i]
        for unit in range(len(calls)):
            c = calls[unit]
            if (
                set_real[unit](c[0], c[1], c[2], c[3]) > 1
                or do_step[unit](c[0], now[0], dt, 1) > 1
                or get_real[unit](c[0], c[4], c[5], c[6]) > 1
            ):
                return unit + 1
        now[0] += dt
    return 0


def run_car_with_units(
    set_real: Any, do_step: Any, get_real: Any, calls: Any, moved: Any, found: Any, now: Any, parts: int,
    c: Any, b: Any, ks: Any, ws: Any, h: Any, road: Any, spacing: float, grips: Any, inputs: Any,
    dt: float, out: Any, refused: Any,
) -> int:  # fmt: skip
    """As `run_car`, but the dampers are FMUs as in `step_units`.

    Returns the number of finished steps: less than n where the road ends, or where `refused` (1,) is what `step_units` said.
    """
    each = moved.shape[2]
    for i in range(4):
        ws[i].damper = found[i // each, 0, i % each]
        ws[i].before = ws[i].damper
    for n in range(len(inputs)):
        row = out[n]
        write_body(b, row)
        if not road_step(c, b, ks, ws, h, road, spacing, grips, inputs[n, 0], inputs[n, 1], inputs[n, 2], dt):
            return n
        write_step(b, ws, row, inputs[n, 0], dt)
        for i in range(4):
            row[BODY_COLUMNS + WHEEL_COLUMNS * i + 10] = found[i // each, 1, i % each]
            ws[i].before = ws[i].damper
        refused[0] = step_units(
            set_real, do_step, get_real, calls, moved, found, now, ws.stroke, ws.velocity, parts, dt / parts
        )  # fmt: skip
        if refused[0] != 0:
            return n
        for i in range(4):
            ws[i].damper = found[i // each, 0, i % each]
    return len(inputs)
