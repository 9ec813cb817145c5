"""The page of the whole car: what worn dampers change in ride, braking and cornering."""

from collections.abc import Mapping, Sequence
from typing import Any

from twintube.dampers.freed_gas import SCALAR
from twintube.report import conclusion
from twintube.report.car_figures import tables
from twintube.report.page import Headline, Picture, Section, Table, html
from twintube.report.style import BLUE, GREEN, GREY, ORANGE, RED, VIOLET, canvas, legend_above, png, title
from twintube.vehicle.cars import CarSet
from twintube.vehicle.full.catalogue import MANEUVERS
from twintube.words import counted

COLOURS = {"smooth": GREY, "A": VIOLET, "B": GREEN, "C": BLUE, "D": RED, "E": ORANGE}
TITLES = {name: each.title for name, each in MANEUVERS.items()}


def picture(rows: Sequence[Mapping[str, Any]]) -> bytes:
    """PNG: change of the headline figures over the oil level, by manoeuvre and speed; bars span the seeds."""
    # The drives of Table 3, each on a road of its own, are in the tables only.
    shown = list(dict.fromkeys((row["maneuver"], row["speed_kmh"]) for row in rows if row["maneuver"] != "table3"))
    if not shown:
        return b""
    columns = min(3, len(shown))
    lines = -(-len(shown) // columns)
    figure, axes = canvas(lines, columns, (4.2 * columns, 3.4 * lines))
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
        ax.set_xlabel("oil [%]")
        ax.set_ylabel(f"{unit}\nagainst intact [%]", fontsize=8.5)
    for ax in axes.flat[len(shown) :]:
        ax.set_visible(False)
    legend_above(figure, *axes.flat[: len(shown)], columns=2 * columns)
    return png(figure)


def page(
    car: CarSet,
    conditions: Mapping[str, Any],
    rows: Sequence[Mapping[str, Any]],
    entries: Sequence[Mapping[str, Any]],
    seen: Mapping[str, Any] | None = None,
    courses: Mapping[str, Sequence[Picture]] | None = None,
) -> str:
    """The page as HTML; `rows` compare the `entries` of the drives, `seen` holds the figures of an inspection study.

    `courses` are pictures of drives, by manoeuvre.
    """
    sections = [conclusion.section(seen, rows)] if seen is not None else []
    for name, words in TITLES.items():
        own = [entry for entry in entries if entry["maneuver"] == name]
        if own:
            compared = table([row for row in rows if row["maneuver"] == name])
            sections.append(
                Section(
                    name, words, text=[text for text in (MANEUVERS[name].standard,) if text],
                    pictures=(courses or {}).get(name, ()), tables=[compared, *tables(own)],
                )
            )  # fmt: skip
    failed = [(f"seed {entry['seed']}, {entry['model']}", entry["failed"]) for entry in entries if "failed" in entry]
    if failed:
        sections.append(
            Section("failed", "Not driven", text=[f"{counted(len(failed), 'drive')} ended early:"], notes=failed)
        )
    said = [conclusion.seen_first(seen)] if seen is not None else []
    assumed = [(name, text) for name, text in car.assumed.items()]
    sections.append(Section("assumed", "Assumed values of the car", text=["No source gives these:"], notes=assumed))
    sections.append(Section("sources", "Sources", notes=list(car.sources.items())))
    return html(
        f"Whole car: {car.title}",
        [
            f"Dampers {conditions['front']} in front and {conditions['rear']} at the rear; worn: {conditions['worn']}, "
            f"without gas preload; grip {conditions['grip']} of a dry road's. Each figure is that of the "
            "worn car over that of the intact car on the same road; the "
            f"band is that of {counted(conditions['seeds'], 'seed')}: other roads of the class, and a slip control whose "
            "thresholds and rates scatter by a quarter; of the full model also that of four ways of the gas that "
            "cavitation frees. F-v curves are stand-ins (assumed)."
        ],
        sections,
        headline=Headline(" ".join([statement(rows), *said]),
                          picture=Picture(shown, "changes over the oil level") if (shown := picture(rows)) else None),
    )  # fmt: skip


def statement(rows: Sequence[Mapping[str, Any]]) -> str:
    """The largest change of each manoeuvre at the highest oil level where its band leaves zero, in a sentence."""
    parts = []
    for name, words in TITLES.items():
        own = [r for r in rows if r["maneuver"] == name and r["model"] != SCALAR and r["change"] is not None]
        clear = [r for r in own if r["change_band"][0] * r["change_band"][1] > 0 and abs(r["change"]) >= 0.01]
        if not own:
            continue
        if not clear:
            parts.append(f"{words.lower()}: no change that all seeds and ways of the freed gas share")
            continue
        level = max(r["oil_level"] for r in clear)
        first = max((r for r in clear if r["oil_level"] == level), key=lambda r: abs(r["change"]))
        low, high = first["change_band"]
        road = {"smooth": "a smooth road"}.get(first["road"], f"class {first['road']}")
        if name == "table3":
            road = first["road"]
        parts.append(
            f"{words.lower()} from {level:.0%} oil ({first['figure']} {first['change']:+.0%} at "
            f"{first['speed_kmh']:.0f} km/h on {road}, {low:+.0%} to {high:+.0%} over "
            f"{counted(first['seeds'], 'seed')} and all ways of the freed gas)"
        )
    return "Felt first, of the levels tried: " + "; ".join(parts) + "."


def table(rows: Sequence[Mapping[str, Any]]) -> Table:
    """One manoeuvre's rows."""
    cells = []
    for row in rows:
        band = row["change_band"]
        over = counted(row["seeds"], "seed") + ("" if row["model"] == SCALAR else " and the ways of the freed gas")
        cells.append([
            f"{row['speed_kmh']:.0f}", row["road"], f"{row['oil_level']:.0%}", row["model"],
            MANEUVERS[row["maneuver"]].without if band is None else f"{row['change']:+.1%}",
            "" if band is None else f"{band[0]:+.1%} to {band[1]:+.1%}", over, str(row["failed"] or ""),
        ])  # fmt: skip
    head = ("km/h", "road", "oil", "model", "change", "band", "over", "left out")
    return Table(head, cells, f"{rows[0]['figure']}, worn against intact", numeric=(0, 2, 4, 5))
