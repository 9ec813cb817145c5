"""Faults of the measurement, and troubles outside the catalogue.

Sources: data sheets of strain-gauge load cells (zero and span drift, overload), LVDT practice (span error), logger practice
(clocks of 0.1 to 0.5 %, lost samples), rig practice (clevis play, resonance of cell and crosshead, hum of the mains).
"""

import numpy as np
from scipy.signal import cont2discrete, lfilter, ss2tf

from twintube.arrays import Array
from twintube.dampers import Damper, load
from twintube.lab.challenge.march import Between, march
from twintube.lab.challenge.run import Constants, Run, with_numba


def offset(run: Run, x: float, c: Constants) -> None:
    """The cell reads `x` [N] too much, in every record."""
    run.force = run.force + c["sign"] * x


def offset_later(run: Run, x: float, c: Constants) -> None:
    """The cell was set to zero anew in the middle of the campaign: wrong by `x` [N] from a record on."""
    if run.record.number >= c["from"]:
        offset(run, x, c)


def gain(run: Run, x: float, c: Constants) -> None:
    """The cell reads 1 + x times the force."""
    run.force = run.force * (1.0 + c["sign"] * x)


def bent_gain(run: Run, x: float, c: Constants) -> None:
    """As `gain`, in full at small forces and two thirds of it at 5 kN: shunt calibration of a cell that is not straight."""
    run.force = run.force * (1.0 + c["sign"] * x * (1.0 - np.minimum(np.abs(run.force) / 15e3, 0.5)))


def flip_force(run: Run, x: float, c: Constants) -> None:
    """Tension is negative, in every record."""
    run.force = -run.force


def flip_some(run: Run, x: float, c: Constants) -> None:
    """Tension is negative in some files."""
    if run.record.number in c["files"]:
        run.force = -run.force


def flip_stroke(run: Run, x: float, c: Constants) -> None:
    """The stroke is positive in compression."""
    run.stroke = -run.stroke


def force_late(run: Run, x: float, c: Constants) -> None:
    """The force channel is `x` [s] late, as behind a filter of constant group delay."""
    run.force = np.interp(run.time - x, run.time, run.force)


def stroke_late(run: Run, x: float, c: Constants) -> None:
    """The stroke channel is `x` [s] late, as a converter that is read in turn."""
    run.stroke = np.interp(run.time - x, run.time, run.stroke)


def wrong_unit(run: Run, x: float, c: Constants) -> None:
    """A unit by name, another by number."""
    run.unit = (c["force"], c["stroke"])


def wrong_unit_some(run: Run, x: float, c: Constants) -> None:
    """As `wrong_unit`, in some files."""
    if run.record.number in c["files"]:
        wrong_unit(run, x, c)


def stroke_gain(run: Run, x: float, c: Constants) -> None:
    """The stroke channel reads 1 + x times the stroke."""
    run.stroke = run.stroke * (1.0 + c["sign"] * x)


def string_pot(run: Run, x: float, c: Constants) -> None:
    """A string at a slant: its length follows the stroke with a gain and a slight bend."""
    run.stroke = run.stroke * (1.0 + c["sign"] * x) * (1.0 + 0.1 * x * run.stroke / c["reach"])


def drift(run: Run, x: float, c: Constants) -> None:
    """The zero drifts by `x` [N/s] from the start of each record."""
    run.force = run.force + c["sign"] * x * (run.time - run.start)


def drift_on(run: Run, x: float, c: Constants) -> None:
    """The zero drifts on over all records, whose rests are short."""
    run.force = run.force + c["sign"] * x * (run.record.began + run.time - run.start)


def warming_cell(run: Run, x: float, c: Constants) -> None:
    """The cell warms up in each record: drift `x` [N/s] at first, settling with a time constant."""
    run.force = run.force + c["sign"] * x * c["settling"] * (
        1.0 - np.exp(-np.maximum(run.time - run.start, 0) / c["settling"])
    )


def force_clock(run: Run, x: float, c: Constants) -> None:
    """The force channel's clock runs fast by `x`: the sample said to be at t was taken at t / (1 + x)."""
    rate = 1.0 + c["sign"] * x
    run.force_time = lambda t: t / rate


def lost_samples(run: Run, x: float, c: Constants) -> None:
    """The force channel loses a sample now and then, `x` of its samples in all."""
    every = 1.0 / (x * c["fs"])
    run.force_time = lambda t: t + np.floor(t / every) / c["fs"]


def odd_state(run: Run, x: float, c: Constants) -> None:
    """The file was taken in another state: `x` [1] more or less oil, without preload."""
    if run.record.number == c["file"]:
        level = run.record.level - x if run.record.level - x >= 0.25 else min(run.record.level + x, 0.97)
        forces_of(run, run.damper.with_(oil_level=level, gas_preload=0))


def odd_setting(run: Run, x: float, c: Constants) -> None:
    """The file was taken at another setting of the valves: forces of both branches times 1 + x or 1 - x."""
    if run.record.number == c["file"]:
        p, factor = run.damper.parameters, 1.0 + c["sign"] * x
        scaled = {name: tuple(factor * F for F in getattr(p, name)) for name in ("F_re", "F_co")}
        forces_of(run, run.damper.with_(**scaled))


def odd_damper(run: Run, x: float, c: Constants) -> None:
    """The file is of another damper."""
    if run.record.number == c["file"]:
        state = {"oil_level": run.record.level, "gas_preload": int(run.record.preload)}
        forces_of(run, load(c["damper"], as_published=True).with_(**state))


def forces_of(run: Run, damper: Damper) -> None:
    """The forces of another damper over the run's motion."""
    m = run.motion
    parts = march(damper, m.time, m.stroke, m.velocity, Between())
    run.force = parts["fluid"] + parts["friction"] + parts["gas"]


def clipping(run: Run, x: float, c: Constants) -> None:
    """The amplifier ends at 1 - x of the largest force of the campaign."""
    run.force = np.clip(run.force, -(1.0 - x) * c["largest"], (1.0 - x) * c["largest"])


def played(F: Array, t: Array, gap: float, stroke: Array, out: Array) -> None:
    """Clevis play: the force passes zero over the stroke `gap` [m]."""
    taken = 0.0
    for i in range(len(F)):
        if i > 0:
            taken = min(gap, max(0.0, taken + stroke[i] - stroke[i - 1]))
        free = 1.0 - (taken / gap if F[i] > 0.0 else 1.0 - taken / gap)
        out[i] = F[i] * (1.0 - free)


def backlash(run: Run, x: float, c: Constants) -> None:
    """Play of `x` [m] in the clevis: after a reversal the force comes over that stroke."""
    out = np.empty_like(run.force)
    with_numba(played)(run.force, run.time, x, run.stroke, out)
    run.force = out


def resonance(run: Run, x: float, c: Constants) -> None:
    """Cell and crosshead ring: the share `x` of the force passes a resonance of 40 to 150 Hz."""
    omega, zeta, dt = 2 * np.pi * c["hertz"], c["zeta"], 2e-4
    grid = np.arange(run.time[0], run.time[-1], dt)
    A, B = np.array([[0.0, 1.0], [-(omega**2), -2 * zeta * omega]]), np.array([[0.0], [omega**2]])
    a, b, cc, d, _ = cont2discrete((A, B, np.array([[1.0, 0.0]]), np.zeros((1, 1))), dt)
    top, bottom = ss2tf(a, b, cc, d)
    F = np.interp(grid, run.time, run.force)
    rung = lfilter(top[0], bottom, F - F[0]) + F[0]
    run.force = run.force + x * (np.interp(run.time, grid, rung) - run.force)


def hum(run: Run, x: float, c: Constants) -> None:
    """`x` [N] of the mains, and a third of it at three times the frequency."""
    phase = 2 * np.pi * c["mains"] * (run.time + run.record.began)
    run.force = run.force + x * (np.sin(phase) + np.sin(3 * phase + 1.0) / 3.0)


def coarse(run: Run, x: float, c: Constants) -> None:
    """A converter with steps of `x` [N]."""
    run.force = x * np.round(run.force / x)


def dropouts(run: Run, x: float, c: Constants) -> None:
    """The force channel holds its value or falls to zero for the share `x` of the time."""
    rng = np.random.default_rng([c["seed"], run.record.number])
    starts = run.start + rng.uniform(0, 1, 400) * (run.time[-1] - run.start)
    length = x * (run.time[-1] - run.start) / 6.0
    force = run.force.copy()
    for start in starts[:6]:
        inside = (run.time >= start) & (run.time < start + length)
        if inside.any():
            force[inside] = 0.0 if c["to_zero"] else force[np.argmax(inside)]
    run.force = force
