"""The pictures of an identification."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from twintube.core.kernel import fluid_force
from twintube.fitting.parameters import DEGRADATION
from twintube.fitting.prediction import predicted
from twintube.fitting.splits import distinct
from twintube.identification import Harmonic, Result
from twintube.identification.intact import fv_points
from twintube.identification.validation import Validated
from twintube.report.common import style

EQUAL_AMPLITUDES = 1.1  # amplitudes that differ by a smaller factor belong to a line
SPLITS = {"heldout": "not fitted", "fit": "fitted"}


def loops(result: Result, chosen: Sequence[tuple[Harmonic, str]], narrow: bool = False) -> Figure:
    """Force over stroke, first and last oscillation, measured and simulated."""
    figure, axes = style.grid(len(chosen), (3.7, 2.9), narrow)
    damper, offset = result.identification.damper, result.identification.offset
    for ax, (record, split) in zip(axes.flat, chosen, strict=False):
        simulated = predicted(damper, record, offset)
        for colour, name, force in ((style.GREY, "measured", record.force), (style.RED, "simulated", simulated)):
            for dash, which, (a, b) in (("-", "first", record.marks[:2]), (":", "last", record.marks[-2:])):
                part, label = slice(int(a), int(b) + 1), f"{name}, {which} oscillation"
                ax.plot(record.stroke[part] * 1e3, force[part], dash, color=colour, lw=1.4, label=label)
        style.title(ax, f"{record.oil_level:.0%} oil, {record.top_speed:.3g} m/s, {SPLITS[split]}", 9)
    style.label(axes, "stroke [mm]", "force [N]")
    style.legend_above(figure, axes[0, 0])
    return figure


def works(rows: Sequence[Validated], narrow: bool = False) -> Figure:
    """Work of the first and the last oscillation over the velocity, per oil level."""
    figure, axes = style.grid(2, (5.0, 3.7), narrow)
    levels = sorted({(row.oil_level, row.gas_preload) for row in rows}, reverse=True)
    sizes = distinct((row.amplitude for row in rows), EQUAL_AMPLITUDES)
    palette = [style.INK, style.ORANGE, style.RED, style.BLUE, style.GREEN, style.VIOLET]
    for i, (ax, text) in enumerate(zip(axes.flat, ("first oscillation", "last oscillation"), strict=True)):
        for colour, level in zip(palette * 9, levels, strict=False):
            here = sorted((r for r in rows if (r.oil_level, r.gas_preload) == level), key=lambda r: r.top_speed)
            name = f"{level[0]:.0%} oil, {'with' if level[1] else 'without'} preload"
            label: str | None = f"simulated, {name}"
            # A line per amplitude: the work at a velocity is proportional to it.
            for size in sizes:
                line = [r for r in here if size <= r.amplitude <= EQUAL_AMPLITUDES * size]
                v, W = [r.top_speed for r in line], [r.work_simulated[i] for r in line]
                ax.plot(v, W, "-" if len(line) > 1 else "_", color=colour, lw=1.3, ms=9, label=label if line else None)
                label = None if line else label
            for fitted in (True, False):
                some = [r for r in here if (r.split != "heldout") is fitted]
                label = f"measured, {'fitted' if fitted else 'not fitted'}, {name}" if some else None
                measured = [r.work_measured[i] for r in some]
                fill = colour if fitted else "white"
                ax.plot([r.top_speed for r in some], measured, "o", ms=5, color=colour, mfc=fill, label=label)
        style.title(ax, text)
        ax.set_ylim(bottom=min(0.0, ax.get_ylim()[0]))
    style.label(axes, "velocity [m/s]", "work [J]")
    style.legend_above(figure, axes[0, 0], columns=3)
    return figure


def curve(result: Result, narrow: bool = False) -> Figure:
    """The identified F-v curve with the friction-reduced points of the intact records."""
    figure, ((ax,),) = style.grid(1, (8.0, 3.6), narrow)
    damper = result.identification.damper
    intact = [h for h, _ in result.harmonics if h.intact]
    v = np.linspace(-1, 1, 401) * max(h.top_speed for h, _ in result.harmonics)
    ax.plot(v, [fluid_force(damper.parameters, float(x)) for x in v], color=style.INK, label="identified")
    before = result.dataset.damper.parameters
    ax.plot(v, [fluid_force(before, float(x)) for x in v], color=style.GREY, lw=1, ls="--", label="given parameter set")
    if intact:
        rebound, compression = fv_points(damper, intact)
        points = np.array(rebound + [(-a, -b) for a, b in compression])
        points[:, 1] += result.identification.offset * -1.0
        ax.plot(points[:, 0], points[:, 1], "o", color=style.RED, ms=4, label="records at stroke 0, less friction and gas")
    ax.set(xlabel="velocity [m/s], rebound positive", ylabel="fluid force [N]")
    style.legend_above(figure, ax)
    return figure


def intervals(result: Result, narrow: bool = False) -> Figure:
    """Every parameter with its interval within its allowed range."""
    estimates = [e for e in result.identification.estimates if e.name in DEGRADATION]
    figure, ((ax,),) = style.grid(1, (8.0, 0.3 * len(estimates) + 0.5), narrow)
    for i, e in enumerate(estimates):
        low, width = e.bounds[0], e.bounds[1] - e.bounds[0]
        colour = style.BLUE if e.determined else style.FAINT
        ax.plot([(e.low - low) / width, (e.high - low) / width], [i, i], "-", lw=6, color=colour, solid_capstyle="butt")
        ax.plot((e.value - low) / width, i, "|", ms=12, mew=2, color=style.INK)
    ax.set_yticks(range(len(estimates)), [e.name for e in estimates])
    ax.set_xlim(-0.02, 1.02)
    ax.invert_yaxis()
    ax.set_xlabel("share of the allowed range")
    return figure


def convergence(result: Result, narrow: bool = False) -> Figure:
    """Best error after every generation of each search."""
    steps = result.identification.steps
    figure, axes = style.grid(len(steps), (3.6, 2.6), narrow, most=len(steps))
    for ax, step in zip(axes.flat, steps, strict=True):
        ax.plot(np.arange(1, len(step.best.trace) + 1), step.best.trace, color=style.BLUE)
        style.title(ax, step.title)
        ax.set(xlabel="generation", ylabel=f"error [{step.unit}]")
    return figure


def drives(rows: Sequence[Validated], narrow: bool = False) -> Figure:
    """Work of the drives relative to the intact damper."""
    figure, ((ax,),) = style.grid(1, (9.0, 0.32 * len(rows) + 0.7), narrow)
    at = np.arange(len(rows))
    ax.barh(at - 0.2, [r.relative_measured or 0.0 for r in rows], 0.38, color=style.GREY, label="measured")
    ax.barh(at + 0.2, [r.relative_simulated or 0.0 for r in rows], 0.38, color=style.RED, label="simulated")
    ax.set_yticks(at, [style.plain(r.name) for r in rows], fontsize=8)
    ax.invert_yaxis()
    ax.set_xlabel("work relative to the intact damper")
    style.legend_above(figure, ax)
    return figure
