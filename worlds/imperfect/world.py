"""The two worlds: one state with unknown fill, and a damper before and after something happened, or nothing."""

from collections.abc import Callable
from dataclasses import asdict, dataclass, fields, replace
from typing import Any, Final

import numpy as np
from scipy.signal import lfilter

from twintube.dampers import names
from worlds.imperfect.bench import (
    AMPLITUDES,
    COOLING,
    SPEEDS,
    STROKE_STEP,
    THERMOCOUPLE,
    Bench,
    Fault,
    Motion,
    draw_bench,
    noise,
    recorded,
    road,
    seen,
    sine,
    triangle,
    warmed,
)  # fmt: skip
from worlds.imperfect.causes import CAUSES, RNG, Cause
from worlds.imperfect.law import RATE, Array, Law, State, through_mount
from worlds.imperfect.specimen import specimen

UNCHANGED: Final = 0.4  # share of before_after in which nothing happened
STATED_WRONGLY: Final = 1 / 3  # share of the unknown fills that the operator calls full with preload
CALIBRATION: Final = 0.004  # of the gain from day to day, never more than 1 %
UNRECORDED: Final = 3.0  # [K] by which the oil gets warmer between two records: some 10 K in a session
MOST_RECORDS: Final = 8
LEVEL_STEP: Final = 0.03  # of the oil, both ways: where this shows, an interval of 0.1 is no feat
PAUSES: Final = (20.0, 180.0)  # [s] between two records
IDENTIFYING: Final = (0.05, 0.131, 0.262, 0.524, 0.786, 1.048, 1.572)


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


@dataclass(frozen=True)
class World:
    """Records and the truth about them."""

    damper: str
    bench: Bench
    stated: tuple[bool, bool]  # whether the file calls the fill of first and later records full with preload
    recordings: list[Recording]
    truth: dict[str, Any]


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


def session(
    rng: RNG, law: Law, bench: Bench, day: Day, motions: list[Motion], state: State, fault: Fault, *, reference: bool,
    levels: tuple[float, ...] = (),
) -> list[Recording]:  # fmt: skip
    """Records one after the other on one day; `levels` are those for which `moved` is to be told."""
    out: list[Recording] = []
    oil, still = float(day.room + rng.uniform(0.0, 4.0)), State()
    for i, motion in enumerate(motions):
        warmth = warmed(law, bench, motion, oil, day.room)
        acting = part(state, i / len(motions), (i + 1) / len(motions))
        extra = np.linspace(*acting.heating, len(motion.z))
        zeros = np.zeros(len(motion.z))
        loose = np.cumsum(rng.random(len(motion.z)) < 1.0 / RATE) % 2  # about once a second
        contact: Array = np.asarray(fault.contact * loose, dtype=float)
        force = through_mount(law, acting, bench.compliance, motion.z, warmth + extra)[0]
        plain = force if state == still else through_mount(law, still, bench.compliance, motion.z, warmth)[0]
        if fault.stroke_gain != 1.0 or fault.sign != 1:  # what the damper would do at the stroke that is read
            plain = through_mount(law, still, bench.compliance, fault.sign * fault.stroke_gain * motion.z, warmth)[0]
        stroke, clean = recorded(bench, motion, *seen(bench, fault, motion.z, force, contact))
        zero = day.zero + float(rng.normal(0.0, 1.5))
        others = [
            through_mount(law, replace(acting, oil_level=x), bench.compliance, motion.z, warmth + extra)[0] for x in levels
        ]
        moved = tuple(recorded(bench, motion, *seen(bench, fault, motion.z, other, contact))[1] for other in others)
        n = len(clean)
        measured = day.gain * clean + zero + noise(bench, n, rng)
        stroke = np.round((stroke + bench.stroke_noise * rng.standard_normal(n)) / STROKE_STEP) * STROKE_STEP
        felt = warmth + extra
        surface = lfilter([1.0], [THERMOCOUPLE * RATE, 1.0 - THERMOCOUPLE * RATE], felt - felt[0]) + felt[0] - 1.0
        shown = np.round(surface[motion.first :: RATE // bench.rate], 1) if bench.temperature == "column" else None
        _, before = recorded(bench, motion, *seen(bench, Fault(), motion.z, plain, zeros))
        out.append(Recording(
            motion.name, motion.measurement, np.arange(n) / bench.rate, stroke, measured, shown, round(float(felt[0]), 1),
            reference, clean, before, motion.period, max(0, motion.steady - motion.first) * bench.rate // RATE,
            moved,
        ))  # fmt: skip
        # Setting up and repeats that nobody keeps warm it, too.
        oil = rng.uniform(0.0, UNRECORDED) + day.room + (warmth[-1] - day.room) * np.exp(-rng.uniform(*PAUSES) / COOLING)
    return out


def change(record: Recording) -> Array:
    """The change of the force by the cause: of its mean cycle where there are cycles, else as it is."""
    difference = record.clean - record.plain
    samples = record.period / (record.time[1] - record.time[0])
    steady = difference[record.steady :]
    if samples == 0.0 or len(steady) < 2 * samples:
        return difference
    phase = (np.arange(len(steady)) / samples % 1.0 * 64).astype(int)
    return np.asarray(np.bincount(phase, steady, 64) / np.maximum(np.bincount(phase, minlength=64), 1))


def programme(rng: RNG, law: Law, bench: Bench, count: int) -> list[Motion]:
    """What an operator drives who wants to see a damper: mostly sines, often a slow motion, sometimes a road."""
    most = 0.9 * law.damper.parameters.stroke_max
    amplitude = float(rng.choice([a for a in AMPLITUDES if a <= most]))
    motions = [triangle(bench, float(rng.choice([2e-3, 4e-3, 5e-3])), amplitude)] if rng.random() < 0.4 and count > 1 else []
    if rng.random() < 0.25 and len(motions) + 1 < count:
        motions.append(road(bench, amplitude, rng))
    left = sorted(rng.choice(SPEEDS, count - len(motions), replace=False))
    if len(left) == 1:  # nobody looks at a damper at walking pace only
        left = [float(rng.choice([0.131, 0.262, 0.524, 1.048]))]
    return motions + [sine(bench, float(v), amplitude) for v in left]


def truth(world: str, seed: int, name: str, off: float, law: Law, bench: Bench, state: State) -> dict[str, Any]:
    """What both worlds tell."""
    level = state.oil_level if state.oil_level_end is None else state.oil_level_end  # what is left at the end
    return {
        "world": world, "seed": seed, "damper": name, "kind": "none", "causes": ["none"], "also_fits": [], "parameters": {},
        "source": "", "oil_level": level, "gas_preload": bool(state.gas_preload), "off_percent": off,
        "effect_over_noise": 0.0, "noise_N": bench.noise_rms, "bench": asdict(bench),
        "law": {
            **{key: law.scale * value for key, value in law.traits.items()}, "lag_s": law.scale * law.lag,
            "lag_order": law.order, "smoothing_m": law.smoothing, "viscosity_per_K": law.viscosity,
        },
    }  # fmt: skip


def over_noise(recordings: list[Recording], bench: Bench) -> float:
    """RMS of the change of mean-cycle force over the RMS of the noise."""
    return float(np.sqrt(np.mean([np.mean(change(item) ** 2) for item in recordings])) / bench.noise_rms)


def level_over_noise(recordings: list[Recording], bench: Bench) -> float:
    """As `over_noise`, of the other oil level in `moved` that changes the force least."""
    others = [[replace(item, plain=item.moved[i]) for item in recordings] for i in range(len(recordings[0].moved))]
    return min(over_noise(some, bench) for some in others)


def begin(seed: int, world: int) -> tuple[RNG, str, Law, float, Bench, str]:
    """Generator, damper, specimen, deviation, bench and which kernel."""
    rng = np.random.default_rng([seed, world])
    name, published = str(rng.choice(names())), bool(rng.random() < 0.3)
    law, off = specimen(rng, name, as_published=published)
    return rng, name, law, off, draw_bench(rng), "as published" if published else "default"


def unknown_fill(seed: int) -> World:
    """One to eight records of a damper at some oil level, with its gas or without, and nobody has looked."""
    rng, name, law, off, bench, kernel = begin(seed, 1)
    level = 1.0 if rng.random() < 0.2 else float(rng.uniform(0.35, 1.0))
    state = State(oil_level=level, gas_preload=int(rng.random() < 0.5))
    motions = programme(rng, law, bench, int(rng.integers(1, MOST_RECORDS + 1)))
    levels = tuple(x for x in (level - LEVEL_STEP, level + LEVEL_STEP) if x <= 1.0)
    recordings = session(rng, law, bench, draw_day(rng), motions, state, Fault(), reference=False, levels=levels)
    told = truth("unknown_fill", seed, name, off, law, bench, state) | {"kernel": kernel}
    if state != State():
        told |= {"kind": "state", "causes": ["state"], "effect_over_noise": over_noise(recordings, bench)}
        told["parameters"] = {"oil_level": level, "gas_preload": state.gas_preload}
    told["level_over_noise"] = level_over_noise(recordings, bench)
    told["level_seen"] = told["level_over_noise"] > 1.0
    wrong = bool(rng.random() < STATED_WRONGLY)
    if not wrong:  # of a fill that nobody has stated, the state and "nothing has changed" are the same answer
        told["also_fits"] = ["none" if told["kind"] == "state" else "state"]
    return World(name, bench, (wrong, wrong), recordings, told | {"stated_as_full": wrong})


def before_after(seed: int) -> World:
    """Reference records as delivered, and later ones of another day, after one cause or none."""
    rng, name, law, off, bench, kernel = begin(seed, 2)
    most = 0.9 * law.damper.parameters.stroke_max
    amplitude = float(rng.choice([a for a in AMPLITUDES[1:] if a <= most]))
    speeds = sorted(float(v) for v in rng.choice(IDENTIFYING[1:], int(rng.integers(2, 4)), replace=False))
    speeds = [0.05, *speeds]
    slow = float(rng.choice([2e-3, 5e-3]))
    first = [triangle(bench, slow, amplitude, "_a"), *(sine(bench, v, amplitude, "_a") for v in speeds)]
    again = sorted(float(v) for v in rng.choice(speeds, int(rng.integers(2, 4)), replace=False))
    later = [sine(bench, v, amplitude, "_b") for v in again]
    if rng.random() < 0.3 and len(first) + len(later) < MOST_RECORDS:
        later.insert(0, triangle(bench, slow, amplitude, "_b"))
    elif rng.random() < 0.3 and len(first) + len(later) < MOST_RECORDS:
        later.append(road(bench, amplitude, rng, "_b"))
    cause: Cause | None = None
    drawn: dict[str, Any] = {}
    if rng.random() >= UNCHANGED:
        weights = np.array([item.weight for item in CAUSES.values()])
        cause = CAUSES[str(rng.choice(list(CAUSES), p=weights / weights.sum()))]
        drawn = cause.draw(rng, law, float(max(np.abs(item.z).max() for item in later)))
    channel = {item.name for item in fields(Fault)}
    state = State(**{key: value for key, value in drawn.items() if key not in channel})
    fault = Fault(**{key: value for key, value in drawn.items() if key in channel})
    before = session(rng, law, bench, draw_day(rng), first, State(), Fault(), reference=True)
    after = session(rng, law, bench, draw_day(rng), later, state, fault, reference=False)
    told = truth("before_after", seed, name, off, law, bench, state) | {"kernel": kernel}
    if cause is not None:
        told |= {"kind": cause.kind, "causes": [cause.name], "also_fits": list(cause.also), "source": cause.source}
        told |= {"parameters": drawn, "effect_over_noise": over_noise(after, bench)}
    wrong = bool(rng.random() < STATED_WRONGLY)
    return World(name, bench, (True, wrong), [*before, *after], told | {"stated_as_full": wrong})


WORLDS: Final[dict[str, Callable[[int], World]]] = {"unknown_fill": unknown_fill, "before_after": before_after}


def make(seed: int, world: str | None = None) -> World:
    """The world of a seed; without a name, even seeds are unknown_fill and odd ones before_after."""
    return WORLDS[world or list(WORLDS)[seed % 2]](seed)
