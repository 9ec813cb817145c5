"""Figures 3, 7 and 12: the intact damper."""

from typing import Any

import numpy as np

from twintube.common.arrays import Array
from twintube.core.kernel import fluid_force, stribeck
from twintube.dampers import Damper
from twintube.engine.simulate import simulate
from twintube.identification import Harmonic
from twintube.identification.intact import fv_points, quasi_static
from twintube.report.common import style
from twintube.report.paper import notes
from twintube.report.paper.context import Context, loop
from twintube.report.paper.records import Job, harmonic_jobs, slow_jobs
from twintube.report.paper.statement import Plot, Statement, from_claim
from twintube.rig.plan import at_oil_level, oil_levels
from twintube.rig.plan import quasi_static as ramps
from twintube.rig.signals import BLOCKS

CURVE_FOUND = 0.02  # relative deviation [1] of a curve that is determined from its own simulation


def jobs_3(name: str) -> list[Job]:
    """Intact blocks at the velocities common to all dampers."""
    return [job for job in harmonic_jobs(name, BLOCKS) if job.gas_preload]


def model_record(damper: Damper, velocity: float) -> Harmonic:
    """The simulation of an intact block, as a record."""
    signal, run = loop(damper, 1.0, velocity)
    return Harmonic(1.0, 1, signal.time, run.stroke, run.velocity, run.force, signal.marks)


def forces_at_middle(record: Harmonic) -> tuple[float, float]:
    """Forces [N] at stroke 0 in rebound and compression, means over the oscillations."""
    z, F = record.stroke[record.marks[0] :], record.force[record.marks[0] :]
    forces = []
    for i in (np.flatnonzero((z[:-1] < 0) & (z[1:] >= 0)), np.flatnonzero((z[:-1] > 0) & (z[1:] <= 0))):
        share = z[i] / (z[i] - z[i + 1])
        forces.append(float(np.mean(F[i] + share * (F[i + 1] - F[i]))))
    return forces[0], forces[1]


def figure_3(context: Context) -> Plot:
    """F-v characteristics of the eight dampers."""
    figure, axes = style.panels(context.dampers, sharex=True)
    deviation: dict[str, float] = {}
    for name, ax in axes.items():
        damper = context.dampers[name]
        p = damper.parameters
        v = np.linspace(-1.6, 1.6, 400)
        curve = [fluid_force(p, float(x)) / 1e3 for x in v]
        ax.plot(v, curve, color=style.INK, lw=1.6, label="friction-reduced F-v curve (assumed)")
        model_records = [model_record(damper, speed) for speed in BLOCKS]
        model_forces = [forces_at_middle(record) for record in model_records]
        both_ways = [*BLOCKS, *(-speed for speed in BLOCKS)]
        values = np.array([force[0] for force in model_forces] + [force[1] for force in model_forces])
        ax.plot(both_ways, values / 1e3, "o", ms=4, color=style.BLUE, mfc="white", label="model, force at stroke 0")
        rig_forces = [forces_at_middle(context.records.get(job)) for job in jobs_3(name)]
        values = np.array([force[0] for force in rig_forces] + [force[1] for force in rig_forces])
        ax.plot(both_ways, values / 1e3, "x", ms=4, color=style.GREY, label="virtual rig (stand-in), force at stroke 0")
        rebound, compression = fv_points(damper, model_records)
        deviations = [abs(F / fluid_force(p, u) - 1) for u, F in rebound] + [
            abs(F / -fluid_force(p, -u) - 1) for u, F in compression
        ]
        deviation[name] = max(deviations)
    for name in ("SA1", "SA5"):
        axes[name].set_ylabel("force [kN]")
    for name in ("SA5", "SA6", "SA7", "SA8"):
        axes[name].set_xlabel("velocity [m/s]")
    style.legend_above(figure, axes["SA1"])
    assumed = (notes.FV, notes.FRICTION, notes.GAS, notes.BLOCKS)
    style.notes(figure, notes.lines(assumed, notes.VIRTUAL))
    return Plot(
        3,
        "Force-velocity characteristics of Shock Absorbers 1 (a) to 8 (h), intact",
        figure,
        (
            Statement(
                text="SA1 to SA6 have the same F-v characteristics before and after the modification (valves welded in)",
                source="Section 2, Figure 3",
                holds=None,
                numbers={},
                basis="not checkable",
                reason="the measured curves are unpublished, and a model has no counterpart of the modification",
            ),
            Statement(
                text="the friction-reduced F-v curve is determined from harmonic measurements of the intact damper at a "
                "displacement of 0 mm",
                source="Section 3.2",
                holds=max(deviation.values()) <= CURVE_FOUND,
                numbers={"largest_deviation_of_the_curve_found_from_the_curve_put_in": deviation},
                basis="consistency",
                criterion="the curve determined from simulated intact blocks at 0 mm equals the input curve within 2 %",
            ),
        ),
        notes.VIRTUAL,
        assumed,
        ("Front dampers share one assumed curve, rear dampers another; the paper's eight curves differ.",),
    )


def slope(stroke: Array, force: Array) -> float:
    """Slope [N/m] of the slow force over the stroke, mean of both directions."""
    return quasi_static(stroke, force).c_gas


def figure_7(context: Context) -> Plot:
    """Quasi-static F-s diagram of SA7."""
    damper = context.dampers["SA7"]
    figure, axes = style.canvas(1, 2, (10.0, 4.2), sharex=True)
    signal = ramps(damper)
    slopes: dict[str, list[float]] = {"model": [], "virtual rig": []}
    for level, job, colour in zip(oil_levels(damper), slow_jobs("SA7"), style.LEVELS, strict=True):
        text = "100% oil, gas preload" if level >= 1.0 else f"{level:.0%} oil, no preload"
        run = simulate(at_oil_level(damper, level), signal.stroke, signal.velocity)
        dash = (0, (4, 3)) if level == oil_levels(damper)[-1] else "-"  # the curves of the two degraded states coincide
        axes[0][0].plot(run.stroke * 1e3, run.force, color=colour, ls=dash, lw=1.2, label=text)
        rig = context.records.get(job)
        axes[0][1].plot(rig.stroke * 1e3, rig.force, color=colour, ls=dash, lw=1.2)
        slopes["model"].append(slope(run.stroke, run.force))
        slopes["virtual rig"].append(slope(rig.stroke, rig.force))
    style.title(axes[0][0], "model")
    style.title(axes[0][1], f"{style.STAND_IN}")
    style.label(axes, "stroke [mm]", "force [N]")
    style.legend_above(figure, axes[0][0])
    assumed = (notes.FRICTION, notes.GAS, notes.FV, notes.REACH)
    style.notes(figure, notes.lines(assumed, notes.VIRTUAL))
    claim = context.claim("C11")
    table: Any = claim.figures["slope_N_per_m_with_and_without_preload"]
    return Plot(
        7,
        "Quasi-static measurements of Shock Absorber 7 at 1 mm/s",
        figure,
        (
            from_claim(claim, {"SA7_slope_N_per_m_with_and_without_preload": table["SA7"], "at_100_60_40": slopes}),
            Statement(
                text="the measurements show an offset of a few newtons, because the rig is not free of lateral forces",
                source="Section 3.1, Figure 7",
                holds=None,
                numbers={},
                basis="not checkable",
                reason="a property of the paper's rig; the model and the stand-in have no lateral forces",
            ),
        ),
        notes.VIRTUAL,
        assumed,
        ("The paper shows measurements only; the left panel is the model with assumed gas spring and friction.",),
    )


def figure_12(context: Context) -> Plot:
    """Velocity-dependent scaling of the friction."""
    figure, axes = style.canvas(1, 1, (7.0, 3.6))
    v = np.linspace(-0.3, 0.3, 601)
    curves = {name: np.array([stribeck(d.parameters, float(x)) for x in v]) for name, d in context.dampers.items()}
    ax = axes[0][0]
    ax.plot(v, curves["SA7"], color=style.INK, lw=1.6)
    ax.set_ylim(0, 1.08)
    ax.set_xlabel("velocity [m/s]")
    ax.set_ylabel("scaling $k_{FrS}$ [1]")
    assumed = ("shape and values of the scaling, the same for all eight dampers",)
    style.notes(figure, notes.lines(assumed))
    scaling = curves["SA7"]
    return Plot(
        12,
        "Velocity-dependent scaling factor for the friction force",
        figure,
        (
            Statement(
                text="the friction is scaled with a damper-specific Stribeck curve taken from Deubel",
                source="Section 3.2, Figure 12",
                holds=None,
                numbers={
                    "scaling_at_rest": float(scaling.max()),
                    "scaling_at_0.3_m_per_s": float(scaling[-1]),
                    "largest_difference_between_dampers": float(max(np.ptp(c) for c in np.array(list(curves.values())).T)),
                },
                basis="not checkable",
                reason="Figure 12 has no numbers in the text; the curve is assumed",
            ),
        ),
        (),
        assumed,
    )
