"""Figures 8 to 11: harmonic measurements of the degraded dampers."""

from typing import Any

import matplotlib
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm, Normalize

from twintube.claims.claim import VISIBLE
from twintube.common.arrays import Array
from twintube.report.common import style
from twintube.report.paper import notes
from twintube.report.paper.context import Context, loop, works
from twintube.report.paper.records import Job, harmonic_jobs, levels
from twintube.report.paper.statement import Plot, Statement, from_claim
from twintube.rig.signals import BLOCKS, FASTEST, ONE_METRE, SLOWEST

FALLEN = 0.5  # work relative to the 1st oscillation [1]: "sometimes very sharply"


def jobs_8(name: str) -> list[Job]:
    """Slow blocks, intact and at the lowest level."""
    return [job for job in harmonic_jobs(name, (SLOWEST,)) if job.level in (1.0, levels(name)[-1])]


def jobs_11(name: str) -> list[Job]:
    """The slowest and the fastest block at the lowest level."""
    return [job for job in harmonic_jobs(name, (SLOWEST, FASTEST)) if job.level == levels(name)[-1]]


def loops(context: Context, velocity: float, *, rig: bool) -> tuple[Any, dict[str, float]]:
    """F-s loops of all dampers, intact and at the lowest level, 19 oscillations; spread of the degraded works [1]."""
    figure, axes = style.panels(context.dampers, sharex=True)
    spread = {}
    unit, scale = ("N", 1.0) if velocity <= SLOWEST else ("kN", 1e-3)
    for name, ax in axes.items():
        damper = context.dampers[name]
        low = damper.measured_levels[-1]
        for level, colour, text in ((1.0, style.INK, "100% oil"), (low, style.RED, "lowest measured level (Table 2)")):
            signal, run = loop(damper, level, velocity)
            span = slice(signal.marks[0], None)
            ax.plot(run.stroke[span] * 1e3, run.force[span] * scale, color=colour, lw=0.8, label=f"model, {text}")
        work = works(damper, low, velocity)
        spread[name] = float(np.ptp(work) / work.max())
        for job, colour in zip(jobs_8(name) if rig else [], (style.GREY, style.ORANGE), strict=False):
            record = context.records.get(job)
            span = slice(record.marks[-2], None)
            text = "100% oil" if job.gas_preload else "lowest level"
            ax.plot(record.stroke[span] * 1e3, record.force[span] * scale, color=colour, lw=0.9, ls=(0, (4, 2)),
                    label=f"virtual rig (stand-in), {text}")  # fmt: skip
        style.title(ax, f"{ax.get_title(loc='left')}, {low:.0%}")
    for name in ("SA1", "SA5"):
        axes[name].set_ylabel(f"force [{unit}]")
    for name in ("SA5", "SA6", "SA7", "SA8"):
        axes[name].set_xlabel("stroke [mm]")
    style.legend_above(figure, axes["SA1"], columns=4)
    style.notes(figure, notes.lines(notes.HARMONIC, notes.VIRTUAL if rig else ()))
    return figure, spread


def figure_8(context: Context) -> Plot:
    """F-s diagrams at 0.05 m/s."""
    figure, _ = loops(context, SLOWEST, rig=True)
    return Plot(
        8,
        "Force-displacement characteristics at oil levels near 40 % and 100 %, maximum velocity 0.05 m/s, 19 oscillations",
        figure,
        (from_claim(context.claim("C1")), from_claim(context.claim("C2"))),
        notes.VIRTUAL,
        notes.HARMONIC,
        ("The paper shows measurements only; solid lines are the model, dashed lines the stand-in (last oscillation).",),
    )


def figure_9(context: Context) -> Plot:
    """F-s diagrams at 1 m/s."""
    figure, spread = loops(context, ONE_METRE, rig=False)
    return Plot(
        9,
        "Force-displacement characteristics at oil levels near 40 % and 100 %, maximum velocity 1 m/s, 19 oscillations",
        figure,
        (
            Statement(
                text="above 0.05 m/s the F-s curves of the 19 consecutive oscillations do not overlap",
                source="Section 3.1, Figure 9",
                holds=min(spread.values()) > VISIBLE,
                numbers={"spread_of_work_over_19_oscillations": spread, "velocity_m_per_s": ONE_METRE},
                basis="evidence",
                criterion=f"in every damper the works of the 19 oscillations differ by more than {VISIBLE:.0%}",
                reason="" if min(spread.values()) > VISIBLE else "the oscillations of "
                + ", ".join(n for n, x in spread.items() if x <= VISIBLE) + " coincide",
            ),
            from_claim(context.claim("C3")),
        ),
        (),
        notes.HARMONIC,
        (f'The paper\'s "1 m/s" is taken as {ONE_METRE} m/s.', "The paper shows measurements only; this is the model."),
    )  # fmt: skip


def figure_10(context: Context) -> Plot:
    """Nineteen oscillations of SA1, coloured by number."""
    damper = context.dampers["SA1"]
    figure, axes = style.canvas(1, 2, (10.5, 4.4), sharex=True, sharey=True)
    colours = matplotlib.colormaps["viridis"]
    norm = Normalize(1, 19)
    for ax, level, text in zip(axes[0], damper.measured_levels[::-1], ("text: 40 %", "caption: 60 %"), strict=True):
        signal, run = loop(damper, level, ONE_METRE)
        for i, (a, b) in enumerate(zip(signal.marks[:-1], signal.marks[1:], strict=True), start=1):
            ax.plot(run.stroke[a : b + 1] * 1e3, run.force[a : b + 1] / 1e3, color=colours(norm(i)), lw=1.0)
        style.title(ax, f"SA1, {level:.0%} oil (paper's {text})")
    style.label(axes, "stroke [mm]", "force [kN]")
    bar = figure.colorbar(ScalarMappable(norm, colours), ax=axes, ticks=[1, 5, 10, 15, 19], aspect=30, pad=0.01)
    bar.set_label("oscillation")
    style.notes(figure, notes.lines(notes.HARMONIC))
    return Plot(
        10,
        "Nineteen harmonic oscillations of Shock Absorber 1, maximum velocity 1 m/s",
        figure,
        (from_claim(context.claim("C3")),),
        (),
        notes.HARMONIC,
        (
            "The paper's text says 40 %, its caption 60 %: both are drawn, at the oil levels of Table 2.",
            "The paper shows measurements only; this is the model.",
        ),
    )


def figure_11(context: Context) -> Plot:
    """Work over the number of the oscillation."""
    figure, axes = style.panels(context.dampers, sharex=True)
    colours = matplotlib.colormaps["viridis"]
    norm = LogNorm(BLOCKS[0], BLOCKS[-1])
    count = np.arange(1, 20)
    steady, fallen = {}, {}
    for name, ax in axes.items():
        damper = context.dampers[name]
        low = damper.measured_levels[-1]
        table: dict[float, Array] = {v: works(damper, low, v) for v in BLOCKS}
        for v, work in table.items():
            ax.plot(count, work, ".-", ms=3, lw=1.0, color=colours(norm(v)), label=f"{v:g} m/s")
        for job, ls in zip(jobs_11(name), (":", "--"), strict=True):
            text = f"virtual rig (stand-in), {job.value:g} m/s"
            ax.plot(count, context.records.get(job).works(), ls, lw=0.9, color=style.GREY, label=text)
        ax.set_ylim(bottom=0)
        style.title(ax, f"{ax.get_title(loc='left')}, {low:.0%}")
        steady[name] = float(np.ptp(table[SLOWEST]) / table[SLOWEST][0])
        fallen[name] = float(min(work[-1] / work[0] for work in table.values()))
    for name in ("SA1", "SA5"):
        axes[name].set_ylabel("work per oscillation [J]")
    for name in ("SA5", "SA6", "SA7", "SA8"):
        axes[name].set_xlabel("oscillation")
        axes[name].set_xticks([1, 5, 10, 15, 19])
    style.legend_above(figure, axes["SA1"], columns=5)
    style.notes(figure, notes.lines(notes.HARMONIC, notes.VIRTUAL))
    return Plot(
        11,
        "Work performed at oil levels near 40 % over 19 sinusoidal oscillations, all velocities",
        figure,
        (
            Statement(
                text="the work per oscillation is constant at low velocities and at higher ones falls with the number of "
                "oscillations, sometimes very sharply",
                source="Section 3.1, Figure 11",
                holds=max(steady.values()) <= VISIBLE and min(fallen.values()) < FALLEN,
                numbers={"spread_at_0.05_m_per_s": steady, "least_work_19th_over_1st": fallen},
                basis="calibrated",  # on C3
                criterion=f"spread at 0.05 m/s up to {VISIBLE:.0%}; at some velocity the 19th oscillation does less than "
                "half of the work of the 1st",
            ),
            from_claim(context.claim("C4")),
        ),
        notes.VIRTUAL,
        notes.HARMONIC,
        ("The paper shows measurements only; coloured lines are the model, grey ones the stand-in.",),
    )
