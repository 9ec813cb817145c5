"""A twin-tube damper integrated in small fixed steps: phase volumes that are clipped at 0.

The gas of a working chamber is the volume without oil and foam. Flows of oil and foam are limited by the source volume and
by the free volume at the destination. Without hidden physics this is the paper's model; `Hidden` adds further physics. All
compiled functions are in this file, because numba's cache does not detect a change in another file.
"""

import math
from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba

from worlds.blind_trials.quantities import Array, Hidden, Tube

F = TypeVar("F", bound=Callable[..., Any])

P_ATM = 1e5  # [Pa]
TINY = 1e-14  # [m3] smaller volumes are rounding errors

# State: free oil, foam, oil held by the foam and the fast-draining part of the foam [m3], each in the rebound chamber, the
# compression chamber and the reserve; oil freed as gas, returned, leaked [m3]; friction [N]; oil temperature [K]; piston
# stroke [m] and velocity [m/s]; valve forces of compliant chambers [N]; structural mode [N, N/s]; travel since the gas of a
# working chamber was consumed, negative: depth of the remaining gas [m].
O1, FOAM, HELD, FAST = 0, 3, 6, 9
O2, O3 = O1 + 1, O1 + 2
F1, F2, F3 = FOAM, FOAM + 1, FOAM + 2
CAV, RETURNED, LEAKED, DAHL, TEMPERATURE, PISTON, PISTON_V, P_RE, P_CO, MODE, MODE_V, D1, D2, STATES = range(12, 26)
# Columns of a run: measured force [N], k_degr [1], oil free and in foam [m3], freed gas not returned [m3], leaked [m3],
# temperature [K], foam [m3], stroke of the piston [m], mean force since the previous row [N].
FORCE, K_DEGR, OIL, FREED, LOST, WARM, FOAMED, PLACE, CELL, COLUMNS = range(10)


def compiled(function: F) -> F:
    """Compile with numba; for type checkers the signature is unchanged."""
    return cast(F, numba.njit(cache=True, error_model="numpy", nogil=True)(function))


@compiled
def motion(pieces: Array, i: int, t: float) -> tuple[float, float]:
    """Stroke [m] and velocity [m/s] at t [s] in piece i: from, to, omega, amplitude, ramp, stroke at its begin, slope.

    A sine starts and ends with a ramp of `ramp` seconds, in which the rate of its phase rises and falls smoothly.
    """
    begin, end, omega, amplitude, ramp, z, slope = pieces[i]
    if omega == 0.0:
        return z + slope * (t - begin), slope
    since, remaining = t - begin, end - t
    if since < ramp:
        x = since / ramp
        phase, speed = ramp * x**3 * (1.0 - 0.5 * x), x * x * (3.0 - 2.0 * x)
    elif remaining < ramp:
        x = remaining / ramp
        phase, speed = end - begin - ramp - ramp * x**3 * (1.0 - 0.5 * x), x * x * (3.0 - 2.0 * x)
    else:
        phase, speed = since - 0.5 * ramp, 1.0
    return z + amplitude * math.sin(omega * phase), amplitude * omega * speed * math.cos(omega * phase)


@compiled
def sample(pieces: Array, times: Array, z: Array, v: Array) -> None:
    """Stroke [m] and velocity [m/s] at the rising `times` (n,) [s]."""
    piece = 0
    for row in range(len(times)):
        while piece < len(pieces) - 1 and pieces[piece, 1] <= times[row]:
            piece += 1
        z[row], v[row] = motion(pieces, piece, times[row])


@compiled
def curve(u: float, v: Array, f: Array) -> float:
    """Force [N] of one branch at the speed u >= 0 [m/s]; the last segment is extrapolated."""
    if u <= v[0]:
        return float(f[0] * u / v[0])
    i = 1
    while i < len(v) - 1 and v[i] < u:
        i += 1
    return float(f[i] - (f[i] - f[i - 1]) * (v[i] - u) / (v[i] - v[i - 1]))


@compiled
def steepness(c: Tube, v: float) -> float:
    """Slope of the F-v curve [N s/m] at the velocity v [m/s]."""
    u = abs(v)
    if v >= 0.0:
        return (curve(u + 5e-3, c.v_re, c.F_re) - curve(u, c.v_re, c.F_re)) / 5e-3
    return (curve(u + 5e-3, c.v_co, c.F_co) - curve(u, c.v_co, c.F_co)) / 5e-3


@compiled
def squeezed(speed: float, before: float, give: float, scale: float, v: Array, f: Array) -> float:
    """Valve force [N] of a compliant chamber at the end of a step: u + give (scale f(u) - before) = speed, for u >= 0.

    `give` [m/(s N)] is the chamber's compliance over the step; f is piecewise linear, so that u is exact in its segment.
    """
    if speed + give * before <= 0.0:
        return 0.0
    u0, f0 = 0.0, 0.0
    for i in range(len(v)):
        last = i == len(v) - 1
        if last or v[i] + give * (scale * f[i] - before) >= speed:
            slope = (f[i] - f0) / (v[i] - u0)
            u = (speed + give * (before - scale * (f0 - slope * u0))) / (1.0 + give * scale * slope)
            return float(scale * (f0 + slope * (u - u0)))
        u0, f0 = v[i], f[i]
    return 0.0


@compiled
def foam_force(c: Tube, y: Array, i: int) -> float:
    """Force of the foam of chamber i relative to that of oil [1]: B p^E."""
    if y[FOAM + i] <= 0.0:
        return 1.0
    return c.B * math.pow(max(y[HELD + i], 0.0) / y[FOAM + i], c.E)


@compiled
def carry(y: Array, i: int, j: int, foam: float) -> None:
    """Move foam [m3] with its oil and its fast class from chamber i to j; with j = -1 the caller moves the oil."""
    if foam <= 0.0:
        return
    share = min(foam / y[FOAM + i], 1.0)
    for state in (FOAM, HELD, FAST):
        moved = share * y[state + i]
        y[state + i] -= moved
        if j >= 0:
            y[state + j] += moved


@compiled
def froth(y: Array, i: int, gas: float, ratio: float, c: Tube) -> None:
    """Form foam of gas [m3] and `ratio` [1] times as much oil of chamber i, limited by the oil."""
    drawn = ratio * gas
    if drawn > y[O1 + i]:
        gas *= y[O1 + i] / drawn
        drawn = y[O1 + i]
    y[O1 + i] -= drawn
    y[FOAM + i] += gas + drawn
    y[HELD + i] += drawn
    y[FAST + i] += c.fast_share * (gas + drawn)


@compiled
def blend(low: float, high: float, depth: float, width: float) -> float:
    """Transition from `low` to `high` at the depth 0 [m], over `width` [m]; a step if the width is 0."""
    if width <= 0.0:
        return low if depth < 0.0 else high
    return low + (high - low) * 0.5 * (1.0 + math.tanh(depth / width))


@compiled
def force_of(base: float, foam: float, oil: float, liquid: float, c: Tube, y: Array, i: int, phi: float) -> float:
    """k_degr of a liquid flow [m3] of foam and oil from chamber i; the rest of the flow is gas."""
    if liquid > 0.0:
        return base * (foam * phi + oil) / liquid
    if foam > 0.0 or y[FOAM + i] > 0.0:
        return base * phi
    return base if y[O1 + i] > 0.0 else 0.0


@compiled
def freed(c: Tube, h: Hidden, y: Array, gas: float) -> float:
    """Record the gas [m3] that a valve would free; returns the oil [m3] that does not arrive downstream.

    With `scarce` the released gas decreases with the gas that is already free. With `give_way` a share of the displaced oil
    stays in the reserve, as far as it fits, because the rod draws less from it or the foot valve passes more.
    """
    if h.scarce > 0.0:
        gas *= max(1.0 - h.scarce * (y[CAV] - y[RETURNED]) / c.oil, 0.0)
    if h.give_way > 0.0:
        displaced = min(h.give_way * gas, max(c.V_res - y[O3] - y[F3], 0.0))
        y[O3] += displaced
        missing = (1.0 - h.give_way) * gas
        y[CAV] += missing
        return float(displaced + missing)
    y[CAV] += gas
    return gas


@compiled
def rebound(c: Tube, h: Hidden, y: Array, z: float, dz: float, speed: float) -> float:
    """Move the phases from the stroke z [m] outwards by dz > 0; returns k_degr."""
    want = c.A_1 * dz
    gas = c.A_1 * (c.half - z) - y[O1] - y[F1]
    mixed = gas > TINY
    y[D1] = -gas / c.A_1 if mixed else max(y[D1], 0.0) + dz
    liquid = want - min(gas, (1.0 - c.W_PV) * want) if mixed else want
    phi = foam_force(c, y, 0)
    foam = min(y[F1], liquid)
    oil = min(y[O1], liquid - foam)
    k = force_of(blend(c.X_Re, 1.0, y[D1], h.blend), foam, oil, liquid, c, y, 0, phi)
    y[O1] -= oil
    lost = freed(c, h, y, c.Y_Re * oil) if speed > c.v_cav else 0.0
    y[O2] += oil - lost
    if y[O1] > 0.0 and foam > 0.0:  # together with oil the foam separates in the valve
        y[O2] += y[HELD] * min(foam / y[F1], 1.0)
        carry(y, 0, -1, foam)
    else:
        carry(y, 0, 1, foam)
    need = c.A_rod * dz
    oil = min(y[O3], need)
    y[O3] -= oil
    y[O2] += oil
    foam = min(y[F3], need - oil)
    carry(y, 2, 1, foam)
    need -= oil + foam
    if need > 0.0 and speed > c.v_foam and y[O2] > 0.0:
        froth(y, 1, c.S_BV * need, c.S_BVoil, c)
    return k


@compiled
def compression(c: Tube, h: Hidden, y: Array, z: float, dz: float, speed: float) -> float:
    """Move the phases from the stroke z [m] inwards by dz > 0; returns k_degr."""
    want = c.A_2 * dz
    gas = c.A_2 * (c.half + z) - y[O2] - y[F2]
    room = c.A_1 * (c.half - z + dz) - y[O1] - y[F1]
    grown = c.A_1 * dz
    mixed = gas > TINY
    y[D2] = -gas / c.A_2 if mixed else max(y[D2], 0.0) + dz
    surplus = (1.0 - c.W_BV2) * want - grown  # flow of the piston valve beyond the volume that opens
    if mixed:
        bottom = c.W_BV1 * want if y[O2] + y[F2] > 0.0 else 0.0
        out = min(gas, want - bottom)
        vents = 1.0 if room - grown > TINY else 0.0
    else:
        bottom, out = c.W_BV2 * want, 0.0
        vents = min(max((room - grown) / surplus, 0.0), 1.0) if surplus > 0.0 else 0.0
    piston = min(want - bottom - out, max(room, 0.0))
    bottom = want - out - piston
    liquid = bottom + piston
    phi = foam_force(c, y, 1)
    foam = min(y[F2], liquid)
    oil = min(y[O2], liquid - foam)
    full = 1.0 + vents * (c.k_Co2 - 1.0)
    k = force_of(blend(c.X_Co1, full, y[D2], h.blend), foam, oil, liquid, c, y, 1, phi)
    up = piston / liquid if liquid > 0.0 else 0.0
    carry(y, 1, 0, up * foam)
    carry(y, 1, 2, min((1.0 - up) * foam, y[F2]))
    y[O2] -= oil
    lost = freed(c, h, y, c.Y_Co * up * oil) if speed > c.v_cav else 0.0
    y[O1] += up * oil - lost
    y[O3] += (1.0 - up) * oil
    if out > 0.0 and speed > c.v_foam and y[O1] > 0.0:
        froth(y, 0, min(c.S_PV * out, max(c.A_1 * (c.half - z + dz) - y[O1] - y[F1], 0.0)), c.S_PVoil, c)
    if y[F3] > c.V_res - y[O3]:  # foam beyond the volume of the reserve loses gas
        remaining = max(c.V_res - y[O3], y[HELD + 2])
        y[FAST + 2] *= remaining / y[F3]
        y[F3] = remaining
    return k


@compiled
def ageing(c: Tube, h: Hidden, y: Array, z: float, v: float, dt: float) -> None:
    """Changes of the phases with time: foam drains, freed gas dissolves, the film on the rod carries oil out."""
    if h.drain_fast > 0.0:
        for i in range(3):
            if y[FOAM + i] > 0.0:
                fast_drained = y[FAST + i] * h.drain_fast * dt
                drained = min(fast_drained + (y[FOAM + i] - y[FAST + i]) * h.drain_slow * dt, y[FOAM + i])
                oil = y[HELD + i] * drained / y[FOAM + i]
                y[FAST + i] -= fast_drained
                y[FOAM + i] -= drained
                y[HELD + i] -= oil
                y[O1 + i] += oil
    if h.dissolve > 0.0:
        free = y[CAV] - y[RETURNED]
        oil = y[O1] + y[O2] + y[O3]
        for i in range(3):
            volume = c.A_1 * (c.half - z) if i == 0 else c.A_2 * (c.half + z) if i == 1 else c.V_res
            gas = max(volume - y[O1 + i] - y[FOAM + i], 0.0)
            back = min(h.dissolve * dt * free * y[O1 + i] / max(oil, TINY), gas)
            y[O1 + i] += back
            y[RETURNED] += back
    if h.leak > 0.0:
        leaving = h.leak * math.sqrt(abs(v)) * dt
        for i in (2, 1, 0):  # the rod guide drains into the reserve; the pressurised V1 passes its loss on to V2
            taken_out = min(y[O1 + i], leaving)
            y[O1 + i] -= taken_out
            y[LEAKED] += taken_out
            leaving -= taken_out


@compiled
def friction(c: Tube, h: Hidden, y: Array, dz: float, v: float) -> float:
    """Friction [N] after the stroke dz [m]: Dahl's equation by the midpoint rule, and the friction of a side load."""
    if c.F_sat > 0.0 and dz != 0.0:
        steps = int(abs(dz) * c.sigma / c.F_sat * 4.0) + 1
        step, sign = dz / steps, 1.0 if dz > 0.0 else -1.0
        for _ in range(steps):
            gap = 1.0 - sign * y[DAHL] / c.F_sat
            middle = y[DAHL] + 0.5 * step * c.sigma * math.copysign(abs(gap) ** c.delta, gap)
            gap = 1.0 - sign * middle / c.F_sat
            y[DAHL] += step * c.sigma * math.copysign(abs(gap) ** c.delta, gap)
    scale = c.k_high + (1.0 - c.k_high) * math.exp(-abs(v) / c.v_S)
    side = h.side * math.tanh(v / h.side_v) if h.side > 0.0 else 0.0
    if h.lever > 0.0:
        # The reactions at guide and piston are the side force times (overhang + span) / span and overhang / span.
        z = y[PISTON]
        pressed = 1.0 + 2.0 * (h.overhang + z) / (h.span - z)
        scale *= 1.0 + h.lever * (pressed / (1.0 + 2.0 * h.overhang / h.span) - 1.0)
    return float(scale * y[DAHL] + side)


@compiled
def thinned(h: Hidden, T: float) -> float:
    """Fluid force at T [K] relative to 25 degC [1]: Vogel's law of a damper oil, 15 mm2/s at 40 and 4 at 100 degC."""
    return math.exp(h.thinning * 800.0 * (1.0 / (T - 150.0) - 1.0 / (298.15 - 150.0)))


@compiled
def fluid(c: Tube, h: Hidden, y: Array, k: float, v: float, dt: float) -> float:
    """Fluid force [N] with worn valves, warm oil and, for compressible oil, the pressure built up so far."""
    out = thinned(h, y[TEMPERATURE]) if h.thinning > 0.0 else 1.0
    into = out
    if h.wear_re != 0.0:
        fast = 1.0 - math.exp(-abs(v) / h.wear_v)
        out *= 1.0 + h.wear_re_slow + (h.wear_re - h.wear_re_slow) * fast
        into *= 1.0 + h.wear_co_slow + (h.wear_co - h.wear_co_slow) * fast
    if h.give <= 0.0:
        return k * out * curve(v, c.v_re, c.F_re) if v >= 0.0 else -k * into * curve(-v, c.v_co, c.F_co)
    # The rebound force acts on the annulus, the compression force on the rod's area and the oil of both chambers.
    V_1, V_2 = c.A_1 * (c.half - y[PISTON]), c.A_2 * (c.half + y[PISTON])
    for p, area, volume in ((P_RE, c.A_1, V_1), (P_CO, c.A_rod, V_1 + V_2)):
        pressure = c.p_fill + y[p] / area
        soft = volume / (area * area) * (h.give + h.air * P_ATM / (pressure * pressure)) / dt
        if p == P_RE:
            y[p] = squeezed(v, y[p], soft, out * (k if v > 0.0 else 1.0), c.v_re, c.F_re)
        else:
            y[p] = squeezed(-v, y[p], soft, into * (k if v < 0.0 else 1.0), c.v_co, c.F_co)
    return float(y[P_RE] - y[P_CO])


@compiled
def springs(c: Tube, h: Hidden, y: Array, z: float, v: float) -> float:
    """Gas force and rubber stops [N] at the stroke z [m]."""
    total = c.c_gas * z - c.F_0
    if h.residual > 0.0:
        # Oil lost since the start is neglected; the rod changes the gas volume.
        space = c.A_1 * c.half + c.A_2 * c.half + c.V_res - c.oil
        total -= c.A_rod * ((P_ATM + h.residual) * math.pow(space / (space + c.A_rod * z), h.polytropic) - P_ATM)
    for stop, deep, speed, sign in ((h.stop_out, z - h.stop_at, v, 1.0), (h.stop_in, -z - h.stop_at, -v, -1.0)):
        if stop > 0.0 and deep > 0.0:
            total += sign * stop * (math.exp(deep / h.stop_scale) - 1.0) * (1.0 + h.stop_loss * math.tanh(speed / 0.02))
    return total


@compiled
def advance(c: Tube, h: Hidden, y: Array, z: float, v: float, dt: float) -> tuple[float, float]:
    """Move the piston to the stroke z [m]; returns its force [N] and k_degr."""
    before = y[PISTON]
    dz = z - before
    k = 1.0
    if dz > 0.0:
        k = rebound(c, h, y, before, dz, abs(v))
    elif dz < 0.0:
        k = compression(c, h, y, before, -dz, abs(v))
    y[PISTON] = z
    ageing(c, h, y, z, v, dt)
    F_fluid = fluid(c, h, y, k, v, dt)
    F_friction = friction(c, h, y, dz, v)
    if h.warming > 0.0:
        heat = (F_fluid + F_friction) * v
        y[TEMPERATURE] += dt * (h.warming * heat - h.cooling * (y[TEMPERATURE] - h.start))
    return F_fluid + F_friction + springs(c, h, y, z, v), k


@compiled
def begin(c: Tube, h: Hidden, y: Array, z: float) -> None:
    """At rest at the stroke z [m]: the oil fills the compression chamber, then the rebound chamber, then the reserve."""
    y[:] = 0.0
    y[O2] = min(c.oil, c.A_2 * (c.half + z))
    y[O1] = min(c.oil - y[O2], c.A_1 * (c.half - z))
    y[O3] = c.oil - y[O1] - y[O2]
    y[TEMPERATURE], y[PISTON], y[D1], y[D2] = h.start, z, 1.0, 1.0


@compiled
def run(  # noqa: PLR0915 - one step after the other, compiled by numba
    c: Tube, h: Hidden, pieces: Array, times: Array, y: Array, dz: float, dt: float, out: Array
) -> None:
    """Integrate over the excitation and write the columns at the `times` (n,) [s] to `out` (n, COLUMNS).

    A step is at most `dz` [m] of stroke and `dt` [s].
    """
    piece, t = 0, pieces[0, 0]
    z, v = motion(pieces, 0, t)
    begin(c, h, y, z)
    total, k = advance(c, h, y, z, v, dt)
    load = total
    for row in range(len(times)):
        span = times[row] - t
        while piece < len(pieces) - 1 and pieces[piece, 1] <= times[row]:
            piece += 1
        v_end = motion(pieces, piece, times[row])[1]
        steps = max(int(max(abs(v), abs(v_end)) * span / dz), int(span / dt)) + 1
        tau = span / steps
        current, acting, travel, impulse = piece, 0.0, 0.0, 0.0
        while current > 0 and pieces[current, 0] > t:
            current -= 1
        for i in range(steps if span > 0.0 else 0):
            end_time, last = t + (i + 1) * tau, y[PISTON]
            while current < piece and pieces[current, 1] <= end_time:
                current += 1
            z, v = motion(pieces, current, end_time)
            if h.mount > 0.0:
                # Implicit in the mount, which may be stiff, and linearly implicit in the valves.
                bent = z - y[PISTON]
                stiff = h.mount * (1.0 + h.hardening * bent * bent)
                pull = stiff * bent + h.rubber * v
                drag = h.rubber + stiff * tau
                slope = k * steepness(c, y[PISTON_V])
                rate = tau / h.mass
                y[PISTON_V] = (y[PISTON_V] * (1.0 + rate * slope) + rate * (pull - total)) / (1.0 + rate * (drag + slope))
                load = pull - drag * y[PISTON_V]
                total, k = advance(c, h, y, y[PISTON] + tau * y[PISTON_V], y[PISTON_V], tau)
            elif h.play > 0.0:
                place = min(max(y[PISTON], z - 0.5 * h.play), z + 0.5 * h.play)
                load, k = advance(c, h, y, place, v if place != y[PISTON] else 0.0, tau)
                total = load if place != z and v * (z - place) > 0.0 and abs(z - place) > 0.499 * h.play else 0.0
            else:
                total, k = advance(c, h, y, z, v, tau)
            acting += k * abs(y[PISTON] - last)
            travel += abs(y[PISTON] - last)
            if h.mode > 0.0:
                y[MODE_V] += tau * (h.mode * h.mode * (total - y[MODE]) - 2.0 * h.mode_loss * h.mode * y[MODE_V])
                y[MODE] += tau * y[MODE_V]
            cell_force = load if h.mount > 0.0 else total
            impulse += tau * (cell_force + h.mode_share * (y[MODE] - cell_force))
        t = times[row]
        force = load if h.mount > 0.0 else total
        if travel > 0.0 and h.mount + h.give + h.play <= 0.0:
            # A load cell's filter averages changes within a sample; compliant springs smooth them anyway.
            force += fluid(c, h, y, acting / travel - k, v, tau)
            k = acting / travel
        out[row, FORCE] = force + h.mode_share * (y[MODE] - force)
        out[row, K_DEGR] = k
        out[row, OIL] = y[O1] + y[O2] + y[O3] + y[HELD] + y[HELD + 1] + y[HELD + 2]
        out[row, FREED] = y[CAV] - y[RETURNED]
        out[row, LOST] = y[LEAKED]
        out[row, WARM] = y[TEMPERATURE]
        out[row, FOAMED] = y[F1] + y[F2] + y[F3]
        out[row, PLACE] = y[PISTON]
        out[row, CELL] = impulse / span if span > 0.0 else out[row, FORCE]
