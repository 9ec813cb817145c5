"""Records one after the other on one day, and what a cause changes in them."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from scipy.signal import lfilter

from twintube.common.arrays import Array
from worlds.bench.plan import RNG, Motion
from worlds.bench.sampler import converted
from worlds.imperfect.bench import COOLING, STROKE_STEP, THERMOCOUPLE, Bench, Fault, Test, noise, recorded, warmed
from worlds.imperfect.law import RATE, Law, State, through_mount

CALIBRATION: Final = 0.004  # of the gain from day to day, never more than 1 %
UNRECORDED: Final = 3.0  # [K] by which the oil gets warmer between two records: some 10 K in a session
PAUSES: Final = (20.0, 180.0)  # [s] between two records


@dataclass(frozen=True)
class Day:
    """What changes from one day to the next."""

    gain: float
    zero: float  # [N]
    room: float  # [degC]


@dataclass(frozen=True)
class Recording:
    """One record as the bench writes it: arrays (m,), SI units."""

    name: str
    measurement: str
    time: Array
    stroke: Array
    force: Array
    temperature: Array | None
    start_temperature: float
    reference: bool
    clean: Array  # force without noise, zero and gain of the day
    plain: Array  # the same without the cause
    period: float
    steady: int  # sample from which cycles are equal
    moved: tuple[Array, ...] = ()  # `clean` with other oil levels


def draw_day(rng: RNG) -> Day:
    """Within the tolerances of a bench that is looked after."""
    gain = 1.0 + float(np.clip(rng.normal(0.0, CALIBRATION), -0.01, 0.01))
    return Day(gain, float(rng.normal(0.0, 3.0)), float(rng.uniform(17.0, 28.0)))


def part(state: State, begin: float, end: float) -> State:
    """The state in a record that takes the session from share `begin` to `end`."""
    level_end = state.oil_level if state.oil_level_end is None else state.oil_level_end
    low, high = (state.oil_level + q * (level_end - state.oil_level) for q in (begin, end))
    # A run heats fast at first and towards a balance; air leaves at a rate.
    (cold, hot), (air, left) = state.heating, state.dead_stroke
    heat = [cold + (hot - cold) * (1.0 - float(np.exp(-2.5 * q))) for q in (begin, end)]
    aired = [air * (left / air) ** q if air > 0.0 else 0.0 for q in (begin, end)]
    return replace(
        state, oil_level=low, oil_level_end=high if high != low else None, heating=(heat[0], heat[1]),
        dead_stroke=(aired[0], aired[1]),
    )  # fmt: skip


@dataclass(frozen=True)
class Driven:
    """What a damper does in a record, arrays (n,) at RATE."""

    force: Array
    plain: Array  # the same without the cause, at the stroke that is read
    felt: Array | float  # temperature of the oil [degC]
    moved: tuple[Array, ...] = ()  # `force` with other oil levels


Damper = Callable[[int, Motion], Driven]  # the first argument is the number of the record in the session


def session(
    rng: RNG, bench: Bench, day: Day, tests: list[Test], fault: Fault, *, damper: Damper, reference: bool
) -> list[Recording]:
    """Records one after the other on one day."""
    out: list[Recording] = []
    for i, test in enumerate(tests):
        motion, driven = test.motion, damper(i, test.motion)
        loose = np.cumsum(rng.random(len(motion.time)) < 1.0 / RATE) % 2  # about once a second
        contact = np.asarray(fault.contact * loose, dtype=float)
        time, stroke, clean = recorded(bench, fault, motion, driven.force, contact)
        moved = tuple(recorded(bench, fault, motion, other, contact)[2] for other in driven.moved)
        n, zero = len(clean), day.zero + float(rng.normal(0.0, 1.5))
        measured = day.gain * clean + zero + noise(bench, n, rng)
        stroke = converted(stroke + bench.stroke_noise * rng.standard_normal(n), STROKE_STEP)
        felt = np.broadcast_to(driven.felt, motion.time.shape)
        surface = lfilter([1.0], [THERMOCOUPLE * RATE, 1.0 - THERMOCOUPLE * RATE], felt - felt[0]) + felt[0] - 1.0
        shown = np.interp(time + motion.time[motion.first], motion.time, surface) if bench.temperature == "column" else None
        before = recorded(bench, Fault(), motion, driven.plain)[2]
        steady = max(0, motion.steady - motion.first) * bench.rate // RATE
        out.append(Recording(test.name, test.measurement, time, stroke, measured, shown, round(float(felt[0]), 1), reference,
                             clean, before, motion.period, steady, moved))  # fmt: skip
    return out


def specimen_on(
    rng: RNG, law: Law, bench: Bench, day: Day, *, count: int, state: State, fault: Fault, levels: tuple[float, ...] = ()
) -> Damper:
    """A specimen in a session of `count` records; `levels` are those for which `moved` is to be told."""
    oil = float(day.room + rng.uniform(0.0, 4.0))

    def damper(i: int, motion: Motion) -> Driven:
        nonlocal oil
        z, warmth, acting = motion.stroke, warmed(law, bench, motion, oil, day.room), part(state, i / count, (i + 1) / count)
        felt = warmth + np.linspace(*acting.heating, len(z))
        force = through_mount(law, acting, bench.compliance, z, felt)[0]
        read = fault.sign * fault.stroke_gain * z  # what the damper would do at the stroke that is read
        same = state == State() and fault.stroke_gain == fault.sign == 1
        plain = force if same else through_mount(law, State(), bench.compliance, read, warmth)[0]
        moved = tuple(through_mount(law, replace(acting, oil_level=x), bench.compliance, z, felt)[0] for x in levels)
        # Setting up and repeats that nobody keeps warm it, too.
        oil = rng.uniform(0.0, UNRECORDED) + day.room + (warmth[-1] - day.room) * np.exp(-rng.uniform(*PAUSES) / COOLING)
        return Driven(force, plain, felt, moved)

    return damper


def change(record: Recording) -> Array:
    """The change of the force by the cause: of its mean cycle where there are cycles, else as it is."""
    difference = record.clean - record.plain
    samples = record.period / (record.time[1] - record.time[0])
    steady = difference[record.steady :]
    if samples == 0.0 or len(steady) < 2 * samples:
        return difference
    phase = (np.arange(len(steady)) / samples % 1.0 * 64).astype(int)
    return np.asarray(np.bincount(phase, steady, 64) / np.maximum(np.bincount(phase, minlength=64), 1))


def over_noise(recordings: list[Recording], bench: Bench) -> float:
    """RMS of the change of mean-cycle force over the RMS of the noise."""
    return float(np.sqrt(np.mean([np.mean(change(item) ** 2) for item in recordings])) / bench.noise_rms)
