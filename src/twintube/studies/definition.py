"""What a study is: its axes, and the order of its cases."""

import math
from dataclasses import dataclass, field, fields
from typing import NamedTuple

import numpy as np

from twintube.common.arrays import Array
from twintube.core.effects import Parameters
from twintube.core.variables import fmi_name
from twintube.dampers import Damper, ParameterError
from twintube.rig.signals import OSCILLATIONS

FIELDS = {fmi_name(item): item for item in fields(Parameters)}


class StudyError(ParameterError):
    """A study that cannot be run; the message names the file, the key and what is allowed."""


@dataclass(frozen=True)
class Signal:
    """An excitation after the paper's preconditioning: a harmonic block, or a record where `stroke` is given."""

    name: str
    velocity: float = math.nan  # maximum [m/s]
    amplitude: float = math.nan  # [m]
    time: Array = field(default_factory=lambda: np.empty(0))  # (n,) [s]
    stroke: Array = field(default_factory=lambda: np.empty(0))  # (n,) [m]
    speed: Array = field(default_factory=lambda: np.empty(0))  # (n,) [m/s]

    def samples(self, time_step: float) -> float:
        """About how many samples it has, without the preconditioning."""
        return self.stroke.size or OSCILLATIONS * 2 * math.pi * self.amplitude / self.velocity / time_step


class StudyCase(NamedTuple):
    """One point of the grid."""

    damper: int
    signal: int
    values: tuple[float, ...]  # of the study's parameters
    oil_level: float
    gas_preload: float
    variant: int


@dataclass(frozen=True, eq=False)
class Study:
    """A checked grid. The last axis runs fastest: dampers, signals, parameters, oil levels, gas preload, variants."""

    title: str
    dampers: tuple[Damper, ...]
    signals: tuple[Signal, ...]
    parameters: dict[str, tuple[float, ...]]  # by FMI name
    oil_levels: tuple[float, ...]
    gas_preload: tuple[float, ...]  # empty: 1 at 100 % oil, 0 below
    variants: tuple[int, ...]
    oscillations: tuple[int, ...]  # counted from 1
    time_step: float  # [s]
    text: str  # the definition with all defaults, as JSON

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values on each axis."""
        listed = (self.dampers, self.signals, *self.parameters.values(), self.oil_levels, self.gas_preload, self.variants)
        return tuple(max(1, len(axis)) for axis in listed)

    def __len__(self) -> int:
        return math.prod(self.shape)

    @property
    def samples(self) -> float:
        """About how many samples all cases have together."""
        return len(self) / len(self.signals) * sum(signal.samples(self.time_step) for signal in self.signals)

    def case(self, number: int) -> StudyCase:
        """The case `number`, counted from 0."""
        places = [int(i) for i in np.unravel_index(number, self.shape)]
        level = self.oil_levels[places[-3]]
        full = 1.0 if level >= 1.0 else 0.0
        return StudyCase(
            damper=places[0],
            signal=places[1],
            values=tuple(axis[i] for axis, i in zip(self.parameters.values(), places[2:-3], strict=True)),
            oil_level=level,
            gas_preload=self.gas_preload[places[-2]] if self.gas_preload else full,
            variant=self.variants[places[-1]],
        )

    def rows(self, case: StudyCase) -> tuple[int, ...]:
        """The oscillations that have a row; a record counts as one."""
        return (1,) if self.signals[case.signal].stroke.size else self.oscillations
