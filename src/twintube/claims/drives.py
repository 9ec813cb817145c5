"""The claim about drives: C13. The strokes are those of the intact damper in a quarter car, replayed on the others."""

from twintube.claims.claim import Claim, Dampers, rounded
from twintube.maneuvers import MANEUVERS, Maneuver
from twintube.parameters import Damper
from twintube.plan import drive_signal
from twintube.simulate import work_between

USED = [m for m in MANEUVERS if m.number in (3, 11, 12)]


def relative_works(damper: Damper, maneuver: Maneuver) -> list[float]:
    """Work of the stroke signal relative to intact at 100 % and the measured levels, each after preconditioning."""
    signal = drive_signal(damper, maneuver)
    states = [damper.with_(oil_level=1.0, gas_preload=1)]
    states += [damper.with_(oil_level=level, gas_preload=0) for level in damper.measured_levels]
    works = [float(work_between(state, signal.stroke, signal.velocity, signal.marks)[0]) for state in states]
    return [rounded(work / works[0]) for work in works]


def c13(dampers: Dampers) -> Claim:
    """Stochastic drives."""
    table = {name: {m.name: relative_works(dampers[name], m) for m in USED} for name in ("SA7", "SA8")}
    bump, *uneven = (m.name for m in USED)
    # Friction rises with oil loss (assumed): a work up to 1 % above the intact one counts as not fallen, not as risen.
    falls = all(row[1] < 1.01 and row[2] < row[1] for drives in table.values() for row in drives.values())
    more = all(min(table[name][m][i] for m in uneven) < table[name][bump][i] for name in table for i in (1, 2))
    return Claim(
        id="C13",
        statement="stochastic drives: work relative to intact falls with the oil level; uneven-road drives lose more than a "
        "single bump",
        source="Figures 29-32",
        holds=falls and more,
        figures={"work_relative_to_intact_at_100_60_40": table},
        needs="measured strokes (quarter car with the intact damper, ISO 8608 class D road and a 50 mm bump, assumed)",
        reason=""
        if falls and more
        else "at its 55 % state SA7 loses nothing in any drive: with the dead length that C2 asks for, the oil left still "
        "fills both working chambers",
    )
