"""The kernel driven over records: stroke and velocity in, forces and volumes out."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from twintube.common.arrays import Array
from twintube.core import effects, messages, model
from twintube.core.agreement import Agreement, ways
from twintube.core.checks import TEMPERATURE, VELOCITY, bad_input, outside, problems
from twintube.core.frame import stroke_limit
from twintube.core.kernel.temperature import ROUNDING
from twintube.core.publishing import NAMES
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import Damper, load
from twintube.dampers.damper import refuse
from twintube.engine import compiled, loops
from twintube.engine.simulation import Simulation
from twintube.errors import InputError as InputError  # noqa: PLC0414  # others have it from here
from twintube.errors import InputWarning


@runtime_checkable
class Motion(Protocol):
    """What holds a whole motion, such as a signal of the rig."""

    @property
    def time(self) -> Array:
        """(n,) [s]."""

    @property
    def stroke(self) -> Array:
        """(n,) [m]."""

    @property
    def velocity(self) -> Array:
        """(n,) [m/s]."""


def checked(stroke: ArrayLike, velocity: ArrayLike, limit: float) -> tuple[Array, Array]:
    """Stroke [m] and velocity [m/s] as arrays (n,); raises InputError at the first sample that is not admissible."""
    # Copies: the result keeps them.
    z = np.array(stroke, dtype=float, order="C")
    v = np.array(velocity, dtype=float, order="C")
    if z.ndim != 1 or z.shape != v.shape or z.size == 0:
        raise InputError(f"stroke {z.shape} and velocity {v.shape} must be arrays of one length above 0")
    for i in np.flatnonzero(~(np.abs(z) <= limit) | ~((v >= VELOCITY["lower"]) & (v <= VELOCITY["upper"])))[:1]:
        raise InputError(f"sample {i}: " + bad_input(float(z[i]), float(v[i]), limit))
    return z, v


def at_rest(damper: Damper, z: float) -> list[Any]:
    """The kernel's records p, d, s, f with the damper at rest at the stroke `z` [m]; raises ParameterError."""
    p = damper.parameters
    refuse(damper.name, problems(p))
    d, s, f = blank(Derived), blank(effects.State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, z)
    return [p, d, s, f]


def checked_time(damper: Damper, time: ArrayLike | None, size: int) -> Array:
    """Times [s] (n,), zeros where the damper needs none; raises InputError where it does or where time goes back."""
    if time is None:
        needing = effects.needing_time(damper.parameters)
        if needing:
            raise InputError(
                f"a record without time, but {', '.join(needing)} of {damper.name} acts with time: "
                "give the times of the samples"
            )
        return np.zeros(size)
    t = np.array(time, dtype=float, order="C")
    if t.shape != (size,):
        raise InputError(f"time {t.shape} and stroke ({size},) must be arrays of one length")
    for i in np.flatnonzero(~np.isfinite(t))[:1]:
        raise InputError(f"sample {i}: time = {t[i]:g} s is not a number")
    for i in np.flatnonzero(np.diff(t) < 0.0)[:1]:
        raise InputError(f"sample {i + 1}: time = {t[i + 1]:g} s is before {t[i]:g} s")
    return t


def checked_temperature(damper: Damper, temperature: ArrayLike | None, size: int) -> Array:
    """Temperatures [K] (n,), that of the parameters where none is given; raises InputError."""
    if temperature is None:
        return np.full(size, damper.parameters.T_curve)
    given = np.asarray(temperature, dtype=float)
    if given.shape not in ((), (size,)):
        raise InputError(f"temperature {given.shape} must be one number or an array of the length of the stroke, ({size},)")
    low, high = TEMPERATURE["lower"], TEMPERATURE["upper"]
    kelvins = np.array(np.broadcast_to(given, (size,)), order="C")
    for i in np.flatnonzero(~((kelvins >= low) & (kelvins <= high)))[:1]:
        raise InputError(f"sample {i}: " + outside("temperature", float(kelvins[i]), low, high, "K"))
    return kelvins


def beyond_law(damper: Damper, result: Simulation) -> str:
    """What to warn of where the law of a damper does not hold at its temperature; else empty."""
    p, kelvins = damper.parameters, result.T_oil
    for i in np.flatnonzero((kelvins < p.T_cold - ROUNDING) | (kelvins > p.T_hot + ROUNDING))[:1]:
        return f"sample {i}: " + messages.BEYOND_LAW % (float(kelvins[i]), p.T_cold, p.T_hot)
    return ""


def started(
    damper: Damper, stroke: ArrayLike, velocity: ArrayLike, time: ArrayLike | None
) -> tuple[list[Any], Array, Array, Array]:
    """The kernel's records at the first sample, and the checked record: time, stroke, velocity."""
    p, d, s, f = at_rest(damper, 0.0)
    z, v = checked(stroke, velocity, stroke_limit(d))
    t = checked_time(damper, time, len(z))
    model.start(p, d, s, float(z[0]))
    return [p, d, s, f], t, z, v


def rows(records: list[Any]) -> list[Any]:
    """The records as compiled code takes them."""
    return [compiled.as_row(record)[0] for record in records]


def finished(done: int, z: Array) -> None:
    """Raise InputError if not all samples were done."""
    if done < len(z):
        raise InputError(f"sample {done}: the step could not be split finely enough; please report this parameter set")


def disagreement(time: Array, stroke: Array, velocity: Array, *, interpreted: bool = False) -> str:
    """What to warn of where the velocity [m/s] does not belong to the stroke [m] at the times [s], all (n,); else empty."""
    a = blank(Agreement)
    if interpreted:
        found = loops.first_parted(a, time.tolist(), stroke.tolist(), velocity.tolist())
    else:
        row = compiled.as_row(a)[0]
        found = compiled.module().first_parted(row, *map(np.ascontiguousarray, (time, stroke, velocity)))
        a = Agreement(*row.item())
    return messages.parted(float(time[found]), *ways(a)) if found >= 0 else ""


def simulate(
    damper: Damper | str | Path,
    stroke: ArrayLike | Motion,
    velocity: ArrayLike | None = None,
    time: ArrayLike | None = None,
    *,
    temperature: ArrayLike | None = None,
    interpreted: bool = False,
) -> Simulation:
    """Simulate a record from rest at its first sample.

    Where a time is given, a velocity that does not belong to the stroke (sign, unit, connection) is warned of, once. So is
    a temperature beyond the law of the damper.

    Args:
        damper: parameters and condition (oil level, gas preload), or the name or file of a parameter set.
        stroke: (n,) [m], positive in rebound, 0 in the middle position; or a signal, which has velocity and time too.
        velocity: (n,) [m/s], positive in rebound; between two samples it changes evenly.
        time: (n,) [s], not falling; needed only where the damper has an effect that acts with time.
        temperature: [K] one or (n,), of oil, seals and gas, or around a damper that keeps its heat; it holds until the next
            sample. That of the parameters if left out.
        interpreted: run the kernel in plain Python instead of C; the result is the same to the last bit.

    Raises:
        InputError: a sample is not finite or out of range, the piston would leave the tube, or a needed time is missing.
        ParameterError: the parameters are not admissible.

    Warns:
        InputWarning: velocity and stroke do not belong together, or the law of the damper does not hold at a temperature.

    """
    damper = load(damper)
    if isinstance(stroke, Motion):
        signal = stroke
        stroke, velocity, time = signal.stroke, signal.velocity, signal.time
    elif velocity is None:
        raise InputError("velocity is missing: simulate takes stroke, velocity and time, or a signal that has all three")
    result = simulate_quietly(damper, stroke, velocity, time, temperature=temperature, interpreted=interpreted)
    texts = [beyond_law(damper, result)]
    if time is not None:
        t = np.asarray(time, dtype=float)
        texts.append(disagreement(t, result.stroke, result.velocity, interpreted=interpreted))
    for text in filter(None, texts):
        warnings.warn(text, InputWarning, stacklevel=2)
    return result


def simulate_quietly(
    damper: Damper,
    stroke: ArrayLike,
    velocity: ArrayLike,
    time: ArrayLike | None = None,
    *,
    temperature: ArrayLike | None = None,
    interpreted: bool = False,
) -> Simulation:
    """As `simulate`, for motions that were looked at already: without a warning."""
    records, t, z, v = started(damper, stroke, velocity, time)
    kelvins = checked_temperature(damper, temperature, len(z))
    out = np.empty((len(z), len(NAMES)))
    if interpreted:
        p, d, s, f = records
        done = loops.run_record(p, d, s, f, t.tolist(), z.tolist(), v.tolist(), kelvins.tolist(), out)
    else:
        done = compiled.module().run_record(*rows(records), t, z, v, kelvins, out)
    finished(done, z)
    columns: dict[str, Any] = {name: out[:, i] for i, name in enumerate(NAMES)}
    if time is None:
        columns["heat_flow"] = np.full(len(z), np.nan)  # no rate without a time
    return Simulation(stroke=z, velocity=v, time=None if time is None else t, **columns)


def work_between(
    damper: Damper, stroke: Array, velocity: Array, marks: NDArray[np.int64], time: Array | None = None
) -> Array:
    """Work [J] dissipated between the samples `marks` (m,), shape (m-1,); as `simulate`, without the other outputs."""
    records, t, z, v = started(damper, stroke, velocity, time)
    out = np.empty(len(marks))
    finished(compiled.module().run_work(*rows(records), t, z, v, marks, out), z)
    return np.diff(out)
