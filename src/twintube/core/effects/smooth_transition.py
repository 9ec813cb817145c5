"""Gradual build-up: where the paper's k_degr steps, the real one approaches its new value over a length of stroke or a time.

Gas, foam and oil do not part at sharp levels. At a stroke g before one of them runs out, below two lengths L = build_up +
tau_build |v|, the force has already risen by early_share (1 - g / 2L)^2 of the coming step, which is known from the last
time. Of the step itself (1 - early_share) exp(-y) is missing after that, with dy = |dz| / L. That holds for gas and foam
of the driving chamber, and for the gas that compression drives out of V1. Of every other change of k_degr the share
`carry_over` is made up in the same way. A direction begins with the share `carry_turn` of what it has ended with the last
time, as far as a chamber's mixture lasts while the other one drives, else with what the piston meets there.
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
ORDER = 220
FAR = 1e3
THIN = 0.1  # of a length: a layer that is thinner acts in proportion, else one of no thickness would act
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
    carry_over: float = var("smooth_transition", "", "1", "gradual share of other changes", lower=0, upper=1,
                            source="first-order relaxation", default=0.0, role="law")  # fmt: skip
    carry_turn: float = var("smooth_transition", "", "1", "share of k_degr that lasts from stroke to stroke", lower=0,
                            upper=1, source="first-order relaxation", default=0.0, role="law")  # fmt: skip


@dataclass(slots=True)
class State(Frame):
    """What the present direction has seen."""

    k_side: float = var("smooth_transition", "", "1", "direction: 1, -1, 0 before the start", default=0.0)
    gas_ahead: float = var("smooth_transition", "", "m", "stroke until the driving chamber has no gas", default=0.0)
    foam_ahead: float = var("smooth_transition", "", "m", "stroke until the driving chamber has no foam", default=0.0)
    vent_ahead: float = var("smooth_transition", "", "m", "stroke until compression has emptied V1 of gas", default=0.0)
    rise_gas_re: float = var(
        "smooth_transition", "k_degr", "1", "rise when the gas of V1 last ran out in rebound", default=1.0
    )
    rise_gas_co: float = var("smooth_transition", "k_degr", "1", "rise when the gas of V2 last ran out", default=1.0)
    rise_foam_re: float = var("smooth_transition", "k_degr", "1", "rise when the foam of V1 last ran out", default=0.0)
    rise_foam_co: float = var("smooth_transition", "k_degr", "1", "rise when the foam of V2 last ran out", default=0.0)
    rise_vent: float = var("smooth_transition", "k_degr", "1", "rise when the gas of V1 was last driven out", default=0.0)
    since_turn: float = var("smooth_transition", "", "m", "stroke in the present direction", default=0.0)
    k_last: float = var("smooth_transition", "k_degr", "1", "k_degr at the end of the last step", default=1.0)
    k_end_re: float = var(
        "smooth_transition", "k_degr", "1", "k_degr at the end of the last rebound, -1: none", default=-1.0
    )
    k_end_co: float = var("smooth_transition", "k_degr", "1", "the same of compression", default=-1.0)
    k_target: float = var("smooth_transition", "k_degr", "1", "latest k_degr without build-up", default=1.0)
    k_carried: float = var("smooth_transition", "k_degr", "1", "k_degr left from before other changes", default=0.0)


def smooth_transition_stroke(volume: float, flow: float) -> float:
    """Stroke [m] in which a `volume` [m3] leaves with a `flow` [m2]."""
    return 0.0 if volume <= 0.0 else min(FAR, volume / flow) if flow > 0.0 else FAR


def smooth_transition_look(s: State, f: Flow, side: float) -> None:
    """The strokes until gas and foam run out."""
    s.foam_ahead = 0.0
    s.vent_ahead = 0.0
    if side > 0.0:
        s.gas_ahead = smooth_transition_stroke(s.V1_gas, -f.V1_gas)
        if s.V1_foam > 0.0:
            s.foam_ahead = smooth_transition_stroke(s.V1_gas + s.V1_foam, -(f.V1_gas + f.V1_foam + f.V1_oil))
    else:
        s.gas_ahead = smooth_transition_stroke(s.V2_gas, -f.V2_gas)
        if s.V2_foam > 0.0:
            s.foam_ahead = smooth_transition_stroke(s.V2_gas + s.V2_foam, -(f.V2_gas + f.V2_foam + f.V2_oil))
        if s.V2_gas <= 0.0:
            s.vent_ahead = smooth_transition_stroke(s.V1_gas, -f.V1_gas)


def smooth_transition_early(p: Parameters, ahead: float, length: float) -> float:
    """Share [1] of a step that has come at a stroke `ahead` [m] of it."""
    near = max(0.0, 1.0 - 0.5 * ahead / length)
    return p.early_share * near * near if ahead > 0.0 else 0.0


def smooth_transition_coming(p: Parameters, s: State, side: float, k: float, length: float) -> float:
    """What has already come [1] of the steps ahead of `k`."""
    gas = s.rise_gas_re if side > 0.0 else s.rise_gas_co
    foam = s.rise_foam_re if side > 0.0 else s.rise_foam_co
    coming = gas * smooth_transition_early(p, s.gas_ahead, length) + foam * smooth_transition_early(p, s.foam_ahead, length)
    coming += s.rise_vent * smooth_transition_early(p, s.vent_ahead, length)
    return max(0.0, min(1.0 - k, coming))


def smooth_transition_remember(s: State, side: float, gas: bool, foam: bool, vent: bool, rise: float) -> None:
    """The `rise` [1] of k_degr in a step in which `gas` or `foam` or the gas of V1 has run out."""
    if gas:
        if side > 0.0:
            s.rise_gas_re = rise
        else:
            s.rise_gas_co = rise
    if foam:
        # What runs out in one step is one step of the force.
        alone = 0.0 if gas else rise
        if side > 0.0:
            s.rise_foam_re = alone
        else:
            s.rise_foam_co = alone
    if vent:
        s.rise_vent = 0.0 if foam else rise


def smooth_transition_fade(way: float) -> float:
    """Mean of exp(-y) [1] over 0 <= y <= `way`."""
    return (1.0 - math.exp(-way)) / way if way > 1e-9 else 1.0


def smooth_transition_turn(p: Parameters, s: State, f: Flow, side: float, k: float) -> None:
    """Begin a direction at its own value `k`."""
    if s.k_side > 0.0:
        s.k_end_re = s.k_last
    elif s.k_side < 0.0:
        s.k_end_co = s.k_last
    ended = s.k_end_re if side > 0.0 else s.k_end_co
    s.k_carried = p.carry_turn * (ended - k) if ended >= 0.0 else 0.0
    s.k_side = side
    s.k_target = k
    s.since_turn = 0.0
    smooth_transition_look(s, f, side)


def smooth_transition_transition(p: Parameters, s: State, f: Flow, v: float, dz: float) -> None:
    """Change the mean over the step, `f.k_mean`, and the value at its end."""
    settled = s.k_degr
    side = 1.0 if dz > 0.0 else -1.0 if dz < 0.0 else s.k_side
    if side != s.k_side:
        smooth_transition_turn(p, s, f, side, f.k_mean)
    length = max(STILL, p.build_up + 0.5 * p.tau_build * (abs(s.goal_v0) + abs(s.goal_v1)))
    gas = s.gas_ahead > 0.0
    foam = s.foam_ahead > 0.0
    vent = s.vent_ahead > 0.0
    smooth_transition_look(s, f, side)
    known = s.k_target
    mean = f.k_mean if dz != 0.0 or side == 0.0 else known
    end = f.k_degr if dz != 0.0 or side == 0.0 else known
    rise = 0.0
    gained = 0.0
    if dz != 0.0:
        gas = gas and s.gas_ahead == 0.0
        foam = foam and s.foam_ahead == 0.0
        vent = vent and s.vent_ahead == 0.0
        if gas or foam or vent:
            rise = max(0.0, end - known)
            smooth_transition_remember(s, side, gas, foam, vent, rise)
    carried = s.k_carried
    target = mean
    if rise > 0.0:
        # In the step in which something runs out the kernel's mean tells where.
        gained = max(0.0, min(1.0, (mean - known) / rise))
        mean += p.early_share * rise * (1.0 - gained)
        target = end
    else:
        carried += p.carry_over * (known - target)
    way = abs(dz) / length
    layer = s.since_turn + (1.0 - gained) * abs(dz)
    late = (1.0 - p.early_share) * rise * (1.0 - (1.0 - p.carry_turn) * math.exp(-layer / (THIN * length)))
    s.since_turn += abs(dz)
    # What is left of the past is at most the intact damper's: else every return of the gas would add another step to it.
    carried = min(carried, 1.0 - target + late)
    coming = smooth_transition_coming(p, s, side, end, length)
    mean += coming + carried * smooth_transition_fade(way) - late * gained * smooth_transition_fade(gained * way)
    f.k_mean = max(0.0, min(1.0, mean))
    s.k_carried = carried * math.exp(-way) - late * math.exp(-gained * way)
    s.k_target = target
    f.k_degr = max(0.0, min(1.0, end + coming + s.k_carried))
    s.k_last = f.k_degr
    s.k_degr = f.k_mean if dz != 0.0 else f.k_degr
    turned = 1.0 if v > 0.0 else -1.0 if v < 0.0 else s.k_side
    if turned != s.k_side:
        # The kernel has settled k_degr for the new direction, the mean over the step belongs to the one before.
        s.k_last = f.k_mean if dz != 0.0 else s.k_last
        smooth_transition_turn(p, s, f, turned, settled)
        s.k_degr = settled + s.k_carried
        f.k_degr = s.k_degr
