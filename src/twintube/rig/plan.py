"""The bench measurements of the paper's plan (Table 3) for any damper, as excitation signals."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from twintube.dampers import Damper
from twintube.rig.signals import (
    BLOCKS,
    OSCILLATIONS,
    PRECONDITIONING,
    STARTS,
    V_PRECONDITIONING,
    Signal,
    approach,
    harmonic_block,
    joined,
    oscillations,
    run_up,
)

V_QUASI_STATIC = 1e-3  # [m/s]
REST = 180.0  # seconds between measurements, at stroke 0
RAMPS = 2  # full cycles of the quasi-static measurement
# SA7, SA8 were measured at 17 velocities; which ones is assumed: the eight of the others and those between.
BLOCKS_17 = (0.05, 0.08, 0.131, 0.196, 0.262, 0.327, 0.393, 0.458, 0.524, 0.655, 0.786, 0.917, 1.048, 1.179, 1.31, 1.441,
             1.572)  # fmt: skip


# The measurement that would decide what becomes of the gas that cavitation frees (docs/open_choices.md).
RECOVERY_SECONDS = 60.0
RECOVERY_RESTS = (10.0, 30.0, REST)  # [s]
RECOVERY_LEVELS = (1.0, 0.9)  # oil levels, without preload, beside the measured ones
ABOVE = (1.2, 1.5)  # velocities of its blocks over v_cav: well above it, no hotter than needed, two to hold one out
V_RECOVERY = BLOCKS[-2] / ABOVE[0]  # [m/s] v_cav that they are made for at least


@dataclass(frozen=True)
class Measurement:
    """One signal of the plan. The samples before `marks[0]` are preconditioning."""

    number: int  # in Table 3
    name: str
    kind: str  # quasi-static | harmonic | stochastic
    signal: Signal


def amplitude(damper: Damper) -> float:
    """Amplitude [m] of the harmonic blocks: 90 % of the maximum stroke, or what the parameter set says (Section 2)."""
    return damper.measured_amplitude or 0.9 * damper.parameters.stroke_max


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


def bench_plan(damper: Damper) -> Iterator[Measurement]:
    """The measurements 1 and 2 of Table 3: quasi-static and harmonic. The drives are in `vehicle/plan.py`."""
    yield Measurement(1, "quasi-static", "quasi-static", quasi_static(damper))
    for v in velocities(damper):
        yield Measurement(2, f"harmonic {v:g} m/s", "harmonic", harmonic_block(v, amplitude(damper)))


def recovery_velocities(damper: Damper) -> tuple[float, ...]:
    """Maximum velocities [m/s] of the recovery blocks."""
    return tuple(share * max(V_RECOVERY, damper.parameters.v_cav) for share in ABOVE)


def recovery_signal(damper: Damper, v: float, rest: float, slow: bool) -> Signal:
    """Preconditioning, a minute at the maximum velocity `v` [m/s], a rest [s], `slow` strokes or none, then 19 oscillations.

    A closure in which the gas dissolves heals at rest, one in which oil is displaced by slow strokes. The marks are those of
    both blocks' oscillations; the rest lies between two of them.
    """
    reach, dt = amplitude(damper), 1e-3
    count = round(RECOVERY_SECONDS * v / (2 * np.pi * reach))
    conditioning = oscillations(V_PRECONDITIONING, reach, PRECONDITIONING, 2e-3)
    lead = run_up(v, reach, dt, STARTS["rebound"])
    way = approach(0.0, float(lead[1][0]), 2e-3)
    step = float(lead[0][1] - lead[0][0])
    long, short = (oscillations(v, reach, n, dt) for n in (count, OSCILLATIONS))
    again = [conditioning, way] if slow else [way]
    parts = [conditioning, way, lead, long, *again, lead, short]
    pauses = [2e-3, 2e-3, step, rest, *[2e-3] * (len(again) - 1), 2e-3, step]
    time, stroke, speed = joined(parts, pauses)
    starts = np.cumsum([0, *(len(part[0]) for part in parts)])
    per = (len(long[0]) - 1) // count
    marks = [starts[i] + per * np.arange(n + 1) for i, n in ((3, count), (len(parts) - 1, OSCILLATIONS))]
    return Signal(time, stroke, speed, np.concatenate(marks))


def recovery_plan(damper: Damper) -> Iterator[Measurement]:
    """The measurements that would decide between the closures, each at RECOVERY_LEVELS and the measured levels."""
    for v in recovery_velocities(damper):
        for slow in (False, True):
            for rest in RECOVERY_RESTS:
                how = "slow strokes" if slow else "nothing moved"
                name = f"recovery {v:.3g} m/s {rest:g} s {how}"
                yield Measurement(13, name, "harmonic", recovery_signal(damper, v, rest, slow))
