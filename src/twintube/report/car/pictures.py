"""The pictures of the whole car: what is felt first, and the change of every headline figure over the oil level."""

import textwrap
from collections.abc import Mapping, Sequence
from typing import Any

from matplotlib.figure import Figure

from twintube.dampers.freed_gas import SCALAR
from twintube.report.common.style import BLUE, GREEN, GREY, INK, ORANGE, RED, VIOLET, grid, legend_above, title
from twintube.vehicle.full.catalogue import MANEUVERS

COLOURS = {"smooth": GREY, "A": VIOLET, "B": GREEN, "C": BLUE, "D": RED, "E": ORANGE}
TITLES = {name: each.title for name, each in MANEUVERS.items()}


def road_of(row: Mapping[str, Any]) -> str:
    """The road of a row in words."""
    if row["maneuver"] == "table3":
        return str(row["road"])
    return "smooth road" if row["road"] == "smooth" else f"class {row['road']}"


def answer(firsts: Sequence[Mapping[str, Any]], rows: Sequence[Mapping[str, Any]], narrow: bool = False) -> Figure:
    """A bar for each row of `firsts`, with its band and what a scalar factor says of the same drive."""
    same = ("maneuver", "speed_kmh", "road", "oil_level")
    figure, axes = grid(1, (9.0, 0.5 * len(firsts) + 0.8), narrow)
    ax = axes[0, 0]
    names = []
    for at, row in enumerate(firsts):
        low, high = (100 * x for x in row["change_band"])
        ax.barh(at, 100 * row["change"], 0.5, color=BLUE, label="change, worn against intact")
        ax.plot([low, high], [at, at], "|-", color=INK, lw=1.5, ms=9, label="band")
        for other in rows:
            if other["model"] == SCALAR and other["change"] is not None and all(other[k] == row[k] for k in same):
                ax.plot(100 * other["change"], at, "s", color=RED, mfc="white", ms=7, label="by a scalar factor")
        drive = f"{TITLES[row['maneuver']]}, {row['speed_kmh']:.0f} km/h, {road_of(row)}, {row['oil_level']:.0%} oil"
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
                means = [100 * r["change"] for r in some]
                spread = [[m - 100 * r["change_band"][0] for m, r in zip(means, some, strict=True)],
                          [100 * r["change_band"][1] - m for m, r in zip(means, some, strict=True)]]  # fmt: skip
                style = {"ls": ":", "marker": "s", "mfc": "white"} if model == SCALAR else {"ls": "-", "marker": "o"}
                where = "smooth road" if road == "smooth" else f"class {road}"
                name = f"{where}, scalar factor" if model == SCALAR else where
                ax.errorbar(levels, means, spread, color=COLOURS[road], ms=4, lw=1.2, capsize=2, label=name, **style)
        unit = next((row["figure"] for row in own), "")
        title(ax, f"{TITLES[maneuver]}, {speed:.0f} km/h")
        ax.axhline(0.0, color="black", lw=0.6)
        ax.set_xticks(sorted({100 * row["oil_level"] for row in own}))
        ax.margins(x=0.2)
        ax.set_xlabel("oil level [%]")
        ax.set_ylabel(f"{unit}\nagainst intact [%]", fontsize=8.5)
    legend_above(figure, *axes.flat[: len(shown)])
    return figure
