"""The communication step: a wheel with the damper FMU in the loop, where only the exchange gets slower."""

import tempfile
from pathlib import Path

import fmpy
import numpy as np

from twintube.core.variables import blank
from twintube.dampers import load
from twintube.demo.damper_fmu import DamperFmu
from twintube.demo.ride import precondition
from twintube.fmu import build_fmu
from twintube.vehicle.cars import load_car
from twintube.vehicle.quarter_car import Car, Motion, damper_stroke, leapfrog_step, static_load
from twintube.vehicle.ride import SETTLED, Track, track

INNER = 2.5e-4  # [s] step of the car, so that its own error does not count
EVERY = (1, 2, 4, 8, 20, 40)  # steps of the car per communication step: 0.25 to 10 ms
SPEED, SECONDS = 50.0, 60.0  # [km/h], [s] on a class D road
STATES = {"intact": (1.0, 1), "60 %": (0.6, 0), "40 %": (0.4, 0)}


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


def bench_steps() -> dict[str, dict[str, float]]:
    """DLC by state of the damper and communication step."""
    damper = load("SA8")
    car, route = load_car().corner(damper), track(SPEED, SECONDS, dt=INNER)
    settled = round(SETTLED / INNER)
    with tempfile.TemporaryDirectory() as folder:
        fmu = build_fmu(damper, Path(folder) / "damper.fmu", platforms=(fmpy.platform,))
        return {
            f"DLC, {name}": {
                f"{every * INNER * 1e3:g} ms": float(
                    np.std(wheel_loads(fmu, car, route, state, every)[settled:]) / static_load(car)
                )
                for every in EVERY
            }
            for name, state in STATES.items()
        }
