"""What may be the cause: the effects of the catalogue and the faults of the measurement."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from twintube.core import effects
from twintube.core.hooks import Effect, sources
from twintube.diagnosis.fits.fit import Free, Problem
from twintube.diagnosis.records.seen import BENDS, CARRIED, CLOCK, DELAY, INERTIA, LINEAR, SETTLING, STROKE_GAIN, TIME_BASE
from twintube.diagnosis.rules import RULES

FAULT_TITLES = {
    "force_offset": "Zero of the load cell",
    "force_gain": "Calibration of the force channel",
    "channel_delay": "Delay between the channels",
    "stroke_gain": "Calibration of the stroke channel",
    "time_base": "Time base of the recorder",
    "zero_drift": "Drifting zero of the load cell",
    "clock_error": "Clock of the force channel",
    INERTIA: "Inertia of the clamp",
}


def hooked(hooks: str) -> tuple[str, ...]:
    """The effects that have one of some hooks, joined by |."""
    return tuple(name for name, text in sources().items() if re.search(rf"^def {name}_({hooks})\(", text, re.M))


LATENESS = hooked("force|transition")  # effects that make the force late
LATE = (*LATENESS, DELAY, CLOCK)  # and faults that do
DELAYED = (*LATENESS, INERTIA)  # for which a delay stands in
TURNING = hooked("force")  # what begins at a reversal
FILLED = hooked("level")  # another fill than the recorded one, in all states alike or in one
# What changes volumes alone moves steps of the force, or brings them about.
MOVING = tuple(name for name in hooked("phases|derive") if name not in (*hooked("scale_fluid"), *FILLED))
LOSING = hooked("lost")  # oil that is lost in a record is missing in those after it
FRICTION = tuple(name for name in sources() if name.endswith("_friction"))
RECALIBRATE = "recalibrate"
CONTENTS = (*MOVING, *(name for name in hooked("motion") if name not in LATE))  # what becomes of oil, freed gas and foam
ALIKE = (LATE, FRICTION, CONTENTS)  # of each a second only mends the formulation of the first
FADING = tuple(name for name in hooked("scale_fluid") if name in hooked("phases"))  # the force falls with what happened
# At a single velocity, beside what fades, another temperature at the start.
EXACT = ("force_gain",)  # a law without another formulation
FACTORS = (*EXACT, STROKE_GAIN, TIME_BASE, *(name for name in hooked("scale_fluid") if name not in FADING))
SCALING = (*FACTORS, *FADING)  # of which a second may only mend the formulation of the first


@dataclass(frozen=True)
class Candidate:
    """A possible cause: its parameters, and those of them that are neutral while it is absent."""

    name: str
    title: str
    cause: str
    free: tuple[Free, ...]
    strength: tuple[str, ...]
    units: Mapping[str, str]
    fault: bool
    decides: str  # the measurement that tells it from its look-alikes
    least: Mapping[str, float]  # strengths up to which every measurement has it
    laws: tuple[str, ...] = ()  # parameters whose lowest value is a law of its own
    single: bool = False  # its strengths exclude each other

    def joined(self, values: Mapping[str, float]) -> tuple[Free, ...]:
        """Its free parameters in a model that has `values`: strengths that are not among them stay neutral."""
        return tuple(f for f in self.free if f.name in values or f.name not in self.strength)


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


def linear(problem: Problem) -> tuple[Free, ...]:
    """Those of them in which forces are linear."""
    return tuple(f for f in nuisances(problem) if f.name in LINEAR)


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


def candidates(problem: Problem) -> list[Candidate]:
    """All effects that do not act already, and the faults."""
    reach = max(float(np.abs(record.stroke).max()) for record in problem.records)
    several = []
    peak = max(record.peak for record in problem.records)
    longest = max(float(np.ptp(record.time)) for record in problem.records)
    for effect in effects.EFFECTS.values():
        if effect.acts(problem.damper.parameters):
            continue
        free, least, unknown = [], {}, unsought(effect, problem)
        for item in effect.parameters:
            meta = item.metadata
            if item.name in unknown:
                continue
            low, high, start = meta["lower"], meta["upper"], meta["default"]
            if meta["role"] == "place" and high > reach > low:
                low, high, start = max(low, -reach), reach, start if low < 0.0 else RULES.place * reach
            free.append(Free(item.name, start, low, high, meta["default"] if meta["role"] == "strength" else None))
            if meta["role"] == "strength":
                # What is over within a sample cannot be told from sampling.
                time = max(RULES.small_delay, period(problem))
                usual = {"s": time, "N": RULES.small_force * peak, "1/s": RULES.small_decay / longest}
                usual |= {"m": turned_way(problem, time)} if effect.name in TURNING else {}
                least[item.name] = usual.get(meta["unit"], RULES.acts * (high - low))
        units = {item.name: item.metadata["unit"] for item in effect.parameters}
        carried = effect.name in LOSING and any(record.before[0] > 0.0 for record in problem.records)
        refilled = any(record.before_fill[0] > 0.0 for record in problem.records)
        free += [Free(CARRIED, 0.0, 0.0, 2.0 if refilled else 1.0)] if carried else []
        units |= {CARRIED: "1"} if carried else {}
        fills = problem.fills() if effect.name in FILLED else {}
        for name in fills if len(fills) > 1 else ():
            like = free[0]
            free.append(replace(like, name=name))
            least[name], units[name] = least[like.name], units[like.name]
        laws = tuple(item.name for item in effect.parameters if item.metadata["role"] == "law" and item.name not in unknown)
        laws += (CARRIED,) if carried else ()
        several.append(
            Candidate(
                effect.name,
                effect.title,
                effect.cause,
                tuple(free),
                tuple(least),
                units,
                False,
                effect.decides,
                least,
                laws,
                single=bool(fills),
            )
        )
    return [*several, *faults(problem)]


def turned_way(problem: Problem, time: float) -> float:
    """Stroke [m] that the piston goes in a time [s] after a reversal, in the usual record."""
    ways = []
    for record in problem.records:
        gained = np.abs(np.diff(record.velocity)) / np.maximum(np.diff(record.time), 1e-9)
        ways.append(0.5 * float(np.quantile(gained, RULES.speed_quantile)) * time**2)
    return float(np.median(ways))


def unsought(effect: Effect, problem: Problem) -> tuple[str, ...]:
    """Parameters of heat for which the records have no temperature.

    Those of the heat of the work are always sought: it warms the oil before the tube, where thermometers are.
    """
    kelvin = tuple(item.name for item in effect.parameters if item.metadata["unit"] == "1/K")
    apart = float(np.ptp([record.warm[0] for record in problem.records]))
    if apart > RULES.warm or any(np.ptp(record.warm) > RULES.warm for record in problem.records):
        return ()
    return kelvin[1:] if apart > RULES.begun_warm else kelvin  # so little shows in the fluid force, the first, alone


def faults(problem: Problem) -> list[Candidate]:
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
         "The force channel reads a constant in addition to the force.", "the load cell read with the damper taken out"),
        ("force_gain", "1", (1.0, *RULES.gain_range), RULES.small_gain,
         "The force channel reads all forces too large or too small.", "the load cell checked with a known weight"),
        ("channel_delay", "s", (0.0, -late, late), usual["channel_delay"],
         "Force and stroke are not recorded simultaneously.",
         "a record of the friction alone at high frequency: only a delay shifts it"),
        (STROKE_GAIN, "1", (1.0, *RULES.stroke_range), RULES.small_gain,
         "The stroke channel reads all strokes too large or too small.", "the stroke checked with a gauge block"),
        (TIME_BASE, "1", (1.0, *RULES.time_range), RULES.small_gain,
         "The times in the files run too fast or too slow, as with another sampling rate than the stated one.",
         "an oscillation of the rig timed with a stopwatch"),
        ("zero_drift", "N/s", (0.0, -drift, drift), RULES.small_force * peak / longest,
         "The zero of the load cell moves during each record.", "the load cell read before and after a record"),
        ("clock_error", "1", (0.0, -RULES.clock_range, RULES.clock_range), usual["channel_delay"] / duration,
         "The clock of the force channel runs faster or slower than that of the stroke.", "both channels on a single clock"),
        (INERTIA, "kg", (0.0, -RULES.clamp_mass, RULES.clamp_mass), RULES.small_force * peak / sway,
         "Between load cell and damper a mass is moved, whose inertia the cell reads with the force of the damper.",
         "the motion of a record repeated without the damper"),
    ]  # fmt: skip
    laws = dict.fromkeys(FAULT_TITLES, ()) | {"zero_drift": (Free(SETTLING, *RULES.settling),)}
    return [
        Candidate(
            name,
            FAULT_TITLES[name],
            text,
            (Free(name, *bounds, neutral=bounds[0]), *laws[name]),
            (name,),
            {name: unit} | {law.name: "1/s" for law in laws[name]},
            True,
            decides,
            {name: least},
            tuple(law.name for law in laws[name]),
        )
        for name, unit, bounds, least, text, decides in several
    ]
