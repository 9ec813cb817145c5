"""The page of `twintube identify`: parameters, their intervals, and the errors on the records."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from twintube.core.kernel import fluid_force
from twintube.dampers.freed_gas import as_published
from twintube.files import write_bytes, write_text
from twintube.fitting.parameters import DEGRADATION
from twintube.fitting.prediction import predicted
from twintube.fitting.splits import distinct
from twintube.identification import Harmonic, Result
from twintube.identification.figures import totals, unit
from twintube.identification.intact import fv_points
from twintube.identification.judgement import judgement, next_step
from twintube.identification.remarks import reach
from twintube.identification.validation import Validated
from twintube.report import style
from twintube.report.live import Curve, Look, live
from twintube.report.page import Picture, Section, Table, html

EQUAL_AMPLITUDES = 1.1  # amplitudes that differ by a smaller factor belong to a line
LOOPS = 8  # records of which the loops are drawn


def loops(result: Result, chosen: Sequence[tuple[Harmonic, str]]) -> Figure:
    """Force over stroke, first and last oscillation, measured and simulated."""
    rows = (len(chosen) + 3) // 4
    figure, axes = style.canvas(rows, min(4, len(chosen)), (11.0, 2.9 * rows + 0.4))
    damper, offset = as_published(result.identification.damper), result.identification.offset
    for ax, (record, split) in zip(axes.flat, chosen, strict=False):
        simulated = predicted(damper, record, offset)
        for colour, name, force in ((style.GREY, "measured", record.force), (style.RED, "simulated", simulated)):
            for dash, which, (a, b) in (
                ("-", "first", (record.marks[0], record.marks[1])),
                (":", "last", (record.marks[-2], record.marks[-1])),
            ):
                part = slice(int(a), int(b) + 1)
                ax.plot(
                    record.stroke[part] * 1e3, force[part], dash, color=colour, lw=1.4, label=f"{name}, {which} oscillation"
                )
        held = ", held out" if split == "heldout" else ""
        style.title(ax, f"{record.oil_level:.0%} oil, {record.top_speed:.3g} m/s{held}")
        ax.title.set_fontsize(9)
    for ax in axes.flat[len(chosen) :]:
        ax.set_visible(False)
    style.label(axes, "stroke [mm]", "force [N]")
    style.legend_above(figure, axes[0, 0])
    return figure


def live_part(result: Result, chosen: Sequence[tuple[Harmonic, str]]) -> str:
    """The same records to look into, as the identified model has them."""
    damper, offset = as_published(result.identification.damper), result.identification.offset
    looks = []
    for record, split in chosen:
        first, last = int(record.marks[0]), int(record.marks[-1])
        span = slice(first, last + 1)
        where = "held out" if split == "heldout" else "fitted"
        looks.append(
            Look(
                f"{record.oil_level:.0%} oil, {record.top_speed:.3g} m/s, {where}", record.name,
                record.time[span], record.stroke[span], record.velocity[span],
                {"measured": record.force[span], "simulated": predicted(damper, record, offset)[span]},
                (record.marks - first).tolist(),
            )
        )  # fmt: skip
    return live([Curve("measured", "measured", style.INK), Curve("simulated", "identified model", style.RED)], looks)


def works(rows: Sequence[Validated]) -> Figure:
    """Work of the first and the last oscillation over the velocity, per oil level."""
    figure, axes = style.canvas(1, 2, (10.0, 4.2))
    levels = sorted({(row.oil_level, row.gas_preload) for row in rows}, reverse=True)
    sizes = distinct((row.amplitude for row in rows), EQUAL_AMPLITUDES)
    palette = [style.INK, style.ORANGE, style.RED, style.BLUE, style.GREEN, style.VIOLET]
    for i, (ax, text) in enumerate(zip(axes[0], ("first oscillation", "last oscillation"), strict=True)):
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
                label = f"measured, {'fitted' if fitted else 'held out'}, {name}" if some else None
                measured = [r.work_measured[i] for r in some]
                fill = colour if fitted else "white"
                ax.plot([r.top_speed for r in some], measured, "o", ms=5, color=colour, mfc=fill, label=label)
        style.title(ax, text)
        ax.set_ylim(bottom=min(0.0, ax.get_ylim()[0]))
    style.label(axes, "velocity [m/s]", "work [J]")
    style.legend_above(figure, axes[0, 0], columns=3)
    return figure


def curve(result: Result) -> Figure:
    """The identified F-v curve with the friction-reduced points of the intact records."""
    figure, axes = style.canvas(1, 1, (7.0, 4.0))
    ax = axes[0, 0]
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
    style.label(axes, "velocity [m/s], rebound positive", "fluid force [N]")
    ax.legend(loc="upper left")
    return figure


def intervals(result: Result) -> Figure:
    """Every parameter with its interval within its allowed range."""
    estimates = [e for e in result.identification.estimates if e.name in DEGRADATION]
    figure, axes = style.canvas(1, 1, (8.0, 0.3 * len(estimates) + 1.0))
    ax = axes[0, 0]
    for i, e in enumerate(estimates):
        low, width = e.bounds[0], e.bounds[1] - e.bounds[0]
        colour = style.BLUE if e.determined else style.FAINT
        ax.plot([(e.low - low) / width, (e.high - low) / width], [i, i], "-", lw=6, color=colour, solid_capstyle="butt")
        ax.plot((e.value - low) / width, i, "|", ms=12, mew=2, color=style.INK)
    ax.set_yticks(range(len(estimates)), [e.name for e in estimates])
    ax.set_xlim(-0.02, 1.02)
    ax.invert_yaxis()
    ax.set_xlabel("share of the allowed range; grey: not determined by these records")
    return figure


def convergence(result: Result) -> Figure:
    """Best error after every generation of each search."""
    steps = result.identification.steps
    figure, axes = style.canvas(1, len(steps), (3.6 * len(steps), 2.8))
    for ax, step in zip(axes[0], steps, strict=True):
        ax.plot(np.arange(1, len(step.best.trace) + 1), step.best.trace, color=style.BLUE)
        style.title(ax, step.title)
        ax.set_xlabel("generation")
        ax.set_ylabel(f"error [{step.unit}]")
    return figure


def drives(rows: Sequence[Validated]) -> Figure:
    """Work of the drives relative to the intact damper."""
    figure, axes = style.canvas(1, 1, (9.0, 0.32 * len(rows) + 1.2))
    ax = axes[0, 0]
    at = np.arange(len(rows))
    ax.barh(at - 0.2, [r.relative_measured or 0.0 for r in rows], 0.38, color=style.GREY, label="measured")
    ax.barh(at + 0.2, [r.relative_simulated or 0.0 for r in rows], 0.38, color=style.RED, label="simulated")
    ax.set_yticks(at, [style.plain(r.name) for r in rows], fontsize=8)
    ax.invert_yaxis()
    ax.set_xlabel("work relative to the intact damper")
    style.legend_above(figure, ax)
    return figure


def percent(part: dict[str, Any] | None, what: str) -> list[str]:
    """A row of the table of errors."""
    if part is None:
        return [what, "none", "", "", ""]

    def work(which: str) -> str:
        if f"work_error_{which}" not in part:
            return ""
        text = f"{part[f'work_error_{which}']:.1%} (worst {part[f'work_error_{which}_worst']:.1%})"
        of_intact = part[f"work_error_{which}_of_intact"]
        if of_intact is not None:
            text += f"; of the intact work {of_intact:.1%} (worst {part[f'work_error_{which}_of_intact_worst']:.1%})"
        return text

    force = (
        f"{part['force_rmse_N']:.1f} N, {part['force_rmse_of_peak']:.1%} of the peak "
        f"(worst {part['force_rmse_of_peak_worst']:.1%}, {part['worst']})"
    )
    if "force_rmse_recorded_N" in part:
        force += f"; {part['force_rmse_recorded_N']:.1f} N over the strokes with their noise"
    drives = f", {part['stochastic']} stochastic" if part["stochastic"] else ""
    return [what, f"{part['records']}{drives}", force, work("first"), work("last")]


def parameter_table(result: Result) -> Table:
    """All identified parameters with their intervals and doubts."""
    rows = []
    for e in result.identification.estimates:
        doubts = ([] if e.determined else ["not determined"]) + (["at its bound"] if e.at_bound else [])
        rows.append(
            [
                e.name,
                f"{e.value:.3g}",
                unit(e.name),
                f"{e.low:.3g} to {e.high:.3g}",
                f"{e.bounds[0]:g} to {e.bounds[1]:.3g}",
                ", ".join(doubts),
            ]
        )
    return Table(
        ["parameter", "value", "unit", "interval", "allowed", ""],
        rows,
        "Intervals hold with 95 % for all parameters together",
    )


def write_report(result: Result, folder: Path) -> list[Path]:
    """Write report.html and its pictures; returns the files."""
    identified = result.identification
    harmonics = [row for row in result.validation if row.measurement == "harmonic"]
    ordered = sorted(result.harmonics, key=lambda pair: (pair[1] != "heldout", pair[0].top_speed))
    judged = [pair for pair in ordered if not pair[0].intact] or ordered
    chosen = [judged[i] for i in sorted({round(x) for x in np.linspace(0, len(judged) - 1, min(LOOPS, len(judged)))})]
    errors = Table(
        ["records", "number", "force, root mean square", "work, first oscillation", "work, last oscillation"],
        [
            percent(totals(result.validation, kind), text)
            for kind, text in (("heldout", "held out"), ("fit", "fitted"))
        ],
        "Error of the identified model; works as median",
    )  # fmt: skip
    top = reach([h for h, split in result.harmonics if h.intact and split == "fit"])
    continued = f"Measured up to {top:.3g} m/s; the parameter file continues it by its last slope." if top else ""
    pictures = {"works": works(harmonics), "loops": loops(result, chosen), "fv_curve": curve(result)}
    sections = [
        Section("records-live", "Look into the records", live=live_part(result, chosen)),
        section("works", "Work per oscillation", pictures, "Filled: fitted, open: held out."),
        section("loops", "Force over stroke", pictures, "First and last oscillation of some records, those held out first."),
        section("fv_curve", "F-v curve", pictures, f"The first step of the identification. {continued}"),
    ]
    if identified.estimates:
        if identified.steps:
            pictures |= {"intervals": intervals(result), "convergence": convergence(result)}
        alike = [f"{a} and {b} act alike on these records (correlation {c:.2f})" for a, b, c in identified.pairs]
        sections.insert(0, Section(
            "parameters", "Parameters", text=alike, tables=[parameter_table(result)],
            pictures=[picture(pictures[name], name) for name in ("intervals",) if name in pictures],
        ))  # fmt: skip
    if identified.steps:
        steps = Table(
            ["step", "parameters", "error", "evaluations"],
            [
                [s.title, ", ".join(s.names), f"{s.best.error:.3g} {s.unit}", f"{s.best.evaluations}"]
                for s in identified.steps
            ],
        )
        sections.append(Section(
            "search", "Search", pictures=[picture(pictures["convergence"], "convergence")], tables=[steps],
        ))  # fmt: skip
    relative = [row for row in result.validation if row.relative_measured is not None]
    if relative:
        pictures["drives"] = drives(relative)
        sections.append(section("drives", "Drives", pictures, "Not used for fitting."))
    table = Table(
        ["record", "split", "oil", "speed", "force error", "peak", "work measured", "work simulated"],
        [[r.name, r.split, f"{r.oil_level:.0%}", f"{r.top_speed:.3g} m/s", f"{r.force_rmse:.1f} N", f"{r.force_peak:.0f} N",
          " / ".join(f"{w:.2f}" for w in r.work_measured) + " J", " / ".join(f"{w:.2f}" for w in r.work_simulated) + " J"]
         for r in result.validation],
        "Works of the first and the last oscillation, of drives in total",
    )  # fmt: skip
    sections.append(Section("records", "All records", tables=[table]))
    lead = [*judgement(result), f"Next: {next_step(result, folder.name)}.", *result.remarks]
    text = html(f"Identification: {result.dataset.title}", lead, sections, [errors])
    files = [folder / f"{name}.png" for name in pictures]
    for file, figure in zip(files, pictures.values(), strict=True):
        write_bytes(file, style.png(figure))
    write_text(folder / "report.html", text)
    return [*files, folder / "report.html"]


def picture(figure: Figure, alt: str) -> Picture:
    """A figure as picture of the page."""
    return Picture(style.png(figure), alt)


def section(name: str, title: str, pictures: dict[str, Figure], text: str) -> Section:
    """A section of a single picture."""
    return Section(name, title, text=[text], pictures=[picture(pictures[name], title)])
