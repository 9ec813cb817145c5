"""The forces as the measuring channels see them: what they add to a simulated force, and what they change of its motion."""

from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import fields
from functools import lru_cache

import numpy as np

from twintube.common.arrays import Array
from twintube.core import effects
from twintube.dampers import Damper
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.rules import RULES
from twintube.fitting.averaging import averaged_means
from twintube.fitting.simulation import SimulatedRecords

# What a sample holds beside the force at its time: of the mean over its interval, and of the bends of the force a sample
# ahead, about it and before, as a filter gives them. None of them is late: the delay is a parameter of its own.
BENDS = {"bend_ahead": 1, "bend_about": 0, "bend_before": -1}
SAMPLING = ("sample_mean", *BENDS)
# What it changes of the motion under which the force is seen; a simulation of its own for each value.
STROKE_GAIN, TIME_BASE, DELAY, CLOCK = "stroke_gain", "time_base", "channel_delay", "clock_error"
TARE = "tare"  # of the gas force, by which the load cell was set to zero with the damper in it
INERTIA = "clamp_inertia"  # mass [kg] that moves with the stroke between the load cell and the damper
AS_RECORDED = {STROKE_GAIN: 1.0, TIME_BASE: 1.0, DELAY: 0.0, CLOCK: 0.0, INERTIA: 0.0}  # where they change nothing
REMEMBERED = 32  # latest simulations
MOVED = 4  # latest delays and clocks: that of the sampling is in every model


class SeenRecords(SimulatedRecords):
    """Records laid end to end, and their simulated forces as they are recorded.

    `usual` holds values of the measurement where no others are given, see sampling.py; `used` (n,) what is compared.
    """

    def __init__(self, damper: Damper, records: Sequence[PreparedRecord], usual: Mapping[str, float] | None = None) -> None:
        super().__init__(damper, records, parts=RULES.steps_per_interval, failed=RULES.failed_force)
        self.records = list(records)
        self.usual = dict(usual or {})
        lengths = np.diff(self.starts)
        first, last = np.repeat(self.starts[:-1], lengths), np.repeat(self.starts[1:] - 1, lengths)
        self.shifted = {by: np.clip(np.arange(len(self.z)) + by, first, last) for by in range(-2, 3)}
        self.elapsed = np.concatenate([r.time - r.begin for r in records])
        self.used = np.concatenate([r.judged for r in records])
        self.known = {item.name for item in fields(effects.Parameters)}
        self.alone = True  # one simulation at a time, whose records run side by side
        self.fills: dict[str, tuple[int, Array]] = {}  # what of a state is given a value, and of which records (r,)
        # The measurement's parameters need no simulation of their own.
        self.simulated: Callable[[tuple[tuple[str, float], ...]], tuple[Array, Array]] = lru_cache(REMEMBERED)(self.simulate)
        self.moved: Callable[[float, float], tuple[Array, Array]] = lru_cache(MOVED)(self.motion_moved)

    def damping(self, values: Mapping[str, float]) -> tuple[tuple[str, float], ...]:
        """The values that need a simulation: those of the damper's parameters and of the motion that it sees."""
        values = {**self.usual, **values}
        named = {n: x for n, x in values.items() if n in self.known or n in self.fills}
        named |= {n: values[n] for n, neutral in AS_RECORDED.items() if values.get(n, neutral) != neutral}
        return tuple(sorted(named.items()))

    def simulate(self, changes: Sequence[tuple[str, float]], states: Array | None = None) -> tuple[Array, Array]:
        """Mean forces over the intervals and those of the samples alone, both (n,) [N], with values changed.

        `states` (r, 4) are those of the records where they are not given.
        """
        values = dict(changes)
        gain, base, delay, clock, mass = (values.pop(name, x) for name, x in AS_RECORDED.items())
        filled = {name: values.pop(name) for name in self.fills if name in values}
        if filled:
            states = self.filled(filled)
        z, v = self.moved(delay, clock) if delay or clock else (self.z, self.v)
        motion = (self.t / base, z / gain, v * (base / gain))
        force, point, _ = self.sampled(self.rows(), values.items(), motion, states, side_by_side=self.alone)
        if mass:
            accelerations = self.accelerations(motion[2])
            force, point = force + mass * accelerations[0], point + mass * accelerations[1]
        force = self.averaged_samples(force)
        for record, a, b in zip(self.records, self.starts[:-1], self.starts[1:], strict=True):
            for some in (force, point) if record.averaged else ():
                some[a:b] = averaged_means(record.time, some[a:b], record.averaged)
        return force, point

    def motion_moved(self, delay: float, clock: float) -> tuple[Array, Array]:
        """Strokes [m] and velocities [m/s] (n,) at the moments when the forces were measured."""
        strokes, speeds = zip(*(record.moved(delay, clock) for record in self.records), strict=True)
        return np.concatenate(strokes), np.concatenate(speeds)

    def averaged_samples(self, force: Array) -> Array:
        """Mean forces (n,) [N] of samples that are means about their times: they reach half a sample beyond an interval."""
        before, after = np.roll(force, 1), np.roll(force, -1)
        inside = self.used & np.roll(self.used, 1) & np.roll(self.used, -1)
        wider = (before - 2.0 * force + after) / (4.0 * np.maximum(self.samples, 1))
        return np.asarray(force + np.where(inside, wider, 0.0))

    def forces(self, values: Mapping[str, float]) -> Array:
        """Predicted mean forces (n,) [N], measurement included."""
        return self.observed(*self.simulated(self.damping(values)), values)

    def observed(self, force: Array, point: Array, values: Mapping[str, float]) -> Array:
        """Forces (n,) [N] with what the measurement adds to mean forces and those of samples (n,) [N]."""
        values = {**self.usual, **values}
        seen = point + sum(values[name] * part for name, part in self.parts_of_samples(force, point, values).items())
        zero = values.get("force_offset", 0.0) + values.get("zero_drift", 0.0) * self.elapsed
        if TARE in values:
            zero = zero + values[TARE] * self.pressed(values)
        return np.asarray(values.get("force_gain", 1.0) * seen + zero)

    def filled(self, values: Mapping[str, float]) -> Array:
        """The states (r, 4) of the records with what is given of their fills."""
        states = self.states.copy()
        for name in self.fills.keys() & values.keys():
            column, which = self.fills[name]
            states[which, column] = values[name]
        return states

    def pressed(self, values: Mapping[str, float]) -> Array:
        """By how much [N] (n,) the gas pushes out the rod of a damper at rest."""
        states = self.filled(values)
        return np.asarray(np.repeat(self.damper.parameters.F_0 * states[:, 1] * states[:, 2], np.diff(self.starts)))

    def accelerations(self, speed: Array) -> tuple[Array, Array]:
        """Mean accelerations [m/s2] over the intervals and at their samples alone, both (n,), from speeds [m/s] (n,)."""
        change, span = (np.diff(x, prepend=x[0]) for x in (speed, self.t))
        inside = np.ones(len(speed), dtype=bool)
        inside[self.starts[:-1]] = False
        mean = np.where(inside, change / np.where(inside, span, 1.0), 0.0)
        # The samples lie half of their period behind the middle of the interval.
        ahead = (mean[self.shifted[1]] - mean) / (2.0 * np.maximum(self.samples, 1))
        return mean, mean + np.where(inside, ahead, 0.0)

    def parts_of_samples(self, force: Array, point: Array, names: Container[str] = SAMPLING) -> dict[str, Array]:
        """What each of SAMPLING that is among `names` adds to the forces of samples that are points (n,) [N].

        An anti-alias filter near the sampling rate reaches over some samples; of an interval of many it changes little.
        """
        parts: dict[str, Array] = {"sample_mean": force - point} if "sample_mean" in names else {}
        for name, by in BENDS.items():
            if name in names:
                after, about, before = (force[self.shifted[by + side]] for side in (1, 0, -1))
                parts[name] = (after - 2.0 * about + before) / np.maximum(self.samples, 1) ** 2
        return parts
