"""The pictures of `twintube inspect`."""

import textwrap
from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from twintube.common.grouping import grouped
from twintube.dampers import Damper
from twintube.dampers.damper import gas_in_words
from twintube.inspection import Condition, Detection, Entry, Method, Setting
from twintube.inspection.benches import DT, on_plate, plate_motion
from twintube.inspection.detection import FALSE_ALARMS
from twintube.inspection.figures import ABOVE_BODY, measured_cycles
from twintube.report.common import style
from twintube.vehicle.cars import CarSet

Of = Callable[[Damper, Method], list[Entry]]  # the entries of a damper and a method, highest oil level first
PALETTE = (style.INK, style.BLUE, style.GREEN, style.ORANGE, style.RED, style.VIOLET)
MOST_CURVES = 6
FIELDS = {  # verdict -> what it is called, colour
    True: ("passes", "#cfe6d4"),
    False: ("fails", "#f0b9b4"),
    None: ("not judged", "#e3e6e8"),
    "differs": ("depends on what freed gas does", "#f6e3bd"),
}
LEGEND = 7.4  # [inch] its width


def grid(methods: Sequence[Method], narrow: bool) -> tuple[Figure, list[tuple[Method, Axes]]]:
    """One panel per method."""
    figure, axes = style.grid(len(methods), (3.7, 2.9), narrow, least=LEGEND)
    pairs = list(zip(methods, axes.flat, strict=False))
    for method, ax in pairs:
        style.title(ax, method.title)
    return figure, pairs


def verdicts(of: Of, dampers: Sequence[Damper], methods: Sequence[Method], narrow: bool = False) -> Figure:
    """Every figure in a field of its oil level, in the colour of its verdict; a panel for each damper."""
    figure, axes = style.grid(len(dampers), (9.0, 0.5 * len(methods) + 0.8), narrow, most=1)
    for ax, damper in zip(axes.flat, dampers, strict=False):
        states = [entry.condition for entry in of(damper, methods[0])]
        for row, method in enumerate(methods):
            for column, entry in enumerate(of(damper, method)):
                answers = {entry.passes_under(name) for name in entry.readings}
                text, colour = FIELDS[answers.pop() if len(answers) == 1 else "differs"]
                ax.add_patch(Rectangle((column - 0.5, row - 0.5), 1, 1, color=colour, ec="white", lw=2))
                value = f"{entry.figure:.0f}" if method.unit else f"{entry.figure:.2f}"
                ax.text(column, row, value, ha="center", va="center", fontsize=8 if narrow else 10)
                ax.fill([], [], color=colour, label=text)
        names = ["\n".join([*textwrap.wrap(m.title, 18), m.rule]) for m in methods]
        ax.set_yticks(range(len(methods)), names, fontsize=7.5)
        ax.set_xticks(range(len(states)), [f"{100 * state.oil_level:.0f}" for state in states])
        ax.grid(visible=False)
        ax.tick_params(length=0)
        ax.set(xlabel="oil level [% of the intact volume]", xlim=(-0.5, len(states) - 0.5), ylim=(len(methods) - 0.5, -0.5))
        if len(dampers) > 1:
            style.title(ax, damper.name)
    style.legend_above(figure, *axes.flat)
    return figure


def figures_over_oil(of: Of, damper: Damper, methods: Sequence[Method], narrow: bool = False) -> Figure:
    """Each method's figure over the oil level: model and scalar factor, with the side of the limit that fails."""
    figure, pairs = grid(methods, narrow)
    for method, ax in pairs:
        entries = of(damper, method)
        oil = [100 * entry.condition.oil_level for entry in entries]
        values = [entry.figure for entry in entries]
        scalar = [np.nan if entry.scalar_figure is None else entry.scalar_figure for entry in entries]
        lowest, highest = ([end(entry.readings.values()) for entry in entries] for end in (min, max))
        ax.fill_between(oil, lowest, highest, color=style.INK, alpha=0.15, lw=0, label="over the ways of the freed gas")
        ax.plot(oil, values, "o-", ms=4, color=style.INK, label="model")
        ax.plot(oil, scalar, "s:", ms=5, mfc="white", color=style.BLUE, label="oil level as scalar factor")
        top = 1.1 * max(method.limit, *highest, *(x for x in scalar if np.isfinite(x)))
        ax.axhspan(*((0.0, method.limit) if method.low_fails else (method.limit, top)), color=style.RED, alpha=0.08, lw=0)
        ax.axhline(method.limit, color=style.RED, lw=1)
        ax.invert_xaxis()
        ax.set(xlabel="oil level [%]", ylabel=f"{method.name.replace('_', ' ')} [{method.unit or 1}]", ylim=(0.0, top))
    style.legend_above(figure, pairs[0][1])
    return figure


def sweep(damper: Damper, vehicle: CarSet, states: Sequence[Condition], narrow: bool = False) -> Figure:
    """Force and phase over the frequency of the coast."""
    figure, axes = style.grid(2, (5.5, 3.9), narrow)
    size, phase = axes.flat
    corner, run = vehicle.corner(damper), plate_motion(Setting().plate, DT)
    for i, (state, colour) in enumerate(zip(style.spread(states, MOST_CURVES), PALETTE, strict=False)):
        lw = 0.8 + 0.8 * (MOST_CURVES - 1 - i)  # curves that lie on each other are all seen
        found = measured_cycles(run, on_plate(state.applied(damper), corner, run).wheel_load)
        label = f"{state.oil_level:.0%} oil, preload {gas_in_words(state.gas_preload)}"
        size.plot(found.frequency, np.abs(found.answer) / corner.c_tyre, lw=lw, color=colour, label=label)
        phase.plot(found.frequency, found.phase, lw=lw, color=colour)
        phase.axvline(found.wheel_frequency, color=colour, lw=0.8, ls=":")
    phase.axvline(ABOVE_BODY, color=style.GREY, lw=1)
    phase.axhline(35.0, color=style.RED, lw=1)
    for ax, text, ylabel in (
        (size, "Force of the plate", "force / (height × tyre stiffness) [1]"),
        (phase, "Lead of the force", "phase [deg]"),
    ):
        style.title(ax, text)
        ax.set(xlabel="frequency [Hz]", ylabel=ylabel)
    style.legend_above(figure, size)
    return figure


def spanned(several: Sequence[Detection]) -> tuple[float, float]:
    """The band of a share over the ways of the freed gas: the lowest and the highest end of theirs."""
    bands = [d.band for d in several]
    return min(low for low, _ in bands), max(high for _, high in bands)


def shares(found: Sequence[Detection], methods: Sequence[Method], narrow: bool = False) -> Figure:
    """Detected share over the oil level with its band, for model and scalar factor."""
    figure, pairs = grid(methods, narrow)
    for method, ax in pairs:
        for scalar, colour, label in ((False, style.INK, "model"), (True, style.BLUE, "oil level as scalar factor")):
            own = [d for d in found if d.method.name == method.name and d.condition.scalar == scalar]
            here = grouped((100 * d.condition.oil_level, d) for d in own)
            ax.plot(list(here), [100 * several[0].share for several in here.values()], "o-", ms=4, color=colour, label=label)
            low, high = zip(*(spanned(several) for several in here.values()), strict=True) if here else ((), ())
            ax.fill_between(list(here), 100 * np.array(low), 100 * np.array(high), color=colour, alpha=0.15, lw=0)
        ax.axhline(100 * FALSE_ALARMS, color=style.GREY, lw=1, ls="--", label="false alarms")
        ax.invert_xaxis()
        ax.set(xlabel="oil level [%]", ylabel="detected [%]", ylim=(-2, 102))
    style.legend_above(figure, pairs[0][1])
    return figure


def roc_curves(found: Sequence[Detection], methods: Sequence[Method], narrow: bool = False) -> Figure:
    """Detected share over false alarms, for every limit."""
    figure, pairs = grid(methods, narrow)
    for method, ax in pairs:
        own = [d for d in found if d.method.name == method.name and not d.condition.scalar]
        here = [d for d in own if d.condition.freed_gas == own[0].condition.freed_gas]
        for state, colour in zip(style.spread([d.condition for d in here], MOST_CURVES), PALETTE, strict=False):
            false_alarms, detected = next(d for d in here if d.condition == state).roc
            ax.plot(100 * false_alarms, 100 * detected, color=colour, lw=1.4, label=f"{state.oil_level:.0%} oil")
        ax.axvline(100 * FALSE_ALARMS, color=style.GREY, lw=1, ls="--")
        ax.set(xlabel="false alarms [%]", ylabel="detected [%]")
    style.legend_above(figure, pairs[0][1])
    return figure
