"""Dependence of the results on assumptions: the rides repeated with the compiled damper over seeds, freed gas and values."""

import os
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

from twintube.common.bars import Bar
from twintube.common.readable import unit_of
from twintube.dampers import Damper, ParameterError, freed_gas
from twintube.dampers.dead_length import bounds
from twintube.dampers.freed_gas import DEFAULT, P_GASES, VARIED, WAYS, condition
from twintube.dampers.temperature import at_temperature
from twintube.dampers.variants import rear_curve
from twintube.vehicle.cars import CarSet
from twintube.vehicle.drive import Drive
from twintube.vehicle.ride import Track, measures, ride, track

SPEEDS = (30.0, 50.0)  # [km/h]
SEEDS = (1, 2, 3, 4, 5)
FORCES = (0.75, 1.33)  # of the assumed F-v curve
LOSSES = (0.05, 0.4)  # oil losses [1] from which cavitation has its full effect (assumed)
NAMES = {  # of the car's values, and their units
    "d_links": ("damping of the links", "N s/m"),
    "friction": ("friction of the suspension", "N"),
    "d_tyre": ("tyre damping", "N s/m"),
    "c_tyre": ("tyre stiffness", "N/m"),
    "ratio": ("motion ratio", ""),
    "travel": ("bump travel", "m"),
}


@dataclass(frozen=True)
class Setting:
    """One set of assumptions: factor of the F-v curve, changed values of car and damper, state beside the oil level."""

    freed_gas: str = DEFAULT
    seed: int = 1
    car: tuple[tuple[str, float], ...] = ()
    forces: float = 1.0
    damper: tuple[tuple[str, Any], ...] = ()
    gas: float = 0.0  # share of the preload that a worn damper has
    temperature: float | None = None  # [K] of the dampers, worn and intact


POLYTROPIC = Setting(damper=(("polytropic", 1),))  # the gas spring is an enclosed gas


def changed(damper: Damper, setting: Setting) -> Damper:
    """The damper with the assumed values of a setting; raises ParameterError if they are not admissible."""
    damper = damper.with_(**dict(setting.damper))
    p, factor = damper.parameters, setting.forces
    damper = damper.with_(**{name: [factor * F for F in getattr(p, name)] for name in ("F_re", "F_co")})
    return damper if setting.temperature is None else at_temperature(damper, setting.temperature)


@lru_cache(maxsize=64)
def course(speed: float, seconds: float, seed: int, dt: float) -> Track:
    """The class D road at a speed."""
    return track(speed, seconds, seed=seed, dt=dt)


@dataclass(frozen=True)
class Rides:
    """Rides of one damper in one car, by speed [km/h], oil level and setting; each is computed once."""

    damper: Damper
    car: CarSet
    seconds: float
    dt: float
    seed: int = 1  # of the first road; the seeds of settings are relative to it
    results: dict[tuple[float, float | None, Setting], dict[str, Any]] = field(default_factory=dict)

    def run(self, speed: float, level: float | None, setting: Setting) -> Drive:
        """One ride; `level` None is the intact damper."""
        damper = changed(self.damper, setting)
        oil, gas = (1.0, 1.0) if level is None else (level, setting.gas)
        state = condition(damper, oil, gas, setting.freed_gas)
        route = course(speed, self.seconds, self.seed + setting.seed - 1, self.dt)
        return ride(state, self.car.corner(damper, **dict(setting.car)), route)

    def group(self, speed: float, levels: Iterable[float], setting: Setting) -> Iterator[tuple[Any, dict[str, Any]]]:
        """Figures of the intact damper and of all levels over the same track, by (speed, level, setting)."""
        corner = self.car.corner(changed(self.damper, setting), **dict(setting.car))
        intact = self.run(speed, None, setting)
        yield (speed, None, setting), measures(intact, corner, intact)
        for level in levels:
            yield (speed, level, setting), measures(self.run(speed, level, setting), corner, intact)

    def drive_all(self, speeds: Iterable[float], levels: Iterable[float], settings: Iterable[Setting], label: str) -> None:
        """Compute the missing rides on all cores, in threads: the compiled damper releases Python's lock."""
        levels = tuple(levels)
        jobs = [(speed, setting) for setting in dict.fromkeys(settings) for speed in speeds]
        jobs = [job for job in jobs if any((job[0], level, job[1]) not in self.results for level in (None, *levels))]

        def work(job: tuple[float, Setting]) -> dict[Any, dict[str, Any]]:
            return dict(self.group(job[0], levels, job[1]))

        with ThreadPoolExecutor(os.cpu_count()) as pool:
            for figures_by_key in Bar(pool.map(work, jobs), total=len(jobs), unit="setting", desc=label):
                self.results.update(figures_by_key)

    def get(self, speed: float, level: float | None, setting: Setting, figure: str) -> Any:
        """A figure of a ride that has been computed."""
        return self.results[speed, level, setting][figure]


def assumptions(damper: Damper, car: CarSet) -> dict[str, tuple[Setting, Setting]]:
    """The two ends of every assumed value, by name; values that the damper does not admit are left out."""
    ends = {
        ranged(name, low, high): (Setting(car=((name, low),)), Setting(car=((name, high),)))
        for name, (low, high) in car.band.items()
    }
    ends[f"F-v curve, × {FORCES[0]:g} to {FORCES[1]:g}"] = (Setting(forces=FORCES[0]), Setting(forces=FORCES[1]))
    low, high = bounds(damper)
    ends[f"dead length, {1e3 * low:.0f} to {1e3 * high:.0f} mm"] = (dead_length(low), dead_length(high))
    if curve := rear_curve(damper):
        ends["rear curve of the F-v source"] = (Setting(), Setting(damper=tuple(curve.items())))
    ends[f"full cavitation from {100 * LOSSES[0]:.0f} to {100 * LOSSES[1]:.0f} % oil loss"] = (
        loss(LOSSES[0]),
        loss(LOSSES[1]),
    )
    return {name: pair for name, pair in ends.items() if all(fits(damper, setting) for setting in pair)}


def ranged(name: str, low: float, high: float) -> str:
    """A value of the car and its range, in engineering units."""
    text, si = NAMES.get(name, (name, ""))
    unit, factor = unit_of(si, high)
    return f"{text}, {factor * low:g} to {factor * high:g} {unit}".rstrip()


def loss(value: float) -> Setting:
    """Full cavitation from an oil loss [1]."""
    return Setting(damper=(("cavitation_loss", value),))


def dead_length(value: float) -> Setting:
    """A dead length [m]."""
    return Setting(damper=(("dead_length", value),))


def limited(pressure: float) -> Setting:
    """Freed gas that dissolves again and is limited as at a pressure [bar]."""
    return Setting(damper=tuple(freed_gas.limited(pressure).items()))


def fits(damper: Damper, setting: Setting) -> bool:
    """Whether the damper is admissible with a setting."""
    try:
        changed(damper, setting)
    except ParameterError:
        return False
    return True


def extremes(rides: Rides, speed: float, level: float | None, settings: Iterable[Setting]) -> list[float]:
    """Smallest and largest DLC over the settings."""
    values = [rides.get(speed, level, setting, "dlc") for setting in settings]
    return [min(values), max(values)]


def seeds() -> list[Setting]:
    """The default assumptions, on five roads."""
    return [Setting(seed=seed) for seed in SEEDS]


def ways() -> list[Setting]:
    """Every way of the freed gas, on one road."""
    return [Setting(freed_gas=name) for name in WAYS]


def together(rides: Rides) -> list[Setting]:
    """What matters most, varied together: ways of the freed gas, damping of the links and dead length."""
    links = [(("d_links", value),) for value in rides.car.band.get("d_links", ())]
    lengths = [dead_length(value).damper for value in bounds(rides.damper)]
    pairs = [Setting(freed_gas=name, car=car) for name in WAYS for car in links]
    return pairs + [
        Setting(freed_gas=name, car=car, damper=length) for name in VARIED for car in ((), *links) for length in lengths
    ]


def everything(rides: Rides) -> list[Setting]:
    """All settings of the bands: one assumption varied at a time, and the most important ones together."""
    ends = [end for pair in assumptions(rides.damper, rides.car).values() for end in pair]
    gas = [*map(limited, P_GASES), POLYTROPIC]
    return list(dict.fromkeys([*seeds(), *ways(), *gas, *ends, *together(rides)]))


def rises(rides: Rides, speed: float, level: float, settings: Iterable[Setting]) -> list[float]:
    """DLC relative to the intact damper in the same car on the same road [1], for every setting."""
    return [rides.get(speed, level, s, "dlc") / rides.get(speed, None, s, "dlc") for s in settings]


def bands(rides: Rides, speed: float, level: float | None) -> dict[str, Any]:
    """Bands of the DLC at one speed and level for JSON; every entry is [smallest, largest] except `freed_gas`."""
    half_lives = [Setting(freed_gas=name) for name in ("dissolves_fast", "dissolves_slow")]
    figures: dict[str, Any] = {
        "seeds": extremes(rides, speed, level, seeds()),
        "half_life": extremes(rides, speed, level, [*half_lives, Setting()]),
        "freed_gas_ways": extremes(rides, speed, level, ways()),
        "freed_gas": {s.freed_gas: rides.get(speed, level, s, "dlc") for s in ways()},
        "assumed": {
            name: [rides.get(speed, level, end, "dlc") for end in pair]
            for name, pair in assumptions(rides.damper, rides.car).items()
        },
    }
    if level is not None:
        for name, settings in (("seeds_over_intact", seeds()), ("all_over_intact", everything(rides))):
            values = rises(rides, speed, level, settings)
            figures[name] = [min(values), max(values)]
    return figures
