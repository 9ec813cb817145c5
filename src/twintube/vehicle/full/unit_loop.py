"""The loop over the whole car with FMUs of FMI 2.0 as dampers, called by address; compiled with the kernel."""

from collections.abc import Sequence
from ctypes import CFUNCTYPE, c_double, c_int, c_size_t, c_void_p

from twintube.common.arrays import Addresses, Counts, Stack, Table, Vector
from twintube.vehicle.full.brakes import Brakes
from twintube.vehicle.full.car import Body, BodyMotion, Wheel, WheelMotion
from twintube.vehicle.full.loop import BODY_COLUMNS, WHEEL_COLUMNS, road_step, write_body, write_step

VALUES = CFUNCTYPE(c_int, c_void_p, c_void_p, c_size_t, c_void_p)
STEP = CFUNCTYPE(c_int, c_void_p, c_double, c_double, c_int)


def call_values(function: int, component: int, references: int, size: int, values: int) -> int:
    """Call fmi2SetReal or fmi2GetReal at its address; the status. In C this is the call itself (`native/sources.py`)."""
    status: int = VALUES(function)(component, references, size, values)
    return status


def call_step(function: int, component: int, time: float, dt: float) -> int:
    """Call fmi2DoStep at its address; the status. No state before the step will be set."""
    status: int = STEP(function)(component, time, dt, 1)
    return status


def step_units(
    calls: Addresses, moved: Stack, found: Stack, now: Vector, moves: Table, parts: int, dt: float,
) -> int:  # fmt: skip
    """A step of the FMUs in `parts` of `dt` [s] each; 0, or 1 + the number of the FMU that refused it.

    The k FMUs have 4 / k dampers each. `calls` (k, 10) are their functions fmi2SetReal, fmi2DoStep and fmi2GetReal and their
    instances, then for inputs and for outputs the addresses of the references, their number, and the address of the values:
    rows of `moved` (k, 2, 4 / k), stroke and velocity, and of `found`, force and work. `moves` (2, 4) are the strokes [m] at
    the start and the velocities [m/s], `now` (1,) [s] goes on.
    """
    each = moved.shape[2]
    for n in range(parts):
        for i in range(4):
            unit, place = i // each, i % each
            moved[unit, 0, place] = moves[0, i] + n * dt * moves[1, i]
            moved[unit, 1, place] = moves[1, i]
        for k in range(len(calls)):
            c = calls[k]
            if (
                call_values(c[0], c[3], c[4], c[5], c[6]) > 1
                or call_step(c[1], c[3], now[0], dt) > 1
                or call_values(c[2], c[3], c[7], c[8], c[9]) > 1
            ):
                return k + 1
        now[0] += dt
    return 0


def run_car_with_units(
    calls: Addresses, moved: Stack, found: Stack, now: Vector, moves: Table, parts: int,
    c: Body, b: BodyMotion, ks: Sequence[Wheel], ws: Sequence[WheelMotion], h: Brakes, road: Table, spacing: float,
    grips: Vector, inputs: Table, dt: float, out: Table, refused: Counts,
) -> int:  # fmt: skip
    """As `run_car`, but the dampers are FMUs as in `step_units`, whose `moves` it fills in.

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
            moves[0, i] = ws[i].stroke
            moves[1, i] = ws[i].velocity
        refused[0] = step_units(calls, moved, found, now, moves, parts, dt / parts)
        if refused[0] != 0:
            return n
        for i in range(4):
            ws[i].damper = found[i // each, 0, i % each]
    return len(inputs)
