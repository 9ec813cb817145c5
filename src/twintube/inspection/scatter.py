"""What differs from car to car and from tester to tester: the ranges, and draws from them.

All ranges are uniform and independent. They describe one type of car on testers of one kind, not the whole traffic.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from twintube.core.checks import KELVIN
from twintube.dampers import Damper
from twintube.dampers.temperature import at_temperature
from twintube.inspection import tiring
from twintube.inspection.benches import Setting
from twintube.inspection.plate import Plate
from twintube.vehicle.cars import CarSet
from twintube.vehicle.quarter_car import Car

FADE: Final = 0.003  # [1/K] of the fluid force by the heat of a run (assumed)


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


BENCHES: Final = (
    Range("tyre", "tyre stiffness over the car file's", 0.8, 1.2, "", "assumed",
          "pressure up to 20 % off; public data: 158 to 348 N/mm"),
    Range("load", "sprung mass of the corner over the car file's", 0.85, 1.25, "", "assumed",
          "from the driver alone to a full rear seat"),
    Range("friction", "friction of the suspension over the car file's", 0.0, 6.0, "", "assumed",
          "0 to 150 N in the default car"),
    Range("force", "F-v curve over the parameter set's", 0.9, 1.1, "", "assumed", "tolerance of new dampers"),
    Range("temperature_degC", "temperature of oil and gas", 0.0, 40.0, "degC", "assumed",
          "winter to summer, by the law of the damper (docs/temperature.md)"),
    Range("amplitude", "amplitude of the plate", 2.9e-3, 3.1e-3, "m",
          "3 mm sourced (EUSAMA), tolerance assumed", "wear of the crank"),
    Range("top", "highest frequency of the plate", 24.0, 26.0, "Hz",
          "25 Hz sourced (EUSAMA), tolerance assumed", "slip of the motor"),
    Range("coast", "time of the plate to rest", 10.0, 20.0, "s", "assumed", "testers differ"),
    Range("force_noise", "noise of the plate's force, root mean square", 0.0, 20.0, "N", "assumed",
          "below 1 % of the static force"),
    Range("phase_error", "error of the phase", -2.0, 2.0, "deg", "assumed",
          "delay between the channels"),
    Range("push", "depth of the push-down", 0.04, 0.06, "m", "assumed", "by hand"),
    Range("height_noise", "noise of the body's height, root mean square", 0.0, 5e-4, "m", "assumed", "optical sensor"),
    Range("speed_kmh", "speed over the bump", 7.0, 9.0, "km/h", "8 km/h sourced (the paper), tolerance assumed", "a driver"),
    Range("acceleration_noise", "noise of the axle's acceleration, root mean square", 0.0, 0.5, "m/s2", "assumed",
          "MEMS sensor"),
)  # fmt: skip
HEAT: Final = Range("fade", "fluid force lost per kelvin of the heat of the run of tiring", 0.003, 0.006, "1", "assumed",
                    "the paper quotes 2 % of the work at 5 K more: 0.4 % per kelvin")  # fmt: skip
# Drawn after the others, whose draws so stay as they are without them.
OF_TIRING: Final = (
    Range("drift", "frequency of the plate of tiring within 20 s", -0.005, 0.005, "1", "assumed",
          "slip of a motor that gets warm"),
    Range("velocity_noise", "noise of the damper's velocity, root mean square", 0.0, 0.02, "m/s", "assumed",
          "optical sensor between wheel and wing"),
    HEAT,
)  # fmt: skip
RANGES: Final = (*BENCHES, *OF_TIRING)


@dataclass(frozen=True)
class Sample:
    """One car on one tester: the values of RANGES by name, and the seed of the sensors' noise."""

    values: dict[str, float]
    seed: int

    def corner(self, damper: Damper, vehicle: CarSet) -> Car:
        """The corner of this car."""
        nominal = vehicle.corner(damper)
        shares = {"c_tyre": "tyre", "m_body": "load", "friction": "friction"}
        return vehicle.corner(
            damper, **{name: getattr(nominal, name) * self.values[share] for name, share in shares.items()}
        )

    def made(self, damper: Damper) -> Damper:
        """The damper as manufactured and as warm as it is; raises ParameterError."""
        share = self.values["force"]
        p = damper.parameters
        made = damper.with_(F_re=[share * F for F in p.F_re], F_co=[share * F for F in p.F_co])
        return at_temperature(made, KELVIN + self.values["temperature_degC"])

    def setting(self, plates: Iterable[Plate] = tiring.PLATES) -> Setting:
        """The benches of this tester, `plates` being those of `tiring` as they are meant to move."""
        v = self.values
        usual = Plate()
        plate = replace(usual, amplitude=v["amplitude"], top=v["top"], coast=v["coast"])
        # Crank and motor are as far off at the plates of `tiring`, and its runs heat the damper.
        off, slip = v["amplitude"] - usual.amplitude, v["top"] / usual.top
        shaker = tuple(replace(p, amplitude=p.amplitude + off, top=slip * p.top, drift=v["drift"]) for p in plates)
        names = ("push", "speed_kmh", "force_noise", "height_noise", "acceleration_noise", "phase_error", "velocity_noise")
        return Setting(plate=plate, shaker=shaker, fade=v["fade"], **{name: v[name] for name in names})


def drawn(ranges: Iterable[Range], random: np.random.Generator) -> dict[str, float]:
    """One draw from each range."""
    return {item.name: float(random.uniform(item.low, item.high)) for item in ranges}


def samples(count: int, seed: int) -> list[Sample]:
    """`count` draws; a longer list begins with the draws of a shorter one."""
    made = []
    for i in range(count):
        random = np.random.default_rng([seed, i])
        values = drawn(BENCHES, random)
        noise = int(random.integers(2**32))
        made.append(Sample(values | drawn(OF_TIRING, random), noise))
    return made
