"""Random cars and drives: three groups, `train`, `test` and `other`, that share no car and no road.

Ranges are uniform and independent, and assumed but for what `Assumed.reason` says. Cars of `train` and `test` differ in
size, roads in their seeds and in the half of their class, tyres in the half of each range. All else has the same ranges.
Cars of `other` begin with another car, and scatter around it in another way.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from twintube.dampers import Damper, load
from twintube.dampers.freed_gas import DEFAULT
from twintube.driving.scenes import PRESSURE, Conditions, Vehicle, Wear
from twintube.errors import InputError
from twintube.inspection.scatter import BENCHES
from twintube.vehicle.cars import CarSet, load_car
from twintube.vehicle.full.sensitivity import ASSUMED, FORCES, TYRES, Assumed, Variant, scaled, times

GROUPS: Final = ("train", "test", "other")
CARS: Final = {"train": "passat_b8", "test": "passat_b8", "other": "escort"}
# Masses and stiffnesses over those of the car's file: of the Passat 1150 to 1650 kg, and 1650 to 2150 kg.
SIZES: Final = {"train": (0.7, 1.0), "test": (1.0, 1.3), "other": (0.9, 1.6)}
# Factor of the road's spectrum: a class of ISO 8608 reaches from half to twice its mean.
SCALES: Final = {"train": (0.5, 1.0), "test": (1.0, 2.0), "other": (0.5, 2.0)}
SEEDS: Final = {name: (i * 10**6, (i + 1) * 10**6) for i, name in enumerate(GROUPS)}
HALVES: Final = {"train": (0.0, 0.5), "test": (0.5, 1.0), "other": (0.0, 1.0)}  # of the range of each value of a tyre
# Speeds [km/h] that people drive on a class.
SPEEDS: Final = {"A": (80.0, 130.0), "B": (60.0, 110.0), "C": (40.0, 80.0), "D": (30.0, 50.0)}
TORSION: Final = times(
    "tyre stiffness along", 1.0, 4.4, "1: the car file's, with which the wheel swings at 19 Hz; 4.4: 40 Hz, where indirect "
    "pressure systems look (Persson et al., SAE 2002-01-1250)", TYRES, "c_x",
)  # fmt: skip
OF_TYRES: Final = (
    *(item for item in ASSUMED if item.tables == TYRES or item.names in (("c_tyre",), ("d_tyre",))), TORSION,
)  # fmt: skip
OF_CARS: Final = tuple(
    item for item in ASSUMED if item not in OF_TYRES and item.tables != (FORCES,) and "brakes" not in item.tables
)
SPRINGS: Final = times("springs", 0.85, 1.2, "comfortable to sporty", ("front", "rear"), "c_body")
AXLE_MASSES: Final = tuple(
    times(f"mass of a {axle} wheel", 0.75, 1.3, "twist beam or links, rims of 15 to 19 inches", (axle,), "m_wheel")
    for axle in ("front", "rear")
)
# Damping ratio of wheel hop at HOP_SPEED: soft and light dampers to those of a sporty car.
HOP_DAMPING: Final = (0.15, 0.45)
HOP_SPEED: Final = 0.2  # [m/s] of the wheel
# In `other`: each value lies around the middle of its range by a normal distribution that reaches its ends at 2 standard
# deviations, hop damping likewise but wider, and friction is exponential.
OTHER_DAMPING: Final = (0.12, 0.55)
OTHER_FRICTION: Final = 2.0  # times that of the car's file, mean
COMPLIANCES: Final = (1.5e-6, 6e-6)  # [m/N] of a wheel along the body: 10 to 20 Hz
LOSSES: Final = (0.1, 0.3)
TOOTH, RUNOUT = (0.0, 0.005), (0.0, 0.0014)
TOLERANCE: Final = next((item.low, item.high) for item in BENCHES if item.name == "force")  # of new dampers
# Air over the year [degC]: mean, swing from January to July, and standard deviation of the weather; middle of Europe.
YEAR: Final = (10.0, 9.0, 5.0)
COLDEST: Final = -20.0  # [degC] in which people drive
HEAT: Final = (0.0, 25.0)  # [K] by which oil and gas are warmer than the air
ONE_SEASON: Final = 0.5  # share of the cars whose references were all taken in one season
HILLS: Final = (0.0, 0.04)  # grade, root mean square
# Of the tracks, as in `Road`: from the wheel tracks of a patched road to an isotropic one. Roads that were measured agree
# more than isotropic ones (P. Mucka, "Model of coherence function of road unevenness in parallel tracks", 3492 records,
# abstract; its coefficients could not be read).
APART: Final = (0.2, 1.0)
PRESSURES: Final = (0.85, 1.15)  # of a car's tyres over the usual
UNEQUAL: Final = 0.05  # by which each of them may differ besides
LUGGAGE: Final = 100.0  # [kg] at most
REFERENCES: Final = 4  # drives of each car with four good dampers, known as such
PER_CAR: Final = 10  # drives of each car in all
LEVELS: Final = ((0.2, 0.4), (0.4, 0.95))  # oil of worn dampers: half of them below the first end, half above
GOOD, KEPT = 1 / 3, 1 / 4  # shares of the other drives with good dampers, and of worn dampers that keep their gas
ALL: Final = (0, 1, 2, 3)
PLACES_WORN: Final = ((0,), (1,), (2,), (3,), (0, 1), (2, 3), ALL, ALL)  # one damper, an axle, or all four


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


def around(variant: Variant, items: Sequence[Assumed], random: np.random.Generator) -> Variant:
    """The variant with each value around the middle of its range, and exponential friction."""
    for item in items:
        if item.names == ("friction",):
            part = random.exponential(OTHER_FRICTION) / item.high
        else:
            part = 0.5 + random.standard_normal() / 4.0
        variant = variant.with_(item, item.low + min(max(float(part), 0.0), 1.0) * (item.high - item.low))
    return variant


def tuned(damper: Damper, axle: Mapping[str, float], ratio: float) -> Damper:
    """The damper with forces that give a wheel the damping ratio `ratio` at its hop."""
    p, speed = damper.parameters, HOP_SPEED * axle["ratio"]
    force = 0.5 * (np.interp(speed, p.v_re, p.F_re) + np.interp(speed, p.v_co, p.F_co))
    critical = 2.0 * np.sqrt(axle["m_wheel"] * (axle["c_tyre"] + axle["c_body"]))
    return scaled(damper, float(ratio * critical * HOP_SPEED / (force * axle["ratio"])))


def vehicle(group: str, number: int, seed: int) -> Vehicle:
    """The car of a number, the same for all its drives; raises ParameterError."""
    random = np.random.default_rng([seed, GROUPS.index(group), number])
    size = within(random, SIZES[group])
    name = f"{group} {number}"
    car = replace(sized(load_car(CARS[group]), size), name=name)
    variant = Variant(car, load("SA7"), load("SA8"))
    items = (*OF_CARS, SPRINGS, *AXLE_MASSES)
    if group == "other":
        variant = around(variant, (*items, *OF_TYRES), random)
        ratios = [within(random, OTHER_DAMPING) for _ in AXLE_MASSES]
    else:
        variant = varied(varied(variant, items, (0.0, 1.0), random), OF_TYRES, HALVES[group], random)
        ratios = [within(random, HOP_DAMPING) for _ in AXLE_MASSES]
    axles = variant.car.axles
    front, rear = tuned(variant.front, axles["front"], ratios[0]), tuned(variant.rear, axles["rear"], ratios[1])
    made = [within(random, TOLERANCE) for _ in range(4)]
    compliance, loss, tooth, runout = (within(random, ends) for ends in (COMPLIANCES, LOSSES, TOOTH, RUNOUT))
    encoders = int(random.integers(2**31))
    return Vehicle(variant.car, front, rear, name, made, compliance / size, loss, tooth, runout, seed=encoders)


def air(season: float, random: np.random.Generator) -> float:
    """Temperature [degC] of the air at a time of the year, 0 to 1 from January on."""
    mean, swing, weather = YEAR
    return float(max(mean - swing * np.cos(2.0 * np.pi * season) + weather * random.standard_normal(), COLDEST))


def season_of(group: str, car: int, seed: int, reference: bool, random: np.random.Generator) -> float:
    """Time of the year of a drive; of some cars all references have the same."""
    of_car = np.random.default_rng([seed, GROUPS.index(group), car, PER_CAR + 1])
    one, season = of_car.uniform() < ONE_SEASON, float(of_car.uniform())
    return season if one and reference else float(random.uniform())


def conditions(group: str, seconds: float, season: float, random: np.random.Generator) -> Conditions:
    """Where and how a car is driven this time."""
    road_class = str(random.choice(list(SPEEDS)))
    usual = PRESSURE * within(random, PRESSURES)
    pressures = [usual * (1.0 + within(random, (-UNEQUAL, UNEQUAL))) for _ in range(4)]
    return Conditions(
        road_class, within(random, SPEEDS[road_class]), seconds, int(random.integers(*SEEDS[group])),
        within(random, SCALES[group]), int(random.integers(1, 6)), within(random, (0.0, LUGGAGE)), pressures,
        (ambient := air(season, random)) + within(random, HEAT), int(random.integers(2**31)), ambient,
        within(random, HILLS), within(random, APART),
    )  # fmt: skip


def wear(random: np.random.Generator, model: str = DEFAULT) -> Wear:
    """Good dampers, one worn damper, a worn axle or all worn."""
    good, level = random.uniform() < GOOD, within(random, LEVELS[int(random.integers(2))])
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
    where = conditions(group, seconds, season_of(group, car, seed, place < REFERENCES, random), random)
    state = Wear() if place < REFERENCES else wear(random, model)
    return Drawn(number, group, car, place < REFERENCES, vehicle(group, car, seed), where, state)
