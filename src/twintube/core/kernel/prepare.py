"""Before the first step: what follows from the parameters, and where the oil is."""

import math

from twintube.core.kernel.forces import filling_speed, gas_force
from twintube.core.kernel.temperature import temper
from twintube.core.variables import Derived, Parameters, State


def prepare(p: Parameters, d: Derived) -> None:
    """Fill `d` from `p`; to be called again after a parameter has changed."""
    d.A_rod = 0.25 * math.pi * p.D_PR * p.D_PR
    d.A_2 = 0.25 * math.pi * p.D_li * p.D_li
    d.A_1 = d.A_2 - d.A_rod
    d.half_length = 0.5 * (p.h_l - p.dead_length)
    d.V_reserve = 0.25 * math.pi * (p.D_a * p.D_a - p.D_la * p.D_la) * p.h_l

    lost = 1.0 - p.gas_preload
    d.F_0 = p.gas_preload * p.F_0
    d.c_gas = p.gas_preload * p.c_gas + lost * p.c_gas_lost
    d.v_fill = filling_speed(p, d)
    lose(p, d, p.oil_level)

    # Eq. 22: W_kPV reaches its target within one step. Reading B adds the leak to the flow; the force stays X_Re.
    d.W_kPV = (1.0 - p.L_PV) * p.X_Re + p.leak_carries_oil * p.L_PV
    a = d.A_1 / d.A_2
    # Eq. 27
    d.W_kBV_1 = (1.0 - a) * p.X_Co1
    # Eq. 28
    d.W_kBV_2 = (1.0 - a) * p.X_Co2
    # Eq. 29: W_kBV/(1 - a) + G_PV ((1 - W_kBV) - a)/(1 - a), free of 0/0 where a is 1
    d.k_Co2 = p.X_Co2 + p.G_PV * (1.0 - p.X_Co2)


def lose(p: Parameters, d: Derived, oil_level: float) -> None:
    """Friction and cavitation shares of a damper that holds `oil_level` [1] of its oil."""
    # Section 3.2: "In case of oil loss, the friction force of the SA increases".
    d.F_FrS = p.F_FrS * (1.0 + p.oil_loss_gain * (1.0 - oil_level))
    # Section 3.2: the force falls from oscillation to oscillation when the damper "contains less than 100 % oil". Beside the
    # preload it takes gas in the place of oil: in proportion to the loss, in full from `cavitation_loss` on. The paper
    # measured with the preload and without; in between it goes with the pressure that is missing.
    loss = 1.0 - oil_level
    d.cavitation = (1.0 - p.gas_preload) * (1.0 if loss >= p.cavitation_loss else loss / p.cavitation_loss)
    cavitate(p, d, 1.0)


def cavitate(p: Parameters, d: Derived, share: float) -> None:
    """Cavitation shares where the `share` [1] of the gas can be freed; the paper knows no limit, 1."""
    d.Y_Co = share * d.cavitation * p.Y_Co_cav
    d.Y_Re = share * d.cavitation * p.Y_Re_cav


def fill(p: Parameters, d: Derived, s: State, z: float) -> None:
    """The state at rest at the stroke `z` [m]: oil fills V2, then V1, the rest is in the reserve; no foam.

    The order no longer matters after the paper's six preconditioning oscillations.
    """
    pour(p, d, s, z, p.oil_level * p.V_oil)


def pour(p: Parameters, d: Derived, s: State, z: float, oil: float) -> None:
    """As `fill`, with the volume `oil` [m3]."""
    V1 = d.A_1 * (d.half_length - z)
    V2 = d.A_2 * (d.half_length + z)
    s.z = z
    s.V2_oil = min(oil, V2)
    s.V1_oil = min(oil - s.V2_oil, V1)
    s.V3_oil = oil - s.V2_oil - s.V1_oil
    s.V1_gas = V1 - s.V1_oil
    s.V2_gas = V2 - s.V2_oil
    s.V1_foam = 0.0
    s.V1_foam_oil = 0.0
    s.V1_void = 0.0
    s.V2_foam = 0.0
    s.V2_foam_oil = 0.0
    s.V3_foam = 0.0
    s.V3_foam_oil = 0.0
    s.V_cav = 0.0
    s.F_D = 0.0
    s.k_degr = 1.0
    s.F_fluid = 0.0
    s.F_friction = 0.0
    s.temperature = p.T_curve
    temper(p, s, p.T_curve)
    s.F_gas = gas_force(p, d, s, z)
    s.work = 0.0
    s.work_begun = 0.0
    s.span = 0.0
