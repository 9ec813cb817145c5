"""The paper's conclusion as a table: which oil loss an inspection sees, and which one the road feels."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from twintube.common.words import listed
from twintube.dampers.freed_gas import SCALAR
from twintube.engine.simulate import InputError
from twintube.report.common.html_page import Section, Table

# What stands beside it, quoted in the paper's introduction and in trade literature.
LITERATURE = (
    (
        "Rompe",
        "dampers at 50 %: braking distance +8 % without and +23 % with slip control; cornering speed -10 % on uneven roads",
    ),
    ("Schramm", "transmittable lateral force of an axle down by up to 50 %"),
    ("Zwosta", "the braking distance grows on flat and uneven roads, not in proportion to the oil"),
    ("KYB and TUEV", "+20 % from 80 km/h with ESP (trade press, 2005)"),
)


def read_inspection(path: Path) -> dict[str, Any]:
    """The figures that `twintube inspect --json` wrote; raises InputError for anything else."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        if content["detection"] and {"method", "oil_level", "scalar_factor", "detected_share"} <= set(
            content["detection"][0]
        ):
            return dict(content)
    except (ValueError, KeyError, TypeError):
        pass
    raise InputError(f"{path.name}: is not a file of `twintube inspect --scatter N --json FILE`, with shares detected")


def section(inspection: Mapping[str, Any], rows: Sequence[Mapping[str, Any]]) -> Section:
    """The table with what the literature says."""
    found = inspection["detection"]
    methods = list(dict.fromkeys(item["method"] for item in found))
    dampers = list(dict.fromkeys(item["damper"] for item in found))
    driven = list(dict.fromkeys((r["maneuver"], r["speed_kmh"], r["road"]) for r in rows if r["maneuver"] != "ride"))
    levels = sorted({r["oil_level"] for r in rows} & {item["oil_level"] for item in found}, reverse=True)
    cells = []
    for level in levels:
        for scalar in (False, True):
            shares = [share(found, method, level, scalar) for method in methods]
            changes = [change(rows, drive, level, scalar) for drive in driven]
            cells.append([f"{level:.0%}", "scalar factor" if scalar else "full model", *shares, *changes])
    head = ("oil", "model", *(m.replace("_", " ") for m in methods), *(f"{m} {v:.0f} km/h, {r}" for m, v, r in driven))
    samples = inspection["scatter"]["samples"]
    return Section(
        "conclusion", "Seen in an inspection, felt on the road",
        text=[f"Inspections: share of {', '.join(dampers)} detected at 5 % false alarms, over {samples} cars and testers. "
              "Drives: change of the stopping distance, the largest lateral acceleration or what else a manoeuvre is "
              "compared by, with the band over seeds."],
        tables=[Table(head, cells)], notes=[(f"Literature: {who}", what) for who, what in LITERATURE],
    )  # fmt: skip


def seen_first(inspection: Mapping[str, Any]) -> str:
    """The highest of the oil levels that any inspection sees, damper by damper, in a sentence."""
    levels: dict[str, float] = {}
    for row in inspection.get("first_seen", []):
        if row["oil_level"] is not None:
            levels[row["damper"]] = max(row["oil_level"], levels.get(row["damper"], 0.0))
    texts = [f"{damper} at {level:.0%}" for damper, level in levels.items()]
    computed = sorted({item["oil_level"] for item in inspection["detection"]}, reverse=True)
    return f"Seen by an inspection, of {listed(f'{x:.0%}' for x in computed)} oil: {', '.join(texts) or 'none'}."


def share(found: Sequence[Mapping[str, Any]], method: str, level: float, scalar: bool) -> str:
    """Least and most detected share of the dampers."""
    some = [
        item["detected_share"]
        for item in found
        if (item["method"], item["oil_level"], bool(item["scalar_factor"])) == (method, level, scalar)
    ]
    if not some:
        return "-"
    low, high = f"{min(some):.0%}", f"{max(some):.0%}"
    return low if low == high else f"{low} to {high}"


def change(rows: Sequence[Mapping[str, Any]], drive: tuple[Any, ...], level: float, scalar: bool) -> str:
    """Change of a drive's headline figure with its band."""
    for row in rows:
        same = (row["maneuver"], row["speed_kmh"], row["road"]) == drive and row["oil_level"] == level
        if same and (row["model"] == SCALAR) == scalar:
            if row["change"] is None:
                return "not driven"
            low, high = row["change_band"]
            return f"{row['change']:+.0%} ({low:+.0%} to {high:+.0%})"
    return "-"
