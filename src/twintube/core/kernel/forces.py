"""Forces of equations 1, 2 and 36: F-v curve, friction, foam."""

import math

from twintube.core.variables import FV_POINTS, Derived, Parameters, State

# Friction [N] that is none: the force of before over a smaller one has no room in a number.
FRICTIONLESS = 1e-9
P_AMBIENT = 1e5  # [Pa]
UNREACHED = 1e9  # [m/s]: a speed that no damper reaches


def branch(v: float, velocities: tuple[float, ...], forces: tuple[float, ...]) -> float:
    """Force [N] of one branch of the F-v curve at the speed `v` >= 0 [m/s]; the last segment goes on beyond it."""
    i = 0
    while i < FV_POINTS - 1 and velocities[i] < v:
        i += 1
    if i == 0:
        return forces[0] * v / velocities[0]
    slope = (forces[i] - forces[i - 1]) / (velocities[i] - velocities[i - 1])
    return forces[i - 1] + slope * (v - velocities[i - 1])


def fluid_force(p: Parameters, v: float) -> float:
    """Friction-reduced force of the intact damper [N] at the velocity `v` [m/s]."""
    # Eq. 3: A2*p2 - A1*p1 explains this force; as in the paper the measured F-v curve stands for it.
    if v >= 0.0:
        return branch(v, p.v_re, p.F_re)
    return -branch(-v, p.v_co, p.F_co)


def stribeck(p: Parameters, v: float) -> float:
    """Scaling k_FrS [1] of the friction at the velocity `v` [m/s]; the shape of Figure 12 is assumed."""
    return p.k_high + (1.0 - p.k_high) * math.exp(-abs(v) / p.v_S)


def dahl(p: Parameters, d: Derived, F_D: float, dz: float) -> float:
    """Dahl friction force [N] after the stroke `dz` [m]: the exact solution of equation 2 over the stroke."""
    if d.F_FrS <= FRICTIONLESS:
        return 0.0
    direction = 1.0 if dz > 0.0 else -1.0
    gap = 1.0 - direction * F_D / d.F_FrS
    side = 1.0 if gap >= 0.0 else -1.0
    # Eq. 2 divided by the velocity: d|gap|/d|z| = -(sigma_0/F_FrS) |gap|^delta_D
    way = p.sigma_0 / d.F_FrS * abs(dz)
    size = abs(gap)
    if size > 0.0:
        q = 1.0 - p.delta_D
        if abs(q) < 1e-6:  # the limit, free of 0/0
            size *= math.exp(-way)
        else:
            left = math.exp(q * math.log(size)) - q * way
            size = math.exp(math.log(left) / q) if left > 0.0 else 0.0
    return direction * d.F_FrS * (1.0 - side * size)


def foam_factor(p: Parameters, oil: float, foam: float) -> float:
    """Force of a foam holding the volume `oil` in the volume `foam` [m3], relative to that of oil [1]."""
    # Eq. 36: B p^E
    if p.E == 0.0:
        return p.B
    if oil <= 0.0:
        return 0.0
    return p.B * math.exp(p.E * math.log(oil / foam))


def share_above(v0: float, v1: float, threshold: float) -> float:
    """Share [1] of a step during which the speed exceeds `threshold`, the speed going from |v0| to |v1| evenly."""
    a = abs(v0)
    b = abs(v1)
    if a > threshold and b > threshold:
        return 1.0
    if a <= threshold and b <= threshold:
        return 0.0
    return (max(a, b) - threshold) / abs(a - b)


def filling_speed(p: Parameters, d: Derived) -> float:
    """Speed [m/s] of compression up to which oil follows the piston into V1; UNREACHED where it does at any speed.

    Above the foot valve the oil has the pressure of the reserve and that of the foot valve, which acts on the rod and makes
    the share `foot_valve` of the force. The piston valve takes the rest of the force, on A_1. V1 is full while something is
    left.
    """
    taken = (1.0 - p.foot_valve) / d.A_1 - p.foot_valve / d.A_rod
    if taken <= 0.0:
        return UNREACHED
    most = (P_AMBIENT + d.F_0 / d.A_rod) / taken
    i = 0
    while i < FV_POINTS - 1 and p.F_co[i] < most:
        i += 1
    below = 0.0
    slower = 0.0
    if i > 0:
        below = p.F_co[i - 1]
        slower = p.v_co[i - 1]
    if p.F_co[i] <= below:
        return UNREACHED
    return slower + (most - below) * (p.v_co[i] - slower) / (p.F_co[i] - below)


def filling_share(d: Derived, v0: float, v1: float) -> float:
    """What can follow into V1 over what it takes [1], in a step whose speed goes from |v0| to |v1| evenly."""
    return d.v_fill / max(0.5 * (abs(v0) + abs(v1)), 1.0 / UNREACHED)


def gas_rise(p: Parameters, F_0: float, c_gas: float, z: float) -> float:
    """Gas force [N] at the stroke `z` [m] beyond `F_0` [N], that at stroke 0, where `c_gas` [N/m] is the stiffness.

    Beyond the paper, with `polytropic`: at stroke 0 the gas has the absolute pressure P_AMBIENT + F_0/A_rod and the volume
    that makes `c_gas` its stiffness when it is compressed slowly. Beyond the maximum stroke, where a damper has stops and
    the gas may have no room left, the force goes on along its tangent.
    """
    rise = c_gas * z
    if p.polytropic > 0:
        whole = F_0 + P_AMBIENT * 0.25 * math.pi * p.D_PR * p.D_PR
        inside = max(z, -p.stroke_max)
        volume = 1.0 + c_gas * inside / whole
        pressure = math.exp(-p.n_gas * math.log(volume))
        rise = whole * (1.0 - pressure) + p.n_gas * c_gas * pressure / volume * (z - inside)
    return rise


def gas_force(p: Parameters, d: Derived, s: State, z: float) -> float:
    """Gas force [N] at the stroke `z` [m]; beyond the paper, the absolute pressure goes with the temperature."""
    return s.k_T_gas * (gas_rise(p, d.F_0, d.c_gas, z) - d.F_0) - (s.k_T_gas - 1.0) * P_AMBIENT * d.A_rod


def set_forces(p: Parameters, d: Derived, s: State, F_potential: float, v: float) -> None:
    """The three forces of equation 1 at the state `s`; `F_potential` is the intact fluid force [N] at `v` [m/s].

    Each goes with the temperature (`temperature.py`); its factors are 1 where the parameters hold.
    """
    # Eq. 1: F_SA = F_S + F_Fr + F_Fl k_degr; the paper's F_S is a slope; F_0 at stroke 0 is added here
    s.F_gas = gas_force(p, d, s, s.z)
    s.F_friction = s.k_T_Fr * stribeck(p, v) * s.F_D
    s.F_fluid = F_potential * s.k_degr
