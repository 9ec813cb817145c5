"""Figures 5, 6 and 29 to 32: drives."""

from typing import Any

import numpy as np

from twintube.claims.claim import MODEL_ERROR
from twintube.claims.table3_drives import BUMP
from twintube.common.arrays import Array
from twintube.report.common import style
from twintube.report.paper import fitted, notes
from twintube.report.paper.context import Context
from twintube.report.paper.figures.validation import model_works, on_record
from twintube.report.paper.records import Job, drive_jobs, harmonic_jobs, levels, slow_jobs
from twintube.report.paper.statement import Plot, Statement, from_claim
from twintube.vehicle.maneuvers import MANEUVERS
from twintube.vehicle.plan import drive_signal

FORCE_ERROR, MOVING = 0.20, 0.05  # error limit of the force [1], and velocity [m/s] above which it is evaluated


def strokes(context: Context, number: int, first: int, last: int) -> Plot:
    """Damper strokes of the front axle over time for the drives `first` to `last` of Table 3."""
    maneuvers = [m for m in MANEUVERS if first <= m.number <= last]
    damper = context.dampers["SA7"]
    figure, axes = style.canvas(len(maneuvers), 1, (9.0, 7.4))
    speed = {}
    for ax, maneuver in zip(axes[:, 0], maneuvers, strict=True):
        signal = drive_signal(damper, maneuver)
        span = slice(signal.marks[0], None)
        ax.plot(signal.time[span] - signal.time[signal.marks[0]], signal.stroke[span] * 1e3, color=style.BLUE, lw=0.9)
        style.title(ax, f"{maneuver.number}: {maneuver.name}")
        ax.set_ylabel("stroke [mm]")
        ax.margins(x=0.01)
    for maneuver in MANEUVERS:
        signal = drive_signal(damper, maneuver)
        speed[f"{maneuver.number} {maneuver.name}"] = float(np.percentile(np.abs(signal.velocity[signal.marks[0] :]), 90))
    axes[-1][0].set_xlabel("time [s]")
    assumed = (notes.DRIVES, notes.FV, notes.FRICTION, notes.GAS)
    style.notes(figure, ["Stand-in: strokes simulated in a quarter car with the intact damper, not the paper's measurement.",
                         *notes.lines(assumed)])  # fmt: skip
    fast = [v for k, v in speed.items() if "uneven" in k and " 4 km/h" not in k]
    others = [v for k, v in speed.items() if not ("uneven" in k and " 4 km/h" not in k)]
    return Plot(
        number,
        f"Front damper excitation, measurements {first} to {last}",
        figure,
        (
            Statement(
                text="excitations with persistently high damper velocities occur particularly on uneven roads",
                source="Section 4, Figure 6",
                holds=min(fast) > max(others),
                numbers={"damper_velocity_exceeded_a_tenth_of_the_time_m_per_s": speed},
                basis="by assumption",
                criterion="velocity exceeded a tenth of the time: every uneven road from 30 km/h on above all others",
                reason="" if min(fast) > max(others) else "with the assumed obstacles another drive has velocities as high",
            ),
        ),
        ("strokes simulated in a quarter car with the intact damper, not the paper's measurement",),
        assumed,
        ("The text gives no number for these strokes, so their size cannot be checked.",),
    )


def figure_5(context: Context) -> Plot:
    """Drives 3 to 7."""
    return strokes(context, 5, 3, 7)


def figure_6(context: Context) -> Plot:
    """Drives 8 to 12."""
    return strokes(context, 6, 8, 12)


def jobs_bump(name: str) -> list[Job]:
    """Records of the slow bump in all states and of the identification."""
    return [*harmonic_jobs(name), *slow_jobs(name)[:1], *drive_jobs(name, (BUMP,))]


def bump(context: Context, name: str) -> Plot:
    """Figures 29 and 30: force over time during the slow bump crossing."""
    damper = context.fit(name)
    figure, axes = style.canvas(3, 1, (9.0, 6.6), sharex=True, sharey=True)
    errors, peaks = {}, {}
    for ax, level, colour in zip(axes[:, 0], levels(name), style.LEVELS, strict=True):
        record = context.records.get(Job(name, "drive", float(BUMP), level))
        run = on_record(damper, record)
        span = slice(record.marks[0], record.marks[-1] + 1)
        time = record.time[span] - record.time[record.marks[0]]
        ax.plot(time, record.force[span] / 1e3, color=style.GREY, lw=2.2, label="virtual rig (stand-in)")
        ax.plot(time, run.force[span] / 1e3, color=colour, lw=1.2, label=f"model, {level:.0%} oil")
        style.title(ax, f"{level:.0%} oil")
        ax.set_ylabel("force [kN]")
        ax.set_xlim(0.3, 2.0)
        errors[f"{level:.0%}"] = error_moving(run.force[span], record.force[span], record.velocity[span])
        peaks[f"{level:.0%}"] = {"virtual rig": extremes(record.force[span]), "model": extremes(run.force[span])}
    axes[-1][0].set_xlabel("time [s]")
    style.legend_above(figure, *axes[:, 0])
    assumed = (notes.DEAD, notes.DRIVES)
    style.notes(figure, notes.lines(assumed, notes.VIRTUAL, fitted.HOW))
    reproduced = max(errors.values()) <= FORCE_ERROR
    return Plot(
        29 if name == "SA7" else 30,
        f"Damping force over time for the slow bump crossing of {name}",
        figure,
        (
            Statement(
                text="the model is able to reproduce the damping forces of the slow bump crossing well, in all states",
                source="Section 3.3, Figures 29 and 30",
                holds=reproduced,
                numbers={"rmse_over_rms_of_the_force_while_moving": errors, "largest_and_smallest_force_N": peaks},
                basis="stand-in",
                criterion=f"root mean square error up to {FORCE_ERROR:.0%} of the stand-in's root mean square force while "
                f"it moves faster than {MOVING:g} m/s, in every state",
                reason="" if reproduced else "the rig has other physics; error too large at "
                + ", ".join(level for level, x in errors.items() if x > FORCE_ERROR),
            ),
        ),
        notes.VIRTUAL,
        assumed,
    )  # fmt: skip


def bias(works: list[Any], states: tuple[float, ...]) -> str:
    """Mean difference of model and stand-in by oil level, as text; `works`: relative works (drives, levels) of both."""
    shift = (works[1] - works[0]).mean(axis=0)
    texts = [f"{abs(x):.0%} of the intact work too {'much' if x > 0 else 'little'} at {level:.0%} oil"
             for x, level in zip(shift, states, strict=True)]  # fmt: skip
    return "the rig has other physics: on average the model does " + " and ".join(texts)


def error_moving(simulated: Array, measured: Array, velocity: Array) -> float:
    """Root mean square error over the root mean square of the measured force while the damper moves [1]."""
    moving = np.abs(velocity) > MOVING
    return float(np.sqrt(np.mean((simulated - measured)[moving] ** 2) / np.mean(measured[moving] ** 2)))


def extremes(force: Any) -> list[float]:
    """Largest and smallest force [N]."""
    return [float(force.max()), float(force.min())]


def bars(context: Context, name: str) -> Plot:
    """Figures 31 and 32: work relative to intact for the ten drives."""
    damper = context.fit(name)
    table: dict[str, dict[str, list[float]]] = {"virtual rig": {}, "model": {}}
    for maneuver in MANEUVERS:
        records = [context.records.get(Job(name, "drive", float(maneuver.number), level)) for level in levels(name)]
        rig = np.array([record.works()[0] for record in records])
        model = np.array([model_works(damper, record)[0] for record in records])
        table["virtual rig"][maneuver.name] = (rig / rig[0]).tolist()
        table["model"][maneuver.name] = (model / model[0]).tolist()
    figure, axes = style.canvas(1, 1, (10.0, 4.8))
    ax = axes[0][0]
    positions = np.arange(len(MANEUVERS))
    for i, (level, colour) in enumerate(zip(levels(name)[1:], style.LEVELS[1:], strict=True), start=1):
        for j, (source, hatch) in enumerate((("virtual rig", "////"), ("model", ""))):
            text = "virtual rig (stand-in)" if j == 0 else "model"
            heights = 100 * np.array([row[i] for row in table[source].values()])
            place, face = positions + (2 * i + j - 3.5) * 0.2, "white" if hatch else colour
            text = f"{text}, {level:.0%} oil"
            ax.bar(place, heights, 0.18, color=face, edgecolor=colour, hatch=hatch, lw=0.8, label=text)
    ax.axhline(100, color=style.INK, lw=0.9, ls="--")
    ax.set_xticks(
        positions,
        [f"{m.number}: {m.name}".replace(", ", ",\n") for m in MANEUVERS],
        rotation=32,
        ha="right",
        rotation_mode="anchor",
        fontsize=8.5,
    )
    ax.set_ylabel("work relative to intact [%]")
    ax.grid(visible=False, axis="x")
    style.legend_above(figure, ax)
    assumed = (notes.DEAD, notes.DRIVES)
    style.notes(figure, notes.lines(assumed, notes.VIRTUAL, fitted.HOW))
    works = [np.array([row[1:] for row in table[source].values()]) for source in ("virtual rig", "model")]
    mean = [float(x) for x in np.abs(works[0] - works[1]).mean(axis=0)]
    return Plot(
        31 if name == "SA7" else 32,
        f"Work performed for stochastic excitation signals of {name}, relative to the intact state",
        figure,
        (
            Statement(
                text="the simulation model provides a good representation of the work performed",
                source="Section 3.3, Figures 31 and 32",
                holds=max(mean) <= MODEL_ERROR,
                numbers={"mean_difference_at_60_40": mean, "work_relative_to_intact_at_100_60_40": table},
                basis="stand-in",
                criterion=f"on average over the ten drives the works differ by up to {MODEL_ERROR:.0%} of the intact work",
                reason="" if max(mean) <= MODEL_ERROR else bias(works, levels(name)[1:]),
            ),
            from_claim(context.claim("C13")),
        ),
        notes.VIRTUAL,
        assumed,
        ("C13 uses the published parameters and the assumed F-v curve; the bars show the identified model.",),
    )
