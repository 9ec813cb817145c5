"""What can be wrong with load cell, stroke sensor, clock and frame; each changes the channels of a record in place.

Sources: data sheets of strain-gauge load cells (zero and span drift, overload), LVDT practice (span error), logger practice
(clocks of 0.1 to 0.5 %, lost samples), rig practice (clevis play, resonance of cell and crosshead, hum of the mains).
"""

import numpy as np
from scipy.signal import cont2discrete, lfilter, ss2tf

from twintube.common.arrays import Array
from worlds.bench.plan import Channels, with_numba


def scaled(c: Channels, gain: float = 1.0, zero: float = 0.0, stroke: float = 1.0) -> None:
    """Gain and zero [N] of the load cell, gain of the stroke sensor."""
    c.force, c.stroke = c.force * gain + zero, c.stroke * stroke if stroke != 1.0 else c.stroke


def bent_gain(c: Channels, excess: float) -> None:
    """Gain in full at small forces and two thirds of it at 5 kN: shunt calibration of a cell that is not straight."""
    c.force = c.force * (1.0 + excess * (1.0 - np.minimum(np.abs(c.force) / 15e3, 0.5)))


def string_pot(c: Channels, excess: float, bend: float) -> None:
    """A string at a slant: its length follows the stroke with a gain and a slight bend [1/m]."""
    c.stroke = c.stroke * (1.0 + excess) * (1.0 + bend * c.stroke)


def late(c: Channels, force: float = 0.0, stroke: float = 0.0) -> None:
    """A channel is late by a time [s], as behind a filter of constant group delay or a converter that is read in turn."""
    if force != 0.0:
        c.force = np.interp(c.time - force, c.time, c.force)
    if stroke != 0.0:
        c.stroke = np.interp(c.time - stroke, c.time, c.stroke)


def drift(c: Channels, rate: float, *, carried: bool = False, settling: float = 0.0) -> None:
    """The zero drifts by `rate` [N/s] in each record or over all; with a time constant `settling` [s] at first only."""
    t = c.time - c.start + (c.record.began if carried else 0.0)
    c.force = c.force + rate * (settling * (1.0 - np.exp(-np.maximum(t, 0.0) / settling)) if settling else t)


def fast_clock(c: Channels, excess: float) -> None:
    """The force channel's clock runs fast: the sample said to be at t was taken at t / (1 + excess)."""
    c.force_time = lambda t: t / (1.0 + excess)


def lost_samples(c: Channels, share: float, fs: float) -> None:
    """The force channel loses a sample now and then, a share of them in all."""
    c.force_time = lambda t: t + np.floor(t * share * fs) / fs


def clipped(c: Channels, limit: float) -> None:
    """Load cell or amplifier at its limit [N]."""
    c.force = np.clip(c.force, -limit, limit)


def coarse(c: Channels, step: float) -> None:
    """A converter with large steps [N]."""
    c.force = step * np.round(c.force / step)


def hum(c: Channels, amplitude: float, hertz: float) -> None:
    """The mains [N], and a third of it at three times the frequency."""
    phase = 2 * np.pi * hertz * (c.time + c.record.began)
    c.force = c.force + amplitude * (np.sin(phase) + np.sin(3 * phase + 1.0) / 3.0)


def resonance(c: Channels, hertz: float, zeta: float, share: float = 1.0) -> None:
    """Cell and crosshead ring: a share of the force passes H = w^2 / (s^2 + 2 D w s + w^2)."""
    omega, dt = 2 * np.pi * hertz, 2e-4
    grid = np.arange(c.time[0], c.time[-1], dt)
    A, B = np.array([[0.0, 1.0], [-(omega**2), -2 * zeta * omega]]), np.array([[0.0], [omega**2]])
    a, b, cc, d, _ = cont2discrete((A, B, np.array([[1.0, 0.0]]), np.zeros((1, 1))), dt)
    top, bottom = ss2tf(a, b, cc, d)
    F = np.interp(grid, c.time, c.force)
    rung = lfilter(top[0], bottom, F - F[0]) + F[0]
    c.force = c.force + share * (np.interp(c.time, grid, rung) - c.force)


def dropouts(c: Channels, starts: Array, seconds: Array, *, to_zero: bool) -> None:
    """The force channel falls to zero or holds its value at `starts`, shares of the record, for some `seconds`."""
    force = c.force.copy()
    for start, lasts in zip(c.start + starts * (c.time[-1] - c.start), seconds, strict=True):
        inside = (c.time >= start) & (c.time < start + lasts)
        if inside.any():
            force[inside] = 0.0 if to_zero else force[np.argmax(inside)]
    c.force = force


def played(F: Array, gap: float, stroke: Array, out: Array) -> None:
    """Clevis play: the force passes zero over the stroke `gap` [m]."""
    taken = 0.0
    for i in range(len(F)):
        if i > 0:
            taken = min(gap, max(0.0, taken + stroke[i] - stroke[i - 1]))
        out[i] = F[i] * (taken / gap if F[i] > 0.0 else 1.0 - taken / gap)


def backlash(c: Channels, gap: float) -> None:
    """Play [m] in the clevis: after a reversal the force comes over that stroke."""
    out = np.empty_like(c.force)
    with_numba(played)(c.force, gap, c.stroke, out)
    c.force = out
