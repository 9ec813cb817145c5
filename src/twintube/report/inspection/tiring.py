"""What the page of `twintube inspect` says of `tiring`: the course of the runs, the rest, what it rests on."""

from collections.abc import Sequence
from functools import partial

from matplotlib.figure import Figure

from twintube.common.grouping import grouped
from twintube.dampers import Damper
from twintube.inspection import INTACT, Condition, Entry
from twintube.inspection.benches import DT
from twintube.inspection.scatter import FADE, HEAT
from twintube.inspection.tiring import CYCLES, FREQUENCY, HOLD, LIMIT, REST, Tired, returned, twice
from twintube.inspection.watched import says
from twintube.report.common import style
from twintube.report.common.framed import OTHER, SCALAR, colour_of, framed, name_lines, oil
from twintube.report.common.html_page import Picture, Section, Table
from twintube.vehicle.cars import CarSet
from twintube.vehicle.quarter_car import Car

HALF = 0.5  # scalar factor of the weak curve in the picture
RESTS_ON = (
    "Rests on: v_cav, Y of Table 9, and the ramp `cavitation_loss`, which is calibrated by the abstract of the paper. "
    "No damper has been measured on such a plate. Refuted by: a damper with 10 to 20 % of its oil drained whose velocity "
    "does not grow within 20 s above its v_cav, or an intact one whose velocity grows by more than heat explains."
)
NOTE = "Assumed: F-v curve, friction, gas spring, dead length, car, what freed gas does, and how heat fades the force."
PASSES = "passes"
BLIND = (
    "A damper that has lost half of its force before the first half second ends, and does not tire any more, is not judged "
    "here, see the other benches. A damper whose velocity stays below v_cav is not judged either, nor one in which "
    "cavitation frees no gas."
)


def words(entry: Entry) -> str:
    """The verdict with what the rest tells, or why there is none."""
    if entry.not_judged or entry.passed or entry.watched is None:
        return entry.not_judged or PASSES
    rests = entry.watched.rested.items()
    texts = grouped((says(*runs), f"{name} {min(1.0, max(0.0, returned(*runs))):.0%}") for name, runs in rests)
    rested = "; ".join(f"{', '.join(shares)}: {text}" for text, shares in texts.items())
    return f"fails; of the growth has returned after {REST:g} s of rest, with freed gas {rested}"


def remarks(entries: Sequence[Entry]) -> list[str]:
    """What the terminal says below the figures: once each, with the oil levels to which it applies."""
    levels = grouped((words(entry), f"{entry.condition.oil_level:.0%}") for entry in entries)
    return [f"tiring at {', '.join(at)} oil: {text}" for text, at in levels.items() if text != PASSES]


def plate_of(entries: Sequence[Entry]) -> Tired:
    """The run that the picture shows: the last of the highest oil level that fails, else of the highest."""
    watched = next((entry for entry in entries if entry.passed is False), entries[0]).watched
    assert watched is not None, "entries of `tiring`"
    return watched.runs[-1]


def course(damper: Damper, corner: Car, entries: Sequence[Entry], narrow: bool = False) -> Figure:
    """Velocity of the damper over the time on the plate, before and after the rest."""
    figure, panels = style.grid(2, (5.5, 3.6), narrow, sharey=True)
    axes = list(panels.flat)
    plate = plate_of(entries).plate
    failing = [entry for entry in entries if entry.passed is False]
    shown = dict.fromkeys(entry.condition for entry in [entries[0], *failing[:2], entries[-1]])
    names: list[tuple[float, str, str]] = []

    def line(state: Condition, name: str, colour: str, dashes: str = "-", fade: float = 0.0) -> tuple[Tired, Tired]:
        runs = twice(state.applied(damper), corner, plate, DT, fade)
        for ax, run in zip(axes, runs, strict=True):
            ax.plot(run.time, run.answer, dashes, color=colour, lw=1.6)
        names.append((float(runs[-1].answer[-1]), name, colour))
        return runs

    runs = {state: line(state, named(state), colour_of(state.gas_preload, state.oil_level)) for state in shown}
    line(INTACT, "intact, heated", OTHER, "--", FADE)
    line(Condition(HALF, 0, scalar=True), f"force × {HALF:g}", SCALAR, ":")
    for ax, text in zip(axes, ("first run", f"after {REST:g} s of rest"), strict=True):
        style.title(ax, text)
        ax.set_xlabel("time since the plate starts [s]")
    axes[0].set_ylim(bottom=0.0)
    axes[0].set_ylabel("velocity of the damper [m/s]")
    name_lines(axes[1], names)
    told = (
        f"Root mean square of {CYCLES} cycles each, on a plate of {plate.amplitude * 1e3:g} mm and {FREQUENCY:g} Hz. "
        f"Heated: the force fades by {100 * FADE:.1f} % per kelvin of the run's own heat. Force × {HALF:g}: a scalar factor."
    )
    message = f"{damper.name} does not tire on this plate"
    if failing:
        message = tires(damper, failing[0].condition.oil_level, *runs[failing[0].condition])
    framed(figure, message, told, NOTE)
    return figure


def named(state: Condition) -> str:
    """A state at its line."""
    return "intact" if state == INTACT else oil(state.oil_level)


def tires(damper: Damper, oil_level: float, first: Tired, again: Tired) -> str:
    """What the picture says of the highest oil level that fails, before and after the rest."""
    gone = min(1.0, max(0.0, returned(first, again)))
    return (
        f"{damper.name} with {oil(oil_level)} tires: its velocity on the plate grows {first.growth:.1f}-fold, "
        f"and {100 * gone:.0f} % of the growth is gone after {REST:g} s of rest"
    )


def table(entries: Sequence[Entry]) -> Table:
    """One row per oil level."""
    rows = []
    for entry in entries:
        assert entry.watched is not None, "entries of `tiring`"
        run = max(entry.watched.runs, key=lambda each: each.growth)
        rows.append([
            f"{entry.condition.oil_level:.0%}", f"{run.plate.amplitude * 1e3:g}",
            *(f"{x:.2f}" for x in (run.peak, run.answer[0], run.answer.max(), run.growth, run.force_growth)),
            f"{run.contact_lost:.0%}", f"{run.work / 1e3:.0f}", words(entry),
        ])  # fmt: skip
    head = ["oil", "plate [mm]", "fastest [m/s]", "first [m/s]", "largest [m/s]", "growth", "of the force", "off the plate",
            "work [kJ]", "verdict"]  # fmt: skip
    caption = "Fastest: of the first half second. Of the force: growth of the plate's force. Work: the heat of the run"
    return Table(head, rows, caption, numeric=range(1, 9))


def section(damper: Damper, vehicle: CarSet, entries: Sequence[Entry]) -> Section:
    """The section of one damper."""
    caption = "Velocity of the damper on the plate: where oil is lost it grows while the plate shakes."
    drawn = Picture.drawn(partial(course, damper, vehicle.corner(damper), entries), caption, f"{damper.name}_tiring")
    text = [
        f"The plate shakes the wheel for {HOLD:g} s. A weak curve or a stiff tyre answers every cycle alike; oil loss frees "
        f"gas in every fast stroke, and the damper tires. Fails above {LIMIT:g}, more than the heat of the run does to an "
        f"intact damper whose force fades by {100 * HEAT.low:.1f} to {100 * HEAT.high:.1f} % per kelvin. Then the plate "
        f"stands for {REST:g} s and runs again: gas dissolves, heat stays.",
        BLIND,
        RESTS_ON,
    ]
    title = f"Does {damper.name} tire?"
    return Section(f"tiring-{damper.name}", title, text=text, pictures=[drawn], tables=[table(entries)])
