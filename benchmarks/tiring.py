"""The plate that watches a damper tire: what does not tire it, what does, what plate it needs; and the same from a road."""

import os
from itertools import product

import numpy as np

from twintube.common.processes import pool
from twintube.dampers import Damper, load
from twintube.dampers.freed_gas import DEFAULT, VARIED, condition
from twintube.dampers.variants import scalar_factor
from twintube.inspection.benches import DT
from twintube.inspection.rough_road import road_growth
from twintube.inspection.scatter import FADE, HEAT, Sample, samples
from twintube.inspection.tiring import LIMIT, Tired, heated, not_judged, run_on, runs, shaker
from twintube.vehicle.cars import load_car
from twintube.vehicle.ride import track

EARLY, LATE = (2.0, 4.0), (19.0, 21.0)  # [s] from the start of the plate: another reader's two windows
ROADS = (("D", 30.0), ("D", 50.0), ("E", 30.0))  # class and speed [km/h]
SEEDS, SECONDS = range(1, 9), 40.0
OIL = (0.9, 0.8, 0.7, 0.6)
TIRING = ("SA1", "SA2", "SA3", "SA5", "SA7", "SA8")  # in the others cavitation frees no gas: they are not judged
CARS = 30  # drawn


def window(run: Tired, ends: tuple[float, float]) -> float:
    """Root mean square [m/s] of the damper's velocity between two times."""
    inside = (run.time >= ends[0]) & (run.time <= ends[1])
    return float(np.sqrt(np.mean(run.answer[inside] ** 2)))


def row(damper: Damper, amplitude_mm: float, **changes: float) -> dict[str, float]:
    """What a run on a plate of that amplitude says, and 1 as `judged` where it says something; `changes` of the car."""
    car, (plate,) = load_car().corner(damper, **changes), shaker([1e-3 * amplitude_mm])
    run = run_on(damper, car, plate, DT)
    figures = {
        "first": float(run.answer[0]), "largest": float(run.answer.max()), "growth": run.growth,
        "late/early": window(run, LATE) / window(run, EARLY), "force growth": run.force_growth,
        "off the plate": run.contact_lost, "fastest": run.peak,
    }  # fmt: skip
    judged = float(not not_judged(damper, car, [run], DT))
    return {name: round(value, 2) for name, value in figures.items()} | {"judged": judged}


def bench_tiring() -> dict[str, dict[str, dict[str, float]]]:
    """Variants that are no oil loss; oil loss under each way of the freed gas; amplitudes of the plate."""
    sa8 = load("SA8")
    tyre = load_car().corner(sa8).c_tyre
    variants = {"intact": row(sa8, 6.0)}
    variants |= {f"F-v curve x {x:g}": row(sa8.with_(**scalar_factor(x)), 6.0) for x in (0.75, 0.5)}
    variants |= {f"tyre x {x:g}": row(sa8, 6.0, c_tyre=x * tyre) for x in (1.2, 0.8)}
    variants["intact, heated by the run"] = row(heated(sa8, FADE), 6.0)
    loss = {f"SA8 6 mm {level:.0%} {way}": row(condition(sa8, level, 0, way), 6.0) for level in OIL for way in VARIED}
    late = condition(sa8.with_(cavitation_loss=0.4), 0.9, 0, DEFAULT)
    loss["SA8 6 mm 90%, cavitation from 40%"] = row(late, 6.0)
    for name, levels in (("SA7", (0.8, 0.7)), ("SA1", (0.7,))):
        states = {f"{name} 8 mm {x:.0%} {way}": condition(load(name), x, 0, way) for x in levels for way in VARIED}
        loss |= {head: row(damper, 8.0) for head, damper in states.items()}
    plates = {f"SA8 {mm:g} mm 90%": row(condition(sa8, 0.9, 0), mm) for mm in (3.0, 5.0, 6.0, 8.0, 10.0)}
    return {"no oil loss": variants, "oil loss": loss, "plates": plates}


def heat_growth(job: tuple[float, str, Sample]) -> float:
    """Growth of an intact damper by the heat of its runs alone, in one car on one tester, at a fade [1/K]."""
    fade, name, sample = job
    damper = load(name)
    found = runs(sample.made(damper), sample.corner(damper, load_car()), sample.setting().shaker, DT, fade=fade)
    return max(run.growth for run in found)


def bench_tiring_heat() -> dict[str, dict[str, dict[str, float]]]:
    """What the limit of `tiring` follows from: the largest growth of intact dampers, and how many of them pass it."""
    fades = np.linspace(HEAT.low, HEAT.high, 4).tolist()
    jobs = list(product(fades, TIRING, samples(CARS, 1)))
    with pool(os.cpu_count() or 1) as workers:
        grown = np.reshape(list(workers.map(heat_growth, jobs)), (len(fades), len(TIRING), CARS))
    tables = {"largest growth": np.max(grown, axis=2), f"share above {LIMIT:g}": np.mean(grown > LIMIT, axis=2)}
    return {
        title: {
            f"{100 * fade:.1f} % per kelvin": dict(zip(TIRING, np.round(row, 3).tolist(), strict=True))
            for fade, row in zip(fades, table, strict=True)
        }
        for title, table in tables.items()
    }


def bench_rough_road() -> dict[str, dict[str, dict[str, float]]]:
    """Growth on rough roads over the intact SA8's on the same road: mean, lowest and highest of several roads."""
    sa8 = load("SA8")
    car = load_car().corner(sa8)
    states = {f"{level:.0%} oil": condition(sa8, level, 0) for level in OIL}
    states["scalar factor 0.5"] = sa8.with_(**scalar_factor(0.5))
    found: dict[str, dict[str, dict[str, float]]] = {}
    for road_class, speed in ROADS:
        routes = [track(speed, SECONDS, road_class=road_class, seed=seed) for seed in SEEDS]
        table = found[f"class {road_class}, {speed:g} km/h"] = {}
        for head, damper in states.items():
            values = [road_growth(damper, car, route, sa8) for route in routes]
            table[head] = {
                "mean": round(float(np.mean(values)), 2),
                "lowest": round(min(values), 2),
                "highest": round(max(values), 2),
            }
    return found
