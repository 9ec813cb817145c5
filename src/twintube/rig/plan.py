"""The bench measurements of the paper's plan (Table 3) for any damper, as excitation signals."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from twintube.dampers import Damper
from twintube.rig.signals import (
    BLOCKS,
    ONE_METRE,
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
STROKE_SHARE = 0.9  # amplitude of the harmonic blocks over the maximum stroke (Section 2)
REST = 180.0  # seconds between measurements, at stroke 0
RAMPS = 2  # full cycles of the quasi-static measurement
# SA7, SA8 were measured at 17 velocities; which ones is assumed: the eight of the others and those between.
BLOCKS_17 = (0.05, 0.08, 0.131, 0.196, 0.262, 0.327, 0.393, 0.458, 0.524, 0.655, 0.786, 0.917, 1.048, 1.179, 1.31, 1.441,
             1.572)  # fmt: skip


# Measurements to decide between what freed gas does (docs/open_choices.md).
RECOVERY_SECONDS = 60.0
RECOVERY_RESTS = (10.0, 30.0, REST)  # [s]
RECOVERY_LEVELS = (1.0, 0.9)  # oil levels without preload, in addition to the measured ones
ABOVE = (1.2, 1.5)  # velocities of its blocks over v_cav: above it without needless heating; two, to hold one out
V_RECOVERY = ONE_METRE / ABOVE[0]  # [m/s] smallest v_cav that the blocks are made for


@dataclass(frozen=True)
class Measurement:
    """One signal of the plan. The samples before `marks[0]` are preconditioning."""

    number: int  # in Table 3
    name: str
    kind: str  # quasi-static | harmonic | stochastic
    signal: Signal


def amplitude(damper: Damper) -> float:
    """Amplitude [m] of the harmonic blocks: 90 % of the maximum stroke (Section 2), or the value of the parameter set."""
    return damper.measured_amplitude or STROKE_SHARE * damper.parameters.stroke_max


def oil_levels(damper: Damper) -> tuple[float, ...]:
    """Oil levels [1] of the measured states: intact and the two degraded ones of Table 2."""
    return (1.0, *damper.measured_levels)


def at_oil_level(damper: Damper, oil_level: float) -> Damper:
    """The damper at an oil level [1]; below 100 % the gas preload is lost, as in the paper's measurements."""
    return damper.with_(oil_level=oil_level, gas_preload=int(oil_level >= 1.0))


def velocities(damper: Damper) -> tuple[float, ...]:
    """Maximum velocities [m/s] of the harmonic blocks."""
    return BLOCKS_17 if damper.name in ("SA7", "SA8") else BLOCKS


def quasi_static(damper: Damper) -> Signal:
    """Ramps at 1 mm/s over 90 % of the stroke, from the middle and back.

    Sampled at 100 Hz, because the friction reverses within tenths of a millimetre.
    """
    reach = amplitude(damper)
    corners = np.concatenate([[0.0], np.tile([reach, -reach], RAMPS), [0.0]])
    corner_times = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(corners)))]) / V_QUASI_STATIC
    time = np.arange(0.0, corner_times[-1], 0.01)
    stroke = np.interp(time, corner_times, corners)
    ramp = np.clip(np.searchsorted(corner_times, time, side="right") - 1, 0, len(corners) - 2)
    direction = np.sign(np.diff(corners))[ramp]
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

    If the freed gas dissolves, the damper recovers at rest; if it displaces oil, it recovers in slow strokes. The marks are
    the oscillations of both blocks; the rest lies between two marks.
    """
    reach, dt = amplitude(damper), 1e-3
    count = round(RECOVERY_SECONDS * v / (2 * np.pi * reach))
    conditioning = oscillations(V_PRECONDITIONING, reach, PRECONDITIONING, 2e-3)
    lead = run_up(v, reach, dt, STARTS["rebound"])
    transfer = approach(0.0, float(lead[1][0]), 2e-3)
    step = float(lead[0][1] - lead[0][0])
    long_block, short_block = (oscillations(v, reach, n, dt) for n in (count, OSCILLATIONS))
    after_rest = [conditioning, transfer] if slow else [transfer]
    segments = [conditioning, transfer, lead, long_block, *after_rest, lead, short_block]
    pauses = [2e-3, 2e-3, step, rest, *[2e-3] * (len(after_rest) - 1), 2e-3, step]
    time, stroke, speed = joined(segments, pauses)
    starts = np.cumsum([0, *(len(segment[0]) for segment in segments)])
    samples = (len(long_block[0]) - 1) // count
    marks = [starts[i] + samples * np.arange(n + 1) for i, n in ((3, count), (len(segments) - 1, OSCILLATIONS))]
    return Signal(time, stroke, speed, np.concatenate(marks))


def recovery_plan(damper: Damper) -> Iterator[Measurement]:
    """The measurements to decide between the ways of the freed gas, each at RECOVERY_LEVELS and the measured levels."""
    for v in recovery_velocities(damper):
        for slow in (False, True):
            for rest in RECOVERY_RESTS:
                motion = "slow strokes" if slow else "nothing moved"
                name = f"recovery {v:.3g} m/s {rest:g} s {motion}"
                yield Measurement(13, name, "harmonic", recovery_signal(damper, v, rest, slow))
