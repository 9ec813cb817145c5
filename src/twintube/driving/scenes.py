"""Which car drives where: a vehicle with its tolerances, the conditions of a drive, and the wear of its dampers."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from twintube.core.checks import KELVIN, outside
from twintube.dampers import Damper
from twintube.dampers.freed_gas import DEFAULT, condition
from twintube.dampers.temperature import at_temperature
from twintube.driving.channels import PLACES
from twintube.driving.drives import ROOM, Bushings, Scene
from twintube.driving.sensors import Encoder
from twintube.driving.sheet import IN_A_FILE
from twintube.errors import InputError
from twintube.vehicle.cars import CarSet
from twintube.vehicle.full.car import Wheel
from twintube.vehicle.full.maneuvers import Road
from twintube.vehicle.full.rolling import shrinking
from twintube.vehicle.full.run import FullCar, full_car
from twintube.vehicle.full.sensitivity import scaled

PRESSURE: Final = 2.3e5  # [Pa] of the tyres over ambient, at which the car's file holds: assumed
# Vertical stiffness over pressure, PFZ1 of the Magic Formula 6.1 for the tyre of `rolling.py`, from the same source.
STIFFER: Final = 0.7098
PERSON: Final = 75.0  # [kg], two of them in the car's file
# Share of the front axle of what is loaded: front seats, rear seats, luggage (assumed).
FRONT_SEATS, REAR_SEATS, LUGGAGE = 0.5, 0.2, -0.1
# Fore-and-aft compliance of a wheel [m/N] and loss of its rubber at resonance: assumed, so that a wheel of 45 kg swings at
# 14 Hz; harshness engineering speaks of 10 to 20 Hz.
COMPLIANCE: Final = 3e-6
LOSS: Final = 0.2
# Errors of the teeth and runout of the encoder over its radius: assumed, bearings' makers allow 2 % of a pitch at most.
TOOTH: Final = 0.003
RUNOUT: Final = 0.0007


@dataclass(frozen=True)
class Vehicle:
    """A car as it left the works, with its tyres: `made` (4,) are the F-v curves over those of the dampers of its axles."""

    car: CarSet
    front: Damper
    rear: Damper
    tyre: str = "as the car's file"
    made: Sequence[float] = (1.0, 1.0, 1.0, 1.0)
    compliance: float = COMPLIANCE  # [m/N]
    loss: float = LOSS
    tooth: float = TOOTH  # [pitches]
    runout: float = RUNOUT
    seed: int = 0  # of the encoders

    @property
    def sheet(self) -> dict[str, Any]:
        """What its data sheet says."""
        whole = self.car.whole
        return {"name": self.car.name} | {name: whole[table][key] for name, (table, key) in IN_A_FILE.items()}


@dataclass(frozen=True)
class Conditions:
    """A drive: where, how fast [km/h], how long [s], and in which state but for the dampers."""

    road_class: str = "B"
    speed_kmh: float = 80.0
    seconds: float = 60.0
    road_seed: int = 1
    scale: float = 1.0  # of the road's spectrum within its class
    persons: int = 2
    luggage: float = 0.0  # [kg]
    pressures: Sequence[float] = (PRESSURE,) * 4  # [Pa]
    temperature: float = ROOM  # [degC] of oil, seals and gas
    random: int = 1  # of driver and sensors
    ambient: float = ROOM  # [degC] of the air
    hills: float = 0.0  # grade [1], root mean square
    apart: float = 1.0  # of the tracks, as in `Road`


@dataclass(frozen=True)
class Wear:
    """Oil level and gas preload (4,) of the dampers in the order of WHEELS; `model` is a way of the freed gas, or SCALAR."""

    oil_level: Sequence[float] = (1.0, 1.0, 1.0, 1.0)
    gas_preload: Sequence[float] = (1.0, 1.0, 1.0, 1.0)
    model: str = DEFAULT

    def __post_init__(self) -> None:
        """Raises InputError."""
        for place, level in zip(PLACES, self.oil_level, strict=True):
            if message := outside(f"oil_level ({place})", level, 0.0, 1.0, "1"):
                raise InputError(message)
        for place, share in zip(PLACES, self.gas_preload, strict=True):
            if message := outside(f"gas_preload ({place})", share, 0.0, 1.0, "1"):
                raise InputError(message)


def loaded(car: CarSet, conditions: Conditions) -> CarSet:
    """The car with who and what sits in it; how deep it sits on its springs stays as it is."""
    in_front = min(conditions.persons, 2) - 2
    behind = max(conditions.persons - 2, 0)
    masses = ((PERSON * in_front, FRONT_SEATS), (PERSON * behind, REAR_SEATS), (conditions.luggage, LUGGAGE))
    axles = {name: dict(values) for name, values in car.axles.items()}
    for mass, share in masses:
        axles["front"]["m_body"] += mass * share / 2.0
        axles["rear"]["m_body"] += mass * (1.0 - share) / 2.0
    return replace(car, axles=axles)


def inflated(wheel: Wheel, usual: float, pressure: float) -> Wheel:
    """A wheel at a tyre pressure [Pa], `usual` [N] being the load at which the radius of its file holds."""
    stiffness = wheel.c_tyre * (1.0 + STIFFER * (pressure / PRESSURE - 1.0))
    shrunk = [
        wheel.F_nominal / c * shrinking(load / wheel.F_nominal)
        for c, load in ((stiffness, wheel.weight), (wheel.c_tyre, usual))
    ]
    return replace(wheel, c_tyre=stiffness, radius=wheel.radius - shrunk[0] + shrunk[1])


def damper_of(vehicle: Vehicle, i: int, temperature: float, wear: Wear) -> Damper:
    """The damper of wheel `i`, as made, as warm and as worn as it is."""
    made = at_temperature(scaled(vehicle.front if i < 2 else vehicle.rear, vehicle.made[i]), temperature + KELVIN)
    intact = wear.oil_level[i] == 1.0 and wear.gas_preload[i] == 1
    return condition(made, wear.oil_level[i], wear.gas_preload[i], DEFAULT if intact else wear.model)


def scene(vehicle: Vehicle, conditions: Conditions, wear: Wear, labels: Mapping[str, Any] | None = None) -> Scene:
    """A drive of a vehicle, with the truth as its labels and `labels` beside; raises InputError, ParameterError."""
    four = [damper_of(vehicle, i, conditions.temperature, wear) for i in range(4)]
    car = full_car(loaded(vehicle.car, conditions), four)
    usual = [wheel.weight for wheel in full_car(vehicle.car, four).wheels]
    wheels = tuple(map(inflated, car.wheels, usual, conditions.pressures))
    car = FullCar(car.name, car.body, wheels, car.brakes, car.dampers)
    stiff = np.full(4, 1.0 / vehicle.compliance)
    soft = vehicle.loss * np.sqrt(stiff * np.array([wheel.m_wheel for wheel in wheels]))
    random = np.random.default_rng(vehicle.seed)
    encoders = tuple(Encoder.drawn(random, vehicle.tooth, vehicle.runout) for _ in PLACES)
    return Scene(
        car, Bushings(stiff, soft), encoders,
        Road(conditions.road_class, conditions.road_seed, apart=conditions.apart), conditions.scale,
        conditions.speed_kmh, conditions.seconds, conditions.random, vehicle.sheet,
        truth(vehicle, conditions, wear) | dict(labels or {}), conditions.hills, conditions.ambient,
    )  # fmt: skip


def truth(vehicle: Vehicle, conditions: Conditions, wear: Wear) -> dict[str, Any]:
    """The labels of a drive."""
    wheels = {
        place: {"oil_level": float(level), "gas_preload": float(gas), "tyre_pressure_pa": float(pressure)}
        for place, level, gas, pressure in zip(PLACES, wear.oil_level, wear.gas_preload, conditions.pressures, strict=True)
    }
    return {
        "wheels": wheels, "model": wear.model, "car": vehicle.car.name, "tyre": vehicle.tyre,
        "road_class": conditions.road_class, "road_seed": conditions.road_seed, "road_scale": conditions.scale,
        "speed_kmh": conditions.speed_kmh, "persons": conditions.persons, "luggage_kg": conditions.luggage,
        "temperature_degC": conditions.temperature, "ambient_degC": conditions.ambient, "hills": conditions.hills,
        "apart": conditions.apart,
    }  # fmt: skip
