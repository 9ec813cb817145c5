"""The error for people: its budget in lines, a table and a picture, and loops of the records where it is largest."""

from functools import partial

import numpy as np
from matplotlib.figure import Figure

from twintube.common.readable import amount
from twintube.core.effects import EFFECTS
from twintube.diagnosis import Answer, Budget, Line
from twintube.report.common import style
from twintube.report.common.html_page import Picture, Section, Table
from twintube.report.common.titles import title_of
from twintube.report.diagnosis.state import REPAIRS

SHOWN = 6  # contributions
MOST_LOOPS = 3  # records
TRACE = 0.1  # of the noise, below which a contribution is not shown
# What a contribution is, and what tells it from its neighbours.
WORDS = {
    "fill": ("Oil level other than stated", "measure the oil that comes out of the damper"),
    "law": ("The damper's own F-v curve", "identify this damper from records of it full"),
    "oil_loss": ("Loss of force by missing oil", "records at more velocities in the degraded state"),
    "friction": ("Friction", "a quasi-static record: what does not go with velocity is friction"),
    "gas": ("Gas force", "hang the damper out and read the force on its rod at rest"),
    "zero": ("Small zeros of the records", "hang the damper out and read the cell"),
    "gain": ("Calibration of the load cell", "hang a known weight on the cell"),
    "sampling": ("Delay and filter of the channels", "record both channels through equal filters"),
    "temperature": ("Temperature", "record the temperature of the tube"),
    "lasting": ("Errors that come and go", "look at where the error is, and at the rig"),
}


def words(line: Line) -> tuple[str, str]:
    """What a line is, and what tells it from others."""
    if line.name in WORDS:
        return WORDS[line.name]
    first = line.name.split("+")[0]
    decides = EFFECTS[first].decides if first in EFFECTS else REPAIRS.get(first, "")
    return title_of(line.name), decides


def rating(line: Line) -> str:
    """How large a line is beside what is usual."""
    if line.ratio is None:
        return "the cause that is named" if line.finding else "too slight to be named"
    usual = "a finding" if line.finding else "within tolerance"
    return f"{line.ratio:.1f} times what is usual: {usual}"


def shown(budget: Budget) -> list[Line]:
    """The largest lines that are no mere trace beside the noise."""
    return [line for line in budget.lines if line.force > TRACE * budget.noise or line.finding][:SHOWN]


def lines(budget: Budget) -> list[str]:
    """The budget for the terminal."""
    out = [f"The simulation is {amount(budget.error, 'N')} off (largest force {budget.peak:.0f} N):"]
    out += [f"  {words(line)[0]:<34} {amount(line.force, 'N'):>9}  {rating(line)}" for line in shown(budget)]
    return [*out, f"  {'Noise':<34} {amount(budget.noise, 'N'):>9}"]


def section(answer: Answer) -> Section:
    """The part of the page with the budget."""
    budget = answer.budget()
    assert budget is not None, "asked where causes were sought"
    rows = [[words(x)[0], amount(x.force, "N"), rating(x), words(x)[1]] for x in shown(budget)]
    rows.append(["Noise", amount(budget.noise, "N"), "what does not repeat", ""])
    caption = (
        "Root mean square of each contribution, under the likeliest answer. Contributions may cancel: they need not add up. "
        "Usual is one standard deviation of what such dampers and benches have; a finding lies outside 90 % of them."
    )
    table = Table(("contribution", "size", "beside what is usual", "what tells it apart"), rows, caption, (1,))
    text = [f"The simulation is {amount(budget.error, 'N')} off; the largest measured force is {budget.peak:.0f} N."]
    drawn = Picture.drawn(partial(picture, budget), "From the whole error to the noise. Blue: a finding.")
    return Section("budget", "What the error consists of", text=text, pictures=[drawn], tables=[table], open=True)


def picture(budget: Budget, narrow: bool = False) -> Figure:
    """Bars from the whole error to the noise."""
    bars = [("Whole error", budget.error, style.INK)]
    bars += [(words(x)[0], x.force, style.BLUE if x.finding else style.FAINT) for x in shown(budget)]
    bars.append(("Noise", budget.noise, style.FAINT))
    figure, ((ax,),) = style.grid(1, (9.0, 0.8 + 0.42 * len(bars)), narrow, most=1)
    style.bars(ax, bars, 24 if narrow else 44)
    ax.set_xlabel("force, RMS [N]")
    return figure


def loops(answer: Answer) -> Section:
    """The part of the page with the loops."""
    caption = "Force over velocity, one oscillation of each record, largest error first."
    caption += " The simulation is that of the stated damper, without faults of the bench."
    drawn = Picture.drawn(partial(drawn_loops, answer), caption)
    return Section("loops", "Where the simulation is wrong", pictures=[drawn])


def drawn_loops(answer: Answer, narrow: bool = False) -> Figure:
    """Loops of the records with the largest errors: measured, simulated, and with the cause that is named."""
    assert answer.changes is not None
    search, found = answer.changes.search, answer.cause
    bench, once = search.bench, search.bench.once()
    errors = [float(np.sqrt(np.mean((bench.measured - search.none.force)[at] ** 2))) for at in bench.slices]
    worst = np.argsort(errors)[::-1][:MOST_LOOPS]
    figure, panels = style.grid(len(worst), (4.2, 3.4), narrow)
    for i, ax in zip(worst, panels.flat, strict=False):
        rows = np.arange(len(once))[bench.slices[i]][once[bench.slices[i]]]
        lines = [("measured", bench.measured, style.INK, 2.4), ("simulated", search.none.force, style.RED, 1.2)]
        lines += [("with the cause", found.force, style.BLUE, 1.2)] if found is not None else []
        for name, force, colour, width in lines:
            ax.plot(bench.v[rows], 1e-3 * force[rows], color=colour, lw=width, label=name)
        style.title(ax, f"{style.plain(bench.records[i].name)}, error {errors[i]:.0f} N")
        ax.set(xlabel="velocity [m/s]", ylabel="force [kN]")
    style.legend_above(figure, panels.flat[0])
    return figure
