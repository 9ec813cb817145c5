"""Claims about the force within a slow stroke: C1, C2 and C15."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from twintube.arrays import Array
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
from twintube.claims.lengths import beginning, holding, starting
from twintube.dampers import Damper
from twintube.rig.signals import BLOCKS, Signal

DIRECTIONS = ("rebound", "compression")
SLOWEST, STEPPED = BLOCKS[0], 0.08  # maximum velocities [m/s] of Figures 8 and 27
SHARP, STEP = 5e-3, 1e-3  # ways [m] over which a sharp rise and a step happen
JUDGED = 0.9  # share of the amplitude; beyond it the piston hardly moves and friction reverses
HALF = 0.5  # a force above half of the intact one is not "very low"


def strokes(signal: Signal, direction: str) -> list[slice]:
    """The complete strokes from end to end in one direction, after the preconditioning, in order."""
    first = int(signal.marks[0])
    period = int(signal.marks[1]) - first
    sign = 1.0 if direction == "rebound" else -1.0
    moving = np.concatenate([[False], sign * signal.velocity[first:] > 1e-9, [False]])
    edges = np.flatnonzero(np.diff(moving.astype(int)))
    return [slice(first + a, first + b) for a, b in edges.reshape(-1, 2) if b - a >= 0.45 * period]


@dataclass(frozen=True)
class Stroke:
    """One stroke of a degraded damper beside the intact one; forces [N] without F_0, positive against the motion."""

    way: Array  # [m], rising
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
    found = {}
    for direction in DIRECTIONS:
        part, sign = strokes(signal, direction)[-1], 1.0 if direction == "rebound" else -1.0
        at = signal.stroke[part] - bench.position
        found[direction] = Stroke(
            way=sign * at,
            at=at,
            force=sign * low.force[part],
            intact=sign * (full.force[part] + damper.parameters.F_0),
            fluid=sign * low.F_fluid[part],
            intact_fluid=sign * full.F_fluid[part],
            intact_damping=sign * (full.F_fluid[part] + full.F_friction[part]),
        )
    return found


def largest_gain(way: Array, low: Array, full: Array, length: float) -> tuple[float, int, int]:
    """Largest gain [N] of `low` over `length` [m] of the way, and where it begins and ends.

    What `full`, the intact damper, gains there by its velocity is taken off.
    """
    inner = np.flatnonzero(np.abs(way) <= JUDGED * np.abs(way).max())
    ends = np.minimum(np.searchsorted(way, way[inner] + length), inner[-1])
    gain = (low[ends] - low[inner]) - np.maximum(0.0, full[ends] - full[inner])
    best = int(np.argmax(gain))
    return float(gain[best]), int(inner[best]), int(ends[best])


def apart(damper: Damper, oil_level: float, bench: Bench) -> float:
    """How far the 19 slow loops lie from the last one in the diagram, as a share of either axis [1]."""
    signal, result = run(damper, oil_level, SLOWEST, bench)
    span = slice(signal.marks[0], signal.marks[-1])
    points = np.column_stack([x[span] / np.ptp(x[span]) for x in (result.stroke, result.force)])
    last = points[signal.marks[-2] - signal.marks[0] :]
    last = np.vstack([last, last[:1]])
    # The lines between the samples belong to the loop, or a step of the force would be a gap.
    fine = np.arange(0, len(last) - 1, 0.05)
    drawn = np.column_stack([np.interp(fine, np.arange(len(last)), column) for column in last.T])
    return float(cKDTree(drawn).query(points, p=np.inf)[0].max())


def distances(dampers: Dampers, bench: Bench) -> dict[str, float]:
    """`apart` of every damper at 100 % and both measured levels."""
    return {f"{n} at {x:.0%}": apart(d, x, bench) for n, d in dampers.items() for x in (1.0, *d.measured_levels)}


def c1(dampers: Dampers, bench: Bench = BENCH) -> Claim:
    """Slow oscillations coincide."""
    found = distances(dampers, bench)
    away = [name for name, distance in found.items() if distance > VISIBLE]
    worst = max(found, key=found.__getitem__)
    return Claim(
        id="C1",
        quote="It can be seen that all 19 oscillations of a condition are well superimposed.",
        statement="at 0.05 m/s the 19 oscillations coincide, at every oil level",
        source="Section 3.1, Figure 8",
        tested="the force-displacement loops of the 19 oscillations, every damper at 100 % and both measured levels: in the "
        f"diagram no point of one is further from the last than {VISIBLE:.0%} of either axis, the line of a diagram",
        holds=not away,
        figures={"largest_distance": rounded(found[worst], 4), "at": worst, "limit": VISIBLE, "beyond": away},
        needs=DEAD,
        because="" if not away else STAND_IN,
        reason=""
        if not away
        else f"{', '.join(away)} differ, because the first oscillation does not follow a whole slow stroke; all "
        "coincide " + beginning(starting(bench, lambda b: max(distances(dampers, b).values()) <= VISIBLE)),
        calibrated=tuple(dampers),
    )


@dataclass(frozen=True)
class Rise:
    """The rise of the force within a slow stroke; forces relative to the intact damper's [1]."""

    before: float  # lowest damping force before it
    gain: float  # within SHARP, relative to the highest intact damping force
    after: float  # highest force after it at the same stroke, without F_0
    fluid_after: float  # the same of the fluid force
    at: float  # stroke [m]

    @property
    def is_there(self) -> bool:
        """Whether the force is first below half of the intact one and then gains more than the model's own error."""
        return self.before <= HALF and self.gain >= MODEL_ERROR


def rise_of(stroke: Stroke) -> Rise:
    """Measure the rise."""
    gain, begin, end = largest_gain(stroke.way, stroke.force, stroke.intact_damping, SHARP)
    inner = np.abs(stroke.way) <= JUDGED * np.abs(stroke.way).max()
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
    found = last_strokes(damper, damper.measured_levels[-1], SLOWEST, bench)
    return {direction: rise_of(stroke) for direction, stroke in found.items()}


def peak_to_peak(damper: Damper, bench: Bench) -> float:
    """Height of the degraded loop over that of the intact one [1], which no static force changes."""
    height = []
    for level in (damper.measured_levels[-1], 1.0):
        signal, result = run(damper, level, SLOWEST, bench)
        height.append(float(np.ptp(result.force[signal.marks[-2] :])))
    return height[0] / height[1]


def c2(dampers: Dampers, bench: Bench = BENCH) -> Claim:
    """Low force first, then a sharp rise to a level below the intact one."""
    found = {name: rises(damper, bench) for name, damper in dampers.items()}
    silent = [f"{n} {d}" for n in found for d in DIRECTIONS if not found[n][d].is_there]
    reached = [f"{n} {d}" for n in found for d in DIRECTIONS if found[n][d].is_there and found[n][d].after >= 1.0]
    full = [f"{n} {d}" for n in found for d in DIRECTIONS if found[n][d].is_there and found[n][d].fluid_after > 1 - VISIBLE]
    shares = [(r["rebound"].fluid_after, r["compression"].fluid_after) for r in found.values()]
    alike = min(max(abs(a[0] - b[0]), abs(a[1] - b[1])) for i, a in enumerate(shares) for b in shares[:i])
    holds = not silent and not reached and alike > VISIBLE
    reason = []
    if silent:
        where = [
            f"{n} {holding(dampers[n], lambda one: all(r.is_there for r in rises(one, bench).values()))}"
            for n in dict.fromkeys(text.split()[0] for text in silent)
        ]
        reason.append(f"no sharp rise from a very low force in {', '.join(silent)}; both are there in {'; '.join(where)}")
    if reached:
        caps = ", ".join(f"{capped(dampers, text, bench):.2f} in {text.split()[0]}" for text in reached)
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
                for n, t in found.items()
            },
            "rise_at_mm": {n: {d: rounded(r.at * 1e3, 0) for d, r in t.items()} for n, t in found.items()},
            "loop_height_over_intact": {n: rounded(peak_to_peak(d, bench)) for n, d in dampers.items()},
            "without_rise": silent,
            "intact_force_reached": reached,
            "whole_fluid_force_reached": full,
            "closest_shares_differ_by": rounded(alike),
        },
        needs=f"{DEAD}, {FV_STANDIN}, gas stiffness (assumed)",
        because="" if holds else PAPER,
        reason="; ".join(reason),
        calibrated=tuple(dampers),
    )


def capped(dampers: Dampers, reached: str, bench: Bench) -> float:
    """The highest k_degr after the rise [1] with which the force would stay below the intact one.

    `reached` is a damper and a direction.
    """
    name, direction = reached.split()
    stroke = last_strokes(dampers[name], dampers[name].measured_levels[-1], SLOWEST, bench)[direction]
    _, _, end = largest_gain(stroke.way, stroke.force, stroke.intact_damping, SHARP)
    after = np.abs(stroke.way) <= JUDGED * np.abs(stroke.way).max()
    after[:end] = False
    rest = stroke.intact - (stroke.force - stroke.fluid)
    return float((rest / stroke.intact_fluid)[after].min())


def steps(damper: Damper, bench: Bench = BENCH) -> dict[str, float]:
    """Largest step of the fluid force at 0.08 m/s and the higher level, relative to its highest intact value [1]."""
    found = last_strokes(damper, damper.measured_levels[0], STEPPED, bench)
    return {d: largest_gain(s.way, s.fluid, s.intact_fluid, STEP)[0] / float(s.intact_fluid.max()) for d, s in found.items()}


def c15(dampers: Dampers, bench: Bench = BENCH) -> Claim:
    """Steps of the force where oil begins to flow."""
    table = {name: steps(dampers[name], bench) for name in ("SA1", "SA7")}
    silent = [n for n, t in table.items() if max(t.values()) < MODEL_ERROR]
    return Claim(
        id="C15",
        quote="The force steps can be explained by the different types of fluid flows. As soon as oil begins to flow "
        "through a valve, the damping force increases.",
        statement="SA1 (text) or SA7 (caption), 60 %, 0.08 m/s: the force steps within a stroke as oil begins to flow "
        "through a valve",
        source="Section 3.3, Figure 27",
        tested="the gain of the fluid force beyond what the velocity makes of it in the intact damper, over 1 mm, last "
        f"oscillation: at least {MODEL_ERROR:.0%} of the highest intact fluid force (the model's own error) in one "
        "direction, in both dampers because the paper names either",
        holds=not silent,
        figures={"largest_step_over_intact_force": {n: {d: rounded(x) for d, x in t.items()} for n, t in table.items()}},
        needs=f"{DEAD}, {FV_STANDIN}",
        because="" if not silent else STAND_IN,
        reason="" if not silent else f"the oil fills both working chambers of {', '.join(silent)} at this dead length",
        calibrated=("SA1", "SA7"),
    )
