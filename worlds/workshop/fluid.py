"""Causes in the fluid force: heat, oil columns, late valves, smooth steps, wear; each acts upon a run after its march."""

from bisect import bisect_right
from collections.abc import Callable

import numpy as np

from twintube.common.arrays import Array
from worlds.bench.valves import curve
from worlds.model.run import Run

Acts = Callable[[Run], None]
LAMINAR, BEND = 0.35, 0.3  # laminar share of the pressure drop at small speeds, and [m/s] where it has halved
FEWEST, SHORTEST = 4, 1e-4  # samples and way [m] of a stroke in which a rise is spread


def viscosity(kelvin: Array | float) -> Array:
    """Viscosity of damper oil over that at 20 degC, `kelvin` above it: Vogel's law, ISO VG 15 or so (Dixon, "Fluids")."""
    return np.asarray(np.exp(800.0 / (20.0 + np.asarray(kelvin, dtype=float) + 110.0) - 800.0 / 130.0))


def warm_factor(v: Array, kelvin: Array | float) -> Array:
    """Fluid force over that at 20 degC: pressure drop a mu Q + b rho Q^2 (Dixon, "Valve design"; Lang 1977).

    The density falls by 0.07 % per kelvin.
    """
    share = LAMINAR / (1.0 + np.abs(v) / BEND)
    return np.asarray(share * viscosity(kelvin) + (1.0 - share) * (1.0 - 7e-4 * np.asarray(kelvin, dtype=float)))


def warmed(run: Run, kelvin: Array | float) -> None:
    """Fluid by viscosity and density, gas pressure by absolute temperature (Gay-Lussac)."""
    run.times("fluid", warm_factor(run.parts["velocity"], kelvin))
    if run.record.preload:
        run.times("gas", 1.0 + np.asarray(kelvin) / 293.0)


def heating(capacity: float, cooling: float) -> Acts:
    """The oil takes up the damper's work: C dT/dt = F v - C (T - T0)/tau (lumped; Dixon, "Temperature"), also in pauses."""
    now, last = 0.0, 0.0  # [K], and the end of the record before [s]

    def act(run: Run) -> None:
        nonlocal now, last
        time, v, size = run.time, run.parts["velocity"], 20
        now *= float(np.exp(-(run.record.began - last) / cooling))
        warm = np.zeros(len(v))
        for i in range(0, len(v), size):
            part = slice(i, min(len(v), i + size))
            fluid = run.parts["fluid"][part] * warm_factor(v[part], now)
            power = float(np.mean((fluid + run.parts["friction"][part]) * v[part]))
            warm[part] = now
            now += (time[min(part.stop, len(v) - 1)] - time[i]) * (power / capacity - now / cooling)
        warmed(run, warm)
        last = run.record.began + float(time[-1])

    return act


def oil_column(run: Run, stiffness: float) -> None:
    """Maxwell element: oil with air, K [N/m], in series with valves; dF/dt = K (v - v_valve(F)) (Duym 2000), implicit."""
    p, v = run.damper.parameters, run.parts["velocity"]
    knots = np.array(sorted({-50.0, 0.0, 50.0, *(x for x in p.v_re if x > 0), *(-x for x in p.v_co if x > 0)}))
    forces, grid = curve(run.damper, knots).tolist(), knots.tolist()
    gains = (stiffness * np.diff(run.time, prepend=run.time[0] - (run.time[1] - run.time[0]))).tolist()
    f, out = 0.0, np.empty(len(v))
    for i, (speed, k, gain) in enumerate(zip(v.tolist(), run.parts["k_degr"].tolist(), gains, strict=True)):
        goal = f + gain * speed
        sums = [k * y + gain * w for w, y in zip(grid, forces, strict=True)]
        j = min(max(bisect_right(sums, goal) - 1, 0), len(grid) - 2)
        share = (goal - sums[j]) / (sums[j + 1] - sums[j])
        f = k * (forces[j] + share * (forces[j + 1] - forces[j]))
        out[i] = f
    run.parts["fluid"] = out


def late_check_valves(run: Run, stroke: float) -> None:
    """After each reversal the plates of the check valves need a stroke [m] to close; until then they leak in proportion."""
    way = run.since_reversal + np.abs(run.parts["velocity"]) * 0.5 * np.gradient(run.time)
    run.times("fluid", np.minimum(1.0, way / max(stroke, 1e-12)))


def mixing_length(run: Run, length: float) -> None:
    """A rise of the degradation factor within a stroke is followed over a length [m], dk/ds = (k_goal - k)/L; falls at once.

    At a reversal the other valve starts afresh.
    """
    z = run.parts["stroke"]
    shares = (1.0 - np.exp(-np.abs(np.diff(z, prepend=z[0])) / max(length, 1e-15))).tolist()
    goals, sides = run.parts["k_degr"].tolist(), np.sign(run.parts["velocity"]).tolist()
    k, side, out = goals[0], 0.0, np.empty(len(z))
    for i, (goal, share, s) in enumerate(zip(goals, shares, sides, strict=True)):
        k = goal if s != side or goal <= k else k + share * (goal - k)
        side = s
        out[i] = k
    run.parts["fluid"] = run.intact_fluid * out


def tilted_surface(run: Run, height: float) -> None:
    """The oil's surface is not flat and reaches the piston over a height [m]: each rise is spread about its place.

    Within each half stroke the factor is the mean over the height around its place, where that is a rise.
    """
    z, side, k = run.parts["stroke"], np.sign(run.parts["velocity"]), run.parts["k_degr"].copy()
    for part in np.split(np.arange(len(side)), np.flatnonzero(np.diff(side) != 0) + 1):
        s, own = np.abs(z[part] - z[part[0]]), k[part]
        rising = np.maximum.accumulate(own)
        if len(part) < FEWEST or side[part[0]] == 0 or rising[-1] <= rising[0] or np.ptp(s) < SHORTEST:
            continue
        total = np.append(0.0, np.cumsum(0.5 * (rising[1:] + rising[:-1]) * np.diff(s)))
        low, high = s - 0.5 * height, s + 0.5 * height
        mean = (area(high, s, total, rising) - area(low, s, total, rising)) / height
        k[part] = np.maximum(mean - (rising - own), 0.0)  # falls stay where they are
    run.parts["fluid"] = run.intact_fluid * k


def area(at: Array, s: Array, total: Array, k: Array) -> Array:
    """Integral of the factor up to `at`, the factor held beyond both ends."""
    return np.asarray(np.interp(at, s, total) + k[0] * np.minimum(at - s[0], 0.0) + k[-1] * np.maximum(at - s[-1], 0.0))


def worn_scale(run: Run, rebound: float, compression: float) -> None:
    """Weak springs and discs: the fluid force times a factor in each direction (Reimpell: wear of 5 to 35 %)."""
    run.times("fluid", np.where(run.parts["velocity"] >= 0, 1.0 - rebound, 1.0 - compression))


def worn_bleed(run: Run, rebound: float, compression: float) -> None:
    """A worn seat leaks beside the valve: v = v_valve(F) + b sqrt(F / 1000 N), b [m/s] (orifice; Dixon, "Valve design")."""
    v, speed = run.parts["velocity"], np.concatenate([np.linspace(0.0, 0.2, 801), np.linspace(0.2, 6.0, 2000)[1:]])
    for side, b in ((1.0, rebound), (-1.0, compression)):
        force = np.abs(curve(run.damper, side * speed))
        worn = np.interp(np.abs(v), speed + b * np.sqrt(force / 1000.0), force)
        ratio = np.minimum(worn / np.maximum(np.interp(np.abs(v), speed, force), 1e-9), 1.0)
        run.times("fluid", np.where((side * v > 0) & (b > 0), ratio, 1.0))
