"""What the laboratory does on a day: damper, states, excitation, sampling, noise. Drawn without knowing the cause."""

from dataclasses import dataclass, field

import numpy as np

from twintube import load
from twintube.dampers import Damper
from twintube.lab.workshop import motions
from twintube.lab.workshop.bench import Recorder
from twintube.lab.workshop.cause import Array, Trial

FINE = 4000.0  # least rate of the fine grid [Hz]
VDA = (0.052, 0.131, 0.262, 0.393, 0.524, 1.05)  # [m/s]
STYLES = ("frequencies", "velocities", "velocities", "triangles", "sweep", "road", "mixed", "mixed")
RATES = (200.0, 250.0, 400.0, 500.0, 500.0, 1000.0, 1000.0, 1000.0, 2000.0)
MOST = 16  # records


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

    name: str
    damper: Damper
    style: str
    trials: list[Trial]
    recorder: Recorder
    noise_share: float  # RMS of the noise over the largest force
    noise_memory: float  # of the coloured noise, AR(1); 0 white
    zero: float  # of the load cell over the largest force
    stroke_gain: float
    stroke_noise: float  # [m]
    extras: dict[str, float] = field(default_factory=dict)


def states_of(damper: Damper, draw: np.random.Generator, least: int, low: bool) -> list[tuple[float, bool]]:
    """Intact, then one to three degraded states (a few campaigns have none), the preload lost in all of them."""
    count = max(least, int(draw.choice([0, 1, 2, 2, 3])))
    states = [(1.0, True)]
    if draw.random() < 0.5:
        levels = [float(x) for x in draw.choice([0.8, 0.65, 0.5], size=min(count, 3), replace=False)]
    else:
        levels = [round(x, 2) for x in damper.measured_levels][:count]
        levels += [0.75][: count - len(levels)]
    if low and min(levels) > 0.52:
        levels[levels.index(min(levels))] = 0.5
    states += [(level, False) for level in sorted(levels, reverse=True)]
    if count and draw.random() < 0.2 and len(states) < 4:
        states.insert(1, (1.0, False))
    return states


def speeds_of(draw: np.random.Generator, count: int, fastest: float) -> list[float]:
    """Some of the usual test speeds, the fastest always."""
    usual = [v for v in VDA if v <= fastest + 1e-9]
    if fastest > VDA[-1]:
        usual.append(fastest)
    kept = sorted(draw.choice(len(usual) - 1, size=min(count, len(usual)) - 1, replace=False).tolist())
    return [usual[i] for i in kept] + [usual[-1]]


def excitations(
    style: str, amplitude: float, fastest: float, draw: np.random.Generator, states: int, rate: float, strokes: int
) -> list[tuple[str, str, Array]]:
    """Name, kind and stroke of the excitations that each state is given."""
    count = int(draw.integers(3, 6)) if states < 3 else int(draw.integers(2, 5))
    count = max(min(count, MOST // states), -(-5 // states))
    block = float(draw.uniform(2.6, 4.2))
    seeds = draw.integers(1 << 30, size=8).tolist()
    plan: list[tuple[str, str, Array]] = []
    if style in ("velocities", "mixed", "triangles", "recovery"):
        shape = motions.triangle if style == "triangles" else motions.sine
        for v in speeds_of(draw, count if style != "mixed" else max(2, count - 1), fastest):
            before = strokes if v > 0.1 else 0
            plan.append(
                (f"{1000 * v:.0f}", "harmonic", shape(amplitude, v, rate, before, max(block, 6.0 if v < 0.1 else 0)))
            )
        if style == "mixed":
            plan.append(("rd", "stochastic", motions.road(amplitude, 0.3 * fastest, rate, 1, 5.5, draw)))
        if style == "recovery":
            rest = float(draw.uniform(1.5, 3.0))
            plan[-1] = (
                f"{1000 * fastest:.0f}p",
                "harmonic",
                motions.fast_rest_fast(amplitude, fastest, rate, 2.2, rest, 2.2),
            )
    if style == "frequencies":
        top = fastest / (2 * np.pi * amplitude)
        ladder = top * np.geomspace(0.12, 1.0, count)
        for hertz in ladder:
            v = float(2 * np.pi * amplitude * hertz)
            plan.append((f"{hertz:.1f}Hz".replace(".", "p"), "harmonic", motions.sine(amplitude, v, rate, strokes, block)))
    if style == "sweep":
        plan = [(f"sw{i + 1}", "stochastic", motions.sweep(amplitude, fastest * x, rate, strokes, 5.5))
                for i, x in enumerate(np.linspace(1.0, 0.35, max(2, count)))]  # fmt: skip
    if style == "road":
        plan = [(f"rd{i + 1}", "stochastic", motions.road(amplitude, fastest * (0.2 + 0.06 * i), rate, 1, 6.0,
                np.random.default_rng(seeds[i]))) for i in range(max(2, count))]  # fmt: skip
    return plan


def plan_day(seed: int, wish: Wish) -> Day:
    """The campaign of a seed."""
    draw = np.random.default_rng((seed, 77))
    name = str(draw.choice(wish.dampers))
    damper = load(name, as_published=True)
    style = str(draw.choice(wish.styles))
    fs = float(draw.choice([x for x in wish.rates if x >= (500 if style in ("triangles", "road") else 200)]))
    rate = fs * np.ceil(FINE / fs)
    largest = damper.parameters.stroke_max
    wide = wish.wide or draw.random() < 0.3
    amplitude = round(float(largest * draw.uniform(0.82, 0.92) if wide else draw.uniform(0.02, 0.6 * largest)), 3)
    tube = 0.5 * (damper.parameters.h_l - damper.parameters.dead_length)
    amplitude = min(amplitude, 0.9 * tube, 0.06)
    fastest = max(wish.speed, float(draw.choice([0.524, 0.786, 1.05, 1.05, 1.31])))
    states = states_of(damper, draw, wish.states, wish.low)
    strokes = int(draw.choice([0, 2, 2, 2, 3]))
    plan = excitations(style, amplitude, fastest, draw, len(states), rate, strokes)
    trials: list[Trial] = []
    begin, pause = 0.0, float(draw.uniform(3.0, 20.0))
    for level, preload in states:
        head = f"{100 * level:.0f}{'' if preload else 'n'}"
        for label, kind, x in plan:
            if len(trials) < MOST:
                trials.append(Trial(len(trials), f"{head}_{label}", kind, x, rate, level, preload, begin))
                begin += len(x) / rate + pause
    kind = str(draw.choice(["points", "points", "means", "filter"] if fs >= 500 else ["points", "points", "means"]))
    return Day(
        name=name,
        damper=damper,
        style=style,
        trials=trials,
        recorder=Recorder(fs, kind, float(draw.uniform(0.3, 0.42))),
        noise_share=float(np.exp(draw.uniform(np.log(0.002), np.log(0.015)))),
        noise_memory=float(draw.choice([0.0, 0.0, 0.0, 0.6, 0.85])),
        zero=float(draw.uniform(-0.002, 0.002)),
        stroke_gain=1.0 + float(draw.uniform(-5e-4, 5e-4)),
        stroke_noise=float(draw.uniform(0.3e-6, 2e-6)),
    )
