"""The whole measurement plan of Table 3: bench measurements, and drives as damper strokes in a quarter car."""

from collections.abc import Iterator

import numpy as np

from twintube.dampers import Damper
from twintube.rig.plan import Measurement, amplitude, bench_plan
from twintube.rig.signals import PRECONDITIONING, V_PRECONDITIONING, Signal, oscillations
from twintube.vehicle.cars import axle, load_car
from twintube.vehicle.drive import drive
from twintube.vehicle.maneuvers import DT, MANEUVERS, Maneuver, wheel_input


def drive_signal(damper: Damper, maneuver: Maneuver, seed: int = 1) -> Signal:
    """Strokes of the intact damper in a quarter car during a drive, after the preconditioning.

    The corner of the car follows from the damper. The paper measured these strokes; here they are simulated.
    """
    height, push = wheel_input(maneuver, axle(damper), seed)
    run = drive(damper.with_(oil_level=1.0, gas_preload=1), load_car().corner(damper), height, DT, push=push)
    t0, z0, v0 = oscillations(V_PRECONDITIONING, amplitude(damper), PRECONDITIONING, 2e-3)
    return Signal(
        time=np.concatenate([t0, t0[-1] + DT + run.time]),
        stroke=np.concatenate([z0, run.stroke]),
        velocity=np.concatenate([v0, run.velocity]),
        marks=np.array([len(t0), len(t0) + len(height) - 1]),
    )


def plan(damper: Damper, seed: int = 1) -> Iterator[Measurement]:
    """All measurements of Table 3; raises InputError if the piston would leave the tube in a drive."""
    yield from bench_plan(damper)
    for maneuver in MANEUVERS:
        yield Measurement(maneuver.number, maneuver.name, "stochastic", drive_signal(damper, maneuver, seed))
