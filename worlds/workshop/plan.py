"""What the laboratory does on a day: damper, states, excitation, sampling, noise. Drawn without knowing the cause."""

from dataclasses import dataclass

import numpy as np

from twintube import load
from twintube.dampers import Damper
from worlds.bench.motions import V_SLOW, Piece, joined, rest, road, sweep, swing, triangle
from worlds.bench.plan import RNG, Motion, Record, chance, span
from worlds.bench.sampler import Recorder

FINE = 4000.0  # least rate of the fine grid [Hz]
VDA = (0.052, 0.131, 0.262, 0.393, 0.524, 1.05)  # [m/s]
STYLES = ("frequencies", "velocities", "velocities", "triangles", "sweep", "road", "mixed", "mixed")
RATES = (200.0, 250.0, 400.0, 500.0, 500.0, 1000.0, 1000.0, 1000.0, 2000.0)
MOST = 16  # records
SETTLED = 4.5  # [s] that slow strokes may take; they are faster where they would take longer
PEAK = 3.0  # of the speed on a road, over its RMS
LOW = 0.52  # oil level [1]: one state is below it where a low one is wished
SLOW = 3.0  # [s] of a cycle that need not be repeated
CALM = 0.1  # [m/s] up to which no strokes go before, and a record lasts longer
FILTERING = 500.0  # [Hz] from which a recorder has a filter


@dataclass(frozen=True)
class Wish:
    """What a customer asked for: dampers, style, and whether degraded states, fast strokes or large strokes are needed."""

    dampers: tuple[str, ...] = ("SA1", "SA2", "SA3", "SA4", "SA5", "SA6", "SA7", "SA8")
    styles: tuple[str, ...] = STYLES
    states: int = 0  # least number of degraded states
    speed: float = 0.0  # least of the largest speeds [m/s]
    wide: bool = False
    low: bool = False  # a state with half of the oil or less
    rates: tuple[float, ...] = RATES


@dataclass(frozen=True)
class Day:
    """A measured campaign."""

    damper: Damper
    style: str
    records: list[tuple[Record, Motion]]
    recorder: Recorder
    noise_share: float  # RMS of the noise over the largest force
    noise_memory: float  # of the coloured noise, AR(1); 0 white
    zero: float  # of the load cell over the largest force
    stroke_gain: float
    stroke_noise: float  # [m]

    @property
    def widest(self) -> float:
        """Largest stroke [m]."""
        return max(float(np.abs(motion.stroke).max()) for _, motion in self.records)

    @property
    def seconds(self) -> float:
        """All records together."""
        return sum(float(motion.time[-1]) for _, motion in self.records)

    @property
    def longest_way(self) -> float:
        """Way [m] of the state that moves most."""
        ways: dict[tuple[float, bool], float] = {}
        for record, motion in self.records:
            state = (record.level, record.preload)
            ways[state] = ways.get(state, 0.0) + float(np.abs(np.diff(motion.stroke)).sum())
        return max(ways.values())


def states_of(damper: Damper, draw: RNG, least: int, low: bool) -> list[tuple[float, bool]]:
    """Intact, then one to three degraded states (a few campaigns have none), the preload lost in all of them."""
    count = max(least, int(draw.choice([0, 1, 2, 2, 3])))
    states = [(1.0, True)]
    if chance(draw, 0.5):
        levels = [float(x) for x in draw.choice([0.8, 0.65, 0.5], size=min(count, 3), replace=False)]
    else:
        levels = [round(x, 2) for x in damper.measured_levels][:count]
        levels += [0.75][: count - len(levels)]
    if low and min(levels) > LOW:
        levels[levels.index(min(levels))] = 0.5
    states += [(level, False) for level in sorted(levels, reverse=True)]
    if count and chance(draw, 0.2) and len(states) < 4:
        states.insert(1, (1.0, False))
    return states


def speeds_of(draw: RNG, count: int, fastest: float) -> list[float]:
    """Some of the usual test speeds, the fastest always."""
    usual = [v for v in VDA if v <= fastest + 1e-9]
    if fastest > VDA[-1]:
        usual.append(fastest)
    kept = sorted(draw.choice(len(usual) - 1, size=min(count, len(usual)) - 1, replace=False).tolist())
    return [usual[i] for i in kept] + [usual[-1]]


def cycles_of(speed: float, amplitude: float, block: float) -> int:
    """Cycles of about `block` [s], two at least where they are not slow."""
    period = 2 * np.pi * amplitude / speed
    return max(2 if period < SLOW else 1, round(block / period))


def excitations(
    style: str, amplitude: float, fastest: float, *, draw: RNG, states: int, dt: float, strokes: int
) -> list[tuple[str, str, Motion]]:
    """Name, kind and motion of the excitations that each state is given."""
    count = int(draw.integers(3, 6)) if states < 3 else int(draw.integers(2, 5))
    count = max(min(count, MOST // states), -(-5 // states))
    block = float(draw.uniform(2.6, 4.2))

    def settled(piece: Piece, turns: int = strokes, reach: float = amplitude) -> Motion:
        slow = max(V_SLOW, 2 * np.pi * reach * turns / SETTLED)
        return joined([swing(slow, reach, turns, dt, 0.1), piece] if turns else [rest(0.06, dt), piece])

    def uneven(speed: float, seconds: float) -> Motion:
        return settled(road(draw, PEAK * speed, amplitude, seconds, dt), 1, 0.6 * amplitude)

    def sine(v: float, seconds: float, turns: int = strokes) -> Motion:
        return settled(swing(v, amplitude, cycles_of(v, amplitude, seconds), dt, 0.1), turns)

    plan: list[tuple[str, str, Motion]] = []
    if style in ("velocities", "mixed", "triangles", "recovery"):
        for v in speeds_of(draw, count if style != "mixed" else max(2, count - 1), fastest):
            before, seconds = strokes if v > CALM else 0, max(block, 6.0 if v < CALM else 0.0)
            quarters = 4 * cycles_of(v, 2 * amplitude / np.pi, seconds)
            sharp = style == "triangles"
            motion = settled(triangle(v, amplitude, quarters, dt, 0.014), before) if sharp else sine(v, seconds, before)
            plan.append((f"{1000 * v:.0f}", "harmonic", motion))
        if style == "mixed":
            plan.append(("rd", "stochastic", uneven(0.3 * fastest, 5.5)))
        if style == "recovery":
            fast = swing(fastest, amplitude, cycles_of(fastest, amplitude, 2.2), dt, 0.1)
            slow = swing(max(V_SLOW, 2 * np.pi * amplitude / 2.5), amplitude, 1, dt, 0.1)
            again = joined([slow, fast, rest(float(draw.uniform(1.5, 3.0)), dt), fast])
            plan[-1] = (f"{1000 * fastest:.0f}p", "harmonic", again)
    if style == "frequencies":
        for hertz in fastest / (2 * np.pi * amplitude) * np.geomspace(0.12, 1.0, count):
            motion = sine(float(2 * np.pi * amplitude * hertz), block)
            plan.append((f"{hertz:.1f}Hz".replace(".", "p"), "harmonic", motion))
    if style == "sweep":
        for i, share in enumerate(np.linspace(1.0, 0.35, max(2, count))):
            plan.append(
                (f"sw{i + 1}", "stochastic", settled(sweep(fastest * share, amplitude, 0.6, 12.0, seconds=5.5, dt=dt)))
            )
    if style == "road":
        for i in range(max(2, count)):
            plan.append((f"rd{i + 1}", "stochastic", uneven(fastest * (0.2 + 0.06 * i), 6.0)))
    return plan


def plan_day(seed: int, wish: Wish) -> Day:
    """The campaign of a seed."""
    draw = np.random.default_rng((seed, 77))
    damper = load(str(draw.choice(wish.dampers)), as_published=True)
    style = str(draw.choice(wish.styles))
    fs = float(draw.choice([x for x in wish.rates if x >= (500 if style in ("triangles", "road") else 200)]))
    largest = damper.parameters.stroke_max
    wide = wish.wide or chance(draw, 0.3)
    amplitude = round(float(largest * draw.uniform(0.82, 0.92) if wide else draw.uniform(0.02, 0.6 * largest)), 3)
    tube = 0.5 * (damper.parameters.h_l - damper.parameters.dead_length)
    amplitude = min(amplitude, 0.9 * tube, 0.06)
    fastest = max(wish.speed, float(draw.choice([0.524, 0.786, 1.05, 1.05, 1.31])))
    states = states_of(damper, draw, wish.states, wish.low)
    strokes = int(draw.choice([0, 2, 2, 2, 3]))
    plan = excitations(
        style, amplitude, fastest, draw=draw, states=len(states), dt=1.0 / (fs * np.ceil(FINE / fs)), strokes=strokes
    )
    records: list[tuple[Record, Motion]] = []
    begin, pause = 0.0, float(draw.uniform(3.0, 20.0))
    for level, preload in states:
        for label, kind, motion in plan[: MOST - len(records)]:
            name = f"{len(records) + 1:02d}_{100 * level:.0f}{'' if preload else 'n'}_{label}"
            records.append((Record(name, len(records), kind, level, preload, 20.0, begin), motion))
            begin += float(motion.time[-1]) + pause
    kind = str(draw.choice(["point", "point", "mean", "filtered"] if fs >= FILTERING else ["point", "point", "mean"]))
    recorder = Recorder(fs, kind, float(draw.uniform(0.3, 0.42)), both=kind == "filtered", late=True)
    return Day(
        damper, style, records, recorder, span(draw, 0.002, 0.015), float(draw.choice([0.0, 0.0, 0.0, 0.6, 0.85])),
        float(draw.uniform(-0.002, 0.002)), 1.0 + float(draw.uniform(-5e-4, 5e-4)), float(draw.uniform(0.3e-6, 2e-6)),
    )  # fmt: skip
