"""Figures 33 and 34: the simulation studies on SA8."""

import matplotlib
import numpy as np

from twintube.claims.claim import MODEL_ERROR, works
from twintube.claims.variants import variants
from twintube.common.arrays import Array
from twintube.dampers import Damper
from twintube.report.common import style
from twintube.report.paper import fitted
from twintube.report.paper.context import Context
from twintube.report.paper.records import Job
from twintube.report.paper.statement import HARMONIC, VIRTUAL, Plot, Statement, from_claim
from twintube.rig.plan import velocities
from twintube.rig.signals import BLOCKS
from twintube.studies.cases import scaled

NAMES = {1: "1 scalar factor", 2: "2 basic model", 3: "3 with foam", 4: "4 with foam and cavitation"}
# Colour, dash and width [pt]: curves that coincide stay visible below each other.
DRAWN = {1: (style.GREY, "--", 1.7), 2: (style.FAINT, "-", 6.0), 3: (style.BLUE, "-", 3.0), 4: (style.RED, "-", 1.3)}


def variant_works(damper: Damper, level: float, speeds: tuple[float, ...]) -> dict[int, Array]:
    """Works [J] (velocities, 19) of the four variants; 1 is the oil level times the intact fluid force."""
    states = {1: (scaled(damper, level, 0), 1.0)} | {n: (variant, level) for n, variant in variants(damper).items()}
    return {number: np.array([works(*state, v) for v in speeds]) for number, state in states.items()}


def figure_33(context: Context) -> Plot:
    """Four model variants at 60 % oil."""
    published, identified = context.dampers["SA8"], context.fit("SA8")
    level, speeds = published.measured_levels[0], velocities(published)
    rig = np.array([context.records.get(Job("SA8", "harmonic", v, level)).works() for v in speeds])
    names = ("published Table 9, assumed F-v curve", "model of the stand-in")
    figure, axes = style.pairs((10.0, 7.2), *names, sharex=True, sharey="row")
    rows = (variant_works(published, level, BLOCKS), variant_works(identified, level, speeds))
    for ax, i in zip(axes[1], (0, -1), strict=True):
        text = "virtual rig (stand-in)"
        ax.plot(speeds, rig[:, i], "o", ms=4.5, mfc="white", color=style.INK, zorder=4, label=text)
    for row, table, x in zip(axes, rows, (BLOCKS, speeds), strict=True):
        for ax, i in zip(row, (0, -1), strict=True):
            for number, work in table.items():
                colour, ls, lw = DRAWN[number]
                ax.plot(x, work[:, i], color=colour, ls=ls, lw=lw, label=f"variant {NAMES[number]}")
    style.from_zero(axes)
    style.legend_above(figure, axes[1][0], columns=3)
    first = {number: work[:, 0] / rig[:, 0] - 1 for number, work in rows[1].items()}
    worst = {NAMES[n]: float(np.abs(first[n]).max()) for n in (2, 3, 4)}
    at = {NAMES[n]: speeds[int(np.argmax(np.abs(first[n])))] for n in (2, 3, 4)}
    off = [f"variant {n} is off by {x:.0%} at {at[n]:g} m/s" for n, x in worst.items() if x > MODEL_ERROR]
    return Plot(
        33,
        f"Damping work for the 1st (a) and the 19th oscillation (b) for different model variants, SA8, {level:.0%} oil",
        figure,
        (
            from_claim(context.claim("C5")),
            from_claim(context.claim("C6")),
            from_claim(context.claim("C14")),
            Statement(
                "variants 2 to 4 reproduce the work of the first oscillation with a maximum error of 10 %",
                "Section 3.4, Figure 33",
                not off,
                {
                    "largest_error_of_the_first_oscillation": worst,
                    "at_m_per_s": at,
                    "scalar_factor_below_by_up_to": float(-first[1].min()),
                },
                "stand-in",
                "at every velocity of the lower row, against the virtual rig",
                f"the rig has other physics: {', '.join(off)}",
            ),
        ),
        HARMONIC,
        VIRTUAL,
        ("The claims use the published parameters (upper row); the comparison with the stand-in uses the lower row.",),
        f"lower row {fitted.HOW}",
    )


def figure_34(context: Context) -> Plot:
    """Oil levels from 0 to 100 %."""
    damper = context.dampers["SA8"]
    figure, axes = style.pairs((10.0, 4.6), "", sharey=True)
    colours = matplotlib.colormaps["plasma"]
    for level in (round(0.1 * i, 1) for i in range(10, -1, -1)):
        work = np.array([works(damper, level, v) for v in BLOCKS])
        colour = style.INK if level >= 1.0 else colours(0.95 - 0.95 * level)
        for ax, i in zip(axes.flat, (0, -1), strict=True):
            ax.plot(BLOCKS, work[:, i], ".-", color=colour, lw=1.4, label=f"{level:.0%}")
    style.from_zero(axes)
    handles, labels = axes[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside right center", title="oil level", fontsize=9, frameon=False)
    return Plot(
        34,
        "Damping work for the 1st oscillation (a) and the 19th oscillation (b) for oil levels from 0 to 100 %, SA8",
        figure,
        (from_claim(context.claim("C8")), from_claim(context.claim("C7")), from_claim(context.claim("C9"))),
        HARMONIC,
    )
