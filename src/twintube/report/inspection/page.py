"""The page of `twintube inspect`: figures and verdicts over the oil level, and what is detected over the scatter."""

from collections.abc import Callable, Sequence
from functools import partial

from twintube.common.grouping import grouped
from twintube.common.words import listed
from twintube.dampers import Damper
from twintube.inspection import METHODS, Detection
from twintube.inspection.detection import CONFIDENCE, FALSE_ALARMS, SEEN
from twintube.inspection.figures import READING, WINDOWS
from twintube.inspection.tables import METHOD_HEAD, RANGE_HEAD, method_rows, range_rows
from twintube.report.common.html_page import Headline, Page, Picture, Section, Table
from twintube.report.inspection import tiring
from twintube.report.inspection.pictures import figures_over_oil, roc_curves, shares, spanned, sweep, verdicts
from twintube.report.inspection.summary import EVERY_WAY, Inspection, factor_seen, figure_rows, gas, seen_in_words, sentence

MODEL, FACTOR = "model", "scalar factor"
ONE_CORNER = (
    "One corner, a quarter car: no left against right, no pitch of the body, no play or worn bushings. Cars, obstacle and "
    "tester are assumed."
)
FIGURES = "Lines: the model; open squares: the oil level as a scalar factor on the fluid force. Red: the side that fails."
NEXT = "`twintube inspect --json FILE`, then `twintube car --inspection FILE`: what the same loss does on the road."


def seen_table(result: Inspection) -> Table:
    """Where each method first sees the loss."""
    rows = [
        [damper.name, m.title, seen_in_words(result, damper, m), factor_seen(result, damper, m)]
        for damper in result.dampers
        for m in result.methods
    ]
    return Table(
        ["damper", "method", MODEL, FACTOR], rows,
        f"Oil levels of this study at which, and at all below, {SEEN:.0%} are detected at {FALSE_ALARMS:.0%} false alarms; "
        f"of {METHODS['tiring'].title} all such levels, as below them a damper may be spent",
    )  # fmt: skip


def detection_tables(result: Inspection, damper: Damper) -> list[Table]:
    """Share detected and share that fails at the method's limit, a column per oil level."""
    here = [d for d in result.detections if d.damper == damper.name]
    levels = sorted({d.condition.oil_level for d in here}, reverse=True)
    found = grouped(((d.method.name, d.condition.scalar, d.condition.oil_level), d) for d in here)

    def rows(text: Callable[[Sequence[Detection]], str]) -> list[list[str]]:
        return [
            [m.title, FACTOR if scalar else MODEL]
            + [text(found[m.name, scalar, level]) if (m.name, scalar, level) in found else "" for level in levels]
            for m in result.methods
            for scalar in (False, True)
        ]

    def detected(several: Sequence[Detection]) -> str:
        low, high = spanned(several)
        return f"{several[0].share:.0%} ({low:.0%} to {high:.0%})"

    def failed(several: Sequence[Detection]) -> str:
        shares = [f"{end(d.failed_share for d in several):.0%}" for end in (min, max)]
        return shares[0] if shares[0] == shares[1] else f"{several[0].failed_share:.0%} ({shares[0]} to {shares[1]})"

    head = ["method", "damper", *(f"{level:.0%} oil" for level in levels)]
    band = f"{CONFIDENCE:.0%} band{', widest over the ways of the freed gas' if len(result.ways) > 1 else ''}"
    return [
        Table(head, rows(detected), f"{damper.name}: detected at {FALSE_ALARMS:.0%} false alarms ({band})"),
        Table(head, rows(failed), f"{damper.name}: fails at the method's own limit (from way to way)"),
    ]


def windows_table(result: Inspection) -> Table:
    """The phase shift in every window."""
    rows = [
        [entry.damper, f"{entry.condition.oil_level:.0%}", *(f"{entry.windows[name]:.0f}" for name in WINDOWS)]
        for entry in result.entries if entry.windows
    ]  # fmt: skip
    limit = METHODS["phase_shift"].limit
    caption = f"Smallest phase [deg] per window; `{READING}` is the reading used, and below {limit:g} fails"
    return Table(["damper", "oil", *WINDOWS], rows, caption, numeric=range(2, 2 + len(WINDOWS)))


def damper_section(result: Inspection, damper: Damper) -> Section:
    """Figures of one damper."""
    drawn = Picture.drawn(partial(figures_over_oil, result.of, damper, result.methods), FIGURES, damper.name)
    head = ["oil", "preload", *(f"{m.title}{f' [{m.unit}]' if m.unit else ''}" for m in result.methods)]
    table = Table(head, figure_rows(result, damper), "Figure and verdict; [ ]: from way to way; ( ): scalar factor")
    return Section(damper.name, f"Figures of {damper.name}, {damper.title}", pictures=[drawn], tables=[table])


def plate_section(result: Inspection) -> Section:
    """The coast of the EUSAMA plate of the first damper."""
    first = result.dampers[0]
    states = [entry.condition for entry in result.of(first, result.methods[0])]
    caption = (
        "Force per height of the plate over tyre stiffness, and the angle by which the force leads, one value per cycle. "
        "Thick lines lie below thin ones. Dotted: resonance of the wheel; red: limit."
    )
    drawn = Picture.drawn(partial(sweep, first, result.vehicle, states), caption, "plate")
    tables = [windows_table(result)] if any(entry.windows for entry in result.entries) else []
    return Section("plate", f"The plate run of {first.name}", pictures=[drawn], tables=tables)


def headline(result: Inspection) -> Headline:
    """What the first screen says: down to which oil level the dampers pass, and which loss is seen in the scatter."""
    first = result.dampers[0]
    methods = result.methods if result.detections else []
    seen = grouped((seen_in_words(result, first, m).removesuffix(EVERY_WAY), m.title) for m in methods)
    levels = "; ".join(f"{level}: {', '.join(methods)}" for level, methods in seen.items())
    rule = f"{SEEN:.0%} of the cars at {FALSE_ALARMS:.0%} false alarms"
    remark = f"Oil levels of this study at which the loss of {first.name} is seen in {rule}. {levels}." if seen else ""
    step = NEXT if result.detections else "`--scatter 100` shows in how many of 100 cars the loss is seen."
    caption = f"Figure of each method at each oil level{gas(result)}."
    drawn = Picture.drawn(partial(verdicts, result.of, result.dampers, result.methods), caption, "verdicts")
    text = " ".join(sentence(result, damper) for damper in result.dampers)
    return Headline(text, remark=remark, next=step, picture=drawn)


def detection_section(result: Inspection, damper: Damper) -> Section:
    """Which share of the drawn cars is detected."""
    here, name = [d for d in result.detections if d.damper == damper.name], damper.name
    drawn = [
        Picture.drawn(partial(shares, here, result.methods), "Detected share over the oil level.", f"{name}_detected"),
        Picture.drawn(partial(roc_curves, here, result.methods), "The same for every limit.", f"{name}_roc"),
    ]
    text = (
        f"{result.samples} cars and testers, drawn from the ranges below, the same for all states. Bands: binomial, "
        f"{CONFIDENCE:.0%}, for the drawn limit, from the lowest to the highest of the freed gas {listed(result.ways)}."
    )
    tables = detection_tables(result, damper)
    return Section(f"detection-{name}", f"Detection of {name}", text=[text], pictures=drawn, tables=tables)


def page(result: Inspection) -> Page:
    """The page of an inspection with its pictures."""
    sections = [Section("seen", "Which loss is seen", tables=[seen_table(result)])] if result.detections else []
    sections += [damper_section(result, damper) for damper in result.dampers]
    for damper in result.dampers:
        if watched := result.of(damper, METHODS["tiring"]):
            sections.append(tiring.section(damper, result.vehicle, watched))
    if [m.name for m in result.methods] != ["tiring"]:
        sections.append(plate_section(result))
    if result.detections:
        sections += [detection_section(result, damper) for damper in result.dampers]
    sections.append(Section("methods", "Methods and limits", tables=[Table(METHOD_HEAD, method_rows())]))
    sections.append(Section("scatter", "Ranges of the scatter", tables=[Table(RANGE_HEAD, range_rows())]))
    lead = [
        f"Car: {result.vehicle.title}. {ONE_CORNER} Figures and lines: freed gas {result.ways[0]}"
        + (f"; shaded: from the lowest to the highest of {listed(result.ways)}." if len(result.ways) > 1 else "."),
    ]
    return Page("Inspection of worn dampers", sections, lead, headline=headline(result))
