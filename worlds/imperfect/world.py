"""The worlds: one state with unknown fill, its load cell tared or not; before and after something happened, or nothing."""

from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from twintube.dampers import load, names
from worlds.bench.files import FORCE, LAYOUTS, STROKE, TIME, told, write_dataset, write_truth
from worlds.bench.plan import RNG, chance
from worlds.imperfect.bench import AMPLITUDES, SPEEDS, Bench, Fault, Test, draw_bench, road, sine, triangle
from worlds.imperfect.causes import CAUSES, Cause
from worlds.imperfect.law import Law, State
from worlds.imperfect.session import Recording, draw_day, over_noise, session, specimen_on
from worlds.imperfect.specimen import specimen

STYLES: Final = ("csv", "german", "machine")  # layouts of the recorder
UNCHANGED: Final = 0.4  # share of before_after in which nothing happened
STATED_WRONGLY: Final = 1 / 3  # share of the unknown fills that the operator calls full with preload
MOST_RECORDS: Final = 8
FILLED: Final = 0.05  # of the gas force: filling tolerance and temperature
LEVEL_STEP: Final = 0.03  # of the oil, both ways: where this shows, an interval of 0.1 is no feat
IDENTIFYING: Final = (0.05, 0.131, 0.262, 0.524, 0.786, 1.048, 1.572)


@dataclass(frozen=True)
class World:
    """Records and the truth about them."""

    damper: str
    bench: Bench
    stated: tuple[bool, bool]  # whether the file calls the fill of first and later records full with preload
    recordings: list[Recording]
    truth: dict[str, Any]


def programme(rng: RNG, law: Law, bench: Bench, count: int) -> list[Test]:
    """What an operator drives who wants to see a damper: mostly sines, often a slow motion, sometimes a road."""
    most = 0.9 * law.damper.parameters.stroke_max
    amplitude = float(rng.choice([a for a in AMPLITUDES if a <= most]))
    motions = [triangle(float(rng.choice([2e-3, 4e-3, 5e-3])), amplitude)] if chance(rng, 0.4) and count > 1 else []
    if chance(rng, 0.25) and len(motions) + 1 < count:
        motions.append(road(amplitude, rng))
    left = sorted(rng.choice(SPEEDS, count - len(motions), replace=False))
    if len(left) == 1:  # nobody looks at a damper at walking pace only
        left = [float(rng.choice([0.131, 0.262, 0.524, 1.048]))]
    return motions + [sine(bench, float(v), amplitude) for v in left]


def truth(world: str, seed: int, name: str, *, level: float, preload: bool, bench: Bench) -> dict[str, Any]:
    """What all these worlds tell where nothing is hidden; `level` is what is left at the end."""
    more = {"parameters": {}, "source": "", "oil_level": level, "gas_preload": preload, "effect_over_noise": 0.0,
            "noise_N": bench.noise_rms, "bench": asdict(bench)}  # fmt: skip
    return told(world, seed, name, ["none"], kind="none", more=more)


def of_cause(cause: Cause, drawn: dict[str, Any], after: list[Recording], bench: Bench) -> dict[str, Any]:
    """What they tell of a cause in the later records."""
    names = {"kind": cause.kind, "causes": [cause.name], "also_fits": list(cause.also), "source": cause.source}
    return {**names, "parameters": drawn, "effect_over_noise": over_noise(after, bench)}


def of_specimen(law: Law, off: float, kernel: str) -> dict[str, Any]:
    """What they tell of the specimen."""
    own = {
        **{key: law.scale * value for key, value in law.traits.items()}, "lag_s": law.scale * law.lag,
        "lag_order": law.order, "smoothing_m": law.smoothing, "viscosity_per_K": law.viscosity,
    }  # fmt: skip
    return {"off_percent": off, "law": own, "kernel": kernel}


def level_over_noise(recordings: list[Recording], bench: Bench) -> float:
    """As `over_noise`, of the other oil level in `moved` that changes the force least."""
    others = [[replace(item, plain=item.moved[i]) for item in recordings] for i in range(len(recordings[0].moved))]
    return min(over_noise(some, bench) for some in others)


def begin(seed: int, world: int) -> tuple[RNG, str, Law, float, Bench, str]:
    """Generator, damper, specimen, deviation, bench and which kernel."""
    rng = np.random.default_rng([seed, world])
    name, published = str(rng.choice(names())), chance(rng, 0.3)
    law, off = specimen(rng, name, as_published=published)
    return rng, name, law, off, draw_bench(rng), "as published" if published else "default"


def unknown_fill(seed: int) -> World:
    """One to eight records of a damper at some oil level, with its gas or without, and nobody has looked."""
    rng, name, law, off, bench, kernel = begin(seed, 1)
    level = 1.0 if chance(rng, 0.2) else float(rng.uniform(0.35, 1.0))
    state = State(oil_level=level, gas_preload=int(chance(rng, 0.5)))
    motions = programme(rng, law, bench, int(rng.integers(1, MOST_RECORDS + 1)))
    levels = tuple(x for x in (level - LEVEL_STEP, level + LEVEL_STEP) if x <= 1.0)
    day = draw_day(rng)
    damper = specimen_on(rng, law, bench, day, count=len(motions), state=state, fault=Fault(), levels=levels)
    recordings = session(rng, bench, day, motions, Fault(), damper=damper, reference=False)
    facts = truth("unknown_fill", seed, name, level=level, preload=bool(state.gas_preload), bench=bench)
    facts |= of_specimen(law, off, kernel)
    if state != State():
        facts |= {"kind": "state", "causes": ["state"], "effect_over_noise": over_noise(recordings, bench)}
        facts["parameters"] = {"oil_level": level, "gas_preload": state.gas_preload}
    facts["level_over_noise"] = level_over_noise(recordings, bench)
    facts["level_seen"] = facts["level_over_noise"] > 1.0
    wrong = bool(rng.random() < STATED_WRONGLY)
    if not wrong:  # of a fill that nobody has stated, the state and "nothing has changed" are the same answer
        facts["also_fits"] = ["none" if facts["kind"] == "state" else "state"]
    return World(name, bench, (wrong, wrong), recordings, facts | {"stated_as_full": wrong})


def tared_cell(seed: int) -> World:
    """As `unknown_fill`, on a load cell that was set to zero with the damper in it, at rest in the middle."""
    world, rng = unknown_fill(seed), np.random.default_rng([seed, 3])
    p = load(world.damper).parameters
    gas = p.F_0 * rng.normal(1.0, FILLED) if world.truth["gas_preload"] else 0.0
    read = p.F_FrS * rng.uniform(-1.0, 1.0) - gas
    recordings = [replace(item, force=item.force - read) for item in world.recordings]
    return replace(world, recordings=recordings, truth=world.truth | {"world": "tared_cell", "zero_N": -read})


def before_after(seed: int) -> World:
    """Reference records as delivered, and later ones of another day, after one cause or none."""
    rng, name, law, off, bench, kernel = begin(seed, 2)
    most = 0.9 * law.damper.parameters.stroke_max
    amplitude = float(rng.choice([a for a in AMPLITUDES[1:] if a <= most]))
    speeds = sorted(float(v) for v in rng.choice(IDENTIFYING[1:], int(rng.integers(2, 4)), replace=False))
    speeds = [0.05, *speeds]
    slow = float(rng.choice([2e-3, 5e-3]))
    first = [triangle(slow, amplitude, "_a"), *(sine(bench, v, amplitude, "_a") for v in speeds)]
    again = sorted(float(v) for v in rng.choice(speeds, int(rng.integers(2, 4)), replace=False))
    later = [sine(bench, v, amplitude, "_b") for v in again]
    if chance(rng, 0.3) and len(first) + len(later) < MOST_RECORDS:
        later.insert(0, triangle(slow, amplitude, "_b"))
    elif chance(rng, 0.3) and len(first) + len(later) < MOST_RECORDS:
        later.append(road(amplitude, rng, "_b"))
    cause: Cause | None = None
    drawn: dict[str, Any] = {}
    if rng.random() >= UNCHANGED:
        weights = np.array([item.weight for item in CAUSES.values()])
        cause = CAUSES[str(rng.choice(list(CAUSES), p=weights / weights.sum()))]
        drawn = cause.draw(rng, law, float(max(np.abs(item.motion.stroke).max() for item in later)))
    channel = {item.name for item in fields(Fault)}
    state = State(**{key: value for key, value in drawn.items() if key not in channel})
    fault = Fault(**{key: value for key, value in drawn.items() if key in channel})
    days = draw_day(rng), draw_day(rng)
    new = specimen_on(rng, law, bench, days[0], count=len(first), state=State(), fault=Fault())
    before = session(rng, bench, days[0], first, Fault(), damper=new, reference=True)
    used = specimen_on(rng, law, bench, days[1], count=len(later), state=state, fault=fault)
    after = session(rng, bench, days[1], later, fault, damper=used, reference=False)
    level = state.oil_level if state.oil_level_end is None else state.oil_level_end
    facts = truth("before_after", seed, name, level=level, preload=bool(state.gas_preload), bench=bench)
    facts |= of_specimen(law, off, kernel)
    facts |= {} if cause is None else of_cause(cause, drawn, after, bench)
    wrong = bool(rng.random() < STATED_WRONGLY)
    return World(name, bench, (True, wrong), [*before, *after], facts | {"stated_as_full": wrong})


def write(world: World, output: Path) -> None:
    """Write a world as OUTPUT/dataset and OUTPUT/truth.json."""
    records = []
    for item in world.recordings:
        columns = {TIME: item.time, STROKE: 1e3 * item.stroke, FORCE: item.force}
        if item.temperature is not None:
            columns["temperature [degC]"] = item.temperature
        full = world.stated[0 if item.reference else 1]
        entries: dict[str, Any] = {"measurement": item.measurement, "oil_level": 1.0 if full else "unknown",
                                   "gas_preload": True if full else "unknown"}  # fmt: skip
        entries |= {"reference": True} if item.reference else {}
        entries |= {"start_temperature_degC": item.start_temperature} if world.bench.temperature == "start" else {}
        records.append((item.name, entries, columns))
    write_dataset(output / "dataset", "Damper bench", world.damper, LAYOUTS[STYLES[world.bench.style]], records)
    write_truth(output, world.truth)
