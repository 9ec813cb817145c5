"""From the rig's motion to the sampled channels: the plain model of twintube, with causes around it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import butter, lfilter, lfilter_zi

from twintube import simulate
from twintube.core.kernel import step
from twintube.core.kernel.forces import dahl, fluid_force, stribeck
from twintube.dampers import Damper
from twintube.engine import compiled
from twintube.engine.loops import COLUMNS
from twintube.engine.simulate import at_rest
from twintube.lab.workshop.cause import Cause, Channels, Rubber, Run, Trial

Array = NDArray[np.float64]
CHUNK = 0.004  # [s] between two acts of a cause on the volumes


@dataclass(frozen=True)
class Recorder:
    """Sampling at `fs` [Hz]: points, the mean force since the sample before, or a filter before the sampling."""

    fs: float
    kind: str  # points, means, filter
    corner: float  # of the filter over fs


def curve(damper: Damper, v: Array) -> Array:
    """Fluid force (n,) [N] of the intact damper (equation 3 of the paper), the last segment going on."""
    p = damper.parameters
    speed = np.abs(v)
    sides = []
    for velocities, forces in ((p.v_re, p.F_re), (p.v_co, p.F_co)):
        x, y = np.append(0.0, velocities), np.append(0.0, forces)
        keep = np.append(True, np.diff(x) > 0)
        x, y = x[keep], y[keep]
        slope = (y[-1] - y[-2]) / (x[-1] - x[-2])
        sides.append(np.interp(speed, x, y) + slope * np.maximum(speed - x[-1], 0.0))
    result: Array = np.where(v >= 0, sides[0], -sides[1])
    return result


def drive(trial: Trial, damper: Damper, causes: list[Cause]) -> Run:
    """Move the damper by the trial's stroke with the causes at work."""
    true = damper.with_(oil_level=trial.level, gas_preload=int(trial.preload))
    x = trial.x
    for cause in causes:
        true = cause.damper(true, trial)
        x = cause.path(x, trial)
    v = np.gradient(x, 1.0 / trial.rate)
    rubber = next((cause.rubber for cause in causes if cause.rubber is not None), None)
    inside = [cause for cause in causes if cause.acts_inside]
    if rubber is not None:
        run = through_rubber(trial, true, x, v, rubber)
    elif inside:
        run = in_chunks(trial, true, x, v, inside)
    else:
        s = simulate(true, x, v)
        found = (s.k_degr, s.F_fluid, s.F_friction, s.F_gas, s.V3_gas)
        k, fluid, friction, gas, reserve = (np.array(values, dtype=np.float64) for values in found)
        run = Run(trial, true, x, v, curve(true, v), k, fluid, friction, gas, reserve, np.zeros(len(x)))
    for cause in causes:
        cause.force(run)
    return run


def in_chunks(trial: Trial, damper: Damper, z: Array, v: Array, causes: list[Cause]) -> Run:
    """The kernel over a few samples, then the causes on its volumes, and so on."""
    p, d, s, f = (compiled.as_row(record)[0] for record in at_rest(damper, float(z[0])))
    march, t = compiled.module().run_record, trial.time
    size, n = max(1, round(CHUNK * trial.rate)), len(z)
    out = np.empty((n, len(COLUMNS)))
    for first in range(0, n, size):
        last, low = min(n, first + size), max(0, first - 1)
        block = np.empty((last - low, len(COLUMNS)))
        march(p, d, s, f, t[low:last], z[low:last].copy(), v[low:last].copy(), block)
        out[first:last] = block[first - low :]
        way = float(np.abs(np.diff(z[low:last])).sum())
        fluid = float(np.abs(block[:, 2]).mean())
        for cause in causes:
            cause.act(s, d, trial, (last - first) / trial.rate, way, fluid)
    column: dict[str, Array] = {name: out[:, i] for i, name in enumerate(COLUMNS)}
    return Run(trial, damper, z, v, curve(damper, v), column["k_degr"], column["F_fluid"], column["F_friction"],
               column["F_gas"], column["V3_gas"], np.zeros(n))  # fmt: skip


def through_rubber(trial: Trial, damper: Damper, x: Array, v: Array, rubber: Rubber) -> Run:
    """Damper and mount in series, solved implicitly at each step for the deflection u of the mount.

    F_damper(z, z') = k u + k3 u^3 + c u', z = x - u (Kelvin-Voigt; Dixon, The Shock Absorber Handbook, "Installation").
    """
    p, d, s, f = at_rest(damper, float(x[0]))
    dt, n = 1.0 / trial.rate, len(x)
    u = s.F_gas / rubber.stiffness
    p, d, s, f = at_rest(damper, float(x[0] - u))
    parts = np.zeros((n, 6))
    speed = 0.0
    for i in range(n):
        u0 = u
        for _ in range(25):
            w = v[i] - (u - u0) / dt
            z = x[i] - u
            friction_0 = dahl(p, d, s.F_D, z - s.z)
            friction = stribeck(p, w) * friction_0
            fluid = fluid_force(p, w) * s.k_degr
            up = rubber.stiffness * u + rubber.cubic * u**3 + rubber.damping * (u - u0) / dt
            missing = fluid + friction + d.c_gas * z - d.F_0 - up
            c = abs(fluid_force(p, w + 1e-4) - fluid_force(p, w)) / 1e-4 * s.k_degr + rubber.damping
            soft = max(0.0, 1.0 - (1.0 if z > s.z else -1.0) * friction_0 / d.F_FrS)
            slope = rubber.stiffness + 3 * rubber.cubic * u * u + c / dt + p.sigma_0 * soft + d.c_gas
            u += missing / slope
            if abs(missing) < 1e-6:
                break
        w = v[i] - (u - u0) / dt
        step(p, d, s, f, float(x[i] - u), speed if i else w, float(w))
        speed = float(w)
        parts[i] = (s.z, w, s.k_degr, s.F_fluid, s.F_friction, s.F_gas)
    z_, w_, k, fluid_, friction_, gas = parts.T.copy()
    return Run(trial, damper, z_, w_, curve(damper, w_), k, fluid_, friction_, gas, np.zeros(n), np.zeros(n))


def sampled(channels: Channels, recorder: Recorder, causes: list[Cause]) -> tuple[Array, Array, Array]:
    """Time [s], stroke [m] and force [N] of the file, without noise."""
    many = round(channels.trial.rate / recorder.fs)
    stroke, force = channels.stroke, channels.force
    if recorder.kind == "filter":
        b, a = butter(3, recorder.corner / many * 2)
        zi = lfilter_zi(b, a)
        stroke, force = (lfilter(b, a, y, zi=zi * y[0])[0] for y in (stroke, force))
    at = np.arange(0, len(stroke), many)
    points = force[at]
    if recorder.kind == "means" and many > 1:
        total = np.append(0.0, np.cumsum(force))
        points = np.append(force[0], (total[at[1:] + 1] - total[at[1:] + 1 - many]) / many)
    for cause in causes:
        points = cause.sampled(points, channels.trial, recorder.fs)
    return at / channels.trial.rate * channels.factor, stroke[at], points


def measure(trial: Trial, damper: Damper, causes: list[Cause], recorder: Recorder) -> tuple[Array, Array, Array]:
    """Drive and sample one record."""
    run = drive(trial, damper, causes)
    channels = Channels(trial, trial.x.copy(), run.force)
    for cause in causes:
        cause.measure(channels)
    return sampled(channels, recorder, causes)
