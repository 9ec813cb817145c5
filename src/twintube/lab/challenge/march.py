"""The paper's kernel driven step by step, with a state that leaks, drains, dissolves gas or hangs on a mount.

The equations of the flows and forces are the kernel's; what happens between two of its steps is written here from other
sources. A run without any of it is the kernel's own, step by step.
"""

import math
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import numpy as np

from twintube.arrays import Array
from twintube.dampers import Damper
from twintube.engine import compiled
from twintube.engine.simulate import at_rest, rows

COLUMNS = ("k_degr", "fluid", "friction", "gas", "stroke", "velocity", "oil")

# Kinds of change of the state between two steps, 0 is none
HALF_LIFE, DRAINAGE = 1, 2  # foam
FIRST_ORDER, HENRY = 1, 2  # gas that dissolves
FILM, ORIFICE = 1, 2  # leak
ATMOSPHERE = 1.013e5  # [Pa]
THETA = 0.55  # of the implicit step with a mount: above 0.5 the stiff mode is damped


@dataclass
class Mount:
    """A mount between rod and rig; force over deflection e: k e + k_3 e^3 + c de/dt + friction as Berg (1998) writes it."""

    stiffness: float = 0.0  # [N/m], 0 is no mount
    cubic: float = 0.0  # [N/m3]
    damping: float = 0.0  # [N s/m]
    friction: float = 0.0  # [N] at large amplitude
    half_way: float = 1e-4  # [m] deflection at which half of the friction has come back after a reversal


@dataclass
class Between:
    """What changes the state between two steps; kinds are the constants above."""

    foam: int = 0
    foam_rate: float = 0.0  # [1/s]
    foam_power: float = 1.0
    gas: int = 0
    gas_rate: float = 0.0  # [1/s] at ambient pressure
    leak: int = 0
    leak_size: float = 0.0  # film: [m3] per metre out and root of m/s; orifice: [m3/s] at 1 kN
    mount: Mount = field(default_factory=Mount)

    def packed(self) -> Array:
        """All numbers as an array."""
        m = self.mount
        numbers = [self.foam, self.foam_rate, self.foam_power, self.gas, self.gas_rate, self.leak, self.leak_size]
        return np.array([*numbers, m.stiffness, m.cubic, m.damping, m.friction, m.half_way], dtype=float)


def rows_of(damper: Damper, stroke: float = 0.0) -> list[Any]:
    """The kernel's records p, d, s, f as numba takes them, at rest at a stroke [m]."""
    return rows(at_rest(damper, stroke))


def march(damper: Damper, time: Array, stroke: Array, velocity: Array, between: Between) -> dict[str, Array]:
    """Drive the damper over times [s], strokes [m] and velocities [m/s], all (n,); COLUMNS in SI units, each (n,).

    Raises ArithmeticError where a step of the kernel fails.
    """
    p, d, s, f = rows_of(damper, float(stroke[0]))
    out = np.empty((len(COLUMNS), len(time)))
    compiled.module().fill(p, d, s, stroke[0])
    done = loop()(p, d, s, f, time, stroke, velocity, between.packed(), out)
    if done < len(time):
        raise ArithmeticError(f"step {done} of {damper.name} could not be finished")
    return {name: out[i] for i, name in enumerate(COLUMNS)}


@cache
def loop() -> Any:
    """The compiled loop; without a cache on disk, as numba's would not see a change of the kernel."""
    import numba

    kernel = compiled.module()
    step, dahl, stribeck, fluid_force = kernel.step, kernel.dahl, kernel.stribeck, kernel.fluid_force
    njit = numba.njit(error_model="numpy", nogil=True)

    @njit
    def lost_foam(kind: Any, rate: Any, power: Any, reference: Any, foam: Any, oil: Any, dt: Any) -> Any:
        """Foam and oil of it that are gone after `dt`."""
        if foam <= 0.0 or dt <= 0.0:
            return 0.0, 0.0
        if kind == HALF_LIFE:
            # dV/dt = -rate V (V / reference)^(power - 1)
            now = rate * (foam / reference) ** (power - 1.0)
            gone = foam * (1.0 - math.exp(-now * dt))
            return gone, gone * oil / foam
        # Liquid drains between the bubbles (Bikerman), the dry rest collapses five times slower
        drained = oil * (1.0 - math.exp(-rate * dt))
        collapsed = (foam - oil) * (1.0 - math.exp(-0.2 * rate * dt))
        return drained + collapsed, drained

    @njit
    def settle_foam(p: Any, s: Any, kind: Any, rate: Any, power: Any, dt: Any) -> None:
        reference = 0.1 * p.V_oil
        foam, oil = lost_foam(kind, rate, power, reference, s.V1_foam, s.V1_foam_oil, dt)
        s.V1_foam -= foam
        s.V1_foam_oil -= oil
        s.V1_oil += oil
        s.V1_gas += foam - oil
        foam, oil = lost_foam(kind, rate, power, reference, s.V2_foam, s.V2_foam_oil, dt)
        s.V2_foam -= foam
        s.V2_foam_oil -= oil
        s.V2_oil += oil
        s.V2_gas += foam - oil
        foam, oil = lost_foam(kind, rate, power, reference, s.V3_foam, s.V3_foam_oil, dt)
        s.V3_foam -= foam
        s.V3_foam_oil -= oil
        s.V3_oil += oil

    @njit
    def dissolve(d: Any, s: Any, kind: Any, rate: Any, dt: Any) -> None:
        reserve = max(0.0, d.V_reserve - s.V3_oil - s.V3_foam)
        if kind == HENRY:
            # Henry: what dissolves in a time goes with the absolute pressure of the gas; only the loaded chamber has more.
            pressure = abs(s.F_fluid) / d.A_2 / ATMOSPHERE
            rate *= 1.0 + 0.5 * pressure
        left = s.V_cav * (1.0 - math.exp(-rate * dt))
        if kind == HENRY:
            room = s.V1_gas + s.V2_gas + reserve
            first = 0.0 if room <= 0.0 else left * s.V1_gas / room
            second = 0.0 if room <= 0.0 else left * s.V2_gas / room
        else:
            room = s.V1_gas + s.V2_gas
            first = 0.0 if room <= 0.0 else min(s.V1_gas, left * s.V1_gas / room)
            second = 0.0 if room <= 0.0 else min(s.V2_gas, left * s.V2_gas / room)
        third = min(left - first - second, reserve)
        s.V1_gas -= first
        s.V1_oil += first
        s.V2_gas -= second
        s.V2_oil += second
        s.V3_oil += third
        s.V_cav -= first + second + third

    @njit
    def leak(p: Any, s: Any, kind: Any, size: Any, dz: Any, v: Any, dt: Any) -> None:
        if kind == FILM:
            # The film that the rod carries through the seal, thicker the faster it goes out (Landau, Levich: here a root)
            if dz > 0.0:
                s.V3_oil -= min(s.V3_oil, size * dz * math.sqrt(abs(v)))
        elif s.F_fluid > 0.0 and v > 0.0:
            # Pressure above the guide drives oil past a cut seal as through an orifice
            gone = min(s.V1_oil, size * math.sqrt(s.F_fluid / 1000.0) * dt)
            s.V1_oil -= gone
            s.V1_gas += gone

    @njit
    def mount_force(o: Any, e: Any, rate: Any, e_turn: Any, F_turn: Any, direction: Any) -> Any:
        elastic = o[7] * e + o[8] * e * e * e + o[9] * rate
        if o[10] <= 0.0:
            return elastic, 0.0
        # Berg (1998): from the last reversal (e_turn, F_turn) on, F = F_turn + x / (x_2 (1 - m) + x) (F_f - F_turn)
        way = abs(e - e_turn)
        m = direction * F_turn / o[10]
        rub = F_turn + way / (o[11] * (1.0 - m) + way) * (direction * o[10] - F_turn)
        return elastic + rub, rub

    @njit
    def surplus(
        p: Any, d: Any, s: Any, o: Any, trial: Any, before: Any, dt: Any, z: Any, speed: Any, up: Any, down: Any,
        e: Any, e_turn: Any, F_turn: Any, rub: Any, direction: Any,
    ) -> Any:  # fmt: skip
        """Force of the mount less that of the damper [N] at the piston's velocity `trial`, deflection, its way, friction."""
        at = s.z + dt * ((1.0 - THETA) * before + THETA * trial)
        k = up if trial >= 0.0 else down
        F = fluid_force(p, trial) * k + stribeck(p, trial) * dahl(p, d, s.F_D, at - s.z) + d.c_gas * at
        now = z - at
        way = 1.0 if now >= e else -1.0
        turn, F_from = (e_turn, F_turn) if way == direction else (e, rub)
        held, rubbing = mount_force(o, now, speed - trial, turn, F_from, way)
        return held - F, now, way, rubbing

    @njit
    def run(p: Any, d: Any, s: Any, f: Any, t: Any, z: Any, v: Any, o: Any, out: Any) -> Any:
        before = v[0]
        up, down = 1.0, 1.0
        e, e_turn, F_turn, rub, direction = 0.0, 0.0, 0.0, 0.0, 1.0
        for i in range(len(t)):
            dt = t[i] - t[i - 1] if i > 0 else 0.0
            goal, speed = z[i], v[i]
            if o[7] > 0.0 and dt > 0.0:
                # Implicit: the piston's velocity at which mount and damper pull alike (Illinois' variant of the secant)
                guess, width = before + speed - v[i - 1], 0.01
                low, high = guess - width, guess + width
                G_low = surplus(p, d, s, o, low, before, dt, z[i], speed, up, down, e, e_turn, F_turn, rub, direction)[0]
                G_high = surplus(p, d, s, o, high, before, dt, z[i], speed, up, down, e, e_turn, F_turn, rub, direction)[0]
                while (G_low < 0.0 or G_high > 0.0) and width < 100.0:
                    width *= 4.0
                    if G_low < 0.0:
                        low = guess - width
                        G_low = surplus(
                            p, d, s, o, low, before, dt, z[i], speed, up, down, e, e_turn, F_turn, rub, direction
                        )[0]
                    else:
                        high = guess + width
                        G_high = surplus(
                            p, d, s, o, high, before, dt, z[i], speed, up, down, e, e_turn, F_turn, rub, direction
                        )[0]
                trial, now, way, rubbing, side = guess, e, direction, rub, 0
                for _ in range(60):
                    trial = 0.5 * (low + high) if G_low == G_high else (low * G_high - high * G_low) / (G_high - G_low)
                    G, now, way, rubbing = surplus(
                        p, d, s, o, trial, before, dt, z[i], speed, up, down, e, e_turn, F_turn, rub, direction
                    )
                    if abs(G) < 1e-6 or high - low < 1e-10:
                        break
                    if G > 0.0:
                        low, G_low = trial, G
                        if side == 1:
                            G_high *= 0.5
                        side = 1
                    else:
                        high, G_high = trial, G
                        if side == -1:
                            G_low *= 0.5
                        side = -1
                if way != direction:
                    e_turn, F_turn, direction = e, rub, way
                e, rub = now, rubbing
                goal, speed = z[i] - now, trial
            dz = goal - s.z
            if not step(p, d, s, f, goal, before, speed):
                return i
            if speed >= 0.0:
                up = s.k_degr
            else:
                down = s.k_degr
            out[0, i] = s.k_degr
            out[1, i] = s.F_fluid
            out[2, i] = s.F_friction
            out[3, i] = s.F_gas
            out[4, i] = goal
            out[5, i] = speed
            out[6, i] = s.V1_oil + s.V2_oil + s.V3_oil + s.V1_foam_oil + s.V2_foam_oil + s.V3_foam_oil
            before = speed
            if o[0] > 0.0:
                settle_foam(p, s, o[0], o[1], o[2], dt)
            if o[3] > 0.0 and s.V_cav > 0.0:
                dissolve(d, s, o[3], o[4], dt)
            if o[5] > 0.0:
                leak(p, s, o[5], o[6], dz, speed, dt)
        return len(t)

    return run
