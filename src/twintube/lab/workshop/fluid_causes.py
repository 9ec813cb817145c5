"""Physical causes that act on the fluid force, the gas force and the friction while the damper's motion is given."""

from bisect import bisect_right
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from twintube.lab.workshop.bench import curve
from twintube.lab.workshop.cause import Cause, Run

Array = NDArray[np.float64]
AIR = 1.013e5  # [Pa]


def viscosity(kelvin: Array | float) -> Array:
    """Viscosity of damper oil over that at 20 degC, `kelvin` above it: Vogel's law, ISO VG 15 or so (Dixon, "Fluids")."""
    t = 20.0 + np.asarray(kelvin, dtype=float)
    result: Array = np.exp(800.0 / (t + 110.0) - 800.0 / 130.0)
    return result


def warm_factor(v: Array, kelvin: Array | float, laminar: float, bend: float) -> Array:
    """Fluid force over that at 20 degC: pressure drop a mu Q + b rho Q^2 (Dixon, "Valve design"; Lang 1977).

    `laminar` is the laminar share at small speeds, `bend` [m/s] where it has halved; the density falls by 0.07 % per kelvin.
    """
    share = laminar / (1.0 + np.abs(v) / bend)
    return share * viscosity(kelvin) + (1.0 - share) * (1.0 - 7e-4 * np.asarray(kelvin, dtype=float))


@dataclass
class WarmOil(Cause):
    """The whole run warmer or colder than at identification by `kelvin`; the gas as well (Gay-Lussac)."""

    kelvin: float = 0.0
    laminar: float = 0.35
    bend: float = 0.3

    def force(self, run: Run) -> None:
        """Fluid by viscosity and density, gas pressure by absolute temperature."""
        run.fluid *= warm_factor(run.v, self.kelvin, self.laminar, self.bend)
        if run.trial.preload:
            run.gas *= 1.0 + self.kelvin / 293.0


@dataclass
class Heating(Cause):
    """The oil takes up the damper's work: C dT/dt = F v - C (T - T0)/tau (lumped; Dixon, "Temperature")."""

    capacity: float = 600.0  # [J/K]
    cooling: float = 150.0  # [s]
    laminar: float = 0.35
    bend: float = 0.3
    kelvin: float = 0.0
    last: float = 0.0  # end of the record before [s]

    def begin(self) -> None:
        """Cold."""
        self.kelvin, self.last = 0.0, 0.0

    def force(self, run: Run) -> None:
        """March the temperature over the record and over the pause before it."""
        n, dt = len(run.v), 1.0 / run.trial.rate
        self.kelvin *= float(np.exp(-(run.trial.begin - self.last) / self.cooling))
        warm, now, size = np.zeros(n), self.kelvin, 20
        for i in range(0, n, size):
            part = slice(i, min(n, i + size))
            factor = warm_factor(run.v[part], now, self.laminar, self.bend)
            power = float(np.mean((run.fluid[part] * factor + run.friction[part]) * run.v[part]))
            warm[part] = now
            now += (part.stop - i) * dt * (power / self.capacity - now / self.cooling)
        run.fluid *= warm_factor(run.v, warm, self.laminar, self.bend)
        if run.trial.preload:
            run.gas *= 1.0 + warm / 293.0
        self.kelvin, self.last = now, run.trial.begin + n * dt
        self.values["kelvin_at_end"] = round(now, 2)


@dataclass
class OilColumn(Cause):
    """Maxwell element: oil with air, stiffness K [N/m], in series with valves; dF/dt = K (v - v_valve(F)) (Duym 2000)."""

    stiffness: float = 1e6

    def force(self, run: Run) -> None:
        """Implicit Euler; valves by the F-v curve times the degradation factor."""
        p = run.damper.parameters
        knots = np.array(sorted({-50.0, 0.0, 50.0, *(x for x in p.v_re if x > 0), *(-x for x in p.v_co if x > 0)}))
        forces = curve(run.damper, knots).tolist()
        grid, gain, f = knots.tolist(), self.stiffness / run.trial.rate, 0.0
        out = np.empty(len(run.v))
        for i, (v, k) in enumerate(zip(run.v.tolist(), run.k.tolist(), strict=True)):
            goal = f + gain * v
            sums = [k * y + gain * w for w, y in zip(grid, forces, strict=True)]
            j = min(max(bisect_right(sums, goal) - 1, 0), len(grid) - 2)
            share = (goal - sums[j]) / (sums[j + 1] - sums[j])
            f = k * (forces[j] + share * (forces[j + 1] - forces[j]))
            out[i] = f
        run.fluid = out


@dataclass
class LateCheckValves(Cause):
    """After each reversal the plates of the check valves need a stroke [m] to close; until then they leak in proportion."""

    stroke: float = 1e-3

    def force(self, run: Run) -> None:
        """Fluid force builds up linearly over the stroke since the reversal."""
        run.fluid *= np.minimum(1.0, since_reversal(run) / max(self.stroke, 1e-12))


def since_reversal(run: Run) -> Array:
    """Stroke (n,) [m] since the last change of direction."""
    way = np.append(0.0, np.cumsum(np.abs(np.diff(run.z))))
    side = np.sign(run.v)
    turn = np.append(True, (side[1:] != side[:-1]) & (side[1:] != 0))
    start = np.maximum.accumulate(np.where(turn, np.arange(len(way)), 0))
    result: Array = way - way[start] + np.abs(run.v) * 0.5 / run.trial.rate
    return result


@dataclass
class MixingLength(Cause):
    """A rise of the degradation factor within a stroke is followed over a length [m]: dk/ds = (k_goal - k)/L."""

    length: float = 5e-3

    def force(self, run: Run) -> None:
        """First order over the stroke, rises only; at a reversal the other valve starts afresh."""
        way = np.abs(np.diff(run.z, prepend=run.z[0]))
        share = 1.0 - np.exp(-way / max(self.length, 1e-15))
        k, side, out = float(run.k[0]), 0.0, np.empty(len(run.k))
        for i, (goal, a, s) in enumerate(zip(run.k.tolist(), share.tolist(), np.sign(run.v).tolist(), strict=True)):
            if s != side or goal <= k:
                k = goal
            else:
                k += a * (goal - k)
            side = s
            out[i] = k
        run.fluid = run.fv * out
        run.k = out


@dataclass
class TiltedSurface(Cause):
    """The oil's surface is not flat and reaches the piston over a height [m]: each rise is spread about its place."""

    height: float = 8e-3

    def force(self, run: Run) -> None:
        """Within each half stroke the factor is the mean over the height around its place, where that is a rise."""
        side = np.sign(run.v)
        cuts = np.flatnonzero(np.diff(side) != 0) + 1
        for part in np.split(np.arange(len(side)), cuts):
            if len(part) < 4 or side[part[0]] == 0:
                continue
            s, k = np.abs(run.z[part] - run.z[part[0]]), run.k[part]
            rising = np.maximum.accumulate(k)
            if rising[-1] <= rising[0] or np.ptp(s) < 1e-4:
                continue
            total = np.append(0.0, np.cumsum(0.5 * (rising[1:] + rising[:-1]) * np.diff(s)))
            low, high = s - 0.5 * self.height, s + 0.5 * self.height
            mean = (self.area(high, s, total, rising) - self.area(low, s, total, rising)) / self.height
            run.k[part] = np.maximum(mean - (rising - k), 0.0)  # falls stay where they are
        run.fluid = run.fv * run.k

    @staticmethod
    def area(at: Array, s: Array, total: Array, k: Array) -> Array:
        """Integral of the factor up to `at`, the factor held beyond both ends."""
        inner = np.interp(at, s, total)
        result: Array = inner + k[0] * np.minimum(at - s[0], 0.0) + k[-1] * np.maximum(at - s[-1], 0.0)
        return result


@dataclass
class WornScale(Cause):
    """Weak springs and discs: the fluid force times a factor in each direction (Reimpell: wear of 5 to 35 %)."""

    rebound: float = 0.0
    compression: float = 0.0

    def force(self, run: Run) -> None:
        """Less force."""
        run.fluid *= np.where(run.v >= 0, 1.0 - self.rebound, 1.0 - self.compression)


@dataclass
class WornBleed(Cause):
    """A worn seat leaks beside the valve: v = v_valve(F) + b sqrt(F / 1000 N) (orifice; Dixon, "Valve design")."""

    rebound: float = 0.0  # [m/s] at 1000 N
    compression: float = 0.0

    def force(self, run: Run) -> None:
        """Ratio of both curves, by tabulating speed over force."""
        speed = np.concatenate([np.linspace(0.0, 0.2, 801), np.linspace(0.2, 6.0, 2000)[1:]])
        for sign, b in ((1.0, self.rebound), (-1.0, self.compression)):
            if b <= 0:
                continue
            force = np.abs(curve(run.damper, sign * speed))
            total = speed + b * np.sqrt(force / 1000.0)
            here = sign * run.v > 0
            v = np.abs(run.v[here])
            ratio = np.interp(v, total, force) / np.maximum(np.interp(v, speed, force), 1e-9)
            run.fluid[here] *= np.minimum(ratio, 1.0)
