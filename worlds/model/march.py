"""The paper's kernel over a motion, with changes of its volumes between two steps, or with a mount at the rod.

The equations of flows and forces are the kernel's. A march with neither acts nor mount is the kernel's own, step by step.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from twintube.common.arrays import Array
from twintube.core.publishing import NAMES as COLUMNS
from twintube.dampers import Damper
from twintube.engine import compiled
from twintube.engine.simulate import at_rest, rows
from worlds.bench.plan import with_numba as njit
from worlds.model.kernel import kernel

# Between two acts upon the volumes, whichever takes longer: a time [s], or a stroke [m] that a long time at rest cuts short.
CHUNK, WAY, LONG = 0.004, 0.002, 0.05
WIDEST = 100.0  # [m/s] around the expected velocity within which the piston is sought
EXACT, FINEST = 1e-6, 1e-10  # [N] and [m/s] to which it is
THETA = 0.55  # of the implicit step with a mount: above 0.5 the stiff mode is damped
PARTS = {"k_degr": "k_degr", "fluid": "F_fluid", "friction": "F_friction", "gas": "F_gas"}


@dataclass(frozen=True)
class Moment:
    """What an act sees: the kernel's volumes `s` and constants `d`, and what the rod did since the last act."""

    s: Any
    d: Any
    dt: float  # [s]
    out: float  # [m] of stroke out of the damper
    speed: float  # [m/s] mean size
    fluid: float  # [N] mean force of the fluid
    size: float  # [N] mean size of that force


Act = Callable[[Moment], None]


@dataclass(frozen=True)
class Mount:
    """A mount between rod and rig; force over deflection e: k e + k_3 e^3 + c de/dt + friction as Berg (1998) writes it."""

    stiffness: float  # [N/m]
    cubic: float = 0.0  # [N/m3]
    damping: float = 0.0  # [N s/m]
    friction: float = 0.0  # [N] at large amplitude
    half_way: float = 1e-4  # [m] deflection at which half of the friction has come back after a reversal


def collapsed(m: Moment, gone: Callable[[float, float], tuple[float, float]]) -> None:
    """Foam becomes oil and gas: `gone` tells of foam and the oil in it [m3] what is lost of both."""
    for chamber in ("V1", "V2", "V3"):
        foam, oil = gone(float(m.s[f"{chamber}_foam"]), float(m.s[f"{chamber}_foam_oil"]))
        m.s[f"{chamber}_foam"] -= foam
        m.s[f"{chamber}_foam_oil"] -= oil
        m.s[f"{chamber}_oil"] += oil
        if chamber != "V3":
            m.s[f"{chamber}_gas"] += foam - oil


def march(
    damper: Damper, time: Array, stroke: Array, velocity: Array, acts: Sequence[Act] = (), *, mount: Mount | None = None
) -> dict[str, Array]:
    """Drive the damper over times [s], strokes [m] and velocities [m/s], (n,) each: its PARTS, stroke and velocity.

    Raises ArithmeticError where a step of the kernel fails.
    """
    n = len(time)
    if mount is not None:
        p, d, s, f = rows(at_rest(damper, float(stroke[0])))
        kernel().fill(p, d, s, stroke[0])
        m = np.array([mount.stiffness, mount.cubic, mount.damping, mount.friction, mount.half_way])
        values = np.empty((6, n))
        done = mounted()(p, d, s, f, time, stroke, velocity, m, values)
        found: dict[str, Array] = dict(zip((*PARTS, "stroke", "velocity"), values, strict=True))
    else:
        out = np.empty((n, len(COLUMNS)))
        done = in_chunks(damper, time, stroke, velocity, acts, out=out)
        found = {name: out[:, COLUMNS.index(column)].copy() for name, column in PARTS.items()}
        found |= {"stroke": stroke, "velocity": velocity}
    if done < n:
        raise ArithmeticError(f"step {done} of {damper.name} could not be finished")
    return found


def in_chunks(damper: Damper, t: Array, z: Array, v: Array, acts: Sequence[Act], *, out: Array) -> int:
    """The kernel over a few samples, then the acts upon its volumes, and so on; returns the samples done."""
    p, d, s, f = (compiled.as_row(record)[0] for record in at_rest(damper, float(z[0])))
    run, n = compiled.module().run_record, len(t)
    passed = np.cumsum(np.minimum(np.diff(t) / CHUNK, np.abs(np.diff(z)) / WAY + np.diff(t) / LONG))
    cuts = [*(np.flatnonzero(np.diff(np.floor(passed), prepend=0.0)) + 1).tolist(), n] if acts else [n]
    first = 0
    for last in cuts:
        low = max(0, first - 1)
        block = np.empty((last - low, len(COLUMNS)))
        warm = np.full(last - low, damper.parameters.T_curve)
        done = run(p, d, s, f, t[low:last], z[low:last].copy(), v[low:last].copy(), warm, block)
        out[first:last] = block[first - low :]
        if done < last - low:
            return int(low + done)
        steps, fluid = np.diff(z[low:last]), block[:, COLUMNS.index("F_fluid")]
        moment = Moment(s, d, float(t[last - 1] - t[low]), float(steps[steps > 0.0].sum()),
                        float(np.abs(v[low:last]).mean()), float(fluid.mean()), float(np.abs(fluid).mean()))  # fmt: skip
        for act in acts:
            act(moment)
        first = last
    return n


@cache
def balance() -> Any:
    """The compiled balance of mount and damper."""
    dahl, stribeck, fluid_force = kernel().dahl, kernel().stribeck, kernel().fluid_force

    @njit
    def mount_force(m: Any, e: Any, rate: Any, e_turn: Any, F_turn: Any, direction: Any) -> Any:  # noqa: PLR0917 - compiled
        elastic = m[0] * e + m[1] * e * e * e + m[2] * rate
        if m[3] <= 0.0:
            return elastic, 0.0
        # Berg (1998): from the last reversal (e_turn, F_turn) on, F = F_turn + x / (x_2 (1 - q) + x) (F_f - F_turn)
        way = abs(e - e_turn)
        q = direction * F_turn / m[3]
        rub = F_turn + way / (m[4] * (1.0 - q) + way) * (direction * m[3] - F_turn)
        return elastic + rub, rub

    @njit
    def surplus(  # noqa: PLR0913, PLR0917 - compiled
        p: Any, d: Any, s: Any, m: Any, trial: Any, before: Any, dt: Any, z: Any, speed: Any, k: Any, h: Any
    ) -> Any:
        """Force of the mount less that of the damper [N] at the piston's velocity `trial`, deflection, its way, friction.

        `k` are the factors out and in, `h` the mount's last deflection, its last turn and the force there, friction, way.
        """
        at = s.z + dt * ((1.0 - THETA) * before + THETA * trial)
        F = fluid_force(p, trial) * (k[0] if trial >= 0.0 else k[1]) + stribeck(p, trial) * dahl(p, d, s.F_D, at - s.z)
        F += d.c_gas * at
        now = z - at
        way = 1.0 if now >= h[0] else -1.0
        turn, F_from = (h[1], h[2]) if way == h[4] else (h[0], h[3])
        held, rubbing = mount_force(m, now, speed - trial, turn, F_from, way)
        return held - F, now, way, rubbing

    return surplus


@cache
def mounted() -> Any:
    """The compiled loop with a mount."""
    step, surplus = kernel().step, balance()

    @njit
    def run(  # noqa: PLR0913, PLR0917 - compiled
        p: Any, d: Any, s: Any, f: Any, t: Any, z: Any, v: Any, m: Any, out: Any
    ) -> Any:
        before = v[0]
        k, h = np.ones(2), np.array([0.0, 0.0, 0.0, 0.0, 1.0])
        for i in range(len(t)):
            dt = t[i] - t[i - 1] if i > 0 else 0.0
            goal, speed = z[i], v[i]
            if dt > 0.0:
                # Implicit: the piston's velocity at which mount and damper pull alike (Illinois' variant of the secant)
                guess, width = before + speed - v[i - 1], 0.01
                low, high = guess - width, guess + width
                G_low = surplus(p, d, s, m, low, before, dt, z[i], speed, k, h)[0]
                G_high = surplus(p, d, s, m, high, before, dt, z[i], speed, k, h)[0]
                while (G_low < 0.0 or G_high > 0.0) and width < WIDEST:
                    width *= 4.0
                    low, high = (guess - width, high) if G_low < 0.0 else (low, guess + width)
                    G_low = surplus(p, d, s, m, low, before, dt, z[i], speed, k, h)[0]
                    G_high = surplus(p, d, s, m, high, before, dt, z[i], speed, k, h)[0]
                trial, now, way, rubbing, side = guess, h[0], h[4], h[3], 0
                for _ in range(60):
                    trial = 0.5 * (low + high) if G_low == G_high else (low * G_high - high * G_low) / (G_high - G_low)
                    G, now, way, rubbing = surplus(p, d, s, m, trial, before, dt, z[i], speed, k, h)
                    if abs(G) < EXACT or high - low < FINEST:
                        break
                    if G > 0.0:
                        low, G_low = trial, G
                        G_high *= 0.5 if side == 1 else 1.0
                        side = 1
                    else:
                        high, G_high = trial, G
                        G_low *= 0.5 if side == -1 else 1.0
                        side = -1
                if way != h[4]:
                    h[1], h[2], h[4] = h[0], h[3], way
                h[0], h[3] = now, rubbing
                goal, speed = z[i] - now, trial
            if not step(p, d, s, f, goal, before, speed):
                return i
            k[0 if speed >= 0.0 else 1] = s.k_degr
            out[0, i], out[1, i], out[2, i], out[3, i] = s.k_degr, s.F_fluid, s.F_friction, s.F_gas
            out[4, i], out[5, i] = goal, speed
            before = speed
        return len(t)

    return run
