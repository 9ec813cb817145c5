"""The claim about the drives of Table 3: C13. The strokes of the intact damper in a quarter car drive all states."""

from dataclasses import dataclass
from functools import lru_cache

from twintube.claims.claim import BENCH, STAND_IN, Bench, Claim, Dampers, Keyed, condition, rounded
from twintube.dampers import Damper
from twintube.engine.simulate import work_between
from twintube.rig.plan import oil_levels
from twintube.rig.signals import Signal
from twintube.vehicle.maneuvers import MANEUVERS, Maneuver
from twintube.vehicle.plan import drive_signal

MEASURED_IN_DRIVES = ("SA7", "SA8")
SHORTER_DEAD_LENGTH = 0.07  # [m]
BUMP, UNEVEN = 3, (11, 12)  # numbers in Table 3: the single bump, the uneven road at 30 and 50 km/h
VISIBLE_BAR = 0.01  # share of the intact work: smaller differences of bars are not visible


@lru_cache(maxsize=64)
def cached_signal(damper: Keyed, maneuver: Maneuver) -> Signal:
    """The strokes of the intact damper in a drive."""
    return drive_signal(damper.damper, maneuver)


@dataclass(frozen=True)
class DriveWorks:
    """Works of one drive at the two measured levels, relative to the intact damper [1]."""

    total: list[float]
    fluid: list[float]  # without friction
    floor: float  # of a damper without oil, friction alone

    @property
    def falls(self) -> bool:
        """Whether the fluid work falls visibly from level to level."""
        upper, lower = self.fluid
        return upper < 1 - VISIBLE_BAR and lower < upper - VISIBLE_BAR


def drive_works(damper: Damper, maneuver: Maneuver, bench: Bench = BENCH) -> DriveWorks:
    """Works of one drive, after its preconditioning."""
    signal = cached_signal(Keyed(damper.with_(oil_level=1.0, gas_preload=1)), maneuver)
    levels = (*oil_levels(damper), 0.0)

    def shares(variant: Damper) -> list[float]:
        states = [condition(variant, level, bench, drive=True) for level in levels]
        stroke = signal.stroke + bench.position
        works = [float(work_between(state, stroke, signal.velocity, signal.marks, signal.time)[0]) for state in states]
        return [rounded(work / works[0]) for work in works[1:]]

    *total, floor = shares(damper)
    return DriveWorks(total, shares(damper.with_(F_FrS=0.0))[:-1], floor)


def c13(dampers: Dampers, bench: Bench = BENCH) -> Claim:
    """Stochastic drives."""
    table = {name: {m.number: drive_works(dampers[name], m, bench) for m in MANEUVERS} for name in MEASURED_IN_DRIVES}
    not_falling = [f"{name} {number}" for name, rows in table.items() for number, row in rows.items() if not row.falls]
    no_worse_than_bump = [
        f"{name} {number} at {level:.0%}"
        for name, rows in table.items()
        for i, level in enumerate(dampers[name].measured_levels)
        for number in UNEVEN
        if rows[number].fluid[i] >= rows[BUMP].fluid[i]
    ]
    holds = not not_falling and not no_worse_than_bump
    reason = []
    if not_falling:
        reason.append(f"the work does not fall by {VISIBLE_BAR:.0%} from level to level in drives {', '.join(not_falling)}")
    if no_worse_than_bump:
        reason.append(f"the loss is not larger than over the bump in {', '.join(no_worse_than_bump)}")
    if not holds:
        reason.append(with_shorter_dead_length(dampers, bench))
    names = {m.number: m.name for m in MANEUVERS}
    return Claim(
        id="C13",
        quote="particularly long-lasting excitations at high shock absorber velocities, such as those that occur when "
        "driving on uneven roads, lead to a significant loss of damping work. / At the same time, simple degradation "
        "models, such as a scalar factor, underestimate the damping work performed for one-time excitations, such as a "
        "speed bump crossing (Figure 33). / These diagrams show that the work performed decreases as the oil level "
        "decreases.",
        statement="stochastic drives: work relative to intact falls with the oil level; uneven-road drives lose more than a "
        "single bump",
        source="Abstract, Sections 3.3 and 4, Figures 29-32",
        tested="all ten drives of Table 3, SA7 and SA8, fluid work (above the friction) relative to intact: "
        f"falls by more than {VISIBLE_BAR:.0%} of the intact work from 100 % to each measured level; uneven road at 30 and "
        "50 km/h below the single bump at both levels. Drives last longer than a block: with what freed gas does in rides",
        holds=holds,
        figures={
            "fluid_work_relative_to_intact_at_60_40": {
                name: {names[n]: row.fluid for n, row in rows.items()} for name, rows in table.items()
            },
            "whole_work_relative_to_intact_at_60_40_and_without_oil": {
                name: {names[n]: [*row.total, row.floor] for n, row in rows.items()} for name, rows in table.items()
            },
            "not_falling": not_falling,
            "no_more_than_the_bump": no_worse_than_bump,
        },
        needs="measured strokes (quarter car with the intact damper, ISO 8608 class D road and obstacles, assumed)",
        because="" if holds else STAND_IN,
        reason="; ".join(reason),
    )


def with_shorter_dead_length(dampers: Dampers, bench: Bench) -> str:
    """Result with a shorter dead length, at which the oil at 60 % no longer fills both working chambers."""
    counts = []
    for name in MEASURED_IN_DRIVES:
        shorter = dampers[name].with_(dead_length=SHORTER_DEAD_LENGTH)
        falling = sum(drive_works(shorter, m, bench).falls for m in MANEUVERS)
        counts.append(f"{name} {falling} of {len(MANEUVERS)}")
    return f"with a dead length of {SHORTER_DEAD_LENGTH * 1e3:.0f} mm the work would fall in: {', '.join(counts)} drives"
