"""One corner of a car inspected over oil levels, with a scalar factor in place of the model beside it."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from twintube.dampers import Damper
from twintube.dampers.freed_gas import DEFAULT, with_freed_gas
from twintube.dampers.variants import scalar_factor
from twintube.inspection.benches import DT, ON_PLATE, Setting, on_plate, plate_motion, read
from twintube.inspection.figures import WINDOWS, measured_cycles, phase_shift
from twintube.inspection.methods import METHODS, USUAL, eusama_class
from twintube.inspection.watched import Watched, watched
from twintube.vehicle.cars import CarSet
from twintube.vehicle.quarter_car import Car

LEVELS = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3)
LEAST_FACTOR = 0.2  # smallest scalar factor that the valves' wear admits


@dataclass(frozen=True)
class Condition:
    """State of a damper; `scalar` puts the oil level as a factor on the fluid force of the full damper (variant 1)."""

    oil_level: float
    gas_preload: float
    scalar: bool = False
    freed_gas: str = DEFAULT

    def applied(self, damper: Damper) -> Damper:
        """The damper in this state; raises ParameterError."""
        if self.scalar:
            return damper.with_(gas_preload=self.gas_preload, **scalar_factor(self.oil_level))
        return with_freed_gas(damper.with_(oil_level=self.oil_level, gas_preload=self.gas_preload), self.freed_gas)


INTACT = Condition(1.0, 1)


@dataclass(frozen=True)
class Entry:
    """A figure and its verdict."""

    damper: str
    condition: Condition
    method: str
    figure: float  # in the method's unit
    scalar_figure: float | None = None  # with the oil level as factor; None below LEAST_FACTOR
    readings: Mapping[str, float] = field(default_factory=dict)  # the figure under every way, that of `figure` included
    windows: Mapping[str, float] = field(default_factory=dict)  # [deg] the phase shift in other windows
    watched: Watched | None = None  # what else `tiring` found

    @property
    def not_judged(self) -> str:
        """Why the bench cannot judge this damper; empty where it can."""
        return self.not_judged_under(self.condition.freed_gas)

    def not_judged_under(self, freed_gas: str) -> str:
        """The same under a way of `readings`."""
        return self.watched.not_judged[freed_gas] if self.watched else ""

    @property
    def passed(self) -> bool | None:
        """Whether the damper passes; None where the bench cannot judge it."""
        return None if self.not_judged else METHODS[self.method].passed(self.figure)

    def passes_under(self, freed_gas: str) -> bool | None:
        """The same under a way of `readings`."""
        return None if self.not_judged_under(freed_gas) else METHODS[self.method].passed(self.readings[freed_gas])

    @property
    def as_json(self) -> dict[str, Any]:
        """The entry for JSON."""
        how, scalar = METHODS[self.method], self.scalar_figure
        entry: dict[str, Any] = {
            "damper": self.damper,
            "oil_level": self.condition.oil_level,
            "gas_preload": self.condition.gas_preload,
            "method": self.method,
            "figure": self.figure,
            "unit": how.unit,
            "limit": how.limit,
            "passed": self.passed,
            "freed_gas_ways": dict(self.readings),
            "scalar_factor": None
            if scalar is None
            else {"factor": self.condition.oil_level, "figure": scalar, "passed": how.passed(scalar)},
        }
        if self.method == "eusama":
            entry["class"] = eusama_class(self.figure)
        if self.windows:
            entry["windows"] = dict(self.windows)
        if self.watched:
            entry |= self.watched.as_json
        return entry


def conditions(levels: Iterable[float], gas_preload: float) -> list[Condition]:
    """One state per oil level; below 100 % the share of the gas preload [1], 0 as in the paper's measurements."""
    return [Condition(level, 1.0 if level >= 1.0 else gas_preload) for level in levels]


def under(ways: Iterable[str], states: Iterable[Condition]) -> list[Condition]:
    """The states under each way in turn."""
    several = list(states)
    return [replace(state, freed_gas=name) for name in ways for state in several]


def inspected(
    damper: Damper,
    vehicle: CarSet,
    states: Iterable[Condition],
    methods: tuple[str, ...] = USUAL,
    *,
    ways: Sequence[str] = (DEFAULT,),
    setting: Setting | None = None,
    dt: float = DT,
) -> list[Entry]:
    """The figures of all states and methods on ideal benches; raises InputError if the piston would leave the tube.

    `ways` are those of `readings`; the first one is that of `figure`.
    """
    bench, corner = setting or Setting(), vehicle.corner(damper)

    def figures(state: Condition) -> dict[str, float]:
        return read(state.applied(damper), corner, methods, bench, dt=dt)

    reference = read(replace(INTACT, freed_gas=ways[0]).applied(damper), corner, over_intact(methods), bench, dt=dt)
    entries = []
    for state in under(ways[:1], states):
        models = {each.freed_gas: relative(figures(each), reference) for each in under(ways, [state])}
        scalar = replace(state, scalar=True)
        factor = relative(figures(scalar), reference) if state.oil_level >= LEAST_FACTOR else {}
        for name in methods:
            readings = {freed_gas: model[name] for freed_gas, model in models.items()}
            windows = in_windows(state.applied(damper), corner, bench, dt) if name == "phase_shift" else {}
            entry = Entry(damper.name, state, name, readings[state.freed_gas], factor.get(name), readings, windows)
            if name == "tiring":
                by_way = {each.freed_gas: each.applied(damper) for each in under(ways, [state])}
                entry = replace(entry, watched=watched(by_way, corner, bench, dt))
            entries.append(entry)
    return entries


def relative(figures: Mapping[str, float], reference: Mapping[str, float]) -> dict[str, float]:
    """The figures with that of the bump over the reference's."""
    return {name: value / reference[name] if name not in COMPLETE else value for name, value in figures.items()}


COMPLETE = (*ON_PLATE, "push_down", "tiring")  # methods that need no intact damper


def over_intact(methods: Iterable[str]) -> tuple[str, ...]:
    """Those of the methods whose figure is one over the intact damper's."""
    return tuple(name for name in methods if name not in COMPLETE)


def in_windows(damper: Damper, car: Car, setting: Setting, dt: float = DT) -> dict[str, float]:
    """The phase shift [deg] in every window of WINDOWS."""
    run = plate_motion(setting.plate, dt)
    measured = measured_cycles(run, on_plate(damper, car, run).wheel_load)
    return {name: phase_shift(measured, name) for name in WINDOWS}
