"""The paper's measurement plan (Table 3) for any damper, as excitation signals."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from twintube.drive import CORNERS, axle, drive
from twintube.maneuvers import DT, MANEUVERS, Maneuver, ridden
from twintube.parameters import Damper
from twintube.rig import BLOCKS, PRECONDITIONING, V_PRECONDITIONING, Signal, harmonic_block, oscillations

V_QUASI_STATIC = 1e-3  # [m/s]
REST = 180.0  # seconds between measurements, at stroke 0
RAMPS = 2  # full cycles of the quasi-static measurement
# SA7, SA8 were measured at 17 velocities; which ones is assumed: the eight of the others and those between.
BLOCKS_17 = (0.05, 0.08, 0.131, 0.196, 0.262, 0.327, 0.393, 0.458, 0.524, 0.655, 0.786, 0.917, 1.048, 1.179, 1.31, 1.441,
             1.572)  # fmt: skip


@dataclass(frozen=True)
class Measurement:
    """One signal of the plan. The samples before `marks[0]` are preconditioning."""

    number: int  # in Table 3
    name: str
    kind: str  # quasi-static | harmonic | stochastic
    signal: Signal


def amplitude(damper: Damper) -> float:
    """Amplitude [m] of the harmonic blocks: 90 % of the maximum stroke."""
    return 0.9 * damper.parameters.stroke_max


def velocities(damper: Damper) -> tuple[float, ...]:
    """Maximum velocities [m/s] of the harmonic blocks."""
    return BLOCKS_17 if damper.name in ("SA7", "SA8") else BLOCKS


def quasi_static(damper: Damper) -> Signal:
    """Ramps at 1 mm/s over 90 % of the stroke, from the middle and back.

    Sampled at 100 Hz, because the friction reverses within tenths of a millimetre.
    """
    reach = amplitude(damper)
    corners = np.concatenate([[0.0], np.tile([reach, -reach], RAMPS), [0.0]])
    at = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(corners)))]) / V_QUASI_STATIC
    time = np.arange(0.0, at[-1], 0.01)
    stroke = np.interp(time, at, corners)
    direction = np.sign(np.diff(corners))[np.clip(np.searchsorted(at, time, side="right") - 1, 0, len(corners) - 2)]
    return Signal(time, stroke, V_QUASI_STATIC * direction, np.array([0, len(time) - 1]))


def drive_signal(damper: Damper, maneuver: Maneuver, seed: int = 1) -> Signal:
    """Strokes of the intact damper in a quarter car during a drive, after the preconditioning.

    The car's corner is the damper's; the paper measured these strokes, here they are simulated.
    """
    corner = axle(damper)
    height, push = ridden(maneuver, corner, seed)
    run = drive(damper.with_(oil_level=1.0, gas_preload=1), CORNERS[corner], height, DT, push)
    t0, z0, v0 = oscillations(V_PRECONDITIONING, amplitude(damper), PRECONDITIONING, 2e-3)
    return Signal(
        time=np.concatenate([t0, t0[-1] + DT + run.time]),
        stroke=np.concatenate([z0, run.stroke]),
        velocity=np.concatenate([v0, run.velocity]),
        marks=np.array([len(t0), len(t0) + len(height) - 1]),
    )


def plan(damper: Damper, seed: int = 1) -> Iterator[Measurement]:
    """All measurements of Table 3; raises InputError where a drive takes the piston out of the tube."""
    yield Measurement(1, "quasi-static", "quasi-static", quasi_static(damper))
    for v in velocities(damper):
        yield Measurement(2, f"harmonic {v:g} m/s", "harmonic", harmonic_block(v, amplitude(damper)))
    for maneuver in MANEUVERS:
        yield Measurement(maneuver.number, maneuver.name, "stochastic", drive_signal(damper, maneuver, seed))
