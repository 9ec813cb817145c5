"""The page of the whole car: what worn dampers change in ride, braking and cornering."""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

from twintube.common.grouping import grouped
from twintube.common.words import counted, listed
from twintube.dampers.freed_gas import SCALAR
from twintube.report.car import conclusion
from twintube.report.car.figures import TITLES, answer, drives, over_levels, tables
from twintube.report.common.html_page import Headline, Page, Picture, Section, Table
from twintube.vehicle.cars import CarSet
from twintube.vehicle.full.catalogue import MANEUVERS

LEVELS = "Dots and lines: the model; open squares: a scalar factor in its place. Bars span seeds and ways of the freed gas."
BESIDE = "`twintube inspect --json FILE`, then `twintube car --inspection FILE`: what an inspection sees of the same loss."
VARY = "`python -m benchmarks car_sensitivity` shows what the assumed values of the car do to these figures."
SHOWN = 0.01  # relative change [1] that is told


def page(
    car: CarSet,
    conditions: Mapping[str, Any],
    rows: Sequence[Mapping[str, Any]],
    entries: Sequence[Mapping[str, Any]],
    *,
    seen: Mapping[str, Any] | None = None,
    courses: Mapping[str, Sequence[Picture]] | None = None,
) -> Page:
    """The page; `rows` compare the `entries` of the drives, `seen` holds the figures of an inspection study.

    `courses` are pictures of drives, by manoeuvre.
    """
    sections = [conclusion.section(seen, rows)] if seen is not None else []
    if drives(rows):
        drawn = Picture.drawn(partial(over_levels, rows), LEVELS, "car")
        sections.append(Section("levels", "Change over the oil level", pictures=[drawn]))
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
    assumed = [(name, text) for name, text in car.assumed.items()]
    sections.append(Section("assumed", "Assumed values of the car", text=["No source gives these:"], notes=assumed))
    sections.append(Section("sources", "Sources", notes=list(car.sources.items())))
    lead = (
        f"Dampers {conditions['front']} in front and {conditions['rear']} at the rear; worn: {conditions['worn']}, "
        f"gas preload {conditions['gas_preload']}{warm(conditions)}; grip {conditions['grip']} of a dry road's. "
        "Each figure is that of the worn car over that of the intact car on the same road; the "
        f"band is that of {counted(conditions['seeds'], 'seed')}: other roads of the class, and a slip control whose "
        "thresholds and rates scatter by a quarter; of the full model also that of four ways of the gas that "
        "cavitation frees. F-v curves are stand-ins (assumed)."
    )
    head = headline(rows, seen, conditions["gas_preload"])
    return Page(f"Whole car: {car.title}", sections, [lead], headline=head)


def warm(conditions: Mapping[str, Any]) -> str:
    """The temperature of all dampers, where it is not that of their parameters."""
    degC = conditions.get("temperature_degC")
    return "" if degC is None else f"; all dampers at {degC:g} °C"


def felt(rows: Sequence[Mapping[str, Any]]) -> tuple[list[Mapping[str, Any]], list[str]]:
    """Of each manoeuvre the largest change at the highest oil level where its band leaves zero; titles of those without."""
    firsts, without = [], []
    for name, words in TITLES.items():
        own = [r for r in rows if r["maneuver"] == name and r["model"] != SCALAR and r["change"] is not None]
        clear = [r for r in own if r["change_band"][0] * r["change_band"][1] > 0 and abs(r["change"]) >= SHOWN]
        if clear:
            level = max(r["oil_level"] for r in clear)
            firsts.append(max((r for r in clear if r["oil_level"] == level), key=lambda r: abs(r["change"])))
        elif own:
            without.append(words.lower())
    return firsts, without


def headline(rows: Sequence[Mapping[str, Any]], seen: Mapping[str, Any] | None, gas: str) -> Headline:
    """What the first screen says: what is felt first on the road, and what an inspection sees; `gas` tells the preload."""
    firsts, without = felt(rows)
    levels = grouped((row["oil_level"], f"{row['figure']} {row['change']:+.0%}") for row in firsts)
    driven = sorted({row["oil_level"] for row in rows}, reverse=True)
    state = f"{listed(f'{x:.0%}' for x in driven)} oil (gas preload {gas})"
    if len(driven) == 1:
        parts = [f"At {state} are felt: {', '.join(texts)}." for texts in levels.values()]
    else:
        parts = [f"Felt first at {at:.0%}: {', '.join(texts)}." for at, texts in sorted(levels.items(), reverse=True)]
        parts.insert(0, f"Driven with {state}.")
    if without:
        parts.append(f"Not felt, in all roads and ways of the freed gas: {', '.join(without)}.")
    remark = conclusion.seen_first(seen) if seen is not None else ""
    seeds = max((row["seeds"] for row in rows), default=1)
    caption = f"The largest change of each manoeuvre. Band: {counted(seeds, 'seed')} and all ways of the freed gas."
    drawn = Picture.drawn(partial(answer, firsts, rows), caption) if firsts else None
    return Headline(" ".join(parts), remark=remark, next=BESIDE if seen is None else VARY, picture=drawn)


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
