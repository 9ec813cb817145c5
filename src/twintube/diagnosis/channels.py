"""The measuring channels: what every measurement has, and what may be wrong with one, see faults.toml."""

import tomllib
from dataclasses import dataclass
from importlib.resources import files

import numpy as np

from twintube.diagnosis.problem import Free, Problem
from twintube.diagnosis.records.seen import BENDS, INERTIA, STROKE_GAIN, TIME_BASE
from twintube.diagnosis.rules import RULES

TARED = "tared_cell"  # set to zero with the damper in it


@dataclass(frozen=True)
class BenchFault:
    """What may be wrong with the bench: an entry of faults.toml."""

    title: str
    repair: str
    unit: str = "1"
    neutral: float = 0.0
    prior: float = 0.0  # 0 of one that is not sought among the hypotheses
    low: float = 0.0
    high: float = 0.0
    of: str = "1"
    means: str = ""
    acts: str = ""

    def times(self, peak: float, longest: float) -> float:
        """What prior and range are multiples of, for records of a largest force [N] and duration [s]."""
        return {"1": 1.0, "peak": peak, "peak_over_time": peak / longest}[self.of]


KNOWN = tomllib.loads(files("twintube.diagnosis").joinpath("faults.toml").read_text(encoding="utf-8"))
FAULTS: dict[str, BenchFault] = {name: BenchFault(**entry) for name, entry in KNOWN.items()}
SOUGHT = {name: fault for name, fault in FAULTS.items() if fault.prior > 0.0}


@dataclass(frozen=True)
class ChannelFault:
    """A fault in the range it is sought in, and what every measurement has of it."""

    name: str
    neutral: float
    low: float
    high: float
    usual: float


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
    sway = max(float(np.quantile(np.abs(problem.accelerations(problem.v)[0]), RULES.speed_quantile)), 1e-9)  # [m/s2]
    usual = {free.name: free.high for free in nuisances(problem)}
    usual |= dict.fromkeys(("force_gain", STROKE_GAIN, TIME_BASE), RULES.small_gain)
    usual |= {"zero_drift": RULES.small_force * peak / longest, INERTIA: RULES.small_force * peak / sway}
    usual["clock_error"] = usual["channel_delay"] / duration
    several = []
    for name, fault in SOUGHT.items():
        low, high = (x * fault.times(peak, duration) for x in (fault.low, fault.high))
        several.append(ChannelFault(name, fault.neutral, low, high, usual[name]))
    return several
