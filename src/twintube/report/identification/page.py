"""The page of `twintube identify`: what the set is good for, parameters, their intervals, and the errors on the records."""

from collections.abc import Sequence
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from twintube.common.files import write_bytes, write_text
from twintube.fitting.peak_velocity import as_csv, as_xlsx, peak_velocities
from twintube.fitting.prediction import predicted
from twintube.identification import Harmonic, Result
from twintube.identification.figures import totals, unit
from twintube.identification.judgement import judgement, next_step
from twintube.identification.remarks import reach
from twintube.report.common import style
from twintube.report.common.html_page import Headline, Page, Picture, Section, Table
from twintube.report.common.titles import meaning
from twintube.report.identification import pictures as drawings
from twintube.report.identification.live import Curve, Look, live
from twintube.report.identification.pictures import SPLITS

LOOPS = 8  # records of which the loops are drawn
FIRST = 3  # of them on the first screen
BADGES = {  # first word of a judgement, the best first -> badge, class of the style sheet
    "Usable": ("usable", "yes"),
    "Rough": ("rough", "warn"),
    "Not": ("not usable", "no"),
}


def live_part(result: Result, chosen: Sequence[tuple[Harmonic, str]]) -> str:
    """The same records to look into, as the identified model has them."""
    damper, offset = result.identification.damper, result.identification.offset
    looks = []
    for record, split in chosen:
        first, last = int(record.marks[0]), int(record.marks[-1])
        span = slice(first, last + 1)
        looks.append(
            Look(
                f"{record.oil_level:.0%} oil, {record.top_speed:.3g} m/s, {SPLITS[split]}", record.name,
                record.time[span], record.stroke[span], record.velocity[span],
                {"measured": record.force[span], "simulated": predicted(damper, record, offset)[span]},
                (record.marks - first).tolist(),
            )
        )  # fmt: skip
    return live([Curve("measured", "measured", style.INK), Curve("simulated", "identified model", style.RED)], looks)


def percent(part: dict[str, Any] | None, what: str) -> list[str]:
    """A row of the table of errors."""
    if part is None:
        return [what, "none", "", "", ""]

    def both(key: str, before: str = "") -> str:
        return "" if part.get(key) is None else f"{before}{part[key]:.1%} (worst {part[f'{key}_worst']:.1%})"

    force = (
        f"{part['force_rmse_N']:.1f} N, {part['force_rmse_of_peak']:.1%} of the peak "
        f"(worst {part['force_rmse_of_peak_worst']:.1%}, {part['worst']})"
    )
    if "force_rmse_recorded_N" in part:
        force += f"; {part['force_rmse_recorded_N']:.1f} N over the strokes with their noise"
    drives = f", {part['stochastic']} stochastic" if part["stochastic"] else ""
    keys = ("work_error_first", "work_error_last")
    works = [both(key) + both(f"{key}_of_intact", "; of the intact work ") for key in keys]
    return [what, f"{part['records']}{drives}", force, *works]


def parameter_table(result: Result) -> Table:
    """All identified parameters with their intervals and doubts."""
    rows = []
    for e in result.identification.estimates:
        doubts = ", ".join((["not determined"] * (not e.determined)) + (["at its bound"] * e.at_bound))
        interval, allowed = f"{e.low:.3g} to {e.high:.3g}", f"{e.bounds[0]:g} to {e.bounds[1]:.3g}"
        rows.append([e.name, meaning(e.name), f"{e.value:.3g}", unit(e.name), interval, allowed, doubts])
    head = ["parameter", "meaning", "value", "unit", "interval", "allowed", ""]
    return Table(head, rows, "Intervals hold with 95 % for all parameters together")


def headline(result: Result, folder: str, chosen: Sequence[tuple[Harmonic, str]]) -> Headline:
    """What the first screen says: what the set is good for and what not, the next step, measured and simulated loops."""
    sentences = judgement(result)
    limits = [text for text in sentences if text.startswith("Not for")]
    good = [text for text in sentences if text not in limits]
    words = [text.split()[0] for text in good]
    badge = next((BADGES[word] for word in reversed(BADGES) if word in words), ("", "open"))
    some = partial(drawings.loops, result, style.spread(chosen, FIRST))
    return Headline(
        good[0] if good else "Identified.", *badge, " ".join([*good[1:], *limits]), f"{next_step(result, folder)}.",
        Picture.drawn(some, "First and last oscillation of some records."),
    )  # fmt: skip


def error_table(result: Result) -> Table:
    """Errors of the identified model over the records of each kind."""
    rows = [percent(totals(result.validation, kind), text) for kind, text in SPLITS.items()]
    head = ["records", "number", "force error (RMS)", "work, first oscillation", "work, last oscillation"]
    return Table(head, rows, "Error of the identified model; works as median")


def record_table(result: Result) -> Table:
    """Every record with its errors."""
    rows = [
        [r.name, SPLITS.get(r.split, r.split), f"{r.oil_level:.0%}", f"{r.top_speed:.3g} m/s", f"{r.force_rmse:.1f} N",
         f"{r.force_peak:.0f} N", " / ".join(f"{w:.2f}" for w in r.work_measured) + " J",
         " / ".join(f"{w:.2f}" for w in r.work_simulated) + " J"]
        for r in result.validation
    ]  # fmt: skip
    return Table(
        ["record", "", "oil", "speed", "force error", "peak", "work measured", "work simulated"], rows,
        "Works of the first and the last oscillation, of drives in total", (2, 3, 4, 5),
    )  # fmt: skip


def step_table(result: Result) -> Table:
    """The steps of the search."""
    rows = [
        [s.title, ", ".join(s.names), f"{s.best.error:.3g} {s.unit}", f"{s.best.evaluations}"]
        for s in result.identification.steps
    ]
    return Table(["step", "parameters", "error", "simulations"], rows, numeric=(3,))


def record_section(result: Result) -> Section:
    """The errors on all records."""
    harmonics = [row for row in result.validation if row.measurement == "harmonic"]
    relative = [row for row in result.validation if row.relative_measured is not None]
    drawn = [Picture.drawn(partial(drawings.works, harmonics), "Filled: fitted, open: not fitted.", "works")]
    drawn += [Picture.drawn(partial(drawings.drives, relative), "Not used for fitting.", "drives")] if relative else []
    return Section("records", "Errors of all records", pictures=drawn, tables=[error_table(result), record_table(result)])


def parameter_section(result: Result) -> Section:
    """The identified parameters."""
    found = result.identification
    alike = [f"{a} and {b} act alike on these records (correlation {c:.2f})." for a, b, c in found.pairs]
    caption = "Bar: interval, line: value, within the allowed range. Grey: these records do not tell the value."
    drawn = [Picture.drawn(partial(drawings.intervals, result), caption, "intervals")] if found.steps else []
    return Section("parameters", "Parameters", text=alike, tables=[parameter_table(result)], pictures=drawn)


def sections(result: Result, chosen: Sequence[tuple[Harmonic, str]]) -> list[Section]:
    """The page below the answer; what has nothing to show is left out."""
    top = reach([h for h, split in result.harmonics if h.intact and split == "fit"])
    continued = f" Measured up to {top:.3g} m/s; the parameter file continues it by its last slope." if top else ""
    curve = Picture.drawn(partial(drawings.curve, result), f"The first step of the identification.{continued}", "fv_curve")
    caption = "First and last oscillation; records not fitted come first."
    loops = Picture.drawn(partial(drawings.loops, result, chosen), caption, "loops")
    parts = [record_section(result), *([parameter_section(result)] if result.identification.estimates else [])]
    parts += [
        Section("records-live", "Look into the records", live=live_part(result, chosen)),
        Section("loops", "Force over stroke", pictures=[loops]),
        Section("fv_curve", "F-v curve", pictures=[curve]),
    ]
    if result.identification.steps:
        caption = "Error of the best set after each generation."
        drawn = Picture.drawn(partial(drawings.convergence, result), caption, "convergence")
        parts.append(Section("search", "Search", pictures=[drawn], tables=[step_table(result)]))
    return parts + ([Section("remarks", "Remarks", items=result.remarks)] if result.remarks else [])


def page(result: Result, folder: str) -> Page:
    """The page of a result; `folder` is named in the next step."""
    ordered = sorted(result.harmonics, key=lambda pair: (pair[1] != "heldout", pair[0].top_speed))
    chosen = style.spread([pair for pair in ordered if not pair[0].intact] or ordered, LOOPS)
    head = headline(result, folder, chosen)
    return Page(f"Identification: {result.dataset.title}", sections(result, chosen), headline=head)


def write_table(result: Result, folder: Path) -> list[Path]:
    """Write the table of forces over velocity; returns the files."""
    table, files = peak_velocities([h for h, _ in result.harmonics]), [folder / "fv_table.csv"]
    write_text(files[0], as_csv(table))
    if find_spec("xlsxwriter"):
        files.append(folder / "fv_table.xlsx")
        write_bytes(files[1], as_xlsx(table))
    return files
