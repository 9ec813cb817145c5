"""Random cars and drives: two groups, `train` and `test`, that share no car, no road and no tyre.

Ranges are uniform and independent, and assumed but for what `Assumed.reason` says. Cars of the two groups differ in size,
roads in their seeds and in the half of their class, tyres in the half of each range. All else has the same ranges in both.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from twintube.dampers import load
from twintube.dampers.freed_gas import DEFAULT
from twintube.driving.scenes import PRESSURE, Conditions, Vehicle, Wear
from twintube.errors import InputError
from twintube.inspection.scatter import BENCHES
from twintube.vehicle.cars import CarSet, load_car
from twintube.vehicle.full.sensitivity import ASSUMED, TYRES, Assumed, Variant, scaled, times

GROUPS: Final = ("train", "test")
# Masses and stiffnesses over those of the Passat: 1150 to 1650 kg, and 1650 to 2150 kg.
SIZES: Final = {"train": (0.7, 1.0), "test": (1.0, 1.3)}
# Factor of the road's spectrum: a class of ISO 8608 reaches from half to twice its mean.
SCALES: Final = {"train": (0.5, 1.0), "test": (1.0, 2.0)}
SEEDS: Final = {"train": (0, 10**6), "test": (10**6, 2 * 10**6)}
HALVES: Final = {"train": (0.0, 0.5), "test": (0.5, 1.0)}  # of the range of each value of a tyre
# Speeds [km/h] that people drive on a class.
SPEEDS: Final = {"A": (80.0, 130.0), "B": (60.0, 110.0), "C": (40.0, 80.0), "D": (30.0, 50.0)}
TORSION: Final = times(
    "tyre stiffness along", 1.0, 4.4, "1: the car file's, with which the wheel swings at 19 Hz; 4.4: 40 Hz, where indirect "
    "pressure systems look (Persson et al., SAE 2002-01-1250)", TYRES, "c_x",
)  # fmt: skip
OF_TYRES: Final = (
    *(item for item in ASSUMED if item.tables == TYRES or item.names in (("c_tyre",), ("d_tyre",))), TORSION,
)  # fmt: skip
# None in these cars: with it the monitor's tables would have to be made anew, and its figures measured again.
FRICTION: Final = next(item for item in ASSUMED if item.names == ("friction",))
OF_CARS: Final = tuple(
    item for item in ASSUMED if item not in OF_TYRES and item is not FRICTION and "brakes" not in item.tables
)
SPRINGS: Final = times("springs", 0.85, 1.2, "comfortable to sporty", ("front", "rear"), "c_body")
COMPLIANCES: Final = (1.5e-6, 6e-6)  # [m/N] of a wheel along the body: 10 to 20 Hz
LOSSES: Final = (0.1, 0.3)
TOOTH, RUNOUT = (0.0, 0.005), (0.0, 0.0014)
TOLERANCE: Final = next((item.low, item.high) for item in BENCHES if item.name == "force")  # of new dampers
TEMPERATURES: Final = (-10.0, 60.0)  # [degC] of oil and gas
PRESSURES: Final = (0.85, 1.15)  # of a car's tyres over the usual
UNEQUAL: Final = 0.05  # by which each of them may differ besides
LUGGAGE: Final = 100.0  # [kg] at most
REFERENCES: Final = 4  # drives of each car with four good dampers, known as such
PER_CAR: Final = 10  # drives of each car in all
LEVELS: Final = (0.2, 0.95)  # oil of worn dampers
GOOD, KEPT = 1 / 3, 1 / 4  # shares of the other drives with good dampers, and of worn dampers that keep their gas
PLACES_WORN: Final = ((0,), (1,), (2,), (3,), (0, 1), (2, 3))  # one damper, or an axle


@dataclass(frozen=True)
class Drawn:
    """A drive of a study: its car's number, whether it is known to be good, and what is driven."""

    number: int
    group: str
    car: int
    reference: bool
    vehicle: Vehicle
    conditions: Conditions
    wear: Wear


def sized(car: CarSet, factor: float) -> CarSet:
    """A car of other size: masses and stiffnesses by the factor, lengths by its cube root; so its frequencies stay."""
    length = factor ** (1.0 / 3.0)
    powers = {"wheelbase": length, "track": length, "drag": length**2, "steer_compliance": 1.0 / factor}
    powers |= {name: factor * length**2 for name in ("I_roll", "I_pitch", "I_yaw")}
    same = ("ratio", "travel", "d_stop", "height", "h_roll", "support", "steers", "drive", "radius")

    def grown(name: str, value: float) -> float:
        return value if name in same or name.startswith("s_") else value * powers.get(name, factor)

    axles = {place: {name: grown(name, value) for name, value in table.items()} for place, table in car.axles.items()}
    whole = {
        place: table if place == "brakes" else {name: grown(name, value) for name, value in table.items()}
        for place, table in car.whole.items()
    }
    return replace(car, axles=axles, whole=whole)


def within(random: np.random.Generator, ends: Sequence[float]) -> float:
    """A value between two ends."""
    return float(random.uniform(ends[0], ends[1]))


def varied(variant: Variant, items: Sequence[Assumed], part: Sequence[float], random: np.random.Generator) -> Variant:
    """The variant with each value somewhere in a `part` of its range, from 0 to 1."""
    for item in items:
        variant = variant.with_(item, item.low + within(random, part) * (item.high - item.low))
    return variant


def vehicle(group: str, number: int, seed: int) -> Vehicle:
    """The car of a number, the same for all its drives; raises ParameterError."""
    random = np.random.default_rng([seed, GROUPS.index(group), number])
    size = within(random, SIZES[group])
    name = f"{group} {number}"
    car = replace(sized(load_car(), size), name=name)
    variant = Variant(car, scaled(load("SA7"), size), scaled(load("SA8"), size)).with_(FRICTION, 0.0)
    variant = varied(variant, (*OF_CARS, SPRINGS), (0.0, 1.0), random)
    variant = varied(variant, OF_TYRES, HALVES[group], random)
    made = [within(random, TOLERANCE) for _ in range(4)]
    compliance, loss, tooth, runout = (within(random, ends) for ends in (COMPLIANCES, LOSSES, TOOTH, RUNOUT))
    encoders = int(random.integers(2**31))
    return Vehicle(
        variant.car, variant.front, variant.rear, name, made, compliance / size, loss, tooth, runout, seed=encoders
    )


def conditions(group: str, seconds: float, random: np.random.Generator) -> Conditions:
    """Where and how a car is driven this time."""
    road_class = str(random.choice(list(SPEEDS)))
    usual = PRESSURE * within(random, PRESSURES)
    pressures = [usual * (1.0 + within(random, (-UNEQUAL, UNEQUAL))) for _ in range(4)]
    return Conditions(
        road_class, within(random, SPEEDS[road_class]), seconds, int(random.integers(*SEEDS[group])),
        within(random, SCALES[group]), int(random.integers(1, 6)), within(random, (0.0, LUGGAGE)), pressures,
        within(random, TEMPERATURES), int(random.integers(2**31)),
    )  # fmt: skip


def wear(random: np.random.Generator, model: str = DEFAULT) -> Wear:
    """Good dampers, one worn damper or a worn axle."""
    good, level = random.uniform() < GOOD, within(random, LEVELS)
    places = PLACES_WORN[int(random.integers(len(PLACES_WORN)))]
    gas = int(random.uniform() < KEPT)
    if good:
        return Wear(model=model)
    levels = [level if i in places else 1.0 for i in range(4)]
    return Wear(levels, [gas if i in places else 1 for i in range(4)], model)


def draw(number: int, seconds: float, seed: int, model: str = DEFAULT) -> Drawn:
    """The drive of a number; cars of both groups alternate. `model` is that of the worn dampers. Raises InputError."""
    if number < 0 or seed < 0:
        raise InputError(f"number {number}, seed {seed}: must not be below 0")
    car, place = divmod(number, PER_CAR)
    group = GROUPS[car % len(GROUPS)]
    random = np.random.default_rng([seed, GROUPS.index(group), car, place + 1])
    where = conditions(group, seconds, random)
    state = Wear() if place < REFERENCES else wear(random, model)
    return Drawn(number, group, car, place < REFERENCES, vehicle(group, car, seed), where, state)
