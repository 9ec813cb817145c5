"""Constants of the right-hand side."""

from typing import NamedTuple


class Constants(NamedTuple):
    """Dimensions, valves and fluids, SI units; `damper.py` gives the assumptions and their reasons."""

    A_1: float  # [m2] annulus of the piston
    A_2: float  # [m2] piston
    V_10: float  # [m3] rebound chamber at stroke 0
    V_20: float  # [m3] compression chamber at stroke 0
    V_3: float  # [m3] reserve
    p_fill: float  # [Pa] absolute reserve pressure in the initial state
    n_reserve: float  # [1] polytropic exponent of the reserve's gas
    K_oil: float  # [Pa] bulk modulus of oil and tube
    rho_oil: float  # [kg/m3]
    C_d: float  # [1] discharge coefficient
    piston_bleed: float  # [m2]
    piston_crack: float  # [Pa] opening of the blow-off valve in rebound
    piston_opening: float  # [m2/Pa] its area per pressure above the opening
    check_crack: float  # [Pa] opening of the piston's valve in compression
    check_opening: float  # [m2/Pa]
    base_bleed: float  # [m2]
    base_crack: float  # [Pa] opening of the blow-off valve in compression
    base_opening: float  # [m2/Pa]
    suction: float  # [m2] suction valve of the foot, open in rebound, and windows from the foot valve to the reserve
    suction_pressure: float  # [Pa] at which it is fully open
    rod_guide: float  # [m2] gap from the rebound chamber to the reserve
    guide_gap: float  # [m3/(Pa s)] laminar gap around the rod at 25 degC
    piston_gap: float  # [m3/(Pa s)] laminar leak past the piston at 25 degC
    thinning: float  # [1/K] share of viscosity lost per kelvin at 25 degC
    port: float  # [m] height of oil over which a port changes from oil to gas at rest
    draw: float  # [1] the same under flow, relative to (Q^2/g)^(1/5), the height from which a port draws
    height_1: float  # [m] rebound chamber at stroke 0
    height_2: float  # [m] compression chamber at stroke 0
    height_3: float  # [m] reserve
    Q_mix: float  # [m3/s] flow at which half of the gas is broken into bubbles
    jet: float  # [1] pocket gas that an oil jet entrains, per oil
    A_3: float  # [m2] cross-section of the reserve
    wetted: float  # [m] perimeter of the reserve
    jet_width: float  # [m] width of a foot-valve jet
    viscosity: float  # [m2/s] at 25 degC
    released: float  # [1] largest share of the dissolved gas that one pass of a cavitating valve releases
    cavitating: float  # [1] pressure drop over downstream pressure at which a valve releases half of that
    t_separate: float  # [s] time constant of rising bubbles
    solubility: float  # [1] dissolved gas per oil at P_0
    t_release: float  # [s] half-life of dissolved gas above saturation
    t_dissolve: float  # [s] half-life of bubbles below saturation
    heat_capacity: float  # [J/K]
    cooling: float  # [W/K]
    T_ambient: float  # [degC]
    F_static: float  # [N]
    F_sliding: float  # [N]
    v_stribeck: float  # [m/s]
    bristle: float  # [N/m]
    viscous: float  # [N s/m]
    leak: float  # [m2] oil that the rod carries out past its seal, per stroke out
    foam: float  # [1] share of both working chambers that is bubbles at the start
