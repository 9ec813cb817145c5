"""What worn dampers change in the whole car: manoeuvres over oil levels, roads and seeds, against the intact car."""

import os
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any

import numpy as np

from twintube.common.bars import Bar
from twintube.dampers import Damper
from twintube.dampers.freed_gas import DEFAULT, SCALAR, VARIED, condition
from twintube.engine.simulate import InputError
from twintube.vehicle import maneuvers as table3
from twintube.vehicle.cars import CarSet
from twintube.vehicle.full.brakes import Brakes
from twintube.vehicle.full.car import WHEELS
from twintube.vehicle.full.catalogue import MANEUVERS, TABLE_3, Case
from twintube.vehicle.full.maneuvers import SMOOTH
from twintube.vehicle.full.run import CarRun, FullCar, full_car

WORN = {"all": (0, 1, 2, 3), "front": (0, 1), "rear": (2, 3)} | {name: (i,) for i, name in enumerate(WHEELS)}
FULL = "full model"
SCATTER = 0.25  # of thresholds and rates of the slip control, from seed to seed: assumed
USUAL = ("ride", "braking", "cornering")


def dampers_of(front: Damper, rear: Damper, worn: str, case: Case) -> list[Damper]:
    """The four dampers, those of `worn` in the case's state; raises InputError for an unknown place."""
    if worn not in WORN:
        raise InputError(f"worn {worn}: must be one of {', '.join(WORN)}")
    several = []
    for i in range(len(WHEELS)):
        damper = front if i < 2 else rear
        bad = i in WORN[worn] and not case.intact
        state = (case.oil_level, case.gas_preload, case.model) if bad else (1.0, 1, DEFAULT)
        several.append(condition(damper, *state))
    return several


def varied(brakes: Brakes, seed: int) -> Brakes:
    """The slip control of a seed: the given one for the first, else with thresholds and rates scattered by SCATTER.

    A stop hangs on how thresholds and wheel hop fall together; a single control would pass for the tyre's or the road's.
    """
    if seed == 1:
        return brakes
    rng = np.random.default_rng([seed, 7])
    names = ("slip_release", "slip_build", "fall", "build", "release", "cycle")
    values = {name: getattr(brakes, name) * float(rng.uniform(1 - SCATTER, 1 + SCATTER)) for name in names}
    values["slip_build"] = min(values["slip_build"], 0.8 * values["slip_release"])
    return replace(brakes, **values)


def run_of(car: FullCar, case: Case) -> CarRun:
    """The drive of a case, with the slip control of its seed; raises InputError where a piston leaves its tube."""
    return MANEUVERS[case.maneuver].drive(replace(car, brakes=varied(car.brakes, case.seed)), case)


def figures_of(car: FullCar, case: Case) -> dict[str, Any]:
    """The figures of a case; raises as `run_of`."""
    figures = MANEUVERS[case.maneuver].figures(car, case, run_of(car, case))
    return figures | {"dlc_worst": max(figures["dlc"].values())}


def cases(
    maneuvers: Iterable[str],
    speeds: Sequence[float] | None,
    roads: Sequence[str],
    levels: Sequence[float],
    *,
    seeds: int,
    grips: tuple[float, float] = (1.0, 1.0),
    gas_preload: float = 1.0,
) -> list[Case]:
    """All cases, the intact ones included; the drives of Table 3 have roads and speeds of their own, all others speeds.

    Below 100 % oil the worn dampers have the share `gas_preload` [1] of their gas preload.

    On a smooth road seeds differ in the slip control alone; where neither differs there is one. Raises InputError where
    nothing is left to drive.
    """
    wanted = []
    for name in maneuvers:
        maneuver = MANEUVERS[name]
        if name == "table3":
            places = [(drive.speed_kmh, key, drive.profile is table3.uneven) for key, drive in TABLE_3.items()]
        else:
            places = [
                (speed, road, road != SMOOTH or maneuver.seeded)
                for speed in speeds or maneuver.speeds
                for road in roads
                if (maneuver.smooth if road == SMOOTH else maneuver.uneven)
            ]
        wanted += [
            Case(name, speed, road, seed, level, model, grips, 1.0 if level == 1.0 else gas_preload)
            for speed, road, differs in places
            for seed in range(1, (seeds if differs else 1) + 1)
            for level in (1.0, *(x for x in levels if x != 1.0))
            for model in ((DEFAULT,) if level == 1.0 else (*VARIED, SCALAR))
        ]
    if not wanted:
        raise InputError(f"nothing to drive: a {', '.join(maneuvers)} is not driven on the road class {', '.join(roads)}")
    return wanted


def drive_all(
    car: CarSet, front: Damper, rear: Damper, worn: str, wanted: Sequence[Case], *, progress: bool = True
) -> list[dict[str, Any]]:
    """The entries of all cases, in their order; one whose piston leaves its tube says so in `failed`."""
    return driven_all([(car, dampers_of(front, rear, worn, case), case) for case in wanted], progress)


def driven_all(jobs: Sequence[tuple[CarSet, Sequence[Damper], Case]], progress: bool = True) -> list[dict[str, Any]]:
    """The entries of cars with four dampers and what they drive, on all cores; else as `drive_all`."""
    with ThreadPoolExecutor(os.cpu_count()) as threads:
        bar = Bar(threads.map(entry, jobs), total=len(jobs), unit="drive", leave=False, disable=None if progress else True)
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
        name, title, unit = MANEUVERS[maneuver].headline
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
            "beside": [
                {"name": key_, "figure": words, "unit": unit_,
                 "intact": mean_of([intact[key(row)].get(key_) for row in usual]),
                 "worn": mean_of([row.get(key_) for row in usual])}
                for key_, words, unit_ in MANEUVERS[maneuver].beside
            ],
        })  # fmt: skip
    return rows


def key(row: dict[str, Any]) -> tuple[Any, ...]:
    """What worn and intact drives share."""
    return row["maneuver"], row["speed_kmh"], row["road"], row["seed"]


def mean_of(values: Sequence[float | None]) -> float | None:
    """Mean of those that are there."""
    some = [value for value in values if value is not None]
    return float(np.mean(some)) if some else None
