"""Constants of a damper in one condition, and simulation of a run."""

from math import pi

import numpy as np

from twintube.dampers import Damper, load
from worlds.blind_trials.excitation import Excitation
from worlds.blind_trials.model import COLUMNS, P_ATM, STATES, run
from worlds.blind_trials.quantities import Array, Hidden, Tube

DZ, DT = 40e-6, 1e-3  # [m], [s] largest step
DT_VIBRATION = 2e-4  # [s] largest step if the rod's mass or the rig can vibrate


def tube(damper: str | Damper, level: float, preload: bool, changes: dict[str, float] | None = None) -> Tube:
    """The damper at the oil `level` [1], with or without gas preload; `changes` are changed parameters."""
    loaded = load(damper, as_published=True) if isinstance(damper, str) else damper
    p = (loaded.with_(**changes) if changes else loaded).parameters
    A_rod, A_2 = pi / 4 * p.D_PR**2, pi / 4 * p.D_li**2
    rod = A_rod / A_2
    full_loss = p.cavitation_loss  # oil loss of the full effect; proportional below it
    cavitates = 0.0 if preload else 1.0 if 1.0 - level >= full_loss else (1.0 - level) / full_loss
    same = {
        name: getattr(p, name) for name in ("X_Re", "X_Co1", "S_BV", "S_BVoil", "S_PV", "S_PVoil", "B", "E", "k_high", "v_S")
    }
    return Tube(
        A_1=A_2 - A_rod, A_2=A_2, A_rod=A_rod, half=(p.h_l - p.dead_length) / 2,
        V_res=pi / 4 * (p.D_a**2 - p.D_la**2) * p.h_l, oil=level * p.V_oil,
        W_PV=(1 - p.L_PV) * p.X_Re, W_BV1=rod * p.X_Co1, W_BV2=rod * p.X_Co2, k_Co2=p.X_Co2 + p.G_PV * (1 - p.X_Co2),
        # A block whose maximum velocity equals the threshold stays below it, independent of rounding.
        v_foam=p.v_foam * (1 + 1e-9), v_cav=p.v_cav * (1 + 1e-9), Y_Co=cavitates * p.Y_Co_cav, Y_Re=cavitates * p.Y_Re_cav,
        F_sat=p.F_FrS * (1 + p.oil_loss_gain * (1 - level)), sigma=p.sigma_0, delta=p.delta_D,
        F_0=p.F_0 if preload else 0.0, c_gas=p.c_gas if preload else p.c_gas_lost,
        p_fill=P_ATM + (p.F_0 / A_rod if preload else 0.0), fast_share=0.5, **same,
        v_re=np.array(p.v_re), F_re=np.array(p.F_re), v_co=np.array(p.v_co), F_co=np.array(p.F_co),
    )  # fmt: skip


def march(c: Tube, h: Hidden, excitation: Excitation, times: Array, dz: float = DZ) -> Array:
    """Simulate a run; results (n, COLUMNS) at the rising `times` (n,) [s], columns as in model.py."""
    out = np.empty((len(times), COLUMNS))
    dt = DT_VIBRATION if h.mount + h.mode > 0.0 else DT
    run(c, h, excitation.pieces, np.ascontiguousarray(times, float), np.zeros(STATES), dz, dt, out)
    return out
