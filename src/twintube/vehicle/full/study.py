"""What worn dampers change in the whole car: manoeuvres over oil levels, roads and seeds, against the intact car."""

import os
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from tqdm import tqdm

from twintube.dampers import Damper
from twintube.dampers.freed_gas import DEFAULT, SCALAR, VARIED, condition
from twintube.engine.simulate import InputError
from twintube.vehicle import maneuvers as table3
from twintube.vehicle.cars import CarSet
from twintube.vehicle.full import maneuvers as driven
from twintube.vehicle.full.brakes import Brakes
from twintube.vehicle.full.car import WHEELS
from twintube.vehicle.full.figures import braking_figures, cornering_figures, ride_figures
from twintube.vehicle.full.run import FullCar, full_car

WORN = {"all": (0, 1, 2, 3), "front": (0, 1), "rear": (2, 3)} | {name: (i,) for i, name in enumerate(WHEELS)}
RIDE_SECONDS = 30.0
FULL = "full model"
SCATTER = 0.25  # of thresholds and rates of the slip control, from seed to seed: assumed
# The figure of each manoeuvre that is compared, its name and unit.
HEADLINES = {
    "ride": ("dlc_worst", "largest DLC of a wheel", "1"),
    "braking": ("stopping_distance_m", "stopping distance", "m"),
    "cornering": ("lateral_acceleration_max_m_s2", "largest lateral acceleration", "m/s2"),
    "table3": ("dlc_worst", "largest DLC of a wheel", "1"),
}
USUAL = ("ride", "braking", "cornering")
TABLE_3 = {drive.name: drive for drive in table3.MANEUVERS}


@dataclass(frozen=True)
class Case:
    """A drive: what is driven, on which road, and how worn the dampers are."""

    maneuver: str
    speed_kmh: float
    road: str  # of the drives of Table 3 their name
    seed: int
    oil_level: float = 1.0
    model: str = DEFAULT  # a way, or SCALAR

    @property
    def intact(self) -> bool:
        """Whether nothing is worn."""
        return self.oil_level == 1.0


def dampers_of(front: Damper, rear: Damper, worn: str, case: Case) -> list[Damper]:
    """The four dampers, those of `worn` at the case's oil level without preload; raises InputError for an unknown place."""
    if worn not in WORN:
        raise InputError(f"worn {worn}: must be one of {', '.join(WORN)}")
    several = []
    for i in range(len(WHEELS)):
        damper = front if i < 2 else rear
        bad = i in WORN[worn] and not case.intact
        several.append(condition(damper, case.oil_level if bad else 1.0, 0 if bad else 1, case.model if bad else DEFAULT))
    return several


def varied(brakes: Brakes, seed: int) -> Brakes:
    """The slip control of a seed: the given one for the first, else with thresholds and rates scattered by SCATTER.

    A stop hangs on how thresholds and wheel hop fall together; a single control would pass for the tyre's or the road's.
    """
    if seed == 1:
        return brakes
    rng = np.random.default_rng([seed, 7])
    names = ("slip_release", "slip_build", "build", "release", "cycle")
    values = {name: getattr(brakes, name) * float(rng.uniform(1 - SCATTER, 1 + SCATTER)) for name in names}
    values["slip_build"] = min(values["slip_build"], 0.8 * values["slip_release"])
    return replace(brakes, **values)


def figures_of(car: FullCar, case: Case) -> dict[str, Any]:
    """The figures of a case; raises InputError where a piston leaves its tube."""
    car = replace(car, brakes=varied(car.brakes, case.seed))
    match case.maneuver:
        case "ride":
            figures = ride_figures(car, driven.ride(car, case.speed_kmh, RIDE_SECONDS, driven.Road(case.road, case.seed)))
        case "braking":
            figures = braking_figures(car, driven.braking(car, case.speed_kmh, driven.Road(case.road, case.seed)))
        case "cornering":
            run = driven.cornering(car, case.speed_kmh, driven.Road(case.road, case.seed))
            figures = cornering_figures(car, run)
            if case.road != driven.SMOOTH:  # a few seconds of an uneven road give no gradient
                figures = {name: value for name, value in figures.items() if not name.endswith("per_g")}
        case "table3":
            figures = ride_figures(car, driven.table3_drive(car, TABLE_3[case.road], case.seed), settled=0.0)
        case _:
            raise InputError(f"maneuver {case.maneuver}: must be one of {', '.join(HEADLINES)}")
    return figures | {"dlc_worst": max(figures["dlc"].values())}


def cases(
    maneuvers: Iterable[str], speeds: Sequence[float], roads: Sequence[str], levels: Sequence[float], seeds: int
) -> list[Case]:
    """All cases, the intact ones included; the drives of Table 3 have roads and speeds of their own.

    On a smooth road seeds differ in the slip control alone; where neither differs there is one.
    """
    wanted = []
    for maneuver in maneuvers:
        if maneuver == "table3":
            places = [(drive.speed_kmh, name, drive.profile is table3.uneven) for name, drive in TABLE_3.items()]
        else:
            places = [
                (speed, road, road != driven.SMOOTH or maneuver == "braking")
                for speed in speeds
                for road in roads
                if not (maneuver == "ride" and road == driven.SMOOTH)
            ]
        wanted += [
            Case(maneuver, speed, road, seed, level, model)
            for speed, road, differs in places
            for seed in range(1, (seeds if differs else 1) + 1)
            for level in (1.0, *(x for x in levels if x != 1.0))
            for model in ((DEFAULT,) if level == 1.0 else (*VARIED, SCALAR))
        ]
    return wanted


def drive_all(
    car: CarSet, front: Damper, rear: Damper, worn: str, wanted: Sequence[Case], progress: bool = True
) -> list[dict[str, Any]]:
    """The entries of all cases, in their order; one whose piston leaves its tube says so in `failed`."""
    return driven_all([(car, dampers_of(front, rear, worn, case), case) for case in wanted], progress)


def driven_all(jobs: Sequence[tuple[CarSet, Sequence[Damper], Case]], progress: bool = True) -> list[dict[str, Any]]:
    """The entries of cars with four dampers and what they drive, on all cores; else as `drive_all`."""
    with ThreadPoolExecutor(os.cpu_count()) as threads:
        bar = tqdm(threads.map(entry, jobs), total=len(jobs), unit="drive", leave=False, disable=None if progress else True)
        return list(bar)


def entry(job: tuple[CarSet, Sequence[Damper], Case]) -> dict[str, Any]:
    """One drive: what `Case` says and its figures."""
    car, dampers, case = job
    row: dict[str, Any] = {name: getattr(case, name) for name in Case.__dataclass_fields__}
    try:
        return row | figures_of(full_car(car, dampers), case)
    except InputError as error:
        return row | {
            "failed": f"{case.maneuver} at {case.speed_kmh:g} km/h on {case.road}, {case.oil_level:.0%} oil: {error}"
        }


def compared(entries: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Rows of headline figures, worn over intact on the same road, of the full model and of the scalar factor.

    The change is the mean over seeds with the default way of the freed gas, its band that over all seeds and VARIED.
    """
    intact = {key(row): row for row in entries if row["oil_level"] == 1.0}
    groups: dict[tuple[Any, ...], list[dict[str, Any]]] = {}
    for row in entries:
        if row["oil_level"] != 1.0:
            model = SCALAR if row["model"] == SCALAR else FULL
            groups.setdefault((*key(row)[:3], row["oil_level"], model), []).append(row)
    rows = []
    for (maneuver, speed, road, level, model), some in groups.items():
        name, title, unit = HEADLINES[maneuver]
        pairs = [(row.get(name), intact[key(row)].get(name)) for row in some]
        ratios = [a / b for a, b in pairs if a is not None and b]
        usual = [row for row in some if row["model"] in (DEFAULT, SCALAR)]
        means = [row.get(name) for row in usual]
        shares = [
            a / intact[key(row)][name] for a, row in zip(means, usual, strict=True) if a and intact[key(row)].get(name)
        ]
        rows.append({
            "maneuver": maneuver, "speed_kmh": speed, "road": road, "oil_level": level, "model": model,
            "figure": title, "unit": unit, "seeds": len(usual), "failed": len(some) - len(ratios),
            "intact": mean_of([b for _, b in pairs]), "worn": mean_of(means),
            "change": float(np.mean(shares) - 1) if shares else None,
            "change_band": [min(ratios) - 1, max(ratios) - 1] if shares else None,
        })  # fmt: skip
    return rows


def key(row: dict[str, Any]) -> tuple[Any, ...]:
    """What worn and intact drives share."""
    return row["maneuver"], row["speed_kmh"], row["road"], row["seed"]


def mean_of(values: Sequence[float | None]) -> float | None:
    """Mean of those that are there."""
    some = [value for value in values if value is not None]
    return float(np.mean(some)) if some else None
