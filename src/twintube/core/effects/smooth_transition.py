"""Gradual build-up: where the paper's k_degr steps, the real one approaches its new value over a length of stroke or a time.

Gas and oil do not part at a sharp level. While the driving chamber's gas is about to run out, at a depth g below `build_up`,
the force has already risen by early_share (1 - g / build_up)^2 of the coming step, which is known from the last time. Of
the step itself (1 - early_share) exp(-y) is missing after the gas has run out, with dy = |dz| / (build_up + tau_build |v|).
Of every other change of k_degr the share `carry_over` is made up in the same way where foam or cavitation make it, the share
`carry_turn` where a reversal does: the piston meets oil or gas there at once, unless the force itself follows late.
"""

import math
from dataclasses import dataclass

from twintube.core import variables
from twintube.core.frame import Frame
from twintube.core.variables import Flow, var

TITLE = "Gradual build-up of the force"
CAUSE = "Oil and gas are mixed near the level between them, so that the force builds up over a stroke instead of at once."
ABSENCE = "The model's force steps where the measured one rises gradually: a residual of both signs around the rise."
DECIDES = "the same velocity with half the amplitude: the build-up is a length of stroke, not a time"
NEEDS_TIME = False
FAR = 1e3
STILL = 1e-9  # [m] length of a step's build-up below which there is none


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Length of the transition."""

    build_up: float = var("smooth_transition", "", "m", "stroke over which k_degr builds up", lower=0, upper=0.03,
                          source="first-order relaxation over the stroke", default=0.0, role="strength")  # fmt: skip
    tau_build: float = var("smooth_transition", "", "s", "time over which k_degr builds up", lower=0, upper=0.05,
                           source="first-order relaxation over the time", default=0.0, role="strength")  # fmt: skip
    early_share: float = var("smooth_transition", "", "1", "share of the rise before the gas has run out", lower=0, upper=1,
                       source="mixing layer about the level", default=0.0, role="law")  # fmt: skip
    carry_over: float = var("smooth_transition", "", "1", "gradual share of changes by foam, cavitation", lower=0, upper=1,
                            source="first-order relaxation", default=0.0, role="law")  # fmt: skip
    carry_turn: float = var("smooth_transition", "", "1", "gradual share of changes at a reversal", lower=0, upper=1,
                            source="first-order relaxation", default=0.0, role="law")  # fmt: skip


@dataclass(slots=True)
class State(Frame):
    """What the present direction has seen."""

    k_side: float = var("smooth_transition", "", "1", "direction: 1, -1, 0 before the start", default=0.0)
    k_mixed: float = var("smooth_transition", "k_degr", "1", "latest k_degr with gas in the driving chamber", default=1.0)
    k_full_re: float = var("smooth_transition", "k_degr", "1", "latest k_degr in rebound without gas in V1", default=1.0)
    k_full_co: float = var("smooth_transition", "k_degr", "1", "latest k_degr in compression without gas in V2", default=1.0)
    y_free: float = var("smooth_transition", "", "1", "lengths of build-up since the driving chamber's gas has run out",
                        default=0.0)  # fmt: skip
    k_last: float = var("smooth_transition", "k_degr", "1", "k_degr at the end of the last step", default=1.0)
    k_target: float = var("smooth_transition", "k_degr", "1", "latest k_degr without build-up", default=1.0)
    k_carried: float = var("smooth_transition", "k_degr", "1", "k_degr left from before other changes", default=0.0)


def smooth_transition_depth(p: Parameters, s: State, side: float) -> float:
    """Depth [m] of the gas in the driving chamber."""
    rod = p.D_PR * p.D_PR
    tube = p.D_li * p.D_li
    return s.V1_gas / (0.25 * math.pi * (tube - rod)) if side > 0.0 else s.V2_gas / (0.25 * math.pi * tube)


def smooth_transition_fade(way: float) -> float:
    """Mean of exp(-y) [1] over 0 <= y <= `way`."""
    return (1.0 - math.exp(-way)) / way if way > 1e-9 else 1.0


def smooth_transition_turn(p: Parameters, s: State, side: float, k: float) -> None:
    """Begin a direction at its own value `k`; where its chamber has no gas there is no step ahead."""
    s.k_carried = p.carry_turn * (s.k_last - k) if s.k_side != 0.0 else 0.0
    s.k_side = side
    s.k_target = k
    s.k_mixed = k
    s.y_free = 0.0 if smooth_transition_depth(p, s, side) > 0.0 else FAR


def smooth_transition_transition(p: Parameters, s: State, f: Flow, v: float, dz: float) -> None:
    """Change the mean over the step, `f.k_mean`, and the value at its end."""
    settled = s.k_degr
    side = 1.0 if dz > 0.0 else -1.0 if dz < 0.0 else s.k_side
    if side != s.k_side:
        smooth_transition_turn(p, s, side, f.k_mean)
    length = max(STILL, p.build_up + 0.5 * p.tau_build * (abs(s.goal_v0) + abs(s.goal_v1)))
    depth = smooth_transition_depth(p, s, side)
    target = f.k_mean
    known = s.k_target
    if depth > 0.0:
        full = s.k_full_re if side > 0.0 else s.k_full_co
        near = max(0.0, 1.0 - depth / length)
        share = p.early_share * near * near
        s.k_mixed = f.k_mean
        s.y_free = 0.0
        f.k_mean += max(0.0, full - f.k_mean) * share
        f.k_degr += max(0.0, full - f.k_degr) * share
    elif side != 0.0:
        k = s.k_full_re if side > 0.0 else s.k_full_co
        ended = k
        if dz != 0.0:
            ended = f.k_degr
            k = f.k_mean if s.y_free > 0.0 else f.k_degr
        target = k
        jump = max(0.0, k - s.k_mixed)
        free = abs(dz)
        if s.y_free == 0.0 and jump > 0.0:
            known = k
            # In the step in which the gas runs out the kernel's mean tells where.
            free *= max(0.0, min(1.0, (f.k_mean - s.k_mixed) / jump))
        missing = jump * (1.0 - p.early_share) * math.exp(-s.y_free)
        way = free / length
        if abs(dz) > 0.0:
            early = (1.0 - free / abs(dz)) * jump * p.early_share
            f.k_mean = max(0.0, f.k_mean + early - missing * smooth_transition_fade(way) * free / abs(dz))
        s.y_free += way
        f.k_degr = ended - missing * math.exp(-way)
        if side > 0.0:
            s.k_full_re = k
        else:
            s.k_full_co = k
    way = abs(dz) / length
    # What is left of the past is at most the intact damper's: else every return of the gas would add another step to it.
    s.k_carried = min(s.k_carried + p.carry_over * (known - target), 1.0 - target)
    s.k_target = target
    f.k_mean = max(0.0, min(1.0, f.k_mean + s.k_carried * smooth_transition_fade(way)))
    s.k_carried *= math.exp(-way)
    f.k_degr = max(0.0, min(1.0, f.k_degr + s.k_carried))
    s.k_last = f.k_degr
    s.k_degr = f.k_mean if dz != 0.0 else f.k_degr
    turned = 1.0 if v > 0.0 else -1.0 if v < 0.0 else s.k_side
    if turned != s.k_side:
        # The kernel has settled k_degr for the new direction, the mean over the step belongs to the one before.
        s.k_last = f.k_mean if dz != 0.0 else s.k_last
        smooth_transition_turn(p, s, turned, settled)
        s.k_degr = settled + s.k_carried
        f.k_degr = s.k_degr
