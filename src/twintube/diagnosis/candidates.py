"""What may be the cause: the effects of the catalogue and the faults of the measurement."""

import itertools
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.polynomial import Polynomial

from twintube.core import effects
from twintube.core.hooks import Effect, sources
from twintube.diagnosis.fit import Free, Problem
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.seen import BENDS, CLOCK, DELAY, LINEAR, SETTLING, STROKE_GAIN

FAULT_TITLES = {
    "force_offset": "Zero of the load cell",
    "force_gain": "Calibration of the force channel",
    "channel_delay": "Delay between the channels",
    "stroke_gain": "Calibration of the stroke channel",
    "zero_drift": "Drifting zero of the load cell",
    "clock_error": "Clock of the force channel",
}


def hooked(hooks: str) -> tuple[str, ...]:
    """The effects that have one of some hooks, joined by |."""
    return tuple(name for name, text in sources().items() if re.search(rf"^def {name}_({hooks})\(", text, re.M))


LATENESS = hooked("force|transition")  # effects that make the force late
LATE = (*LATENESS, DELAY, CLOCK)  # and faults that do
FILLED = hooked("level")  # another fill than the recorded one, in all states alike or in one
# What changes volumes alone moves steps of the force, or brings them about.
MOVING = tuple(name for name in hooked("phases|derive") if name not in (*hooked("scale_fluid"), *FILLED))
FRICTION = tuple(name for name in sources() if name.endswith("_friction"))
RECALIBRATE = "recalibrate"
BOUND = (*MOVING, *(name for name in hooked("motion") if name not in LATE))  # what becomes of oil, freed gas and foam
ALIKE = (LATE, FRICTION, BOUND)  # of each a second only mends the formulation of the first
FADING = tuple(name for name in hooked("scale_fluid") if name in hooked("phases"))  # the force falls with what happened
# At a single velocity, beside what fades, another temperature at the start.
FACTORS = ("force_gain", STROKE_GAIN, *(name for name in hooked("scale_fluid") if name not in FADING))


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
    if any((record.samples[record.judged] < RULES.steps_per_interval).any() for record in problem.records):
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
                # A time constant below a sample cannot be told from sampling.
                time = max(RULES.small_delay, period(problem))
                usual = {"s": time, "N": RULES.small_force * peak}
                least[item.name] = usual.get(meta["unit"], RULES.acts * (high - low))
        units = {item.name: item.metadata["unit"] for item in effect.parameters}
        fills = problem.fills() if effect.name in FILLED else {}
        for name in fills if len(fills) > 1 else ():
            like = free[0]
            free.append(replace(like, name=name))
            least[name], units[name] = least[like.name], units[like.name]
        laws = tuple(item.name for item in effect.parameters if item.metadata["role"] == "law" and item.name not in unknown)
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


def unsought(effect: Effect, problem: Problem) -> tuple[str, ...]:
    """Parameters of heat for which the records have no temperature, or which a temperature along them makes needless."""
    kelvin = tuple(item.name for item in effect.parameters if item.metadata["unit"] == "1/K")
    if kelvin and any(np.ptp(record.warm) > RULES.warm for record in problem.records):
        return tuple(item.name for item in effect.parameters if item.metadata["unit"] in ("1/J", "J", "s"))
    return () if np.ptp(np.concatenate([record.warm for record in problem.records])) > RULES.warm else kelvin


def faults(problem: Problem) -> list[Candidate]:
    """What may be wrong with a measuring channel in all records alike."""
    peak = max(record.peak for record in problem.records)
    lasting = [np.ptp(record.time) for record in problem.records]
    duration, longest = float(np.median(lasting)), float(max(lasting))
    usual = {free.name: free.high for free in nuisances(problem)}
    zero, late = RULES.zero_range * peak, max(RULES.delay_range, RULES.delay_samples * period(problem))
    drift = zero / duration
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
        ("zero_drift", "N/s", (0.0, -drift, drift), RULES.small_force * peak / longest,
         "The zero of the load cell moves during each record.", "the load cell read before and after a record"),
        ("clock_error", "1", (0.0, -RULES.clock_range, RULES.clock_range), usual["channel_delay"] / duration,
         "The clock of the force channel runs faster or slower than that of the stroke.", "both channels on a single clock"),
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


def grid(candidate: Candidate, f: Free) -> list[float]:
    """Values from which to begin: a strength over its range with both signs, a length or time near its usual value.

    A power or a share begins at its low end too, which is a law of its own; a share at the other end as well.
    """
    if f.name not in candidate.strength:
        if f.low < 0.0 < f.high:  # a place on either side
            return [float(x) for x in np.linspace(f.low, f.high, RULES.places + 2)[1:-1]]
        near = [f.start, (f.low + f.start) / 2, (f.high * f.start) ** 0.5 if f.start > 0 else f.high / 2]
        near += ([f.low, f.high] if f.high == 1.0 else [f.low]) if f.name in candidate.laws else []
        return sorted({min(max(x, f.low), f.high) for x in near})
    sides = [(sign, side) for sign, side in ((1.0, f.high - f.start), (-1.0, f.start - f.low)) if side > 0]
    shares = np.geomspace(*RULES.shares_moving).tolist() if candidate.name in MOVING else RULES.shares
    shares = RULES.shares_calibration if candidate.name == RECALIBRATE else shares
    return [f.start + sign * share * side for share in shares for sign, side in sides]


def fills(most: float) -> list[float]:
    """Errors of a fill [1] up to `most`, to either side, from which a search begins."""
    fine, coarse, end = RULES.fills_tried
    near, far = np.arange(fine, end, fine), np.arange(end, most, coarse)
    return [*RULES.shares[:2], *near.tolist(), *far.tolist()]


def clock_starts(problems: Sequence[Problem], fixed: Sequence[Mapping[str, float]]) -> list[float]:
    """Errors of the clock that explain the records best, seen by moving the forces of the model without one.

    Over a long record a clock drifts by whole oscillations, so that there are many local optima.
    """
    clocks = np.linspace(-RULES.clock_range, RULES.clock_range, RULES.clocks)
    costs = np.zeros(len(clocks))
    for problem, values in zip(problems, fixed, strict=True):
        forces = problem.forces(values)
        for record, a, b in zip(problem.records, problem.starts[:-1], problem.starts[1:], strict=True):
            elapsed = np.maximum(record.time - record.begin, 0.0)
            weight, measured = (problem.weight * problem.share)[a:b], problem.measured[a:b]
            for i, clock in enumerate(clocks):
                moved = np.interp(record.time - clock * elapsed, record.time, forces[a:b])
                costs[i] += float(np.sum((weight * (moved - measured)) ** 2))
    inner = costs[1:-1]
    lowest = 1 + np.flatnonzero((inner <= costs[:-2]) & (inner <= costs[2:]))
    return [float(clocks[i]) for i in lowest[np.argsort(costs[lowest])][: RULES.clock_starts]] or [0.0]


def best_start(
    problems: Sequence[Problem], candidate: Candidate, fixed: Sequence[Mapping[str, float]]
) -> tuple[float, dict[str, float]]:
    """The point that explains the records best, and their sum of squares there; strength after strength joins if it helps.

    A strength that does not help is not in the point: it stays neutral, as free it would follow the noise.

    `fixed` holds the other values in each of the problems. The measurement is free: at the zero of the model without the
    cause a residual spring would start as a loss, and behind the delay that stands in for a late effect it would not show.
    """
    free = [nuisances(problem) if candidate.name in LATENESS else linear(problem) for problem in problems]
    grids = {f.name: grid(candidate, f) for f in candidate.free}
    if candidate.single:  # a step of the force comes or goes with some thousandths of the oil
        grids |= {f.name: [x for size in fills(f.high) for x in (size, -size)] for f in candidate.free}
    if CLOCK in grids:
        grids[CLOCK] = clock_starts(problems, fixed)
    shapes = [f.name for f in candidate.free if f.name not in candidate.strength][: RULES.shapes]
    best, low = {f.name: f.start for f in candidate.free}, np.inf

    def costs(points: Sequence[Mapping[str, float]]) -> list[float]:
        some = [
            problem.costs([{**values, **point} for point in points], values, measured)
            for problem, values, measured in zip(problems, fixed, free, strict=True)
        ]
        return [sum(cost) for cost in zip(*some, strict=True)]

    neutral = costs([best])[0]
    left = list(candidate.strength)
    while left:
        # Lengths and times are sought together with the first strength, then each by itself: a stop has an onset of its own.
        some = [dict(zip(shapes, other, strict=True)) for other in itertools.product(*(grids[name] for name in shapes))]
        if len(left) < len(candidate.strength):
            some = [{}, *({name: x} for name in shapes for x in grids[name])]
        rows = [(name, x, shape) for name in left for x in grids[name] for shape in some]
        points = [best | {name: x} | shape for name, x, shape in rows]
        scores = costs(points)
        # Else a strength between two values of its grid loses against a value of another's.
        for name in left:
            own = [i for i, row in enumerate(rows) if row[0] == name]
            top = min(own, key=lambda i: scores[i])
            line = {best[name]: neutral} | {rows[i][1]: scores[i] for i in own if rows[i][2] == rows[top][2]}
            if (x := lowest(line)) not in line:
                points.append(points[top] | {name: x})
        scores += costs(points[len(rows) :]) if len(points) > len(rows) else []
        if min(scores) >= (1.0 - RULES.joins) * low:
            break
        point, low = points[int(np.argmin(scores))], min(scores)
        left, neutral = [name for name in left if point[name] == best[name]], low
        best = point
        if candidate.single:
            break
    return float(low), {name: x for name, x in best.items() if name not in left}


def lowest(costs: Mapping[float, float]) -> float:
    """Where a parabola through the lowest of some costs and its two neighbours is lowest; the lowest at an end of them."""
    x = np.array(sorted(costs))
    y = np.array([costs[value] for value in x.tolist()])
    i = int(np.argmin(y))
    if not 0 < i < len(x) - 1:
        return float(x[i])
    slope = Polynomial.fit(x[i - 1 : i + 2], y[i - 1 : i + 2], 2).deriv()
    return float(slope.roots()[0]) if slope.degree() == 1 and slope.coef[1] > 0.0 else float(x[i])
