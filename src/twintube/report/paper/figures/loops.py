"""Figures 27 and 28: force over stroke, model and stand-in."""

from typing import Any

import numpy as np

from twintube.common.arrays import Array
from twintube.dampers import Damper
from twintube.engine.simulation import Simulation
from twintube.identification import Harmonic
from twintube.report.common import style
from twintube.report.paper import fitted, notes
from twintube.report.paper.context import Context
from twintube.report.paper.figures.validation import UNCHANGED, deviation, model_works, on_record
from twintube.report.paper.records import Job, levels
from twintube.report.paper.statement import Plot, Statement, from_claim
from twintube.rig.signals import FASTEST

SHAPE = 0.10  # root mean square error of a force over the range of the measured one


def loop_figure(context: Context, velocity: float) -> tuple[Harmonic, Simulation, Damper]:
    """SA7 at its higher degraded level: the record of the stand-in, the simulation with its stroke, and the damper."""
    name = "SA7"
    record = context.records.get(Job(name, "harmonic", velocity, levels(name)[1]))
    damper = context.fit(name)
    return record, on_record(damper, record), damper


def steepest(stroke: Array, force: Array) -> float:
    """Largest change of force per stroke [N/mm] away from the reversals."""
    inner = np.abs(stroke) < 0.8 * np.abs(stroke).max()
    window = max(2, len(stroke) // 100)
    change = np.abs(force[window:] - force[:-window]) / np.maximum(np.abs(stroke[window:] - stroke[:-window]), 1e-5)
    return float(change[inner[window:] & inner[:-window]].max() / 1e3)


def figure_27(context: Context) -> Plot:
    """F-s diagram of one slow oscillation."""
    record, run, _ = loop_figure(context, 0.08)
    span = slice(record.marks[-2], record.marks[-1] + 1)
    figure, axes = style.canvas(1, 1, (7.5, 4.4))
    ax = axes[0][0]
    ax.plot(record.stroke[span] * 1e3, record.force[span], color=style.BLUE, lw=1.4, label="virtual rig (stand-in)")
    ax.plot(run.stroke[span] * 1e3, run.force[span], color=style.RED, lw=1.4, label="model")
    style.label(axes, "stroke [mm]", "force [N]")
    style.legend_above(figure, ax)
    assumed = (notes.DEAD, notes.REACH)
    style.notes(figure, notes.lines(assumed, notes.VIRTUAL, fitted.HOW))
    error = deviation(run.force[span], record.force[span])
    edge = {
        "model": steepest(run.stroke[span], run.force[span]),
        "virtual rig": steepest(record.stroke[span], record.force[span]),
    }
    return Plot(
        27,
        f"Force-displacement diagram of Shock Absorber 7, {record.oil_level:.0%} oil (paper's 60 %), 0.08 m/s",
        figure,
        (
            from_claim(context.claim("C15")),
            Statement(
                text="the qualitative behaviour of the force at lower velocities can be reproduced",
                source="Section 3.3, Figure 27",
                holds=error <= SHAPE,
                numbers={"rmse_over_range_of_the_force": error},
                basis="stand-in",
                criterion=f"root mean square error up to {SHAPE:.0%} of the range of the stand-in's force",
                reason="" if error <= SHAPE else "the rig has other physics than the model",
            ),
            Statement(
                text="the model's force changes in steps, in reality it is often smoother",
                source="Section 3.3, Figure 27",
                holds=edge["model"] > edge["virtual rig"],
                numbers={"steepest_change_N_per_mm": edge},
                basis="stand-in",
                reason=""
                if edge["model"] > edge["virtual rig"]
                else "in this state the stand-in's force has the steeper change",
            ),
        ),
        notes.VIRTUAL,
        assumed,
        ("The caption says SA7, the text SA1; drawn as in the caption.",),
    )


def figure_28(context: Context) -> Plot:
    """F-s diagram of 19 fast oscillations."""
    record, run, _ = loop_figure(context, FASTEST)
    figure, axes = style.canvas(1, 1, (7.5, 4.4))
    ax = axes[0][0]
    span = slice(record.marks[0], None)
    ax.plot(
        record.stroke[span] * 1e3,
        record.force[span] / 1e3,
        color=style.BLUE,
        lw=0.7,
        label="virtual rig (stand-in), 1st to 19th",
    )
    for i, colour, text, ls in ((-1, style.RED, "19th", "-"), (0, style.GREEN, "1st", (0, (5, 2)))):
        oscillation = slice(record.marks[:-1][i], record.marks[1:][i] + 1)
        name = f"model, {text} oscillation"
        ax.plot(run.stroke[oscillation] * 1e3, run.force[oscillation] / 1e3, color=colour, ls=ls, lw=1.6, label=name)
    style.label(axes, "stroke [mm]", "force [kN]")
    style.legend_above(figure, ax)
    assumed = (notes.DEAD, notes.REACH)
    style.notes(figure, notes.lines(assumed, notes.VIRTUAL, fitted.HOW))
    works: dict[str, Any] = {"virtual rig": record.works(), "model": model_works(context.fit("SA7"), record)}
    last = {source: float(w[-1] / w[0]) for source, w in works.items()}
    return Plot(
        28,
        f"Force-displacement diagram of Shock Absorber 7, {record.oil_level:.0%} oil (paper's 60 %), 19 oscillations, "
        f"maximum velocity {FASTEST} m/s",
        figure,
        (
            Statement(
                text="the force falls with the number of oscillations, and the model reproduces this qualitatively",
                source="Section 3.3, Figure 28",
                holds=max(last.values()) < UNCHANGED,
                numbers={"work_19th_over_1st": last},
                basis="stand-in",
                criterion=f"both lose more than {1 - UNCHANGED:.0%} of work from the 1st to the 19th oscillation",
                reason="" if max(last.values()) < UNCHANGED else f"no fall in the {max(last, key=last.__getitem__)}",
            ),
        ),
        notes.VIRTUAL,
        assumed,
        ("The caption says SA7 and 60 %, the text SA1 and 40 %; drawn as in the caption.",),
    )
