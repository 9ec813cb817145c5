"""What differs from car to car and from tester to tester: the ranges, and draws from them.

All ranges are uniform and independent. They describe one type of car on testers of one kind, not the whole traffic.
"""

import math
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from twintube.dampers import Damper
from twintube.inspection.benches import Setting
from twintube.inspection.plate import Plate
from twintube.vehicle.cars import CarSet
from twintube.vehicle.quarter_car import Car

FADE: Final = 0.003  # [1/K] of the fluid force, which falls as that of warm oil does (assumed)


@dataclass(frozen=True)
class Range:
    """One value that scatters."""

    name: str
    title: str
    low: float
    high: float
    unit: str
    basis: str  # `assumed`, or what is sourced
    reason: str


RANGES: Final = (
    Range("tyre", "tyre stiffness over the car file's", 0.8, 1.2, "", "assumed",
          "pressure up to 20 % off, stiffness in proportion to it; public data of car tyres go from 158 to 348 N/mm"),
    Range("load", "sprung mass of the corner over the car file's", 0.85, 1.25, "", "assumed",
          "from the driver alone to a full rear seat; the height of the body and the stroke's middle stay"),
    Range("force", "F-v curve over the parameter set's", 0.9, 1.1, "", "assumed", "tolerance of new dampers"),
    Range("temperature", "oil temperature less that of the F-v curve", -15.0, 25.0, "K", "assumed",
          "cold car to end of a drive; acts on the fluid force only, 0.3 % per kelvin"),
    Range("amplitude", "amplitude of the plate", 2.9e-3, 3.1e-3, "m",
          "3 mm sourced (EUSAMA), tolerance assumed", "wear of the crank"),
    Range("top", "highest frequency of the plate", 24.0, 26.0, "Hz",
          "25 Hz sourced (EUSAMA), tolerance assumed", "slip of the motor"),
    Range("coast", "time of the plate to rest", 10.0, 20.0, "s", "assumed", "flywheel and friction differ between testers"),
    Range("force_noise", "noise of the plate's force, root mean square", 0.0, 20.0, "N", "assumed",
          "below 1 % of the static force"),
    Range("phase_error", "error of the phase", -2.0, 2.0, "deg", "assumed",
          "delay between the channels of force and height"),
    Range("push", "depth of the push-down", 0.04, 0.06, "m", "assumed", "by hand"),
    Range("height_noise", "noise of the body's height, root mean square", 0.0, 5e-4, "m", "assumed", "optical sensor"),
    Range("speed_kmh", "speed over the bump", 7.0, 9.0, "km/h", "8 km/h sourced (the paper), tolerance assumed", "a driver"),
    Range("acceleration_noise", "noise of the axle's acceleration, root mean square", 0.0, 0.5, "m/s2", "assumed",
          "MEMS sensor"),
)  # fmt: skip


@dataclass(frozen=True)
class Sample:
    """One car on one tester: the values of RANGES by name, and the seed of the sensors' noise."""

    values: dict[str, float]
    seed: int

    def corner(self, damper: Damper, vehicle: CarSet) -> Car:
        """The corner of this car."""
        nominal = vehicle.corner(damper)
        return vehicle.corner(
            damper, c_tyre=nominal.c_tyre * self.values["tyre"], m_body=nominal.m_body * self.values["load"]
        )

    def made(self, damper: Damper) -> Damper:
        """The damper as manufactured and as warm as it is; raises ParameterError."""
        share = self.values["force"] * math.exp(-FADE * self.values["temperature"])
        p = damper.parameters
        return damper.with_(F_re=[share * F for F in p.F_re], F_co=[share * F for F in p.F_co])

    @property
    def setting(self) -> Setting:
        """The benches of this tester."""
        v = self.values
        plate = replace(Plate(), amplitude=v["amplitude"], top=v["top"], coast=v["coast"])
        names = ("push", "speed_kmh", "force_noise", "height_noise", "acceleration_noise", "phase_error")
        return Setting(plate=plate, **{name: v[name] for name in names})


def samples(count: int, seed: int) -> list[Sample]:
    """`count` draws; a longer list begins with the draws of a shorter one."""
    made = []
    for i in range(count):
        random = np.random.default_rng([seed, i])
        values = {item.name: float(random.uniform(item.low, item.high)) for item in RANGES}
        made.append(Sample(values, int(random.integers(2**32))))
    return made
