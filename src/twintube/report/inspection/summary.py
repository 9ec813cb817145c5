"""What `twintube inspect` found, in words and as figures: from which oil level on a damper fails, and which loss is seen."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from twintube.common.grouping import grouped
from twintube.common.words import listed
from twintube.dampers import Damper
from twintube.dampers.damper import gas_in_words
from twintube.inspection import METHODS, RANGES, Detection, Entry, Method, Setting, first_seen
from twintube.inspection.detection import FALSE_ALARMS, SEEN
from twintube.inspection.tiring import AMPLITUDES
from twintube.report.inspection import tiring
from twintube.vehicle.cars import CarSet, axle

EVERY_WAY = " whatever freed gas does"
NOWHERE = "at none of these oil levels"


@dataclass(frozen=True)
class Inspection:
    """All that `twintube inspect` found; without scatter there are no detections."""

    dampers: Sequence[Damper]
    vehicle: CarSet
    entries: Sequence[Entry]
    detections: Sequence[Detection]
    ways: Sequence[str]  # of the freed gas; the first is that of the figures
    seed: int
    plates: Sequence[float] = AMPLITUDES  # [m] of `tiring`

    @property
    def methods(self) -> list[Method]:
        """The methods of the entries, in the order of METHODS."""
        used = {entry.method for entry in self.entries}
        return [method for name, method in METHODS.items() if name in used]

    @property
    def samples(self) -> int:
        """Cars and testers that were drawn."""
        return len(self.detections[0].figures) if self.detections else 0

    def of(self, damper: Damper, method: Method) -> list[Entry]:
        """The entries of a damper and a method, highest oil level first."""
        return [entry for entry in self.entries if (entry.damper, entry.method) == (damper.name, method.name)]


def verdict(entry: Entry) -> str:
    """What stands behind a figure."""
    return " not judged" if entry.not_judged else "" if entry.passed else " fails"


def digits(value: float | None, method: Method) -> str:
    """A figure with the digits that its unit asks for."""
    return "" if value is None else f"{value:.0f}" if method.unit else f"{value:.2f}"


def summary(result: Inspection) -> dict[str, Any]:
    """All figures for JSON."""
    plate = Setting().plate
    return {
        "car": result.vehicle.name,
        "freed_gas": result.ways[0],
        "freed_gas_ways": list(result.ways),
        "plate": {"amplitude_m": plate.amplitude, "top_Hz": plate.top, "coast_s": plate.coast},
        "plates_of_tiring_m": list(result.plates),
        "dead_lengths_m": {damper.name: damper.parameters.dead_length for damper in result.dampers},
        "methods": {
            m.name: {"figure": m.figure, "unit": m.unit, "limit": m.limit, "rule": m.rule, "source": m.source,
                     "how_sure": m.certainty}
            for m in result.methods
        },
        "entries": [entry.as_json for entry in result.entries],
        "scatter": {
            "samples": result.samples,
            "seed": result.seed,
            "ranges": {r.name: {"low": r.low, "high": r.high, "unit": r.unit, "basis": r.basis} for r in RANGES},
        },
        "detection": [item.as_json for item in result.detections],
        "first_seen": [
            {"damper": damper.name, "method": m.name, "oil_level": seen_under(result, damper, m)[result.ways[0]],
             "freed_gas_ways": seen_under(result, damper, m),
             "seen_at": {name: seen_at(result, damper, m, name) for name in result.ways},
             "scalar_factor": first_seen(result.detections, damper.name, m.name, scalar=True)}
            for damper in result.dampers
            for m in result.methods
            if result.detections
        ],
    }  # fmt: skip


def seen_under(result: Inspection, damper: Damper, method: Method) -> dict[str, float | None]:
    """From which oil level on a method sees the loss, by what freed gas does."""
    return {name: first_seen(result.detections, damper.name, method.name, name) for name in result.ways}


def seen_at(result: Inspection, damper: Damper, method: Method, freed_gas: str) -> list[float]:
    """All oil levels at which a method sees the loss; what tires early is spent at lower levels, and not seen there."""
    return [
        d.condition.oil_level
        for d in result.detections
        if (d.damper, d.method, d.condition.scalar, d.condition.freed_gas) == (damper.name, method, False, freed_gas)
        and d.share >= SEEN
    ]


def by_way(texts: Mapping[str, str]) -> str:
    """One text where all ways of the freed gas agree; else that of the first, and under which conditions it is another."""
    first, *others = texts.items()
    conditions = grouped((text, name) for name, text in others if text != first[1])
    if not conditions:
        return first[1] + (EVERY_WAY if others else "")
    flips = (f"{text} with freed gas {listed(names)}" for text, names in conditions.items())
    return f"{first[1]}, but {', '.join(flips)}"


def never_judged(result: Inspection, damper: Damper, method: Method) -> bool:
    """Whether a method judges the damper at none of the oil levels."""
    return all(entry.not_judged for entry in result.of(damper, method))


def seen_in_words(result: Inspection, damper: Damper, method: Method) -> str:
    """At which of the oil levels a method sees the loss, and under which ways at others."""
    if never_judged(result, damper, method):
        return "at none, as it does not judge this damper"
    if method.name == "tiring":
        levels = {name: seen_at(result, damper, method, name) for name in result.ways}
        return by_way({name: f"at {listed(f'{x:.0%}' for x in at)}" if at else NOWHERE for name, at in levels.items()})
    return by_way({name: down_from(result, level) for name, level in seen_under(result, damper, method).items()})


def factor_seen(result: Inspection, damper: Damper, method: Method) -> str:
    """At which of the oil levels a method sees the scalar factor."""
    return down_from(result, first_seen(result.detections, damper.name, method.name, scalar=True))


def down_from(result: Inspection, level: float | None) -> str:
    """The oil levels from one on down, in words; no level but those of the study."""
    if level is None:
        return NOWHERE
    lowest = min(d.condition.oil_level for d in result.detections)
    return f"at {level:.0%}" if level == lowest else f"from {level:.0%} down to {lowest:.0%}"


def passed_down_to(result: Inspection, damper: Damper, freed_gas: str) -> float | None:
    """The lowest oil level down to which the damper passes every method that judges it under a way; one has to."""
    passed = None
    for level in sorted({e.condition.oil_level for e in result.entries}, reverse=True):
        own = (e for e in result.entries if (e.damper, e.condition.oil_level) == (damper.name, level))
        answers = {e.passes_under(freed_gas) for e in own}
        if False in answers or True not in answers:
            break
        passed = level
    return passed


def sentence(result: Inspection, damper: Damper) -> str:
    """Down to which oil level the damper passes every method, and under which ways down to another one."""
    never = {m.title: never_judged(result, damper, m) for m in result.methods}
    if all(never.values()):
        why = {e.not_judged.removeprefix("not judged: ") for e in result.entries if e.damper == damper.name}
        return f"{damper.name} is not judged by {result.methods[0].title}{': ' + why.pop() if len(why) == 1 else ''}."
    names = "every method" if len(result.methods) > 1 else result.methods[0].title
    names += "".join(f" but {title}, which does not judge it," for title, holds in never.items() if holds)
    levels = {freed_gas: passed_down_to(result, damper, freed_gas) for freed_gas in result.ways}
    texts = {name: NOWHERE if x is None else f"at all of these oil levels down to {x:.0%}" for name, x in levels.items()}
    return f"{damper.name} passes {names} {by_way(texts)}{gas(result)}."


def gas(result: Inspection) -> str:
    """What became of the preload in the dampers that have lost oil; empty where none has."""
    worn = {entry.condition.gas_preload for entry in result.entries if entry.condition.oil_level < 1.0}
    return "" if not worn else f" (below 100% its gas preload is {', '.join(map(gas_in_words, sorted(worn)))})"


def figure_rows(result: Inspection, damper: Damper) -> list[list[str]]:
    """One row per oil level: the figure of each method, marked where it fails, and that of the scalar factor."""
    rows = []
    for entries in zip(*(result.of(damper, m) for m in result.methods), strict=True):
        state = entries[0].condition
        row = [f"{state.oil_level:.0%}", gas_in_words(state.gas_preload)]
        for entry, m in zip(entries, result.methods, strict=True):
            row.append(
                f"{digits(entry.figure, m)}{verdict(entry)}{other_ways(entry, m)} "
                f"({digits(entry.scalar_figure, m) or 'none'})"
            )
        rows.append(row)
    return rows


def other_ways(entry: Entry, method: Method) -> str:
    """From which to which figure the ways of the freed gas lead, where that shows in the digits."""
    ends = [digits(end(entry.readings.values()), method) for end in (min, max)]
    return "" if ends[0] == ends[1] else f" [{ends[0]} to {ends[1]}]"


def terminal(result: Inspection) -> str:
    """The figures and, where there is scatter, the detection as text."""
    lines = []
    for damper in result.dampers:
        lines.append(
            f"{damper.name}, {axle(damper)} corner of {result.vehicle.name}; in brackets the oil level as a scalar factor"
            + ("; [ ]: from way to way" if len(result.ways) > 1 else "")
        )
        head = ["oil", "preload", *(f"{m.name} [{m.unit or 1}]" for m in result.methods)]
        rows = [head, *figure_rows(result, damper)]
        widths = [max(len(row[i]) for row in rows) for i in range(len(head))]
        lines += ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
        lines.append(sentence(result, damper))
        lines += tiring.remarks(result.of(damper, METHODS["tiring"]))
        if result.detections:
            for m in result.methods:
                seen, factor = seen_in_words(result, damper, m), factor_seen(result, damper, m)
                text = f"{SEEN:.0%} detected at {FALSE_ALARMS:.0%} false alarms"
                lines.append(f"{m.name}: {text} {seen} (scalar factor: {factor})")
    return "\n".join(lines)
