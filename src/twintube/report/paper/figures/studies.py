"""Figures 33 and 34: the simulation studies on SA8."""

import matplotlib
import numpy as np

from twintube.claims.claim import MODEL_ERROR
from twintube.claims.variants import variants
from twintube.common.arrays import Array
from twintube.dampers import Damper
from twintube.report.common import style
from twintube.report.paper import fitted, notes
from twintube.report.paper.context import Context, works
from twintube.report.paper.records import Job
from twintube.report.paper.statement import Plot, Statement, from_claim
from twintube.rig.plan import velocities
from twintube.rig.signals import BLOCKS
from twintube.studies.cases import scaled

NAMES = {1: "1 scalar factor", 2: "2 basic model", 3: "3 with foam", 4: "4 with foam and cavitation"}
# Colour, dash and width [pt]: curves that coincide stay visible below each other.
DRAWN = {1: (style.GREY, "--", 1.7), 2: (style.FAINT, "-", 6.0), 3: (style.BLUE, "-", 3.0), 4: (style.RED, "-", 1.3)}


def variant_works(damper: Damper, level: float, speeds: tuple[float, ...]) -> dict[int, Array]:
    """Works [J] (velocities, 19) of the four variants; 1 is the oil level times the intact fluid force."""
    factor = scaled(damper, level, 0)
    table = {1: np.array([works(factor, 1.0, v) for v in speeds])}
    for number, variant in variants(damper).items():
        table[number] = np.array([works(variant, level, v) for v in speeds])
    return table


def figure_33(context: Context) -> Plot:
    """Four model variants at 60 % oil."""
    published, identified = context.dampers["SA8"], context.fit("SA8")
    level = published.measured_levels[0]
    speeds = velocities(published)
    rig = np.array([context.records.get(Job("SA8", "harmonic", v, level)).works() for v in speeds])
    figure, axes = style.canvas(2, 2, (10.0, 7.2), sharex=True, sharey="row")
    rows = (variant_works(published, level, BLOCKS), variant_works(identified, level, speeds))
    for row, table, x, measured in zip(axes, rows, (BLOCKS, speeds), (False, True), strict=True):
        for ax, i in zip(row, (0, -1), strict=True):
            if measured:
                ax.plot(
                    speeds, rig[:, i], "o", ms=4.5, mfc="white", color=style.INK, zorder=4, label="virtual rig (stand-in)"
                )
            for number, work in table.items():
                colour, ls, lw = DRAWN[number]
                ax.plot(x, work[:, i], color=colour, ls=ls, lw=lw, label=f"variant {NAMES[number]}")
            ax.set_ylim(bottom=0)
            ax.set_xlim(left=0)
    for ax, text in zip(axes.flat, ("(a) 1st oscillation", "(b) 19th oscillation") * 2, strict=True):
        style.title(ax, f"{text}, " + ("published Table 9, assumed F-v curve" if ax in axes[0] else "model of the stand-in"))
    style.label(axes, "maximum velocity [m/s]", "work of one oscillation [J]")
    style.legend_above(figure, axes[1][0], columns=3)
    style.notes(figure, notes.lines(notes.HARMONIC, notes.VIRTUAL, f"lower row {fitted.HOW}"))
    first = {number: rows[1][number][:, 0] / rig[:, 0] - 1 for number in rows[1]}
    worst = {NAMES[n]: float(np.abs(first[n]).max()) for n in (2, 3, 4)}
    worst_speed = {NAMES[n]: speeds[int(np.argmax(np.abs(first[n])))] for n in (2, 3, 4)}
    shortfall = float(-first[1].min())
    reproduced = max(worst.values()) <= MODEL_ERROR
    return Plot(
        33,
        f"Damping work for the 1st (a) and the 19th oscillation (b) for different model variants, SA8, {level:.0%} oil",
        figure,
        (
            from_claim(context.claim("C5")),
            from_claim(context.claim("C6")),
            from_claim(context.claim("C14")),
            Statement(
                text="variants 2 to 4 reproduce the work of the first oscillation with a maximum error of 10 %",
                source="Section 3.4, Figure 33",
                holds=reproduced,
                numbers={
                    "largest_error_of_the_first_oscillation": worst,
                    "at_m_per_s": worst_speed,
                    "scalar_factor_below_by_up_to": shortfall,
                },
                basis="stand-in",
                criterion="at every velocity of the lower row, against the virtual rig",
                reason=""
                if reproduced
                else "the rig has other physics: "
                + ", ".join(
                    f"variant {n} is off by {x:.0%} at {worst_speed[n]:g} m/s" for n, x in worst.items() if x > MODEL_ERROR
                ),
            ),
        ),
        notes.VIRTUAL,
        notes.HARMONIC,
        ("The claims use the published parameters (upper row); the comparison with the stand-in uses the lower row.",),
    )


def figure_34(context: Context) -> Plot:
    """Oil levels from 0 to 100 %."""
    damper = context.dampers["SA8"]
    oil_levels = [round(0.1 * i, 1) for i in range(10, -1, -1)]
    table = {level: np.array([works(damper, level, v) for v in BLOCKS]) for level in oil_levels}
    figure, axes = style.pair((10.0, 4.6), sharey=True)
    colours = matplotlib.colormaps["plasma"]
    for ax, i in zip(axes, (0, -1), strict=True):
        for level, work in table.items():
            colour = style.INK if level >= 1.0 else colours(0.95 - 0.95 * level)
            ax.plot(BLOCKS, work[:, i], ".-", color=colour, lw=1.4, label=f"{level:.0%}")
        ax.set_xlabel("maximum velocity [m/s]")
        ax.set_xlim(left=0)
        ax.set_ylim(bottom=0)
    axes[0].set_ylabel("work of one oscillation [J]")
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside right center", title="oil level", fontsize=9, frameon=False)
    style.notes(figure, notes.lines(notes.HARMONIC))
    return Plot(
        34,
        "Damping work for the 1st oscillation (a) and the 19th oscillation (b) for oil levels from 0 to 100 %, SA8",
        figure,
        (
            from_claim(context.claim("C8")),
            from_claim(context.claim("C7")),
            from_claim(context.claim("C9"), None),
        ),
        (),
        notes.HARMONIC,
    )
