"""The communication step: a wheel with the damper FMU in the loop, where only the exchange gets slower; a given motion."""

import tempfile
from pathlib import Path

import fmpy
import numpy as np

from twintube.common.arrays import Array
from twintube.core.variables import blank
from twintube.dampers import load
from twintube.demo.damper_fmu import DamperFmu
from twintube.demo.ride import precondition
from twintube.fmu import build_fmu
from twintube.vehicle.cars import load_car
from twintube.vehicle.quarter_car import Car, Motion, damper_stroke, leapfrog_step, static_load
from twintube.vehicle.ride import SETTLED, Track, ride, track

INNER = 2.5e-4  # [s] step of the car, so that its own error does not count
EVERY = (1, 2, 4, 8, 20, 40)  # steps of the car per communication step: 0.25 to 10 ms
SPEED, SECONDS = 50.0, 60.0  # [km/h], [s] on a class D road
STATES = {"intact": (1.0, 1), "60 %": (0.6, 0), "40 %": (0.4, 0)}
FINE = 1e-4  # [s] step of the given motion, and of the run that the others are compared with
LONGER = (5, 10, 20, 50, 100)  # of them: 0.5 to 10 ms
OPEN_SECONDS = 20.0  # [s]
OPEN_STATES = {"intact": (1.0, 1), "50 %": (0.5, 0)}


def wheel_loads(fmu: Path, car: Car, route: Track, state: tuple[float, int], every: int) -> list[float]:
    """Wheel loads [N] of the car's steps; motion goes to the damper every so many of them, then its force comes back."""
    level, preload = state
    m, loads = blank(Motion), []
    with DamperFmu(fmu, oil_level=level, gas_preload=preload) as damper:
        precondition(damper)
        force = damper.outputs()["force"]
        for i, (height, rate) in enumerate(zip(route.heights.tolist(), route.rates.tolist(), strict=True)):
            if i % every == 0:
                now, speed = damper_stroke(car, m), m.v_body - m.v_wheel + 0.5 * (m.dv_body - m.dv_wheel)
                coming = damper.step(now, car.ratio * speed, every * INNER)
            loads.append(leapfrog_step(car, m, height, rate, force, 0.0, INNER))
            if i % every == every - 1:
                force = coming  # known when both have done their step, as in any parallel master
    return loads


def given(fmu: Path, motion: tuple[Array, Array], state: tuple[float, int], every: int, mean: bool) -> tuple[Array, float]:
    """Forces [N] at the ends of the steps, and the work [J], where the stroke does not answer to the force.

    The velocity is that of the moment, or the mean of the coming step.
    """
    (stroke, velocity), h, (level, preload) = (values[::every] for values in motion), every * FINE, state
    velocity = np.diff(stroke) / h if mean else velocity[:-1]
    with DamperFmu(fmu, oil_level=level, gas_preload=preload) as damper:
        precondition(damper)
        before = damper.outputs()["work"]
        pairs = zip(stroke[:-1].tolist(), velocity.tolist(), strict=True)
        forces = np.array([damper.step(z, v, h) for z, v in pairs])
        return forces, damper.outputs()["work"] - before


def open_loop(fmu: Path, motion: tuple[Array, Array]) -> dict[str, dict[str, float]]:
    """Error of the force [% of its root mean square] and of the work [%] by state, kind of velocity and step."""
    found: dict[str, dict[str, float]] = {}
    for name, state in OPEN_STATES.items():
        exact, work = given(fmu, motion, state, 1, mean=True)
        for kind, mean in (("of the moment", False), ("mean of the step", True)):
            row = found[f"{name}, velocity {kind}"] = {}
            for every in LONGER:
                forces, spent = given(fmu, motion, state, every, mean=mean)
                error = forces - exact[every - 1 :: every][: len(forces)]
                head = f"{every * FINE * 1e3:g} ms"
                row[f"{head} force"] = round(100.0 * float(np.std(error) / np.std(exact)), 1)
                row[f"{head} work"] = round(100.0 * (spent / work - 1.0), 1)
    return found


def bench_steps() -> dict[str, dict[str, dict[str, float]] | dict[str, float]]:
    """DLC by state of the damper and communication step; errors of the force where the motion is given."""
    damper = load("SA8")
    car, route = load_car().corner(damper), track(SPEED, SECONDS, dt=INNER)
    settled = round(SETTLED / INNER)
    driven = ride(damper, car, track(SPEED, OPEN_SECONDS, dt=FINE))
    motion = driven.stroke, np.gradient(driven.stroke, FINE)
    with tempfile.TemporaryDirectory() as folder:
        fmu = build_fmu(damper, Path(folder) / "damper.fmu", platforms=(fmpy.platform,))
        closed = {
            f"DLC, {name}": {
                f"{every * INNER * 1e3:g} ms": round(
                    float(np.std(wheel_loads(fmu, car, route, state, every)[settled:]) / static_load(car)), 3
                )
                for every in EVERY
            }
            for name, state in STATES.items()
        }
        return {**closed, "given motion, errors [%]": open_loop(fmu, motion)}
