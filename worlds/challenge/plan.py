"""What a test engineer would have decided before the campaign: damper, states, velocities, motion, sampling, noise."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from twintube.dampers import Damper, load
from worlds.bench.motions import Piece, joined, rest, road, step_of, sweep, swing, triangle
from worlds.bench.plan import RNG, Motion, Record, chance, span
from worlds.bench.sampler import Recorder

SPEEDS = (0.052, 0.08, 0.131, 0.196, 0.262, 0.393, 0.524, 0.786, 1.048, 1.31, 1.572)  # [m/s]
RATES = (100.0, 128.0, 200.0, 250.0, 256.0, 300.0, 500.0, 512.0, 1000.0, 1024.0, 2000.0, 2048.0, 4000.0, 5000.0)  # [Hz]
MOST_SAMPLES = 300_000  # of a dataset
MOST_RECORDS = 20
SAMPLINGS = ("point", "mean", "filtered")
FORMATS = ("csv", "parquet", "german", "tabs")  # that hold any column
STYLES = ("amplitude", "frequency", "triangle", "sweep", "random")
HARMONIC = ("amplitude", "frequency")
ONE_KIND = 0.12  # share of the campaigns with the intact state alone, and of those without it


@dataclass(frozen=True)
class Order:
    """What a record is to be: style and size, without its samples."""

    style: str
    speed: float  # [m/s] largest
    reach: float  # [m] amplitude, or the largest stroke of styles that change it
    slow: float  # [m/s] preconditioning
    turns: int  # oscillations of the preconditioning
    rest: float  # [s] between preconditioning and block
    hertz: float  # of the style `frequency`
    cut: bool  # the preconditioning is not in the file
    count: int  # oscillations of the block
    seed: int  # of the noise


@dataclass(frozen=True)
class Bench:
    """One campaign."""

    damper: Damper
    orders: tuple[Order, ...]
    records: tuple[Record, ...]
    style: str
    history: bool  # the preconditioning is in the files
    recorder: Recorder
    noise: float  # share of the RMS force
    by_record: bool  # the share holds for each record, else for all of them together
    colour: float  # correlation of the noise from sample to sample
    zero: float  # scatter of the records' zeros, largest share of the peak force
    bits: int
    stroke_noise: float  # [m]
    format: str
    temperatures: bool  # start temperatures are given
    velocity_column: bool
    volumes: bool  # oil in mL
    milliseconds: bool
    largest: float = 0.0  # [N] of all records, nothing hidden

    @property
    def states(self) -> tuple[str, ...]:
        """Intact, degraded or both."""
        return tuple(sorted({"intact" if record.preload else "degraded" for record in self.records}))

    @property
    def reach(self) -> float:
        """Largest stroke [m]."""
        return max(order.reach for order in self.orders)


def motion(order: Order, longest: float, coarser: float = 1.0) -> Motion:
    """The motion of an order; `longest` [s] is the longest step."""
    dt, slow_dt = step_of(order.speed, longest, coarser), step_of(order.slow, longest, coarser)
    v, pause = order.speed, max(order.rest, dt)
    settling = [swing(order.slow, order.reach, order.turns, slow_dt), rest(pause, pause)]
    return joined([*settling, block(order, v, dt)], 2 if order.cut else 0)


def block(order: Order, v: float, dt: float) -> Piece:
    """What is measured."""
    if order.style == "triangle":
        return triangle(v, order.reach, 4 * order.count, dt, order.reach / v / 6.0)
    if order.style == "sweep":
        top = max(v / (2 * np.pi * order.reach), 0.45)
        return sweep(v, order.reach, 0.3, top, seconds=4.0 + 1.5 * order.count, dt=dt)
    if order.style == "random":
        return road(np.random.default_rng(order.seed), v, order.reach, 6.0 + order.count, dt)
    return swing(v, v / (2 * np.pi * order.hertz) if order.style == "frequency" else order.reach, order.count, dt)


def damper_for(needs: frozenset[str], rng: RNG) -> Damper:
    """One of the eight that can show the cause."""
    names = [f"SA{i}" for i in range(1, 9)]
    dampers = [load(name, as_published=True) for name in names]
    if "cavitation" in needs:
        dampers = [d for d in dampers if d.parameters.v_cav > 0.0 and d.parameters.Y_Re_cav > 0.0]
    return dampers[int(rng.integers(len(dampers)))]


def levels_for(needs: frozenset[str], rng: RNG) -> list[float]:
    """Oil levels, 1 is the intact state with its preload."""
    count = int(rng.integers(1, 4))
    degraded = sorted((float(x) for x in rng.choice(np.arange(35, 81), count, replace=False) / 100.0), reverse=True)
    draw = rng.random()
    if draw < ONE_KIND and not needs & {"degraded", "foam", "cavitation"}:
        return [1.0]
    if draw > 1.0 - ONE_KIND and "intact" not in needs:
        return degraded
    return [1.0, *degraded]


def orders_for(damper: Damper, style: str, cut: bool, needs: frozenset[str], rng: RNG) -> tuple[list[Order], float]:
    """One order for each velocity, and the largest stroke [m]."""
    reach = round(0.045 * float(rng.choice([1.0, 1.0, rng.uniform(0.55, 1.0)])), 4)
    hertz = 0.0
    speeds: list[float] = []
    if "single_speed" in needs:
        speeds = [float(rng.choice(SPEEDS[5:9]))]
    else:
        count = int(rng.integers(3, 9))
        least = 3 if chance(rng, 0.3) else 0
        speeds = sorted(float(v) for v in rng.choice(SPEEDS[least:], min(count, len(SPEEDS) - least), replace=False))
        if "fast" in needs and speeds[-1] < 1.2 * damper.parameters.v_cav:
            speeds[-1] = 1.572
    if style == "frequency":
        hertz = round(max(speeds) / (2 * np.pi * reach), 3)
    slow = 0.05 if chance(rng, 0.5) else round(rng.uniform(0.03, 0.048), 3)
    rest = float(rng.choice([0.0, rng.uniform(0.5, 5.0)]))
    if "rest" in needs:
        rest = rng.uniform(3.0, 20.0)
    full = chance(rng, 0.6)
    orders = []
    for v in speeds:
        own = style if style != "mixed" else "amplitude"
        count = 19 if own == "amplitude" and full else int(rng.integers(5, 16))
        if "single_speed" in needs:
            count = int(rng.integers(60, 101))
        turns = 6 if full else int(rng.integers(3, 7))
        orders.append(Order(own, v, reach, slow, turns, rest, hertz, cut, count, int(rng.integers(1 << 30))))
    if style == "mixed":
        speed, seed = float(np.median(speeds)), int(rng.integers(1 << 30))
        orders.append(Order("random", speed, reach, slow, 6, rest, 0.0, cut, 20, seed))
    return orders, reach


def bench_for(needs: frozenset[str], cut: bool | None, rng: RNG, formats: Sequence[str] = FORMATS) -> Bench:
    """A campaign that can show a cause with these needs; `cut` None draws whether the preconditioning is in the files."""
    damper = damper_for(needs, rng)
    styles = HARMONIC if needs & {"sine", "single_speed"} else STYLES
    weights = np.array([0.42 if s == "amplitude" else 0.1 for s in styles])
    style = str(rng.choice([*styles, "mixed"], p=[*(0.9 * weights / weights.sum()), 0.1]))
    if "single_speed" in needs:
        style = "amplitude"
    cut = chance(rng, 0.15) if cut is None else cut
    levels = levels_for(needs, rng)
    if "single_speed" in needs:
        levels = levels[:1] if chance(rng, 0.7) else levels[:2]
    orders, reach = orders_for(damper, style, cut, needs, rng)
    pairs = [(level, order) for level in levels for order in orders][:MOST_RECORDS]
    if len(levels) > 1:  # of every state as many velocities, from the fastest on
        kept = orders[-max(2, MOST_RECORDS // len(levels)) :]
        pairs = [(level, order) for level in levels for order in kept]
    given = chance(rng, 0.5)
    warm = rng.uniform(0.0, 15.0) if given and chance(rng, 0.5) else 0.0
    records, began = [], 0.0
    for i, (level, order) in enumerate(pairs):
        m = motion(order, 0.01, 20.0)
        label = "rnd" if order.style == "random" and style == "mixed" else f"{order.speed:.3f}"
        temperature = round(23.0 + rng.uniform(-0.8, 0.8) + (warm * rng.uniform(0, 1) if warm else 0.0), 1)
        kind = "harmonic" if order.style in HARMONIC else "stochastic"
        name = f"{'int' if level == 1.0 else 'deg'}{100 * level:03.0f}_{label}"
        records.append(Record(name, i, kind, level, level == 1.0, temperature, began))
        began += float(m.time[-1] - m.time[m.first]) + 2.0
    allowed = [fs for fs in RATES if fs * began <= MOST_SAMPLES] or [RATES[0]]
    fastest = max(order.speed for order in orders) / reach
    enough = [fs for fs in allowed if fs > 12.0 * fastest / (2 * np.pi)] or allowed[-1:]
    recorder = Recorder(
        float(rng.choice(enough)), str(rng.choice(SAMPLINGS)), both=chance(rng, 0.7), late=chance(rng, 0.5),
        jitter=float(rng.choice([0.0, rng.uniform(0.0005, 0.008)])),
    )  # fmt: skip
    return Bench(
        damper, tuple(order for _, order in pairs), tuple(records), style, not cut, recorder,
        noise=span(rng, 0.003, 0.03), by_record=chance(rng, 0.3),
        colour=float(rng.choice([0.0, 0.0, 0.0, rng.uniform(0.5, 0.9)])), zero=rng.uniform(0.0, 0.003),
        bits=int(rng.choice([12, 14, 16, 16])), stroke_noise=float(rng.choice([0.0, 2e-6, 1e-5])),
        format=str(rng.choice(formats)), temperatures=given, velocity_column=chance(rng, 0.15),
        volumes=chance(rng, 0.2), milliseconds=chance(rng, 0.2),
    )  # fmt: skip
