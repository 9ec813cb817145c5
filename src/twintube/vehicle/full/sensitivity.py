"""What the assumed values of a car do to its headlines: each varied over a range, and all of them drawn together."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from twintube.core.checks import outside
from twintube.dampers import Damper, ParameterError
from twintube.dampers.freed_gas import DEFAULT, SCALAR, VARIED
from twintube.vehicle.cars import METAS, CarSet
from twintube.vehicle.full.catalogue import MANEUVERS, Case
from twintube.vehicle.full.study import dampers_of, driven_all

SPEED = 80.0  # [km/h]
DRIVES: Final = (
    ("ride", "D"), ("braking", "smooth"), ("braking", "C"), ("braking", "D"), ("cornering", "C"), ("cornering", "D"),
)  # fmt: skip
FORCES = "dampers"  # in place of a table of the car: the F-v curves of all dampers
PEAK = tuple(f"{name}{load}" for name in ("most_x", "most_y", "slide_x", "slide_y") for load in ("", "2"))
SLIPS = tuple(f"s_{name}{load}" for name in ("most_x", "most_y", "slide_x", "slide_y") for load in ("", "2"))
TYRES = ("front_tyre", "rear_tyre")


@dataclass(frozen=True)
class Assumed:
    """An assumed value: where it stands, and from which to which factor, or addend where `adds`, it is varied."""

    title: str
    low: float
    high: float
    reason: str
    tables: tuple[str, ...]
    names: tuple[str, ...]
    adds: bool = False
    unit: str = ""  # of addends
    inverse: tuple[str, ...] = ()  # names that are divided by the factor


def times(title: str, low: float, high: float, reason: str, tables: Sequence[str], *names: str) -> Assumed:
    """A value varied by a factor."""
    return Assumed(title, low, high, reason, tuple(tables), names)


def plus(title: str, low: float, high: float, reason: str, tables: Sequence[str], *names: str, unit: str = "") -> Assumed:
    """A value varied by an addend of a `unit`."""
    return Assumed(title, low, high, reason, tuple(tables), names, True, unit)


BOTH = ("front", "rear")
AXLES = ("front_axle", "rear_axle")
ASSUMED: Final = (
    plus("height of the centre of gravity", -0.05, 0.05, "luggage, another body", ["body"], "height", unit="m"),
    times("roll, pitch and yaw inertia", 0.85, 1.15, "those of another car, scaled", ["body"], "I_roll", "I_pitch", "I_yaw"),
    times("air drag", 0.8, 1.2, "front area assumed", ["body"], "drag"),
    plus("tracks", -0.03, 0.03, "without source", AXLES, "track", unit="m"),
    plus("roll centre, front", -0.05, 0.05, "chosen for the roll gradient", ["front_axle"], "h_roll", unit="m"),
    plus("roll centre, rear", -0.05, 0.05, "chosen for the roll gradient", ["rear_axle"], "h_roll", unit="m"),
    times("anti-roll bar, front", 0.5, 1.5, "chosen for the roll gradient", ["front_axle"], "c_bar"),
    times("anti-roll bar, rear", 0.0, 2.0, "chosen for the roll gradient; some cars have none", ["rear_axle"], "c_bar"),
    plus("anti-dive, front", -0.05, 0.10, "a tenth or so", ["front_axle"], "support"),
    plus("anti-lift, rear", -0.15, 0.15, "a tenth or so", ["rear_axle"], "support"),
    times("steer compliance", 0.15, 1.5, "0.75 to 5 deg/g; 3.6 on a measured saloon", ["front_axle"], "steer_compliance"),
    times("rear brakes", 0.63, 1.13, "front share 0.76 to 0.64 in three cars of CommonRoad", ["rear_axle"], "brake"),
    times("slip thresholds of the control", 0.75, 1.5, "no source", ["brakes"], "slip_release", "slip_build"),
    times("fall at which a wheel is held", 0.8, 1.6, "80 to 100 rad/s2 in such controllers", ["brakes"], "fall"),
    times("drift of the estimated speed", 0.0, 4.0, "a perfect accelerometer to a poor one", ["brakes"], "drift"),
    times("its rise after a rim", 0.5, 2.0, "no source", ["brakes"], "catch"),
    times("pressure regained fast", 0.8, 1.1, "no source", ["brakes"], "regain"),
    times("build-up of the control", 0.5, 2.0, "no source", ["brakes"], "build"),
    times("release of the control", 0.5, 2.0, "a student's controller", ["brakes"], "release"),
    times("cycle of the control", 1.0, 2.0, "usual 5 to 10 ms", ["brakes"], "cycle"),
    times("driver's build-up of pressure", 0.5, 2.0, "no source", ["brakes"], "apply"),
    times("speed at which the control ends", 0.5, 2.0, "no source", ["brakes"], "slowest"),
    times("tyre grip", 0.8, 1.1, "worn or cold tyres to a rough surface", TYRES, *PEAK, *SLIPS),
    times(
        "tyre forces at twice the load", 0.95, 1.05, "what a changing load costs", TYRES, *(n for n in PEAK if n[-1] == "2")
    ),
    Assumed(
        "cornering stiffness of the tyres",
        0.5,
        1.0,
        "the stand-in has 0.47 of the load per degree, usual are 0.11 to 0.30",
        TYRES,
        ("rise_y", "rise_y2"),
        inverse=("s_most_y", "s_most_y2"),
    ),
    times("tyre stiffness along and aside", 0.7, 1.3, "a rule for passenger cars", TYRES, "c_x", "c_y"),
    times("links' damping", 0.0, 6.4, "the car file's band, 0 to 450 N s/m", BOTH, "d_links"),
    times("friction of the suspension", 0.0, 6.0, "the car file's band, 0 to 150 N", BOTH, "friction"),
    times("tyre's vertical damping", 0.5, 3.0, "the car file's band, 50 to 300 N s/m", BOTH, "d_tyre"),
    times("tyre's vertical stiffness", 0.87, 1.13, "the car file's band, 200 to 260 N/mm", BOTH, "c_tyre"),
    times("motion ratio, rear", 0.89, 1.11, "the car file's band, 0.8 to 1.0", ["rear"], "ratio"),
    plus("travel to the stops", -0.01, 0.01, "the car file's band, 45 to 65 mm", BOTH, "travel", unit="m"),
    times("stiffness of the stops", 0.5, 2.0, "another car's rubber", BOTH, "c_stop"),
    times("damping of the stops", 0.0, 2.0, "no source", BOTH, "d_stop"),
    times("F-v curves of the dampers", 0.75, 1.33, "stand-ins, as for the quarter car", [FORCES]),
)


@dataclass(frozen=True)
class Variant:
    """A car with its dampers, some of whose assumed values are changed."""

    car: CarSet
    front: Damper
    rear: Damper

    def with_(self, item: Assumed, value: float) -> "Variant":
        """The variant with a factor or addend of an assumed value; raises ParameterError for a value out of its range."""
        if item.tables == (FORCES,):
            return replace(self, front=scaled(self.front, value), rear=scaled(self.rear, value))
        axles, whole = ({name: dict(table) for name, table in side.items()} for side in (self.car.axles, self.car.whole))
        for place in item.tables:
            table = axles[place] if place in axles else whole[place]
            for name in (*item.names, *item.inverse):
                factor = 1.0 / value if name in item.inverse else value
                table[name] = table[name] + value if item.adds else table[name] * factor
                meta = METAS[place][name]
                message = outside(f"{place}.{name}", table[name], meta["lower"], meta["upper"], meta["unit"])
                if message:
                    raise ParameterError(f"{item.title}: {message}")
        return replace(self, car=replace(self.car, axles=axles, whole=whole))


def scaled(damper: Damper, factor: float) -> Damper:
    """The damper with a factor on its F-v curve."""
    p = damper.parameters
    return damper.with_(F_re=[factor * F for F in p.F_re], F_co=[factor * F for F in p.F_co])


def wanted(level: float, seeds: Sequence[int], models: Sequence[str]) -> list[Case]:
    """The drives of a variant: intact, and worn with each model."""
    return [
        Case(maneuver, SPEED, road, seed, oil, model, gas_preload=int(oil == 1.0))
        for maneuver, road in DRIVES
        for seed in seeds
        for oil, model in ((1.0, DEFAULT), *((level, name) for name in models))
    ]


def growth(entries: Sequence[Mapping[str, Any]]) -> dict[tuple[str, str, str], list[float]]:
    """Worn over intact less 1 of the headlines, seed by seed, by manoeuvre, road and model; what was not driven is NaN."""
    figures = {
        (e["maneuver"], e["road"], e["seed"], e["model"] if e["oil_level"] < 1.0 else ""): e.get(
            MANEUVERS[e["maneuver"]].headline[0]
        )
        for e in entries
    }
    found: dict[tuple[str, str, str], list[float]] = {}
    for (maneuver, road, seed, model), worn in figures.items():
        intact = figures[maneuver, road, seed, ""]
        if model:
            found.setdefault((maneuver, road, model), []).append(worn / intact - 1 if worn and intact else math.nan)
    return found


@dataclass(frozen=True)
class Sensitivity:
    """Growth of the headlines, by (manoeuvre, road): as the car is, at both ends of each assumed value, and over draws."""

    level: float
    seeds: int
    nominal: Mapping[tuple[str, str], list[float]]  # seed by seed
    ends: Mapping[str, Mapping[tuple[str, str], tuple[float, float]]]  # by title: means at the low and the high end
    draws: Mapping[tuple[str, str], list[float]]  # draw by draw, of the full model
    scalar: Mapping[tuple[str, str], list[float]]  # of the scalar factor in the same draws


def sensitivity(
    variant: Variant, worn: str, level: float, *, seeds: int, draws: int, seed: int = 1, progress: bool = True
) -> Sensitivity:
    """Drive the variants of a car whose dampers at `worn` are at an oil `level`; raises ParameterError, InputError.

    One at a time: the mean over `seeds`, freed gas as by default, the same roads at both ends. Draws: every assumed value
    uniform in its range, with a road, a slip control and a way of VARIED of its own.
    """
    several = [variant] + [variant.with_(item, end) for item in ASSUMED for end in (item.low, item.high)]
    plans = [(each, wanted(level, range(1, seeds + 1), [DEFAULT])) for each in several]
    random = np.random.default_rng(seed)
    ways = []
    for i in range(draws):
        drawn = variant
        for item in ASSUMED:
            drawn = drawn.with_(item, float(random.uniform(item.low, item.high)))
        ways.append(VARIED[int(random.integers(len(VARIED)))])
        plans.append((drawn, wanted(level, [i + 1], [ways[-1], SCALAR])))
    jobs = [(v.car, dampers_of(v.front, v.rear, worn, case), case) for v, cases in plans for case in cases]
    entries = iter(driven_all(jobs, progress))
    grown = [growth([next(entries) for _ in cases]) for _, cases in plans]
    means = [{drive: mean(found[*drive, DEFAULT]) for drive in DRIVES} for found in grown[: len(several)]]
    return Sensitivity(
        level,
        seeds,
        {drive: grown[0][*drive, DEFAULT] for drive in DRIVES},
        {
            item.title: {drive: (means[1 + 2 * i][drive], means[2 + 2 * i][drive]) for drive in DRIVES}
            for i, item in enumerate(ASSUMED)
        },
        {
            drive: [found[*drive, name][0] for found, name in zip(grown[len(several) :], ways, strict=True)]
            for drive in DRIVES
        },
        {drive: [found[*drive, SCALAR][0] for found in grown[len(several) :]] for drive in DRIVES},
    )


def mean(values: Sequence[float]) -> float:
    """Mean of what was driven; NaN where nothing was."""
    some = [x for x in values if not math.isnan(x)]
    return float(np.mean(some)) if some else math.nan
