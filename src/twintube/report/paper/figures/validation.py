"""Figures 19 to 28: harmonic measurements and model. The measurements are those of the virtual rig."""

from typing import Any

import numpy as np

from twintube.claims.claim import FRONT, MODEL_ERROR
from twintube.common.arrays import Array
from twintube.core.kernel import prepare
from twintube.core.variables import Derived, blank
from twintube.dampers import Damper
from twintube.engine.simulate import simulate, work_between
from twintube.engine.simulation import Simulation
from twintube.identification import Harmonic
from twintube.report.common import style
from twintube.report.paper import fitted
from twintube.report.paper.context import Context
from twintube.report.paper.records import Job, levels, rig_oil_level
from twintube.report.paper.statement import DEAD, NOT_CHECKABLE, REACH, SPEEDS, VIRTUAL, Plot, Statement, from_claim
from twintube.rig.plan import amplitude, at_oil_level, velocities
from twintube.rig.signals import FASTEST

UNCHANGED = 0.99  # work of the 19th over that of the 1st oscillation: a larger ratio is not a loss
NOT_JUDGED = 0.05  # share of the intact work below which a state is not judged
Tables = dict[str, dict[float, Array]]
REMARK = "Markers are works of the virtual rig: they show how the method handles other physics, not how real dampers behave."
TABLE_9 = "Grey lines: Table 9 as published, with the F-v curve, friction and gas spring of the virtual rig."
SHAPE = 0.10  # root mean square error of a force over the range of the measured one
SLOW = 0.08  # [m/s] of Figure 27


def on_record(damper: Damper, record: Harmonic) -> Simulation:
    """The model driven by a record's stroke, in its state."""
    return simulate(at_oil_level(damper, record.oil_level), record.stroke, record.velocity)


def model_works(damper: Damper, record: Harmonic) -> Array:
    """Works [J] of the model over a record's oscillations."""
    return work_between(at_oil_level(damper, record.oil_level), record.stroke, record.velocity, record.marks)


def deviation(simulated: Array, measured: Array) -> float:
    """Root mean square error over the range of the measured values [1]."""
    return float(np.sqrt(np.mean((simulated - measured) ** 2)) / np.ptp(measured))


def tables(context: Context, name: str) -> Tables:
    """Works [J] (velocities, 19) by source and oil level."""
    sources = {"model": context.fit(name), "published": context.published(name)}
    works: Tables = {"rig": {}, "model": {}, "published": {}}
    for level in levels(name):
        records = [context.records.get(Job(name, "harmonic", v, level)) for v in velocities(sources["model"])]
        works["rig"][level] = np.array([record.works() for record in records])
        for source, damper in sources.items():
            works[source][level] = np.array([model_works(damper, record) for record in records])
    return works


def work(context: Context, name: str) -> Plot:
    """Figures 19 to 26: damping work of the 1st and the 19th oscillation over the velocity."""
    works = tables(context, name)
    speeds = np.array(velocities(context.dampers[name]))
    figure, axes = style.pairs((10.0, 4.4), "", sharey=True)
    for ax, i in zip(axes.flat, (0, -1), strict=True):
        for level, colour in zip(works["rig"], style.LEVELS, strict=True):
            ax.plot(speeds, works["model"][level][:, i], color=colour, lw=1.6, label=f"model, {level:.0%} oil")
            text = f"virtual rig, {level:.0%} oil"
            ax.plot(speeds, works["rig"][level][:, i], "o", ms=4.5, mfc="white", color=colour, label=text)
        for table_9 in works["published"].values():
            ax.plot(speeds, table_9[:, i], color=style.GREY, lw=0.8, zorder=1, label="model, Table 9")
    style.from_zero(axes)
    style.legend_above(figure, axes[0][0], columns=4)
    held = rig_oil_level(Job(name, "harmonic", FASTEST, 1.0))
    room = f"Intact, the virtual rig holds {held:.0%} of the oil: its reserve needs volume for gas."
    return Plot(
        18 + int(name[2:]),
        f"Damping work for the 1st (a) and the 19th oscillation (b) for different excitation velocities of {name}",
        figure,
        statements(works, speeds, context.dampers[name]),
        (DEAD, REACH, SPEEDS),
        VIRTUAL,
        (REMARK, *([room] if held < 1.0 else []), TABLE_9),
        fitted.HOW,
    )


def statements(works: Tables, speeds: Array, damper: Damper) -> tuple[Statement, ...]:
    """Statements of Section 3.3 at Figures 19 to 26; Table 9 decides, except for the last one. Other sources are listed."""
    name, p = damper.name, damper.parameters
    intact, *degraded = works["rig"]
    fast = speeds > 0.99 * FASTEST
    falls, later, top = {}, {}, {}
    for source, table in works.items():
        falls[source] = [float(work[:, [0, -1]].mean() / table[intact][:, [0, -1]].mean()) for work in table.values()]
        later[source] = {f"{level:.0%}": float((table[level][fast, -1] / table[level][fast, 0]).max()) for level in degraded}
        top[source] = {f"{level:.0%}": float(table[level][-1, -1] / table[level][:-1, -1].max()) for level in degraded}
    deviations = {
        source: {
            f"{level:.0%}": mean_deviations(work, works["rig"][level], works["rig"][intact]) for level, work in table.items()
        }
        for source, table in works.items()
        if source != "rig"
    }
    published, table_9 = falls["published"], works["published"]
    judged = [f"{level:.0%}" for level in degraded if table_9[level][-1, 0] >= NOT_JUDGED * table_9[intact][-1, 0]]
    without_loss = [level for level in judged if later["published"][level] >= UNCHANGED]
    no_cavitation = "" if p.Y_Re_cav or p.Y_Co_cav else ": Table 9 gives this damper no cavitation"
    lower, front = min(top["published"].values()) < 1, name in FRONT
    worst, level, number = max((x, level, n) for level, pair in deviations["model"].items() for n, x in pair.items())
    return (
        Statement(
            "the work falls with the oil level",
            "Section 3.3",
            published[0] > published[1] > published[2],
            {"mean_work_relative_to_intact_at_100_60_40": falls},
            "calibrated",  # on C16, the same statement for every velocity
            reason=filling(damper, degraded[0])
            if published[1] >= published[0]
            else "the lower of the two levels does more work",
        ),
        Statement(
            "at high velocities the 19th oscillation does less work than the 1st",
            "Section 3.3",
            not without_loss,
            {"work_19th_over_1st_at_1.572": later, "judged": judged},
            "evidence",
            f"by more than {1 - UNCHANGED:.0%} at the highest velocity; states below {NOT_JUDGED:.0%} of the "
            "intact work are not judged",
            f"not at {' and '.join(without_loss)} oil{no_cavitation}",
        ),
        Statement(
            "at 1.6 m/s the work is partially lower than at lower velocities",
            "Section 3.3, Figure 11",
            lower or (False if front else None),
            {"work_19th_at_1.572_over_largest_below": top},
            "evidence" if lower or front else NOT_CHECKABLE,
            "19th oscillation, in at least one of the two degraded states",
            "the work does not fall in either state"
            if front
            else "it is not lower here; the paper states this for the front dampers, without a number for this rear damper",
        ),
        Statement(
            "the simulation model is able to reproduce the measurement data",
            "Section 3.3",
            worst <= MODEL_ERROR,
            {"mean_deviation_of_works_relative_to_intact_by_level": deviations},
            "stand-in",
            f"mean deviation over the velocities up to {MODEL_ERROR:.0%} of the intact work at all levels",
            f"the rig has other physics; largest at {level} oil, {number} oscillation: {worst:.1%}",
        ),
    )


def filling(damper: Damper, level: float) -> str:
    """Reason for no loss of work at an oil level: whether the oil fills both working chambers at every stroke."""
    d = blank(Derived)
    prepare(damper.parameters, d)
    reach = amplitude(damper)
    room = d.A_1 * (d.half_length - reach) + d.A_2 * (d.half_length + reach)
    oil = level * damper.parameters.V_oil
    fills = "fills" if oil >= room else "does not fill"
    return (
        f"no work is lost at {level:.0%} oil, which is {oil * 1e6:.0f} mL and {fills} the two working chambers of up to "
        f"{room * 1e6:.0f} mL (dead length and maximum stroke are assumed)"
    )


def mean_deviations(work: Array, measured: Array, intact: Array) -> dict[str, float]:
    """Mean deviation of the works (velocities, 19) [J] of the 1st and the 19th oscillation from the measured ones [1]."""
    deviations = np.abs(work - measured)[:, [0, -1]] / intact[:, [0]]
    return dict(zip(("1st", "19th"), deviations.mean(axis=0).tolist(), strict=True))


def drawn(context: Context, velocity: float, unit: str) -> tuple[Any, ...]:
    """SA7 at its higher degraded level: record of the stand-in, simulation with its stroke, figure and its axes."""
    record = context.records.get(Job("SA7", "harmonic", velocity, levels("SA7")[1]))
    figure, ((ax,),) = style.canvas(1, 1, (7.5, 4.4))
    ax.set(xlabel="stroke [mm]", ylabel=f"force [{unit}]")
    return record, on_record(context.fit("SA7"), record), figure, ax


def steepest(stroke: Array, force: Array) -> float:
    """Largest change of force per stroke [N/mm] away from the reversals."""
    inner = np.abs(stroke) < 0.8 * np.abs(stroke).max()
    window = max(2, len(stroke) // 100)
    change = np.abs(force[window:] - force[:-window]) / np.maximum(np.abs(stroke[window:] - stroke[:-window]), 1e-5)
    return float(change[inner[window:] & inner[:-window]].max() / 1e3)


def figure_27(context: Context) -> Plot:
    """F-s diagram of one slow oscillation."""
    record, run, figure, ax = drawn(context, SLOW, "N")
    span = slice(record.marks[-2], record.marks[-1] + 1)
    edge = {}
    for source, text, some, colour in (
        ("virtual rig", "virtual rig (stand-in)", record, style.BLUE),
        ("model", "model", run, style.RED),
    ):
        style.loop(ax, some, span, color=colour, lw=1.4, label=text)
        edge[source] = steepest(some.stroke[span], some.force[span])
    style.legend_above(figure, ax)
    error = deviation(run.force[span], record.force[span])
    return Plot(
        27,
        f"Force-displacement diagram of Shock Absorber 7, {record.oil_level:.0%} oil (paper's 60 %), {SLOW:g} m/s",
        figure,
        (
            from_claim(context.claim("C15")),
            Statement(
                "the qualitative behaviour of the force at lower velocities can be reproduced",
                "Section 3.3, Figure 27",
                error <= SHAPE,
                {"rmse_over_range_of_the_force": error},
                "stand-in",
                f"root mean square error up to {SHAPE:.0%} of the range of the stand-in's force",
                "the rig has other physics than the model",
            ),
            Statement(
                "the model's force changes in steps, in reality it is often smoother",
                "Section 3.3, Figure 27",
                edge["model"] > edge["virtual rig"],
                {"steepest_change_N_per_mm": edge},
                "stand-in",
                reason="in this state the stand-in's force has the steeper change",
            ),
        ),
        (DEAD, REACH),
        VIRTUAL,
        ("The caption says SA7, the text SA1; drawn as in the caption.",),
        fitted.HOW,
    )


def figure_28(context: Context) -> Plot:
    """F-s diagram of 19 fast oscillations."""
    record, run, figure, ax = drawn(context, FASTEST, "kN")
    text = "virtual rig (stand-in), 1st to 19th"
    style.loop(ax, record, slice(record.marks[0], None), 1e-3, color=style.BLUE, lw=0.7, label=text)
    for i, colour, text, ls in ((-1, style.RED, "19th", "-"), (0, style.GREEN, "1st", (0, (5, 2)))):
        span = slice(record.marks[:-1][i], record.marks[1:][i] + 1)
        style.loop(ax, run, span, 1e-3, color=colour, ls=ls, lw=1.6, label=f"model, {text} oscillation")
    style.legend_above(figure, ax)
    works = {"virtual rig": record.works(), "model": model_works(context.fit("SA7"), record)}
    last = {source: float(w[-1] / w[0]) for source, w in works.items()}
    return Plot(
        28,
        f"Force-displacement diagram of Shock Absorber 7, {record.oil_level:.0%} oil (paper's 60 %), 19 oscillations, "
        f"maximum velocity {FASTEST} m/s",
        figure,
        (
            Statement(
                "the force falls with the number of oscillations, and the model reproduces this qualitatively",
                "Section 3.3, Figure 28",
                max(last.values()) < UNCHANGED,
                {"work_19th_over_1st": last},
                "stand-in",
                f"both lose more than {1 - UNCHANGED:.0%} of work from the 1st to the 19th oscillation",
                f"no fall in the {max(last, key=last.__getitem__)}",
            ),
        ),
        (DEAD, REACH),
        VIRTUAL,
        ("The caption says SA7 and 60 %, the text SA1 and 40 %; drawn as in the caption.",),
        fitted.HOW,
    )
