"""What the assumed values of a car do to its headlines, as tables and a picture."""

import math
from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from twintube.common.readable import unit_of
from twintube.common.words import counted
from twintube.inspection.tables import markdown
from twintube.report.car.figures import road_of
from twintube.report.common.framed import framed, oil
from twintube.report.common.html_page import Headline, Page, Picture, Section, Table
from twintube.report.common.style import BLUE, FAINT, INK, ORANGE, grid, title
from twintube.vehicle.full.catalogue import MANEUVERS
from twintube.vehicle.full.sensitivity import ASSUMED, DRIVES, SPEED, Assumed, Sensitivity, mean

SHORT = {"ride": "DLC", "braking": "stop", "cornering": "bend"}
SHARES = (5, 95)  # [%] of the draws between which the band lies
MOST_BARS = 6  # of each panel, in letters that can be read
CAPTION = "For each headline the assumed values that move it most, from their low to their high end."
READ = "Measure or look up the values with the longest bars before the headline is relied on."


def name_of(drive: tuple[str, str]) -> str:
    """A drive's headline in a few words."""
    return f"{SHORT[drive[0]]}, {road_of(drive[1]).removesuffix(' road')}"


def percent(value: float) -> str:
    """A growth."""
    return "not driven" if math.isnan(value) else f"{100 * value:+.0f}%"


def range_of(item: Assumed) -> str:
    """From where to where a value is varied."""
    if not item.adds:
        return f"times {item.low:g} to {item.high:g}"
    unit, factor = unit_of(item.unit, item.high) if item.unit else ("", 1.0)
    return f"{item.low * factor:+g} to {item.high * factor:+g}{' ' + unit if unit else ''}"


def error_of(values: Sequence[float]) -> float:
    """Standard error of the mean over the seeds; 0 of a single one."""
    return float(np.nanstd(values, ddof=1) / math.sqrt(len(values))) if len(values) > 1 else 0.0


def band_of(values: Iterable[float]) -> tuple[float, float]:
    """The band of the draws, of those that were driven."""
    low, high = np.nanpercentile(list(values), SHARES)
    return float(low), float(high)


def same_sign(result: Sensitivity, drive: tuple[str, str]) -> float:
    """Share of the draws whose growth has the sign of that of the car as it is."""
    sign = math.copysign(1.0, mean(result.nominal[drive]))
    driven = [x for x in result.draws[drive] if not math.isnan(x)]
    return sum(x * sign > 0 for x in driven) / len(driven)


def above_scalar(result: Sensitivity, drive: tuple[str, str]) -> float:
    """Share of the draws in which the model's change is larger than the scalar factor's."""
    sign = -1.0 if drive[0] == "cornering" else 1.0
    both = [(a, b) for a, b in zip(result.draws[drive], result.scalar[drive], strict=True) if not math.isnan(a + b)]
    return sum(sign * a > sign * b for a, b in both) / len(both)


def head_and_rows(result: Sensitivity) -> tuple[list[str], list[list[str]]]:
    """The table: how each headline grows, as the car is and with each value at both ends."""
    head = ["assumed", "varied", *map(name_of, DRIVES)]
    rows = [["as the car is", f"mean of {counted(result.seeds, 'seed')}, standard error"]]
    rows[0] += [f"{percent(mean(result.nominal[d]))} ± {100 * error_of(result.nominal[d]):.0f}" for d in DRIVES]
    for item in ASSUMED:
        ends = result.ends[item.title]
        rows.append([item.title, range_of(item), *(f"{percent(ends[d][0])} / {percent(ends[d][1])}" for d in DRIVES)])
    if result.draws[DRIVES[0]]:
        count, bands = len(result.draws[DRIVES[0]]), [band_of(result.draws[d]) for d in DRIVES]
        rows.append(["all at once", f"{count} draws, {SHARES[0]} to {SHARES[1]} %"])
        rows[-1] += [f"{percent(low)} to {percent(high)}" for low, high in bands]
        rows.append(["", "of the draws with the sign of the car as it is", *(f"{same_sign(result, d):.0%}" for d in DRIVES)])
        rows.append(
            ["", "of the draws with more change than a scalar factor", *(f"{above_scalar(result, d):.0%}" for d in DRIVES)]
        )
    return head, rows


def text(result: Sensitivity) -> str:
    """The table in Markdown."""
    return markdown(*head_and_rows(result))


def drawn(result: Sensitivity, narrow: bool = False) -> Figure:
    """For each headline the values that move it most, from end to end."""
    figure, axes = grid(len(DRIVES), (4.7, 2.9), narrow)
    for drive, ax in zip(DRIVES, axes.flat, strict=False):
        centre = 100 * mean(result.nominal[drive])
        reach = 100 * error_of(result.nominal[drive])
        ax.axvspan(centre - reach, centre + reach, color=FAINT, alpha=0.6, lw=0, label="standard error")
        ends = {
            name: [100 * x for x in by[drive]] for name, by in result.ends.items() if not any(map(math.isnan, by[drive]))
        }
        largest = sorted(ends, key=lambda name: max(abs(x - centre) for x in ends[name]))[-MOST_BARS:]
        for i, name in enumerate(largest):
            low, high = ends[name]
            ax.barh(i, low - centre, left=centre, height=0.38, align="edge", color=BLUE, label="low end")
            ax.barh(i, high - centre, left=centre, height=-0.38, align="edge", color=ORANGE, label="high end")
        names = list(largest)
        if result.draws[drive]:
            ends_of_all = [100 * x for x in band_of(result.draws[drive])]
            label = f"all at once, {SHARES[0]} to {SHARES[1]} %"
            ax.plot(ends_of_all, [-1.0, -1.0], color=INK, lw=4, solid_capstyle="butt", label=label)
            names.insert(0, "all at once")
        ax.set_yticks(range(len(largest) - len(names), len(largest)), names)
        ax.axvline(centre, color=INK, lw=0.8)
        ax.axvline(0.0, color=INK, lw=1.0, ls=":")
        ax.grid(visible=False, axis="y")
        title(ax, f"{MANEUVERS[drive[0]].headline[1]},\n{road_of(drive[1]).removesuffix(' road')} road")
        ax.set_xlabel("worn against intact [%]")
    told = (
        f"Change from intact to worn dampers, whole car at {SPEED:g} km/h, mean of {counted(result.seeds, 'seed')}. "
        f"Each assumed value at both ends of its range, alone; the {MOST_BARS} that move most. Dotted: no change. "
        "Grey: standard error over the seeds."
    )
    framed(figure, sure(result), told, "Assumed: all of these values, their ranges, F-v curves and friction.", axes.flat[0])
    return figure


def sure(result: Sensitivity) -> str:
    """Which changes keep their sign where all assumed values are drawn at once."""
    bands = {drive: band_of(result.draws[drive]) for drive in DRIVES if result.draws[drive]}
    if not bands:
        return f"What moves the effect of {oil(result.level)} most"
    held = [f"{name_of(d)} ({100 * low:+.0f} to {100 * high:+.0f} %)" for d, (low, high) in bands.items() if low * high > 0]
    which = f": {'; '.join(held)}" if held else ""
    return (
        f"With {oil(result.level)}, {len(held)} of {len(bands)} changes keep their sign with all values drawn at once{which}"
    )


def page(result: Sensitivity, conditions: Mapping[str, Any]) -> Page:
    """The page with its picture."""
    head, rows = head_and_rows(result)
    lead = [
        f"Worn dampers: {conditions['worn']}, {result.level:.0%} oil without gas preload, {SPEED:g} km/h, against the "
        f"intact car. One at a time: mean over {counted(result.seeds, 'seed')}, other roads and slip controls, the same at "
        "both ends; what moves less than the standard error says nothing. All at once: each draw has a road, a slip control "
        "and a way of the freed gas of its own."
    ]
    count = len(result.draws[DRIVES[0]])
    held = "; ".join(f"{name_of(d)}, in {same_sign(result, d):.0%}" for d in DRIVES) if count else "no draws"
    sentence = f"How many of {count} draws of all assumed values keep the sign of the change: {held}."
    reasons = [(f"{item.title}, {range_of(item)}", item.reason) for item in ASSUMED]
    picture = Picture.drawn(partial(drawn, result), CAPTION, "sensitivity")
    return Page(
        f"Whole car: what the assumed values do, {conditions['car']}",
        [Section("table", "All assumed values", tables=[Table(head, rows)]), Section("ranges", "Ranges", notes=reasons)],
        lead, headline=Headline(sentence, next=READ, picture=picture),
    )  # fmt: skip


def as_json(result: Sensitivity) -> dict[str, Any]:
    """All figures."""
    return {
        "oil_level": result.level, "seeds": result.seeds, "speed_kmh": SPEED,
        "assumed": [
            {"name": item.title, "tables": item.tables, "keys": item.names, "low": item.low, "high": item.high,
             "adds": item.adds, "unit": item.unit, "reason": item.reason}
            for item in ASSUMED
        ],
        "headlines": [
            {"maneuver": d[0], "road": d[1], "nominal": none(result.nominal[d]), "draws": none(result.draws[d]),
             "draws_scalar_factor": none(result.scalar[d]),
             "ends": {name: none(by[d]) for name, by in result.ends.items()}}
            for d in DRIVES
        ],
    }  # fmt: skip


def none(values: Iterable[float]) -> list[float | None]:
    """For JSON, which has no NaN."""
    return [None if math.isnan(x) else x for x in values]
