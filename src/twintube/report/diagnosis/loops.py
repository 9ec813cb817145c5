"""Where a simulation is wrong: measured and simulated loops of the records with the largest error."""

import numpy as np
from matplotlib.figure import Figure

from twintube.diagnosis import Answer
from twintube.report.common import style
from twintube.report.common.html_page import Picture, Section

MOST = 3  # records


def section(answer: Answer) -> Section:
    """The part of the page with the loops."""
    caption = "Force over velocity, one oscillation of each record, largest error first."
    caption += " The simulation is that of the stated damper, without faults of the bench."
    drawn = Picture.drawn(lambda narrow: picture(answer, narrow), caption)
    return Section("loops", "Where the simulation is wrong", pictures=[drawn])


def picture(answer: Answer, narrow: bool = False) -> Figure:
    """Loops of the records with the largest errors: measured, simulated, and with the cause that is named."""
    assert answer.changes is not None
    search, found = answer.changes.search, answer.cause
    bench, once = search.bench, search.bench.once()
    errors = [float(np.sqrt(np.mean((bench.measured - search.none.force)[at] ** 2))) for at in bench.slices]
    worst = np.argsort(errors)[::-1][:MOST]
    figure, panels = style.grid(len(worst), (4.2, 3.4), narrow)
    for i, ax in zip(worst, panels.flat, strict=False):
        rows = np.arange(len(once))[bench.slices[i]][once[bench.slices[i]]]
        lines = [("measured", bench.measured, style.INK, 2.4), ("simulated", search.none.force, style.RED, 1.2)]
        lines += [("with the cause", found.force, style.BLUE, 1.2)] if found is not None else []
        for name, force, colour, width in lines:
            ax.plot(bench.v[rows], 1e-3 * force[rows], color=colour, lw=width, label=name)
        style.title(ax, f"{style.plain(bench.records[i].name)}, error {errors[i]:.0f} N")
        ax.set_xlabel("velocity [m/s]")
        ax.set_ylabel("force [kN]")
    style.legend_above(figure, panels.flat[0])
    return figure
