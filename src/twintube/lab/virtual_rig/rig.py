"""Run the virtual damper through a stroke record."""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

from twintube.common.arrays import Array
from twintube.lab.virtual_rig.constants import Constants
from twintube.lab.virtual_rig.damper import VirtualDamper
from twintube.lab.virtual_rig.physics import (
    BUBBLES,
    DISSOLVED,
    ENERGY,
    FILM,
    OIL,
    P_0,
    POCKET,
    STATES,
    T_0,
    TEMPERATURE,
)
from twintube.native.library import module

RTOL = 1e-7
ATOL = np.array([1e-12] * 13 + [1e-5, 1e-9, 1e-3])  # [m3], [degC], [m], [J]
LOWEST = 0.05  # oil level [1] down to which the rig can be filled


@dataclass(frozen=True)
class VirtualRecord:
    """Signals of the rig and, unlike a real rig, of the inside of the damper: arrays (n,), SI units.

    Rows of the (3, n) arrays are rebound chamber, compression chamber and reserve.
    """

    damper: VirtualDamper
    oil_level: float  # [1] share of the intact oil
    gas_preload: float  # [1] share of the gas pressure above ambient
    time: Array  # [s]
    stroke: Array  # [m], positive in rebound
    velocity: Array  # [m/s]
    force: Array  # [N], positive when the damper is pulled in rebound
    temperature: Array  # [degC] of the oil
    dissipated: Array  # [J] turned into heat since the start
    pressure: Array  # [Pa] absolute, (3, n)
    oil: Array  # [m3] at ambient pressure, (3, n)
    film: Array  # [m3] oil on the walls of the reserve, included in `oil`, (n,)
    free_gas: Array  # [m3] at ambient pressure and 25 degC, pockets and bubbles, (3, n)
    bubbles: Array  # [m3] gas in bubbles, included in `free_gas`, (3, n)
    dissolved_gas: Array  # [m3] at ambient pressure and 25 degC, (3, n)


def initial_state(z: float, oil: float, temperature: float, c: Constants) -> Array:
    """States at rest at the stroke z [m] with `oil` [m3]: filled in the order compression, rebound, reserve."""
    p = c.p_fill
    dense = 1.0 - (p - P_0) / c.K_oil
    warm = (temperature + 273.15) / T_0
    rooms = np.array([c.V_10 - c.A_1 * z, c.V_20 + c.A_2 * z, c.V_3])
    y = np.zeros(STATES)
    remaining = oil
    for i in (1, 0, 2):
        froth = c.foam * rooms[i] if i < 2 else 0.0
        y[OIL + i] = min(remaining, (rooms[i] - froth) / (dense if i < 2 else 1.0))
        remaining -= y[OIL + i]
        y[BUBBLES + i] = froth * p / P_0 / warm
        y[POCKET + i] = max(rooms[i] - froth - y[OIL + i] * (dense if i < 2 else 1.0), 0.0) * p / P_0 / warm
        y[DISSOLVED + i] = c.solubility * y[OIL + i] * p / P_0
    y[TEMPERATURE] = temperature
    return y


def run(
    damper: VirtualDamper,
    time: Array,
    stroke: Array,
    oil_level: float = 1.0,
    *,
    gas_preload: float = 1.0,
    temperature_degC: float = 25.0,
    rtol: float = RTOL,
) -> VirtualRecord:
    """Record of the damper at rest before `time[0]` [s], then driven by a cubic spline through `stroke` [m].

    Raises ValueError if time or stroke is not a valid record, or if the oil does not fit.
    """
    time = np.ascontiguousarray(time, dtype=float)
    stroke = np.ascontiguousarray(stroke, dtype=float)
    c = damper.constants(gas_preload, temperature_degC)
    check(damper, time, stroke, oil_level, c)
    path = CubicSpline(time, stroke)
    velocity = path(time, 1)
    compiled, breaks, spline = module("rig"), np.array(path.x), np.ascontiguousarray(path.c)

    def rates(t: float, y: Array) -> Array:
        """Rates of the states."""
        dy = np.empty(STATES)
        compiled.right_hand_side(t, y, breaks, spline, c, dy)
        return dy

    solution = solve_ivp(
        rates,
        (time[0], time[-1]),
        initial_state(stroke[0], oil_level * damper.V_oil, temperature_degC, c),
        method="LSODA",
        t_eval=time,
        rtol=rtol,
        atol=ATOL * (rtol / RTOL),
        max_step=float(np.median(np.diff(time))) * 20,
    )
    if not solution.success or not np.isfinite(solution.y).all():
        raise RuntimeError(f"{damper.name}: the solver stopped at {solution.t[-1]:.3f} s: {solution.message}")
    y = np.ascontiguousarray(solution.y.T)
    out = np.empty((4, len(time)))
    compiled.outputs(stroke, velocity, y, c, out)
    return VirtualRecord(
        damper=damper,
        oil_level=oil_level,
        gas_preload=gas_preload,
        time=time,
        stroke=stroke,
        velocity=velocity,
        force=out[0],
        temperature=solution.y[TEMPERATURE],
        dissipated=solution.y[ENERGY],
        pressure=out[1:],
        oil=solution.y[OIL : OIL + 3] + np.outer([0, 0, 1], solution.y[FILM]),
        film=solution.y[FILM],
        free_gas=solution.y[POCKET : POCKET + 3] + solution.y[BUBBLES : BUBBLES + 3],
        bubbles=solution.y[BUBBLES : BUBBLES + 3],
        dissolved_gas=solution.y[DISSOLVED : DISSOLVED + 3],
    )


def check(damper: VirtualDamper, time: Array, stroke: Array, oil_level: float, c: Constants) -> None:
    """Raise ValueError with the first defect of the inputs."""
    if time.ndim != 1 or time.shape != stroke.shape or len(time) < 4:
        raise ValueError("time and stroke must be arrays of the same length, at least 4")
    if not (np.isfinite(time).all() and np.isfinite(stroke).all() and (np.diff(time) > 0).all()):
        raise ValueError("time must rise, time and stroke must be finite")
    longest = 0.95 * damper.half
    if np.abs(stroke).max() > longest:
        raise ValueError(f"stroke {np.abs(stroke).max():.4f} m is beyond the end stops at {longest:.4f} m")
    room = (1.0 - c.foam) * (c.V_10 + c.V_20) - (c.A_2 - c.A_1) * np.abs(stroke).max() + 0.95 * c.V_3
    if not LOWEST <= oil_level <= room / damper.V_oil:
        raise ValueError(f"oil_level {oil_level}: must be from 0.05 to {room / damper.V_oil:.3f}")
