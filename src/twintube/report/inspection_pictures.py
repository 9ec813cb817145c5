"""The pictures of `twintube inspect`."""

from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from twintube.dampers import Damper
from twintube.inspection import Condition, Detection, Entry, Method, Setting
from twintube.inspection.benches import DT, on_plate, plate_motion
from twintube.inspection.detection import FALSE_ALARMS
from twintube.inspection.figures import ABOVE_BODY, measured_cycles
from twintube.report import style
from twintube.vehicle.cars import CarSet

PALETTE = (style.INK, style.BLUE, style.GREEN, style.ORANGE, style.RED, style.VIOLET)
MOST_CURVES = 6
COLUMNS = 3
LEGEND = 7.4  # [inch] its width


def grid(methods: Sequence[Method], height: float = 2.9) -> tuple[Figure, list[tuple[Method, Axes]]]:
    """One panel per method."""
    columns = min(COLUMNS, len(methods))
    rows = -(-len(methods) // columns)
    figure, axes = style.canvas(rows, columns, (max(3.7 * columns, LEGEND), height * rows + 0.5))
    for ax in axes.flat[len(methods) :]:
        ax.set_visible(False)
    pairs = list(zip(methods, axes.flat, strict=False))
    for method, ax in pairs:
        style.title(ax, method.title)
    return figure, pairs


def figures_over_oil(of: Callable[[Damper, Method], list[Entry]], damper: Damper, methods: Sequence[Method]) -> Figure:
    """Each method's figure over the oil level: model and scalar factor, with the side of the limit that fails."""
    figure, pairs = grid(methods)
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
        ax.set_ylim(0.0, top)
        low, high = (0.0, method.limit) if method.low_fails else (method.limit, top)
        ax.axhspan(low, high, color=style.RED, alpha=0.08, lw=0)
        ax.axhline(method.limit, color=style.RED, lw=1)
        ax.invert_xaxis()
        ax.set_xlabel("oil [%]")
        ax.set_ylabel(f"{method.name}{f' [{method.unit}]' if method.unit else ''}")
    style.legend_above(figure, pairs[0][1])
    return figure


def spread(states: Sequence[Condition]) -> list[Condition]:
    """At most MOST_CURVES of the states, first and last among them."""
    picked = {round(x) for x in np.linspace(0, len(states) - 1, min(MOST_CURVES, len(states)))}
    return [states[i] for i in sorted(picked)]


def sweep(damper: Damper, vehicle: CarSet, states: Sequence[Condition]) -> Figure:
    """Force and phase over the frequency of the coast."""
    figure, ((size, phase),) = style.canvas(1, 2, (11.0, 4.4))
    corner, run = vehicle.corner(damper), plate_motion(Setting().plate, DT)
    for state, colour in zip(spread(states), PALETTE, strict=False):
        found = measured_cycles(run, on_plate(state.applied(damper), corner, run).wheel_load)
        label = f"{state.oil_level:.0%} oil, {'with' if state.gas_preload else 'no'} preload"
        size.plot(found.frequency, np.abs(found.answer) / corner.c_tyre, ".-", ms=3, lw=1, color=colour, label=label)
        phase.plot(found.frequency, found.phase, ".-", ms=3, lw=1, color=colour)
        phase.axvline(found.wheel_frequency, color=colour, lw=0.8, ls=":")
    phase.axvline(ABOVE_BODY, color=style.GREY, lw=1)
    phase.axhline(35.0, color=style.RED, lw=1)
    style.title(size, "plate force")
    style.title(phase, "lead of the force; dotted: wheel's resonance, red: limit")
    for ax, text in ((size, "force / (height x tyre stiffness)"), (phase, "phase [deg]")):
        ax.set_xlabel("frequency [Hz]")
        ax.set_ylabel(text)
    style.legend_above(figure, size)
    return figure


def spanned(several: Sequence[Detection]) -> tuple[float, float]:
    """The band of a share over the ways of the freed gas: the lowest and the highest end of theirs."""
    bands = [d.band for d in several]
    return min(low for low, _ in bands), max(high for _, high in bands)


def shares(found: Sequence[Detection], methods: Sequence[Method]) -> Figure:
    """Detected share over the oil level with its band, for model and scalar factor."""
    figure, pairs = grid(methods)
    for method, ax in pairs:
        for scalar, colour, label in ((False, style.INK, "model"), (True, style.BLUE, "oil level as scalar factor")):
            here: dict[float, list[Detection]] = {}
            for d in found:
                if d.method.name == method.name and d.condition.scalar == scalar:
                    here.setdefault(100 * d.condition.oil_level, []).append(d)
            ax.plot(list(here), [100 * several[0].share for several in here.values()], "o-", ms=4, color=colour, label=label)
            low, high = zip(*(spanned(several) for several in here.values()), strict=True) if here else ((), ())
            ax.fill_between(list(here), 100 * np.array(low), 100 * np.array(high), color=colour, alpha=0.15, lw=0)
        ax.axhline(100 * FALSE_ALARMS, color=style.GREY, lw=1, ls="--", label="false alarms")
        ax.set_ylim(-2, 102)
        ax.invert_xaxis()
        ax.set_xlabel("oil [%]")
        ax.set_ylabel("detected [%]")
    style.legend_above(figure, pairs[0][1])
    return figure


def roc_curves(found: Sequence[Detection], methods: Sequence[Method]) -> Figure:
    """Detected share over false alarms, for every limit."""
    figure, pairs = grid(methods)
    for method, ax in pairs:
        own = [d for d in found if d.method.name == method.name and not d.condition.scalar]
        here = [d for d in own if d.condition.freed_gas == own[0].condition.freed_gas]
        for state, colour in zip(spread([d.condition for d in here]), PALETTE, strict=False):
            item = next(d for d in here if d.condition == state)
            false_alarms, detected = item.roc
            ax.plot(100 * false_alarms, 100 * detected, color=colour, lw=1.4, label=f"{state.oil_level:.0%} oil")
        ax.axvline(100 * FALSE_ALARMS, color=style.GREY, lw=1, ls="--")
        ax.set_xlabel("false alarms [%]")
        ax.set_ylabel("detected [%]")
    style.legend_above(figure, pairs[0][1])
    return figure
