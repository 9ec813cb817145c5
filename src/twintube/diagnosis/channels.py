"""The measuring channels: what every measurement has, and what may be wrong with one."""

from dataclasses import dataclass

import numpy as np

from twintube.diagnosis.problem import Free, Problem
from twintube.diagnosis.records.seen import BENDS, CLOCK, INERTIA, STROKE_GAIN, TIME_BASE
from twintube.diagnosis.rules import RULES

TARED = "tared_cell"  # set to zero with the damper in it

FAULT_TITLES = {
    TARED: "Load cell set to zero with the damper in it",
    "force_offset": "Zero of the load cell",
    "force_gain": "Calibration of the force channel",
    "channel_delay": "Delay between the channels",
    STROKE_GAIN: "Calibration of the stroke channel",
    TIME_BASE: "Time base of the recorder",
    "zero_drift": "Drifting zero of the load cell",
    CLOCK: "Clock of the force channel",
    INERTIA: "Inertia of the clamp",
}


@dataclass(frozen=True)
class ChannelFault:
    """What may be wrong with a channel: its parameter with the range it is sought in, and what every measurement has."""

    name: str
    unit: str
    neutral: float
    low: float
    high: float
    usual: float
    text: str  # a sentence


def nuisances(problem: Problem) -> tuple[Free, ...]:
    """What every measurement has: a small zero of the load cell, a part of a sample of delay, means or points as samples."""
    zero = RULES.small_zero * max(record.peak for record in problem.records)
    late = usual_delay(problem)
    known = problem.usual
    free = [
        Free("force_offset", known.get("force_offset", 0.0), -zero, zero),
        Free("channel_delay", known.get("channel_delay", 0.0), -late, late),
    ]
    # So few samples are read one by one, as the logger did.
    if any((record.samples[record.judged] <= 2 * RULES.steps_per_interval).any() for record in problem.records):
        free.append(Free("sample_mean", known.get("sample_mean", 0.5), 0.0, 1.0))
        most = RULES.bends
        free += [Free(name, known.get(name, 0.0), -most, most) for name in BENDS]
    return tuple(free)


def usual_delay(problem: Problem) -> float:
    """The delay [s] that sampling leaves open: a mean over the interval is late by half of it, a filter by a sample."""
    samples = RULES.open_samples if unfiltered(problem) else RULES.open_filtered
    return max(RULES.small_delay, samples * period(problem))


def unfiltered(problem: Problem) -> bool:
    """Whether steps of the force are known to be as sharp as the samples: a filter takes part of each bend away."""
    return problem.usual.get("bend_about", -np.inf) > -RULES.bent


def period(problem: Problem) -> float:
    """The usual time [s] between two measured samples."""
    return float(np.median([record.period for record in problem.records]))


def faults(problem: Problem) -> list[ChannelFault]:
    """What may be wrong with a measuring channel in all records alike."""
    peak = max(record.peak for record in problem.records)
    lasting = [np.ptp(record.time) for record in problem.records]
    duration, longest = float(np.median(lasting)), float(max(lasting))
    usual = {free.name: free.high for free in nuisances(problem)}
    zero, late = RULES.zero_range * peak, max(RULES.delay_range, RULES.delay_samples * period(problem))
    drift = zero / duration
    sway = max(float(np.quantile(np.abs(problem.accelerations(problem.v)[0]), RULES.speed_quantile)), 1e-9)  # [m/s2]
    several = [
        ("force_offset", "N", (0.0, -zero, zero), usual["force_offset"],
         "The force channel reads a constant in addition to the force."),
        ("force_gain", "1", (1.0, *RULES.gain_range), RULES.small_gain,
         "The force channel reads all forces too large or too small."),
        ("channel_delay", "s", (0.0, -late, late), usual["channel_delay"],
         "Force and stroke are not recorded simultaneously."),
        (STROKE_GAIN, "1", (1.0, *RULES.stroke_range), RULES.small_gain,
         "The stroke channel reads all strokes too large or too small."),
        (TIME_BASE, "1", (1.0, *RULES.time_range), RULES.small_gain,
         "The times in the files run too fast or too slow, as with another sampling rate than the stated one."),
        ("zero_drift", "N/s", (0.0, -drift, drift), RULES.small_force * peak / longest,
         "The zero of the load cell moves during each record."),
        ("clock_error", "1", (0.0, -RULES.clock_range, RULES.clock_range), usual["channel_delay"] / duration,
         "The clock of the force channel runs faster or slower than that of the stroke."),
        (INERTIA, "kg", (0.0, -RULES.clamp_mass, RULES.clamp_mass), RULES.small_force * peak / sway,
         "Between load cell and damper a mass is moved, whose inertia the cell reads with the force of the damper."),
    ]  # fmt: skip
    return [ChannelFault(name, unit, *bounds, least, text) for name, unit, bounds, least, text in several]
