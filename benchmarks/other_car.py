"""`python -m benchmarks.other_car FOLDER`: the monitor on a car that another program drives.

The car is a multi-body model of 29 states of `commonroad-vehicle-models` (TU Munich). Its dampers are linear: a worn one has
a share of its constant. Its road is flat and its tyre rolls on a constant radius, so that wheel speeds show hardly any road.
A copy of its text gets road heights at the deflections of the tyres, loads that do not pull, a rolling radius that falls
with load as in `vehicle/full/rolling.py`, and a constant for each damper. Sensors and roads are those of `twintube drive`;
the roads' seeds belong to neither group of its study.
"""

import inspect
import math
import re
from collections import namedtuple
from dataclasses import asdict, replace
from pathlib import Path
from typing import Annotated, Any, Final

import numba
import numpy as np
import typer

from twintube.cli.base import standalone
from twintube.common.arrays import Array
from twintube.driving.channels import PLACES
from twintube.driving.drives import CURVES, SETTLED, WANDER, slow_noise
from twintube.driving.monitor import watch
from twintube.driving.scenes import RUNOUT, TOOTH
from twintube.driving.sensors import INERTIAL, RASTER, STEERING, VERTICAL, Encoder, resolutions, rounded, sensed, wheel_speed
from twintube.driving.signals import Signals
from twintube.driving.writing import write
from twintube.errors import InputError
from twintube.vehicle.full.rolling import shrinking
from twintube.vehicle.road import SPACING
from twintube.vehicle.tracks import tracks

PACKAGE: Final = "commonroad-vehicle-models"
ROAD, SPEED, SECONDS, DT = "C", 70.0 / 3.6, 120.0, 0.001  # class, [m/s], [s], [s]
NOMINAL: Final = 5500.0  # [N] load of the tyre whose rolling radius is used, 205/60 R15
SEEDS: Final = 5_000_000  # of the roads, from here on
GAINS: Final = (5.0, 0.5)  # [1/s] of the driver: for steer angle and speed
shrunk: Any = numba.njit(shrinking)


def rewritten(text: str) -> str:
    """The model's function over `x, uInit, p, h, share`: road heights [m], share of each damper's constant; InputError."""
    changes = {r"def vehicle_dynamics_mb\(x, uInit, p\)": "def model(x, uInit, p, h, share)"}
    for i, place in enumerate(("LF", "RF", "LR", "RR")):
        changes |= {
            rf"(F_z_{place} = )(.*)\*p\.K_zt": rf"\1max((\2 + h[{i}])*p.K_zt, 1.0)",
            rf"(s_{place.lower()} = 1 - )p\.R_w": rf"\1radius(F_z_{place}, {i}, p)",
            rf"dz_S{place}\*p\.K_sd": rf"share[{i}]*\g<0>",
        }
    for pattern, new in changes.items():
        text, found = re.subn(pattern, new, text)
        if found != 1:
            raise InputError(f"{PACKAGE}: {found} places of {pattern} in its model: must be 1, as in release 3.0.2")
    return text.replace("tireModel.", "")


@numba.njit
def radius(load: float, i: int, p: Any) -> float:
    """Rolling radius [m] of a wheel at a `load` [N]; that of the sheet at the car's own weight."""
    usual = 0.5 * 9.81 * (p.m_s * (p.b if i < 2 else p.a) / (p.a + p.b) + (p.m_uf if i < 2 else p.m_ur))
    return float(p.R_w - NOMINAL / p.K_zt * (shrunk(load / NOMINAL) - shrunk(usual / NOMINAL)))


def frozen(name: str, values: dict[str, Any]) -> Any:
    """Parameters as numba takes them: a named tuple of numbers, and of such tuples."""
    known = {key: frozen(key, each) if isinstance(each, dict) else each for key, each in values.items() if each is not None}
    return namedtuple(name, known)(**known)


def loaded(number: int) -> tuple[Any, Any, Array]:
    """Compiled model, parameters and state at rest of a car of the package; raises InputError where it is not installed."""
    try:
        from vehiclemodels import init_mb, vehicle_dynamics_mb, vehicle_parameters
        from vehiclemodels.utils import acceleration_constraints, steering_constraints, tire_model, vehicle_dynamics_ks_cog
    except ModuleNotFoundError as error:
        raise InputError(f"the package {PACKAGE} is not installed: pip install {PACKAGE}") from error
    space: dict[str, Any] = {"math": math, "radius": radius}
    for module in (steering_constraints, acceleration_constraints, tire_model, vehicle_dynamics_ks_cog):
        exec(inspect.getsource(module), space)
    exec(rewritten(inspect.getsource(vehicle_dynamics_mb.vehicle_dynamics_mb)), space)
    space |= {name: numba.njit(each) for name, each in space.items() if inspect.isfunction(each)}
    p = vehicle_parameters.setup_vehicle_parameters(number)
    return space["model"], frozen("car", asdict(p)), np.array(init_mb.init_mb([0.0] * 7, p))


@numba.njit
def driven(  # noqa: PLR0917 - numba takes no keywords
    model: Any, p: Any, x: Array, road: Array, share: Array, wanted: Array
) -> Array:
    """What moves the sensors (n, 13): spins and accelerations of the wheels, three of the body, yaw rate, steer angle.

    `road` (2, m) are heights every SPACING, `wanted` (n, 2) steer angle and speed. As in the model z is down, yaw clockwise.
    """
    out, way = np.empty((len(wanted), 13)), 0.0
    heights, u, slopes = np.empty(4), np.empty(2), np.zeros((4, len(x)))
    for n in range(len(wanted)):
        u[0], u[1] = GAINS[0] * (wanted[n, 0] - x[2]), GAINS[1] * (wanted[n, 1] - x[3])
        for k, part in enumerate((0.0, 0.5, 0.5, 1.0)):
            for i in range(4):
                place = (way + part * DT * x[3] + (p.a + p.b if i < 2 else 0.0)) / SPACING
                at = int(place)
                heights[i] = road[i % 2, at] + (place - at) * (road[i % 2, at + 1] - road[i % 2, at])
            slopes[k] = np.array(model(x + part * DT * slopes[k - 1], u, p, heights, share))
        f = slopes[0]
        for i in range(4):
            axle, track = (13, p.T_f) if i < 2 else (18, p.T_r)
            out[n, i], out[n, 4 + i] = x[23 + i], f[axle + 4] + (0.5 if i % 2 else -0.5) * track * f[axle + 1]
        out[n, 8:] = np.array([f[3] - x[5] * x[10], f[10] + x[5] * x[3], f[12], x[5], x[2]])
        way += DT * x[3]
        x = x + DT / 6.0 * (slopes[0] + 2.0 * slopes[1] + 2.0 * slopes[2] + slopes[3])
    return out


def signals(car: tuple[Any, Any, Array], share: Array, seed: int) -> Signals:
    """A drive over the road of a `seed` with the constant of each damper times its `share`, (4,) in the order of PLACES."""
    model, p, rest = car
    random, count = np.random.default_rng([SEEDS, seed]), round((SECONDS + SETTLED) / DT)
    steer = CURVES[0] * slow_noise(count, DT, CURVES[1], random) * (p.a + p.b) / SPEED**2
    wanted = np.column_stack([steer, SPEED * (1.0 + WANDER[0] * slow_noise(count, DT, WANDER[1], random))])
    road = tracks(1.3 * SPEED * count * DT + 10.0, 0.5 * (p.T_f + p.T_r), road_class=ROAD, seed=SEEDS + seed)
    start = np.array([0.0, 0.0, 0.0, SPEED, *rest[4:23], *[SPEED / p.R_w] * 4, *rest[27:]])
    moved = driven(model, p, start, road - road[:, :1], share, wanted)[round(SETTLED / DT) :]
    values = {}
    for i, place in enumerate(PLACES):
        encoder = Encoder.drawn(np.random.default_rng([SEEDS, i]), TOOTH, RUNOUT)
        values[f"wheel_speed_{place}_rad_per_s"] = wheel_speed(moved[:, i], DT, encoder, p.R_w)
    felt = (moved[:, 8], -moved[:, 9], -moved[:, 11], np.zeros(len(moved)), *-moved[:, 4:8].T, -moved[:, 10])
    for (name, sensor), each in zip((INERTIAL | VERTICAL).items(), felt, strict=True):
        values[name] = sensed(each, DT, sensor, random)
    values["steering_angle_rad"] = rounded(-moved[:: round(RASTER / DT), 12], float(STEERING))
    sheet = {"wheelbase_m": p.a + p.b, "track_front_m": p.T_f, "track_rear_m": p.T_r, "wheel_radius_m": p.R_w}
    time = np.arange(round(SECONDS / RASTER)) * RASTER
    return Signals(time, values, {"name": PACKAGE} | sheet, {"seconds": SECONDS}, resolutions(p.R_w, values))


def main(
    folder: Annotated[Path, typer.Argument(help="Where the drives are written, as Parquet.")],
    number: Annotated[int, typer.Option("--car", help="1 Ford Escort, 2 BMW 320i, 3 VW Vanagon.", min=1, max=3)] = 2,
    share: Annotated[float, typer.Option(help="Constant of a worn damper over a good one.", min=0.0, max=1.0)] = 0.3,
    drives: Annotated[int, typer.Option(help="Drives of each kind, each over its own road.", min=1, max=100)] = 1,
) -> None:
    """Judge drives of 2 minutes against one good drive: all dampers good, and each in turn worn."""
    car = loaded(number)
    folder.mkdir(exist_ok=True)
    reference = signals(car, np.ones(4), 0)
    write(reference, folder / "reference.parquet")
    for i, kind in enumerate(["good", *PLACES] * drives):
        drive = signals(car, np.array([share if place == kind else 1.0 for place in PLACES]), i + 1)
        write(drive, folder / f"{kind}_{i + 1}.parquet")
        for absent in ({}, VERTICAL):
            both = [replace(x, values={n: v for n, v in x.values.items() if n not in absent}) for x in (drive, reference)]
            answer = watch(both[0], both[1:])
            said = [f"{each.place} {each.state} {each.probability:.3f} ({each.damping:.2f})" for each in answer.dampers]
            typer.echo(f"{kind:5} {answer.sensors:21} {'; '.join(said)}; coherence {answer.coherence:.2f}")


if __name__ == "__main__":
    standalone(main)()
