"""Claims about the force within a slow stroke: C1, C2 and C15."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from twintube.claims.claim import (
    BENCH,
    DEAD,
    FV_STANDIN,
    MODEL_ERROR,
    PAPER,
    STAND_IN,
    VISIBLE,
    Bench,
    Claim,
    Dampers,
    rounded,
    run,
)
from twintube.claims.lengths import dead_lengths_that_hold, starts_in_words, starts_that_hold
from twintube.common.arrays import Array
from twintube.dampers import Damper
from twintube.rig.plan import oil_levels
from twintube.rig.signals import SLOWEST, Signal

DIRECTIONS = ("rebound", "compression")
STEPPED = 0.08  # maximum velocity [m/s] of Figure 27
SHARP, STEP = 5e-3, 1e-3  # travel [m] of a sharp rise and of a step
JUDGED = 0.9  # share of the amplitude that is evaluated; beyond it the piston is slow and the friction reverses
STILL = 1e-9  # [m/s] rounding of a velocity at rest
HALF = 0.5  # a force above half of the intact one is not "very low"


def strokes(signal: Signal, direction: str) -> list[slice]:
    """The complete strokes from end to end in one direction, after the preconditioning, in order."""
    first = int(signal.marks[0])
    period = int(signal.marks[1]) - first
    sign = 1.0 if direction == "rebound" else -1.0
    moving = np.concatenate([[False], sign * signal.velocity[first:] > STILL, [False]])
    edges = np.flatnonzero(np.diff(moving.astype(int)))
    return [slice(first + a, first + b) for a, b in edges.reshape(-1, 2) if b - a >= 0.45 * period]


@dataclass(frozen=True)
class Stroke:
    """One stroke of a degraded damper and of the intact one; forces [N] without F_0, positive against the motion."""

    travel: Array  # [m], rising
    at: Array  # stroke [m] from the middle
    force: Array
    intact: Array
    fluid: Array
    intact_fluid: Array
    intact_damping: Array  # fluid and friction


def last_strokes(damper: Damper, oil_level: float, velocity: float, bench: Bench) -> dict[str, Stroke]:
    """The last stroke of a block in both directions."""
    signal, low = run(damper, oil_level, velocity, bench)
    _, full = run(damper, 1.0, velocity, bench)
    by_direction = {}
    for direction in DIRECTIONS:
        span, sign = strokes(signal, direction)[-1], 1.0 if direction == "rebound" else -1.0
        at = signal.stroke[span] - bench.position
        by_direction[direction] = Stroke(
            travel=sign * at,
            at=at,
            force=sign * low.force[span],
            intact=sign * (full.force[span] + damper.parameters.F_0),
            fluid=sign * low.F_fluid[span],
            intact_fluid=sign * full.F_fluid[span],
            intact_damping=sign * (full.F_fluid[span] + full.F_friction[span]),
        )
    return by_direction


def largest_gain(travel: Array, low: Array, full: Array, length: float) -> tuple[float, int, int]:
    """Largest gain [N] of the force `low` over `length` [m] of travel, and its first and last sample.

    The gain of `full`, the intact damper, over the same travel is subtracted: it is due to the velocity.
    """
    inner = np.flatnonzero(np.abs(travel) <= JUDGED * np.abs(travel).max())
    ends = np.minimum(np.searchsorted(travel, travel[inner] + length), inner[-1])
    gain = (low[ends] - low[inner]) - np.maximum(0.0, full[ends] - full[inner])
    best = int(np.argmax(gain))
    return float(gain[best]), int(inner[best]), int(ends[best])


def spread(damper: Damper, oil_level: float, bench: Bench) -> float:
    """Largest distance of the 19 slow loops from the last one in the diagram, as a share of either axis [1]."""
    signal, result = run(damper, oil_level, SLOWEST, bench)
    span = slice(signal.marks[0], signal.marks[-1])
    points = np.column_stack([x[span] / np.ptp(x[span]) for x in (result.stroke, result.force)])
    last = points[signal.marks[-2] - signal.marks[0] :]
    last = np.vstack([last, last[:1]])
    # The lines between the samples belong to the loop; otherwise a step of the force would leave a gap.
    fine = np.arange(0, len(last) - 1, 0.05)
    drawn = np.column_stack([np.interp(fine, np.arange(len(last)), column) for column in last.T])
    return float(cKDTree(drawn).query(points, p=np.inf)[0].max())


def all_spreads(dampers: Dampers, bench: Bench) -> dict[str, float]:
    """`spread` of every damper at 100 % and both measured levels."""
    return {f"{n} at {x:.0%}": spread(d, x, bench) for n, d in dampers.items() for x in oil_levels(d)}


def c1(dampers: Dampers, bench: Bench = BENCH) -> Claim:
    """Slow oscillations coincide."""
    spreads = all_spreads(dampers, bench)
    beyond = [name for name, distance in spreads.items() if distance > VISIBLE]
    worst = max(spreads, key=spreads.__getitem__)
    return Claim(
        id="C1",
        quote="It can be seen that all 19 oscillations of a condition are well superimposed.",
        statement="at 0.05 m/s the 19 oscillations coincide, at every oil level",
        source="Section 3.1, Figure 8",
        tested="the force-displacement loops of the 19 oscillations, every damper at 100 % and both measured levels: in the "
        f"diagram no point of one is further from the last than {VISIBLE:.0%} of either axis, the line of a diagram",
        holds=not beyond,
        figures={"largest_distance": rounded(spreads[worst], 4), "at": worst, "limit": VISIBLE, "beyond": beyond},
        needs=DEAD,
        because="" if not beyond else STAND_IN,
        reason=""
        if not beyond
        else f"{', '.join(beyond)} differ, because no complete slow stroke precedes the first oscillation; all "
        "coincide " + starts_in_words(starts_that_hold(bench, lambda b: max(all_spreads(dampers, b).values()) <= VISIBLE)),
        calibrated=tuple(dampers),
    )


@dataclass(frozen=True)
class Rise:
    """The rise of the force within a slow stroke; forces relative to the intact damper [1]."""

    before: float  # lowest damping force before it
    gain: float  # within SHARP, relative to the highest intact damping force
    after: float  # highest force after it at the same stroke, without F_0
    fluid_after: float  # the same of the fluid force
    at: float  # stroke [m]

    @property
    def exists(self) -> bool:
        """Whether the force is first at most half of the intact one and then gains at least the model's error."""
        return self.before <= HALF and self.gain >= MODEL_ERROR


def rise_of(stroke: Stroke) -> Rise:
    """The rise of the force in a stroke."""
    gain, begin, end = largest_gain(stroke.travel, stroke.force, stroke.intact_damping, SHARP)
    inner = np.abs(stroke.travel) <= JUDGED * np.abs(stroke.travel).max()
    before, after = inner.copy(), inner.copy()
    before[begin + 1 :], after[:end] = False, False
    return Rise(
        before=float((stroke.force / stroke.intact_damping)[before].min()),
        gain=gain / float(stroke.intact_damping.max()),
        after=float((1 + (stroke.force - stroke.intact) / stroke.intact_damping)[after].max()),
        fluid_after=float((stroke.fluid / stroke.intact_fluid)[after].max()),
        at=float(stroke.at[begin]),
    )


def rises(damper: Damper, bench: Bench = BENCH) -> dict[str, Rise]:
    """The rises in both directions at the lowest measured level and 0.05 m/s."""
    strokes_by_direction = last_strokes(damper, damper.measured_levels[-1], SLOWEST, bench)
    return {direction: rise_of(stroke) for direction, stroke in strokes_by_direction.items()}


def peak_to_peak(damper: Damper, bench: Bench) -> float:
    """Height of the degraded loop over that of the intact one [1]; a static force does not change it."""
    heights = []
    for level in (damper.measured_levels[-1], 1.0):
        signal, result = run(damper, level, SLOWEST, bench)
        heights.append(float(np.ptp(result.force[signal.marks[-2] :])))
    return heights[0] / heights[1]


def c2(dampers: Dampers, bench: Bench = BENCH) -> Claim:
    """Low force first, then a sharp rise to a level below the intact one."""
    table = {name: rises(damper, bench) for name, damper in dampers.items()}
    without_rise = [f"{n} {d}" for n in table for d in DIRECTIONS if not table[n][d].exists]
    reached = [f"{n} {d}" for n in table for d in DIRECTIONS if table[n][d].exists and table[n][d].after >= 1.0]
    whole_fluid_force = [
        f"{n} {d}" for n in table for d in DIRECTIONS if table[n][d].exists and table[n][d].fluid_after > 1 - VISIBLE
    ]
    shares = [(r["rebound"].fluid_after, r["compression"].fluid_after) for r in table.values()]
    closest = min(max(abs(a[0] - b[0]), abs(a[1] - b[1])) for i, a in enumerate(shares) for b in shares[:i])
    holds = not without_rise and not reached and closest > VISIBLE
    reason = []
    if without_rise:

        def both_rise(candidate: Damper) -> bool:
            return all(rise.exists for rise in rises(candidate, bench).values())

        where = [
            f"{n} {dead_lengths_that_hold(dampers[n], both_rise)}"
            for n in dict.fromkeys(text.split()[0] for text in without_rise)
        ]
        reason.append(f"no sharp rise from a very low force in {', '.join(without_rise)}; both exist in {'; '.join(where)}")
    if reached:
        caps = ", ".join(f"{cap_below_intact(dampers, text, bench):.2f} in {text.split()[0]}" for text in reached)
        reason.append(
            f"the intact force is reached in {', '.join(reached)}, because equation 23 sets k = 1 once V1 holds no gas; "
            f"it would stay below with k capped at {caps}"
        )
    return Claim(
        id="C2",
        quote="For the degraded state, it can also be seen that the damping forces in the rebound and compression stages "
        "are initially very low and increase sharply from a certain point of deflection. Furthermore, it can be seen "
        "that the forces of the intact SAs are not reached after this increase. The relative proportion of the forces in "
        "relation to the intact SAs is different for each SA and is therefore SA-specific.",
        statement="40 %, 0.05 m/s: force first very low, then a sharp rise to a level below the intact force, different "
        "for each damper",
        source="Section 3.1, Figure 8",
        tested="the force without the static F_0 (the paper's gas force is a slope), last oscillation, both directions, all "
        f"dampers, within {JUDGED:.0%} of the amplitude: before the rise at most half of the intact damping force; gains "
        f"more than {MODEL_ERROR:.0%} of it within {SHARP * 1e3:.0f} mm (the model's own error); then below the intact "
        "force at the same stroke; no two dampers end at the same shares",
        holds=holds,
        figures={
            "damping_force_before_gain_force_after_fluid_after": {
                n: {d: [rounded(x, 2) for x in (r.before, r.gain, r.after, r.fluid_after)] for d, r in t.items()}
                for n, t in table.items()
            },
            "rise_at_mm": {n: {d: rounded(r.at * 1e3, 0) for d, r in t.items()} for n, t in table.items()},
            "loop_height_over_intact": {n: rounded(peak_to_peak(d, bench)) for n, d in dampers.items()},
            "without_rise": without_rise,
            "intact_force_reached": reached,
            "whole_fluid_force_reached": whole_fluid_force,
            "closest_shares_differ_by": rounded(closest),
        },
        needs=f"{DEAD}, {FV_STANDIN}, gas stiffness (assumed)",
        because="" if holds else PAPER,
        reason="; ".join(reason),
        calibrated=tuple(dampers),
    )


def cap_below_intact(dampers: Dampers, reached: str, bench: Bench) -> float:
    """Largest k_degr [1] after the rise at which the force stays below the intact one.

    `reached` names a damper and a direction, e.g. `SA1 rebound`.
    """
    name, direction = reached.split()
    stroke = last_strokes(dampers[name], dampers[name].measured_levels[-1], SLOWEST, bench)[direction]
    _, _, end = largest_gain(stroke.travel, stroke.force, stroke.intact_damping, SHARP)
    after = np.abs(stroke.travel) <= JUDGED * np.abs(stroke.travel).max()
    after[:end] = False
    available = stroke.intact - (stroke.force - stroke.fluid)
    return float((available / stroke.intact_fluid)[after].min())


def steps(damper: Damper, bench: Bench = BENCH) -> dict[str, float]:
    """Largest step of the fluid force at 0.08 m/s and the higher level, relative to the highest intact force [1]."""
    return {
        direction: largest_gain(s.travel, s.fluid, s.intact_fluid, STEP)[0] / float(s.intact_fluid.max())
        for direction, s in last_strokes(damper, damper.measured_levels[0], STEPPED, bench).items()
    }


def c15(dampers: Dampers, bench: Bench = BENCH) -> Claim:
    """Steps of the force where oil begins to flow."""
    table = {name: steps(dampers[name], bench) for name in ("SA1", "SA7")}
    without_step = [n for n, t in table.items() if max(t.values()) < MODEL_ERROR]
    return Claim(
        id="C15",
        quote="The force steps can be explained by the different types of fluid flows. As soon as oil begins to flow "
        "through a valve, the damping force increases.",
        statement="SA1 (text) or SA7 (caption), 60 %, 0.08 m/s: the force steps within a stroke as oil begins to flow "
        "through a valve",
        source="Section 3.3, Figure 27",
        tested="the gain of the fluid force less that of the intact damper (due to the velocity), over 1 mm, last "
        f"oscillation: at least {MODEL_ERROR:.0%} of the highest intact fluid force (the model's own error) in one "
        "direction, in both dampers because the paper names both",
        holds=not without_step,
        figures={"largest_step_over_intact_force": {n: {d: rounded(x) for d, x in t.items()} for n, t in table.items()}},
        needs=f"{DEAD}, {FV_STANDIN}",
        because="" if not without_step else STAND_IN,
        reason=f"the oil fills both working chambers of {', '.join(without_step)} at this dead length"
        if without_step
        else "",
        calibrated=("SA1", "SA7"),
    )
