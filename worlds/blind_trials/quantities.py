"""Inputs of the compiled model: constants of a damper, and hidden physics in addition to the paper's. SI units.

If a field is renamed or moved, change model.py too: its compiled functions are cached by file.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Tube(NamedTuple):
    """A damper in one condition."""

    A_1: float  # [m2] annulus
    A_2: float  # [m2] piston
    A_rod: float  # [m2]
    half: float  # [m] free length of a working chamber at stroke 0
    V_res: float  # [m3] reserve
    oil: float  # [m3] at the start
    X_Re: float
    W_PV: float
    X_Co1: float
    W_BV1: float
    W_BV2: float
    k_Co2: float
    S_BV: float
    S_BVoil: float
    S_PV: float
    S_PVoil: float
    B: float
    E: float
    v_foam: float  # [m/s]
    v_cav: float  # [m/s]
    Y_Co: float
    Y_Re: float
    F_sat: float  # [N] saturated friction
    sigma: float  # [N/m]
    delta: float
    k_high: float
    v_S: float  # [m/s]
    F_0: float  # [N] gas force at stroke 0
    c_gas: float  # [N/m]
    p_fill: float  # [Pa] absolute pressure at rest
    fast_share: float  # [1] of new foam that drains fast
    v_re: Array  # (m,) [m/s]
    F_re: Array  # (m,) [N]
    v_co: Array  # (m,) [m/s]
    F_co: Array  # (m,) [N]


class Hidden(NamedTuple):
    """Physics in addition to the paper's; the defaults switch all of it off."""

    start: float = 298.15  # [K]
    warming: float = 0.0  # [K/J] 1 / heat capacity
    cooling: float = 0.0  # [1/s]
    thinning: float = 0.0  # [1] exponent of the viscosity in the fluid force
    mount: float = 0.0  # [N/m] 0: rigid
    hardening: float = 0.0  # [1/m2] growth of the mount's stiffness with the square of its deflection
    rubber: float = 0.0  # [N s/m] damping of the mount
    mass: float = 2.0  # [kg] of the rod
    give: float = 0.0  # [1/Pa] compressibility of the oil; 0: stiff
    air: float = 0.0  # [1] trapped air at ambient pressure, share of the chamber
    blend: float = 0.0  # [m] width of the change of k_degr
    drain_fast: float = 0.0  # [1/s]
    drain_slow: float = 0.0  # [1/s]
    dissolve: float = 0.0  # [1/s]
    give_way: float = 0.0  # [1] share of the displaced oil that stays in the reserve
    scarce: float = 0.0  # [1] initial oil volume over the gas volume that it can free
    residual: float = 0.0  # [Pa] gauge
    polytropic: float = 1.2  # [1]
    leak: float = 0.0  # [m3/s per (m/s)^0.5]
    stop_out: float = 0.0  # [N] at the scale length, rebound stop
    stop_in: float = 0.0  # [N] the same, compression stop
    stop_at: float = 1.0  # [m] stroke at which a stop is touched
    stop_scale: float = 1.0  # [m]
    stop_loss: float = 0.0  # [1] hysteresis
    side: float = 0.0  # [N]
    side_v: float = 0.01  # [m/s] over which it reverses
    lever: float = 0.0  # [1] share of the friction that a side force on the rod causes
    span: float = 0.1  # [m] from guide to piston at the stroke 0
    overhang: float = 0.05  # [m] from the side force to the guide at the stroke 0
    wear_re: float = 0.0  # [1] change of the rebound force at high velocity
    wear_re_slow: float = 0.0  # [1] at low velocity
    wear_co: float = 0.0  # [1]
    wear_co_slow: float = 0.0  # [1]
    wear_v: float = 0.3  # [m/s] range from low to high velocity
    mode: float = 0.0  # [rad/s] structural mode of the rig
    mode_loss: float = 0.04  # [1] its damping ratio
    mode_share: float = 0.0  # [1] share of the force that excites it
    play: float = 0.0  # [m] of the joint
