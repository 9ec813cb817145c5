"""What the model says of an open measurement: oil is taken step by step out of a twin-tube damper without gas pressure.

An indicator stand drives the damper by a crank. What is read off is the force at the largest velocity, which is that in the
middle of the stroke, in rebound and in compression (Burdzik et al., Transport Problems 4(4), 2009).
"""

from dataclasses import dataclass, fields
from itertools import product

import numpy as np

from twintube.common.arrays import Array
from twintube.core.kernel import fluid_force
from twintube.dampers import Damper, freed_gas, load
from twintube.dampers.dead_length import bounds, collapse_level, prepared
from twintube.dampers.toml import names
from twintube.engine.simulate import simulate
from twintube.rig import harmonic_block

# Strokes of 25, 50 and 100 mm, and two velocities of a damper bench. Those of the test are not known to us (assumed).
AMPLITUDES = (0.0125, 0.025, 0.05)  # [m]
SLOW, FAST = 0.524, 1.048  # [m/s]: below and above the speeds of cavitation of Table 9, 0.70 to 1.05 m/s
FALLS = (0.1, 0.5)  # of the force: the first that is seen, and half of it
VALVES = ("degradation", "foam", "cavitation")  # groups of Table 9, which dimensions do not tell
REACH = np.arange(-5, 21) / 10  # oil missing in the working chambers, over A_2 times the amplitude [1]
LEVELS = np.arange(100, 19, -2) / 100  # oil levels [1] of the fast blocks

Falls = dict[tuple[str, float], float]  # by direction and fall


@dataclass(frozen=True)
class Levels:
    """Working chambers of a damper with the piston in the middle, which decide below the speed of cavitation."""

    full: float  # [m3] of oil below which the chambers are not full: V_c = (A_1 + A_2) l / 2
    swept: float  # [m2] bore: A_2, times the amplitude the oil that a half stroke moves
    intact: float  # [m3] of oil

    def oil_level(self, missing: float, amplitude: float) -> float:
        """Oil level [1] where `missing` times A_2 times the amplitude [m] lacks in the working chambers."""
        return float(np.clip((self.full - missing * self.swept * amplitude) / self.intact, 0.0, 1.0))


def levels(damper: Damper) -> Levels:
    """Volumes of a damper."""
    p = damper.parameters
    return Levels(collapse_level(damper) * p.V_oil, prepared(p).A_2, p.V_oil)


def force_left(damper: Damper, oil_level: float, v: float, amplitude: float, way: str) -> tuple[float, float]:
    """Fluid force at the largest velocity `v` [m/s] over that of the F-v curve, in rebound and compression [1].

    Read in the last of 19 oscillations. The damper has no gas preload at any level.
    """
    block = harmonic_block(v, amplitude)
    found = simulate(freed_gas.condition(damper, oil_level, 0, way), block.stroke, block.velocity, block.time)
    last = slice(block.marks[-2], block.marks[-1])
    speed, force = block.velocity[last], found.F_fluid[last]
    rebound, compression = int(np.argmax(speed)), int(np.argmin(speed))
    curve = damper.parameters
    return float(force[rebound] / fluid_force(curve, v)), float(force[compression] / fluid_force(curve, -v))


def with_valves_of(damper: Damper, name: str) -> Damper:
    """The damper with the parameters of VALVES of one of the paper's eight, as its own cannot be read off its dimensions."""
    other = load(name).parameters
    valves = [item.name for item in fields(other) if item.metadata["group"] in VALVES]
    return damper.with_(**{valve: getattr(other, valve) for valve in valves})


def strokes(damper: Damper) -> list[float]:
    """Amplitudes [m] that the damper has room for, at least its own."""
    longest = damper.parameters.stroke_max
    return [amplitude for amplitude in AMPLITUDES if amplitude <= longest] or [longest]


def missing_at(damper: Damper, amplitude: float) -> Falls:
    """Oil missing in the working chambers, over A_2 times the amplitude [1], at which the slow force has fallen.

    By direction and fall; infinite where it does not fall within REACH.
    """
    volumes = levels(damper)
    oil = [volumes.oil_level(share, amplitude) for share in REACH.tolist()]
    left = np.array([force_left(damper, level, SLOW, amplitude, freed_gas.DEFAULT) for level in oil])
    return first(REACH, left, never=np.inf)


def level_at(damper: Damper, amplitude: float, way: str) -> Falls:
    """Oil level [1] from 1 down at which the fast force has fallen, by direction and fall; 0 where it does not."""
    left = np.array([force_left(damper, float(level), FAST, amplitude, way) for level in LEVELS])
    return first(LEVELS, left, never=0.0)


def first(at: Array, left: Array, never: float) -> Falls:
    """The first of `at` (n,) where `left` (n, 2) is below 1 - fall, or `never`."""
    return {
        (direction, fall): float(next((x for x, share in zip(at, column, strict=True) if share < 1.0 - fall), never))
        for direction, column in zip(("rebound", "compression"), left.T, strict=True)
        for fall in FALLS
    }


def dead_lengths(damper: Damper) -> list[Damper]:
    """The damper with both bounds of its dead length, 60 to 110 mm where oil and gas leave room for that."""
    return [damper.with_(dead_length=length) for length in bounds(damper)]


def slow_falls(damper: Damper) -> dict[float, list[Falls]]:
    """`missing_at` by amplitude, for every dead length and every set of valves of Table 9."""
    builds = [with_valves_of(item, name) for item, name in product(dead_lengths(damper), names())]
    return {amplitude: [missing_at(item, amplitude) for item in builds] for amplitude in strokes(damper)}


def fast_falls(damper: Damper) -> list[Falls]:
    """`level_at` for every dead length, stroke and way of freed gas, with the valves that the damper has."""
    cases = product(dead_lengths(damper), strokes(damper), freed_gas.VARIED)
    return [level_at(item, amplitude, way) for item, amplitude, way in cases]
