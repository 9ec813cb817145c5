"""Hidden causes in the fluid force: heat, compressibility, smooth steps, worn valves.

Sources: Dixon, The Shock Absorber Handbook (heat: 0.2 to 2 % of the force per kelvin; valves); Walther's viscosity law as
in DIN 51563; bulk modulus of oil with air bubbles from the sum of compliances (Merritt); Duym 2000 and Segel, Lang 1981
for the hysteresis at high frequency; Hryciow 2022 for the fall of the work with heat.
"""

import math
from typing import Any

import numpy as np

from twintube.common.arrays import Array
from worlds.bench.plan import chance, with_numba
from worlds.bench.valves import curve
from worlds.model.run import Constants, Run, derived_of

ATMOSPHERE = 1.013e5  # [Pa]
HOTTEST = 150.0  # [degC]
ROOM = 23.0  # [degC] at which the parameter sets hold
KELVIN = 273.15
OIL_HEAT = 0.87 * 1.9e6  # [J/(m3 K)]
FEWEST, SHORTEST = 8, 1e-5  # samples and way [m] of a stroke in which a step is smoothed


def warmed(time: Array, power: Array, *, oil: float, body: float, inner: float, outer: float, start: float) -> Array:
    """Temperatures [degC] (n, 2) of oil and body with heat capacities [J/K] and conductances [W/K], room at ROOM."""
    out = np.empty((len(time), 2))
    oil_T, body_T = start, start
    for i in range(len(time)):
        if i > 0:
            left = time[i] - time[i - 1]
            while left > 0.0:
                dt = min(left, 0.5)
                flow = inner * (oil_T - body_T)
                oil_T += dt * (power[i] - flow) / oil
                body_T += dt * (flow - outer * (body_T - 23.0)) / body
                left -= dt
        out[i, 0] = oil_T
        out[i, 1] = body_T
    return out


def temperatures(run: Run, c: Constants) -> Array:
    """Oil and body [degC], (n, 2), of a run that heats itself."""
    power = np.abs((run.parts["fluid"] + run.parts["friction"]) * run.parts["velocity"])
    capacity = OIL_HEAT * run.damper.parameters.V_oil * max(run.record.level, 0.1)
    arguments = (run.time, power, capacity, c["body"], c["inner"], c["outer"], run.record.temperature)
    return np.asarray(with_numba(warmed)(*arguments))


def acting(run: Run, x: float, c: Constants) -> Array:
    """Oil temperature [degC] (n,) that the viscosity follows: `x` of the way from ROOM."""
    oil: Array = temperatures(run, c)[:, 0]
    followed: Array = np.minimum(ROOM + x * (oil - ROOM), HOTTEST)
    return followed


def heat_constants(rng: np.random.Generator) -> dict[str, Any]:
    """Capacity of the tubes [J/K], conductances [W/K], viscosities [mm2/s] at 40 and 100 degC, and how laminar it flows."""
    return {
        "body": rng.uniform(500, 1100), "inner": rng.uniform(20, 80), "outer": rng.uniform(2, 10),
        "nu_40": rng.uniform(10, 18), "nu_100": rng.uniform(3, 5), "v_turbulent": rng.uniform(0.1, 0.5),
        "fade": rng.uniform(0.002, 0.008), "gas_share": 1.0, "friction_fade": rng.uniform(0.003, 0.01),
    }  # fmt: skip


def walther(T: Array, nu_40: float, nu_100: float) -> Array:
    """Kinematic viscosity [mm2/s] at `T` [degC]: log log (nu + 0.7) falls linearly with log T."""
    ends = [math.log10(math.log10(nu + 0.7)) for nu in (nu_40, nu_100)]
    logs = [math.log10(t + KELVIN) for t in (40.0, 100.0)]
    slope = (ends[1] - ends[0]) / (logs[1] - logs[0])
    nu: Array = 10.0 ** (10.0 ** (ends[0] + slope * (np.log10(T + KELVIN) - logs[0]))) - 0.7
    return nu


def laminar_fade(run: Run, x: float, c: Constants) -> None:
    """Walther's viscosity on the laminar share of the drop, the density on the rest."""
    thinned(run, acting(run, x, c), c)


def warm(run: Run, x: float, c: Constants) -> None:
    """The damper was `x` [K] warmer than the room all the time; the gas presses by its absolute temperature."""
    thinned(run, np.full(len(run.time), ROOM + x), c)
    if run.record.preload:
        run.times("gas", 1.0 + x / (ROOM + KELVIN))


def thinned(run: Run, T: Array, c: Constants) -> None:
    """The fluid force at temperatures [degC] (n,)."""
    share = 1.0 / (1.0 + np.abs(run.parts["velocity"]) / c["v_turbulent"])
    thin = walther(T, c["nu_40"], c["nu_100"]) / walther(np.array([ROOM]), c["nu_40"], c["nu_100"])
    run.times("fluid", share * thin + (1.0 - share) * (1.0 - 7e-4 * (T - ROOM)))


def linear_fade(run: Run, x: float, c: Constants) -> None:
    """The whole fluid force falls linearly with the temperature (Dixon's fade in 1/K)."""
    T = acting(run, x, c)
    run.times("fluid", np.maximum(0.05, 1.0 - c["fade"] * (T - ROOM)))


def heat_run(run: Run, x: float, c: Constants) -> None:
    """Endurance: oil thins, gas presses with its absolute temperature, friction falls; the tube's temperature is kept."""
    both = temperatures(run, c)
    T = both[:, 0]
    fade = np.exp(-x * c["fade"] * (T - ROOM))
    run.times("fluid", fade)
    run.times("friction", np.exp(-x * c["friction_fade"] * (T - ROOM)))
    # Gauge: the absolute pressure of the gas goes with its absolute temperature; F_0 is a gauge pressure on the rod.
    d = derived_of(run.damper)
    absolute = d.F_0 + ATMOSPHERE * d.A_rod
    run.plus("gas", -x * absolute * (both.mean(axis=1) - ROOM) / (ROOM + KELVIN))
    run.temperature = both[:, 1]


def lag_constants(rng: np.random.Generator) -> dict[str, Any]:
    """Share of air bubbles at ambient pressure and the bulk modulus [Pa] of the oil."""
    return {"air": float(np.exp(rng.uniform(np.log(1e-3), np.log(3e-2)))), "bulk": rng.uniform(1.0e9, 1.7e9)}


def compressed(  # noqa: PLR0917 - compiled by numba
    t: Array, v: Array, z: Array, k: Array, table: Array, numbers: Array, out: Array
) -> None:
    """Fluid force behind a compressible column: dF/dt = K (v - u), F = k f(u); implicit; `table`: v, F of both."""
    F, factors = 0.0, np.ones(2)  # of rebound and compression
    x, air, bulk, A_1, A_2, half, base = numbers
    for i in range(len(t)):
        factors[0 if v[i] >= 0.0 else 1] = k[i]
        if i == 0 or t[i] <= t[i - 1]:
            out[i] = F
            continue
        area, length = (A_1, half - z[i]) if F >= 0.0 else (A_2, half + z[i])
        pressure = base + abs(F) / area
        share = air * 1.013e5 / pressure
        stiffness = area / (max(length, 0.01) * x * (share / (1.2 * pressure) + 1.0 / bulk))
        pull = F + stiffness * v[i] * (t[i] - t[i - 1])
        soft = stiffness * (t[i] - t[i - 1])
        # F solves F + soft u(F) = pull: along the branch of the sign of `pull`, segment by segment
        side, factor = (0, factors[0]) if pull >= 0.0 else (2, factors[1])
        goal = abs(pull)
        u0, f0 = 0.0, 0.0
        for j in range(table.shape[1]):
            u1, f1 = table[side, j], factor * table[side + 1, j]
            if f1 + soft * u1 >= goal or j == table.shape[1] - 1:
                u = u0 + (goal - f0 - soft * u0) * (u1 - u0) / max(f1 - f0 + soft * (u1 - u0), 1e-12)
                F = goal - soft * u
                break
            u0, f0 = u1, f1
        if side == 2:
            F = -F
        out[i] = F


def bulk_modulus(run: Run, x: float, c: Constants) -> None:
    """Oil with air bubbles between piston and valves, `x` times as soft as the two volumes say."""
    p, d = run.damper.parameters, derived_of(run.damper)
    table = np.array([p.v_re, p.F_re, p.v_co, p.F_co])
    base = ATMOSPHERE + float(d.F_0 / d.A_rod)
    numbers = np.array([x, c["air"], c["bulk"], d.A_1, d.A_2, d.half_length, base])
    out = np.empty_like(run.time)
    parts = run.parts
    with_numba(compressed)(run.time, parts["velocity"], parts["stroke"], parts["k_degr"], table, numbers, out)
    parts["fluid"] = out


def lagging(t: Array, F: Array, tau: float, out: Array) -> None:
    """First-order lag, exact for a force that is straight between two samples."""
    y = F[0]
    out[0] = y
    for i in range(1, len(t)):
        dt = t[i] - t[i - 1]
        if dt > 0.0:
            q = dt / tau
            decay = math.exp(-q)
            ramp = 1.0 - (1.0 - decay) / q
            y = decay * y + (1.0 - decay - ramp) * F[i - 1] + ramp * F[i]
        out[i] = y


def first_order_lag(run: Run, x: float, c: Constants) -> None:
    """The fluid force follows with the time constant `x` [s]."""
    out = np.empty_like(run.time)
    with_numba(lagging)(run.time, run.parts["fluid"], x, out)
    run.parts["fluid"] = out


def late_valves(run: Run, x: float, c: Constants) -> None:
    """Check valves that close late: after each reversal the force grows over `x` [m] of stroke, the plate's gap."""
    run.times("fluid", 1.0 - np.exp(-((run.since_reversal / x) ** 2)))


def mixing(z: Array, v: Array, k: Array, length: float, out: Array) -> None:
    """k_degr follows its stepping value over a stroke `length` [m], each direction with a memory of its own."""
    followed = np.array([k[0], k[0]])
    for i in range(len(z)):
        side = 0 if v[i] >= 0.0 else 1
        decay = 1.0 - math.exp(-abs(z[i] - z[i - 1]) / length) if i > 0 else 0.0
        followed[side] += decay * (k[i] - followed[side])
        out[i] = followed[side]


def mixing_length(run: Run, x: float, c: Constants) -> None:
    """Oil, foam and gas mix over the length `x` [m] of stroke."""
    k = np.empty_like(run.time)
    with_numba(mixing)(run.parts["stroke"], run.parts["velocity"], run.parts["k_degr"], x, k)
    run.parts["fluid"] = run.intact_fluid * k


def sigmoid(run: Run, x: float, c: Constants) -> None:
    """A step of k_degr becomes a logistic curve of the displaced volume, of the width `x` as a stroke [m]."""
    z, v, k = run.parts["stroke"], run.parts["velocity"], run.parts["k_degr"]
    bounds = np.flatnonzero(np.diff(np.sign(v), prepend=np.sign(v[0])) != 0)
    smooth = k.copy()
    reach = 6.0 * x
    for i, j in zip([0, *bounds], [*bounds, len(z)], strict=True):
        way = np.abs(z[i:j] - z[i])
        if j - i < FEWEST or way[-1] < SHORTEST:
            continue
        grid = np.linspace(0.0, way[-1], min(4 * (j - i), 4000))
        step = float(grid[1])
        width = int(min(reach / step, 3 * len(grid))) + 1
        weights = 1.0 / np.cosh(np.arange(-width, width + 1) * step / (2.0 * x)) ** 2
        values = np.interp(grid, np.maximum.accumulate(way), k[i:j])
        padded = np.pad(values, width, mode="edge")
        spread = np.convolve(padded, weights / weights.sum(), mode="valid")
        smooth[i:j] = np.interp(way, grid, spread)
    run.parts["fluid"] = run.intact_fluid * smooth


def wear_constants(rng: np.random.Generator) -> dict[str, Any]:
    """Which branch is worn how far relative to the other, and the sign: a shim stack can also be stiffened by varnish."""
    kind = rng.choice(["both", "rebound", "compression"])
    re, co = {"both": (1.0, rng.uniform(0.3, 1.0)), "rebound": (1.0, 0.0), "compression": (0.0, 1.0)}[str(kind)]
    return {"re": re, "co": float(co), "sign": -1.0 if chance(rng, 0.8) else 1.0, "knee": rng.uniform(0.1, 0.4)}


def sides(run: Run, c: Constants) -> Array:
    """The branch's share of the wear at each step (n,)."""
    return np.where(run.parts["velocity"] >= 0.0, float(c["re"]), float(c["co"]))


def uniform_wear(run: Run, x: float, c: Constants) -> None:
    """Each branch times a factor."""
    run.times("fluid", 1.0 + c["sign"] * x * sides(run, c))


def bleed_wear(run: Run, x: float, c: Constants) -> None:
    """A wider bleed, v = f^-1(F) + b sqrt(F): the low-speed part of the curve falls most; `x` [m/s] passes it at 1 kN."""
    v, speed = run.parts["velocity"], np.concatenate([np.linspace(0.0, 0.2, 801), np.linspace(0.2, 6.0, 4000)[1:]])
    for side, share in ((1.0, c["re"]), (-1.0, c["co"])):
        force = np.abs(curve(run.damper, side * speed))
        worn = np.interp(np.abs(v), speed + share * x * np.sqrt(force / 1000.0), force)
        run.parts["fluid"] = np.where(side * v > 0.0, side * run.parts["k_degr"] * worn, run.parts["fluid"])


def lost_preload(run: Run, x: float, c: Constants) -> None:
    """Blow-off springs have lost preload: above the knee the force is less by a constant, `x` of that at 0.5 m/s."""
    v = run.parts["velocity"]
    pull, push = np.abs(curve(run.damper, np.array([0.5, -0.5])))
    less = x * np.where(v >= 0.0, pull, push) * sides(run, c) * (1.0 - np.exp(-((np.abs(v) / c["knee"]) ** 2)))
    whole = run.intact_fluid
    kept = np.maximum(np.abs(whole) - less, 0.05 * np.abs(whole))
    run.parts["fluid"] = run.parts["k_degr"] * np.sign(whole) * kept
