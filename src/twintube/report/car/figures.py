"""The figures of the drives as pictures and tables: intact and worn, with the range over seeds and ways of the freed gas."""

import textwrap
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from twintube.common.grouping import grouped
from twintube.dampers.freed_gas import DEFAULT, SCALAR
from twintube.report.common.html_page import Table
from twintube.report.common.style import BLUE, GREEN, GREY, INK, ORANGE, RED, VIOLET, grid, legend_above, title
from twintube.vehicle.full.car import WHEELS
from twintube.vehicle.full.catalogue import MANEUVERS

Row = Mapping[str, Any]
# Figures of a drive: name, title, unit, decimals; those of the wheels have a line for each wheel.
FIGURES = (
    ("stopping_distance_m", "stopping distance", "m", 1),
    ("stopping_time_s", "stopping time", "s", 2),
    ("deceleration_m_s2", "mean deceleration", "m/s2", 2),
    ("lateral_acceleration_max_m_s2", "largest lateral acceleration", "m/s2", 2),
    ("understeer_deg_per_g", "understeer gradient", "deg/g", 2),
    ("roll_deg_per_g", "roll gradient", "deg/g", 2),
    ("side_slip_deg_per_g", "side slip gradient", "deg/g", 2),
    ("entry_speed_max_kmh", "highest entry speed passed", "km/h", 0),
    ("exit_speed_kmh", "speed after the lanes", "km/h", 1),
    ("out_of_lane_m", "out of the lanes, below 0 the room left", "m", 2),
    ("steer_rate_rms_deg_s", "steer rate, rms", "deg/s", 1),
    ("steer_max_deg", "largest steer angle", "deg", 1),
    ("yaw_rate_gain_1_s", "yaw rate gain", "1/s", 2),
    ("steady_lateral_acceleration_m_s2", "steady lateral acceleration", "m/s2", 2),
    ("yaw_rate_t90_s", "response time of the yaw rate, to 90 %", "s", 3),
    ("lateral_acceleration_t90_s", "response time of the lateral acceleration, to 90 %", "s", 3),
    ("roll_t90_s", "response time of the roll angle, to 90 %", "s", 3),
    ("yaw_rate_peak_time_s", "time to the peak of the yaw rate", "s", 2),
    ("yaw_rate_peak_ratio", "peak of the yaw rate over steady", "1", 3),
    ("lateral_acceleration_peak_ratio", "peak of the lateral acceleration over steady", "1", 3),
    ("roll_peak_ratio", "peak of the roll angle over steady", "1", 3),
    ("amplitude_passed_A", "largest steering passed", "A", 1),
    ("yaw_ratio_1_s", "yaw rate 1 s after the steering over its peak", "1", 3),
    ("yaw_ratio_1.75_s", "yaw rate 1.75 s after the steering over its peak", "1", 3),
    ("displacement_1.07_s_m", "displacement 1.07 s after the steering begins", "m", 2),
    ("yaw_ratio_braked", "yaw rate 1 s after the brakes over that of the circle", "1", 3),
    ("yaw_rate_max_deg_s", "largest yaw rate", "deg/s", 2),
    ("heading_deg", "largest heading, with its sign", "deg", 2),
    ("side_offset_m", "largest side offset, to the left", "m", 3),
    ("side_slip_max_deg", "largest side slip angle", "deg", 2),
    ("side_slip_change_deg", "largest change of the side slip angle", "deg", 2),
    ("off_circle_m", "furthest off the circle, outside positive", "m", 2),
    ("dlc", "DLC", "1", 3),
    ("min_load_share", "smallest wheel load over that at rest", "1", 2),
    ("contact_loss_share", "share of the time without contact", "1", 4),
    ("comfort_m_s2", "vertical acceleration, ISO 2631 W_k", "m/s2", 2),
    ("roll_rms_deg", "roll angle, rms", "deg", 2),
    ("roll_max_deg", "largest roll angle", "deg", 2),
    ("pitch_rms_deg", "pitch angle, rms", "deg", 2),
    ("pitch_max_deg", "largest pitch angle, nose down", "deg", 2),
    ("damping_work_J", "work of the damper", "J", 0),
)
COLOURS = {"smooth": GREY, "A": VIOLET, "B": GREEN, "C": BLUE, "D": RED, "E": ORANGE}
TITLES = {name: each.title for name, each in MANEUVERS.items()}


def tables(entries: Sequence[Mapping[str, Any]]) -> list[Table]:
    """One table for each drive: a line per figure, a column per oil level and model."""
    drives = grouped(((row["maneuver"], row["speed_kmh"], row["road"]), row) for row in entries)
    return [table(*drive, rows) for drive, rows in drives.items()]


def table(maneuver: str, speed: float, road: str, rows: Sequence[Row]) -> Table:
    """The figures of one drive; each cell is the mean over the seeds, with the range over seeds and ways."""
    states = grouped((state_of(row), row) for row in rows)
    cells = []
    for name, words, unit, decimals in FIGURES:
        for wheel in WHEELS if any(isinstance(row.get(name), Mapping) for row in rows) else (None,):
            line = [cell(several, name, wheel, decimals) for several in states.values()]
            if any(line):
                place = f", {wheel.replace('_', ' ')}" if wheel else ""
                cells.append([f"{words}{place}{f' [{unit}]' if unit != '1' else ''}", *line])
    seeds = len({row["seed"] for row in rows})
    where = road if maneuver == "table3" else f"{speed:.0f} km/h, {road_of(road)}"
    over = f"range over {seeds} seeds" if seeds > 1 else "1 seed; range over"
    caption = f"{where}: mean ({over}{' and' if seeds > 1 else ''} the ways of the freed gas)"
    return Table(["figure", *states], cells, caption, numeric=range(1, len(states) + 1))


def state_of(row: Mapping[str, Any]) -> str:
    """The column of a drive."""
    if row["oil_level"] == 1.0:
        return "intact"
    return f"{row['oil_level']:.0%}{', scalar' if row['model'] == SCALAR else ''}"


def cell(rows: Sequence[Mapping[str, Any]], name: str, wheel: str | None, decimals: int) -> str:
    """Mean over the seeds, of the full model with the default way of the freed gas, and the range over all rows."""

    def value(row: Mapping[str, Any]) -> float | None:
        found = row.get(name)
        return found[wheel] if wheel is not None and found is not None else found

    values = [x for x in map(value, rows) if x is not None]
    usual = [x for x in map(value, (row for row in rows if row["model"] in (DEFAULT, SCALAR))) if x is not None]
    if not usual:
        return "not driven" if values == [] and any("failed" in row for row in rows) else ""
    low, mean, high = (f"{x:.{decimals}f}" for x in (min(values), sum(usual) / len(usual), max(values)))
    return f"{mean} ({low} to {high})"


def road_of(road: str) -> str:
    """A road in words; the drives of Table 3 have one of their own name."""
    return {"smooth": "smooth road"}.get(road, f"class {road}" if road in COLOURS else road)


def answer(firsts: Sequence[Mapping[str, Any]], rows: Sequence[Mapping[str, Any]], narrow: bool = False) -> Figure:
    """A bar for each row of `firsts`, with its band and what a scalar factor says of the same drive."""
    same = ("maneuver", "speed_kmh", "road", "oil_level")
    figure, ((ax,),) = grid(1, (9.0, 0.5 * len(firsts) + 0.8), narrow)
    names = []
    for at, row in enumerate(firsts):
        low, high = (100 * x for x in row["change_band"])
        ax.barh(at, 100 * row["change"], 0.5, color=BLUE, label="change, worn against intact")
        ax.plot([low, high], [at, at], "|-", color=INK, lw=1.5, ms=9, label="band")
        for other in rows:
            if other["model"] == SCALAR and other["change"] is not None and all(other[k] == row[k] for k in same):
                ax.plot(100 * other["change"], at, "s", color=RED, mfc="white", ms=7, label="by a scalar factor")
        drive = f"{TITLES[row['maneuver']]}, {row['speed_kmh']:.0f} km/h, {road_of(row['road'])}, {row['oil_level']:.0%} oil"
        names.append("\n".join([row["figure"], *textwrap.wrap(drive, 28 if narrow else 60)]))
    ax.set_yticks(range(len(firsts)), names, fontsize=7.5 if narrow else 9)
    ax.set_ylim(len(firsts) - 0.5, -0.5)
    ax.axvline(0.0, color=INK, lw=0.8)
    ax.set_xlabel("worn against intact [%]")
    legend_above(figure, ax)
    return figure


def drives(rows: Sequence[Mapping[str, Any]]) -> list[tuple[str, float]]:
    """Manoeuvre and speed of what is drawn; the drives of Table 3, each on a road of its own, are in the tables only."""
    return list(dict.fromkeys((row["maneuver"], row["speed_kmh"]) for row in rows if row["maneuver"] != "table3"))


def over_levels(rows: Sequence[Mapping[str, Any]], narrow: bool = False) -> Figure:
    """Change of the headline figures over the oil level, by manoeuvre and speed; bars span the seeds."""
    shown = drives(rows)
    figure, axes = grid(len(shown), (3.7, 3.0), narrow)
    for ax, (maneuver, speed) in zip(axes.flat, shown, strict=False):
        own = [row for row in rows if (row["maneuver"], row["speed_kmh"]) == (maneuver, speed) and row["change"] is not None]
        for road in dict.fromkeys(row["road"] for row in own):
            for model in dict.fromkeys(row["model"] for row in own):
                some = sorted((r for r in own if (r["road"], r["model"]) == (road, model)), key=lambda r: r["oil_level"])
                levels = [100 * r["oil_level"] for r in some]
                means = np.array([100 * r["change"] for r in some])
                bands = 100 * np.array([r["change_band"] for r in some]).T
                line: dict[str, Any] = {"color": COLOURS[road], "ms": 4, "lw": 1.2, "capsize": 2, "label": road_of(road)}
                if model == SCALAR:
                    line |= {"ls": ":", "mfc": "white", "label": f"{road_of(road)}, scalar factor"}
                ax.errorbar(levels, means, np.abs(bands - means), marker="s" if model == SCALAR else "o", **line)
        unit = next((row["figure"] for row in own), "")
        title(ax, f"{TITLES[maneuver]}, {speed:.0f} km/h")
        ax.axhline(0.0, color="black", lw=0.6)
        ax.set_xticks(sorted({100 * row["oil_level"] for row in own}))
        ax.margins(x=0.2)
        ax.set_xlabel("oil level [%]")
        ax.set_ylabel(f"{unit}\nagainst intact [%]", fontsize=8.5)
    legend_above(figure, *axes.flat[: len(shown)])
    return figure
