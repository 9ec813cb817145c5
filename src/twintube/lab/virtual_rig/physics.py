"""Right-hand side of the rig's damper: masses in three chambers and their pressures, in the subset that becomes C.

The states are masses, not chamber pressures: at a given stroke the oil and gas of a chamber determine its pressure. Masses
are conserved to rounding, whereas a pressure state would drift. They are given as standard volumes [m3] at P_0 and T_0.
Fade has four causes: without preload, gas below the piston leaves the foot valve too little back pressure to fill the
rebound chamber; gas of the reserve is drawn in where oil is missing; jets of the foot valve throw oil onto the reserve's
walls, which runs down too late for the next stroke; the jet of a valve releases dissolved gas.
"""

import math

from twintube.common.arrays import Table, Vector
from twintube.lab.virtual_rig.constants import Constants

P_0 = 1.0e5  # [Pa] ambient pressure
T_0 = 298.15  # [K]
GAS_DENSITY = 1.17  # [kg/m3] at P_0 and T_0
P_SMOOTH = 1.0e3  # [Pa] at lower pressure drops an orifice is nearly laminar
TINY = 1.0e-12  # [m3]
VOGEL = 95.0  # [degC] of mineral oils in Vogel's law, viscosity ~ exp(B / (T + VOGEL)), after Cameron (remembered)

# States: oil, gas in a pocket above the oil, gas in bubbles, dissolved gas, each in the rebound chamber 0, the compression
# chamber 1 and the reserve 2; oil on the reserve's walls [m3], oil temperature [degC], bristle deflection [m], energy
# dissipated [J]. The gas dissolved in the reserve belongs to its pool and to the film.
OIL, POCKET, BUBBLES, DISSOLVED, FILM, TEMPERATURE, BRISTLE, ENERGY, STATES = 0, 3, 6, 9, 12, 13, 14, 15, 16


def warmth(temperature: float) -> float:
    """Gas volume relative to that at T_0 [1]; bounded, because the solver tries states that are never reached."""
    return min(max((temperature + 273.15) / T_0, 0.7), 2.0)


def chamber_pressure(V: float, oil: float, gas: float, K: float) -> float:
    """Absolute pressure [Pa] at which oil and ideal gas fill the volume V: the positive root of a quadratic."""
    oil = max(oil, TINY)
    gas = max(gas, TINY)
    c = oil / K
    b = oil * (1.0 + P_0 / K) - V
    root = math.sqrt(b * b + 4.0 * c * gas * P_0)
    if b > 0.0:
        return (b + root) / (2.0 * c)
    return 2.0 * gas * P_0 / (root - b)


def reserve_pressure(oil: float, gas: float, warm: float, c: Constants) -> float:
    """Absolute pressure [Pa] of the reserve's gas, polytropic about the initial state."""
    return c.p_fill * math.pow(max(gas, TINY) * warm * P_0 / (max(c.V_3 - oil, 1e-7) * c.p_fill), c.n_reserve)


def pressures(z: float, y: Vector, c: Constants) -> tuple[float, float, float]:
    """Absolute pressures [Pa] of rebound chamber, compression chamber and reserve at the stroke z [m]."""
    warm = warmth(y[TEMPERATURE])
    p_1 = chamber_pressure(c.V_10 - c.A_1 * z, y[OIL], (y[POCKET] + y[BUBBLES]) * warm, c.K_oil)
    p_2 = chamber_pressure(c.V_20 + c.A_2 * z, y[OIL + 1], (y[POCKET + 1] + y[BUBBLES + 1]) * warm, c.K_oil)
    return p_1, p_2, reserve_pressure(y[OIL + 2] + y[FILM], y[POCKET + 2] + y[BUBBLES + 2], warm, c)


def friction(v: float, bristle: float, c: Constants) -> tuple[float, float]:
    """LuGre: rate of the bristle deflection [m/s] and friction force [N]."""
    share = v / c.v_stribeck
    level = c.F_sliding + (c.F_static - c.F_sliding) * math.exp(-(share * share))
    rate = v - c.bristle * abs(v) / level * bristle
    return rate, c.bristle * bristle + c.viscous * v


def opened(p: float, p_full: float) -> float:
    """Opening of the suction valve [1], smooth between 0 and `p_full`."""
    x = min(max(p / p_full, 0.0), 1.0)
    return x * x * (3.0 - 2.0 * x)


def blow_off(p: float, crack: float, slope: float) -> float:
    """Area [m2] of a pressure-relief valve, rounded over a tenth of its opening pressure, and closed below."""
    w = 0.1 * crack
    x = max(p - crack + w, 0.0)
    return slope * x * x / (4.0 * w) if x < 2.0 * w else slope * (x - w)


def shares(i: int, p: float, Q: float, y: Vector, at_bottom: bool, c: Constants) -> tuple[float, float, float]:
    """Volume shares of oil, pocket gas and bubbles at a port at bottom or top of chamber i that draws about Q [m3/s]."""
    height = c.height_1 if i == 0 else c.height_2 if i == 1 else c.height_3
    width = (c.port + c.draw * math.pow((Q * Q + 1e-12) / 9.81, 0.2)) / height
    warm = warmth(y[TEMPERATURE])
    oil = max(y[OIL + i], 0.0)
    pocket = max(y[POCKET + i], 0.0) * P_0 / p * warm
    bubbles = max(y[BUBBLES + i], 0.0) * P_0 / p * warm
    liquid = oil + bubbles
    total = max(liquid + pocket, TINY)
    if at_bottom:
        wetted = 1.0 - math.exp(-liquid / (width * total)) * (1.0 - math.exp(-pocket / (0.2 * width * total)))
    else:
        wetted = math.exp(-pocket / (width * total)) * (1.0 - math.exp(-liquid / (0.2 * width * total)))
    oil_share = oil / max(liquid, TINY)
    return wetted * oil_share, 1.0 - wetted, wetted * (1.0 - oil_share)


def orifice(dp: float, area: float, gap: float, rho: float, oil: float, c: Constants) -> float:
    """Volume flow [m3/s] for dp >= 0: turbulent through the area, laminar through the gap (viscosity of gas: 1 %)."""
    turbulent = c.C_d * area * math.sqrt(2.0 / rho) * dp / math.sqrt(math.sqrt(dp * dp + P_SMOOTH * P_SMOOTH))
    return turbulent + gap * dp / (0.01 + oil)


def all_oil(i: int, y: Vector) -> float:
    """Oil of chamber i with that on the walls [m3]."""
    total: float = max(y[OIL + i], 0.0)
    if i == 2:
        total += max(y[FILM], 0.0)
    return total


def throw(Q: float, Q_oil: float, y: Vector, dy: Vector, c: Constants) -> None:
    """Move a share of the foot valve's flow to the reserve's walls: half of it if the jet's head is half the height.

    A turbulent jet keeps its speed within six widths of oil above it; then its speed falls with the distance.
    """
    pool = max(y[OIL + 2], 0.0) / c.A_3
    speed = Q / c.suction / (1.0 + pool / (6.0 * c.jet_width))
    head = speed * speed / (2.0 * 9.81) / (0.5 * c.height_3)
    thrown = head * head / (head * head + 1.0) * Q_oil
    dy[OIL + 2] -= thrown
    dy[FILM] += thrown


def drain(thin: float, y: Vector, dy: Vector, c: Constants) -> None:
    """Let the oil on the walls run down: a laminar film over the reserve's height."""
    thick = max(y[FILM], 0.0) / (c.wetted * c.height_3)
    drained = c.wetted * 9.81 * thick * thick * thick / (3.0 * c.viscosity) * thin
    dy[FILM] -= drained
    dy[OIL + 2] += drained


def transfer(
    i: int, j: int, area: float, gap: float, bottom: bool, p: float, p_to: float, y: Vector, dy: Vector, c: Constants
) -> float:
    """Let oil and gas flow from chamber i at p to chamber j at p_to [Pa]; returns the dissipated power [W]."""
    warm = warmth(y[TEMPERATURE])
    oil, pocket, bubbles = shares(i, p, orifice(p - p_to, area, gap, c.rho_oil, 1.0, c), y, bottom, c)
    per_gas = p / P_0 / warm
    rho = max(c.rho_oil * oil + GAS_DENSITY * per_gas * (1.0 - oil), 0.1)
    Q = orifice(p - p_to, area, gap, rho, oil, c)
    Q_oil = Q * oil / max(1.0 - (p - P_0) / c.K_oil, 0.5)
    Q_pocket = Q * pocket * per_gas
    Q_bubbles = Q * bubbles * per_gas
    Q_dissolved = Q_oil * max(y[DISSOLVED + i], 0.0) / max(all_oil(i, y), TINY)
    # The pressure in the jet of a cavitating valve is nearly zero, so that gas is released within one pass.
    drop = (p - p_to) / (p_to * c.cavitating)
    x = drop * drop
    Q_released = c.released * x / (1.0 + x) * Q_dissolved
    dy[OIL + i] -= Q_oil
    dy[OIL + j] += Q_oil
    dy[POCKET + i] -= Q_pocket
    dy[BUBBLES + i] -= Q_bubbles
    dy[DISSOLVED + i] -= Q_dissolved
    dy[DISSOLVED + j] += Q_dissolved - Q_released
    if i == 1 and j == 2:
        throw(Q, Q_oil, y, dy, c)
    # Gas that enters below the oil level breaks into bubbles if the flow is fast; an oil jet entrains pocket gas.
    fast = Q * Q / (Q * Q + c.Q_mix * c.Q_mix)
    from_below = i != 0
    wet, dry, froth = shares(j, p_to, 0.0, y, from_below, c)
    broken = fast * (wet + froth)
    dy[BUBBLES + j] += Q_bubbles + Q_released + broken * Q_pocket
    dy[POCKET + j] += (1.0 - broken) * Q_pocket
    if not from_below:
        dragged = c.jet * fast * Q_oil * dry * p_to / P_0 / warm
        dy[BUBBLES + j] += dragged
        dy[POCKET + j] -= dragged
    # Gas has the temperature of the oil: its work of expansion becomes heat in the course of an oscillation.
    return Q * (oil * (p - p_to) + (1.0 - oil) * p * math.log(p / p_to))


def exchange(i: int, p: float, y: Vector, dy: Vector, c: Constants) -> None:
    """Henry: release above saturation, dissolution of bubbles below it; bubbles rise into the pocket."""
    saturated = c.solubility * all_oil(i, y) * p / P_0
    excess = y[DISSOLVED + i] - saturated
    if excess > 0.0:
        rate = math.log(2.0) / c.t_release * excess
    else:
        rate = math.log(2.0) / c.t_dissolve * max(y[BUBBLES + i], 0.0) * excess / (0.1 * saturated - excess + TINY)
    risen = max(y[BUBBLES + i], 0.0) / c.t_separate
    dy[DISSOLVED + i] -= rate
    dy[BUBBLES + i] += rate - risen
    dy[POCKET + i] += risen


def rates(z: float, v: float, y: Vector, dy: Vector, c: Constants) -> None:
    """Rates `dy` of the states `y` at the stroke z [m] and velocity v [m/s]."""
    for i in range(STATES):
        dy[i] = 0.0
    p_1, p_2, p_3 = pressures(z, y, c)
    warmer = min(max(y[TEMPERATURE] - 25.0, -80.0), 200.0)
    thin = math.exp(c.thinning * warmer / (1.0 + warmer / (25.0 + VOGEL)))
    gap = c.piston_gap * thin
    if p_1 > p_2:
        area = c.piston_bleed + blow_off(p_1 - p_2, c.piston_crack, c.piston_opening)
        power = transfer(0, 1, area, gap, True, p_1, p_2, y, dy, c)
    else:
        area = c.piston_bleed + blow_off(p_2 - p_1, c.check_crack, c.check_opening)
        power = transfer(1, 0, area, gap, False, p_2, p_1, y, dy, c)
    if p_2 > p_3:
        area = c.base_bleed + blow_off(p_2 - p_3, c.base_crack, c.base_opening)
        power += transfer(1, 2, area, 0.0, True, p_2, p_3, y, dy, c)
    else:
        area = c.base_bleed + c.suction * opened(p_3 - p_2, c.suction_pressure)
        power += transfer(2, 1, area, 0.0, True, p_3, p_2, y, dy, c)
    if p_1 > p_3:
        power += transfer(0, 2, c.rod_guide, c.guide_gap * thin, False, p_1, p_3, y, dy, c)
    drain(thin, y, dy, c)
    leaked = c.leak * max(v, 0.0)
    dy[OIL] -= leaked
    dy[DISSOLVED] -= leaked * y[DISSOLVED] / (all_oil(0, y) + TINY)
    exchange(0, p_1, y, dy, c)
    exchange(1, p_2, y, dy, c)
    exchange(2, p_3, y, dy, c)
    dy[BRISTLE], rubbed = friction(v, y[BRISTLE], c)
    power += abs(rubbed * v)
    dy[ENERGY] = power
    dy[TEMPERATURE] = (power - c.cooling * (y[TEMPERATURE] - c.T_ambient)) / c.heat_capacity


def segment_of(breaks: Vector, t: float) -> int:
    """The segment of a spline in which `t` lies; beyond the ends the first or last."""
    low, high = 0, len(breaks) - 1
    while high - low > 1:
        middle = (low + high) // 2
        if breaks[middle] <= t:
            low = middle
        else:
            high = middle
    return low


def right_hand_side(t: float, y: Vector, breaks: Vector, spline: Table, c: Constants, dy: Vector) -> None:
    """Rates `dy` of the states `y`, the stroke a cubic spline: `breaks` (n,), `spline` (4, n - 1), highest power first."""
    k = segment_of(breaks, t)
    x = t - breaks[k]
    a, b, d = spline[0, k], spline[1, k], spline[2, k]
    rates(((a * x + b) * x + d) * x + spline[3, k], (3.0 * a * x + 2.0 * b) * x + d, y, dy, c)


def outputs(z: Vector, v: Vector, y: Table, c: Constants, out: Table) -> None:
    """To `out` (4, n) force [N], positive in rebound, and absolute pressures p_1, p_2, p_3 [Pa]; states `y` (n, STATES)."""
    for k in range(len(z)):
        p_1, p_2, p_3 = pressures(z[k], y[k], c)
        _, rubbed = friction(v[k], y[k, BRISTLE], c)
        out[0, k] = c.A_1 * p_1 - c.A_2 * p_2 + (c.A_2 - c.A_1) * P_0 + rubbed
        out[1, k] = p_1
        out[2, k] = p_2
        out[3, k] = p_3
