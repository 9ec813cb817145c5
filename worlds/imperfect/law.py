"""The damper's own law: where the oil is comes from the kernel; valves, friction and lag are this specimen's."""

import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

import numpy as np
from scipy.signal import bilinear, lfilter

from twintube import Damper, simulate
from twintube.common.arrays import Array
from worlds.bench.valves import curve, since_reversal

RATE: Final = 2000  # [Hz] of everything before the recorder: 1 ms of lag is two samples, kept apart by interpolation
V_KNEE: Final = 0.2  # [m/s] where the valves of car dampers blow off, 0.1 to 0.3
A_DISCS: Final = 15.0  # [m/s2] from which discs no longer follow: 0.4 m/s in 25 ms
T_PARAMETERS: Final = 25.0  # [degC] at which the parameter set holds
P_GAS: Final = 6.0 / 5.0  # absolute over gauge pressure of 5 bar: the gauge pressure follows the absolute temperature
LONGEST_LAG: Final = 1.5e-3  # [s] of valve discs and compressible oil, tenths of ms to 1 ms and a little more
SHORTEST_LAG: Final = 1e-5  # [s] of which samples at RATE show nothing
# Kernel runs and iterations in each, of a damper between hard clevises (the stroke then changes by micrometres) and of a
# bush that gives way by a millimetre.
HARD_MOUNT: Final = (1, 4)
SOFT_MOUNT: Final = (2, 7)

# How specimens differ from their type, and by how much before all are scaled together: production tolerance of valve
# stacks is 10 % of the force at a point, their knees scatter by 10 to 20 %, bleed notches are stamped to 10 % of area.
TRAITS: Final[Mapping[str, float]] = {
    "knee_shift": 0.20,  # share of velocity, around the knee
    "knee_round": 0.60,  # natural logarithm of velocity over which the knee is rounded
    "bleed_re": 0.25,  # share of the force at low velocity
    "bleed_co": 0.25,
    "gain_re": 0.06,  # share of the force
    "gain_co": 0.08,
    "turbulent": 0.06,  # share of the force at 1 m/s
    "position": 0.10,  # share of the fluid force, from the middle to the ends
    "friction_tilt": 0.5,  # share of the friction, over the stroke
    "friction_bow": 0.5,
    "loop": 0.06,  # share of the force by which opening and closing valves differ
}
POSITIVE: Final = ("knee_round", "loop")


@dataclass(frozen=True)
class State:
    """What is the matter with damper and bench; the defaults are a damper as delivered and a bench in order."""

    oil_level: float = 1.0
    oil_level_end: float | None = None  # at the end of the record, where oil leaks out
    gas_preload: int = 1
    gas_share: float = 1.0  # of the gas force
    heating: tuple[float, float] = (0.0, 0.0)  # [K] above the start, at the record's start and end
    bleed: tuple[float, float] = (0.0, 0.0)  # change of the force at low velocity, rebound and compression
    blow_off: tuple[float, float] = (0.0, 0.0)  # the same above the knee
    friction: float = 1.0
    side_friction: float = 0.0  # [N], more of it further out
    rod_bump: tuple[float, float, float] = (0.0, 0.0, 0.01)  # friction [N], place and width [m]
    bush: float = 0.0  # compliance [m/N]
    dead_stroke: tuple[float, float] = (0.0, 0.0)  # [m] that aerated oil needs after a reversal, at start and end
    play: float = 0.0  # [m] free at each reversal
    late_compression: float = 0.0  # [m] without force after the reversal into compression
    stop: tuple[float, float] = (0.0, 0.0)  # stroke of the contact [m], signed, and stiffness [N/m^1.5]
    chatter: tuple[float, float] = (0.0, 100.0)  # share of the fluid force, frequency [Hz]


@dataclass(frozen=True)
class Law:
    """One specimen."""

    damper: Damper
    traits: dict[str, float]
    lag: float  # [s]
    order: int  # 1 or 2 of the lag
    smoothing: float  # stroke [m] over which a chamber runs out: the oil's surface is neither flat nor still
    viscosity: float  # change of the fluid force per K
    scale: float = 1.0
    nominal: bool = field(default=False)  # the parameter set's own law


def by_direction(v: Array, rebound: float, compression: float) -> Array:
    """One value in rebound, the other in compression."""
    return np.asarray(np.where(v >= 0.0, rebound, compression))


def fluid_force(law: Law, state: State, z: Array, v: Array) -> Array:
    """Force of the valves on full chambers, without lag."""
    s = {name: law.scale * value for name, value in law.traits.items()}
    speed = np.abs(v) + 1e-9
    warped = v * (1.0 + s.get("knee_shift", 0.0) * np.exp(-((np.log(speed / V_KNEE) / 0.8) ** 2)))
    width = np.exp(min(s.get("knee_round", 0.0), 0.8))
    force = 0.5 * curve(law.damper, warped) + 0.25 * (curve(law.damper, warped * width) + curve(law.damper, warped / width))
    low, x = 1.0 / (1.0 + (v / 0.12) ** 2), z / law.damper.parameters.stroke_max
    force *= 1.0 + low * by_direction(v, s.get("bleed_re", 0.0), s.get("bleed_co", 0.0))
    force *= 1.0 + by_direction(v, s.get("gain_re", 0.0), s.get("gain_co", 0.0)) + s.get("turbulent", 0.0) * speed
    force *= 1.0 + s.get("position", 0.0) * (x**2 - 0.3)
    # Valve discs lift late and fall late; where the bench hardly accelerates they have the time.
    force *= 1.0 + s.get("loop", 0.0) * np.tanh(np.gradient(v) * RATE * np.sign(v) / A_DISCS)
    force *= 1.0 + by_direction(v, *state.bleed) * low + by_direction(v, *state.blow_off) * v**2 / (v**2 + V_KNEE**2)
    return np.asarray(force)


def lagged(law: Law, force: Array) -> Array:
    """The force behind oil columns and valve discs: a first- or second-order lag of the same delay."""
    delay = min(law.scale * law.lag, LONGEST_LAG)
    if law.nominal or delay < SHORTEST_LAG:
        return force
    damping = 0.7  # of the discs in oil
    omega = 2 * damping / delay
    poles = [delay, 1.0] if law.order == 1 else [1 / omega**2, 2 * damping / omega, 1.0]
    return np.asarray(lfilter(*bilinear([1.0], poles, RATE), force))


def over_travel(values: Array, z: Array, length: float) -> Array:
    """Values that follow with a lag of `length` [m] of travel."""
    travel = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(z)))])
    grid = np.arange(0.0, travel[-1] + 1e-4, 1e-4)
    rate = 1.0 - np.exp(-1e-4 / length)
    smooth = lfilter([rate], [1.0, rate - 1.0], np.interp(grid, travel, values) - values[0]) + values[0]
    return np.asarray(np.interp(travel, grid, smooth))


@dataclass(frozen=True)
class Inside:
    """What the kernel says about a motion: how far the chambers are full, friction and gas force [N]; arrays (n,)."""

    k_degr: Array
    friction: Array
    gas: Array


def inside(law: Law, state: State, z: Array) -> Inside:
    """The kernel over a motion; where oil leaks out, between runs with the oil of different times."""
    n, v = len(z), np.gradient(z) * RATE
    ends = (state.oil_level, state.oil_level if state.oil_level_end is None else state.oil_level_end)
    levels = np.linspace(*ends, 1 if ends[0] == ends[1] else 5)
    share = np.linspace(0.0, len(levels) - 1.0, n)
    parts = np.zeros((3, n))
    for i, level in enumerate(levels):
        damper = law.damper.with_(oil_level=level, gas_preload=state.gas_preload)
        with warnings.catch_warnings():  # the velocity seen through a mount is only nearly the stroke's derivative
            warnings.simplefilter("ignore")
            run = simulate(damper, z, v, np.arange(n) / RATE)
        parts += np.clip(1.0 - np.abs(share - i), 0.0, 1.0) * np.array([run.k_degr, run.F_friction, run.F_gas])
    return Inside(*parts)


def force(law: Law, state: State, z: Array, warmth: Array, found: Inside) -> Array:
    """Force [N] at strokes [m] of the damper itself at temperatures [degC], all (n,) at RATE."""
    own, n, p = law.damper, len(z), law.damper.parameters
    v, k, gas = np.gradient(z) * RATE, found.k_degr, found.gas
    if law.nominal:
        return np.asarray(curve(own, v) * k + found.friction + gas)
    x, kelvin = z / p.stroke_max, warmth - T_PARAMETERS
    fluid = lagged(law, fluid_force(law, state, z, v)) * over_travel(k, z, law.smoothing)
    fluid *= 1.0 + law.viscosity * kelvin
    turned = since_reversal(z, v)
    dead = np.linspace(*state.dead_stroke, n)
    if dead.any():
        fluid *= 1.0 - np.exp(-turned / np.maximum(dead, 1e-6))
    if state.late_compression > 0.0:
        fluid *= np.where(v < 0.0, np.clip((turned / state.late_compression - 0.8) / 0.2, 0.0, 1.0), 1.0)
    fluid *= 1.0 + state.chatter[0] * np.sin(2 * np.pi * state.chatter[1] * np.arange(n) / RATE) * (np.abs(v) > V_KNEE)
    tilt, bow = law.scale * law.traits.get("friction_tilt", 0.0), law.scale * law.traits.get("friction_bow", 0.0)
    bump, place, width = state.rod_bump
    extra = state.side_friction * (1.0 + 0.3 * x) + bump * np.exp(-(((z - place) / width) ** 2))
    uneven = np.clip(state.friction * (1.0 + tilt * x + bow * (x**2 - 0.3)), 0.1, None)
    rubbing = found.friction * (uneven + extra / p.F_FrS)
    total = fluid + rubbing
    if state.play > 0.0:
        total *= np.clip((turned / state.play - 0.8) / 0.2, 0.0, 1.0)
    contact, stiffness = state.stop
    if stiffness > 0.0:
        total += np.sign(contact) * stiffness * np.clip(z * np.sign(contact) - abs(contact), 0.0, None) ** 1.5
    return np.asarray(total + gas * state.gas_share * (1.0 + P_GAS * kelvin / 298.0))


def through_mount(law: Law, state: State, compliance: float, z: Array, warmth: Array) -> tuple[Array, Array]:
    """Force [N] and stroke of the damper [m] where the bench moves by `z` and its mount gives way by `compliance` [m/N].

    The residual is fed back through the lag of the stiffest damping, so that no frequency grows.
    """
    give = compliance + state.bush
    p = law.damper.parameters
    stiffest = 1.5 * max(*np.gradient(p.F_re, p.v_re)[:3], p.F_re[0] / p.v_re[0], p.F_co[0] / p.v_co[0])
    lag = bilinear([1.0], [give * stiffest, 1.0], RATE)
    inner = z
    runs, iterations = HARD_MOUNT if state.bush == 0.0 else SOFT_MOUNT
    for _ in range(runs):
        found = inside(law, state, inner)
        for _ in range(iterations):
            acting = force(law, state, inner, warmth, found)
            inner = inner - lfilter(*lag, inner + give * (acting - acting[0]) - z)
    return force(law, state, inner, warmth, found), inner
