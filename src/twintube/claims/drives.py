"""The claim about drives: C13. The strokes are those of the intact damper in a quarter car, replayed on the others."""

from dataclasses import dataclass
from functools import lru_cache

from twintube.claims.claim import BENCH, STAND_IN, Bench, Claim, Dampers, Keyed, condition, rounded
from twintube.dampers import Damper
from twintube.engine.simulate import work_between
from twintube.rig.signals import Signal
from twintube.vehicle.maneuvers import MANEUVERS, Maneuver
from twintube.vehicle.plan import drive_signal

DRIVEN = ("SA7", "SA8")
SHORTER = 0.07  # [m]
BUMP, UNEVEN = 3, (11, 12)  # numbers in Table 3: the single bump, the uneven road at 30 and 50 km/h
VISIBLE = 0.01  # share of the intact work: a bar that is lower by less looks the same


@lru_cache(maxsize=64)
def cached_signal(damper: Keyed, maneuver: Maneuver) -> Signal:
    """The strokes of a drive with the intact damper."""
    return drive_signal(damper.damper, maneuver)


@dataclass(frozen=True)
class Driven:
    """Works of one drive at the two measured levels, relative to the intact damper [1]."""

    total: list[float]
    fluid: list[float]  # without friction
    floor: float  # of a damper without oil, friction alone

    @property
    def falls(self) -> bool:
        """Whether the fluid work falls visibly from each level to the next."""
        upper, lower = self.fluid
        return upper < 1 - VISIBLE and lower < upper - VISIBLE


def driven(damper: Damper, maneuver: Maneuver, bench: Bench = BENCH) -> Driven:
    """One drive, after its preconditioning."""
    signal = cached_signal(Keyed(damper.with_(oil_level=1.0, gas_preload=1)), maneuver)
    levels = (1.0, *damper.measured_levels, 0.0)

    def shares(one: Damper) -> list[float]:
        states = [condition(one, level, bench, drive=True) for level in levels]
        stroke = signal.stroke + bench.position
        works = [float(work_between(state, stroke, signal.velocity, signal.marks, signal.time)[0]) for state in states]
        return [rounded(work / works[0]) for work in works[1:]]

    *total, floor = shares(damper)
    return Driven(total, shares(damper.with_(F_FrS=0.0))[:-1], floor)


def c13(dampers: Dampers, bench: Bench = BENCH) -> Claim:
    """Stochastic drives."""
    table = {name: {m.number: driven(dampers[name], m, bench) for m in MANEUVERS} for name in DRIVEN}
    level = [f"{name} {number}" for name, rows in table.items() for number, row in rows.items() if not row.falls]
    less = []
    for name, rows in table.items():
        for i in (0, 1):
            bump = rows[BUMP].fluid[i]
            less += [f"{name} {number} at {dampers[name].measured_levels[i]:.0%}" for number in UNEVEN
                     if rows[number].fluid[i] >= bump]  # fmt: skip
    reason = [f"the work does not fall by {VISIBLE:.0%} from level to level in drives {', '.join(level)}"] * bool(level)
    reason += [f"no more is lost than over the bump in {', '.join(less)}"] * bool(less)
    if level or less:
        reason.append(mended(dampers, bench))
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
        f"falls by more than {VISIBLE:.0%} of the intact work from 100 % to each measured level; uneven road at 30 and "
        "50 km/h below the single bump at either level. Drives last longer than a block: with the closure of rides",
        holds=not level and not less,
        figures={
            "fluid_work_relative_to_intact_at_60_40": {
                name: {names[n]: row.fluid for n, row in rows.items()} for name, rows in table.items()
            },
            "whole_work_relative_to_intact_at_60_40_and_without_oil": {
                name: {names[n]: [*row.total, row.floor] for n, row in rows.items()} for name, rows in table.items()
            },
            "not_falling": level,
            "no_more_than_the_bump": less,
        },
        needs="measured strokes (quarter car with the intact damper, ISO 8608 class D road and obstacles, assumed)",
        because="" if not level and not less else STAND_IN,
        reason="; ".join(reason),
    )


def mended(dampers: Dampers, bench: Bench) -> str:
    """What a shorter dead length would do: with it the oil at 60 % would no longer fill both working chambers."""
    found = []
    for name in DRIVEN:
        shorter = dampers[name].with_(dead_length=SHORTER)
        falling = sum(driven(shorter, m, bench).falls for m in MANEUVERS)
        found.append(f"{name} {falling} of {len(MANEUVERS)}")
    return f"with a dead length of {SHORTER * 1e3:.0f} mm the work would fall in: {', '.join(found)} drives"
