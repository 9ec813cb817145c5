"""Figures 5, 6 and 29 to 32: drives."""

import numpy as np

from twintube.claims.claim import MODEL_ERROR
from twintube.claims.table3_drives import BUMP
from twintube.report.common import style
from twintube.report.paper import fitted
from twintube.report.paper.context import Context
from twintube.report.paper.figures.validation import model_works, on_record
from twintube.report.paper.records import Job, levels
from twintube.report.paper.statement import DEAD, DRIVES, FRICTION, FV, GAS, VIRTUAL, Plot, Statement, from_claim
from twintube.vehicle.maneuvers import MANEUVERS
from twintube.vehicle.plan import drive_signal

FORCE_ERROR, MOVING = 0.20, 0.05  # error limit of the force [1], and velocity [m/s] above which it is evaluated


def strokes(context: Context, number: int, first: int, last: int) -> Plot:
    """Figures 5 and 6: damper strokes of the front axle over time for the drives `first` to `last` of Table 3."""
    shown = [m for m in MANEUVERS if first <= m.number <= last]
    figure, axes = style.canvas(len(shown), 1, (9.0, 7.4))
    panels = dict(zip((m.number for m in shown), axes[:, 0], strict=True))
    speed: dict[str, float] = {}
    rough = set()  # drives whose velocities should be high
    for maneuver in MANEUVERS:
        signal = drive_signal(context.dampers["SA7"], maneuver)
        span, text = slice(signal.marks[0], None), f"{maneuver.number} {maneuver.name}"
        speed[text] = float(np.percentile(np.abs(signal.velocity[span]), 90))
        rough |= {text} if "uneven" in text and " 4 km/h" not in text else set()
        if ax := panels.get(maneuver.number):
            ax.plot(signal.time[span] - signal.time[signal.marks[0]], signal.stroke[span] * 1e3, color=style.BLUE, lw=0.9)
            style.title(ax, f"{maneuver.number}: {maneuver.name}")
            ax.set_ylabel("stroke [mm]")
            ax.margins(x=0.01)
    axes[-1][0].set_xlabel("time [s]")
    return Plot(
        number,
        f"Front damper excitation, measurements {first} to {last}",
        figure,
        (
            Statement(
                "excitations with persistently high damper velocities occur particularly on uneven roads",
                "Section 4, Figure 6",
                min(map(speed.__getitem__, rough)) > max(map(speed.__getitem__, speed.keys() - rough)),
                {"damper_velocity_exceeded_a_tenth_of_the_time_m_per_s": speed},
                "by assumption",
                "velocity exceeded a tenth of the time: every uneven road from 30 km/h on above all others",
                "with the assumed obstacles another drive has velocities as high",
            ),
        ),
        (DRIVES, FV, FRICTION, GAS),
        ("stand-in: strokes simulated in a quarter car with the intact damper, not the paper's measurement",),
        ("The text gives no number for these strokes, so their size cannot be checked.",),
    )


def bump(context: Context, name: str) -> Plot:
    """Figures 29 and 30: force over time during the slow bump crossing."""
    damper = context.fit(name)
    figure, axes = style.canvas(3, 1, (9.0, 6.6), sharex=True, sharey=True)
    errors, peaks = {}, {}
    for ax, level, colour in zip(axes[:, 0], levels(name), style.LEVELS, strict=True):
        record = context.records.get(Job(name, "drive", float(BUMP), level))
        span = slice(record.marks[0], record.marks[-1] + 1)
        time, measured, simulated = record.time[span], record.force[span], on_record(damper, record).force[span]
        ax.plot(time - time[0], measured / 1e3, color=style.GREY, lw=2.2, label="virtual rig (stand-in)")
        ax.plot(time - time[0], simulated / 1e3, color=colour, lw=1.2, label=f"model, {level:.0%} oil")
        style.title(ax, f"{level:.0%} oil")
        ax.set_xlim(0.3, 2.0)
        moving = np.abs(record.velocity[span]) > MOVING
        error = np.mean((simulated - measured)[moving] ** 2) / np.mean(measured[moving] ** 2)
        errors[f"{level:.0%}"] = float(np.sqrt(error))
        forces = {"virtual rig": measured, "model": simulated}
        peaks[f"{level:.0%}"] = {source: [float(F.max()), float(F.min())] for source, F in forces.items()}
    style.label(axes, "time [s]", "force [kN]")
    style.legend_above(figure, *axes[:, 0])
    return Plot(
        29 if name == "SA7" else 30,
        f"Damping force over time for the slow bump crossing of {name}",
        figure,
        (
            Statement(
                "the model is able to reproduce the damping forces of the slow bump crossing well, in all states",
                "Section 3.3, Figures 29 and 30",
                max(errors.values()) <= FORCE_ERROR,
                {"rmse_over_rms_of_the_force_while_moving": errors, "largest_and_smallest_force_N": peaks},
                "stand-in",
                f"root mean square error up to {FORCE_ERROR:.0%} of the stand-in's root mean square force while "
                f"it moves faster than {MOVING:g} m/s, in every state",
                "the rig has other physics; error too large at "
                + ", ".join(level for level, x in errors.items() if x > FORCE_ERROR),
            ),
        ),
        (DEAD, DRIVES),
        VIRTUAL,
        model=fitted.HOW,
    )


def bars(context: Context, name: str) -> Plot:
    """Figures 31 and 32: work relative to intact for the ten drives."""
    damper, states = context.fit(name), levels(name)
    table: dict[str, dict[str, list[float]]] = {"virtual rig": {}, "model": {}}
    for maneuver in MANEUVERS:
        records = [context.records.get(Job(name, "drive", float(maneuver.number), level)) for level in states]
        rig, model = ([record.works()[0] for record in records], [model_works(damper, record)[0] for record in records])
        for source, works in zip(table, (rig, model), strict=True):
            table[source][maneuver.name] = [float(work / works[0]) for work in works]
    figure, ((ax,),) = style.canvas(1, 1, (10.0, 4.8))
    positions = np.arange(len(MANEUVERS))
    found = {source: np.array(list(rows.values()))[:, 1:] for source, rows in table.items()}  # (drives, degraded levels)
    for i, (level, colour) in enumerate(zip(states[1:], style.LEVELS[1:], strict=True)):
        for j, (source, hatch, text) in enumerate(
            (("virtual rig", "////", "virtual rig (stand-in)"), ("model", "", "model"))
        ):
            place, face = positions + (2 * i + j - 1.5) * 0.2, "white" if hatch else colour
            ax.bar(
                place, 100 * found[source][:, i], 0.18, color=face, edgecolor=colour, hatch=hatch, lw=0.8,
                label=f"{text}, {level:.0%} oil",
            )  # fmt: skip
    ax.axhline(100, color=style.INK, lw=0.9, ls="--")
    names = [f"{m.number}: {m.name}".replace(", ", ",\n") for m in MANEUVERS]
    ax.set_xticks(positions, names, rotation=32, ha="right", rotation_mode="anchor", fontsize=8.5)
    ax.set_ylabel("work relative to intact [%]")
    ax.grid(visible=False, axis="x")
    style.legend_above(figure, ax)
    shift = found["model"] - found["virtual rig"]
    mean = [float(x) for x in np.abs(shift).mean(axis=0)]
    biased = [
        f"{abs(x):.0%} of the intact work too {'much' if x > 0 else 'little'} at {level:.0%} oil"
        for x, level in zip(shift.mean(axis=0), states[1:], strict=True)
    ]
    return Plot(
        31 if name == "SA7" else 32,
        f"Work performed for stochastic excitation signals of {name}, relative to the intact state",
        figure,
        (
            Statement(
                "the simulation model provides a good representation of the work performed",
                "Section 3.3, Figures 31 and 32",
                max(mean) <= MODEL_ERROR,
                {"mean_difference_at_60_40": mean, "work_relative_to_intact_at_100_60_40": table},
                "stand-in",
                f"on average over the ten drives the works differ by up to {MODEL_ERROR:.0%} of the intact work",
                f"the rig has other physics: on average the model does {' and '.join(biased)}",
            ),
            from_claim(context.claim("C13")),
        ),
        (DEAD, DRIVES),
        VIRTUAL,
        ("C13 uses the published parameters and the assumed F-v curve; the bars show the identified model.",),
        fitted.HOW,
    )
