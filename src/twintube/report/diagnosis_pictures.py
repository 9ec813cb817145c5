"""The pictures of a diagnosis. A residual is the measured less the simulated force."""

import itertools
import textwrap
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from twintube.arrays import Array
from twintube.diagnosis.result import Diagnosis, Map, RecordResult, Tried
from twintube.diagnosis.rules import RULES
from twintube.readable import unit_of
from twintube.report import style
from twintube.report.diagnosis_loop import answer_loop
from twintube.report.diagnosis_records import (
    KINDS,
    Model,
    broken,
    compared,
    drawn,
    format_of,
    middle,
    models,
    name_of,
    oscillations,
    parts,
    ranked,
    rests,
    shown,
    work,
)
from twintube.report.engineering import title_of

PICTURES = ("answer", "loops", "work", "maps", "residual", "errors", "ranking")  # that a page may have, as files
NARROW = "answer_narrow"  # the first of them for small screens, on the page alone
MOST = 30  # records per split in the chart of errors
FLOOR, CEILING = -0.5, 1.05  # of the explainable error: what the chart of gains shows
BASE_MARK = "--o"
FEW = 4  # bins of a map
SEPARATE = ("oil level", "frequency")  # quantities whose values are states of their own: no line joins them
DENSE = 300  # points of a curve that would hide one another
LEAST = 6.5  # width of a picture [inch] that has room for its legend
NAME = 32  # letters of a record's name
DECISIONS = {"chosen": style.RED, "rejected": style.GREY}


def small_title(ax: Axes, text: str) -> None:
    """A panel's title in small type."""
    ax.set_title(text, loc="left", fontsize=9)


def hidden(axes: Any, used: int, text: str = "") -> None:
    """Hide the panels that are left over; the lowest that is seen in each column bears the label `text`."""
    for i, ax in enumerate(axes.flat):
        ax.set_visible(i < used)
    for column in axes.T:
        lowest = [ax for ax in column if ax.get_visible()][-1:]
        for ax in lowest if text else []:
            ax.set_xlabel(text)


def loops(d: Diagnosis) -> Figure:
    """Force over stroke and over velocity of the shown records, a row each."""
    chosen = shown(d)
    columns = 2 * max(len(parts(r.record)) for r in chosen)
    figure, axes = style.canvas(len(chosen), columns, (11.0, 2.15 * len(chosen) + 0.7), sharey="row")
    for row, result in zip(axes, chosen, strict=True):
        record = result.record
        some = list(itertools.product(((record.stroke, 1e3), (record.velocity, 1.0)), parts(record)))
        for ax, ((signal, factor), (which, ends)) in zip(row, some, strict=False):
            at = middle(signal, ends) * factor
            thin = 1.0 if len(ends) < DENSE else 0.4
            measured = broken(result, result.measured, ends)
            ax.plot(at, measured, "o", color=style.INK, ms=2.5 * thin, mew=0, zorder=3, label="measured")
            for model in drawn(result, compared(d)):
                force = broken(result, model.force(result), ends)
                dots = 7.0 * thin
                ax.plot(at, force, format_of(model, record), color=model.colour, lw=1.2 * thin, ms=dots, label=model.label)
            small_title(ax, which)
            ax.set_xlabel("stroke [mm]" if signal is record.stroke else "velocity [m/s]", fontsize=8)
        for ax in row[len(some) :]:
            ax.set_visible(False)
        held = KINDS[result.split]
        row[0].set_ylabel("\n".join([*textwrap.wrap(name_of(result), 22), held, "force [N]"]), fontsize=8.5)
    style.legend_above(figure, *axes[:, 0])
    return figure


def works(d: Diagnosis) -> Figure | None:
    """Work over the number of the oscillation; nothing where no record has three of them."""
    chosen = [r for r in shown(d) if len(oscillations(r.record)) >= 3]
    if not chosen:
        return None
    columns = min(3, len(chosen))
    rows = -(-len(chosen) // columns)
    figure, axes = style.canvas(rows, columns, (max(LEAST, 3.7 * columns), 2.5 * rows + 0.5))
    for ax, result in zip(axes.flat, chosen, strict=False):
        measured = work(result.record, result.measured)
        number = np.arange(1, len(measured) + 1)
        ax.plot(number, measured, "o", color=style.GREY, ms=5, label="measured")
        for model in drawn(result, compared(d)):
            ax.plot(
                number, work(result.record, model.force(result)), model.dash, color=model.colour, lw=1.5, label=model.label
            )
        for i, rest in enumerate(rests(result.record)):
            ax.axvline(rest + 0.5, color=style.INK, lw=0.7, ls=":", label="rest" if i == 0 else None)
        low, high = ax.get_ylim()
        spread = 0.08 * float(np.abs(measured).mean())
        ax.set_ylim(min(low, measured.mean() - spread), max(high, measured.mean() + spread))
        ax.xaxis.set_major_locator(MaxNLocator(integer=True))
        small_title(ax, f"{name_of(result)}{', held out' if result.split == 'heldout' else ''}")
    style.label(axes, "", "work [J]")
    hidden(axes, len(chosen), "oscillation")
    style.legend_above(figure, *axes.flat)
    return figure


def maps(d: Diagnosis) -> Figure:
    """Root mean square and sign of the residual over every quantity of the maps."""
    several = [m for m in d.maps if np.isfinite(m.base).any()]
    columns = min(3, len(several))
    rows = -(-len(several) // columns)
    figure, axes = style.canvas(rows, columns, (max(LEAST, 3.7 * columns), 2.6 * rows + 0.6))
    best = compared(d)[1:]
    for ax, m in zip(axes.flat, several, strict=False):
        draw_map(ax, m, best)
    hidden(axes, len(several))
    for ax in axes[:, 0]:
        ax.set_ylabel("residual [N]")
    style.legend_above(figure, axes[0, 0])
    return figure


def draw_map(ax: Axes, m: Map, best: list[Model]) -> None:
    """A panel of the maps; few bins, and those of states such as oil levels, stand side by side."""
    separate = m.quantity in SEPARATE and len(m.centres) <= RULES.bins
    if separate:  # without the empty bins
        kept = np.isfinite(m.base)
        m = replace(m, **{f: getattr(m, f)[kept] for f in ("centres", "base", "extended", "noise", "mean")})
    name, factor = unit_of(m.unit, float(np.abs(m.centres).max()))
    at = m.centres * factor
    if len(at) <= FEW or separate:
        many = len(at) > FEW
        ax.set_xticks(range(len(at)), [f"{x:.3g}" for x in at], rotation=60 if many else 0, fontsize=7 if many else None)
        at = np.arange(len(at), dtype=float)
        ax.set_xlim(-0.7, len(at) - 0.3)
    between = (at[1:] + at[:-1]) / 2
    half = (at[1] - at[0]) / 2 if len(at) > 1 else 0.5
    edges = np.concatenate([[at[0] - half], between, [2 * at[-1] - between[-1] if len(at) > 1 else at[0] + half]])
    pairs = np.repeat(edges, 2)[1:-1]
    ax.fill_between(pairs, 0.0, np.repeat(m.noise, 2), color=style.FAINT, alpha=0.6, lw=0, label="noise floor")
    ax.bar(edges[:-1], np.nan_to_num(m.mean), 0.94 * np.diff(edges), align="edge", color=style.BLUE, alpha=0.28, lw=0,
           label="base model, mean with its sign")  # fmt: skip
    base, line = (BASE_MARK, "-s") if not separate else ("o", "s")
    ax.plot(at, m.base, base, color=style.BLUE, lw=1.3, ms=4, label="base model, root mean square")
    for model in best:
        if not np.allclose(m.extended, m.base, rtol=1e-6, equal_nan=True):
            ax.plot(at, m.extended, line, color=model.colour, lw=1.3, ms=3.5, label=f"{model.label}, root mean square")
    ax.axhline(0.0, color=style.INK, lw=0.7)
    ax.set_xlabel(f"{m.quantity} [{name}]" if name else m.quantity)


def residual(d: Diagnosis) -> Figure:
    """Residual over time of the record of the largest base error: all of it, and two oscillations near its ends."""
    result = shown_record(d)
    record = result.record
    block = oscillations(record)
    zoomed = len(block) >= 5
    figure, axes = style.canvas(2 if zoomed else 1, 2, (11.0, 5.0 if zoomed else 2.9), sharey=True)
    whole = axes[0, 0]
    whole.set_subplotspec(whole.get_gridspec()[0, :])
    axes[0, 1].remove()
    rest = np.flatnonzero(np.diff(record.stretch) != 0) + 1
    named = f"{name_of(result)}{', held out' if result.split == 'heldout' else ''}"
    windows = [(whole, np.arange(1, len(record.time)), f"{named}: whole record")]
    if zoomed:
        windows.append((axes[1, 0], np.concatenate(block[:2]), "oscillations 1 and 2"))
        windows.append((axes[1, 1], np.concatenate(block[-2:]), f"oscillations {len(block) - 1} and {len(block)}"))
    for ax, ends, text in windows:
        ax.fill_between(
            record.time[ends], -2 * record.noise[ends], 2 * record.noise[ends], color=style.FAINT, alpha=0.6, lw=0,
            label="noise, ± 2 standard deviations",
        )  # fmt: skip
        for model in drawn(result, compared(d)):
            values = result.measured - model.force(result)
            values[rest] = np.nan
            dash = "-" if ax is whole else model.dash
            lw = 0.6 if ax is whole and zoomed else 1.2
            ax.plot(record.time[ends], values[ends], dash, color=model.colour, lw=lw, label=model.label)
        ax.set_xlim(float(record.time[ends[0]]), float(record.time[ends[-1]]))
        ax.set_xlabel("time [s]")
        small_title(ax, text)
    for ax in (whole, *([axes[1, 0]] if zoomed else [])):
        ax.set_ylabel("measured less\nsimulated [N]")
    style.legend_above(figure, windows[-1][0])
    return figure


def errors(d: Diagnosis) -> Figure:
    """Error of every record, base to best; the worst where there are many."""
    ordered = ranked(d)
    kept = [
        r
        for split in ("heldout", "fit")
        for r in [r for r in ordered if (r.split == "heldout") == (split == "heldout")][:MOST]
    ]
    figure, axes = style.canvas(1, 1, (9.5, 0.24 * len(kept) + 1.3))
    ax = axes[0, 0]
    held = sum(r.split == "heldout" for r in kept)
    if held:
        ax.axhspan(-0.5, held - 0.5, color="#f6efdd", lw=0, zorder=0, label="held out")
    rows = np.arange(len(kept))
    values = {m: np.array([r.rms(m.force(r)) for r in kept]) for m in models(d)}
    floor = np.array([r.noise for r in kept])
    everything = np.concatenate([floor, *values.values()])
    ax.hlines(
        rows, np.minimum.reduce(list(values.values())), np.maximum.reduce(list(values.values())), color=style.FAINT, lw=2
    )
    ax.plot(floor, rows, "|", color=style.INK, ms=9, mew=1.4, label="noise floor")
    for (model, x), marker in zip(values.items(), "oDs", strict=False):
        ax.plot(x, rows, marker, color=model.colour, ms=5.5 if marker == "o" else 4.5, label=model.label)
    if everything.min() > 0 and everything.max() > 20 * everything.min():
        ax.set_xscale("log")
        ax.xaxis.set_major_formatter("{x:g}")
    else:
        ax.set_xlim(left=0.0)
    ax.set_yticks(
        rows,
        [f"{style.plain(short(r.record.name))}  ({name_of(r)})" for r in kept],
        fontsize=8,
    )
    ax.set_ylim(len(kept) - 0.5, -0.5)
    ax.set_xlabel("root mean square error of the force [N]")
    style.legend_above(figure, ax)
    return figure


def short(name: str) -> str:
    """A name that leaves room for the chart."""
    return name if len(name) <= NAME else name[: NAME - 1] + "…"


def ranking(d: Diagnosis) -> Figure:
    """Gains of all candidates with intervals, one panel per round; every candidate has its own row."""
    ordered = sorted(d.tried, key=lambda t: (t.round, -t.heldout_gain))
    rounds = [list(rows) for _, rows in itertools.groupby(ordered, key=lambda t: t.round)]
    rows = list(dict.fromkeys(t.effect for t in ordered))
    size = (min(11.0, 3.6 + 3.7 * len(rounds)), 0.25 * len(rows) + 1.6)
    figure, axes = style.canvas(1, len(rounds), size, sharey=True)
    least = min(min(t.interval[0], t.heldout_gain) for t in d.tried)
    left = max(FLOOR, min(-0.05, 1.1 * least if np.isfinite(least) else FLOOR))
    before: list[str] = []
    for ax, tried in zip(axes[0], rounds, strict=True):
        draw_ranking(ax, tried, rows, left)
        title = f"Round {tried[0].round}" + (f", with {' and '.join(before)}" if before else "")
        small_title(ax, "\n".join(textwrap.wrap(title, 36)))
        before += [title_of(t.effect).lower() for t in tried if t.decision == "chosen"]
        ax.set_xlabel("gain [%]")
    axes[0, 0].set_yticks(range(len(rows)), [title_of(name) for name in rows], fontsize=8.5)
    axes[0, 0].set_ylim(len(rows) - 0.4, -0.6)
    style.legend_above(figure, *axes.flat)
    return figure


def draw_ranking(ax: Axes, tried: list[Tried], rows: list[str], left: float) -> None:
    """A round."""
    ax.axvline(0.0, color=style.INK, lw=0.8)
    for decision, colour in DECISIONS.items():
        some = [t for t in tried if t.decision == decision]
        if not some:
            continue
        at = np.array([rows.index(t.effect) for t in some])
        gain, low, high = (clipped(np.array(x), left) for x in zip(
            *((t.heldout_gain, *t.interval) for t in some), strict=True))  # fmt: skip
        ax.hlines(at, low * 100, high * 100, color=colour, lw=2)
        seen = np.array([t.heldout_gain for t in some]) >= left
        ax.plot(gain[seen] * 100, at[seen], "o", color=colour, ms=6, label=decision)
        if not seen.all():  # an empty line that is not clipped would upset the layout
            ax.plot(gain[~seen] * 100, at[~seen], "<", color=colour, ms=6, clip_on=False)
    ax.set_xlim(left * 100, CEILING * 100)


def clipped(x: Array, left: float) -> Array:
    """Gains within what the chart shows."""
    return np.clip(np.nan_to_num(x, nan=left, neginf=left, posinf=CEILING), left, CEILING)


def pictures(d: Diagnosis) -> dict[str, Figure]:
    """All pictures that this diagnosis has something to show in, by name, in the order of the page."""
    figures: dict[str, Figure | None] = {}
    if d.records:
        figures |= {"answer": answer_loop(d), NARROW: answer_loop(d, narrow=True), "loops": loops(d), "work": works(d)}
    if any(np.isfinite(m.base).any() for m in d.maps):
        figures["maps"] = maps(d)
    if d.records:
        figures |= {"residual": residual(d), "errors": errors(d)}
    if d.tried:
        figures["ranking"] = ranking(d)
    return {name: figure for name, figure in figures.items() if figure is not None}


def shown_record(d: Diagnosis) -> RecordResult:
    """The record whose residual is drawn over time."""
    return shown(d)[0]
