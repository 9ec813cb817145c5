"""The wheel load and a bench along the loss of oil at constant gas, of gas at constant oil, and of both as in service."""

from collections.abc import Callable
from itertools import product

import numpy as np

from benchmarks.dead_length import ABOVE
from twintube.core.kernel.forces import P_AMBIENT
from twintube.dampers import Damper
from twintube.dampers.dead_length import collapse_level, prepared, reserve_gas
from twintube.dampers.freed_gas import SOLUBILITY, condition
from twintube.demo.bands import SEEDS, SPEEDS, course
from twintube.inspection import METHODS, Setting, read
from twintube.vehicle.cars import CarSet, axle, load_car
from twintube.vehicle.quarter_car import Car
from twintube.vehicle.ride import DT, measures, ride

LEVELS = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3)
SHARES = (1.0, 0.75, 0.5, 0.25, 0.0)  # of the gas preload
SECONDS = 120.0
KEPT, SERVICE, LOST = "gas at 100%", "as in service", "gas at 0%"
Figures = dict[str, dict[str, dict[str, float]]]


def in_service(damper: Damper, oil_level: float) -> float:
    """The share [1] of the gas preload that is left when the oil has leaked to a level and no gas by itself.

    The gas of the reserve takes the room of the oil, isothermally. What is dissolved, S per volume of oil and pressure,
    leaves with the oil or comes out of what stays: d(p (V_gas + S V_oil)) = p S dV_oil.
    """
    p, d = damper.parameters, prepared(damper.parameters)
    solubility, filled = sum(SOLUBILITY) / 2, P_AMBIENT + d.F_0 / d.A_rod
    room = reserve_gas(p, d) + solubility * p.V_oil
    taken = (1.0 - solubility) * (1.0 - oil_level) * p.V_oil
    pressure = filled * (room / (room + taken)) ** (1.0 / (1.0 - solubility))
    return max(0.0, float((pressure - P_AMBIENT) / (filled - P_AMBIENT)))


def paths(damper: Damper) -> dict[str, Callable[[float], float]]:
    """The share of the gas preload [1] over the oil level, by the name of the path; each SHARES is one at constant gas."""
    constant = {f"gas at {share:.0%}": lambda _, share=share: share for share in SHARES}
    return constant | {SERVICE: lambda level: in_service(damper, level)}


def frictions(car: CarSet, damper: Damper) -> tuple[float, ...]:
    """Friction of the suspension [N]: the car's own, and the ends of its band."""
    return (car.axles[axle(damper)]["friction"], *car.band["friction"])


def dlc(damper: Damper, car: Car, speed: float, seed: int) -> float:
    """Dynamic load coefficient [1] on a class D road."""
    return float(measures(ride(damper, car, course(speed, SECONDS, seed, DT)), car)["dlc"])


def rises(damper: Damper, car: CarSet, speed: float) -> Figures:
    """Rise of the DLC [%] over the intact damper in the same car on the same road, by path and oil level.

    `mean` is that of the roads with the car's own friction, `least` and `most` those of all roads and frictions.
    """
    corners = [car.corner(damper, friction=friction) for friction in frictions(car, damper)]
    cases = list(product(corners, SEEDS))
    intact = np.array([dlc(condition(damper, 1.0, 1.0), corner, speed, seed) for corner, seed in cases])
    found: Figures = {}
    for (name, share), level in product(paths(damper).items(), LEVELS):
        worn = condition(damper, level, share(level))
        rise = 100.0 * (np.array([dlc(worn, corner, speed, seed) for corner, seed in cases]) / intact - 1.0)
        own = rise[: len(SEEDS)].mean()
        cell = {"least": rise.min(), "mean": own, "most": rise.max()}
        row = found.setdefault(f"{speed:g} km/h, {name}", {})
        row[f"{level:.0%}"] = {key: round(float(value), 1) + 0.0 for key, value in cell.items()}
    return found


def turning(damper: Damper, car: Car, share: Callable[[float], float]) -> float:
    """The highest oil level [%], in whole per cent, at which EUSAMA fails along a path."""
    for percent in range(round(100 * collapse_level(damper)) + ABOVE, 0, -1):
        worn = condition(damper, percent / 100, share(percent / 100))
        if not METHODS["eusama"].passed(read(worn, car, ("eusama",), Setting())["eusama"]):
            return float(percent)
    return 0.0


def bench(damper: Damper, car: CarSet) -> dict[str, dict[str, float]]:
    """`turning` with each friction of the suspension, by path."""
    return {
        name: {f"{friction:g} N": turning(damper, car.corner(damper, friction=friction), paths(damper)[name])
               for friction in sorted(frictions(car, damper))}
        for name in (KEPT, SERVICE, LOST)
    }  # fmt: skip


def gas_path(damper: Damper) -> dict[str, Figures | dict[str, dict[str, float]]]:
    """All figures of a damper in the default car."""
    car = load_car()
    return {
        "preload in service": {damper.name: {f"{level:.0%}": round(in_service(damper, level), 3) for level in LEVELS}},
        "EUSAMA fails from [% of oil]": bench(damper, car),
        **{key: row for speed in SPEEDS for key, row in rises(damper, car, speed).items()},
    }
